//! Ports: where a master couples the scene to others.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Keys, Kind};

/// A marker that a master couples to another unit: one set of inputs and outputs, one terminal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Port {
    /// Name, with which those of its variables begin: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Where it is, `body.marker`.
    pub marker: String,
    /// What comes in and what goes out.
    pub kind: PortKind,
    /// Angle and moment too; a rotational spring or damper says so by itself.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub rotation: bool,
    /// `motion` only: stiffness of a spring between the marker and the point that comes in, N/m; the
    /// marker then stays free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// `motion` only: damping of a damper beside the spring, N s/m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// With a stiffness or damping only: stiffness between the directions, N m/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub rotational_stiffness: Option<f64>,
    /// With a stiffness or damping only: damping between the directions, N m s/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub rotational_damping: Option<f64>,
}

/// Ports by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PortKind {
    /// A force comes in, the motion of the marker goes out.
    Force,
    /// A motion comes in, the force that the scene exerts on the outside goes out.
    Motion,
}

impl Kind for PortKind {
    const PART: &'static str = "Port";

    fn keys(&self) -> &'static [Keys] {
        match self {
            Self::Force => &[(&[], &[])],
            Self::Motion => &[(
                &[],
                &[
                    "stiffness",
                    "damping",
                    "rotational_stiffness",
                    "rotational_damping",
                ],
            )],
        }
    }
}
