//! Scenes from files, and errors that say of which.

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use flexbody::scene::Scene;
use fmu_package::SCENE;

/// Whether a file is an FMU by its name.
pub fn is_fmu(path: &Path) -> bool {
    path.extension() == Some("fmu".as_ref())
}

/// Reads a scene from a file of its own or from an FMU.
///
/// # Errors
/// A file that cannot be read, or a scene that is not valid.
pub fn read(path: &Path) -> Result<Scene> {
    if !is_fmu(path) {
        let text = std::fs::read_to_string(path).map_err(|error| at(path, error))?;
        return Scene::from_json(&text).map_err(|error| at(path, error));
    }
    let Some(bytes) = fmu_package::read(path)?.remove(SCENE) else {
        bail!("{}: expected {SCENE} in it, found none", path.display());
    };
    let wrong = |error: &dyn std::fmt::Display| at(path, format!("{SCENE}: {error}"));
    let text = String::from_utf8(bytes).map_err(|error| wrong(&error))?;
    Scene::from_json(&text).map_err(|error| wrong(&error))
}

/// An error, with the file that it is about before it.
pub fn at(path: &Path, error: impl std::fmt::Display) -> anyhow::Error {
    anyhow!("{}: {error}", path.display())
}
