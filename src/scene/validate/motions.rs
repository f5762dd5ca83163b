//! Checks of driven motions.

use std::collections::HashSet;
use std::mem::discriminant;

use super::checks::{components, expected, quoted, shape, value};
use crate::scene::Error;
use crate::scene::description::{MotionKind as Given, MotionValue, Value};
use crate::scene::resolved::{self, DirectionSource, Resolved};
use crate::system::{Attitude, Drive};

/// Replacement in space for a driven angle of a marker, in a message.
const NO_ANGLE: &str = "nothing in space, where a motion of kind `orientation` drives a marker and one of kind `angle` a joint with an axis,";
/// Most derivatives that the master sets with a motion.
const MOST_DERIVATIVES: u8 = 2;

impl<'a> Resolved<'a> {
    /// Resolves the motions without those of ports.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, a coordinate that is driven twice, or a course that is not
    /// valid.
    pub(super) fn resolve_motions(&mut self) -> Result<(), Error> {
        // Inputs have the first numbers.
        let inputs = self.scene.inputs.iter();
        let dimension = self.scene.dimension;
        self.numbers = inputs.map(|input| input.components(dimension)).sum();
        let mut seen = HashSet::new();
        for (index, motion) in self.scene.motions.iter().enumerate() {
            let path = format!("motions[{index}]");
            let kind = self.resolve_motion(&path, &motion.kind)?;
            if !seen.insert((discriminant(&motion.kind), kind.of())) {
                let wanted = "a motion of what is not driven yet";
                return Err(expected(&path, wanted, quoted(kind.of())));
            }
            let holder = self.hold(&path, &motion.name);
            self.motions.push(resolved::ResolvedMotion {
                name: &motion.name,
                holder,
                kind,
                values: motion.kind.value().components(),
            });
        }
        Ok(())
    }

    fn resolve_motion(
        &mut self,
        path: &str,
        motion: &'a Given,
    ) -> Result<resolved::MotionKind<'a>, Error> {
        use resolved::MotionKind as Kind;
        let at = |key: &str| format!("{path}.{key}");
        let (at_marker, at_value) = (at("marker"), at("value"));
        Ok(match motion {
            Given::Position(of) => {
                let marker = self.require_marker(&at_marker, &of.marker)?;
                Kind::Position(marker, self.vector_of_drives(&at_value, &of.value)?)
            }
            Given::Orientation(of) => {
                let marker = self.require_driven(&at_marker, &of.marker)?;
                Kind::Orientation(marker, self.quaternion_of_drives(&at_value, &of.value)?)
            }
            Given::Angle(of) => {
                let source = match (&of.marker, &of.joint) {
                    (Some(marker), None) => {
                        DirectionSource::Marker(self.require_turning(&at_marker, marker, NO_ANGLE)?)
                    }
                    (None, Some(joint)) => {
                        DirectionSource::Pivot(self.require_pivot(&at("joint"), joint)?)
                    }
                    (marker, _) => {
                        let found = marker.as_ref().map_or("neither", |_| "both");
                        return Err(expected(path, "either a marker or a joint", found));
                    }
                };
                Kind::Angle(source, self.one_drive(&at_value, &of.value)?)
            }
            Given::Winch(of) => {
                let marker = self.require_paid_out(&at_marker, &of.marker)?;
                if let MotionValue::One(Value::Number(number)) = &of.value
                    && *number != 0.0
                {
                    let wanted = "a length that begins at 0, since the cable is as long as its shape at the start";
                    return Err(expected(&at_value, wanted, number));
                }
                Kind::Winch(marker, self.one_drive(&at_value, &of.value)?)
            }
            Given::Displacement(of) => {
                let slider = self.require_slider(&at("joint"), &of.joint)?;
                Kind::Displacement(slider, self.one_drive(&at_value, &of.value)?)
            }
        })
    }

    fn one_drive(&mut self, path: &str, given: &MotionValue) -> Result<Drive, Error> {
        match given {
            MotionValue::Input(input) => Ok(self.driven(derivatives(path, input.input)?)),
            MotionValue::One(of) => value(path, of, true).map(Drive::Function),
            MotionValue::Vector(values) => Err(expected(path, "one value", values.len())),
        }
    }

    fn vector_of_drives(&mut self, path: &str, given: &MotionValue) -> Result<Vec<Drive>, Error> {
        let dimension = self.scene.dimension;
        match given {
            MotionValue::Input(input) => {
                let derivatives = derivatives(path, input.input)?;
                Ok((0..dimension).map(|_| self.driven(derivatives)).collect())
            }
            MotionValue::One(_) => {
                let shape = shape(dimension);
                let wanted = format!("{dimension} values {shape} or {{\"input\": 0, 1 or 2}}");
                Err(expected(path, &wanted, "one value"))
            }
            MotionValue::Vector(values) => components(path, dimension, values, |place, of| {
                value(place, of, true).map(Drive::Function)
            }),
        }
    }

    fn quaternion_of_drives(
        &mut self,
        path: &str,
        given: &MotionValue,
    ) -> Result<Vec<Drive>, Error> {
        match given {
            MotionValue::Input(input) => Ok(self.rotation_drives(derivatives(path, input.input)?)),
            MotionValue::Vector(values) if values.len() == 4 => {
                let values = values.iter().enumerate();
                let part = |(k, of)| value(&format!("{path}[{k}]"), of, true);
                values.map(|of| part(of).map(Drive::Function)).collect()
            }
            MotionValue::One(_) | MotionValue::Vector(_) => {
                let wanted = "4 values [w, x, y, z] or {\"input\": 0, 1 or 2}";
                let found = match given {
                    MotionValue::Vector(values) => format!("{} values", values.len()),
                    _ => "one value".into(),
                };
                Err(expected(path, wanted, found))
            }
        }
    }

    /// The parts of an orientation that the master drives, with as many derivatives.
    pub(super) fn rotation_drives(&mut self, derivatives: usize) -> Vec<Drive> {
        let first = self.numbers;
        let attitude = Attitude { first, derivatives };
        self.place(attitude.count());
        let part = |part| Drive::Turned { attitude, part };
        (0..4).map(part).collect()
    }

    /// A coordinate that the master drives, with as many derivatives.
    pub(super) fn driven(&mut self, derivatives: usize) -> Drive {
        Drive::Input {
            first: self.place(1 + derivatives),
            derivatives,
        }
    }
}

fn derivatives(path: &str, input: u8) -> Result<usize, Error> {
    if input > MOST_DERIVATIVES {
        return Err(expected(&format!("{path}.input"), "0, 1 or 2", input));
    }
    Ok(input.into())
}
