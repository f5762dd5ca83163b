//! Integrators: error in time alone against CPU time, those of the product and those of the lab.

use std::path::PathBuf;

use anyhow::{Context, Result};
use serde_json::Value;

use super::bench::{Bench, Outcome, Run};
use super::csv::{Csv, digits};
use super::numbers::{distance, largest, number, text};

/// Scenes, references, and steps and tolerances of all points.
const SETTINGS: &str = "lab/methods.json";
/// Rounds of timed runs; runs that take longer than `LONG` s run once.
const ROUNDS: usize = 3;
const LONG: f64 = 0.4;

/// A run: a method with a step, a tolerance, or both.
struct Plan<'a> {
    method: &'a str,
    step: Option<f64>,
    tolerance: Option<f64>,
}

impl Plan<'_> {
    /// Step and tolerance.
    fn cells(&self) -> [String; 2] {
        [self.step, self.tolerance]
            .map(|value| value.map_or(String::new(), |value| format!("{value:e}")))
    }
}

/// Measures.
pub fn measure(bench: &Bench) -> Result<()> {
    let settings = bench.json(SETTINGS)?;
    let with_diffsol = settings.to_string().contains("\"diffsol\"");
    let diffsol = || {
        let workspace = bench.workspace();
        workspace.program_apart("lab/diffsol", "lab-diffsol")
    };
    let diffsol = with_diffsol.then(diffsol).transpose()?;
    let header = "scene,method,step_s,tolerance,error,cpu_time_s,left_out";
    let mut csv = Csv::new(bench, "methods", header);
    let header = "scene,stop_time_s,every_s,reference,reference_step_s,reference_tolerance,other,other_step_s,\
                  other_tolerance,apart";
    let mut scenes = Csv::new(bench, "methods_scenes", header);
    for setting in settings.as_array().into_iter().flatten() {
        let place = || format!("{SETTINGS}: {}", setting["name"]);
        scene(bench, setting, &diffsol, &mut csv, &mut scenes).with_context(place)?;
    }
    csv.save()?;
    scenes.save()
}

/// Measures on one scene.
fn scene(
    bench: &Bench,
    setting: &Value,
    diffsol: &Option<PathBuf>,
    csv: &mut Csv,
    scenes: &mut Csv,
) -> Result<()> {
    let (name, scene) = (text(&setting["name"])?, changed(bench, setting)?);
    let runs = |plans: &[Plan]| -> Result<Vec<Run>> {
        plans
            .iter()
            .map(|plan| run(setting, &scene, plan, diffsol))
            .collect()
    };
    let references = plans(&setting["references"]);
    let title = format!("methods, {name}");
    let known = bench.run(&format!("{title}, references"), &runs(&references)?)?;
    let paths: Result<Vec<_>> = known
        .iter()
        .map(|outcome| places(&scene, outcome))
        .collect();
    let [reference, other] = &paths?[..] else {
        anyhow::bail!("expected two references, found {}", references.len());
    };
    let length = number(&setting["length"])?;
    let error = |path: &[[f64; 2]]| {
        largest(
            path.iter()
                .zip(reference)
                .map(|(a, b)| distance(*a, *b) / length),
        )
    };
    let number = |key: &str| number(&setting[key]);
    let [[step, tolerance], [other_step, other_tolerance]] =
        [references[0].cells(), references[1].cells()];
    let (stop, every, apart) = (number("stop_time")?, number("every")?, digits(error(other)));
    scenes.row(&[
        &name,
        &stop,
        &every,
        &references[0].method,
        &step,
        &tolerance,
        &references[1].method,
        &other_step,
        &other_tolerance,
        &apart,
    ]);
    let plans = plans(&setting["points"]);
    let outcomes = bench.repeat(&title, &runs(&plans)?, ROUNDS, LONG)?;
    let mut points = Vec::new();
    for (plan, outcome) in plans.iter().zip(outcomes) {
        let path = outcome.cost().and_then(|_| places(&scene, &outcome));
        let found = path
            .map(|path| error(&path))
            .ok()
            .filter(|error| *error > 0.0 && error.is_finite());
        points.push((
            plan,
            found,
            outcome.cost.map_or(f64::NAN, |cost| cost.cpu_time),
        ));
    }
    // Errors of a method fall from row to row.
    points.sort_by(|a, b| {
        (a.0.method, b.1.unwrap_or(0.0))
            .partial_cmp(&(b.0.method, a.1.unwrap_or(0.0)))
            .expect("no NaN")
    });
    for (plan, error, time) in points {
        let [step, tolerance] = plan.cells();
        let time = error.map_or(String::new(), |_| digits(time));
        csv.row(&[
            &name,
            &plan.method,
            &step,
            &tolerance,
            &digits(error),
            &time,
            &"",
        ]);
    }
    for (method, reason) in setting["left_out"].as_object().into_iter().flatten() {
        csv.row(&[&name, method, &"", &"", &"", &"", &text(reason)?]);
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

fn run(setting: &Value, scene: &Value, plan: &Plan, diffsol: &Option<PathBuf>) -> Result<Run> {
    let run = Run::new(
        scene,
        number(&setting["stop_time"])?,
        number(&setting["every"])?,
    );
    if let Some(method) = plan.method.strip_prefix("product_") {
        let run = run.integrator(method);
        return Ok(match plan.tolerance {
            Some(tolerance) => run.tolerance(tolerance),
            None => run,
        });
    }
    let mut options = Vec::new();
    for (name, value) in [("--step", plan.step), ("--tolerance", plan.tolerance)] {
        options.extend(
            value
                .iter()
                .flat_map(|value| [name.to_owned(), value.to_string()]),
        );
    }
    if plan.method == "diffsol" {
        let program = diffsol.as_ref().context("diffsol was not built")?;
        return Ok(run.by_other(program, options));
    }
    let method = plan.method.trim_end_matches("_adaptive").to_owned();
    options.extend(["--method".to_owned(), method]);
    Ok(run.by_lab(options))
}

/// Places of every marker that the scene reads, one after the other.
fn places(scene: &Value, outcome: &Outcome) -> Result<Vec<[f64; 2]>> {
    let table = outcome.table()?;
    let mut places = Vec::new();
    for output in scene["outputs"].as_array().into_iter().flatten() {
        let marker = text(&output["marker"])?;
        places.extend(table.points(
            &format!("{marker}.position[1]"),
            &format!("{marker}.position[2]"),
        )?);
    }
    Ok(places)
}
