//! Checks of driven motions.

use std::collections::BTreeSet;

use super::checks::{Key, components, expected, keys, needed, quoted, shape, value};
use crate::scene::Error;
use crate::scene::description::{Kind as _, Motion, MotionKind, MotionValue, Value};
use crate::scene::resolved::{self, Resolved, Turning};
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
        let mut seen = BTreeSet::new();
        for (index, motion) in self.scene.motions.iter().enumerate() {
            let path = format!("motions[{index}]");
            let kind = self.resolve_motion(&path, motion)?;
            if !seen.insert((motion.kind as u8, kind.of())) {
                let wanted = "a motion of what is not driven yet";
                return Err(expected(&path, wanted, quoted(kind.of())));
            }
            let holder = self.hold(&path, &motion.name);
            self.motions.push(resolved::Motion {
                name: &motion.name,
                holder,
                kind,
                values: motion.value.components(),
            });
        }
        Ok(())
    }

    fn resolve_motion(
        &mut self,
        path: &str,
        motion: &'a Motion,
    ) -> Result<resolved::MotionKind<'a>, Error> {
        use resolved::MotionKind as Kind;
        let all: [Key; 2] = [
            ("marker", motion.marker.is_some(), "a name"),
            ("joint", motion.joint.is_some(), "a name"),
        ];
        if motion.kind == MotionKind::Angle && motion.marker.is_some() == motion.joint.is_some() {
            let found = motion.marker.as_ref().map_or("neither", |_| "both");
            return Err(expected(path, "either a marker or a joint", found));
        }
        keys(path, "motion", &all, motion.kind.keys())?;
        let [at_marker, at_joint, at_value] =
            ["marker", "joint", "value"].map(|key| format!("{path}.{key}"));
        let marker = || needed(path, "marker", "a name", motion.marker.as_deref());
        let joint = || needed(path, "joint", "a name", motion.joint.as_deref());
        Ok(match (motion.kind, &motion.joint) {
            (MotionKind::Position, _) => {
                let marker = self.require_marker(&at_marker, marker()?)?;
                Kind::Position(marker, self.vector_of_drives(&at_value, &motion.value)?)
            }
            (MotionKind::Orientation, _) => {
                let marker = self.require_driven(&at_marker, marker()?)?;
                Kind::Orientation(marker, self.quaternion_of_drives(&at_value, &motion.value)?)
            }
            (MotionKind::Angle, None) => {
                let turning =
                    Turning::Marker(self.require_turning(&at_marker, marker()?, NO_ANGLE)?);
                Kind::Angle(turning, self.one_drive(&at_value, &motion.value)?)
            }
            (MotionKind::Angle, Some(joint)) => {
                let turning = Turning::Pivot(self.require_pivot(&at_joint, joint)?);
                Kind::Angle(turning, self.one_drive(&at_value, &motion.value)?)
            }
            (MotionKind::Winch, _) => {
                let marker = self.require_paid_out(&at_marker, marker()?)?;
                if let MotionValue::One(Value::Number(number)) = &motion.value
                    && *number != 0.0
                {
                    let wanted = "a length that begins at 0, since the cable is as long as its shape at the start";
                    return Err(expected(&at_value, wanted, number));
                }
                Kind::Winch(marker, self.one_drive(&at_value, &motion.value)?)
            }
            (MotionKind::Displacement, _) => {
                let slider = self.require_slider(&at_joint, joint()?)?;
                Kind::Displacement(slider, self.one_drive(&at_value, &motion.value)?)
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
            MotionValue::Input(input) => Ok(self.turned(derivatives(path, input.input)?)),
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
    pub(super) fn turned(&mut self, derivatives: usize) -> Vec<Drive> {
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
