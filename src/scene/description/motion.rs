//! Driven motions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::MotionValue;
use super::tagged::{kinds, part};

/// A driven motion.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Motion {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Kind of the motion.
    #[serde(flatten)]
    pub kind: MotionKind,
}
part!(Motion { name: String });

kinds! {
    /// Driven motions by kind.
    MotionKind of "Motion" {
        /// Direction of a marker, or direction of the second marker of a joint less that of its first,
        /// rad.
        Angle(AngleMotion),
        /// Position of a marker, m.
        Position(PositionMotion),
        /// In space how a rigid body stands: the quaternion, scalar first, of the frame of a marker's body in global axes, of any
        /// length and either sign. As an input with rates: the angular velocity and the angular acceleration, in global axes.
        Orientation(OrientationMotion),
        /// Displacement along the line of a point on a line, a prismatic, a cylindrical joint or a screw from its first marker or its point, m; not where
        /// that line belongs to a cable.
        Displacement(DisplacementMotion),
        /// Length that a winch at a marker, an end of a cable, has paid out since the start, m; negative where it has taken in. The mass of the
        /// cable changes with it. What is on the winch has no part in the scene; what acts between its ends acts all along it: `distributed_force`
        /// (where `s` is the share of the length now), `contact`, `fluid` without added mass.
        Winch(WinchMotion),
    }
}

/// A driven angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-either" = [["joint"], ["marker"]]))]
pub struct AngleMotion {
    /// Marker whose direction is driven in the plane, `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of the joint with an axis whose angle is driven.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Course of the angle in time, rad.
    pub value: MotionValue,
}

/// A driven position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PositionMotion {
    /// Marker whose position is driven, `body.marker`.
    pub marker: String,
    /// Course of the position in time, m: two components in the plane, three in space.
    pub value: MotionValue,
}

/// A driven orientation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OrientationMotion {
    /// Marker of the rigid body whose orientation is driven, `body.marker`.
    pub marker: String,
    /// Course of the quaternion in time: its four parts, scalar first.
    pub value: MotionValue,
}

/// A driven displacement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DisplacementMotion {
    /// Name of the joint whose displacement is driven.
    pub joint: String,
    /// Course of the displacement in time, m.
    pub value: MotionValue,
}

/// A winch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WinchMotion {
    /// Marker at the end of the cable where the winch is, `body.marker`.
    pub marker: String,
    /// Course of the length paid out in time, m; 0 at the start.
    pub value: MotionValue,
}

impl MotionKind {
    /// Course in time.
    pub fn value(&self) -> &MotionValue {
        match self {
            Self::Angle(of) => &of.value,
            Self::Position(of) => &of.value,
            Self::Orientation(of) => &of.value,
            Self::Displacement(of) => &of.value,
            Self::Winch(of) => &of.value,
        }
    }

    /// Name of the marker that is driven, if it is one.
    pub fn marker(&self) -> Option<&str> {
        match self {
            Self::Angle(of) => of.marker.as_deref(),
            Self::Position(of) => Some(&of.marker),
            Self::Orientation(of) => Some(&of.marker),
            Self::Winch(of) => Some(&of.marker),
            Self::Displacement(_) => None,
        }
    }

    /// Name of the joint that is driven, if it is one.
    pub fn joint(&self) -> Option<&str> {
        match self {
            Self::Angle(of) => of.joint.as_deref(),
            Self::Displacement(of) => Some(&of.joint),
            Self::Position(_) | Self::Orientation(_) | Self::Winch(_) => None,
        }
    }
}
