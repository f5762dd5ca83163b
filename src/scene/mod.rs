//! Floor 5. A scene: strict JSON to a validated description, and from there to a
//! [`crate::system::System`]. The only user of serde.
//!
//! A scene that fails to validate is refused with the path of the offending value, what was
//! expected there and what was found: `bodies[0].material.density: expected a positive number
//! (kg/m^3), found -1`.

mod assemble;
mod description;
mod marker;
mod mesh;
mod ports;
mod resolved;
mod shape;
mod validate;

pub use assemble::{Assembled, assemble};
pub use description::{
    About, Accuracy, Body, CableBody, Constraints, Experiment, Formulation, Initial, InitialMotion,
    InitialState, Integrator, Material, Method, RigidBody, Scene, Section, Shape, Strain, Table,
    Value,
};
pub use resolved::{
    Action, AngleId, BodyReference, Cable, CableId, Coupling, CouplingId, Ends, First, Holder,
    HolderId, Input, InputKind, Joint, JointKind, Load, LoadKind, Marker, MarkerId, Mass, Motion,
    MotionKind, Output, Pivot, Place, Port, PortKind, Reaction, Resolved, Rigid, RigidId, SlideId,
    Slider, Spring, Turning,
};
pub use validate::{ELEMENTS, TOLERANCE};

/// What is wrong with a scene, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{path}: {message}")]
pub struct Error {
    /// Path of the value inside the scene, e.g. `bodies[0].material.density`.
    pub path: String,
    /// What was expected and what was found.
    pub message: String,
}

impl Error {
    /// An error at `path` with `message`.
    pub fn new(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            message: message.into(),
        }
    }
}

impl Scene {
    /// Reads and validates a scene.
    ///
    /// # Errors
    /// Broken JSON, unknown keys, values of the wrong type and values out of range, each with its path.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let mut json = serde_json::Deserializer::from_str(text);
        let mut scene: Self = serde_path_to_error::deserialize(&mut json).map_err(|error| {
            let (mut path, message) = (error.path().to_string(), error.inner().to_string());
            // Broken JSON has no path.
            if path == "." || path == "?" {
                path = "scene".into();
            }
            match message.split_once(description::INNER) {
                Some((inner, message)) => Error::new(format!("{path}.{inner}"), message),
                None => Error::new(path, message),
            }
        })?;
        json.end()
            .map_err(|error| Error::new("scene", error.to_string()))?;
        scene.accuracy.relative_tolerance = Some(scene.relative_tolerance());
        scene.resolve()?;
        Ok(scene)
    }

    /// The scene as pretty-printed JSON, with every default written out. Reading it again gives
    /// an equal scene; its bytes are what the GUID of the FMU is derived from.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }

    /// The JSON Schema of a scene, pretty-printed.
    pub fn json_schema() -> String {
        let schema = schemars::schema_for!(Scene);
        let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
        text.push('\n');
        text
    }
}
