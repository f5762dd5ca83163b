//! Fuzzing in `cargo xtask test`: a short run of every target in `crates/fuzz/`, and a thousand instances under
//! AddressSanitizer.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use anyhow::{Context, Result, bail};
use fmu_package::{prepared, shown};
use serde_json::Value;

use crate::cargo::{Workspace, executables};
use crate::process;

/// Fuzz targets, the program that only AddressSanitizer watches, and the one that writes what `state` starts from: saved
/// states of another format than today's are refused before much is read of them.
const TARGETS: [&str; 4] = ["scene", "container", "state", "calls"];
const LIVES: &str = "lives";
const SEEDS: &str = "seeds";
/// Where those states are.
const STATES: &str = "fuzz/seeds/state";
/// Where the ready scenes are written without spaces, and the longest input that is made of them: what is longer would
/// be cut off, and refused before much is read of it. The dozen rigid bodies of a Stewart platform are longer: with
/// sanitizers it takes more than a minute to find out that they do not fit.
const SCENES: &str = "fuzz/seeds/scene";
const LONGEST: usize = 4096;

/// How long each target runs, s.
const SECONDS: u32 = 20;

/// Compiler flags that cargo-fuzz passes as well, so that the same targets serve both.
const FLAGS: [&str; 7] = [
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    "-Cllvm-args=-sanitizer-coverage-trace-compares",
    "--cfg fuzzing",
    "-Zsanitizer=address",
];

/// Why this machine cannot fuzz: no sanitizer, no C++ compiler.
fn hindrance() -> Option<&'static str> {
    let supported =
        cfg!(target_os = "linux") && cfg!(any(target_arch = "x86_64", target_arch = "aarch64"));
    if !supported {
        return Some("fuzzing is set up for Linux on x86-64 and AArch64 only");
    }
    let compiles = process::run_quietly(Command::new("c++").arg("--version")).is_ok();
    (!compiles).then_some("libFuzzer needs a C++ compiler named c++")
}

/// Runs what there is to run; whether there is anything, which is said.
///
/// # Errors
/// A target cannot be built, or has found something.
pub fn test(workspace: &Workspace) -> Result<bool> {
    if let Some(reason) = hindrance() {
        eprintln!("skipped: {reason}");
        return Ok(false);
    }
    let programs = build(workspace)?;
    process::run(&mut program(&programs, LIVES)?)?;
    process::run(program(&programs, SEEDS)?.arg(workspace.target(STATES)))?;
    compact_scenes(workspace)?;
    let dictionary = dictionary(workspace)?;
    let start = |target| start(workspace, program(&programs, target)?, target, &dictionary);
    let runs = TARGETS.map(|target| (target, start(target)));
    for (target, run) in runs {
        finish(target, run?)?;
    }
    Ok(true)
}

/// Builds all programs of `crates/fuzz/` with sanitizers.
fn build(workspace: &Workspace) -> Result<Vec<PathBuf>> {
    let host = process::stdout(Command::new("rustc").arg("-vV"))?;
    let host = host.lines().find_map(|line| line.strip_prefix("host: "));
    let mut command = workspace.cargo("build");
    command
        .args([
            "--release",
            "--target",
            host.context("rustc names no host")?,
        ])
        .arg("--manifest-path")
        .arg(workspace.path("crates/fuzz/Cargo.toml"))
        .arg("--target-dir")
        .arg(workspace.target("fuzz"))
        .env("RUSTFLAGS", FLAGS.join(" "))
        // Sanitizers are not stable, yet every stable compiler has them.
        .env("RUSTC_BOOTSTRAP", "1");
    executables(&mut command).context("building the fuzz targets")
}

fn program(programs: &[PathBuf], name: &str) -> Result<Command> {
    let found = programs.iter().find(|path| path.ends_with(name));
    found
        .map(Command::new)
        .with_context(|| format!("fuzz/ builds no {name}"))
}

