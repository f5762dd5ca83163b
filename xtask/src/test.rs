//! `cargo xtask test`: every check there is, the quick ones first.

use std::time::Instant;

use anyhow::{Context, Result};

use crate::cargo::Workspace;
use crate::process::run;
use crate::python::Python;
use crate::{describe, fuzz};

type Step = (&'static str, fn(&Workspace) -> Result<()>);

/// The checks in order.
const STEPS: [Step; 7] = [
    ("formatting", formatting),
    ("clippy", clippy),
    ("Rust tests", rust_tests),
    ("generated files", describe::check),
    ("FMUs under fmpy", fmpy_tests),
    ("coupled FMUs under other masters", master_tests),
    ("fuzzing", fuzz::test),
];

/// Runs every check and stops at the first that fails.
pub fn test(workspace: &Workspace) -> Result<()> {
    let started = Instant::now();
    for (index, (name, step)) in STEPS.iter().enumerate() {
        let place = format!("[{}/{}] {name}", index + 1, STEPS.len());
        eprintln!("{place}");
        let step_started = Instant::now();
        step(workspace).with_context(|| format!("{place} failed"))?;
        eprintln!(
            "{place}: passed in {:.1} s\n",
            step_started.elapsed().as_secs_f64()
        );
    }
    eprintln!(
        "all checks passed in {:.1} s",
        started.elapsed().as_secs_f64()
    );
    Ok(())
}

fn formatting(workspace: &Workspace) -> Result<()> {
    run(workspace.cargo("fmt").args(["--all", "--check"]))
}

fn clippy(workspace: &Workspace) -> Result<()> {
    run(workspace.cargo("clippy").args([
        "--workspace",
        "--all-targets",
        "--",
        "--deny",
        "warnings",
    ]))
}

fn rust_tests(workspace: &Workspace) -> Result<()> {
    run(workspace.cargo("test").arg("--workspace"))
}

fn fmpy_tests(workspace: &Workspace) -> Result<()> {
    pytest(&Python::prepare(workspace)?, workspace, "tests/fmpy")
}

/// Not all masters have packages for other platforms than this one.
fn master_tests(workspace: &Workspace) -> Result<()> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        eprintln!("skipped: the masters' packages are pinned for Linux on x86-64");
        return Ok(());
    }
    pytest(
        &Python::prepare_masters(workspace)?,
        workspace,
        "tests/masters",
    )
}

fn pytest(python: &Python, workspace: &Workspace, tests: &str) -> Result<()> {
    let xtask = std::env::current_exe().context("cannot find this program itself")?;
    // The tests package their FMUs with this very program.
    run(python
        .module("pytest")
        .args(["-p", "no:cacheprovider", "--durations", "5", "-rs"])
        .arg(workspace.path(tests))
        .env("FLEXBODY_XTASK", xtask))
}
