//! Driven distances.

use super::*;

/// A driven distance between two markers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DistanceMotion {
    /// Markers whose distance is driven: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: end on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Course of the distance in time, m: above 0.
    pub value: MotionValue,
}

impl SceneMotion for DistanceMotion {
    type Of<'a> = Ends<'a>;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Of<'a>> {
        let ends = scene.require_pair(path, &self.markers, self.point)?;
        if ends.distance() <= 0.0 {
            let wanted = "markers that are not at the same place at the start";
            return Err(expected(
                &format!("{path}.markers"),
                wanted,
                "a distance of 0",
            ));
        }
        Ok(ends)
    }

    fn drives(path: &str, given: &MotionValue, scene: &mut Resolved<'_>) -> Found<Vec<Drive>> {
        let drive = scene.one_drive(path, given)?;
        if let Drive::Function(function) = &drive {
            let start = function.value(0.0);
            if start <= 0.0 {
                return Err(expected(path, "a distance above 0 m", start));
            }
        }
        Ok(vec![drive])
    }

    fn quantity<'a>(of: &Self::Of<'a>) -> DrivenQuantity<'a> {
        DrivenQuantity {
            place: LoadPlace::Ends(*of),
            exerts: [true, false],
            start: vec![of.distance()],
            orders: displacement("distance", "Distance"),
            words: "the distance to",
        }
    }

    fn primitive<const D: usize>(
        of: &Self::Of<'_>,
        builder: &mut Builder<'_, D>,
        drives: &[usize],
    ) -> Primitive<D> {
        let length = Coordinate::Length(builder.ends(*of));
        builder.held(length, 0.0, Some(drives[0]))
    }
}
