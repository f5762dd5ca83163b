//! `flexbody sweep`: a scene simulated many times with other parameters, on all processors or on a cluster.

mod axes;
mod cluster;
mod journal;
mod table;
mod threads;

use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::{Context, Result, anyhow, bail};
use flexbody::scene::Scene;
use flexbody::simulation::Simulation;
use fmu_package::{Progress, destination, shown};
use serde_json::json;

use crate::planning::{Within, planned};
use crate::settings::{assign, outputs, set, settable};
use crate::simulating::communication_points;
use axes::Axes;
use journal::Journal;

/// Which scene, what of it varies, and where to write.
#[derive(clap::Args)]
pub struct Sweep {
    #[command(flatten)]
    within: Within,
    /// Scene file, or FMU.
    scene: PathBuf,
    /// Varied parameter or input with its values: `NAME=FROM:TO:COUNT`, `NAME=A,B,...` or `NAME=@FILE.csv` (the column
    /// of that name; columns move together, row by row). May be repeated: runs are all combinations.
    #[arg(long, value_name = "NAME=VALUES", required = true)]
    vary: Vec<String>,
    /// Value of a parameter or input in all runs, e.g. `rod.density=7800`; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Time at which runs end, s; that of the scene's experiment if it is not given.
    #[arg(long)]
    stop_time: Option<f64>,
    /// Time between communication points, s; that of the scene's experiment if it is not given.
    #[arg(long)]
    step: Option<f64>,
    /// Parquet file: a row for every run, with what varied, and of every output its final, least and largest value.
    #[arg(long, value_name = "FILE.parquet", default_value = "sweep.parquet")]
    output: PathBuf,
    /// Parquet file for outputs at every communication point: a row for every run and point.
    #[arg(long, value_name = "FILE.parquet")]
    series: Option<PathBuf>,
    /// Number of runs at a time; of processors if it is not given. Of a local cluster, that of workers.
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Runs the FMU on a cluster of Dask, at this address; `local` starts one. Wants the Python package with `[cluster]`.
    #[arg(long, value_name = "ADDRESS|local")]
    scheduler: Option<String>,
    /// Folder with the libraries that go into the FMU for a cluster [default: `fmu` beside this program].
    #[arg(long, value_name = "FOLDER")]
    parts: Option<PathBuf>,
}

/// Outputs at every communication point.
pub struct Series {
    /// Communication points, s.
    pub times: Vec<f64>,
    /// Values of all outputs at each.
    pub values: Vec<Vec<f64>>,
    /// Warnings about the steps.
    pub warnings: Vec<String>,
}

/// Summary of an output in a run.
pub struct Summary {
    /// Value at the end.
    pub last: f64,
    /// Least value at communication points.
    pub least: f64,
    /// Largest value there.
    pub largest: f64,
}

/// Outcome of a run.
pub enum Outcome {
    /// Reason why there is no result.
    Failed(String),
    /// Results of a completed run.
    Finished(Finished),
}

/// A run that came to its end.
pub struct Finished {
    /// Summaries of all outputs.
    pub summaries: Vec<Summary>,
    /// Warnings about the steps.
    pub warnings: Vec<String>,
    /// Communication points and outputs at each, where they are wanted.
    pub series: Option<(Vec<f64>, Vec<Vec<f64>>)>,
}

/// Settings that all runs have in common.
struct Common {
    scene: Scene,
    axes: Axes,
    /// Places of what varies among the variables, in the order of the axes.
    varied: Vec<usize>,
    /// Variables that are fixed in all runs: index, name and value.
    fixed: Vec<(usize, String, f64)>,
    /// Places of outputs.
    outputs: Vec<usize>,
    /// Names of outputs.
    names: Vec<String>,
    /// Communication points, s, without the start.
    points: Vec<f64>,
    /// Their distance, s.
    step: f64,
}

/// Runs a sweep, or the missing runs of one, and prints where its results are.
///
/// # Errors
/// A scene or an axis that is not valid, or a file that cannot be read or written.
pub fn sweep(arguments: &Sweep) -> Result<()> {
    let common = Common::new(arguments)?;
    let output = destination(&arguments.output).context("--output")?;
    let series = arguments.series.as_deref().map(destination).transpose();
    let series = series.context("--series")?;
    if series.as_ref() == Some(&output) {
        bail!("--series: expected another file than --output, found the same");
    }
    let description = common.description(series.is_some());
    let count = common.axes.count();
    let mut journal = Journal::open(Journal::beside(&output), &description, count)?;
    let missing = journal.missing();
    if missing.len() < count {
        eprintln!(
            "{} of {count} runs are there already",
            count - missing.len()
        );
    }
    let template = "sweeping {bar:40} {pos}/{len} runs  {eta} left";
    let done = (count - missing.len()) as u64;
    let bar = Progress::bar(template, "sweeping", count as u64, done);
    let mut take = |run: usize, found: Result<Series, String>| {
        bar.inc(1);
        journal.add(run, &Outcome::new(found, series.is_some()))
    };
    match &arguments.scheduler {
        Some(address) => cluster::run(arguments, &common, address, &missing, &mut take)?,
        None => threads::run(&common, arguments.jobs, &missing, &mut take)?,
    }
    drop(bar);
    let failed = table::write(&common, &mut journal, &output, series.as_deref())?;
    println!("wrote {}", shown(&output));
    if let Some(series) = &series {
        println!("wrote {}", shown(series));
    }
    journal.remove()?;
    match failed {
        Some((number, run, reason)) if number == count => {
            bail!("all of {count} runs failed; first run {run}: {reason}")
        }
        Some((number, run, reason)) => {
            eprintln!("flexbody: {number} of {count} runs failed; first run {run}: {reason}");
            Ok(())
        }
        None => Ok(()),
    }
}

