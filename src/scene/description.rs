//! What a scene may say. Field names are the JSON keys; units are SI, angles in rad.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A scene: bodies, joints, what goes in and what comes out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Name of the scene and of the FMU: letters, digits, `_` and `-`.
    pub name: String,
    /// Dimension of space; 2 (planar).
    pub dimension: usize,
    /// Gravitational acceleration, m/s^2.
    #[serde(default)]
    pub gravity: [f64; 2],
    /// Flexible bodies; exactly one for now.
    pub bodies: Vec<Body>,
    /// Joints to ground.
    #[serde(default)]
    pub joints: Vec<Joint>,
    /// Loads that the master sets.
    #[serde(default)]
    pub inputs: Vec<Input>,
    /// Quantities that the master reads.
    #[serde(default)]
    pub outputs: Vec<Output>,
    /// Where the simulation starts from.
    #[serde(default)]
    pub initial: Initial,
    /// What accuracy is asked for.
    #[serde(default)]
    pub accuracy: Accuracy,
    /// Formulation and integrator, where the automatic choice is not wanted.
    #[serde(default)]
    pub method: Method,
    /// Default experiment of the FMU.
    #[serde(default)]
    pub experiment: Experiment,
}

/// A flexible body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Name: a letter or `_`, then letters, digits and `_`.
    pub name: String,
    /// Finite element.
    pub element: Element,
    /// Number of elements.
    pub elements: u32,
    /// Material.
    pub material: Material,
    /// Cross section.
    pub section: Section,
    /// Strain measure.
    #[serde(default)]
    pub strain: Strain,
    /// Unstressed shape, and the configuration at the start.
    pub shape: Shape,
    /// Rigid motion at the start.
    #[serde(default)]
    pub motion: Motion,
    /// Named material coordinates: 0 is the first end, 1 the last.
    #[serde(default)]
    pub markers: BTreeMap<String, f64>,
}

/// Finite elements by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Element {
    /// ANCF cable: two nodes with position and slope; stretches and bends, does not shear.
    Cable,
}

/// Material of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Density, kg/m^3.
    pub density: f64,
    /// Kelvin-Voigt damping: ratio of viscosity to stiffness, s.
    #[serde(default)]
    pub damping_time: f64,
}

/// Cross section of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// Area, m^2.
    pub area: f64,
    /// Second moment of area, m^4; 0 is a cable without bending stiffness.
    pub second_moment: f64,
}

/// Strain measures by name; they agree only for small strains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Strain {
    /// Stretch `|r'| - 1` and rotation per reference length: geometrically exact beam theory.
    #[default]
    #[serde(rename = "thetaPrime")]
    ThetaPrime,
    /// Green-Lagrange axial strain and the curvature of the deformed line.
    #[serde(rename = "GreenLagrange_FrenetKappa")]
    GreenLagrangeFrenetKappa,
    /// Stretch `|r'| - 1` and the curvature of the deformed line.
    #[serde(rename = "engStrain_FrenetKappa")]
    EngStrainFrenetKappa,
}

/// Unstressed shape of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// Straight line.
    Line {
        /// First end, m.
        from: [f64; 2],
        /// Last end, m.
        to: [f64; 2],
    },
    /// Circular arc that bulges to the right of the way from `from` to `to`: drawn from left to
    /// right it sags.
    Arc {
        /// First end, m.
        from: [f64; 2],
        /// Last end, m.
        to: [f64; 2],
        /// Length along the arc, m; more than the distance between the ends.
        length: f64,
    },
}

/// Rigid motion of a body at the start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Velocity of the first end, m/s.
    #[serde(default)]
    pub velocity: [f64; 2],
    /// Angular velocity, counter-clockwise, rad/s.
    #[serde(default)]
    pub spin: f64,
}

/// A joint between two markers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Name: a letter or `_`, then letters, digits and `_`.
    pub name: String,
    /// What the joint holds.
    pub kind: JointKind,
    /// The markers it joins: `ground`, then `body.marker`.
    pub markers: [String; 2],
    /// `slider` only: direction of the line along which the marker may move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 2]>,
}

/// Joints by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// Holds the position.
    Revolute,
    /// Holds the position and the direction of the slope.
    Weld,
    /// Holds the marker on a fixed line.
    Slider,
    /// Holds the direction of the slope.
    Orientation,
}

/// A load that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// What is set.
    pub kind: InputKind,
    /// Where it acts: `body.marker`.
    pub marker: String,
    /// Value before the master sets one: two components for a force, one for a moment; zero by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// Inputs by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InputKind {
    /// Force in global axes, N.
    Force,
    /// Moment, counter-clockwise, N m.
    Moment,
}

/// A quantity that the master reads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// What is read.
    pub kind: OutputKind,
    /// `body.marker`, for quantities at a marker.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of a joint, for quantities of a joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Name of a body, for quantities of a body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// `natural_frequency` only: how many, lowest first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
}

/// Outputs by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OutputKind {
    /// Position of a marker, m.
    Position,
    /// Velocity of a marker, m/s.
    Velocity,
    /// Acceleration of a marker, m/s^2.
    Acceleration,
    /// Direction of the slope at a marker, rad, counted on over full turns.
    Angle,
    /// Rate of the angle, rad/s.
    AngularVelocity,
    /// Axial strain at a marker, in the strain measure of the body.
    Strain,
    /// Curvature at a marker, in the strain measure of the body, 1/m.
    Curvature,
    /// Force of a joint on its second marker, global axes, N.
    Reaction,
    /// Moment of a joint on its second marker, N m.
    ReactionMoment,
    /// Kinetic, strain and gravitational energy, J.
    Energy,
    /// Natural frequencies about the initial configuration, rad/s.
    NaturalFrequency,
}

/// Where the simulation starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Initial {
    /// The unstressed shape with its rigid motion.
    #[default]
    AsShaped,
    /// The stable equilibrium under gravity and the start values of the inputs, at rest.
    StaticEquilibrium,
}

/// What accuracy is asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Accuracy {
    /// Error in time that a step may make, relative to the length of the body (root mean square
    /// over its mass).
    pub relative_tolerance: f64,
}

impl Default for Accuracy {
    fn default() -> Self {
        Self {
            relative_tolerance: 1e-4,
        }
    }
}

/// Formulation and integrator.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Method {
    /// How connectivity and joints are eliminated.
    #[serde(default)]
    pub formulation: Formulation,
    /// Integrator.
    #[serde(default)]
    pub integrator: Integrator,
}

/// Formulations by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Formulation {
    /// QR elimination weighted by the square root of the mass: exact connectivity, identity inertia.
    #[default]
    MassWeighted,
    /// Report MBS97-2-UIC, Eqs. 23-34, as printed. It tears the elements apart; for charts only.
    AsPrinted,
}

/// Integrators by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Chosen from the stiffness of the scene and the tolerance.
    #[default]
    Auto,
    /// Radau IIA of order 5, implicit: for stiff scenes.
    Radau,
    /// Runge-Kutta of order 4 with an embedded order 3, explicit: for soft scenes.
    Rk4,
}

/// Default experiment of the FMU.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Experiment {
    /// Stop time, s.
    pub stop_time: f64,
    /// Communication step, s.
    pub step: f64,
}

impl Default for Experiment {
    fn default() -> Self {
        Self {
            stop_time: 1.0,
            step: 0.01,
        }
    }
}
