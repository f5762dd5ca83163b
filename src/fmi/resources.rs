//! The directory `resources`: from the scene in there to the simulation that a token stands for.

use std::io;
use std::path::{Path, PathBuf};

use super::guid::guid;
use super::names::Names;
use crate::scene::{self, Scene, bounded};
use crate::simulation::Simulation;

/// Why a simulation could not be made.
#[derive(Debug, thiserror::Error)]
pub enum NoSimulation {
    /// An argument that must be given.
    #[error("{0}: expected a text that is not empty")]
    Missing(&'static str),
    /// A scene file that cannot be read.
    #[error("{path}: {error}", path = path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        error: io::Error,
    },
    /// A bad scene.
    #[error("{path}: {error}", path = path.display())]
    Scene {
        /// The file.
        path: PathBuf,
        /// Error in the scene.
        error: scene::Error,
    },
    /// A description of another model.
    #[error(
        "{argument}: expected {expected}, which resources/scene.json stands for, found {found}"
    )]
    Token {
        /// The argument that tells which model is meant.
        argument: &'static str,
        /// GUID of the scene.
        expected: String,
        /// GUID stated by the master.
        found: String,
    },
}

/// The simulation of the scene in a directory.
///
/// # Errors
/// No scene, a bad one, or one that the token does not stand for.
pub fn open(folder: &Path, names: &Names, token: &str) -> Result<Simulation, NoSimulation> {
    let path = folder.join("scene.json");
    let text = bounded(&path).and_then(|bytes| String::from_utf8(bytes).map_err(io::Error::other));
    let text = text.map_err(|error| NoSimulation::Unreadable {
        path: path.clone(),
        error,
    })?;
    let scene = Scene::from_json_with(&text, &scene::beside(folder));
    let scene = scene.map_err(|error| NoSimulation::Scene { path, error })?;
    let simulation = Simulation::new(scene);
    let expected = guid(simulation.scene(), simulation.variables());
    if token != expected {
        return Err(NoSimulation::Token {
            argument: names.token,
            expected,
            found: token.into(),
        });
    }
    Ok(simulation)
}