/// Starts a target on its corpus; what it finds there goes below `target/`.
fn start(
    workspace: &Workspace,
    mut program: Command,
    target: &str,
    dictionary: &Path,
) -> Result<Child> {
    let found = workspace.target(&format!("fuzz/found/{target}"));
    let failures = workspace.target(&format!("fuzz/failures/{target}-"));
    prepared(&failures)?;
    std::fs::create_dir_all(&found)
        .with_context(|| format!("cannot create the folder {}", shown(&found)))?;
    program.arg(found);
    program.arg(workspace.path(&format!("crates/fuzz/corpus/{target}")));
    if target == "state" {
        program.arg(workspace.target(STATES));
    }
    if target == "scene" {
        program.arg(workspace.target(SCENES));
        program.arg(format!("-dict={}", dictionary.display()));
        program.arg(format!("-max_len={LONGEST}"));
    }
    program
        // Twice as fast, and there is no pointer to what a function left on its stack.
        .env("ASAN_OPTIONS", "detect_stack_use_after_return=0")
        .arg(format!("-max_total_time={SECONDS}"))
        .arg(format!("-artifact_prefix={}", failures.display()))
        .args([
            "-timeout=300",
            "-rss_limit_mb=4096",
            "-print_final_stats=1",
            "-verbosity=0",
        ])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .with_context(|| format!("cannot start the fuzz target {target}"))
}

/// Waits for a target, and says how far it came or what it found.
fn finish(target: &str, run: Child) -> Result<()> {
    let output = run.wait_with_output()?;
    let text = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        bail!(
            "the fuzz target {target} failed ({})\n{text}",
            output.status
        );
    }
    let count = text
        .lines()
        .find_map(|line| line.strip_prefix("stat::number_of_executed_units:"));
    let count = count.context("libFuzzer printed no statistics")?;
    eprintln!("{target}: {} inputs in {SECONDS} s", count.trim());
    Ok(())
}

/// Writes the ready scenes without spaces, where they are not too long.
fn compact_scenes(workspace: &Workspace) -> Result<()> {
    let folder = workspace.path("scenes");
    let scenes = std::fs::read_dir(&folder)
        .with_context(|| format!("cannot read the folder {}", shown(&folder)))?;
    for scene in scenes {
        let from = scene?.path();
        let file = from.to_string_lossy();
        if !file.ends_with(".json") || file.ends_with(".schema.json") {
            continue;
        }
        let text = std::fs::read_to_string(&from)
            .with_context(|| format!("cannot read {}", shown(&from)))?;
        let scene: Value =
            serde_json::from_str(&text).with_context(|| format!("{} is no JSON", shown(&from)))?;
        let compact = scene.to_string();
        if compact.len() > LONGEST {
            continue;
        }
        let name = from.file_name().context("a scene without a name")?;
        let to = prepared(&workspace.target(SCENES).join(name))?;
        std::fs::write(&to, compact).with_context(|| format!("cannot write {}", shown(&to)))?;
    }
    Ok(())
}

/// The words of the scene format, for libFuzzer to put together.
fn dictionary(workspace: &Workspace) -> Result<PathBuf> {
    let schema = workspace.path("scenes/scene.schema.json");
    let text = std::fs::read_to_string(&schema)
        .with_context(|| format!("cannot read {}", shown(&schema)))?;
    let schema: Value = serde_json::from_str(&text).context("the schema is no JSON")?;
    let mut words = BTreeSet::new();
    collect(&schema, &mut words);
    let lines = words.iter().map(|word| format!("\"\\\"{word}\\\"\"\n"));
    let path = prepared(&workspace.target("fuzz/scene.dict"))?;
    std::fs::write(&path, lines.collect::<String>())
        .with_context(|| format!("cannot write {}", shown(&path)))?;
    Ok(path)
}

/// Names of properties and of the values that they may have.
fn collect<'a>(schema: &'a Value, words: &mut BTreeSet<&'a str>) {
    let children = match schema {
        Value::Object(entries) => {
            let keys = schema["properties"].as_object().into_iter().flatten();
            words.extend(keys.map(|(key, _)| key.as_str()));
            let values = schema["enum"].as_array().into_iter().flatten();
            words.extend(values.chain([&schema["const"]]).filter_map(Value::as_str));
            entries.values().collect::<Vec<_>>()
        }
        Value::Array(items) => items.iter().collect(),
        _ => return,
    };
    for child in children {
        collect(child, words);
    }
}
