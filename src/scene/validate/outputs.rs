//! Checks of outputs.

use std::collections::BTreeSet;

use super::checks::{Key, expected, keys, quoted};
use crate::scene::{Error, JointKind, MotionKind, Output, OutputKind, Scene};

/// Most natural frequencies: they are computed with dense matrices.
const MOST_FREQUENCIES: u32 = 100;

impl Output {
    fn validate_keys(&self, path: &str) -> Result<(), Error> {
        use OutputKind::*;
        let all: [Key; 5] = [
            ("marker", self.marker.is_some(), "a name"),
            ("joint", self.joint.is_some(), "a name"),
            ("motion", self.motion.is_some(), "a name"),
            ("body", self.body.is_some(), "a name"),
            ("count", self.count.is_some(), "a count"),
        ];
        let (must, may): (&[&str], &[&str]) = match self.kind {
            Position | Velocity | Acceleration | Strain | Curvature | AxialForce
            | BendingMoment | ConnectivityForce => (&["marker"], &[]),
            Angle | AngularVelocity | AngularAcceleration if self.joint.is_some() => {
                (&["joint"], &["marker"])
            }
            Angle | AngularVelocity | AngularAcceleration => (&["marker"], &[]),
            Travel => (&["joint"], &[]),
            Reaction | ReactionMoment if self.motion.is_some() => (&["motion"], &["joint"]),
            Reaction | ReactionMoment => (&["joint"], &[]),
            Energy | Work | Momentum | CenterOfMass | Residual => (&[], &[]),
            NaturalFrequency => (&[], &["body", "count"]),
        };
        keys(path, "output", &all, must, may)?;
        let of = [&self.marker, &self.joint, &self.motion];
        if of.into_iter().flatten().count() > 1 {
            return Err(expected(path, "one name of what is read", "two"));
        }
        Ok(())
    }

    fn validate_count(&self, path: &str) -> Result<(), Error> {
        let is_right = |count| (1..=MOST_FREQUENCIES).contains(&count);
        if self.kind != OutputKind::NaturalFrequency || self.count.is_some_and(is_right) {
            return Ok(());
        }
        let wanted = format!("an integer from 1 to {MOST_FREQUENCIES}");
        let found = self.count.map_or("nothing".into(), |n| n.to_string());
        Err(expected(&format!("{path}.count"), &wanted, found))
    }
}

impl Scene {
    pub(super) fn validate_outputs(&self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (index, output) in self.outputs.iter().enumerate() {
            let path = format!("outputs[{index}]");
            output.validate_keys(&path)?;
            output.validate_count(&path)?;
            if let Some(name) = &output.marker {
                self.validate_marker_output(&format!("{path}.marker"), output.kind, name)?;
            }
            if let Some(name) = &output.joint {
                self.validate_joint_output(&format!("{path}.joint"), output.kind, name)?;
            }
            if let Some(name) = &output.motion {
                self.validate_motion_output(&format!("{path}.motion"), output.kind, name)?;
            }
            if let Some(name) = &output.body {
                self.validate_body_output(&format!("{path}.body"), name)?;
            }
            let of = [&output.marker, &output.joint, &output.motion, &output.body];
            if !seen.insert((output.kind as u8, of)) {
                return Err(expected(&path, "an output not declared before", "it again"));
            }
        }
        Ok(())
    }

    fn validate_marker_output(
        &self,
        path: &str,
        kind: OutputKind,
        name: &str,
    ) -> Result<(), Error> {
        match kind {
            OutputKind::Position | OutputKind::Velocity | OutputKind::Acceleration => {
                self.require_marker(path, name).map(drop)
            }
            OutputKind::Angle | OutputKind::AngularVelocity | OutputKind::AngularAcceleration => {
                self.require_turning(path, name)
            }
            _ => self.require_cable_marker(path, name),
        }
    }

    fn validate_joint_output(&self, path: &str, kind: OutputKind, name: &str) -> Result<(), Error> {
        let joint = self.require_joint(path, name)?.kind;
        let (wanted, offered) = match kind {
            OutputKind::Travel => ("a joint of kind along", joint == JointKind::Along),
            OutputKind::Reaction => (
                "a joint that transmits a force",
                joint != JointKind::Orientation,
            ),
            OutputKind::ReactionMoment => (
                "a joint that transmits a moment",
                matches!(joint, JointKind::Weld | JointKind::Orientation),
            ),
            _ => return self.require_pivot(path, name),
        };
        if offered {
            return Ok(());
        }
        Err(expected(path, wanted, quoted(name)))
    }

    fn validate_motion_output(
        &self,
        path: &str,
        kind: OutputKind,
        name: &str,
    ) -> Result<(), Error> {
        let Some(motion) = self.motion(name) else {
            return Err(expected(path, "a motion of this scene", quoted(name)));
        };
        let by_moment = self.motions[motion].kind == MotionKind::Angle;
        if by_moment == (kind == OutputKind::ReactionMoment) {
            return Ok(());
        }
        let wanted = match kind {
            OutputKind::ReactionMoment => "a motion driven by a moment",
            _ => "a motion driven by a force",
        };
        Err(expected(path, wanted, quoted(name)))
    }

    /// Natural frequencies belong to the scene; one body may stand for it.
    fn validate_body_output(&self, path: &str, name: &str) -> Result<(), Error> {
        if self.body(name).is_none() {
            return Err(expected(path, "a body of this scene", quoted(name)));
        }
        if self.bodies.len() > 1 {
            let wanted = "nothing in a scene of several bodies, which vibrate together";
            return Err(expected(path, wanted, quoted(name)));
        }
        Ok(())
    }
}
