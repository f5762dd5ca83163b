//! What coupling costs: error against communication step in several masters, and the largest steps
//! that are stable, beside figures. Measured in Python, with masters of others.

use anyhow::{Context, Result};

use super::bench::Bench;
use crate::process::run;
use crate::python::Python;

/// Measures with real FMUs and writes the CSV files into the folder that it is given.
const PROGRAM: &str = "tests/masters/coupling.py";

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let python = Python::prepare_masters(bench.workspace())?;
    let xtask = std::env::current_exe().context("cannot find this program itself")?;
    let mut command = python.script(&bench.workspace().path(PROGRAM));
    run(command.arg(bench.output("")).env("FLEXBODY_XTASK", xtask))
}
