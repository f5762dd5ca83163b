//! `cargo xtask simulate`: one command for scenes and FMUs, one CSV format, one picture.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::cargo::Workspace;
use crate::package::check_readable;
use crate::process::{prepared, run, shown};
use crate::python::Python;

/// What to simulate and where to write.
#[derive(clap::Args)]
pub struct Arguments {
    /// A scene (runs natively) or an FMU (runs under fmpy)
    #[arg(value_name = "FILE.json|FILE.fmu")]
    file: PathBuf,
    /// Simulated time, s
    #[arg(long, value_name = "T", value_parser = duration)]
    stop_time: f64,
    /// Communication step, s
    #[arg(long, value_name = "H", value_parser = duration)]
    step: f64,
    /// Start value of a parameter or an input
    #[arg(long, value_name = "name=value", num_args = 1.., value_parser = assignment)]
    set: Vec<String>,
    /// Where to write the outputs [default: target/simulate/<name>.csv]
    #[arg(long, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    /// Draws the run
    #[arg(long, value_name = "FILE.png")]
    plot: Option<PathBuf>,
}

/// Simulates to a CSV file and says where it is.
pub fn simulate(workspace: &Workspace, arguments: &Arguments) -> Result<()> {
    let file = &arguments.file;
    check_readable(file)?;
    let mut command = match file.extension().and_then(|extension| extension.to_str()) {
        Some("json") => {
            let mut command = Command::new(workspace.binary()?);
            command.arg("simulate").arg(file);
            command
        }
        Some("fmu") => fmpy(workspace, &Python::prepare(workspace)?, file),
        _ => bail!(
            "expected a file ending in .json or .fmu, found {}",
            file.display()
        ),
    };
    let name = file.file_stem().unwrap_or_default().display();
    let output = match &arguments.output {
        Some(output) => prepared(output)?,
        None => prepared(&workspace.target(&format!("simulate/{name}.csv")))?,
    };
    command
        .arg("--stop-time")
        .arg(arguments.stop_time.to_string());
    command.arg("--step").arg(arguments.step.to_string());
    for assignment in &arguments.set {
        command.arg("--set").arg(assignment);
    }
    run(command.arg("--output").arg(&output))
        .with_context(|| format!("{} was not simulated", file.display()))?;
    println!("wrote {}", shown(&output));
    if let Some(picture) = &arguments.plot {
        let picture = prepared(picture)?;
        run(&mut plot(
            workspace,
            &Python::prepare(workspace)?,
            file,
            &output,
            &picture,
        ))?;
        println!("wrote {}", shown(&picture));
    }
    Ok(())
}

/// A command that simulates an FMU with fmpy.
pub fn fmpy(workspace: &Workspace, python: &Python, fmu: &Path) -> Command {
    let mut command = python.script(&workspace.path("tests/fmpy/simulate.py"));
    command.arg(fmu);
    command
}

/// A command that draws a run of a scene or an FMU.
pub fn plot(
    workspace: &Workspace,
    python: &Python,
    model: &Path,
    run: &Path,
    picture: &Path,
) -> Command {
    let mut command = python.script(&workspace.path("tests/fmpy/plot.py"));
    command.arg(model).arg(run).arg(picture);
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
