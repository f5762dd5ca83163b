//! Prismatic joints.

use super::*;

/// A prismatic joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Prismatic {
    /// Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    pub markers: [String; 2],
    /// With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Direction of the line, required in space; in the plane by default the direction of the first marker. It is given in the axes of
    /// the first marker's body at the start: of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<SceneVector>,
    /// In the plane only: angle from the direction of the first marker to that of the second, rad; by default the angle at the start.
    /// The direction of `ground` is 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
}

impl SceneJoint for Prismatic {
    fn parts(&self) -> JointParts {
        // By default the direction of the first end itself.
        let along = self.direction.map_or([1.0, 0.0, 0.0], |of| of.full());
        JointParts::new(Symbol::Prismatic, [Inline(along), Orientation(self.angle)])
            .at(self.point)
            .along([self.direction, None])
    }

    fn check_dimension(&self, path: &str, dimension: usize) -> Found<()> {
        if dimension == 3 && self.direction.is_none() {
            let place = format!("{path}.direction");
            return Err(expected(&place, "a direction [x, y, z]", "nothing"));
        }
        Ok(())
    }
}
