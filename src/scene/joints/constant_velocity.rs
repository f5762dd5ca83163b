//! Constant-velocity joints.

use super::*;

/// A constant-velocity joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ConstantVelocity {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Axis of the first shaft. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    pub direction: SceneVector,
    /// Axis of the second shaft in the same axes and sense, less than a right angle from `direction`; by default `direction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second_direction: Option<SceneVector>,
}

impl SceneJoint for ConstantVelocity {
    fn parts(&self) -> JointParts {
        let axes = Homokinetic(self.direction.full(), self.second().full());
        JointParts::new(Symbol::Pin, [AtPoint, axes])
            .at(self.point)
            .along([Some(self.direction), self.second_direction])
    }

    fn check(&self, path: &str, _ends: &Ends<'_>) -> Found<()> {
        let cosine = cosine(self.direction, self.second());
        if cosine > RIGHT {
            return Ok(());
        }
        let wanted = "a direction less than a right angle from `direction`";
        Err(wrong_second(path, wanted, cosine))
    }
}

impl ConstantVelocity {
    /// Axis of the second shaft.
    fn second(&self) -> SceneVector {
        self.second_direction.unwrap_or(self.direction)
    }
}
