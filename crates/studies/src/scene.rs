//! Scenes with values set, and systems ready to start.

use std::path::Path;

use flexbody::scene::{Assembled, InitialState, MarkerId, Scene, beside};
use flexbody::system::{Drive, State, Workspace, equilibrium};
use serde_json::Value;

/// Result with an error in words.
pub type Outcome<T> = Result<T, String>;

/// Reads a scene with values set: `BODY.NAME=NUMBER` (a number of the body, its material or its section;
/// `BODY` may be `*`: every body that has it) or `relative_tolerance=NUMBER`.
pub fn read(path: &Path, assignments: &[String]) -> Outcome<Scene> {
    let text = std::fs::read_to_string(path).map_err(|error| at(path, error))?;
    let mut json: Value = serde_json::from_str(&text).map_err(|error| at(path, error))?;
    for assignment in assignments {
        assign(&mut json, assignment).map_err(|error| format!("--set {assignment}: {error}"))?;
    }
    let files = beside(path.parent().unwrap_or(Path::new("")));
    Scene::from_json_with(&json.to_string(), &files).map_err(|error| at(path, error))
}

/// An error with the file it is about.
pub fn at(path: &Path, error: impl std::fmt::Display) -> String {
    format!("{}: {error}", path.display())
}

fn assign(scene: &mut Value, assignment: &str) -> Outcome<()> {
    let (name, value) = assignment.split_once('=').ok_or("expected NAME=VALUE")?;
    let value: Value = serde_json::from_str(value).map_err(|_| "expected a number")?;
    if name == "relative_tolerance" {
        scene["accuracy"][name] = value;
        return Ok(());
    }
    let (wanted, key) = name.split_once('.').ok_or("expected BODY.NAME=VALUE")?;
    let mut found = false;
    for body in scene["bodies"].as_array_mut().into_iter().flatten() {
        let is_wanted = body["name"] == wanted || wanted == "*";
        if !is_wanted {
            continue;
        }
        for place in ["", "/material", "/section"] {
            if let Some(part) = body.pointer_mut(place).and_then(Value::as_object_mut)
                && let Some(number) = part.get_mut(key)
            {
                *number = value.clone();
                found = true;
            }
        }
    }
    if found {
        Ok(())
    } else {
        Err("no body has such a number".to_owned())
    }
}

/// A system at its start, in the plane or in space.
pub struct Start<const D: usize = 2> {
    /// The scene.
    pub scene: Scene,
    /// System of the scene.
    pub assembled: Assembled<D>,
    /// Values of the inputs.
    pub inputs: Vec<f64>,
    /// The state to start from.
    pub state: State,
    /// Scratch.
    pub work: Workspace<D>,
}

impl Start {
    /// Assembles a scene of the plane, in equilibrium where it says so; inputs keep their start values.
    pub fn new(scene: Scene) -> Outcome<Self> {
        let mut start = Self::described(scene)?;
        if start.scene.initial.state() == InitialState::StaticEquilibrium {
            start.settle()?;
        }
        Ok(start)
    }
}

impl<const D: usize> Start<D> {
    /// Assembles a scene as it is described, whatever its initial state is.
    pub fn described(scene: Scene) -> Outcome<Self> {
        let resolved = scene.resolve().map_err(|error| error.to_string())?;
        let assembled = resolved.assemble().map_err(|error| error.to_string())?;
        let drives = (resolved.motions.iter()).flat_map(|motion| &motion.driven.drives);
        let is_input = |drive: &Drive| !matches!(drive, Drive::Function(_));
        if drives.into_iter().any(is_input) {
            return Err("motions: expected functions of time, found one driven by inputs".into());
        }
        let inputs = resolved.inputs.iter();
        let inputs: Vec<f64> = inputs.flat_map(|input| input.start.clone()).collect();
        let system = &assembled.system;
        let mut work = Workspace::new(system);
        let described = (&assembled.nodes[..], &assembled.rates[..]);
        let state = system.initial_state(0.0, &inputs, described, &mut work);
        let state = state.map_err(|error| format!("joints do not fit: {:?}", error.gaps))?;
        Ok(Self {
            scene,
            assembled,
            inputs,
            state,
            work,
        })
    }

    /// Moves the state to the static equilibrium.
    pub fn settle(&mut self) -> Outcome<()> {
        let found = equilibrium::find(
            &self.assembled.system,
            &self.inputs,
            &mut self.work,
            &mut self.state,
            (None, f64::INFINITY),
        );
        found.map(drop).map_err(|error| error.to_string())
    }

    /// The marker `body.marker`.
    pub fn marker(&self, name: &str) -> Option<MarkerId> {
        let (body, name) = name.split_once('.')?;
        let resolved = self.scene.resolved();
        let mut markers = resolved.markers.iter();
        let found = markers.find(|m| m.name == name && m.place.body().name() == body);
        Some(found?.id)
    }
}
