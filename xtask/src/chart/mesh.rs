//! Error against the number of elements, for cases with an exact or independent reference.

use anyhow::{Context, Result};
use serde_json::Value;

use crate::table::Table;

use super::bench::{Bench, Ran, Run};
use super::csv::Csv;
use super::numbers::{distance, largest};

const MESHES: [u32; 7] = [2, 4, 8, 16, 32, 64, 128];
const PENDULUM_MESHES: [u32; 6] = [5, 10, 20, 40, 80, 160];
/// Scenes of one soft pendulum in the three strain measures.
const PENDULUMS: [(&str, &str); 3] = [
    ("thetaPrime", "soft_pendulum"),
    ("GreenLagrange_FrenetKappa", "soft_pendulum_green"),
    ("engStrain_FrenetKappa", "soft_pendulum_frenet"),
];
/// Names, cases and the claim of the case that a line is about.
type Exact = (&'static str, &'static str, fn(&Value) -> bool);
const EXACT: [Exact; 4] = [
    ("end moment, full circle", "pure_moment", |claim| {
        claim["note"] == "1 of a circle"
    }),
    ("heavy elastica, β = 5", "heavy_elastica", |claim| {
        claim["set"]["gravity[2]"] == -5.0
    }),
    ("catenary, EA = 10", "catenary", |_| true),
    ("third frequency, cantilever", "frequencies", |_| true),
];
/// Errors below this are roundoff and tell no order.
const ROUNDOFF: f64 = 1e-11;
/// Two times nearer than this are the same communication point, s.
const SAME_TIME: f64 = 1e-9;

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let mut csv = Csv::new(bench, "mesh", "kind,case,elements,error,order");
    for claim in claims(bench, "elastica")? {
        let note = claim["note"].as_str().unwrap_or_default();
        if let Some(ratio) = note.strip_prefix("EA L^2/EI = ") {
            let name = format!("elastica, EA L²/EI = {:e}", ratio.parse::<f64>()?);
            let errors = still(bench, &name, "elastica", &claim)?;
            add(&mut csv, "still", &name, &MESHES, &errors);
        }
    }
    for (name, case, wanted) in EXACT {
        let claim = claims(bench, case)?.into_iter().find(wanted);
        let claim =
            claim.with_context(|| format!("{case}/case.json: expected the claim of {name:?}"))?;
        let errors = still(bench, name, case, &claim)?;
        add(&mut csv, "still", name, &MESHES, &errors);
    }
    for (name, case) in PENDULUMS {
        let scene = bench.case(&format!("{case}/scene.json"))?;
        let run = |mesh| Run::new(&scene, 1.1, 0.1).elements(mesh).tolerance(1e-7);
        let title = format!("soft pendulum, {name}");
        let outcomes = bench.run(&title, &PENDULUM_MESHES.map(run))?;
        let reference = bench.table(&format!("{case}/reference.csv"))?;
        let error = |outcome: Result<Ran>| Ok(Some(tip_error(&outcome?.table, &reference)?));
        let errors = outcomes
            .into_iter()
            .map(error)
            .collect::<Result<Vec<_>>>()?;
        add(&mut csv, "moving", name, &PENDULUM_MESHES, &errors);
    }
    csv.save()
}

/// Claims of values of a case.
fn claims(bench: &Bench, case: &str) -> Result<Vec<Value>> {
    let claims = bench.case(&format!("{case}/case.json"))?["claims"].take();
    let claims = claims.as_array().cloned();
    let mut claims =
        claims.with_context(|| format!("{case}/case.json: expected an array of claims"))?;
    claims.retain(|claim| claim["kind"] == "values");
    Ok(claims)
}

/// Errors of a claim of initial values by mesh, nothing where none was found.
fn still(bench: &Bench, name: &str, case: &str, claim: &Value) -> Result<Vec<Option<f64>>> {
    let scene = claim["scene"].as_str().unwrap_or("scene.json");
    let scene = bench.case(&format!("{case}/{scene}"))?;
    let (values, settings) = (numbers(&claim["values"]), numbers(&claim["set"]));
    // Only the first row of the outputs is of interest.
    let run = |mesh| {
        let run = Run::new(&scene, 1e-9, 1e-9).elements(mesh);
        let set = |run: Run, (name, value): &(String, f64)| run.set(name, *value);
        settings.iter().fold(run, set)
    };
    let outcomes = bench.run(name, &MESHES.map(run))?;
    let error = |outcome: &Result<Ran>| {
        let ran = outcome.as_ref().ok();
        ran.map(|ran| initial_error(ran, &values)).transpose()
    };
    outcomes.iter().map(error).collect()
}

fn numbers(object: &Value) -> Vec<(String, f64)> {
    let entries = object.as_object().into_iter().flatten();
    entries
        .filter_map(|(name, value)| Some((name.clone(), value.as_f64()?)))
        .collect()
}

/// Distance where positions are claimed, else relative error of the last value.
fn initial_error(ran: &Ran, values: &[(String, f64)]) -> Result<f64> {
    let mut squares = Vec::new();
    for (name, value) in values.iter().filter(|(name, _)| name.contains("position")) {
        squares.push((ran.table.column(name)?[0] - value).powi(2));
    }
    if !squares.is_empty() {
        return Ok(squares.iter().sum::<f64>().sqrt());
    }
    let (name, value) = values.last().context("expected a claim with values")?;
    let found = ran.report["calculated"][name].as_f64();
    let found = found.with_context(|| format!("expected {name} in the report of the run"))?;
    Ok((found / value - 1.0).abs())
}

/// Largest distance of the tip from the reference over the points in time they share.
fn tip_error(table: &Table, reference: &Table) -> Result<f64> {
    let tips = table.marker("rod.tip")?;
    let (times, known) = (table.column("time")?, reference.column("t")?);
    let known_tips = reference.points("x_tip", "y_tip")?;
    let apart = |(time, tip): (f64, [f64; 2])| {
        let at = known.iter().position(|t| (t - time).abs() < SAME_TIME);
        let at = at.with_context(|| format!("expected the reference at {time} s"))?;
        Ok(distance(tip, known_tips[at]))
    };
    let all = times.into_iter().zip(tips).map(apart);
    Ok(largest(all.collect::<Result<Vec<_>>>()?))
}

/// Adds a line, with the order observed between a mesh and the one before.
fn add(csv: &mut Csv, kind: &str, name: &str, meshes: &[u32], errors: &[Option<f64>]) {
    for (index, (mesh, error)) in meshes.iter().zip(errors).enumerate() {
        let before = index.checked_sub(1).and_then(|before| errors[before]);
        let resolved = before.zip(*error).filter(|(a, b)| a.min(*b) > ROUNDOFF);
        let order = resolved.map(|(a, b)| {
            let finer = f64::from(*mesh) / f64::from(meshes[index - 1]);
            (a / b).ln() / finer.ln()
        });
        let [error, order] = [*error, order].map(|value| value.unwrap_or(f64::NAN));
        csv.row(&[&kind, &name, mesh, &error, &order]);
    }
}
