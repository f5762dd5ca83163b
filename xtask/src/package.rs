//! `cargo xtask package`: builds what FMUs are made of, then the program packages.

use std::path::Path;

use anyhow::{Context, Result};
use fmu_package::{BINARIES, Platform, prepared, shown};

use crate::cargo::Workspace;
use crate::process::run;
use crate::product::Product;

/// The package that is every scene's library, and thereby its `modelIdentifier`.
pub const PACKAGE: &str = "flexbody";

/// Makes an FMU of a scene for some platforms, or for the host where none is named, with further arguments of the program.
///
/// # Errors
/// A build or the program fails.
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
        None => {
            let folder = workspace.target("fmu");
            let made = std::fs::create_dir_all(&folder);
            made.with_context(|| format!("cannot create the folder {}", shown(&folder)))?;
            folder
        }
    };
    let mut command = product.packager();
    command.arg(scene).arg("--output").arg(output).args(options);
    run(&mut command)
}

/// Copies the library of a package to the binaries of an FMU, under the package's name.
///
/// # Errors
/// A file that cannot be written.
pub fn put_library(library: &Path, folder: &Path, package: &str, platform: Platform) -> Result<()> {
    let inside = folder.join(BINARIES).join(platform.folder());
    let inside = prepared(&inside.join(format!("{package}{}", platform.suffix())))?;
    std::fs::copy(library, &inside)
        .map(drop)
        .with_context(|| format!("cannot copy the library {}", shown(library)))
}

/// Checks that a scene can be read, before the long build.
///
/// # Errors
/// The file cannot be read.
pub fn check_readable(path: &Path) -> Result<()> {
    std::fs::File::open(path)
        .map(drop)
        .with_context(|| format!("cannot read {}", path.display()))
}
