//! Floor 11. The headless runner: describes a scene for packaging, simulates it without FMI, and
//! prints the schema of scenes.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use flexbody::fmi2;
use flexbody::scene::{Experiment, Scene};
use flexbody::simulation::{
    Causality, NEARLY, Redundant, Report, SignalError, Signals, Simulation, Singular, check,
};
use indicatif::{ProgressBar, ProgressStyle};

use files::{Shapes, Sink, Table};
use planning::{plan, planned};
use stopwatch::Stopwatch;

mod files;
mod planning;
mod stopwatch;
mod viewing;

#[derive(Parser)]
#[command(
    version,
    about = "Flexible bodies: describe, plan, simulate, view, schema"
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Writes what a package holds besides the library: model description, scene, documentation.
    Describe {
        /// Scene file.
        scene: PathBuf,
        /// Directory to write into; made if it does not exist.
        #[arg(long)]
        output: PathBuf,
        /// Leaves the default experiment in motion out of the documentation.
        #[arg(long)]
        no_animation: bool,
    },
    /// Finds elements, their numbers and a tolerance for the error that a scene asks for, and says why.
    Plan(Planning),
    /// Simulates a scene and writes its outputs at every communication point as CSV.
    Simulate(Simulate),
    /// Shows a scene, the scene in an FMU or a table of outputs in motion: writes a page of HTML and opens it.
    View(viewing::View),
    /// Prints the JSON Schema of a scene.
    Schema,
}

#[derive(clap::Args)]
struct Planning {
    /// Scene file.
    scene: PathBuf,
    /// Writes the scene with these numbers to a file.
    #[arg(long)]
    output: Option<PathBuf>,
    /// JSON file for the plan: elements and fewest elements of bodies, tolerance, errors of outputs, runs.
    #[arg(long)]
    report: Option<PathBuf>,
    /// CSV file for what inputs do meanwhile (`accuracy.for`), which `simulate --input` reads; not written where
    /// none moves.
    #[arg(long)]
    inputs: Option<PathBuf>,
}

#[derive(clap::Args)]
struct Simulate {
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
    /// CSV file of inputs that vary in time: a column `time` and one for every input, named like it; straight
    /// lines between the rows, two rows of one time are a jump.
    #[arg(long)]
    input: Option<PathBuf>,
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

/// Names that are offered in place of one that is not there.
const OFFERED: usize = 3;
/// How alike (Jaro-Winkler, 0 to 1) an offered name is at least.
const ALIKE: f64 = 0.75;
/// Communication points, about, that bodies are drawn at.
const SNAPSHOTS: u64 = 11;

/// What all communication steps of a run took together; set-up and output do not count.
struct Cost {
    method: &'static str,
    steps: u64,
    rejected: u64,
    newton_iterations: u64,
    /// CPU time of the steps alone.
    stopwatch: Stopwatch,
    /// Outputs that the tolerance does not reach.
    doubtful: Vec<String>,
    /// Singular positions.
    singular: Vec<Singular>,
    /// A mesh that is too coarse, in words.
    unresolved: Option<String>,
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
        }
    }

    fn add(&mut self, report: Report) {
        self.method = report.method;
        self.steps += report.steps;
        self.rejected += report.rejected;
        self.newton_iterations += report.newton_iterations;
    }

    /// One line of JSON; CPU time in seconds. Names of variables and joints need no escapes.
    fn json(&self, calculated: &[(String, f64)], redundant: &Redundant) -> String {
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
            list(&self.doubtful)
        )
    }
}

type Outcome<T> = Result<T, String>;

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Describe {
            scene,
            output,
            no_animation,
        } => describe(&scene, &output, !no_animation),
        Command::Plan(arguments) => plan(&arguments),
        Command::Simulate(arguments) => simulate(&arguments),
        Command::View(arguments) => viewing::view(&arguments),
        Command::Schema => print_schema(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("flexbody: {message}");
            ExitCode::FAILURE
        }
    }
}

