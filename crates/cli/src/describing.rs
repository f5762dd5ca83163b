//! `flexbody describe`: what the FMU of a scene holds besides the library.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use flexbody::fmi2;
use flexbody::simulation::{Simulation, check};
use fmu_package::{Progress, RESOURCES, prepared, shown};

use crate::containers::{described, is_container};
use crate::icon;
use crate::planning::{Within, planned};
use crate::reading::at;
use crate::viewing;

/// Which scene, and where to write.
#[derive(clap::Args)]
pub struct Describe {
    /// Scene file, or a file of a reduced model (`.safetensors`).
    scene: PathBuf,
    /// Directory to write into; made if it does not exist. Nothing is written of a file of a reduced model.
    #[arg(long)]
    output: Option<PathBuf>,
    /// Leaves the default experiment in motion out of the documentation.
    #[arg(long)]
    no_animation: bool,
    #[command(flatten)]
    within: Within,
}

/// Writes the description of a scene that the user asks for, or prints that of a reduced model.
///
/// # Errors
/// A scene or a model that is not valid, a plan that `--strict` refuses, or a file that cannot be written.
pub fn run(arguments: &Describe) -> Result<()> {
    let file = &arguments.scene;
    match (&arguments.output, is_container(file)) {
        (None, true) => {
            let written = io::stdout().write_all(described(file)?.as_bytes());
            written.context("standard output")
        }
        (Some(_), true) => {
            bail!("--output: expected a scene beside it, found a file of a reduced model")
        }
        (Some(output), false) => {
            describe(file, output, !arguments.no_animation, &arguments.within).map(drop)
        }
        (None, false) => bail!("--output: expected a directory to write into, found nothing"),
    }
}

/// Writes everything that an FMU of a scene holds besides libraries and licenses, and returns the scene's name.
///
/// # Errors
/// A scene that is not valid, a plan that `--strict` refuses, or a file that cannot be written.
pub fn describe(place: &Path, output: &Path, is_moving: bool, within: &Within) -> Result<String> {
    let (scene, planned) = planned(place, within)?;
    // What contradicts itself, or has no start, is told here, not by the first master that runs it.
    check(&scene).map_err(|error| at(place, error))?;
    let finding = Progress::spinner("finding the start {spinner}", "finding the start");
    let start = Simulation::new(scene.clone()).initialize(0.0);
    drop(finding);
    start.map_err(|error| at(place, format!("start values: {error}")))?;
    let motion = if is_moving {
        viewing::motion(place, &scene)?
    } else {
        String::new()
    };
    for (name, text) in fmi2::describe(&scene, &planned, &motion) {
        let path = prepared(&output.join(name))?;
        std::fs::write(&path, text).with_context(|| format!("cannot write {}", shown(&path)))?;
    }
    for (name, bytes) in scene.files() {
        let path = prepared(&output.join(RESOURCES).join(name))?;
        std::fs::write(&path, bytes).with_context(|| format!("cannot write {}", shown(&path)))?;
    }
    let documentation = output.join("documentation");
    icon::render(&documentation.join("scene.svg"), &output.join("model.png"))?;
    Ok(scene.name)
}
