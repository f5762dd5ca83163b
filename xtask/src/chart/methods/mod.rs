//! Integrators: error in time alone against CPU time, those of the product and those of the lab.

use std::path::PathBuf;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::Bench;
use super::numbers::{distance, needed_for};
use crate::process::shown;

mod programs;
mod report;

use programs::{Outcome, Programs};

/// Scenes, references, and steps and tolerances of all points.
const SETTINGS: &str = "lab/methods.json";
/// Rounds of timed runs; runs that take longer than `LONG` s run once.
const ROUNDS: usize = 3;
const LONG: f64 = 0.4;
/// Errors of the table.
const ERRORS: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// A scene as both programs take it, and what is compared on it.
struct Setting {
    name: String,
    title: String,
    scene: Value,
    /// m.
    length: f64,
    /// s.
    stop_time: f64,
    /// Time between compared points, s.
    every: f64,
    /// Two runs: the first is the reference.
    references: Vec<Plan>,
    plans: Vec<Plan>,
    /// Methods that do not run here, with the reason.
    left_out: Vec<(String, String)>,
}

/// A run: a method with a step, a tolerance, or both.
#[derive(Clone)]
struct Plan {
    method: String,
    step: Option<f64>,
    tolerance: Option<f64>,
}

/// A measured run.
struct Point {
    plan: Plan,
    error: f64,
    outcome: Outcome,
}

/// All that was measured on a scene.
struct Measured {
    setting: Setting,
    points: Vec<Point>,
    /// Runs without a result.
    failed: Vec<Plan>,
    /// Distance of the references from each other, divided by the length.
    uncertainty: f64,
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let settings = read(bench, SETTINGS)?;
    let with_diffsol = settings.to_string().contains("\"diffsol\"");
    let programs = Programs::new(bench.workspace(), with_diffsol)?;
    let mut measured = Vec::new();
    for value in settings.as_array().into_iter().flatten() {
        let setting =
            Setting::read(bench, value).with_context(|| format!("{SETTINGS}: {value}"))?;
        measured.push(measure(&programs, setting)?);
    }
    report::write(bench, &measured)?;
    Ok(report::section(&measured))
}

fn read(bench: &Bench, path: &str) -> Result<Value> {
    let path: PathBuf = bench.workspace().path(path);
    let text = std::fs::read_to_string(&path);
    let text = text.with_context(|| format!("cannot read {}", shown(&path)))?;
    serde_json::from_str(&text).with_context(|| format!("{} is no JSON", shown(&path)))
}

impl Setting {
    fn read(bench: &Bench, value: &Value) -> Result<Self> {
        let number = |key: &str| {
            value[key]
                .as_f64()
                .with_context(|| format!("expected {key}"))
        };
        let text = |key: &str| {
            value[key]
                .as_str()
                .with_context(|| format!("expected {key}"))
        };
        let mut scene = read(bench, text("scene")?)?;
        for body in scene["bodies"].as_array_mut().into_iter().flatten() {
            for (place, number) in value["set"].as_object().into_iter().flatten() {
                if let Some(found) = body.pointer_mut(place) {
                    *found = number.clone();
                }
            }
        }
        let outputs = scene["outputs"]
            .as_array_mut()
            .context("expected outputs")?;
        outputs.retain(|output| output["kind"] == "position");
        let plans = |key: &str| -> Vec<Plan> {
            let methods = value[key].as_object().into_iter().flatten();
            let runs = methods.flat_map(|(method, runs)| {
                let runs = runs.as_array().into_iter().flatten();
                runs.map(move |run| Plan {
                    method: method.clone(),
                    step: run["step"].as_f64(),
                    tolerance: run["tolerance"].as_f64(),
                })
            });
            runs.collect()
        };
        let left_out = value["left_out"].as_object().into_iter().flatten();
        Ok(Self {
            name: text("name")?.to_owned(),
            title: text("title")?.to_owned(),
            scene,
            length: number("length")?,
            stop_time: number("stop_time")?,
            every: number("every")?,
            references: plans("references"),
            plans: plans("points"),
            left_out: left_out
                .map(|(method, reason)| (method.clone(), reason.as_str().unwrap_or("").to_owned()))
                .collect(),
        })
    }

    /// The scene with a method of the product.
    fn with_method(&self, method: &str) -> Value {
        let mut scene = self.scene.clone();
        scene["method"] = json!({ "integrator": method });
        scene
    }

    /// Largest distance of any marker, divided by the length.
    fn error(&self, a: &[Vec<[f64; 2]>], b: &[Vec<[f64; 2]>]) -> f64 {
        let rows = a.iter().flatten().zip(b.iter().flatten());
        let distances = rows.map(|(a, b)| distance(*a, *b) / self.length);
        // Not f64::max, which would hide a NaN.
        distances.fold(0.0, |most, d| if d <= most { most } else { d })
    }
}

fn measure(programs: &Programs, setting: Setting) -> Result<Measured> {
    let title = format!("methods, {}", setting.name);
    let references = programs.run(
        &format!("{title}, references"),
        &setting,
        &setting.references,
        1,
    )?;
    let [first, second] = &references[..] else {
        anyhow::bail!("expected two references, found {}", references.len());
    };
    let (reference, other) = (first.path()?, second.path()?);
    let uncertainty = setting.error(reference, other);
    let outcomes = programs.run(&title, &setting, &setting.plans, ROUNDS)?;
    let (mut points, mut failed) = (Vec::new(), Vec::new());
    for (plan, outcome) in setting.plans.iter().zip(outcomes) {
        let error = outcome.path().map(|path| setting.error(path, reference));
        match error {
            Ok(error) if error > 0.0 && error.is_finite() => points.push(Point {
                plan: plan.clone(),
                error,
                outcome,
            }),
            _ => failed.push(plan.clone()),
        }
    }
    Ok(Measured {
        setting,
        points,
        failed,
        uncertainty,
    })
}

impl Measured {
    /// Methods in the order of the settings.
    fn methods(&self) -> Vec<&str> {
        let mut methods: Vec<&str> = Vec::new();
        for point in &self.points {
            if !methods.contains(&point.plan.method.as_str()) {
                methods.push(&point.plan.method);
            }
        }
        methods
    }

    /// CPU times and errors of a method, errors falling.
    fn of(&self, method: &str) -> Vec<(f64, f64)> {
        let points = self.points.iter().filter(|p| p.plan.method == method);
        let mut pairs: Vec<(f64, f64)> = points.map(|p| (p.outcome.cpu_time(), p.error)).collect();
        pairs.sort_by(|a, b| b.1.total_cmp(&a.1));
        pairs
    }

    /// CPU time that a method needs for an error, s.
    fn needed(&self, method: &str, error: f64) -> Option<f64> {
        needed_for(&self.of(method), error)
    }

    /// The least over all methods, and which.
    fn best(&self, error: f64) -> Option<(&str, f64)> {
        let all = self.methods().into_iter();
        let needed = all.filter_map(|method| Some((method, self.needed(method, error)?)));
        needed.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}
