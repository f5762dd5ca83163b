//! Checks of ports.

use std::collections::BTreeSet;

use super::checks::{Key, expected, keys, not_negative, quoted, spring_damper};
use crate::scene::{Error, MotionKind, Port, PortKind, Scene};

impl Port {
    fn validate_keys(&self, path: &str) -> Result<(), Error> {
        let all: [Key; 4] = [
            ("stiffness", self.stiffness.is_some(), "a stiffness"),
            ("damping", self.damping.is_some(), "a damping"),
            (
                "rotational_stiffness",
                self.rotational_stiffness.is_some(),
                "a rotational stiffness",
            ),
            (
                "rotational_damping",
                self.rotational_damping.is_some(),
                "a rotational damping",
            ),
        ];
        let may = all.map(|(key, ..)| key);
        match self.kind {
            PortKind::Force => keys(path, "port", &all, &[], &[]),
            PortKind::Motion => keys(path, "port", &all, &[], &may),
        }
    }

    fn validate_springs(&self, path: &str) -> Result<(), Error> {
        let turning = [
            ("rotational_stiffness", self.rotational_stiffness, "N m/rad"),
            ("rotational_damping", self.rotational_damping, "N m s/rad"),
        ];
        let is_turning = turning.iter().any(|(_, value, _)| value.is_some());
        if !self.is_coupling() && !is_turning {
            return Ok(());
        }
        spring_damper(path, (self.stiffness, "N/m"), (self.damping, "N s/m"))?;
        if self.rotation && !is_turning {
            let wanted = "a rotational stiffness or a rotational damping";
            return Err(expected(path, wanted, "neither"));
        }
        for (key, value, unit) in turning {
            if let Some(value) = value {
                not_negative(&format!("{path}.{key}"), unit, value)?;
            }
        }
        Ok(())
    }
}

impl Scene {
    pub(super) fn validate_ports(&self) -> Result<(), Error> {
        let motions = self.motions.iter();
        let driven = motions.map(|motion| (motion.kind as u8, motion.marker.clone()));
        let mut driven: BTreeSet<(u8, Option<String>)> = driven.collect();
        for (index, port) in self.ports.iter().enumerate() {
            let path = format!("ports[{index}]");
            let place = format!("{path}.marker");
            port.validate_keys(&path)?;
            port.validate_springs(&path)?;
            self.require_marker(&place, &port.marker)?;
            if port.turns() {
                self.require_turning(&place, &port.marker)?;
            }
            if !port.drives() {
                continue;
            }
            for motion in port.motions() {
                if !driven.insert((motion.kind as u8, motion.marker)) {
                    let wanted = match motion.kind {
                        MotionKind::Angle => "a marker whose direction is not driven yet",
                        _ => "a marker that is not driven yet",
                    };
                    return Err(expected(&place, wanted, quoted(&port.marker)));
                }
            }
        }
        Ok(())
    }
}
