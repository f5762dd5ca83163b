//! Lengths without force of springs and ropes, which may change in time or be inputs.

use super::*;

/// Length without force of a load, m, which an input may set.
pub struct RestLength<'s> {
    /// Course in time; that at the start if there is none.
    pub course: &'s mut Option<Signal>,
    /// Length at the start, m; none where it changes in time.
    pub start: Option<f64>,
}

/// Key of a length without force.
pub fn timed(length: Option<&Value>) -> Option<TimedKey<'_>> {
    Some(TimedKey {
        key: "length",
        values: std::slice::from_ref(length?),
        // The rate at which the length changes does work.
        order: 1,
    })
}

/// Course of a length without force in time, where one is given. Of a number `check` tells whether it may be.
///
/// # Errors
/// `check` refuses the number, or the value cannot be read.
pub fn course(
    path: &str,
    length: Option<&Value>,
    check: fn(&str, &str, f64) -> Result<(), Error>,
) -> Result<Option<Signal>, Error> {
    let path = format!("{path}.length");
    if let Some(Value::Number(length)) = length {
        check(&path, "m", *length)?;
    }
    let course = length.map(|length| value(&path, length, false));
    Ok(course.transpose()?.map(Signal::Function))
}

/// Length without force at the start, m, by default `drawn`; none where it changes in time.
pub fn at_start(length: Option<&Value>, drawn: impl Fn() -> f64) -> Option<f64> {
    match length {
        None => Some(drawn()),
        Some(Value::Number(length)) => Some(*length),
        Some(_) => None,
    }
}

impl Resolved<'_> {
    /// Makes the length without force of a spring-damper or a rope, which nothing else changes, an input; what it was, m.
    ///
    /// # Errors
    /// There is no such load, or its length changes in time.
    pub(in crate::scene) fn set_rest_length(
        &mut self,
        path: &str,
        name: &str,
        first: usize,
    ) -> Result<f64, Error> {
        let wanted = "a spring_damper or a reeving of this scene";
        let length = self.require_load(path, name, wanted, |load| match load {
            ResolvedLoadKind::SpringDamper(spring) => Some(spring.rest_length()),
            ResolvedLoadKind::Reeving(rope) => Some(rope.rest_length()),
            _ => None,
        })?;
        let Some(start) = length.start else {
            let wanted = "a load whose length is a number";
            let found = format!("{}, whose length changes in time", quoted(name));
            return Err(expected(path, wanted, found));
        };
        *length.course = Some(Signal::Input(first));
        Ok(start)
    }
}
