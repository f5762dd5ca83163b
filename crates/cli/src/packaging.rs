//! `flexbody package`: an FMU is the description of a scene beside the one compiled library.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use fmu_package::{
    BINARIES, Content, PARTS, Platform, Stage, announced, content, destination, prepared, shown,
    write,
};

use crate::describing::describe;
use crate::planning::Within;
use crate::reading::is_fmu;

/// Folder with the description of ports. Only FMUs of scenes with ports have it.
const TERMINALS: &str = "terminalsAndIcons/";

/// Which scene, and where to write.
#[derive(clap::Args)]
pub struct Package {
    /// Limits of planning.
    #[command(flatten)]
    pub within: Within,
    /// Scene file.
    pub scene: PathBuf,
    /// FMU, or the folder for one that is named like the scene [default: the current folder].
    #[arg(long, value_name = "FILE.fmu|FOLDER")]
    pub output: Option<PathBuf>,
    /// Platforms of the FMU [default: all with an installed library].
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

/// Packages a scene as an FMU and prints its path.
///
/// # Errors
/// A scene that is not valid, a plan that `--strict` refuses, a platform without a library, or a file that cannot be
/// written.
pub fn package(arguments: &Package) -> Result<()> {
    let output = arguments.output.as_deref().unwrap_or(Path::new("."));
    let is_named = !output.is_dir();
    let output = if is_named {
        checked_output(output)?
    } else {
        output.to_owned()
    };
    let parts = match &arguments.parts {
        Some(folder) => folder.clone(),
        None => beside()?,
    };
    let parts = libraries_and_licenses(&parts, &arguments.platform)?;
    let stage = stage("package")?;
    let name = describe(
        &arguments.scene,
        &stage.0,
        !arguments.no_animation,
        &arguments.within,
    )?;
    let mut content = content(&stage.0)?;
    if arguments.no_terminals {
        content.retain(|name, _| !name.starts_with(TERMINALS));
    }
    content.extend(parts);
    let output = if is_named {
        output
    } else {
        prepared(&output.join(format!("{name}.fmu")))?
    };
    let done = format!("packaged {}", shown(&output));
    announced("packaging", &done, || write(&content, &output))
}

/// Returns the absolute path of the FMU to write.
///
/// # Errors
/// A name that does not end in `.fmu`, or a folder that cannot be created.
pub fn checked_output(file: &Path) -> Result<PathBuf> {
    if !is_fmu(file) {
        bail!(
            "--output: expected a file name ending in .fmu, found {}",
            file.display()
        );
    }
    // Before anything is planned and run for it.
    destination(file)?;
    prepared(file)
}

/// Returns the folder with the parts of every FMU, which is installed beside this program.
fn beside() -> Result<PathBuf> {
    let program = std::env::current_exe().context("cannot find this program itself")?;
    // A link from elsewhere leads to where the libraries are.
    let program = program.canonicalize().unwrap_or(program);
    Ok(program.with_file_name(PARTS))
}

/// Collects libraries and licenses for some platforms, or for all available ones if none is named.
fn libraries_and_licenses(parts: &Path, wanted: &[Platform]) -> Result<Content> {
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
    let mut content = content(parts)?;
    if !wanted.is_empty() {
        let is_of =
            |file: &str, platform: &Platform| file.split('/').next() == Some(platform.folder());
        content.retain(|name, _| {
            let file = name.strip_prefix(BINARIES);
            file.is_none_or(|file| wanted.iter().any(|platform| is_of(file, platform)))
        });
    }
    Ok(content)
}

/// Creates a temporary folder.
///
/// # Errors
/// The folder cannot be created.
pub fn stage(purpose: &str) -> Result<Stage> {
    Stage::new(&std::env::temp_dir(), &format!("flexbody-{purpose}"))
}
