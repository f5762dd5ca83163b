//! Ports: where a master couples the scene to others.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::action::is_false;
use super::tagged::{kinds, part};

/// A marker that a master couples to another unit: one set of inputs and outputs, one terminal.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Port {
    /// Name, with which those of its variables begin: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Where it is, `body.marker`.
    pub marker: String,
    /// Kind of the port: quantities that come in and that go out.
    #[serde(flatten)]
    pub kind: PortKind,
}
part!(Port {
    name: String,
    marker: String
});

kinds! {
    /// Ports by kind.
    PortKind of "Port" {
        /// A force comes in, the motion of the marker goes out.
        Force(ForcePort),
        /// A motion comes in, the force that the scene exerts on the outside goes out.
        Motion(MotionPort),
    }
}

/// A port that takes a force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForcePort {
    /// Whether a moment comes in and the rotation of the marker goes out too.
    #[serde(default, skip_serializing_if = "is_false")]
    pub rotation: bool,
}

/// A port that takes a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MotionPort {
    /// Whether a rotation comes in and a moment goes out too. A rotational stiffness or damping implies it.
    #[serde(default, skip_serializing_if = "is_false")]
    pub rotation: bool,
    /// Stiffness of a spring between the point that comes in and the marker, N/m; by default the marker follows the point. With a
    /// stiffness or a damping the marker stays free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// Damping of a damper beside the spring, N s/m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// With a stiffness or a damping only: stiffness of a spring between the orientation that comes in and that of the marker, N m/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub rotational_stiffness: Option<f64>,
    /// With a stiffness or a damping only: damping beside the rotational spring, N m s/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub rotational_damping: Option<f64>,
}
