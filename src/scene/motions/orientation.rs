//! Driven orientations.

use super::*;

/// A driven orientation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OrientationMotion {
    /// Marker of the rigid body whose orientation is driven, `body.marker`.
    pub marker: String,
    /// Course of the quaternion in time: its four parts, scalar first.
    pub value: MotionValue,
}

impl SceneMotion for OrientationMotion {
    type Of<'a> = ResolvedMarker<'a>;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Of<'a>> {
        scene.require_driven(&format!("{path}.marker"), &self.marker)
    }

    fn drives(path: &str, given: &MotionValue, scene: &mut Resolved<'_>) -> Found<Vec<Drive>> {
        scene.quaternion_of_drives(path, given)
    }

    fn quantity<'a>(of: &Self::Of<'a>) -> DrivenQuantity<'a> {
        DrivenQuantity {
            place: LoadPlace::Marker(*of),
            exerts: [false, true],
            start: of.place.quaternion().to_vec(),
            orders: ROTATION_ORDERS,
            words: "the orientation of",
        }
    }

    fn primitive<const D: usize>(
        of: &Self::Of<'_>,
        builder: &mut Builder<'_, D>,
        drives: &[usize],
    ) -> Primitive<D> {
        let axes = builder.frame_axes(*of);
        Primitive::DrivenOrientation(
            std::array::from_fn(|k| axes[k]),
            std::array::from_fn(|k| drives[k]),
        )
    }
}
