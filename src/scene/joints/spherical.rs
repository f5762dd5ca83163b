//! Spherical joints.

use super::*;

/// A spherical joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Spherical {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
}

impl SceneJoint for Spherical {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Pin, [AtPoint]).at(self.point)
    }
}
