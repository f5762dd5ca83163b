//! `cargo xtask simulate`: one command for scenes and FMUs, one CSV format, one picture.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use fmu_package::{SCENE, prepared, shown};

use crate::cargo::Workspace;
use crate::package::{PACKAGE, check_readable};
use crate::process::run;
use crate::python::Python;

/// Arguments of a simulation: files to read and to write.
#[derive(clap::Args)]
pub struct Arguments {
    /// A scene (runs natively) or an FMU (runs under fmpy)
    #[arg(value_name = "FILE.json|FILE.fmu")]
    file: PathBuf,
    /// Simulated time, s [default: that of the scene's experiment]
    #[arg(long, value_name = "T", value_parser = duration)]
    stop_time: Option<f64>,
    /// Communication step, s [default: that of the scene's experiment]
    #[arg(long, value_name = "H", value_parser = duration)]
    step: Option<f64>,
    /// Start value of a parameter or an input
    #[arg(long, value_name = "name=value", num_args = 1.., value_parser = assignment)]
    set: Vec<String>,
    /// Inputs that vary in time: a column `time`, then one for every input, named like it. Inputs follow
    /// straight lines from row to row; two rows of one time are a jump
    #[arg(long, value_name = "FILE.csv")]
    input: Option<PathBuf>,
    /// Where to write the outputs [default: target/simulate/<name>.csv]
    #[arg(long, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    /// Draws the run: bodies, paths of markers, reactions, energies
    #[arg(long, value_name = "FILE.png")]
    plot: Option<PathBuf>,
}

/// Simulates to a CSV file and prints its path.
///
/// # Errors
/// A build or the simulation fails.
pub fn simulate(workspace: &Workspace, arguments: &Arguments) -> Result<()> {
    let file = &arguments.file;
    check_readable(file)?;
    if let Some(input) = &arguments.input {
        check_readable(input)?;
    }
    let name = file.file_stem().unwrap_or_default().display();
    let output = match &arguments.output {
        Some(output) => prepared(output)?,
        None => prepared(&workspace.target(&format!("simulate/{name}.csv")))?,
    };
    let shapes = output.with_extension("shapes.jsonl");
    let is_drawn = arguments.plot.is_some();
    let extension = file.extension().and_then(|extension| extension.to_str());
    let has_shapes = match extension {
        Some("json") => {
            let mut command = native(workspace, file, is_drawn.then_some(&shapes))?;
            simulated(
                arguments
                    .settings(&mut command)
                    .arg("--output")
                    .arg(&output),
                file,
            )?;
            is_drawn
        }
        Some("fmu") => {
            let mut command = fmpy(workspace, &Python::prepare(workspace)?, file);
            simulated(
                arguments
                    .settings(&mut command)
                    .arg("--output")
                    .arg(&output),
                file,
            )?;
            is_drawn && draws_scene(workspace, arguments, &shapes)?
        }
        _ => bail!(
            "expected a file ending in .json or .fmu, found {}",
            file.display()
        ),
    };
    println!("wrote {}", shown(&output));
    if let Some(picture) = &arguments.plot {
        let picture = prepared(picture)?;
        let python = Python::prepare(workspace)?;
        let shapes = has_shapes.then_some(&*shapes);
        run(plot(workspace, &python, &output, shapes, &picture)
            .arg("--title")
            .arg(name.to_string()))?;
        println!("wrote {}", shown(&picture));
    }
    Ok(())
}

/// Runs the program with these arguments, and builds it if necessary.
///
/// # Errors
/// The build or the program fails.
pub fn pass_on(workspace: &Workspace, command: &str, arguments: &[OsString]) -> Result<()> {
    let mut program = Command::new(workspace.program(PACKAGE)?);
    run(program.arg(command).args(arguments))
}

impl Arguments {
    /// Passes on what both ways of simulating understand.
    fn settings<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        for (name, value) in [("--stop-time", self.stop_time), ("--step", self.step)] {
            command.args(value.map(|value| format!("{name}={value}")));
        }
        for assignment in &self.set {
            command.arg("--set").arg(assignment);
        }
        if let Some(input) = &self.input {
            command.arg("--input").arg(input);
        }
        command
    }
}

fn simulated(command: &mut Command, file: &Path) -> Result<()> {
    run(command).with_context(|| format!("{} was not simulated", file.display()))
}

/// Finds the shapes of bodies for the picture of an FMU's run, which outputs alone do not tell: by the same run of the
/// scene that it holds. False where it holds none.
fn draws_scene(workspace: &Workspace, arguments: &Arguments, shapes: &Path) -> Result<bool> {
    let fmu = &arguments.file;
    if !fmu_package::read(fmu)?.contains_key(SCENE) {
        return Ok(false);
    }
    let mut command = native(workspace, fmu, Some(shapes))?;
    let command = arguments.settings(&mut command).stdout(Stdio::null());
    simulated(command, fmu)?;
    Ok(true)
}

/// Builds the command that simulates a scene or the scene of an FMU natively. It writes shapes for a picture if
/// `shapes` names a file.
///
/// # Errors
/// The build fails.
pub fn native(
    workspace: &Workspace,
    scene: &Path,
    shapes: Option<impl AsRef<Path>>,
) -> Result<Command> {
    let mut command = Command::new(workspace.program(PACKAGE)?);
    command.arg("simulate").arg(scene);
    if let Some(shapes) = shapes {
        command.arg("--shapes").arg(shapes.as_ref());
    }
    Ok(command)
}

/// A command that simulates an FMU with fmpy.
pub fn fmpy(workspace: &Workspace, python: &Python, fmu: &Path) -> Command {
    let mut command = python.script(&workspace.path("tests/fmpy/simulate.py"));
    command.arg(fmu);
    command
}

/// A command that draws a run: its outputs, and its shapes where there are any.
pub fn plot(
    workspace: &Workspace,
    python: &Python,
    run: &Path,
    shapes: Option<&Path>,
    picture: &Path,
) -> Command {
    let mut command = python.script(&workspace.path("tests/fmpy/plot.py"));
    command.arg(run).arg(picture);
    if let Some(shapes) = shapes {
        command.arg("--shapes").arg(shapes);
    }
    command
}

fn duration(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if f64::is_finite(value) && value > 0.0 => Ok(value),
        _ => Err("expected a positive number of seconds".into()),
    }
}

fn assignment(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() && value.parse::<f64>().is_ok() => Ok(text.into()),
        _ => Err("expected name=number".into()),
    }
}
