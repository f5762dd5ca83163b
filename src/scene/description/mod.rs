//! What a scene may say. Field names are the JSON keys; units are SI, angles in rad.

mod about;
mod accuracy;
mod action;
mod body;
mod element;
mod initial;
mod input;
mod kinds;
mod output;
mod patch;
mod port;
mod profile;
mod reader;
mod reduced;
mod renamed;
mod rotation;
mod section;
mod solid;
mod solved;
pub(super) mod strict;
mod surface;
pub(super) mod tagged;
mod torsion;
mod value;
mod vector;

use schemars::JsonSchema;
use serde::de::{Deserializer, Error as _};
use serde::{Deserialize, Serialize};

use super::joints::{Gear, Joint, Latch};
use super::loads::Load;
use super::motions::Motion;

pub use about::About;
pub use accuracy::{Accuracy, Course, InputCourse};
pub use action::{Acting, ActionKind, ActsOn, is_false};
pub use body::{
    Axial, Body, InitialMotion, LineBody, LineModel, Mass, Material, Model, RigidBody, Shape,
    Strain,
};
pub use initial::{Initial, InitialState};
pub use input::Input;
pub use kinds::{tell_apart, tell_by_tag};
pub use output::{
    Along, DeflectionOutput, OfGear, OfLoad, Output, OutputKind, PlyStressOutput, ReactionOutput,
};
pub use patch::{
    LaminatePly, Pad, PatchBody, PatchMarker, PatchMesh, PatchStiffness, PatchSurface,
    PatchThickness,
};
pub use port::{ForcePort, MotionPort, Port, PortKind};
pub use profile::Profile;
pub use reader::Reader;
pub use reduced::{DampingRatio, FileBody, FixedInterfaceModes, Modes, ModesUpTo};
pub use renamed::check_names;
pub use rotation::{Inertia, Orientation};
pub use section::{Section, SectionNumbers, Station};
pub use solid::Solid;
pub use solved::between_parts;
pub use strict::Strict;
pub use surface::Surface;
pub use tagged::Kinds;
pub use value::{ALONG_LINE, Interpolation, LoadValue, MotionValue, OVER_SURFACE, Table, Value};
pub use vector::{SceneVector, Spin};

/// A scene: bodies, joints, what drives and loads them, what goes in and what comes out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Name of the scene and of the FMU: letters, digits, `_` and `-`; at most 100.
    pub name: String,
    /// Whose model it is.
    #[serde(default, skip_serializing_if = "About::is_empty")]
    pub about: About,
    /// Dimension: 2 in the plane, 3 in space. Cables in space stretch and bend, isotropically, and know no torsion.
    #[serde(deserialize_with = "dimension")]
    #[schemars(range(min = 2, max = 3))]
    pub dimension: usize,
    /// Gravitational acceleration, m/s^2; zero by default.
    #[serde(default, skip_serializing_if = "SceneVector::is_unsaid")]
    pub gravity: SceneVector,
    /// Angular velocity of the frame that the scene is described in, about its origin, rad/s: a number in the plane,
    /// counter-clockwise, three components in space. Gravity and the ground rotate with the frame.
    #[serde(default)]
    pub rotation: Spin,
    /// Bodies; at least one.
    pub bodies: Vec<Body>,
    /// Masses lumped at markers.
    #[serde(default)]
    pub masses: Vec<Mass>,
    /// Joints to ground and between bodies.
    #[serde(default)]
    pub joints: Vec<Joint>,
    /// Gears between joints.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gears: Vec<Gear>,
    /// Latches on joints.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub latches: Vec<Latch>,
    /// Driven positions, angles and displacements.
    #[serde(default)]
    pub motions: Vec<Motion>,
    /// Loads that the scene itself knows.
    #[serde(default)]
    pub loads: Vec<Load>,
    /// Loads that the master sets.
    #[serde(default)]
    pub inputs: Vec<Input>,
    /// Quantities that the master reads.
    #[serde(default)]
    pub outputs: Vec<Output>,
    /// Markers that the master couples to other units.
    #[serde(default)]
    pub ports: Vec<Port>,
    /// Where the simulation starts from.
    #[serde(default)]
    pub initial: Initial,
    /// Accuracy that is requested.
    #[serde(default)]
    pub accuracy: Accuracy,
    /// Integrator, where the automatic choice is not wanted.
    #[serde(default)]
    pub method: Method,
    /// Default experiment of the FMU.
    #[serde(default)]
    pub experiment: Experiment,
}

/// Reads the dimension, of which there are two.
fn dimension<'de, D: Deserializer<'de>>(deserializer: D) -> Result<usize, D::Error> {
    let given = Strict::deserialize(deserializer)?.0;
    let count = given.as_u64().and_then(|count| usize::try_from(count).ok());
    count.ok_or_else(|| {
        let found = reader::found(&given);
        D::Error::custom(format!(
            "expected 2 (the plane) or 3 (space), found {found}"
        ))
    })
}

