//! Runs of the `flexbody` program: what to simulate, its outputs, what it took.

use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use crate::cargo::Workspace;
use crate::package::PACKAGE;
use crate::process::{prepared, shown, stdout};
use crate::table::Table;

use super::numbers::{median, number};

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
    by: Program,
}

/// What takes the steps.
#[derive(Clone)]
enum Program {
    Product,
    /// `lab integrate` with options.
    Lab(Vec<String>),
    /// A program that understands the same, with options.
    Other(PathBuf, Vec<String>),
}

impl Run {
    /// A simulation of a scene up to a time with a communication step, both in seconds.
    pub fn new(scene: &Value, stop_time: f64, step: f64) -> Self {
        Self {
            scene: scene.clone(),
            settings: Vec::new(),
            stop_time,
            step,
            by: Program::Product,
        }
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
    pub fn integrator(mut self, name: &str) -> Self {
        self.scene["method"] = json!({ "integrator": name });
        self
    }

    /// By the lab, with these options.
    pub fn by_lab(mut self, options: Vec<String>) -> Self {
        self.by = Program::Lab(options);
        self
    }

    /// By a program that understands the same as the lab, with these options.
    pub fn by_other(mut self, program: &Path, options: Vec<String>) -> Self {
        self.by = Program::Other(program.to_owned(), options);
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

    /// A JSON file of the project.
    pub fn json(&self, name: &str) -> Result<Value> {
        let path = self.workspace.path(name);
        let place = shown(&path);
        let text =
            std::fs::read_to_string(&path).with_context(|| format!("cannot read {place}"))?;
        serde_json::from_str(&text).with_context(|| format!("{place} is no JSON"))
    }

    /// A JSON file of the cases, e.g. `elastica/case.json`.
    pub fn case(&self, name: &str) -> Result<Value> {
        self.json(&format!("tests/cases/{name}"))
    }

    /// A table of the cases.
    pub fn table(&self, name: &str) -> Result<Table> {
        Table::read(&self.workspace.path("tests/cases").join(name))
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
        self.repeat(title, runs, 1, 0.0)
    }

    /// Runs everything often enough for timing. Repetitions go round all runs, so that whatever
    /// else the machine does meanwhile meets all of them; CPU times are medians.
    pub fn time(&self, title: &str, runs: &[Run]) -> Result<Vec<Outcome>> {
        self.repeat(title, runs, REPEATS, f64::INFINITY)
    }

    /// The same so many times, but once where a run fails or takes longer than that, s.
    pub fn repeat(
        &self,
        title: &str,
        runs: &[Run],
        times: usize,
        long: f64,
    ) -> Result<Vec<Outcome>> {
        let bar = progress_bar(title, runs.len() * times);
        let mut outcomes: Vec<Outcome> = Vec::new();
        let mut cpu_times = vec![Vec::new(); runs.len()];
        for round in 0..times {
            for (index, run) in runs.iter().enumerate() {
                bar.inc(1);
                if round > 0 && cpu_times[index].first().is_none_or(|time| *time > long) {
                    continue;
                }
                let outcome = self.execute(run)?;
                if let Ok(cost) = &outcome.cost {
                    cpu_times[index].push(cost.cpu_time);
                }
                if round == 0 {
                    outcomes.push(outcome);
                }
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

    /// Runs a measurement of the lab, its name followed by options, on a scene if it has none of its own, and returns its report.
    pub fn lab(&self, measurement: &[&str], scene: Option<&Value>) -> Result<Value> {
        let file = scene.map(|scene| self.write("lab.scene.json", scene));
        let mut command = Command::new(&self.lab);
        command.args(measurement).args(file.transpose()?);
        serde_json::from_str(&stdout(&mut command)?).context("the report of the lab is no JSON")
    }

    fn execute(&self, run: &Run) -> Result<Outcome> {
        let number = self.files.replace(self.files.get() + 1);
        let file = |kind: &str| prepared(&self.scratch.join(format!("{number}.{kind}")));
        let scene = self.write(&format!("{number}.scene.json"), &run.scene)?;
        let (outputs, report) = (file("csv")?, file("report.json")?);
        let (program, options) = match &run.by {
            Program::Product => (&self.program, vec!["simulate".to_owned()]),
            Program::Lab(options) => (
                &self.lab,
                [vec!["integrate".into()], options.clone()].concat(),
            ),
            Program::Other(program, options) => (program, options.clone()),
        };
        let mut command = Command::new(program);
        command.args(options).arg(&scene);
        command.arg(match run.by {
            Program::Product => "--step",
            _ => "--every",
        });
        command.arg(run.step.to_string());
        command.arg("--stop-time").arg(run.stop_time.to_string());
        command.arg("--output").arg(&outputs);
        command.arg("--report").arg(&report);
        for (name, value) in &run.settings {
            command.arg("--set").arg(format!("{name}={value}"));
        }
        let finished = command
            .output()
            .with_context(|| format!("cannot start {}", shown(program)))?;
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

fn read_cost(path: &Path) -> Result<Cost> {
    let place = shown(path);
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {place}"))?;
    let report: Value =
        serde_json::from_str(&text).with_context(|| format!("{place} is no JSON"))?;
    let calculated = report["calculated"].as_object().into_iter().flatten();
    let doubtful = report["doubtful"].as_array().into_iter().flatten();
    Ok(Cost {
        calculated: calculated
            .filter_map(|(name, value)| Some((name.clone(), value.as_f64()?)))
            .collect(),
        method: crate::chart::numbers::text(&report["method"])?.to_owned(),
        steps: number(&report["steps"])?,
        rejected: number(&report["rejected"])?,
        newton_iterations: number(&report["newton_iterations"])?,
        cpu_time: number(&report["cpu_time"])?,
        doubtful: doubtful
            .filter_map(|name| Some(name.as_str()?.to_owned()))
            .collect(),
    })
}

/// A bar that counts runs.
pub fn progress_bar(title: &str, runs: usize) -> ProgressBar {
    let template = "{msg} {bar:40} {pos}/{len} runs  {elapsed}";
    let style = ProgressStyle::with_template(template);
    ProgressBar::new(runs as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_message(title.to_owned())
}
