//! Checks of joints.

use super::checks::{Key, expected, finite, keys, positive, quoted, spring_damper, vector};
use crate::scene::{Error, GROUND, Joint, JointKind, Scene};

impl Joint {
    fn validate_keys(&self, path: &str) -> Result<(), Error> {
        let all: [Key; 6] = [
            ("point", self.point.is_some(), "a point [x, y]"),
            ("direction", self.direction.is_some(), "a direction [x, y]"),
            ("angle", self.angle.is_some(), "an angle"),
            ("length", self.length.is_some(), "a length"),
            ("stiffness", self.stiffness.is_some(), "a stiffness"),
            ("damping", self.damping.is_some(), "a damping"),
        ];
        let (must, may): (&[&str], &[&str]) = match self.kind {
            JointKind::Revolute => (&[], &["point"]),
            JointKind::Weld => (&[], &["point", "angle"]),
            JointKind::Slider => (&["direction"], &["point"]),
            JointKind::Orientation => (&[], &["angle"]),
            JointKind::Distance => (&[], &["point", "length"]),
            JointKind::Hinge => (&[], &["point", "angle", "stiffness", "damping"]),
            JointKind::Along => (&[], &[]),
        };
        keys(path, "joint", &all, must, may)
    }

    fn validate_numbers(&self, path: &str) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        if let Some(direction) = self.direction {
            vector(&at("direction"), direction)?;
            if direction[0].hypot(direction[1]) <= 0.0 {
                let wanted = "a direction that is not zero";
                return Err(expected(&at("direction"), wanted, "[0, 0]"));
            }
        }
        if let Some(angle) = self.angle {
            finite(&at("angle"), angle)?;
        }
        if let Some(length) = self.length {
            positive(&at("length"), "m", length)?;
        }
        if self.kind == JointKind::Hinge {
            let stiffness = (self.stiffness, "N m/rad");
            spring_damper(path, stiffness, (self.damping, "N m s/rad"))?;
        }
        Ok(())
    }
}

impl Scene {
    pub(super) fn validate_joint(&self, path: &str, joint: &Joint) -> Result<(), Error> {
        joint.validate_keys(path)?;
        let [first, second] = [0, 1].map(|side| format!("{path}.markers[{side}]"));
        let [a, b] = &joint.markers;
        if joint.kind == JointKind::Along {
            let cable = self.require_cable(&first, a)?;
            let marker = self.require_marker(&second, b)?;
            return self.require_two(path, cable, marker.body);
        }
        if joint.kind == JointKind::Slider && a != GROUND {
            return Err(expected(&first, "\"ground\"", quoted(a)));
        }
        self.require_pair(path, &joint.markers, joint.point)?;
        use JointKind::{Hinge, Orientation, Weld};
        if matches!(joint.kind, Weld | Orientation | Hinge) {
            if a != GROUND {
                self.require_turning(&first, a)?;
            }
            self.require_turning(&second, b)?;
        }
        joint.validate_numbers(path)?;
        let apart = joint.length.is_some() || self.distance(&joint.markers, joint.point) > 0.0;
        if joint.kind == JointKind::Distance && !apart {
            let wanted = "a length, since the markers are at the same place at the start";
            return Err(expected(&format!("{path}.length"), wanted, "nothing"));
        }
        Ok(())
    }
}
