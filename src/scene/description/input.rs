//! Inputs: loads, lengths, releases and currents that the master sets.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::action::{Acting, ActionKind, is_false};
use super::tagged::{kinds, part};

kinds! {
    /// A load that the master sets.
    Input of "Input" {
        /// Force at a marker, N.
        Force(ForceInput),
        /// Moment at a marker, counter-clockwise, N m.
        Moment(MomentInput),
        /// Moment on the second marker of a joint, opposite on its first, N m.
        Torque(TorqueInput),
        /// Force in global axes per reference length of a cable, rod or beam, N/m.
        DistributedForce(DistributedForceInput),
        /// Moment per reference length of a rod or beam, N m/m.
        DistributedMoment(DistributedMomentInput),
        /// Pressure on a plate or shell, Pa.
        Pressure(PressureInput),
        /// Force in global axes per area of a plate or shell, N/m^2.
        AreaForce(AreaForceInput),
        /// Length at rest of a spring-damper, m.
        RestLength(RestLengthInput),
        /// Whether a joint lets go: it does, for good, in the first step that begins with more than 0.
        Release(ReleaseInput),
        /// Whether a latch may close: above 0 it may, else it is open. Read at the start of each communication step.
        Latch(LatchInput),
        /// Force of a joint friction against sliding, N on a displacement and N m on an angle.
        Friction(FrictionInput),
        /// Value `u` of a force law, in the unit that its expression gives it.
        Control(ControlInput),
        /// Velocity of a fluid in global axes, m/s.
        Current(CurrentInput),
    }
}
part!(Input);

/// A force at a marker that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForceInput {
    /// Marker that the force acts at, `body.marker`.
    pub marker: String,
    /// Whether the components rotate with the marker. They are then along and to the left of its direction in the plane, and along the
    /// axes of the body's frame in space.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Components of the force before the master sets it, N; zeros by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A moment at a marker that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MomentInput {
    /// Marker that the moment acts at, `body.marker`.
    pub marker: String,
    /// Whether the components rotate with the marker, along the axes of the body's frame; in space only.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Moment before the master sets it, N m: one value in the plane, three in space; zeros by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A moment between the two bodies of a joint that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TorqueInput {
    /// Name of the joint with an axis that the torque acts about.
    pub joint: String,
    /// Torque before the master sets it, N m: one value; 0 by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A force along a line that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistributedForceInput {
    /// Name of the cable, rod or beam that the force acts along.
    pub body: String,
    /// Components of the force per reference length before the master sets it, N/m; zeros by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A moment along the sections of a line that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistributedMomentInput {
    /// Name of the rod or beam that the moment acts along.
    pub body: String,
    /// Whether the components rotate with the sections, along their axes; in space only.
    #[serde(default, skip_serializing_if = "is_false")]
    pub follower: bool,
    /// Moment per reference length before the master sets it, N m/m: one value in the plane, three in space; zeros by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A pressure on a plate or shell that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PressureInput {
    /// Name of the plate or shell that the pressure acts on.
    pub body: String,
    /// Pressure before the master sets it, along the normal, Pa: one value; 0 by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A force over a plate or shell that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AreaForceInput {
    /// Name of the plate or shell that the force acts on.
    pub body: String,
    /// Components of the force per area before the master sets it, N/m^2; zeros by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A length at rest that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RestLengthInput {
    /// Name of the spring-damper or rope whose length is set.
    pub load: String,
    /// Length before the master sets it, m: one value; by default the length of the spring-damper.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A release of a joint that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ReleaseInput {
    /// Name of the joint that is released.
    pub joint: String,
    /// Value before the master sets it: one value; 0 by default, which holds the joint.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// The arming of a latch that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LatchInput {
    /// Name of the latch that is armed and opened.
    pub latch: String,
    /// Value before the master sets it: one value; 1 by default, which arms the latch.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A force of friction that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FrictionInput {
    /// Name of the joint friction whose force is set.
    pub load: String,
    /// Force before the master sets it, N or N m: one value; by default that of the load.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// The value `u` of a force law that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ControlInput {
    /// Name of the force law whose `u` is set.
    pub load: String,
    /// Value before the master sets it: one value; 0 by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

/// A velocity of a fluid or of the wind on an airfoil that the master sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CurrentInput {
    /// Name of the load of kind `fluid` or `airfoil` whose velocity is set.
    pub load: String,
    /// Components of the velocity before the master sets it, m/s; by default those of the load.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub start: Vec<f64>,
}

impl Input {
    /// Force or moment, of an input that is one.
    pub fn action(&self) -> Option<Acting<'_>> {
        let (kind, on, follower) = match self {
            Self::Force(of) => (ActionKind::Force, &of.marker, of.follower),
            Self::Moment(of) => (ActionKind::Moment, &of.marker, of.follower),
            Self::Torque(of) => (ActionKind::Torque, &of.joint, false),
            Self::DistributedForce(of) => (ActionKind::DistributedForce, &of.body, false),
            Self::DistributedMoment(of) => (ActionKind::DistributedMoment, &of.body, of.follower),
            Self::Pressure(of) => (ActionKind::Pressure, &of.body, false),
            Self::AreaForce(of) => (ActionKind::AreaForce, &of.body, false),
            Self::RestLength(_)
            | Self::Release(_)
            | Self::Latch(_)
            | Self::Friction(_)
            | Self::Control(_)
            | Self::Current(_) => {
                return None;
            }
        };
        Some(Acting { kind, on, follower })
    }

    /// Values before the master sets some; none where they are left out.
    pub fn start(&self) -> &[f64] {
        match self {
            Self::Force(of) => &of.start,
            Self::Moment(of) => &of.start,
            Self::Torque(of) => &of.start,
            Self::DistributedForce(of) => &of.start,
            Self::DistributedMoment(of) => &of.start,
            Self::Pressure(of) => &of.start,
            Self::AreaForce(of) => &of.start,
            Self::RestLength(of) => &of.start,
            Self::Friction(of) => &of.start,
            Self::Control(of) => &of.start,
            Self::Release(of) => &of.start,
            Self::Latch(of) => &of.start,
            Self::Current(of) => &of.start,
        }
    }

    /// Number of components.
    pub fn components(&self, dimension: usize) -> usize {
        match (self.action(), self) {
            (Some(acting), _) => acting.kind.components(dimension),
            (None, Self::Current(_)) => dimension,
            (None, _) => 1,
        }
    }
}
