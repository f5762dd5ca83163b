//! Screws.

use super::*;

/// A screw.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Screw {
    /// Markers that the joint connects: `ground` or the `body.marker` of a rigid body that carries the axis, then the `body.marker` on it.
    pub markers: [String; 2],
    /// With `ground` only: a point of the line on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Axis of the screw. It is given in the axes of the first marker's body at the start: of `ground` the global axes.
    pub direction: SceneVector,
    /// Displacement along the axis for each full turn, m; negative for a left-handed thread.
    pub pitch: f64,
}

impl SceneJoint for Screw {
    fn parts(&self) -> JointParts {
        let (along, pitch) = (self.direction.full(), JointPrimitive::Screw(self.pitch));
        JointParts::new(
            Symbol::Prismatic,
            [Inline(along), ParallelAxes(along), pitch],
        )
        .at(self.point)
        .along([Some(self.direction), None])
    }

    /// A line that belongs to a cable or a rod has no displacement along it that a thread could relate.
    fn check(&self, path: &str, ends: &Ends<'_>) -> Found<()> {
        if let First::Marker(marker) = ends.first
            && matches!(marker.place, Place::Along(..))
        {
            let wanted = "the ground or a marker of a rigid body, which carries the axis";
            let place = format!("{path}.markers[0]");
            return Err(expected(&place, wanted, quoted(marker.name)));
        }
        not_zero(&format!("{path}.pitch"), "m", self.pitch)
    }
}
