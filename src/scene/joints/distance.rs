//! Links of constant length.

use super::*;

/// A link of constant length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistanceJoint {
    /// Markers at the ends of the link: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: end of the link on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Length of the link, m; by default the distance of its ends at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: Option<f64>,
}

impl SceneJoint for DistanceJoint {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Link, [Distance(self.length)]).at(self.point)
    }

    fn check(&self, path: &str, ends: &Ends<'_>) -> Found<()> {
        let place = format!("{path}.length");
        match self.length {
            Some(length) => positive(&place, "m", length),
            None if ends.distance() <= 0.0 => {
                let wanted = "a length, since the markers are at the same place at the start";
                Err(expected(&place, wanted, "nothing"))
            }
            None => Ok(()),
        }
    }
}
