//! Floor 5. A scene: strict JSON to a validated description, and from there to a
//! [`crate::system::System`]. The only user of serde.
//!
//! A scene that fails to validate is refused with the path of the offending value, what was
//! expected there and what was found: `bodies[0].material.density: expected a positive number
//! (kg/m^3), found -1`.

mod alike;
mod assemble;
mod container;
mod description;
mod divisions;
mod elements;
mod files;
mod joints;
mod loads;
mod marker;
mod mesh;
mod motions;
mod numbers;
mod owners;
mod patch;
mod ports;
mod remarks;
mod resolved;
mod shape;
mod timed;
pub(crate) mod unit;
mod validate;
pub(crate) mod words;

use description::{Reader, Strict, check_names};
use serde::Deserialize;
use serde_json::{Value as Json, json};

pub use alike::did_you_mean;
pub use assemble::{Assembled, ModalLine, assemble};
pub use container::{Container, Details};
pub use description::{
    About, Accuracy, ActionKind, Along, Axial, Body, Course, DampingRatio, Experiment, FileBody,
    FixedInterfaceModes, Inertia, Initial, InitialMotion, InitialState, InputCourse, Integrator,
    Interpolation, LaminatePly, LineBody, LineModel, Material, Method, Model, Modes, Orientation,
    OutputKind, Pad, PatchBody, PatchMarker, PatchMesh, PatchSurface, PatchThickness, Profile,
    RigidBody, Scene, SceneVector, Section, SectionNumbers, Shape, Solid, Spin, Station, Strain,
    Surface, Table, Value, between_parts,
};
pub use divisions::{Division, MOST_DIVISIONS};
pub use elements::Chosen;
pub use files::{Files, beside, bounded};
pub use joints::{JointPrimitive, ResolvedGear, ResolvedJoint, ResolvedLatch, Symbol};
pub use loads::{
    ActingLoad, Action, Exerts, LoadNumber, LoadPlace, LoadWords, NumberMut, ResolvedFluid,
    ResolvedLoad, ResolvedLoadKind, TimedKey,
};
pub use motions::{Driven, DrivenQuantity, ROTATION_ORDERS, ResolvedMotion};
pub use patch::PatchGrid;
pub use remarks::remarks;
pub use resolved::{
    AngleId, BodyReference, Cable, ConstraintOwner, ConstraintOwnerId, Coupling, CouplingId,
    DirectionSource, EdgeBase, Ends, First, GaugeId, Incoming, Input, InputKind, JointCoordinate,
    LayerId, LineId, LoadId, MarkerId, Output, OutputTarget, Pivot, Place, Plate, PlateId, PointId,
    PortKind, Reaction, Reduced, ReducedId, Resolved, ResolvedEdge, ResolvedMarker, ResolvedMass,
    ResolvedPort, Rigid, RigidId, SlideId, Slider,
};
pub use timed::{Timed, finite_at, finite_near};
pub use unit::Unit;
pub use validate::{ELEMENTS, TOLERANCE};
pub use words::{number, rounded};

/// A scene with something of everything, for the tests of the floors above.
#[cfg(test)]
pub fn example() -> Scene {
    Scene::from_json(include_str!("example.json")).expect("a valid scene")
}

/// Error in a scene, with its place.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{path}: {message}")]
pub struct Error {
    /// Path of the value inside the scene, e.g. `bodies[0].material.density`.
    pub path: String,
    /// Expectation and finding, in words.
    pub message: String,
}

/// What a check finds, or what is wrong.
type Found<T> = Result<T, Error>;

impl Error {
    /// An error at `path` with `message`.
    pub fn new(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            message: message.into(),
        }
    }
}

/// The key by which editors find the schema of a file.
const SCHEMA: &str = "$schema";

/// A scene without the key that says where its schema is.
fn without_schema(mut scene: Json) -> Result<Json, Error> {
    let found = scene.as_object_mut().and_then(|keys| keys.remove(SCHEMA));
    match found {
        None | Some(Json::String(_)) => Ok(scene),
        Some(other) => {
            let message = format!("expected where the schema is, a text, found {other}");
            Err(Error::new(SCHEMA, message))
        }
    }
}

impl Scene {
    /// Reads and validates a scene that names no files.
    ///
    /// # Errors
    /// Broken JSON, unknown keys, values of the wrong type and values out of range, each with its path; a body that is read from a file.
    ///
    /// # Examples
    ///
    /// ```
    /// use flexbody::scene::Scene;
    ///
    /// let text = r#"{ "name": "stone", "dimension": 2,
    ///     "bodies": [{ "name": "stone", "element": "rigid", "mass": 2.0, "position": [0.0, 0.0] }] }"#;
    /// assert!(Scene::from_json(text).is_ok());
    ///
    /// let error = Scene::from_json(&text.replace("2.0,", "-1,")).unwrap_err();
    /// assert_eq!(error.path, "bodies[0].mass");
    /// assert_eq!(error.message, "expected a positive number (kg), found -1");
    /// ```
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Self::from_json_with(text, &files::none)
    }

    /// Reads and validates a scene with the files that it names.
    ///
    /// # Errors
    /// As [`Self::from_json`], and files that cannot be read or are not valid.
    pub fn from_json_with(text: &str, files: Files<'_>) -> Result<Self, Error> {
        // Editors of some systems begin a file with a mark of its encoding.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut json = serde_json::Deserializer::from_str(text);
        let broken = |error: serde_json::Error| format!("expected JSON: {error}");
        let value: Strict = serde_path_to_error::deserialize(&mut json).map_err(|error| {
            let path = error.path().to_string();
            let is_told = error.inner().is_data();
            let path = if path == "." || path == "?" {
                "scene".into()
            } else {
                path
            };
            if is_told {
                Error::new(path, error.inner().to_string())
            } else {
                // The line and the column say where.
                Error::new("scene", broken(error.into_inner()))
            }
        })?;
        json.end()
            .map_err(|error| Error::new("scene", broken(error)))?;
        let value = without_schema(value.0)?;
        check_names(&value)?;
        let mut scene = Self::deserialize(Reader(value)).map_err(|wrong| {
            let path = match wrong.path.as_str() {
                "" => "scene",
                path => path,
            };
            Error::new(path, wrong.message)
        })?;
        scene.write_out_defaults();
        scene.read_files(files)?;
        let chosen = scene.choose_elements()?;
        scene.take_elements(&chosen);
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
        let mut schema = schemars::schema_for!(Scene);
        description::tell_apart(&mut schema);
        description::tell_by_tag(&mut schema);
        // Editors find the schema by it; a scene does not keep it.
        if let Some(properties) = schema.pointer_mut("/properties") {
            properties[SCHEMA] = json!({
                "description": "Where this schema is, for editors; it means nothing else.",
                "type": "string",
            });
        }
        let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
        text.push('\n');
        text
    }
}
