//! The directory `resources`: from the scene in there to the simulation that a token stands for.

use std::fs::{File, metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::guid::guid;
use super::names::Names;
use crate::scene::{self, Scene};
use crate::simulation::Simulation;

/// Largest file that is read, bytes: room for a million numbers in tables.
const MOST_BYTES: u64 = 1 << 26;

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
    let text = text(&path).map_err(|error| NoSimulation::Unreadable {
        path: path.clone(),
        error,
    })?;
    let scene = Scene::from_json(&text).map_err(|error| NoSimulation::Scene { path, error })?;
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

/// The text of a regular file of bounded size. Anything else might never end: it is refused unopened.
///
/// # Errors
/// What the operating system says; no regular file, one that is too large, or bytes that are not UTF-8.
fn text(path: &Path) -> io::Result<String> {
    let refused = |found: &str| {
        let message =
            format!("expected a regular file of at most {MOST_BYTES} bytes, found {found}");
        Err(io::Error::new(io::ErrorKind::InvalidData, message))
    };
    let status = metadata(path)?;
    if status.is_dir() {
        return refused("a folder");
    }
    if !status.is_file() {
        return refused("a device or a pipe");
    }
    let mut text = String::new();
    // It may grow while it is read.
    if status.len() <= MOST_BYTES {
        let mut file = File::open(path)?.take(MOST_BYTES + 1);
        file.read_to_string(&mut text)?;
    }
    match status.len().max(text.len() as u64) {
        length if length > MOST_BYTES => refused(&format!("{length}")),
        _ => Ok(text),
    }
}
