//! Exudyn and the product: error against CPU time, each with its best settings.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, Run};
use super::numbers::{largest_distance, median};
use crate::process::shown;
use crate::table::Table;

mod cases;
mod report;

use super::exudyn::Exudyn;
use cases::{CASES, Case};

const SETTINGS: &str = "lab/exudyn/settings.json";
/// Rounds of timed runs.
const ROUNDS: usize = 3;

/// What both programs need to know of a scene.
struct Setting {
    scene: Value,
    path: String,
    marker: String,
    /// m.
    length: f64,
    /// s.
    stop_time: f64,
    /// Time between compared points, s.
    every: f64,
    reference: Vec<[f64; 2]>,
    /// What made the reference.
    source: String,
    /// Options of all runs of Exudyn, and of each.
    common: Value,
    points: Vec<Value>,
    /// Runs from which these points were chosen.
    sweep_runs: u64,
}

/// A measured point.
#[derive(Clone)]
struct Point {
    what: String,
    elements: u32,
    /// Of Exudyn: with pins held by heavy nodes.
    is_helped: bool,
    error: f64,
    cpu_time: f64,
}

/// All that was measured on a scene.
struct Measured {
    case: &'static Case,
    setting: Setting,
    exudyn: Vec<Point>,
    product: Vec<Point>,
    /// Distance of the product's finest run from the reference, divided by the length.
    uncertainty: f64,
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let text = std::fs::read_to_string(bench.workspace().path(SETTINGS))?;
    let settings: Value = serde_json::from_str(&text).context("settings of Exudyn")?;
    let mut exudyn = Exudyn::start(bench.workspace())?;
    let mut measured = Vec::new();
    for case in &CASES {
        let setting = Setting::read(bench, &settings[case.name])
            .with_context(|| format!("{SETTINGS}, {}", case.name))?;
        measured.push(measure(bench, &mut exudyn, case, setting)?);
    }
    report::write(bench, &measured)?;
    Ok(report::section(&measured))
}

impl Setting {
    fn read(bench: &Bench, value: &Value) -> Result<Self> {
        let number = |key: &str| value[key].as_f64().context(format!("expected {key}"));
        let text = |key: &str| value[key].as_str().context(format!("expected {key}"));
        let path = bench.workspace().path(text("scene")?);
        let scene = std::fs::read_to_string(&path)
            .with_context(|| format!("cannot read {}", shown(&path)))?;
        let (stop_time, every) = (number("stop_time")?, number("every")?);
        let mut common = json!({ "scene": path, "marker": text("marker")?, "stop_time": stop_time, "every": every });
        for (key, option) in value["options"].as_object().into_iter().flatten() {
            common[key] = option.clone();
        }
        if let Some(shares) = value.get("shares") {
            common["shares"] = shares.clone();
        }
        let reference = Table::read(&bench.workspace().path(text("reference")?))?;
        Ok(Self {
            scene: serde_json::from_str(&scene)?,
            path: text("scene")?.to_owned(),
            marker: text("marker")?.to_owned(),
            length: number("length")?,
            stop_time,
            every,
            reference: at_points(&reference, every)?,
            source: text("source")?.to_owned(),
            common,
            sweep_runs: value["runs"].as_u64().unwrap_or(0),
            points: value["points"]
                .as_array()
                .context("expected points")?
                .clone(),
        })
    }

    /// Largest distance of a path from the reference, divided by the length.
    fn error(&self, path: &[[f64; 2]]) -> f64 {
        largest_distance(path, &self.reference) / self.length
    }

    fn run(&self, case: &Case, elements: u32, tolerance: f64) -> Run {
        let mut run = Run::new(&self.scene, self.stop_time, self.every).tolerance(tolerance);
        for (name, value) in case.set {
            run = run.set(name, *value);
        }
        for (name, multiple) in case.elements {
            run = run.set(name, f64::from(elements * multiple));
        }
        // What `auto` picks is what a user gets.
        run.integrator("auto")
    }

    fn marker_path(&self, table: &Table) -> Result<Vec<[f64; 2]>> {
        let x = table.column(&format!("{}.position[1]", self.marker))?;
        let y = table.column(&format!("{}.position[2]", self.marker))?;
        Ok(x.into_iter().zip(y).map(|(x, y)| [x, y]).collect())
    }
}

/// The places of a reference at multiples of a time.
fn at_points(table: &Table, every: f64) -> Result<Vec<[f64; 2]>> {
    let times = table.column("t")?;
    let places = table
        .column("x_tip")?
        .into_iter()
        .zip(table.column("y_tip")?);
    let rows = times.into_iter().zip(places);
    let on_grid = |t: f64| ((t / every).round() * every - t).abs() < 1e-9;
    Ok(rows
        .filter(|row| on_grid(row.0))
        .map(|(_, (x, y))| [x, y])
        .collect())
}

fn measure(
    bench: &Bench,
    exudyn: &mut Exudyn,
    case: &'static Case,
    setting: Setting,
) -> Result<Measured> {
    let title = format!("peers, {}", case.title);
    let finest = setting.run(case, case.finest.0, case.finest.1);
    let finest = bench.run(&format!("{title}, finest"), &[finest])?;
    let uncertainty = setting.error(&setting.marker_path(finest[0].table()?)?);
    let plan: Vec<(u32, f64)> = case
        .meshes
        .iter()
        .flat_map(|mesh| case.tolerances.iter().map(|tolerance| (*mesh, *tolerance)))
        .collect();
    let runs: Vec<Run> = plan
        .iter()
        .map(|(n, t)| setting.run(case, *n, *t))
        .collect();
    let mut found: BTreeMap<(bool, usize), (f64, Vec<f64>)> = BTreeMap::new();
    for round in 0..ROUNDS {
        for (index, options) in setting.points.iter().enumerate() {
            let mut all = setting.common.clone();
            for (key, option) in options.as_object().into_iter().flatten() {
                all[key] = option.clone();
            }
            let answer = exudyn.run(&all)?;
            let path: Vec<[f64; 2]> = answer.path.iter().map(|row| [row[1], row[2]]).collect();
            let entry = found.entry((true, index)).or_default();
            *entry = (setting.error(&path), std::mem::take(&mut entry.1));
            entry.1.push(answer.cpu_time);
        }
        let round = format!("{title}, round {} of {ROUNDS}", round + 1);
        for (index, outcome) in bench.run(&round, &runs)?.iter().enumerate() {
            // A mesh too coarse for its scene may fail: no point then.
            let Ok(table) = outcome.table() else { continue };
            let entry = found.entry((false, index)).or_default();
            entry.0 = setting.error(&setting.marker_path(table)?);
            entry.1.push(outcome.cost()?.cpu_time);
        }
    }
    let mut points = [Vec::new(), Vec::new()];
    for ((is_peer, index), (error, times)) in found {
        let (what, elements, is_helped) = if is_peer {
            let options = &setting.points[index];
            let elements = options["elements"].as_u64().unwrap_or(0) as u32;
            let is_helped = options.get("heavy").is_some();
            (report::described(options), elements, is_helped)
        } else {
            let (elements, tolerance) = plan[index];
            (format!("tolerance {tolerance:e}"), elements, false)
        };
        points[usize::from(is_peer)].push(Point {
            what,
            elements,
            is_helped,
            error,
            cpu_time: median(&times),
        });
    }
    let [product, exudyn] = points;
    Ok(Measured {
        case,
        setting,
        exudyn,
        product,
        uncertainty,
    })
}
