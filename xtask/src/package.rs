//! `cargo xtask package`: an FMU is the description of a scene beside the one compiled library.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::cargo::Workspace;
use crate::process::{announced, prepared, shown};
use crate::{archive, describe};

/// Name of the library in an FMU; the `modelIdentifier` of every scene.
const MODEL_IDENTIFIER: &str = "flexbody";

/// Makes an FMU of a scene, says where, and returns its path.
pub fn package(workspace: &Workspace, scene: &Path, output: Option<&Path>) -> Result<PathBuf> {
    check_readable(scene)?;
    if let Some(output) = output
        && output.extension() != Some("fmu".as_ref())
    {
        bail!(
            "--output: expected a file name ending in .fmu, found {}",
            output.display()
        );
    }
    let platform = platform()?;
    let binary = workspace.binary()?;
    let library = workspace.library(MODEL_IDENTIFIER)?;
    let stage = Stage::new(workspace)?;
    describe::describe(&binary, scene, &stage.0)?;
    let inside = prepared(&stage.0.join("binaries").join(platform).join(format!(
        "{MODEL_IDENTIFIER}.{}",
        std::env::consts::DLL_EXTENSION
    )))?;
    std::fs::copy(&library, &inside)
        .with_context(|| format!("cannot copy the library {}", shown(&library)))?;
    let output = match output {
        Some(output) => prepared(output)?,
        None => prepared(&workspace.target(&format!("fmu/{}.fmu", scene_name(&stage.0)?)))?,
    };
    let done = format!("packaged {}", shown(&output));
    announced("packaging", &done, || archive::pack(&stage.0, &output))?;
    Ok(output)
}

/// A folder to build in, removed when it goes out of scope.
pub struct Stage(pub PathBuf);

impl Stage {
    /// An empty folder among the products, of this process alone.
    pub fn new(workspace: &Workspace) -> Result<Self> {
        let folder = workspace.target(&format!("fmu/stage-{}", std::process::id()));
        // A crashed process with the same number may have left one behind.
        if folder.exists() {
            std::fs::remove_dir_all(&folder)
                .with_context(|| format!("cannot clear {}", shown(&folder)))?;
        }
        std::fs::create_dir_all(&folder)
            .with_context(|| format!("cannot create the folder {}", shown(&folder)))?;
        Ok(Self(folder))
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        // Nothing depends on the removal, and a failing drop could not be reported.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Refuses a scene that cannot be read before a minute goes into compiling.
pub fn check_readable(path: &Path) -> Result<()> {
    std::fs::File::open(path)
        .map(drop)
        .with_context(|| format!("cannot read {}", path.display()))
}

/// Folder of the host's binaries: FMI 2.0 names where it has one, else those of FMI 3.0.
pub fn platform() -> Result<&'static str> {
    match (std::env::consts::OS, std::env::consts::ARCH) {
        ("linux", "x86_64") => Ok("linux64"),
        ("windows", "x86_64") => Ok("win64"),
        ("macos", "x86_64") => Ok("darwin64"),
        ("linux", "aarch64") => Ok("aarch64-linux"),
        ("macos", "aarch64") => Ok("aarch64-darwin"),
        (system, processor) => bail!(
            "expected Linux, macOS or Windows on x86_64, or Linux or macOS on aarch64, \
             found {system} on {processor}"
        ),
    }
}

/// The name in the validated scene that `flexbody describe` wrote.
fn scene_name(described: &Path) -> Result<String> {
    let file = described.join("resources").join("scene.json");
    let text =
        std::fs::read_to_string(&file).with_context(|| format!("cannot read {}", shown(&file)))?;
    let scene: Value =
        serde_json::from_str(&text).with_context(|| format!("{} is no JSON", shown(&file)))?;
    let name = scene["name"].as_str();
    name.map(str::to_owned)
        .with_context(|| format!("{}: expected a name, found {}", shown(&file), scene["name"]))
}