fn read(path: &Path) -> Outcome<Scene> {
    let text = fs::read_to_string(path).map_err(|error| at(path, error))?;
    Scene::from_json(&text).map_err(|error| at(path, error))
}

fn at(path: &Path, error: impl std::fmt::Display) -> String {
    format!("{}: {error}", path.display())
}

fn print_schema() -> Outcome<()> {
    let outcome = io::stdout().write_all(Scene::json_schema().as_bytes());
    outcome.map_err(|error| format!("standard output: {error}"))
}

fn describe(scene: &Path, output: &Path, is_moving: bool) -> Outcome<()> {
    let (place, (scene, planned)) = (scene, planned(scene)?);
    // What contradicts itself is told here, not by the first master that runs it.
    check(&scene).map_err(|error| at(place, error))?;
    let motion = match is_moving {
        true => viewing::motion(place, &scene)?,
        false => String::new(),
    };
    for (name, text) in fmi2::describe(&scene, &planned, &motion) {
        let path = output.join(name);
        if let Some(directory) = path.parent() {
            fs::create_dir_all(directory).map_err(|error| at(directory, error))?;
        }
        fs::write(&path, text).map_err(|error| at(&path, error))?;
    }
    Ok(())
}

fn simulate(arguments: &Simulate) -> Outcome<()> {
    let (scene, _) = planned(&arguments.scene)?;
    let stop_time = arguments.stop_time.unwrap_or(scene.experiment.stop_time);
    let step = arguments.step.unwrap_or(scene.experiment.step);
    let points = communication_points(stop_time, step)?;
    let mut simulation = Simulation::new(scene);
    for assignment in &arguments.set {
        assign(&mut simulation, assignment)?;
    }
    let signals = signals(&mut simulation, arguments, stop_time)?;
    let started = simulation.initialize(0.0).and_then(|()| simulation.start());
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

/// The inputs that vary in time, if there are any, set to their values at the start.
fn signals(
    simulation: &mut Simulation,
    arguments: &Simulate,
    stop_time: f64,
) -> Outcome<Option<Signals>> {
    let Some(path) = &arguments.input else {
        return Ok(None);
    };
    let text = fs::read_to_string(path).map_err(|error| at(path, error))?;
    let found = Signals::from_csv(&text, simulation.variables()).and_then(|signals| {
        signals.check_covers(0.0, stop_time)?;
        Ok(signals)
    });
    let signals = found.map_err(|error| match &error {
        SignalError::Unknown(name) => {
            let inputs = names(simulation, |kind| kind == Causality::Input);
            at(path, format!("{error}{}", nearest(name, &inputs)))
        }
        SignalError::Wrong(_) => at(path, error),
    })?;
    for assignment in &arguments.set {
        let name = assignment.split('=').next().unwrap_or_default().trim();
        let index = simulation.variables().iter().position(|v| v.name == name);
        if index.is_some_and(|index| signals.holds(index)) {
            return Err(format!(
                "--set {assignment}: {} sets it already",
                path.display()
            ));
        }
    }
    let set = simulation.set_inputs(&signals);
    set.map_err(|error| at(path, error))?;
    Ok(Some(signals))
}

/// Names of the variables of some kinds.
fn names(simulation: &Simulation, is_wanted: impl Fn(Causality) -> bool) -> Vec<&str> {
    let variables = simulation.variables().iter();
    let wanted = variables.filter(|variable| is_wanted(Causality::of(variable)));
    wanted.map(|variable| variable.name.as_str()).collect()
}

/// The names that are most like one that is not there, as the end of a message.
fn nearest(name: &str, names: &[&str]) -> String {
    let mut alike: Vec<(f64, &str)> = names
        .iter()
        .map(|known| (strsim::jaro_winkler(name, known), *known))
        .filter(|(likeness, _)| *likeness >= ALIKE)
        .collect();
    alike.sort_by(|a, b| b.0.total_cmp(&a.0));
    alike.truncate(OFFERED);
    if alike.is_empty() {
        return String::new();
    }
    let alike: Vec<String> = alike.iter().map(|(_, name)| format!("`{name}`")).collect();
    format!("; did you mean {}?", alike.join(" or "))
}

/// Calculated parameters and their values.
fn calculated(simulation: &mut Simulation) -> Outcome<Vec<(String, f64)>> {
    let mut found = Vec::new();
    for index in 0..simulation.variables().len() {
        if Causality::of(&simulation.variables()[index]) == Causality::CalculatedParameter {
            let value = simulation.real(index).map_err(|error| error.to_string())?;
            found.push((simulation.variables()[index].name.clone(), value));
        }
    }
    Ok(found)
}

/// The number of communication steps up to the stop time.
fn communication_points(stop_time: f64, step: f64) -> Outcome<u64> {
    for (name, value) in [("--stop-time", stop_time), ("--step", step)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(format!("{name}: expected a positive number, found {value}"));
        }
    }
    let count = Experiment { stop_time, step }.steps();
    if count > 1e9 {
        return Err(format!("--step: expected at most 1e9 steps, found {count}"));
    }
    Ok(count as u64)
}

