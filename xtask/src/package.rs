//! `cargo xtask package`: builds what FMUs are made of, then the program packages.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use packing::{Platform, prepared, shown};

use crate::cargo::Workspace;
use crate::process::run;
use crate::product::Product;

/// The package that is every scene's library, and thereby its `modelIdentifier`.
pub const PACKAGE: &str = "flexbody";

/// Makes an FMU of a scene for some platforms, or for the host where none is named, with further arguments of the program.
pub fn package(
    workspace: &Workspace,
    scene: &Path,
    output: Option<&Path>,
    platforms: &[Platform],
    options: &[&str],
) -> Result<()> {
    check_readable(scene)?;
    let platforms = match platforms {
        [] => vec![Platform::host()?],
        named => named.to_vec(),
    };
    let product = Product::new(workspace, &platforms)?;
    let output = match output {
        Some(output) => output.to_owned(),
        None => prepared(&workspace.target("fmu").join("."))?,
    };
    let mut command = product.packager();
    command.arg(scene).arg("--output").arg(output).args(options);
    run(&mut command)
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
