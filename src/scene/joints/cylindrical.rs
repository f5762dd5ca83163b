//! Cylindrical joints.

use super::*;

/// A cylindrical joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Cylindrical {
    /// Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    pub markers: [String; 2],
    /// With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Direction of the line, which is the axis of rotation too. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    pub direction: SceneVector,
}

impl SceneJoint for Cylindrical {
    fn parts(&self) -> JointParts {
        let along = self.direction.full();
        JointParts::new(Symbol::Prismatic, [Inline(along), ParallelAxes(along)])
            .at(self.point)
            .along([Some(self.direction), None])
    }
}
