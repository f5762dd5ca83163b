//! Gears between coordinates of joints.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A gear between two joints: `c2 = ratio c1`, of their coordinates from the start on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gear {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// The joints: the angle of those with an axis, else the displacement.
    pub joints: [String; 2],
    /// How much the coordinate of the second changes with that of the first: 1, m/rad, rad/m; negative where they turn opposite ways.
    pub ratio: f64,
}

/// A coordinate of a joint by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CoordinateKind {
    /// The way along its line from the first marker or its point, m.
    Displacement,
    /// The angle about its axis, rad.
    Angle,
}
