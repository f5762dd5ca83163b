//! Joints that hold a point on a line.

use super::*;

/// A point on a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PointOnLineJoint {
    /// Markers that the joint connects: `ground` or the `body.marker` that carries the line, then the `body.marker` on the line.
    pub markers: [String; 2],
    /// With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Direction of the line. It is given in the axes of the first marker's body at the start: of `ground` the global axes, of a rod
    /// or beam the tangent and both axes of its section.
    // What is missing is told once the dimension is known.
    #[serde(default)]
    #[schemars(!default)]
    pub direction: SceneVector,
}

impl SceneJoint for PointOnLineJoint {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Slider, [Inline(self.direction.full())])
            .at(self.point)
            .along([Some(self.direction), None])
    }

    fn check_dimension(&self, path: &str, dimension: usize) -> Found<()> {
        if self.direction.is_unsaid() {
            let wanted = format!("a direction {}", shape(dimension));
            return Err(expected(&format!("{path}.direction"), &wanted, "nothing"));
        }
        Ok(())
    }
}