impl Common {
    fn new(arguments: &Sweep) -> Result<Self> {
        let axes = Axes::parse(&arguments.vary)?;
        let (scene, _) = planned(&arguments.scene, &arguments.within)?;
        let step = arguments.step.unwrap_or(scene.experiment.step);
        let stop_time = arguments.stop_time.unwrap_or(scene.experiment.stop_time);
        let count = communication_points(stop_time, step)?;
        // Multiples rather than sums, so that rounding does not add up.
        let points = (1..=count).map(|number| (number as f64 * step).min(stop_time));
        let mut simulation = Simulation::new(scene.clone());
        let mut fixed = Vec::new();
        for assignment in &arguments.set {
            let index = assign(&mut simulation, assignment)?;
            let name = simulation.variables()[index].name.clone();
            if axes.names().contains(&&*name) {
                bail!("--set {assignment}: --vary sets it already");
            }
            fixed.push((index, name, simulation.setting(index)));
        }
        let place = |name| {
            settable(simulation.variables(), name).map_err(|error| anyhow!("{name}: {error}"))
        };
        let varied = axes.names().into_iter().map(place);
        let varied = varied.collect::<Result<_>>().context("--vary")?;
        let outputs = outputs(&simulation);
        let name = |&index: &usize| simulation.variables()[index].name.clone();
        Ok(Self {
            points: points.collect(),
            scene,
            axes,
            varied,
            fixed,
            names: outputs.iter().map(name).collect(),
            outputs,
            step,
        })
    }

    /// All that decides what runs give, so that results of another sweep are not taken for this one's.
    fn description(&self, has_series: bool) -> serde_json::Value {
        json!({
            "flexbody": env!("CARGO_PKG_VERSION"),
            "scene": self.scene.to_json(),
            "axes": self.axes.to_json(),
            "set": self.fixed,
            "points": self.points.len(),
            "step": self.step,
            "stop_time": self.points.last(),
            "series": has_series,
        })
    }

    /// A run.
    fn run(&self, run: usize) -> Result<Series, String> {
        let mut simulation = Simulation::new(self.scene.clone());
        let mut set = |index: usize, name: &str, value: f64| {
            set(&mut simulation, index, value).map_err(|error| format!("{name}: {error}"))
        };
        for (index, name, value) in &self.fixed {
            set(*index, name, *value)?;
        }
        let names = self.axes.names();
        for ((index, name), value) in self.varied.iter().zip(names).zip(self.axes.values(run)) {
            set(*index, name, value)?;
        }
        let started = simulation.initialize(0.0).and_then(|()| simulation.start());
        started.map_err(|error| error.to_string())?;
        let mut series = Series {
            times: Vec::with_capacity(self.points.len() + 1),
            values: Vec::with_capacity(self.points.len() + 1),
            warnings: Vec::new(),
        };
        self.read(&mut simulation, 0.0, &mut series)?;
        let mut time = 0.0;
        for &point in &self.points {
            // As a master of FMUs does: a time and a step from there.
            let stepped = simulation.step(time + (point - time));
            stepped.map_err(|failure| format!("at {time:?} s: {failure}"))?;
            simulation.tell_warnings(|text| series.warnings.push(text.to_string()));
            self.read(&mut simulation, point, &mut series)?;
            time = point;
        }
        Ok(series)
    }

    fn read(
        &self,
        simulation: &mut Simulation,
        time: f64,
        into: &mut Series,
    ) -> Result<(), String> {
        let mut row = Vec::with_capacity(self.outputs.len());
        for &index in &self.outputs {
            row.push(simulation.real(index).map_err(|error| error.to_string())?);
        }
        into.times.push(time);
        into.values.push(row);
        Ok(())
    }
}

impl Outcome {
    fn new(found: Result<Series, String>, has_series: bool) -> Self {
        let series = match found {
            Ok(series) => series,
            Err(reason) => return Self::Failed(reason),
        };
        let first = series.values[0].iter();
        let mut summaries: Vec<Summary> = first
            .map(|&value| Summary {
                last: value,
                least: value,
                largest: value,
            })
            .collect();
        for row in &series.values {
            for (summary, &value) in summaries.iter_mut().zip(row) {
                summary.last = value;
                summary.least = summary.least.min(value);
                summary.largest = summary.largest.max(value);
            }
        }
        Self::Finished(Finished {
            summaries,
            warnings: series.warnings,
            series: has_series.then_some((series.times, series.values)),
        })
    }
}
