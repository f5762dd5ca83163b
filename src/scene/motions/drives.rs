//! Courses of driven coordinates in time: functions, or what the master sets.

use super::*;

/// Most derivatives that the master sets with a motion.
const MOST_DERIVATIVES: u8 = 2;

impl Resolved<'_> {
    /// Reads the course of one coordinate.
    ///
    /// # Errors
    /// Several values, or one that is not valid.
    pub(super) fn one_drive(&mut self, path: &str, given: &MotionValue) -> Found<Drive> {
        match given {
            MotionValue::Input(input) => Ok(self.driven(derivatives(path, input.input)?)),
            MotionValue::One(of) => value(path, of, true).map(Drive::Function),
            MotionValue::Vector(values) => Err(expected(path, "one value", values.len())),
        }
    }

    /// Reads the courses of the components of a vector.
    ///
    /// # Errors
    /// Another number of values, or one that is not valid.
    pub(super) fn vector_of_drives(
        &mut self,
        path: &str,
        given: &MotionValue,
    ) -> Found<Vec<Drive>> {
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

    /// Reads the courses of the parts of a quaternion.
    ///
    /// # Errors
    /// Another number of values, or one that is not valid.
    pub(super) fn quaternion_of_drives(
        &mut self,
        path: &str,
        given: &MotionValue,
    ) -> Found<Vec<Drive>> {
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
    pub(in crate::scene) fn rotation_drives(&mut self, derivatives: usize) -> Vec<Drive> {
        let first = self.numbers;
        let attitude = Attitude { first, derivatives };
        self.place(attitude.count());
        let part = |part| Drive::Turned { attitude, part };
        (0..4).map(part).collect()
    }

    /// A coordinate that the master drives, with as many derivatives.
    pub(in crate::scene) fn driven(&mut self, derivatives: usize) -> Drive {
        Drive::Input {
            first: self.place(1 + derivatives),
            derivatives,
        }
    }
}

fn derivatives(path: &str, input: u8) -> Found<usize> {
    if input > MOST_DERIVATIVES {
        return Err(expected(&format!("{path}.input"), "0, 1 or 2", input));
    }
    Ok(input.into())
}
