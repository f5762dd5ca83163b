//! Driven motions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Keys, Kind, MotionValue};

/// A driven motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// What is driven.
    pub kind: MotionKind,
    /// `position`, `angle`, `orientation`: the driven `body.marker`; `winch`: the end of the cable.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// `angle`: name of the driven revolute joint; `displacement`: of the joint along a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Its course in time: m or rad; of `orientation` the four parts of a quaternion.
    pub value: MotionValue,
}

/// Driven motions by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionKind {
    /// Direction of a marker, or direction of the second marker of a joint less that of its first,
    /// rad.
    Angle,
    /// Position of a marker, m.
    Position,
    /// In space how a rigid body stands: the quaternion, scalar first, of the frame of a marker's body in global axes, of any
    /// length and either sign. As an input with rates: the angular velocity and the angular acceleration, in global axes.
    Orientation,
    /// Displacement along the line of a point on a line, a prismatic, a cylindrical joint or a screw from its first marker or its point, m; not where
    /// that line belongs to a cable.
    Displacement,
    /// Length that a winch at a marker, an end of a cable, has paid out since the start, m; negative where it has taken in. The mass of the
    /// cable changes with it. What is on the winch has no part in the scene; what acts between its ends acts all along it: `distributed_force`
    /// (where `s` is the share of the length now), `contact`, `fluid` without added mass.
    Winch,
}

impl Kind for MotionKind {
    const PART: &'static str = "Motion";

    fn keys(&self) -> &'static [Keys] {
        match self {
            Self::Position | Self::Orientation | Self::Winch => &[(&["marker"], &[])],
            Self::Angle => &[(&["joint"], &[]), (&["marker"], &[])],
            Self::Displacement => &[(&["joint"], &[])],
        }
    }
}
