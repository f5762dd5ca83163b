//! `cargo xtask describe`: what the FMU of a scene holds besides the library, and the committed
//! copy of it for the default scene.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail};
use fmu_package::{content, prepared, shown, write_whole};

use crate::cargo::Workspace;
use crate::package::PACKAGE;
use crate::process::{run, stdout};

/// The scene that stands for all in the repository.
pub const DEFAULT_SCENE: &str = "scenes/pendulum.json";
/// The committed picture of its FMU, without binaries.
const COMMITTED: &str = "modelDescription";
/// The committed JSON Schema of scenes.
const SCHEMA: &str = "scenes/scene.schema.json";

/// Writes what the FMU of the default scene holds besides the library, without its default experiment in motion, which may differ in the
/// last digits from machine to machine.
fn describe(workspace: &Workspace, binary: &Path, folder: &Path) -> Result<()> {
    run(Command::new(binary)
        .arg("describe")
        .arg(workspace.path(DEFAULT_SCENE))
        .arg("--output")
        .arg(folder)
        .arg("--no-animation"))
}

/// Regenerates the committed files.
///
/// # Errors
/// A file that cannot be generated or written.
pub fn regenerate(workspace: &Workspace) -> Result<()> {
    let binary = workspace.program(PACKAGE)?;
    let stage = workspace.stage("stage")?;
    describe(workspace, &binary, &stage.0)?;
    // Only now: a scene that is refused leaves the committed files as they are.
    let committed = workspace.path(COMMITTED);
    if committed.exists() {
        std::fs::remove_dir_all(&committed)
            .with_context(|| format!("cannot clear {}", shown(&committed)))?;
    }
    for (name, bytes) in content(&stage.0)? {
        write_whole(&prepared(&committed.join(name))?, bytes)?;
    }
    println!("wrote {}", shown(&committed));
    let schema = workspace.path(SCHEMA);
    std::fs::write(&schema, schema_text(&binary)?)
        .with_context(|| format!("cannot write {}", shown(&schema)))?;
    println!("wrote {}", shown(&schema));
    Ok(())
}

/// Compares committed files with freshly generated ones.
///
/// # Errors
/// A file that differs or cannot be generated.
pub fn check(workspace: &Workspace) -> Result<()> {
    let binary = workspace.program(PACKAGE)?;
    let stage = workspace.stage("stage")?;
    describe(workspace, &binary, &stage.0)?;
    let committed = workspace.path(COMMITTED);
    let [fresh, committed] = [content(&stage.0)?, content(&committed)?];
    let names: BTreeSet<&String> = fresh.keys().chain(committed.keys()).collect();
    let mut stale: Vec<String> = names
        .into_iter()
        .filter(|name| fresh.get(*name) != committed.get(*name))
        .map(|name| format!("{COMMITTED}/{name}"))
        .collect();
    let schema = std::fs::read(workspace.path(SCHEMA)).ok();
    if schema != Some(schema_text(&binary)?.into_bytes()) {
        stale.push(SCHEMA.to_owned());
    }
    if !stale.is_empty() {
        bail!(
            "not fresh: {}; run `cargo xtask describe`",
            stale.join(", ")
        );
    }
    Ok(())
}

fn schema_text(binary: &Path) -> Result<String> {
    stdout(Command::new(binary).arg("schema"))
}
