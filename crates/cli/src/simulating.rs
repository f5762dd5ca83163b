//! `flexbody simulate`: a scene, or that in an FMU, without FMI.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, bail};
use flexbody::scene::{Experiment, Interpolation};
use flexbody::simulation::{
    Causality, Doubtful, InputTable, NEARLY, RedundantNames, Report, Signals, Simulation, Singular,
    TrialConditions,
};
use fmu_package::Progress;

use crate::files::{Shapes, Sink, Table};
use crate::inputs::{self, Inputs};
use crate::planning::{Within, planned_for};
use crate::reading::{at, read};
use crate::settings::{assign, assignments};
use crate::stopwatch::Stopwatch;

#[derive(clap::Args)]
pub struct Simulate {
    #[command(flatten)]
    within: Within,
    /// Scene file.
    scene: PathBuf,
    /// Time at which the simulation ends, s; that of the scene's experiment if it is not given.
    #[arg(long, allow_negative_numbers = true)]
    stop_time: Option<f64>,
    /// Time between communication points, s; that of the scene's experiment if it is not given.
    #[arg(long, allow_negative_numbers = true)]
    step: Option<f64>,
    /// Value of a parameter or input, e.g. `rod.density=7800`; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    inputs: Inputs,
    /// CSV file; standard output if it is not given.
    #[arg(long)]
    output: Option<PathBuf>,
    /// JSON file for the natural frequencies, for what the steps took (integrator, sub-steps, Newton
    /// iterations, CPU time in s), for joints that hold what others hold already, exactly or nearly, for
    /// singular positions and for outputs that the tolerance does not reach.
    #[arg(long)]
    report: Option<PathBuf>,
    /// File for pictures: a line of JSON that names every body and its markers, then one for every
    /// communication point with the places of markers and, at some, of points along the bodies.
    #[arg(long)]
    shapes: Option<PathBuf>,
}

/// Communication points, about, that bodies are drawn at.
const SNAPSHOTS: u64 = 11;

/// Total cost of the communication steps of a run, without set-up and output.
struct Cost {
    method: &'static str,
    steps: u64,
    rejected: u64,
    newton_iterations: u64,
    /// CPU time of the steps alone.
    stopwatch: Stopwatch,
    /// Outputs that the tolerance does not reach.
    doubtful: Vec<Doubtful>,
    /// Singular positions.
    singular: Vec<Singular>,
    /// A mesh that is too coarse, in words.
    unresolved: Option<String>,
    /// Functions of time that steps do not follow, and rods that rotate too quickly, in words.
    told: Vec<String>,
}

impl Cost {
    fn new() -> Self {
        Self {
            method: "",
            steps: 0,
            rejected: 0,
            newton_iterations: 0,
            stopwatch: Stopwatch::new(),
            doubtful: Vec::new(),
            singular: Vec::new(),
            unresolved: None,
            told: Vec::new(),
        }
    }

    fn add(&mut self, report: Report) {
        self.method = report.method;
        self.steps += report.steps;
        self.rejected += report.rejected;
        self.newton_iterations += report.newton_iterations;
    }

    /// One line of JSON; CPU time in seconds. Names of variables and joints need no escapes.
    fn json(&self, calculated: &[(String, f64)], redundant: &RedundantNames) -> String {
        let pair = |(name, value): &(String, f64)| format!("\"{name}\": {value:?}");
        let calculated: Vec<String> = calculated.iter().map(pair).collect();
        let quoted = |name: &String| format!("\"{name}\"");
        let list = |names: &[String]| names.iter().map(quoted).collect::<Vec<_>>().join(", ");
        let position = |Singular { time, names }: &Singular| {
            format!("{{\"time\": {time:?}, \"names\": [{}]}}", list(names))
        };
        let singular: Vec<String> = self.singular.iter().map(position).collect();
        format!(
            "{{\"method\": \"{}\", \"steps\": {}, \"rejected\": {}, \"newton_iterations\": {}, \
             \"cpu_time\": {:?}, \"calculated\": {{{}}}, \"redundant\": [{}], \
             \"nearly_redundant\": [{}], \"singular\": [{}], \"doubtful\": [{}]}}\n",
            self.method,
            self.steps,
            self.rejected,
            self.newton_iterations,
            self.stopwatch.seconds(),
            calculated.join(", "),
            list(&redundant.exactly),
            list(&redundant.nearly),
            singular.join(", "),
            self.doubtful
                .iter()
                .map(|of| quoted(&of.name))
                .collect::<Vec<_>>()
                .join(", ")
        )
    }
}

