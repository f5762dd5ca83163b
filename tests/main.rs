//! Tests of the library from outside: one program, so that it is linked once.

mod abi;
mod bounds;
mod cases;
mod cases_runner;
mod claims;
mod dense;
mod derivatives;
mod driven_inputs;
mod eigen;
mod elements;
mod equilibria;
mod examples;
mod hostile_scenes;
mod laws;
mod order;
mod planner;
mod scenes;
mod selection;
mod steps;
mod tidy;
mod zeros;

use std::path::{Path, PathBuf};

use flexbody::scene::{Scene, beside};
use flexbody::simulation::{Budget, plan};

/// The folder of the project.
fn root() -> &'static Path {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().expect("a folder above the tests")
}

/// The ready scenes, sorted.
fn ready_scenes() -> Vec<PathBuf> {
    let listed = std::fs::read_dir(root().join("scenes")).expect("the ready scenes");
    let mut files: Vec<PathBuf> = listed.map(|entry| entry.expect("a file").path()).collect();
    files.retain(|path| {
        let name = path.to_string_lossy();
        name.ends_with(".json") && !name.ends_with(".schema.json")
    });
    files.sort();
    files
}

/// A scene with numbers for those that it leaves to the planner: the best that little time finds.
fn planned(text: &str) -> Result<Scene, String> {
    planned_beside(text, Path::new(""))
}

/// The same of a scene that names files of a folder.
fn planned_beside(text: &str, folder: &Path) -> Result<Scene, String> {
    let scene = Scene::from_json_with(text, &beside(folder)).map_err(|error| error.to_string())?;
    let budget = Budget {
        seconds: 0.3,
        ..Budget::default()
    };
    let planned = plan(&scene, &budget, &mut |_, _, _| ());
    planned
        .map(|(scene, _)| scene)
        .map_err(|error| error.to_string())
}

// Files that fuzzing shares find these at the root.
use abi::{hostile, saved, support};
