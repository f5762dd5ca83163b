//! Driven displacements.

use super::*;

/// A driven displacement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DisplacementMotion {
    /// Name of the joint whose displacement is driven.
    pub joint: String,
    /// Course of the displacement in time, m.
    pub value: MotionValue,
}

impl SceneMotion for DisplacementMotion {
    type Of<'a> = Slider<'a>;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Of<'a>> {
        scene.require_slider(&format!("{path}.joint"), &self.joint)
    }

    fn quantity<'a>(of: &Self::Of<'a>) -> DrivenQuantity<'a> {
        DrivenQuantity {
            place: LoadPlace::Coordinate(JointCoordinate::Displacement(*of)),
            exerts: [true, false],
            start: vec![of.start()],
            orders: displacement("displacement", "Displacement"),
            words: "the way along",
        }
    }

    fn primitive<const D: usize>(
        of: &Self::Of<'_>,
        builder: &mut Builder<'_, D>,
        drives: &[usize],
    ) -> Primitive<D> {
        if of.ends.is_grounded() {
            return Primitive::DrivenDistance(unit(of.direction), drives[0]);
        }
        let coordinate = Coordinate::Translation(builder.way(of));
        builder.held(coordinate, 0.0, Some(drives[0]))
    }
}