/// Simulates a scene and writes its outputs to a table.
///
/// # Errors
/// A scene that is not valid, a step that fails, or a file that cannot be written.
pub fn simulate(arguments: &Simulate) -> Result<()> {
    let path = &arguments.scene;
    let mut scene = read(path)?;
    let stop_time = arguments.stop_time.unwrap_or(scene.experiment.stop_time);
    let step = arguments.step.unwrap_or(scene.experiment.step);
    let points = communication_points(stop_time, step)?;
    if scene.is_to_be_planned() {
        // Planned for what is run.
        scene.experiment = Experiment { stop_time, step };
    }
    let table = arguments.inputs.table()?;
    if table.is_none() && !scene.accuracy.input_profiles.is_empty() {
        eprintln!(
            "flexbody: inputs stay at their start values; `flexbody plan --courses FILE` writes `accuracy.input_profiles` as a table for `--input FILE`"
        );
    }
    let given = TrialConditions {
        set: assignments(&scene, &arguments.set)?,
        inputs: table.as_ref().map(|(table, _)| table.clone()),
    };
    let given = given.without_planned(&scene);
    let (scene, _) = planned_for(path, &scene, &given, &arguments.within)?;
    let mut simulation = Simulation::new(scene);
    let set = arguments.set.iter();
    let set = set.map(|assignment| Ok((&**assignment, assign(&mut simulation, assignment)?)));
    let set: Vec<(&str, usize)> = set.collect::<Result<_>>()?;
    let signals =
        table.map(|(table, path)| signals(&mut simulation, &table, path, &set, stop_time));
    let signals = signals.transpose()?;
    let finding = Progress::spinner("finding the start {spinner}", "finding the start");
    let started = simulation.initialize(0.0).and_then(|()| simulation.start());
    drop(finding);
    started.map_err(|error| at(&arguments.scene, error))?;
    let redundant = simulation.redundant();
    for joint in &redundant.exactly {
        eprintln!("flexbody: {joint} holds what others hold already");
    }
    if !redundant.nearly.is_empty() {
        let names = redundant.nearly.join(", ");
        eprintln!("flexbody: {names}: nearly held by others already; {NEARLY}");
    }
    let outputs = Sink::new(arguments.output.as_deref())?;
    let shapes = arguments.shapes.as_deref();
    let shapes = shapes.map(|path| Sink::new(Some(path))).transpose()?;
    let mut run = Run {
        steps: (points, step, stop_time),
        signals,
        csv: Table::new(&simulation, outputs),
        shapes: shapes.map(|sink| Shapes::new(simulation.scene(), sink)),
        cost: Cost::new(),
    };
    run.all(&mut simulation)?;
    match &arguments.report {
        Some(path) => {
            let json = run.cost.json(&calculated(&mut simulation)?, &redundant);
            fs::write(path, json).map_err(|error| at(path, error))
        }
        None => Ok(()),
    }
}

/// The inputs that vary in time, by a file, set to their values at the start; what is set beside them is none of them.
fn signals(
    simulation: &mut Simulation,
    table: &InputTable,
    path: &Path,
    set: &[(&str, usize)],
    stop_time: f64,
) -> Result<Signals> {
    let signals = inputs::signals(table, path, simulation.variables(), stop_time)?;
    for &(assignment, index) in set {
        if signals.holds(index) {
            bail!("--set {assignment}: {} sets it already", path.display());
        }
    }
    let set = simulation.set_inputs(&signals);
    set.map_err(|error| at(path, error))?;
    let variables = simulation.variables();
    let following: Vec<&str> = signals.following().map(|i| &*variables[i].name).collect();
    if let (Interpolation::Linear, false) = (table.curve, following.is_empty()) {
        eprintln!(
            "flexbody: {}: {} follow the straight lines between rows; `--interpolation spline` makes the motion smooth",
            path.display(),
            following.join(", ")
        );
    }
    Ok(signals)
}

