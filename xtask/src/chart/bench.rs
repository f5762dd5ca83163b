//! Runs of the `flexbody` program: what to simulate, its outputs, what it took.

use std::cell::Cell;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, bail};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use crate::cargo::Workspace;
use crate::package::PACKAGE;
use crate::process::{prepared, shown, stdout};
use crate::table::Table;

use super::numbers::median;

/// How often a timed run is repeated.
pub const REPEATS: usize = 5;

/// The program and the folders it reads and writes.
pub struct Bench<'a> {
    workspace: &'a Workspace,
    program: PathBuf,
    lab: PathBuf,
    scratch: PathBuf,
    files: Cell<u64>,
}

/// One simulation.
#[derive(Clone)]
pub struct Run {
    scene: Value,
    settings: Vec<(String, f64)>,
    stop_time: f64,
    step: f64,
    /// Options of `lab integrate`, where that takes the steps.
    lab: Option<Vec<String>>,
}

impl Run {
    /// A simulation of a scene up to a time with a communication step, both in seconds.
    pub fn new(scene: &Value, stop_time: f64, step: f64) -> Self {
        Self {
            scene: scene.clone(),
            settings: Vec::new(),
            stop_time,
            step,
            lab: None,
        }
    }

    /// The initial configuration of a scene: only the first row of the outputs is of interest.
    pub fn initial(scene: &Value) -> Self {
        Self::new(scene, 1e-9, 1e-9)
    }

    /// Time at which it ends, s.
    pub fn stop_time(&self) -> f64 {
        self.stop_time
    }

    /// With a start value.
    pub fn set(mut self, name: &str, value: f64) -> Self {
        self.settings.push((name.to_owned(), value));
        self
    }

    /// With a number of elements.
    pub fn elements(self, count: u32) -> Self {
        self.set("rod.elements", f64::from(count))
    }

    /// With a relative tolerance.
    pub fn tolerance(self, tolerance: f64) -> Self {
        self.set("relative_tolerance", tolerance)
    }

    /// With an integrator by name.
    pub fn integrator(self, name: &str) -> Self {
        self.method(json!({ "integrator": name }))
    }

    /// By the lab, with these options.
    pub fn by_lab(mut self, options: &[&str]) -> Self {
        self.lab = Some(options.iter().map(|option| (*option).to_owned()).collect());
        self
    }

    /// With a method as scenes have it.
    pub fn method(mut self, method: Value) -> Self {
        self.scene["method"] = method;
        self
    }
}

/// What the steps of a run took.
#[derive(Clone)]
pub struct Cost {
    /// Integrator that ran.
    pub method: String,
    /// Accepted steps.
    pub steps: f64,
    /// Rejected steps.
    pub rejected: f64,
    /// Newton iterations.
    pub newton_iterations: f64,
    /// Calculated parameters: natural frequencies, rad/s.
    pub calculated: Vec<(String, f64)>,
    /// CPU time, s; the median where the run was repeated.
    pub cpu_time: f64,
    /// Outputs that the tolerance does not reach.
    pub doubtful: Vec<String>,
}

impl Cost {
    /// CPU time of an accepted step, s; rejected ones are paid for.
    pub fn per_step(&self) -> f64 {
        self.cpu_time / self.steps
    }

    /// CPU time of a Newton iteration, s.
    pub fn per_iteration(&self) -> f64 {
        self.cpu_time / self.newton_iterations
    }
}

/// What came out of a run.
pub struct Outcome {
    /// Outputs at the communication points; those before the failure if there was one.
    pub table: Option<Table>,
    /// Cost, or why the run failed.
    pub cost: Result<Cost, String>,
}

impl Outcome {
    /// The outputs of a run that must succeed.
    pub fn table(&self) -> Result<&Table> {
        self.cost()?;
        self.table.as_ref().context("the run wrote no outputs")
    }

    /// The cost of a run that must succeed.
    pub fn cost(&self) -> Result<&Cost> {
        match &self.cost {
            Ok(cost) => Ok(cost),
            Err(failure) => bail!("expected a run without failure, found: {failure}"),
        }
    }
}

impl<'a> Bench<'a> {
    /// Builds the programs.
    pub fn new(workspace: &'a Workspace) -> Result<Self> {
        Ok(Self {
            program: workspace.program(PACKAGE)?,
            lab: workspace.program("lab")?,
            scratch: workspace.target("chart"),
            files: Cell::new(0),
            workspace,
        })
    }

    /// The workspace.
    pub fn workspace(&self) -> &Workspace {
        self.workspace
    }

    /// Where a chart's file belongs.
    pub fn output(&self, name: &str) -> PathBuf {
        self.workspace.path("docs/charts").join(name)
    }

    /// A file of the cases, e.g. `elastica/case.json`.
    pub fn case_file(&self, name: &str) -> PathBuf {
        self.workspace.path("tests/cases").join(name)
    }

    /// A JSON file of the cases.
    pub fn case_json(&self, name: &str) -> Result<Value> {
        self.json(&self.case_file(name))
    }

    /// A ready scene.
    pub fn scene_json(&self, name: &str) -> Result<Value> {
        let file = self.workspace.path("scenes").join(name);
        self.json(&file.with_extension("json"))
    }

    fn json(&self, path: &std::path::Path) -> Result<Value> {
        let place = shown(path);
        let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {place}"))?;
        serde_json::from_str(&text).with_context(|| format!("{place} is no JSON"))
    }

