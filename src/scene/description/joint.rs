//! Joints and driven motions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{MotionValue, Vector};

/// A joint between two markers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// What the joint holds.
    pub kind: JointKind,
    /// What it joins: `ground` or `body.marker`, then `body.marker`. `along`: the name of a cable,
    /// then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: where on the ground, m; where the second marker is at the start by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<Vector>,
    /// `slider`: direction of the line along which the marker may move. `prismatic`: the same in the axes of the
    /// first marker (of ground: the global ones), by default its own direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<Vector>,
    /// `weld`, `orientation`, `prismatic`: direction of the second marker less that of the first (of ground: 0),
    /// rad; as at the start by default. `hinge`: the same at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// `distance` only: length of the link, m; the distance at the start by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: Option<f64>,
    /// `hinge` only: stiffness against rotation, N m/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// `hinge` only: damping of rotation, N m s/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
}

/// Joints by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// Holds the position.
    Revolute,
    /// Holds the position and the direction.
    Weld,
    /// Holds the marker on a fixed line.
    Slider,
    /// Holds the marker on a line of the first one, and the direction.
    Prismatic,
    /// Holds the direction.
    Orientation,
    /// Holds the distance.
    Distance,
    /// Holds the position; a spring and a damper act against rotation.
    Hinge,
    /// Holds the marker on the line of a cable.
    Along,
}

/// A driven motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// What is driven.
    pub kind: MotionKind,
    /// `position`, `angle`: the driven `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// `angle`: name of the driven revolute joint or hinge; `displacement`: of the slider.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Its course in time: m or rad.
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
    /// Way along the direction of a slider from its point, m.
    Displacement,
}