/// Calculated parameters and their values.
fn calculated(simulation: &mut Simulation) -> Result<Vec<(String, f64)>> {
    let mut found = Vec::new();
    for index in 0..simulation.variables().len() {
        if Causality::of(&simulation.variables()[index]) == Causality::CalculatedParameter {
            let value = simulation.real(index).map_err(|error| anyhow!("{error}"))?;
            found.push((simulation.variables()[index].name.clone(), value));
        }
    }
    Ok(found)
}

/// Returns the number of communication steps up to the stop time.
///
/// # Errors
/// A time or step that is not positive, or too many steps.
pub fn communication_points(stop_time: f64, step: f64) -> Result<u64> {
    for (name, value) in [("--stop-time", stop_time), ("--step", step)] {
        if !(value.is_finite() && value > 0.0) {
            bail!("{name}: expected a positive number, found {value}");
        }
    }
    let count = Experiment { stop_time, step }.steps();
    if count > 1e9 {
        bail!("--step: expected at most 1e9 steps, found {count}");
    }
    Ok(count as u64)
}

/// A simulation from communication point to communication point.
struct Run {
    /// Number of steps, their length and where the last ends, s.
    steps: (u64, f64, f64),
    signals: Option<Signals>,
    csv: Table,
    shapes: Option<Shapes>,
    cost: Cost,
}

impl Run {
    fn all(&mut self, simulation: &mut Simulation) -> Result<()> {
        let (steps, step, stop_time) = self.steps;
        self.csv.header(simulation)?;
        if let Some(shapes) = &mut self.shapes {
            shapes.sink.line(&shapes.header.clone())?;
        }
        let bar = progress_bar(steps);
        for number in 0..=steps {
            if number > 0 {
                // A multiple rather than a sum, so that rounding does not add up.
                self.step(simulation, (number as f64 * step).min(stop_time))?;
                bar.inc(1);
            }
            self.csv.row(simulation)?;
            if let Some(shapes) = &mut self.shapes {
                // The first and the last, and others at distances as even as can be.
                let is_whole =
                    number == 0 || number * SNAPSHOTS / steps != (number - 1) * SNAPSHOTS / steps;
                shapes.row(simulation, is_whole)?;
            }
        }
        self.csv.sink.finish()?;
        if let Some(shapes) = &mut self.shapes {
            shapes.sink.finish()?;
        }
        drop(bar);
        self.cost.doubtful = simulation.doubtful();
        for doubtful in &self.cost.doubtful {
            eprintln!("flexbody: {doubtful}");
        }
        for singular in &self.cost.singular {
            eprintln!("flexbody: {singular}");
        }
        for found in &self.cost.told {
            eprintln!("flexbody: {found}");
        }
        if let Some(unresolved) = &self.cost.unresolved {
            eprintln!("flexbody: {unresolved}");
        }
        Ok(())
    }

    /// One communication step, in as many parts as inputs have rows in it.
    fn step(&mut self, simulation: &mut Simulation, until: f64) -> Result<()> {
        while simulation.time() < until {
            let signals = self.signals.as_ref();
            self.cost.stopwatch.time(|| match signals {
                Some(signals) => {
                    let stepped = simulation.step_along(signals, until);
                    stepped.map_err(|failure| anyhow!("{failure}"))
                }
                None => {
                    let stepped = simulation.step(until);
                    stepped.map_err(|failure| anyhow!("{failure}"))
                }
            })?;
            self.cost.add(simulation.report());
            let told = std::iter::from_fn(|| simulation.next_beyond());
            self.cost.told.extend(told);
            self.cost.singular.extend(simulation.next_singular());
            if let Some(unresolved) = simulation.next_unresolved() {
                self.cost.unresolved = Some(unresolved.to_string());
            }
        }
        Ok(())
    }
}

/// Progress of steps.
pub fn progress_bar(steps: u64) -> Progress {
    let template = "simulating {bar:40} {percent:>3} %  {eta} left";
    Progress::bar(template, "simulating", steps, 0)
}
