//! Joints that hold an orientation.

use super::*;

/// A joint that holds an orientation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OrientationJoint {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// In the plane only: angle from the direction of the first marker to that of the second, rad; by default the angle at the start.
    /// The direction of `ground` is 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
}

impl SceneJoint for OrientationJoint {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Orientation, [Orientation(self.angle)])
    }
}
