//! Joints that hold a point on the line of a cable.

use super::*;

/// A point on the line of a cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PointOnCable {
    /// Name of the cable, then the `body.marker` on its line.
    pub markers: [String; 2],
}

impl SceneJoint for PointOnCable {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Ring, [PointOnCurve])
    }
}
