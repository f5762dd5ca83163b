//! What is in every FMU, whatever its scene: libraries and licenses; and the program that describes scenes.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};
use fmu_package::{PARTS, Platform, Stage, prepared, shown, write_whole};

use crate::cargo::Workspace;
use crate::licenses;
use crate::package::{PACKAGE, put_library};

/// Names a folder that products are kept in, and taken from without asking cargo again. Who sets it knows that nothing they are made of
/// has changed since: tests, which package hundreds of scenes.
pub const KEPT: &str = "FLEXBODY_PRODUCT";
/// The file that says where the program is.
const PROGRAM: &str = "program.txt";

/// Builds the parts of every FMU for some platforms, and copies them beside the place of the program.
///
/// # Errors
/// A build fails, or a file cannot be written.
pub fn put_parts(workspace: &Workspace, platforms: &[Platform], folder: &Path) -> Result<()> {
    let parts = folder.join(PARTS);
    for &platform in platforms {
        let library = workspace.library(PACKAGE, platform)?;
        put_library(&library, &parts, PACKAGE, platform)?;
    }
    licenses::put(workspace, PACKAGE, platforms, &parts)
}

/// Parts of FMUs for some platforms.
pub struct Product {
    /// The program that describes scenes.
    pub program: PathBuf,
    folder: Folder,
}

/// Where it is.
enum Folder {
    Own(Stage),
    Kept(PathBuf),
}

impl Product {
    /// Builds the product, or takes one that was kept.
    ///
    /// # Errors
    /// A build fails, or a file cannot be written.
    pub fn new(workspace: &Workspace, platforms: &[Platform]) -> Result<Self> {
        let Some(kept) = std::env::var_os(KEPT) else {
            return Self::built(workspace, platforms);
        };
        let names: Vec<&str> = platforms.iter().map(|platform| platform.folder()).collect();
        let folder = Path::new(&kept).join(names.join("+"));
        let file = folder.join(PROGRAM);
        if !file.exists() {
            let built = Self::built(workspace, platforms)?;
            write_whole(
                &built.path().join(PROGRAM),
                built.program.display().to_string(),
            )?;
            // Where another process was quicker its own stays.
            let moved = std::fs::rename(built.path(), prepared(&folder)?);
            if !file.exists() {
                moved.with_context(|| format!("cannot write {}", shown(&folder)))?;
            }
        }
        let program = std::fs::read_to_string(&file);
        let program = program.with_context(|| format!("cannot read {}", shown(&file)))?;
        Ok(Self {
            program: program.into(),
            folder: Folder::Kept(folder),
        })
    }

    fn built(workspace: &Workspace, platforms: &[Platform]) -> Result<Self> {
        let stage = workspace.stage("product")?;
        // Libraries first: what their tools lack is said before the program is compiled.
        put_parts(workspace, platforms, &stage.0)?;
        Ok(Self {
            program: workspace.program(PACKAGE)?,
            folder: Folder::Own(stage),
        })
    }

    fn path(&self) -> &Path {
        match &self.folder {
            Folder::Own(stage) => &stage.0,
            Folder::Kept(folder) => folder,
        }
    }

    /// The program, about to package what follows.
    pub fn packager(&self) -> Command {
        let mut command = Command::new(&self.program);
        command.arg("package").arg("--parts");
        command.arg(self.path().join(PARTS));
        command
    }
}
