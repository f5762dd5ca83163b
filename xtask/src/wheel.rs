//! `cargo xtask wheel`: the program, the libraries for FMUs and the Python package as one file that pip installs.

use std::path::Path;

use anyhow::{Context, Result};
use fmu_package::{Platform, shown};

use crate::cargo::{PROGRAM, Workspace};
use crate::licenses;
use crate::package::PACKAGE;
use crate::process::run;
use crate::product::put_parts;
use crate::python::Python;

/// Where the sources of the Python package are.
const SOURCES: &str = "python";
/// Environment variable that passes the product and its platform to the build of the package.
const PRODUCT: &str = "FLEXBODY_WHEEL_PRODUCT";
const TAG: &str = "FLEXBODY_WHEEL_PLATFORM";

/// Builds a wheel for this machine's platform whose program packages FMUs for all named platforms, and prints its path.
///
/// # Errors
/// A build fails, or a file cannot be written.
pub fn wheel(workspace: &Workspace, platforms: &[Platform], output: Option<&Path>) -> Result<()> {
    let host = Platform::host()?;
    let platforms = match platforms {
        [] => vec![host],
        named => named.to_vec(),
    };
    let folder = match output {
        Some(folder) => std::path::absolute(folder)?,
        None => workspace.target("wheel"),
    };
    let stage = workspace.stage("wheel")?;
    put_product(workspace, &platforms, &stage.0)?;
    let python = Python::prepare_own(workspace)?;
    run(python
        .module("hatchling")
        .args(["build", "-t", "wheel", "-d"])
        .arg(&folder)
        .current_dir(workspace.path(SOURCES))
        .env(PRODUCT, &stage.0)
        .env(TAG, tag(host)))?;
    println!("the wheel is in {}", shown(&folder));
    Ok(())
}

/// The program, what goes into every FMU, and the notices of what the program is linked with.
fn put_product(workspace: &Workspace, platforms: &[Platform], folder: &Path) -> Result<()> {
    put_parts(workspace, platforms, folder)?;
    let program = workspace.program(PACKAGE)?;
    licenses::put(workspace, PROGRAM, platforms, folder)?;
    let name = program.file_name().context("a program without a name")?;
    let copy = folder.join(name);
    let copied = std::fs::copy(&program, &copy);
    copied.with_context(|| format!("cannot write {}", shown(&copy)))?;
    Ok(())
}

/// Returns pip's tag of the platform. On Linux it names the glibc that everything is linked for.
fn tag(platform: Platform) -> &'static str {
    match platform {
        Platform::Linux64 => "manylinux_2_17_x86_64",
        Platform::Aarch64Linux => "manylinux_2_17_aarch64",
        Platform::Win64 => "win_amd64",
        Platform::Darwin64 => "macosx_10_12_x86_64",
        Platform::Aarch64Darwin => "macosx_11_0_arm64",
    }
}