fn assign(simulation: &mut Simulation, assignment: &str) -> Outcome<()> {
    let wrong = |found: &str| format!("--set {assignment}: {found}");
    let (name, value) = assignment
        .split_once('=')
        .ok_or_else(|| wrong("expected NAME=VALUE"))?;
    let (name, value) = (name.trim(), value.trim());
    let index = simulation
        .variables()
        .iter()
        .position(|variable| variable.name == name);
    let index = index.ok_or_else(|| {
        let settable = |kind| matches!(kind, Causality::Parameter | Causality::Input);
        let alike = nearest(name, &names(simulation, settable));
        wrong(&format!("no variable of this name{alike}"))
    })?;
    let outcome = if simulation.variables()[index].is_integer() {
        let value = value.parse().map_err(|_| wrong("expected an integer"))?;
        simulation.set_integer(index, value)
    } else {
        let value = value.parse().map_err(|_| wrong("expected a number"))?;
        simulation.set_real(index, value)
    };
    outcome.map_err(|error| wrong(&error.to_string()))
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
    fn all(&mut self, simulation: &mut Simulation) -> Outcome<()> {
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
        bar.finish_and_clear();
        for name in &self.cost.doubtful {
            eprintln!(
                "flexbody: {name}: errors of the steps may have left more than 10 times the relative tolerance"
            );
        }
        for singular in &self.cost.singular {
            eprintln!("flexbody: {singular}");
        }
        if let Some(unresolved) = &self.cost.unresolved {
            eprintln!("flexbody: {unresolved}");
        }
        Ok(())
    }

    /// One communication step, in as many parts as inputs have rows in it.
    fn step(&mut self, simulation: &mut Simulation, until: f64) -> Outcome<()> {
        while simulation.time() < until {
            let signals = self.signals.as_ref();
            self.cost.stopwatch.time(|| match signals {
                Some(signals) => simulation.step_along(signals, until),
                None => simulation
                    .step(until)
                    .map_err(|failure| failure.to_string()),
            })?;
            self.cost.add(simulation.report());
            while let Some(name) = simulation.next_doubtful() {
                self.cost.doubtful.push(name.to_owned());
            }
            self.cost.singular.extend(simulation.next_singular());
            if let Some(unresolved) = simulation.next_unresolved() {
                self.cost.unresolved = Some(unresolved.to_string());
            }
        }
        Ok(())
    }
}

/// A progress bar on standard error; invisible where that is no terminal.
fn progress_bar(steps: u64) -> ProgressBar {
    let template = "simulating {bar:40} {percent:>3} %  {eta} left";
    let style = ProgressStyle::with_template(template);
    ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
