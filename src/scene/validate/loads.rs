//! Checks of loads.

use super::checks::{Key, expected, keys, not_negative, spring_damper, value};
use crate::scene::{Error, Load, LoadKind, LoadValue, Scene, Value};

impl Load {
    fn validate_keys(&self, path: &str) -> Result<(), Error> {
        let all: [Key; 10] = [
            ("marker", self.marker.is_some(), "a name"),
            ("joint", self.joint.is_some(), "a name"),
            ("body", self.body.is_some(), "a name"),
            ("markers", self.markers.is_some(), "two names"),
            ("point", self.point.is_some(), "a point [x, y]"),
            ("follower", self.follower, "true"),
            ("value", self.value.is_some(), "a value"),
            ("stiffness", self.stiffness.is_some(), "a stiffness"),
            ("damping", self.damping.is_some(), "a damping"),
            ("length", self.length.is_some(), "a length"),
        ];
        let (must, may): (&[&str], &[&str]) = match self.kind {
            LoadKind::Force => (&["marker", "value"], &["follower"]),
            LoadKind::Moment => (&["marker", "value"], &[]),
            LoadKind::Torque => (&["joint", "value"], &[]),
            LoadKind::Distributed => (&["body", "value"], &[]),
            LoadKind::SpringDamper => (&["markers"], &["point", "stiffness", "damping", "length"]),
        };
        keys(path, "load", &all, must, may)
    }

    fn validate_values(&self, path: &str) -> Result<(), Error> {
        let place = format!("{path}.value");
        let is_vector = matches!(self.kind, LoadKind::Force | LoadKind::Distributed);
        match &self.value {
            None => Ok(()),
            Some(LoadValue::One(_)) if is_vector => {
                Err(expected(&place, "two values [x, y]", "one value"))
            }
            Some(LoadValue::Two(_)) if !is_vector => Err(expected(&place, "one value", "two")),
            Some(LoadValue::One(of)) => value(&place, of, false),
            Some(LoadValue::Two(values)) => {
                value(&format!("{place}[0]"), &values[0], false)?;
                value(&format!("{place}[1]"), &values[1], false)
            }
        }
    }
}

impl Scene {
    pub(super) fn validate_load(&self, path: &str, load: &Load) -> Result<(), Error> {
        load.validate_keys(path)?;
        if let Some(marker) = &load.marker {
            let place = format!("{path}.marker");
            if load.kind == LoadKind::Moment || load.follower {
                self.require_turning(&place, marker)?;
            }
            self.require_marker(&place, marker)?;
        }
        if let Some(joint) = &load.joint {
            self.require_pivot(&format!("{path}.joint"), joint)?;
        }
        if let Some(body) = &load.body {
            self.require_cable(&format!("{path}.body"), body)?;
        }
        if let Some(markers) = &load.markers {
            self.require_pair(path, markers, load.point)?;
            let stiffness = (load.stiffness, "N/m");
            spring_damper(path, stiffness, (load.damping, "N s/m"))?;
        }
        let place = format!("{path}.length");
        match &load.length {
            Some(Value::Number(length)) => not_negative(&place, "m", *length)?,
            Some(length) => value(&place, length, false)?,
            None => {}
        }
        load.validate_values(path)
    }
}
