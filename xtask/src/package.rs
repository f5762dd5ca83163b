//! `cargo xtask package`: an FMU is the description of a scene beside the one compiled library.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::cargo::Workspace;
use crate::platform::Platform;
use crate::process::{announced, prepared, shown};
use crate::product::Product;
use crate::{archive, describe};

/// What says which variables make up a port; only FMUs of scenes with ports have it.
const TERMINALS: &str = "terminalsAndIcons";
/// The package that is every scene's library, and thereby its `modelIdentifier`.
pub const PACKAGE: &str = "flexbody";

/// What an FMU may be without.
#[derive(Clone, Copy)]
pub struct Parts {
    /// Terminals.
    pub terminals: bool,
    /// The default experiment in motion.
    pub animation: bool,
}

impl Parts {
    /// Everything.
    pub const ALL: Self = Self {
        terminals: true,
        animation: true,
    };
}

/// Makes an FMU of a scene for some platforms, or for the host where none is named, with these parts,
/// says where, and returns its path.
pub fn package(
    workspace: &Workspace,
    scene: &Path,
    output: Option<&Path>,
    platforms: &[Platform],
    parts: Parts,
) -> Result<PathBuf> {
    check_readable(scene)?;
    let output = output.map(checked_output).transpose()?;
    let platforms = match platforms {
        [] => vec![Platform::host()?],
        named => named.to_vec(),
    };
    let product = Product::new(workspace, &platforms)?;
    let stage = Stage::new(workspace, "stage")?;
    describe::describe(&product.program, scene, &stage.0, parts.animation)?;
    let folder = stage.0.join(TERMINALS);
    if !parts.terminals && folder.exists() {
        std::fs::remove_dir_all(&folder)
            .with_context(|| format!("cannot remove {}", shown(&folder)))?;
    }
    product.put(&stage.0)?;
    let output = match output {
        Some(output) => output,
        None => prepared(&workspace.target(&format!("fmu/{}.fmu", scene_name(&stage.0)?)))?,
    };
    let done = format!("packaged {}", shown(&output));
    announced("packaging", &done, || archive::pack(&stage.0, &output))?;
    Ok(output)
}

/// The file to write an FMU to, absolute, unless its name does not say that it is one.
pub fn checked_output(file: &Path) -> Result<PathBuf> {
    if file.extension() != Some("fmu".as_ref()) {
        bail!(
            "--output: expected a file name ending in .fmu, found {}",
            file.display()
        );
    }
    prepared(file)
}

/// Puts the library of a package among the binaries of an FMU, named like the package.
pub fn put_library(library: &Path, folder: &Path, package: &str, platform: Platform) -> Result<()> {
    let inside = folder.join("binaries").join(platform.folder());
    let inside = prepared(&inside.join(format!("{package}{}", platform.suffix())))?;
    std::fs::copy(library, &inside)
        .map(drop)
        .with_context(|| format!("cannot copy the library {}", shown(library)))
}

/// A folder to build in, removed when it goes out of scope.
pub struct Stage(pub PathBuf);

impl Stage {
    /// An empty folder among the products, of this process and this purpose alone.
    pub fn new(workspace: &Workspace, purpose: &str) -> Result<Self> {
        let folder = workspace.target(&format!("fmu/{purpose}-{}", std::process::id()));
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
