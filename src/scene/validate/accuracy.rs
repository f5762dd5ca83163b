//! Checks what accuracy is asked for, and what inputs do while it is planned.

use std::ops::RangeInclusive;

use super::TOLERANCE;
use super::checks::expected;
use crate::scene::{Course, Error, InputCourse, Scene};

/// Errors of outputs that can be asked for.
const ERROR: RangeInclusive<f64> = 1e-8..=0.1;

impl Scene {
    /// Checks the tolerance, the wanted error and the profiles of inputs.
    ///
    /// # Errors
    /// A number out of range, or a profile that is not valid.
    pub(super) fn validate_accuracy(&self) -> Result<(), Error> {
        let within = |key: &str, range: &RangeInclusive<f64>, value: f64| {
            let wanted = format!("a number from {:e} to {:e}", range.start(), range.end());
            if range.contains(&value) {
                Ok(())
            } else {
                Err(expected(&format!("accuracy.{key}"), &wanted, value))
            }
        };
        within("relative_tolerance", &TOLERANCE, self.relative_tolerance())?;
        for (place, course) in self.accuracy.input_profiles.iter().enumerate() {
            self.validate_course(&format!("accuracy.input_profiles[{place}]"), course)?;
        }
        let Some(error) = self.accuracy.error else {
            return Ok(());
        };
        within("error", &ERROR, error)?;
        match self.accuracy.relative_tolerance {
            Some(_) if self.is_to_be_planned() => {
                let wanted = "nothing beside `relative_tolerance`, which follows from it with the numbers of elements";
                Err(expected("accuracy.error", wanted, error))
            }
            _ => Ok(()),
        }
    }

    /// Checks the profile of an input in the experiment that is planned for.
    fn validate_course(&self, path: &str, course: &InputCourse) -> Result<(), Error> {
        let ends = [course.from, course.to];
        let Some(value) = &course.value else {
            if ends.contains(&None) {
                let found = match ends {
                    [Some(_), None] => "`from` alone",
                    [None, Some(_)] => "`to` alone",
                    _ => "neither",
                };
                return Err(expected(path, "`value`, or `from` and `to`", found));
            }
            let Some(duration) = course.duration else {
                return Ok(());
            };
            let (key, stop) = (format!("{path}.duration"), self.experiment.stop_time);
            let is_ramp = course.course.unwrap_or_default() == Course::Ramp;
            return if !is_ramp {
                Err(expected(&key, "nothing, but of a ramp", duration))
            } else if duration > 0.0 && duration <= stop {
                Ok(())
            } else {
                let wanted = format!("more than 0 and at most {stop} s");
                Err(expected(&key, &wanted, duration))
            };
        };
        let others = [course.course.is_some(), course.duration.is_some()];
        if ends != [None; 2] || others.contains(&true) {
            let message = "expected no `from`, `to`, `course` or `duration` beside it, found one";
            return Err(Error::new(format!("{path}.value"), message));
        }
        match value.function() {
            Ok(_) => Ok(()),
            Err(message) => Err(Error::new(format!("{path}.value"), message)),
        }
    }
}
