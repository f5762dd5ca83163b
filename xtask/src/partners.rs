//! `cargo xtask partners`: the FMUs that Flexbody's are coupled with in tests and examples.

use anyhow::{Context, Result};

use crate::archive;
use crate::cargo::Workspace;
use crate::package::{Stage, platform};
use crate::process::{announced, prepared, run_quietly, shown};

/// The package, its library in an FMU, its program, and its folder among the FMUs.
const PARTNERS: &str = "partners";

/// Makes one FMU of every partner.
pub fn partners(workspace: &Workspace) -> Result<()> {
    let platform = platform()?;
    let program = workspace.program(PARTNERS)?;
    let library = workspace.library(PARTNERS)?;
    let stage = Stage::new(workspace)?;
    run_quietly(std::process::Command::new(program).arg(&stage.0))?;
    let listing = std::fs::read_dir(&stage.0)
        .with_context(|| format!("cannot read the folder {}", shown(&stage.0)))?;
    for entry in listing {
        let folder = entry?.path();
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        let file = format!("{PARTNERS}.{}", std::env::consts::DLL_EXTENSION);
        let inside = prepared(&folder.join("binaries").join(platform).join(file))?;
        std::fs::copy(&library, &inside)
            .with_context(|| format!("cannot copy the library {}", shown(&library)))?;
        let output = prepared(&workspace.target(&format!("fmu/{PARTNERS}/{name}.fmu")))?;
        let done = format!("packaged {}", shown(&output));
        announced("packaging", &done, || archive::pack(&folder, &output))?;
    }
    Ok(())
}
