//! Runs of the `flexbody` program and of the studies: what to simulate, its outputs, what it took.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use anyhow::{Context, Result, bail};
use fmu_package::{bar, prepared, shown};
use indicatif::ProgressBar;
use serde_json::{Value, json};

use crate::cargo::Workspace;
use crate::package::PACKAGE;
use crate::process::{output_within, run_quietly, stdout};
use crate::table::Table;

use super::numbers::median;

/// How often a timed run is repeated.
pub const REPEATS: usize = 5;

/// The programs and the folders that they read and write.
pub struct Bench<'a> {
    workspace: &'a Workspace,
    program: PathBuf,
    /// Built where a chart asks for it: it takes as long as the product.
    studies: OnceCell<PathBuf>,
}

/// One simulation.
#[derive(Clone)]
pub struct Run {
    scene: Value,
    every: f64,
    options: Vec<String>,
    by: By,
    most: Duration,
}

/// A run took longer than it may.
#[derive(Debug)]
pub struct TooLong(Duration);

impl std::fmt::Display for TooLong {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "a run took longer than {:?}", self.0)
    }
}

impl std::error::Error for TooLong {}

/// Plan of a scene, with its report.
pub struct Planned {
    /// Report of `flexbody plan --report`.
    pub report: Value,
    /// Table of inputs, if inputs move.
    pub inputs: Option<PathBuf>,
}

/// Program that takes the steps.
#[derive(Clone)]
enum By {
    Product,
    Studies,
    /// A program that understands the options of `studies integrate`.
    Other(PathBuf),
}

impl Run {
    /// A simulation of a scene up to a time with a communication step, both in seconds.
    pub fn new(scene: &Value, stop_time: f64, every: f64) -> Self {
        Self {
            scene: scene.clone(),
            every,
            options: vec!["--stop-time".to_owned(), stop_time.to_string()],
            by: By::Product,
            most: Duration::MAX,
        }
    }

    fn option(mut self, name: &str, value: String) -> Self {
        self.options.extend([name.to_owned(), value]);
        self
    }

    /// With a start value.
    pub fn set(self, name: &str, value: f64) -> Self {
        self.option("--set", format!("{name}={value}"))
    }

    /// With inputs that vary in time.
    pub fn inputs(self, file: Option<&Path>) -> Self {
        match file {
            Some(file) => self.option("--input", file.display().to_string()),
            None => self,
        }
    }

    /// A run that takes longer fails.
    pub fn within(self, most: Duration) -> Self {
        Self { most, ..self }
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

    /// By the program of the studies with these options, or by another program that understands them.
    pub fn by_lab(mut self, options: &[(&str, String)], other: Option<&Path>) -> Self {
        self.by = other.map_or(By::Studies, |program| By::Other(program.to_owned()));
        let add = |run: Self, (name, value): &(&str, String)| run.option(name, value.clone());
        options.iter().fold(self, add)
    }
}

/// Results of a run: outputs at the communication points, and the cost of the steps.
pub struct Ran {
    /// The outputs.
    pub table: Table,
    /// Integrator that ran, numbers of steps, calculated parameters, doubtful outputs.
    pub report: Value,
    /// CPU time, s; the median where the run was repeated.
    pub cpu_time: f64,
}

impl Ran {
    /// A number of the report: `steps` (accepted), `rejected`, `newton_iterations`.
    pub fn number(&self, key: &str) -> f64 {
        self.report[key].as_f64().unwrap_or(f64::NAN)
    }

    /// CPU time over such a number, s; rejected steps are paid for.
    pub fn per(&self, key: &str) -> f64 {
        self.cpu_time / self.number(key)
    }

    /// The integrator.
    pub fn method(&self) -> &str {
        self.report["method"].as_str().unwrap_or_default()
    }
}

impl<'a> Bench<'a> {
    /// Builds the product.
    ///
    /// # Errors
    /// The build fails.
    pub fn new(workspace: &'a Workspace) -> Result<Self> {
        Ok(Self {
            program: workspace.program(PACKAGE)?,
            studies: OnceCell::new(),
            workspace,
        })
    }

    /// The program of the studies.
    fn studies_program(&self) -> Result<&PathBuf> {
        if let Some(built) = self.studies.get() {
            return Ok(built);
        }
        let built = self.workspace.program("studies")?;
        Ok(self.studies.get_or_init(|| built))
    }

    /// The program, built for release.
    pub fn program(&self) -> &Path {
        &self.program
    }

    /// The workspace.
    pub fn workspace(&self) -> &Workspace {
        self.workspace
    }

    /// Where a chart's file belongs.
    pub fn output(&self, name: &str) -> PathBuf {
        self.workspace.path("docs/charts").join(name)
    }

    /// Reads a JSON file of the project.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn json(&self, name: &str) -> Result<Value> {
        read(&self.workspace.path(name))
    }

