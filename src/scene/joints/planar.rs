//! Planar joints.

use super::*;

/// A planar joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Planar {
    /// Markers that the joint connects: `ground` or the `body.marker` that carries the plane, then the `body.marker` in the plane.
    pub markers: [String; 2],
    /// With `ground` only: a point of the plane on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Normal of the plane, which is the axis of rotation too. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    pub direction: SceneVector,
}

impl SceneJoint for Planar {
    fn parts(&self) -> JointParts {
        let normal = self.direction.full();
        JointParts::new(Symbol::Slider, [Inplane(normal), ParallelAxes(normal)])
            .at(self.point)
            .along([Some(self.direction), None])
    }
}
