//! Driven angles.

use super::*;

/// A driven angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-either" = [["joint"], ["marker"]]))]
pub struct AngleMotion {
    /// Marker whose direction is driven in the plane, `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of the joint with an axis whose angle is driven.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Course of the angle in time, rad.
    pub value: MotionValue,
}

/// Replacement in space for a driven angle of a marker, in a message.
const NO_ANGLE: &str = "nothing in space, where a motion of kind `orientation` drives a marker and one of kind `angle` a joint with an axis,";

impl SceneMotion for AngleMotion {
    type Of<'a> = DirectionSource<'a>;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Of<'a>> {
        Ok(match (&self.marker, &self.joint) {
            (Some(marker), None) => {
                let path = format!("{path}.marker");
                DirectionSource::Marker(scene.require_turning(&path, marker, NO_ANGLE)?)
            }
            (None, Some(joint)) => {
                DirectionSource::Pivot(scene.require_pivot(&format!("{path}.joint"), joint)?)
            }
            (marker, _) => {
                let found = marker.as_ref().map_or("neither", |_| "both");
                return Err(expected(path, "either a marker or a joint", found));
            }
        })
    }

    fn quantity<'a>(of: &Self::Of<'a>) -> DrivenQuantity<'a> {
        let (place, start, words) = match *of {
            DirectionSource::Marker(marker) => {
                let [x, y, _] = marker.direction;
                (LoadPlace::Marker(marker), y.atan2(x), "the direction of")
            }
            DirectionSource::Pivot(pivot) => {
                // In space the angle is counted from the start.
                let start = pivot.axis.map_or(pivot.ends.angle(), |_| 0.0);
                let place = LoadPlace::Coordinate(JointCoordinate::Angle(pivot));
                (place, start, "the angle of")
            }
        };
        DrivenQuantity {
            place,
            exerts: [false, true],
            start: vec![start],
            orders: ROTATION_ORDERS,
            words,
        }
    }

    fn primitive<const D: usize>(
        of: &Self::Of<'_>,
        builder: &mut Builder<'_, D>,
        drives: &[usize],
    ) -> Primitive<D> {
        let drive = drives[0];
        match builder.axis_turn(of) {
            Some(turn) => Primitive::DrivenRotation(DrivenRotation { turn, drive }),
            None => Primitive::DrivenDirection(drive),
        }
    }
}