impl Scene {
    /// Says what is left out and follows from other values.
    pub fn write_out_defaults(&mut self) {
        if !self.is_to_be_planned() {
            self.accuracy.relative_tolerance = Some(self.relative_tolerance());
        } else if self.accuracy.relative_tolerance.is_none() {
            self.accuracy.error = Some(self.error());
        }
        if self.dimension == 3 && self.rotation == Spin::default() {
            self.rotation = Spin::Vector([0.0; 3]);
        }
        let motions = self.bodies.iter_mut().map(Body::motion_mut);
        let zeros = motions.map(|motion| {
            if self.dimension == 3 && motion.spin == Spin::default() {
                motion.spin = Spin::Vector([0.0; 3]);
            }
            &mut motion.velocity
        });
        for vector in zeros.chain([&mut self.gravity]) {
            if vector.is_unsaid() {
                *vector = SceneVector::zero(self.dimension.clamp(2, 3));
            }
        }
        self.divide_open_meshes();
        let vertical = self.gravity.full().map(|component| -component);
        for line in self.bodies.iter_mut().filter_map(Body::cable_mut) {
            line.vertical = vertical;
        }
    }

    /// Whether the frame rotates that it is described in.
    pub fn turns(&self) -> bool {
        self.rotation.full() != [0.0; 3]
    }

    /// Whether numbers of elements or the tolerance are left to the planner.
    pub fn is_to_be_planned(&self) -> bool {
        let mut cables = self.bodies.iter().filter_map(Body::flexible);
        let Accuracy {
            error,
            relative_tolerance,
            ..
        } = &self.accuracy;
        let is_error_alone = error.is_some() && relative_tolerance.is_none();
        let mut reduced = self.bodies.iter().filter_map(Body::reduced);
        let mut patches = self.bodies.iter().filter_map(Body::patch);
        is_error_alone
            || patches.any(|patch| patch.mesh.is_open.contains(&true))
            || cables.any(|cable| cable.elements.is_none())
            || reduced.any(FileBody::is_open)
    }

    /// Whether bodies have damping ratios that have not become times.
    pub fn has_ratios(&self) -> bool {
        let mut cables = self.bodies.iter().filter_map(Body::cable);
        cables.any(|cable| cable.material.damping_ratio.is_some())
    }

    /// The scene with nothing that is read.
    pub fn without_outputs(mut self) -> Self {
        self.outputs.clear();
        self
    }

    /// Error wanted of outputs where it is planned for: as given, or 1e-3.
    pub fn error(&self) -> f64 {
        self.accuracy.error.unwrap_or(1e-3)
    }

    /// Error wanted of what is read, relative, where nothing is left to the planner: as given, or ten times the tolerance, as
    /// are those that are taken where neither is said.
    pub fn error_wanted(&self) -> f64 {
        let by_tolerance = 10.0 * self.relative_tolerance();
        self.accuracy.error.unwrap_or(by_tolerance)
    }

    /// Communication step that the tolerance was found with, s; nothing where the planner did not find it.
    pub fn planned_step(&self) -> Option<f64> {
        let accuracy = &self.accuracy;
        let is_planned = accuracy.error.is_some() && accuracy.relative_tolerance.is_some();
        is_planned.then_some(self.experiment.step)
    }

    /// Gives a tolerance; nothing is left to the planner then.
    pub fn set_relative_tolerance(&mut self, value: f64) {
        if self.is_to_be_planned() {
            self.accuracy = Accuracy::default();
        }
        self.accuracy.relative_tolerance = Some(value);
    }

    /// Error in time that a step may make: as given, or by the kinds of bodies.
    pub fn relative_tolerance(&self) -> f64 {
        let deforms = |body: &Body| {
            body.flexible().is_some() || body.reduced().is_some() || body.patch().is_some()
        };
        let is_rigid = !self.bodies.iter().any(deforms);
        let default = if is_rigid { 1e-7 } else { 1e-4 };
        self.accuracy.relative_tolerance.unwrap_or(default)
    }
}

/// Integrator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Method {
    /// Integrator.
    #[serde(default)]
    pub integrator: Integrator,
    /// Most work of one communication step: evaluations (of accelerations and tangents, factorizations and
    /// solves) times parts (elements, masses and constraints, and four). A step that takes more ends where it
    /// is. A billion takes about a minute.
    #[serde(default = "work_limit")]
    pub work_limit: f64,
}

impl Default for Method {
    fn default() -> Self {
        Self {
            integrator: Integrator::default(),
            work_limit: work_limit(),
        }
    }
}

fn work_limit() -> f64 {
    1e9
}

/// Integrators by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// An explicit method or the implicit one, whichever gets further with the same work while it runs.
    #[default]
    Auto,
    /// Radau IIA of order 5, implicit: for stiff scenes.
    Radau,
    /// Runge-Kutta of order 4 with an embedded order 3, explicit: for soft scenes with damping or
    /// constraints.
    Rk4,
    /// Runge-Kutta of Dormand and Prince of order 8 with embedded orders 5 and 3, explicit: for soft scenes with damping or
    /// constraints at tight tolerances.
    Dopri853,
    /// Velocity Verlet of order 2, explicit: for soft scenes at loose tolerances.
    Verlet,
    /// Runge-Kutta-Nystrom of order 4 with an embedded order 3, explicit: for soft scenes.
    Rkn43,
    /// Runge-Kutta-Nystrom of order 6 with an embedded order 4, explicit: for soft scenes at tight tolerances.
    Rkn64,
}

/// Default experiment of the FMU.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Experiment {
    /// Stop time, s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub stop_time: f64,
    /// Communication step, s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub step: f64,
}

impl Experiment {
    /// Number of communication steps. The last is shorter where the stop time is no multiple, but not by rounding alone.
    pub fn steps(&self) -> f64 {
        (self.stop_time / self.step - 1e-9).ceil().max(1.0)
    }
}

impl Default for Experiment {
    fn default() -> Self {
        Self {
            stop_time: 1.0,
            step: 0.01,
        }
    }
}
