//! Welds.

use super::*;

/// A weld.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Weld {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// In the plane only: angle from the direction of the first marker to that of the second, rad; by default the angle at the start.
    /// The direction of `ground` is 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
}

impl SceneJoint for Weld {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Weld, [AtPoint, Orientation(self.angle)]).at(self.point)
    }
}
