//! Running other programs.

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use fmu_package::shown;

/// Runs a command whose output the user sees.
///
/// # Errors
/// The command cannot be started or fails.
pub fn run(command: &mut Command) -> Result<()> {
    let status = command
        .status()
        .with_context(|| format!("cannot start {}", name(command)))?;
    if !status.success() {
        bail!("{} failed ({status})", name(command));
    }
    Ok(())
}

/// Runs a command and returns its standard output. Standard error goes to the user.
///
/// # Errors
/// The command cannot be started, fails, or prints text that is not UTF-8.
pub fn stdout(command: &mut Command) -> Result<String> {
    let output = command
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| format!("cannot start {}", name(command)))?;
    if !output.status.success() {
        bail!("{} failed ({})", name(command), output.status);
    }
    String::from_utf8(output.stdout)
        .with_context(|| format!("{} printed something other than UTF-8", name(command)))
}

/// Runs a command silently.
///
/// # Errors
/// The command cannot be started or fails. The error holds its output.
pub fn run_quietly(command: &mut Command) -> Result<()> {
    let output = command
        .output()
        .with_context(|| format!("cannot start {}", name(command)))?;
    if !output.status.success() {
        let printed = String::from_utf8_lossy(&output.stdout);
        let errors = String::from_utf8_lossy(&output.stderr);
        bail!(
            "{} failed ({})\n{printed}{errors}",
            name(command),
            output.status
        );
    }
    Ok(())
}

/// Runs a command and returns its output. `None` if it took longer than `most` and was stopped.
///
/// # Errors
/// The command cannot be started.
pub fn output_within(command: &mut Command, most: Duration) -> Result<Option<Output>> {
    let started = Instant::now();
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command
        .spawn()
        .with_context(|| format!("cannot start {}", name(command)))?;
    while child.try_wait()?.is_none() {
        if started.elapsed() > most {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child.wait_with_output().map(Some).map_err(Into::into)
}

fn name(command: &Command) -> String {
    let program = Path::new(command.get_program());
    let program = program.file_stem().unwrap_or(program.as_os_str());
    let first = command.get_args().next().unwrap_or_default();
    format!("`{} {} …`", program.display(), shown(Path::new(first)))
}
