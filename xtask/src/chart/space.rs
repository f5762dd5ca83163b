//! Discretizations of a rod: error against the number of coordinates and against CPU time.

use anyhow::{Context, Result};
use serde_json::Value;

use super::bench::{Bench, progress_bar};
use super::csv::Csv;
use super::numbers::{Path, distance, largest_distance, medians, number, path};

/// Names of the studies.
const KINDS: &str =
    "cubic cubic_graded cubic_mass cubic_mass_bending quintic quintic_mass spline3 spline4";
/// Meshes and slenderness of the elastica.
const STILL: [u32; 5] = [2, 4, 8, 16, 32];
const SLENDER: [&str; 4] = ["100", "10000", "1e+06", "1e+08"];
/// Rounds over all runs.
const ROUNDS: usize = 3;

/// A rod that moves: case, meshes, end and interval of the time it is compared over, s, and length, m.
struct Moving {
    title: &'static str,
    scene: &'static str,
    meshes: [u32; 6],
    stop_time: &'static str,
    every: &'static str,
    length: f64,
}

const PENDULUM: Moving = Moving {
    title: "soft pendulum",
    scene: "soft_pendulum/scene.json",
    meshes: [10, 20, 40, 60, 80, 120],
    stop_time: "1.1",
    every: "0.01",
    length: 1.2,
};
const SPAGHETTI: Moving = Moving {
    title: "flying spaghetti",
    scene: "flying_spaghetti/triangular.json",
    meshes: [4, 6, 8, 12, 16, 32],
    stop_time: "10",
    every: "0.1",
    length: 10.0,
};
/// Two fine meshes for a reference, coarser than their own lines end.
const FINE: [(&str, u32); 2] = [("quintic", 24), ("spline4", 48)];

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let header = "scene,slenderness,discretization,elements,coordinates,error,cpu_time_s,largest_frequency,iteration_s";
    let mut csv = Csv::new(bench, "space", header);
    elastica(bench, &mut csv)?;
    let reference = bench.table("soft_pendulum/reference.csv")?;
    let reference = reference.points("x_tip", "y_tip")?;
    moving(bench, &mut csv, &PENDULUM, &reference)?;
    let fine = FINE.map(|(kind, elements)| path(&run(bench, &SPAGHETTI, kind, elements)?["path"]));
    let [reference, other] = fine;
    let (reference, other) = (reference?, other?);
    moving(bench, &mut csv, &SPAGHETTI, &reference)?;
    let (name, no) = (format!("{}, reference", SPAGHETTI.title), f64::NAN);
    let apart = largest_distance(&reference, &other) / SPAGHETTI.length;
    let (kind, count) = FINE[1];
    csv.row(&[&name, &no, &kind, &count, &no, &apart, &no, &no, &no]);
    csv.save()
}

/// Tip under `F L^2 / EI = 5`, by slenderness, kind and mesh.
fn elastica(bench: &Bench, csv: &mut Csv) -> Result<()> {
    let mut scene = bench.case("elastica/scene.json")?;
    let case = bench.case("elastica/case.json")?;
    let claims = case["claims"].as_array().context("expected claims")?;
    for ratio in SLENDER {
        let note = format!("EA L^2/EI = {ratio}");
        let wanted = |claim: &&Value| claim["kind"] == "values" && claim["note"] == *note;
        let claim = claims.iter().find(wanted);
        let claim = claim.with_context(|| format!("elastica/case.json: expected {note:?}"))?;
        scene["bodies"][0]["section"]["area"] = claim["set"]["rod.area"].clone();
        let force = claim["set"]["rod.tip.force[2]"].to_string();
        let exact = |axis: u32| number(&claim["values"][format!("rod.tip.position[{axis}]")]);
        let exact = [exact(1)?, exact(2)?];
        let (ratio, no) = (ratio.parse::<f64>()?, f64::NAN);
        for kind in KINDS.split(' ') {
            for count in STILL {
                let options = format!("bend --element {kind} --elements {count} --force {force}");
                let report =
                    bench.studies(&options.split(' ').collect::<Vec<_>>(), Some(&scene))?;
                let error = distance([number(&report["x"])?, number(&report["y"])?], exact);
                let size = number(&report["coordinates"])?;
                csv.row(&[
                    &"elastica",
                    &ratio,
                    &kind,
                    &count,
                    &size,
                    &error,
                    &no,
                    &no,
                    &no,
                ]);
            }
        }
    }
    Ok(())
}

fn run(bench: &Bench, moving: &Moving, kind: &str, elements: u32) -> Result<Value> {
    let scene = bench.case(moving.scene)?;
    let count = elements.to_string();
    let mut options = vec!["space", "--element", kind, "--elements", &count];
    options.extend(["--stop-time", moving.stop_time, "--every", moving.every]);
    bench.studies(&options, Some(&scene))
}

/// All kinds on all meshes, by turns; CPU times are medians.
fn moving(bench: &Bench, csv: &mut Csv, moving: &Moving, reference: &Path) -> Result<()> {
    let all = |kind| moving.meshes.map(|elements| (kind, elements));
    let plan: Vec<(&str, u32)> = KINDS.split(' ').flat_map(all).collect();
    let bar = progress_bar(moving.title, plan.len() * ROUNDS);
    let mut reports = vec![Vec::new(); plan.len()];
    for _ in 0..ROUNDS {
        for ((kind, elements), reports) in plan.iter().zip(&mut reports) {
            reports.push(run(bench, moving, kind, *elements)?);
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    for ((kind, elements), reports) in plan.iter().zip(&reports) {
        let keys = [
            "coordinates",
            "cpu_time",
            "largest_frequency",
            "iteration_time",
        ];
        let [size, time, most, iteration] = medians(reports, keys)?;
        let path = path(&reports[0]["path"])?;
        let (found, known) = (path.len(), reference.len());
        anyhow::ensure!(
            found == known,
            "expected {known} points in time, found {found}"
        );
        let error = largest_distance(&path, reference) / moving.length;
        let (scene, none) = (moving.title, f64::NAN);
        csv.row(&[
            &scene, &none, kind, elements, &size, &error, &time, &most, &iteration,
        ]);
    }
    Ok(())
}
