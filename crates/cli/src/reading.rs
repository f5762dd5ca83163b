//! Scenes from files, and errors that say of which.

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use flexbody::scene::{Scene, beside};
use fmu_package::{RESOURCES, SCENE};

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
        let folder = path.parent().unwrap_or(Path::new(""));
        return Scene::from_json_with(&text, &beside(folder)).map_err(|error| at(path, error));
    }
    let mut content = fmu_package::read(path)?;
    let Some(bytes) = content.remove(SCENE) else {
        bail!("{}: expected {SCENE} in it, found none", path.display());
    };
    let files = |name: &str| {
        let found = content.get(&format!("{RESOURCES}{name}"));
        found
            .cloned()
            .ok_or_else(|| format!("expected {RESOURCES}{name} in the FMU, found none"))
    };
    let wrong = |error: &dyn std::fmt::Display| at(path, format!("{SCENE}: {error}"));
    let text = String::from_utf8(bytes).map_err(|error| wrong(&error))?;
    Scene::from_json_with(&text, &files).map_err(|error| wrong(&error))
}

/// An error, with the file that it is about before it.
pub fn at(path: &Path, error: impl std::fmt::Display) -> anyhow::Error {
    anyhow!("{}: {error}", path.display())
}
