//! Runs on a cluster of Dask: the FMU of the scene goes to the workers once, `flexbody.cluster` in Python hands runs out and results back.

use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

use anyhow::{Context, Result, bail};
use serde_json::{Value, json};

use super::{Common, Series, Sweep};
use crate::packaging;
use crate::reading::is_fmu;

/// Says which Python has the package: its own `flexbody` sets it.
const PYTHON: &str = "FLEXBODY_PYTHON";

/// Runs the missing runs on a cluster, and passes each finished one to `take`.
///
/// # Errors
/// A cluster that cannot be reached, or an error of `take`.
pub fn run(
    arguments: &Sweep,
    common: &Common,
    address: &str,
    missing: &[usize],
    take: &mut impl FnMut(usize, Result<Series, String>) -> Result<()>,
) -> Result<()> {
    let stage = packaging::stage("sweep")?;
    let fmu = fmu(arguments, &stage.0)?;
    let python = std::env::var_os(PYTHON).unwrap_or_else(|| "python3".into());
    let mut command = Command::new(&python);
    command.args(["-m", "flexbody.cluster", "--scheduler", address]);
    if let Some(jobs) = arguments.jobs {
        command.args(["--workers", &jobs.to_string()]);
    }
    let mut child = command
        .arg(&fmu)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .with_context(|| format!("--scheduler: cannot start {}", Path::new(&python).display()))?;
    let pipes = child.stdin.take().zip(child.stdout.take());
    let (input, output) = pipes.context("a process without pipes")?;
    let taken = thread::scope(|scope| {
        // What is written and not read would keep both waiting for each other.
        scope.spawn(move || write(common, missing, input));
        let taken = read(BufReader::new(output), take);
        if taken.is_err() {
            // Nobody waits for the rest.
            let _ = child.kill();
        }
        taken
    });
    let status = child.wait()?;
    let left = missing.len().saturating_sub(taken?);
    if !status.success() {
        bail!("--scheduler: flexbody.cluster failed ({status}); is flexbody[cluster] installed?");
    }
    if left > 0 {
        bail!("--scheduler: {left} runs did not come back");
    }
    Ok(())
}

/// Hands results on as they come, and returns their number.
fn read(
    output: impl BufRead,
    take: &mut impl FnMut(usize, Result<Series, String>) -> Result<()>,
) -> Result<usize> {
    let mut count = 0;
    for line in output.lines() {
        let line = line.context("--scheduler: reading results")?;
        let found = serde_json::from_str(&line).ok();
        let result = found.and_then(|found: Value| {
            let run = usize::try_from(found["run"].as_u64()?).ok()?;
            match found["error"].as_str() {
                Some(reason) => Some((run, Err(reason.to_owned()))),
                None => Some((run, Ok(Series::from_json(&found)?))),
            }
        });
        let (run, series) =
            result.with_context(|| format!("--scheduler: expected a result, found {line:?}"))?;
        take(run, series)?;
        count += 1;
    }
    Ok(count)
}

/// The FMU itself, or that of the scene.
fn fmu(arguments: &Sweep, stage: &Path) -> Result<PathBuf> {
    if is_fmu(&arguments.scene) {
        return Ok(arguments.scene.clone());
    }
    let output = stage.join("sweep.fmu");
    packaging::package(&packaging::Package {
        within: arguments.within.clone(),
        scene: arguments.scene.clone(),
        output: Some(output.clone()),
        platform: Vec::new(),
        no_terminals: false,
        no_animation: true,
        parts: arguments.parts.clone(),
    })?;
    Ok(output)
}

/// Tells what all runs have in common, then every run. Where the other side is gone it has told why, or its end does.
fn write(common: &Common, missing: &[usize], input: impl Write) -> std::io::Result<()> {
    let fixed = common.fixed.iter();
    let fixed = fixed.map(|(_, name, value)| (name.clone(), Value::from(*value)));
    let fixed: serde_json::Map<_, _> = fixed.collect();
    let mut input = BufWriter::new(input);
    let header = json!({
        "inputs": common.axes.names(),
        "outputs": common.names,
        "stop_time": common.points.last(),
        "step": common.step,
        "fixed": fixed,
    });
    writeln!(input, "{header}")?;
    for &run in missing {
        writeln!(
            input,
            "{}",
            json!({"run": run, "values": common.axes.values(run)})
        )?;
    }
    input.flush()
}
