//! Integrators: error in time alone against CPU time, those of the product and those of the studies.

use std::path::Path;

use anyhow::{Context, Result, bail};
use serde_json::Value;

use super::bench::{Bench, Ran, Run};
use super::csv::Csv;
use super::numbers::{largest_distance, number, text};

/// Scenes, references, and steps and tolerances of all points.
const SETTINGS: &str = "crates/studies/methods.json";
/// Rounds of timed runs; runs that take longer than `LONG` s run once.
const ROUNDS: usize = 3;
const LONG: f64 = 0.4;

/// A run: a method with a step, a tolerance, or both.
#[derive(Clone, Copy)]
struct Plan<'a> {
    method: &'a str,
    step: Option<f64>,
    tolerance: Option<f64>,
}

impl Plan<'_> {
    fn numbers(&self) -> [f64; 2] {
        [self.step, self.tolerance].map(|value| value.unwrap_or(f64::NAN))
    }
}

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let settings = bench.json(SETTINGS)?;
    let with_diffsol = settings.to_string().contains("\"diffsol\"");
    let workspace = bench.workspace();
    let diffsol = || workspace.program_apart("crates/studies/diffsol", "studies-diffsol");
    let diffsol = with_diffsol.then(diffsol).transpose()?;
    let header = "scene,method,step_s,tolerance,error,cpu_time_s,left_out";
    let mut csv = Csv::new(bench, "methods", header);
    let header = "scene,stop_time_s,every_s,reference,reference_step_s,reference_tolerance,other,other_step_s,\
                  other_tolerance,apart";
    let mut scenes = Csv::new(bench, "methods_scenes", header);
    for setting in settings.as_array().into_iter().flatten() {
        let place = || format!("{SETTINGS}: {}", setting["name"]);
        scene(bench, setting, diffsol.as_deref(), &mut csv, &mut scenes).with_context(place)?;
    }
    csv.save()?;
    scenes.save()
}

/// Measures on one scene.
fn scene(
    bench: &Bench,
    setting: &Value,
    diffsol: Option<&Path>,
    csv: &mut Csv,
    scenes: &mut Csv,
) -> Result<()> {
    let (name, scene) = (text(&setting["name"])?, changed(bench, setting)?);
    let [stop, every, length] = ["stop_time", "every", "length"].map(|key| number(&setting[key]));
    let (stop, every, length) = (stop?, every?, length?);
    let run = |plan: &Plan| run(Run::new(&scene, stop, every), plan, diffsol);
    let title = format!("methods, {name}");
    let [first, second] = plans(&setting["references"])[..] else {
        bail!("expected two references");
    };
    let known = bench.run(
        &format!("{title}, references"),
        &[run(&first), run(&second)],
    )?;
    let known: Result<Vec<_>> = known.into_iter().map(|ran| places(&scene, &ran?)).collect();
    let known = known?;
    let error = |path: &[[f64; 2]]| largest_distance(path, &known[0]) / length;
    let (a, b, apart) = (first.numbers(), second.numbers(), error(&known[1]));
    let (one, other) = (first.method, second.method);
    scenes.row(&[
        &name, &stop, &every, &one, &a[0], &a[1], &other, &b[0], &b[1], &apart,
    ]);
    let plans = plans(&setting["points"]);
    let runs: Vec<Run> = plans.iter().map(run).collect();
    let mut points = Vec::new();
    for (plan, outcome) in plans.iter().zip(bench.repeat(&title, &runs, ROUNDS, LONG)?) {
        let found = outcome.and_then(|ran| Ok((error(&places(&scene, &ran)?), ran.cpu_time)));
        let good = |(error, _): &(f64, f64)| *error > 0.0 && error.is_finite();
        let (error, time) = found.ok().filter(good).unwrap_or((f64::NAN, f64::NAN));
        points.push((plan.method, plan.numbers(), error, time));
    }
    // Errors of a method fall from row to row.
    points.sort_by(|a, b| a.0.cmp(b.0).then(b.2.total_cmp(&a.2)));
    for (method, [step, tolerance], error, time) in &points {
        csv.row(&[&name, method, step, tolerance, error, time, &""]);
    }
    for (method, reason) in setting["left_out"].as_object().into_iter().flatten() {
        let (reason, none) = (text(reason)?, f64::NAN);
        csv.row(&[&name, method, &none, &none, &none, &none, &reason]);
    }
    Ok(())
}

/// The scene with what the settings set, and outputs of places alone.
fn changed(bench: &Bench, setting: &Value) -> Result<Value> {
    let mut scene = bench.json(text(&setting["scene"])?)?;
    for body in scene["bodies"].as_array_mut().into_iter().flatten() {
        for (place, number) in setting["set"].as_object().into_iter().flatten() {
            if let Some(found) = body.pointer_mut(place) {
                *found = number.clone();
            }
        }
    }
    let outputs = scene["outputs"].as_array_mut();
    outputs
        .context("expected outputs")?
        .retain(|output| output["kind"] == "position");
    Ok(scene)
}

fn plans(settings: &Value) -> Vec<Plan<'_>> {
    let methods = settings.as_object().into_iter().flatten();
    let runs = methods.flat_map(|(method, runs)| {
        let runs = runs.as_array().into_iter().flatten();
        runs.map(move |run| Plan {
            method,
            step: run["step"].as_f64(),
            tolerance: run["tolerance"].as_f64(),
        })
    });
    runs.collect()
}

fn run(run: Run, plan: &Plan, diffsol: Option<&Path>) -> Run {
    if let Some(method) = plan.method.strip_prefix("product_") {
        let run = run.integrator(method);
        return match plan.tolerance {
            Some(tolerance) => run.tolerance(tolerance),
            None => run,
        };
    }
    let mut options = Vec::new();
    for (name, value) in [("--step", plan.step), ("--tolerance", plan.tolerance)] {
        options.extend(value.map(|value| (name, value.to_string())));
    }
    if plan.method == "diffsol" {
        return run.by_lab(&options, diffsol);
    }
    let method = plan.method.trim_end_matches("_adaptive").to_owned();
    options.push(("--method", method));
    run.by_lab(&options, None)
}

/// Places of every marker that the scene reads, one after the other.
fn places(scene: &Value, ran: &Ran) -> Result<Vec<[f64; 2]>> {
    let mut places = Vec::new();
    for output in scene["outputs"].as_array().into_iter().flatten() {
        let marker = text(&output["marker"])?;
        places.extend(ran.table.marker(marker)?);
    }
    Ok(places)
}
