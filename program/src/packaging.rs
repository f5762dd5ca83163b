//! `flexbody package`: an FMU is the description of a scene beside the one compiled library.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use packing::{BINARIES, Platform, announced, copy_all, pack, prepared, shown};

use crate::describing::describe;
use crate::reading::is_fmu;

/// What says which variables make up a port; only FMUs of scenes with ports have it.
const TERMINALS: &str = "terminalsAndIcons";
/// Beside the program: what goes into every FMU.
const PARTS: &str = "fmu";

/// Which scene, and where to write.
#[derive(clap::Args)]
pub struct Package {
    /// Scene file.
    pub scene: PathBuf,
    /// FMU, or the folder for one that is named like the scene [default: the current folder].
    #[arg(long, value_name = "FILE.fmu|FOLDER")]
    pub output: Option<PathBuf>,
    /// What it is to run on [default: every platform that there is a library for].
    #[arg(long, value_name = "PLATFORM,...", value_delimiter = ',')]
    pub platform: Vec<Platform>,
    /// Leaves out terminalsAndIcons.xml, which FMI Library warns of in every FMU.
    #[arg(long)]
    pub no_terminals: bool,
    /// Leaves the default experiment in motion out of the documentation.
    #[arg(long)]
    pub no_animation: bool,
    /// Folder with the libraries and licenses that go into every FMU [default: `fmu` beside this program].
    #[arg(long, value_name = "FOLDER")]
    pub parts: Option<PathBuf>,
}

/// Makes an FMU of a scene and says where it is.
pub fn package(arguments: &Package) -> Result<()> {
    let output = arguments.output.as_deref().unwrap_or(Path::new("."));
    let is_named = !output.is_dir();
    let output = match is_named {
        true => checked_output(output)?,
        false => output.to_owned(),
    };
    let parts = match &arguments.parts {
        Some(folder) => folder.clone(),
        None => beside()?,
    };
    let left_out = libraries(&parts, &arguments.platform)?;
    let stage = Stage::new("package")?;
    let name = describe(&arguments.scene, &stage.0, !arguments.no_animation)?;
    if arguments.no_terminals {
        remove(&stage.0.join(TERMINALS))?;
    }
    copy_all(&parts, &stage.0)?;
    for platform in left_out {
        remove(&stage.0.join(BINARIES).join(platform))?;
    }
    let output = match is_named {
        true => output,
        false => prepared(&output.join(format!("{name}.fmu")))?,
    };
    let done = format!("packaged {}", shown(&output));
    announced("packaging", &done, || pack(&stage.0, &output))
}

/// The file to write an FMU to, absolute, unless its name does not say that it is one.
pub fn checked_output(file: &Path) -> Result<PathBuf> {
    if !is_fmu(file) {
        bail!(
            "--output: expected a file name ending in .fmu, found {}",
            file.display()
        );
    }
    prepared(file)
}

/// What goes into every FMU, where this program was installed with it.
fn beside() -> Result<PathBuf> {
    let program = std::env::current_exe().context("cannot find this program itself")?;
    // A link from elsewhere leads to where the libraries are.
    let program = program.canonicalize().unwrap_or(program);
    Ok(program.with_file_name(PARTS))
}

/// The platforms whose libraries are there and are not wanted.
fn libraries(parts: &Path, wanted: &[Platform]) -> Result<Vec<String>> {
    let folder = parts.join(BINARIES);
    let listing = std::fs::read_dir(&folder).with_context(|| {
        let folder = shown(&folder);
        format!("expected libraries for FMUs in {folder}; --parts says where they are")
    })?;
    let mut found = Vec::new();
    for entry in listing {
        found.push(entry?.file_name().to_string_lossy().into_owned());
    }
    found.sort();
    for platform in wanted {
        if !found.iter().any(|name| name == platform.folder()) {
            bail!(
                "--platform: expected some of {}, which there are libraries for, found {}",
                found.join(", "),
                platform.folder()
            );
        }
    }
    let is_wanted = |name: &str| wanted.iter().any(|platform| platform.folder() == name);
    found.retain(|name| !wanted.is_empty() && !is_wanted(name));
    Ok(found)
}

fn remove(folder: &Path) -> Result<()> {
    if !folder.exists() {
        return Ok(());
    }
    let removed = std::fs::remove_dir_all(folder);
    removed.with_context(|| format!("cannot remove {}", shown(folder)))
}

/// A folder to build in, removed when it goes out of scope.
pub struct Stage(pub PathBuf);

impl Stage {
    /// An empty folder of this process and this purpose alone.
    pub fn new(purpose: &str) -> Result<Self> {
        let name = format!("flexbody-{purpose}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        // A crashed process with the same number may have left one behind.
        remove(&folder)?;
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