    /// Reads a JSON file of the cases, e.g. `elastica/case.json`.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn case(&self, name: &str) -> Result<Value> {
        self.json(&format!("tests/cases/{name}"))
    }

    /// Reads a table of the cases.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn table(&self, name: &str) -> Result<Table> {
        Table::read(&self.workspace.path("tests/cases").join(name))
    }

    /// Writes a scene for a program and returns where it is.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, scene: &Value) -> Result<PathBuf> {
        let file = prepared(&self.workspace.target("chart/scene.json"))?;
        std::fs::write(&file, scene.to_string())
            .with_context(|| format!("cannot write {}", shown(&file)))?;
        Ok(file)
    }

    /// Plans a scene.
    ///
    /// # Errors
    /// The plan fails.
    pub fn plan(&self, scene: &Value) -> Result<Planned> {
        let [report, inputs] =
            ["plan.json", "inputs.csv"].map(|name| self.workspace.target("chart").join(name));
        let has_inputs = scene["accuracy"]["input_profiles"]
            .as_array()
            .is_some_and(|courses| !courses.is_empty());
        let mut command = Command::new(&self.program);
        command.arg("plan").arg(self.write(scene)?);
        command.arg("--report").arg(&report);
        command.arg("--courses").arg(&inputs);
        run_quietly(&mut command)?;
        Ok(Planned {
            report: read(&report)?,
            inputs: has_inputs.then_some(inputs),
        })
    }

    /// Runs everything once. Failures of single runs are part of the result.
    ///
    /// # Errors
    /// A program that cannot be started.
    pub fn run(&self, title: &str, runs: &[Run]) -> Result<Vec<Result<Ran>>> {
        self.repeat(title, runs, 1, 0.0)
    }

    /// Runs everything often enough for timing. Failures of single runs are part of the result.
    ///
    /// # Errors
    /// A program that cannot be started.
    pub fn time(&self, title: &str, runs: &[Run]) -> Result<Vec<Result<Ran>>> {
        self.repeat(title, runs, REPEATS, f64::INFINITY)
    }

    /// Runs everything so many times, but once where a run fails or takes longer than that, s. Repetitions go round
    /// all runs, so that whatever else the machine does meanwhile meets all of them; CPU times are medians.
    ///
    /// # Errors
    /// A program that cannot be started.
    pub fn repeat(
        &self,
        title: &str,
        runs: &[Run],
        times: usize,
        long: f64,
    ) -> Result<Vec<Result<Ran>>> {
        let bar = progress_bar(title, runs.len() * times);
        let mut outcomes: Vec<Result<Ran>> = Vec::new();
        let mut cpu_times = vec![Vec::new(); runs.len()];
        for round in 0..times {
            for (index, run) in runs.iter().enumerate() {
                bar.inc(1);
                if round > 0 && cpu_times[index].first().is_none_or(|time| *time > long) {
                    continue;
                }
                let outcome = self.execute(run)?;
                cpu_times[index].extend(outcome.iter().map(|ran| ran.cpu_time));
                if round == 0 {
                    outcomes.push(outcome);
                }
            }
        }
        for (outcome, times) in outcomes.iter_mut().zip(&cpu_times) {
            if let Ok(ran) = outcome {
                ran.cpu_time = median(times);
            }
        }
        bar.finish_and_clear();
        eprintln!("{title}: {} runs", runs.len() * times);
        Ok(outcomes)
    }

    /// Runs a measurement of the studies, its name followed by options, on a scene if it has none of its own, and returns its report.
    ///
    /// # Errors
    /// The measurement fails.
    pub fn studies(&self, measurement: &[&str], scene: Option<&Value>) -> Result<Value> {
        let file = scene.map(|scene| self.write(scene)).transpose()?;
        let report = stdout(
            Command::new(self.studies_program()?)
                .args(measurement)
                .args(file),
        )?;
        serde_json::from_str(&report).context("the report of the studies is no JSON")
    }

    /// Runs a measurement of the studies that prints CSV, the file of the chart of the same name.
    ///
    /// # Errors
    /// The measurement fails, or the file cannot be written.
    pub fn lab_table(&self, chart: &str) -> Result<()> {
        let table = stdout(Command::new(self.studies_program()?).arg(chart))?;
        let path = prepared(&self.output(&format!("{chart}.csv")))?;
        std::fs::write(&path, table).with_context(|| format!("cannot write {}", shown(&path)))
    }

    fn execute(&self, run: &Run) -> Result<Result<Ran>> {
        let file = |name: &str| self.workspace.target("chart").join(name);
        let (scene, outputs, report) = (self.write(&run.scene)?, file("run.csv"), file("run.json"));
        let (program, command, every) = match &run.by {
            By::Product => (&self.program, Some("simulate"), "--step"),
            By::Studies => (self.studies_program()?, Some("integrate"), "--every"),
            By::Other(program) => (program, None, "--every"),
        };
        let mut call = Command::new(program);
        call.args(command)
            .arg(scene)
            .args(&run.options)
            .args([every, &run.every.to_string()])
            .arg("--output")
            .arg(&outputs)
            .arg("--report")
            .arg(&report);
        let Some(finished) = output_within(&mut call, run.most)? else {
            return Ok(Err(TooLong(run.most).into()));
        };
        if !finished.status.success() {
            let failure = String::from_utf8_lossy(&finished.stderr);
            return Ok(Err(anyhow::anyhow!("a run failed: {}", failure.trim())));
        }
        let (table, report) = (Table::read(&outputs)?, read(&report)?);
        let Some(cpu_time) = report["cpu_time"].as_f64() else {
            bail!("expected a CPU time in the report of a run, found {report}");
        };
        Ok(Ok(Ran {
            table,
            report,
            cpu_time,
        }))
    }
}

fn read(path: &Path) -> Result<Value> {
    let place = shown(path);
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {place}"))?;
    serde_json::from_str(&text).with_context(|| format!("{place} is no JSON"))
}

/// A bar that counts runs.
pub fn progress_bar(title: &str, runs: usize) -> ProgressBar {
    let template = "{msg} {bar:40} {pos}/{len} runs  {elapsed}";
    bar(template, runs as u64).with_message(title.to_owned())
}
