//! `cargo xtask example-fmus`: the FMUs that Flexbody's are coupled with in tests and examples.

use std::path::Path;

use anyhow::{Context, Result};
use fmu_package::{Platform, announced, pack, prepared, shown};

use crate::cargo::Workspace;
use crate::licenses;
use crate::package::put_library;
use crate::process::run_quietly;

/// The package and its program.
const EXAMPLES: &str = "example-fmus";
/// Its library, and thereby their `modelIdentifier`.
const IDENTIFIER: &str = "example_fmus";

/// Makes one FMU of every example in a folder.
///
/// # Errors
/// A build fails, or a file cannot be written.
pub fn example_fmus(workspace: &Workspace, output: Option<&Path>) -> Result<()> {
    let platform = Platform::host()?;
    let program = workspace.program(EXAMPLES)?;
    let library = workspace.library(EXAMPLES, platform)?;
    let stage = workspace.stage("stage")?;
    run_quietly(std::process::Command::new(program).arg(&stage.0))?;
    let output = match output {
        Some(output) => output.to_owned(),
        None => workspace.target("fmu/examples"),
    };
    let listing = std::fs::read_dir(&stage.0)
        .with_context(|| format!("cannot read the folder {}", shown(&stage.0)))?;
    for entry in listing {
        let folder = entry?.path();
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        licenses::put(workspace, EXAMPLES, &[platform], &folder)?;
        put_library(&library, &folder, IDENTIFIER, platform)?;
        let output = prepared(&output.join(format!("{name}.fmu")))?;
        let done = format!("packaged {}", shown(&output));
        announced("packaging", &done, || pack(&folder, &output))?;
    }
    Ok(())
}
