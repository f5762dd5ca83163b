//! Universal joints.

use super::*;

/// A universal joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Universal {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Axis of the cross that is fixed in the first body. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    pub direction: SceneVector,
    /// Axis of the cross that is fixed in the second body, perpendicular to `direction` and in the same axes.
    pub second_direction: SceneVector,
}

impl SceneJoint for Universal {
    fn parts(&self) -> JointParts {
        let axes = Perpendicular(self.direction.full(), self.second_direction.full());
        JointParts::new(Symbol::Pin, [AtPoint, axes])
            .at(self.point)
            .along([Some(self.direction), Some(self.second_direction)])
    }

    fn check(&self, path: &str, _ends: &Ends<'_>) -> Found<()> {
        let cosine = cosine(self.direction, self.second_direction);
        if cosine.abs() <= RIGHT {
            return Ok(());
        }
        Err(wrong_second(path, "a direction across `direction`", cosine))
    }
}
