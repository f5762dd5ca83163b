//! Floor 8. The headless runner: describes a scene for packaging, simulates it without FMI, and
//! prints the schema of scenes.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::{Parser, Subcommand};
use cpu_time::ThreadTime;
use flexbody::fmi2::{self, Causality};
use flexbody::scene::Scene;
use flexbody::simulation::{Report, Simulation};
use indicatif::{ProgressBar, ProgressStyle};

#[derive(Parser)]
#[command(version, about = "Flexible bodies: describe, simulate, schema")]
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
    },
    /// Simulates a scene and writes its outputs at every communication point as CSV.
    Simulate(Simulate),
    /// Prints the JSON Schema of a scene.
    Schema,
}

#[derive(clap::Args)]
struct Simulate {
    /// Scene file.
    scene: PathBuf,
    /// Time at which the simulation ends, s.
    #[arg(long, allow_negative_numbers = true)]
    stop_time: f64,
    /// Time between communication points, s.
    #[arg(long, allow_negative_numbers = true)]
    step: f64,
    /// Value of a parameter or input, e.g. `rod.density=7800`; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// CSV file; standard output if it is not given.
    #[arg(long)]
    output: Option<PathBuf>,
    /// JSON file for the natural frequencies, for what the steps took (integrator, sub-steps, Newton
    /// iterations, CPU time in s) and for joints that hold what others hold already.
    #[arg(long)]
    report: Option<PathBuf>,
}

/// What all communication steps of a run took together; set-up and output do not count.
#[derive(Default)]
struct Cost {
    method: &'static str,
    steps: u64,
    rejected: u64,
    newton_iterations: u64,
    cpu_time: Duration,
}

impl Cost {
    fn add(&mut self, report: Report, cpu_time: Duration) {
        self.method = report.method;
        self.steps += report.steps;
        self.rejected += report.rejected;
        self.newton_iterations += report.newton_iterations;
        self.cpu_time += cpu_time;
    }

    /// One line of JSON; CPU time in seconds. Names of variables and joints need no escapes.
    fn json(&self, calculated: &[(String, f64)], redundant: &[String]) -> String {
        let pair = |(name, value): &(String, f64)| format!("\"{name}\": {value:?}");
        let calculated: Vec<String> = calculated.iter().map(pair).collect();
        let quoted = |name: &String| format!("\"{name}\"");
        let redundant: Vec<String> = redundant.iter().map(quoted).collect();
        format!(
            "{{\"method\": \"{}\", \"steps\": {}, \"rejected\": {}, \"newton_iterations\": {}, \
             \"cpu_time\": {:?}, \"calculated\": {{{}}}, \"redundant\": [{}]}}\n",
            self.method,
            self.steps,
            self.rejected,
            self.newton_iterations,
            self.cpu_time.as_secs_f64(),
            calculated.join(", "),
            redundant.join(", ")
        )
    }
}

type Outcome<T> = Result<T, String>;

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Describe { scene, output } => describe(&scene, &output),
        Command::Simulate(arguments) => simulate(&arguments),
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

fn describe(scene: &Path, output: &Path) -> Outcome<()> {
    for (name, text) in fmi2::describe(&read(scene)?) {
        let path = output.join(name);
        if let Some(directory) = path.parent() {
            fs::create_dir_all(directory).map_err(|error| at(directory, error))?;
        }
        fs::write(&path, text).map_err(|error| at(&path, error))?;
    }
    Ok(())
}

fn simulate(arguments: &Simulate) -> Outcome<()> {
    let points = communication_points(arguments.stop_time, arguments.step)?;
    let mut simulation = Simulation::new(read(&arguments.scene)?);
    for assignment in &arguments.set {
        assign(&mut simulation, assignment)?;
    }
    let started = simulation.initialize(0.0).and_then(|()| simulation.start());
    started.map_err(|error| at(&arguments.scene, error))?;
    let redundant = simulation.redundant_joints();
    for joint in &redundant {
        eprintln!("flexbody: {joint} holds what others hold already");
    }
    let cost = match &arguments.output {
        Some(path) => {
            let file = File::create(path).map_err(|error| at(path, error))?;
            run(&mut simulation, arguments, points, BufWriter::new(file))
        }
        None => run(
            &mut simulation,
            arguments,
            points,
            BufWriter::new(io::stdout().lock()),
        ),
    }?;
    match &arguments.report {
        Some(path) => {
            let json = cost.json(&calculated(&mut simulation)?, &redundant);
            fs::write(path, json).map_err(|error| at(path, error))
        }
        None => Ok(()),
    }
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
    // The last step is shorter where the stop time is no multiple, but not by rounding alone.
    let count = (stop_time / step - 1e-9).ceil().max(1.0);
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
    let index = index.ok_or_else(|| wrong("no variable of this name"))?;
    let outcome = if simulation.variables()[index].is_integer() {
        let value = value.parse().map_err(|_| wrong("expected an integer"))?;
        simulation.set_integer(index, value)
    } else {
        let value = value.parse().map_err(|_| wrong("expected a number"))?;
        simulation.set_real(index, value)
    };
    outcome.map_err(|error| wrong(&error.to_string()))
}

fn run(
    simulation: &mut Simulation,
    arguments: &Simulate,
    steps: u64,
    mut csv: impl Write,
) -> Outcome<Cost> {
    let is_output =
        |index: &usize| Causality::of(&simulation.variables()[*index]) == Causality::Output;
    let outputs: Vec<usize> = (0..simulation.variables().len())
        .filter(is_output)
        .collect();
    let unwritten = |error: io::Error| match &arguments.output {
        Some(path) => at(path, error),
        None => format!("standard output: {error}"),
    };
    let names = outputs
        .iter()
        .map(|index| simulation.variables()[*index].name.as_str());
    let header: Vec<&str> = std::iter::once("time").chain(names).collect();
    writeln!(csv, "{}", header.join(",")).map_err(unwritten)?;
    let bar = progress_bar(steps);
    let mut cost = Cost::default();
    for number in 0..=steps {
        if number > 0 {
            // A multiple rather than a sum, so that rounding does not add up.
            let until = (number as f64 * arguments.step).min(arguments.stop_time);
            let started = ThreadTime::now();
            let outcome = simulation.step(until);
            let cpu_time = started.elapsed();
            outcome.map_err(|failure| failure.to_string())?;
            cost.add(simulation.report(), cpu_time);
            bar.inc(1);
        }
        write!(csv, "{:?}", simulation.time()).map_err(unwritten)?;
        for index in &outputs {
            let value = simulation.real(*index).map_err(|error| error.to_string())?;
            write!(csv, ",{value:?}").map_err(unwritten)?;
        }
        writeln!(csv).map_err(unwritten)?;
    }
    csv.flush().map_err(unwritten)?;
    bar.finish_and_clear();
    Ok(cost)
}

/// A progress bar on standard error; invisible where that is no terminal.
fn progress_bar(steps: u64) -> ProgressBar {
    let template = "simulating {bar:40} {percent:>3} %  {eta} left";
    let style = ProgressStyle::with_template(template);
    ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