    /// Writes a scene for a program and returns where it is.
    pub fn write(&self, name: &str, scene: &Value) -> Result<PathBuf> {
        let file = prepared(&self.scratch.join(name))?;
        std::fs::write(&file, scene.to_string())
            .with_context(|| format!("cannot write {}", shown(&file)))?;
        Ok(file)
    }

    /// Runs everything once.
    pub fn run(&self, title: &str, runs: &[Run]) -> Result<Vec<Outcome>> {
        self.repeat(title, runs, 1)
    }

    /// Runs everything often enough for timing. Repetitions go round all runs, so that whatever
    /// else the machine does meanwhile meets all of them; CPU times are medians.
    pub fn time(&self, title: &str, runs: &[Run]) -> Result<Vec<Outcome>> {
        self.repeat(title, runs, REPEATS)
    }

    fn repeat(&self, title: &str, runs: &[Run], times: usize) -> Result<Vec<Outcome>> {
        let bar = progress_bar(title, runs.len() * times);
        let mut outcomes: Vec<Outcome> = Vec::new();
        let mut cpu_times = vec![Vec::new(); runs.len()];
        for round in 0..times {
            for (index, run) in runs.iter().enumerate() {
                let outcome = self.execute(run)?;
                if let Ok(cost) = &outcome.cost {
                    cpu_times[index].push(cost.cpu_time);
                }
                if round == 0 {
                    outcomes.push(outcome);
                }
                bar.inc(1);
            }
        }
        for (outcome, times) in outcomes.iter_mut().zip(&cpu_times) {
            if let Ok(cost) = &mut outcome.cost {
                cost.cpu_time = median(times);
            }
        }
        bar.finish_and_clear();
        eprintln!("{title}: {} runs", runs.len() * times);
        Ok(outcomes)
    }

    /// Runs a measurement of the lab, its name followed by options, on a scene and returns its report.
    pub fn lab(&self, measurement: &[&str], scene: &Value) -> Result<Value> {
        let number = self.files.replace(self.files.get() + 1);
        let file = self.write(&format!("{number}.scene.json"), scene)?;
        let report = stdout(Command::new(&self.lab).args(measurement).arg(&file))?;
        std::fs::remove_file(&file).with_context(|| format!("cannot remove {}", shown(&file)))?;
        serde_json::from_str(&report).context("the report of the lab is no JSON")
    }

    /// Runs a measurement of the lab that has scenes of its own and returns its report.
    pub fn lab_alone(&self, measurement: &str) -> Result<Value> {
        let report = stdout(Command::new(&self.lab).arg(measurement))?;
        serde_json::from_str(&report).context("the report of the lab is no JSON")
    }

    fn execute(&self, run: &Run) -> Result<Outcome> {
        let number = self.files.replace(self.files.get() + 1);
        let file = |kind: &str| prepared(&self.scratch.join(format!("{number}.{kind}")));
        let scene = self.write(&format!("{number}.scene.json"), &run.scene)?;
        let (outputs, report) = (file("csv")?, file("report.json")?);
        let mut command = match &run.lab {
            None => Command::new(&self.program),
            Some(_) => Command::new(&self.lab),
        };
        let step = match &run.lab {
            None => command.arg("simulate").arg(&scene).arg("--step"),
            Some(options) => {
                let command = command.arg("integrate").arg(&scene);
                command.args(options).arg("--every")
            }
        };
        step.arg(run.step.to_string());
        command.arg("--stop-time").arg(run.stop_time.to_string());
        command.arg("--output").arg(&outputs);
        command.arg("--report").arg(&report);
        for (name, value) in &run.settings {
            command.arg("--set").arg(format!("{name}={value}"));
        }
        let finished = command
            .output()
            .with_context(|| format!("cannot start {}", shown(&self.program)))?;
        let cost = match finished.status.success() {
            true => Ok(read_cost(&report)?),
            false => Err(String::from_utf8_lossy(&finished.stderr).trim().to_owned()),
        };
        let table = match cost {
            Ok(_) => Some(Table::read(&outputs)?),
            Err(_) if outputs.exists() => Some(Table::read(&outputs)?),
            Err(_) => None,
        };
        for path in [&scene, &outputs, &report] {
            // A run that failed has not written all of them.
            let _ = std::fs::remove_file(path);
        }
        Ok(Outcome { table, cost })
    }
}

fn read_cost(path: &std::path::Path) -> Result<Cost> {
    let place = shown(path);
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {place}"))?;
    let report: Value =
        serde_json::from_str(&text).with_context(|| format!("{place} is no JSON"))?;
    let number = |key: &str| {
        let value = report[key].as_f64();
        value.with_context(|| format!("{place}: expected a number {key}, found {}", report[key]))
    };
    let method = report["method"].as_str();
    let calculated = report["calculated"].as_object().into_iter().flatten();
    Ok(Cost {
        calculated: calculated
            .filter_map(|(name, value)| Some((name.clone(), value.as_f64()?)))
            .collect(),
        method: method
            .with_context(|| format!("{place}: expected a method"))?
            .to_owned(),
        steps: number("steps")?,
        rejected: number("rejected")?,
        newton_iterations: number("newton_iterations")?,
        cpu_time: number("cpu_time")?,
        doubtful: report["doubtful"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(|name| Some(name.as_str()?.to_owned()))
            .collect(),
    })
}

fn progress_bar(title: &str, runs: usize) -> ProgressBar {
    let template = "{msg} {bar:40} {pos}/{len} runs  {elapsed}";
    let style = ProgressStyle::with_template(template);
    ProgressBar::new(runs as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_message(title.to_owned())
}
