//! Checks of driven motions.

use std::collections::BTreeSet;

use super::checks::{Key, expected, keys, quoted, value};
use crate::scene::{Error, JointKind, Motion, MotionKind, MotionValue, Scene};

/// Most derivatives that the master sets with a motion.
const MOST_DERIVATIVES: u8 = 2;

impl Scene {
    pub(super) fn validate_motions(&self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (index, motion) in self.motions.iter().enumerate() {
            let path = format!("motions[{index}]");
            self.validate_motion(&path, motion)?;
            let of = motion.marker.as_ref().or(motion.joint.as_ref());
            if !seen.insert((motion.kind as u8, of)) {
                let name = of.map_or("it", String::as_str);
                let wanted = "a motion of what is not driven yet";
                return Err(expected(&path, wanted, quoted(name)));
            }
        }
        Ok(())
    }

    fn validate_motion(&self, path: &str, motion: &Motion) -> Result<(), Error> {
        let all: [Key; 2] = [
            ("marker", motion.marker.is_some(), "a name"),
            ("joint", motion.joint.is_some(), "a name"),
        ];
        let must: &[&str] = match (motion.kind, &motion.joint) {
            (MotionKind::Position, _) | (MotionKind::Angle, None) => &["marker"],
            (MotionKind::Displacement, _) | (MotionKind::Angle, Some(_)) => &["joint"],
        };
        if motion.kind == MotionKind::Angle && motion.marker.is_some() == motion.joint.is_some() {
            let found = motion.marker.as_ref().map_or("neither", |_| "both");
            return Err(expected(path, "either a marker or a joint", found));
        }
        keys(path, "motion", &all, must, &[])?;
        let place = format!("{path}.marker");
        if let Some(marker) = &motion.marker {
            match motion.kind {
                MotionKind::Angle => self.require_turning(&place, marker)?,
                _ => drop(self.require_marker(&place, marker)?),
            }
        }
        let place = format!("{path}.joint");
        if let Some(joint) = &motion.joint {
            match motion.kind {
                MotionKind::Angle => self.require_pivot(&place, joint)?,
                _ if self.require_joint(&place, joint)?.kind != JointKind::Slider => {
                    return Err(expected(&place, "a slider", quoted(joint)));
                }
                _ => {}
            }
        }
        motion.validate_value(&format!("{path}.value"))
    }
}

impl Motion {
    fn validate_value(&self, path: &str) -> Result<(), Error> {
        match (&self.value, self.kind) {
            (MotionValue::Input(input), _) if input.input > MOST_DERIVATIVES => {
                Err(expected(&format!("{path}.input"), "0, 1 or 2", input.input))
            }
            (MotionValue::Input(_), _) => Ok(()),
            (MotionValue::One(_), MotionKind::Position) => {
                let wanted = "two values [x, y] or {\"input\": 0, 1 or 2}";
                Err(expected(path, wanted, "one value"))
            }
            (MotionValue::Two(values), MotionKind::Position) => {
                value(&format!("{path}[0]"), &values[0], true)?;
                value(&format!("{path}[1]"), &values[1], true)
            }
            (MotionValue::One(of), _) => value(path, of, true),
            (MotionValue::Two(_), _) => Err(expected(path, "one value", "two")),
        }
    }
}
