//! `cargo xtask view-bundle`: the committed program of pages that move, made from its sources and pinned packages of npm.

use std::path::Path;

use anyhow::{Context, Result};
use fmu_package::{announced, prepared, shown};

use crate::cargo::Workspace;
use crate::process::{run, run_quietly};
use crate::python::Python;

/// Sources, with the pinned packages.
const SOURCES: &str = "src/view/script";
/// Generated file.
const BUNDLE: &str = "src/view/bundle.txt";
/// Runs node and npm.
const NODE: &str = "xtask/node.py";

/// Builds the script anew. Packages are installed among the products, beside a copy of the sources.
///
/// # Errors
/// Node or a package cannot be installed, or the build fails.
pub fn regenerate(workspace: &Workspace) -> Result<()> {
    let python = Python::prepare_node(workspace)?;
    let folder = workspace.target("view-bundle");
    for entry in std::fs::read_dir(workspace.path(SOURCES))? {
        let from = entry?.path();
        if from.is_file() {
            let to = prepared(&folder.join(from.file_name().unwrap_or_default()))?;
            std::fs::copy(&from, &to).with_context(|| format!("cannot copy {}", shown(&from)))?;
        }
    }
    let program = |name: &str, arguments: &[&Path]| {
        let mut command = python.script(&workspace.path(NODE));
        command.arg(name).args(arguments).current_dir(&folder);
        command
    };
    announced("installing packages", "installed packages", || {
        let install = ["ci", "--no-audit", "--no-fund"].map(Path::new);
        run_quietly(&mut program("npm", &install))
    })?;
    run(&mut program(
        "node",
        &[Path::new("build.mjs"), &workspace.path(BUNDLE)],
    ))
}
