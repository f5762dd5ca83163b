//! Driven positions.

use super::*;

/// A driven position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PositionMotion {
    /// Marker whose position is driven, `body.marker`.
    pub marker: String,
    /// Course of the position in time, m: two components in the plane, three in space.
    pub value: MotionValue,
}

impl SceneMotion for PositionMotion {
    type Of<'a> = ResolvedMarker<'a>;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Of<'a>> {
        scene.require_marker(&format!("{path}.marker"), &self.marker)
    }

    fn drives(path: &str, given: &MotionValue, scene: &mut Resolved<'_>) -> Found<Vec<Drive>> {
        scene.vector_of_drives(path, given)
    }

    fn quantity<'a>(of: &Self::Of<'a>) -> DrivenQuantity<'a> {
        DrivenQuantity {
            place: LoadPlace::Marker(*of),
            exerts: [true, false],
            start: of.position.to_vec(),
            orders: displacement("position", "Position"),
            words: "the position of",
        }
    }

    fn primitive<const D: usize>(
        _of: &Self::Of<'_>,
        _builder: &mut Builder<'_, D>,
        drives: &[usize],
    ) -> Primitive<D> {
        Primitive::DrivenPosition(std::array::from_fn(|k| drives[k]))
    }
}
