//! Checks of outputs.

use std::collections::BTreeSet;

use super::checks::{Key, expected, keys, needed, planar, quoted};
use crate::scene::Error;
use crate::scene::description::{Kind as _, Output, OutputKind};
use crate::scene::resolved::{self, AngleId, MotionKind, Reaction, Resolved, Turning};

/// Most natural frequencies or eigenvalues.
const MOST_FREQUENCIES: u32 = 100;

impl Output {
    fn validate_keys(&self, path: &str) -> Result<(), Error> {
        let all: [Key; 5] = [
            ("marker", self.marker.is_some(), "a name"),
            ("joint", self.joint.is_some(), "a name"),
            ("motion", self.motion.is_some(), "a name"),
            ("body", self.body.is_some(), "a name"),
            ("count", self.count.is_some(), "a count"),
        ];
        let alternatives = self.kind.keys();
        let of = [&self.marker, &self.joint, &self.motion];
        if alternatives.len() > 1 && of.into_iter().flatten().count() > 1 {
            return Err(expected(path, "one name of what is read", "two"));
        }
        keys(path, "output", &all, alternatives)
    }

    fn validate_count(&self, path: &str) -> Result<(), Error> {
        let is_right = |count| (1..=MOST_FREQUENCIES).contains(&count);
        let is_spectrum = matches!(
            self.kind,
            OutputKind::NaturalFrequency | OutputKind::Eigenvalue
        );
        if !is_spectrum || self.count.is_some_and(is_right) {
            return Ok(());
        }
        let wanted = format!("an integer from 1 to {MOST_FREQUENCIES}");
        let found = self.count.map_or("nothing".into(), |n| n.to_string());
        Err(expected(&format!("{path}.count"), &wanted, found))
    }
}

impl<'a> Resolved<'a> {
    pub(super) fn resolve_outputs(&mut self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (index, output) in self.scene.outputs.iter().enumerate() {
            let path = format!("outputs[{index}]");
            output.validate_keys(&path)?;
            output.validate_count(&path)?;
            let resolved = self.resolve_output(&path, output)?;
            let of = [&output.marker, &output.joint, &output.motion, &output.body];
            if !seen.insert((output.kind as u8, of)) {
                return Err(expected(&path, "an output not declared before", "it again"));
            }
            self.outputs.push(resolved);
        }
        Ok(())
    }

    fn resolve_output(
        &mut self,
        path: &str,
        output: &'a Output,
    ) -> Result<resolved::Output<'a>, Error> {
        use resolved::Output as To;
        let named = |key: &str, name: &'a Option<String>| {
            let name = needed(path, key, "a name", name.as_deref())?;
            Ok::<_, Error>((format!("{path}.{key}"), name))
        };
        let marker = || {
            let (at, name) = named("marker", &output.marker)?;
            self.require_marker(&at, name)
        };
        let on_cable = || {
            let (at, name) = named("marker", &output.marker)?;
            self.require_cable_marker(&at, name)
        };
        let turning = || match &output.joint {
            Some(joint) => {
                let pivot = self.require_pivot(&format!("{path}.joint"), joint)?;
                Ok::<_, Error>(Turning::Pivot(pivot))
            }
            None => {
                let (at, name) = named("marker", &output.marker)?;
                Ok(Turning::Marker(self.require_turning(&at, name)?))
            }
        };
        Ok(match output.kind {
            OutputKind::Position => To::Position(marker()?),
            OutputKind::Velocity => To::Velocity(marker()?),
            OutputKind::Acceleration => To::Acceleration(marker()?),
            OutputKind::Angle => {
                let turning = turning()?;
                To::Angle(turning, self.count_angle(turning))
            }
            OutputKind::AngularVelocity => To::AngularVelocity(turning()?),
            OutputKind::AngularAcceleration => To::AngularAcceleration(turning()?),
            OutputKind::Strain => To::Strain(on_cable()?),
            OutputKind::Curvature => To::Curvature(on_cable()?),
            OutputKind::AxialForce => To::AxialForce(on_cable()?),
            OutputKind::BendingMoment => To::BendingMoment(on_cable()?),
            OutputKind::ConnectivityForce => To::ConnectivityForce(on_cable()?),
            OutputKind::Travel => {
                let (at, name) = named("joint", &output.joint)?;
                self.travel(&at, name)?
            }
            OutputKind::Reaction => To::Reaction(self.reaction(path, output)?),
            OutputKind::ReactionMoment => To::ReactionMoment(self.reaction(path, output)?),
            OutputKind::Energy => To::Energy,
            OutputKind::Work => To::Work,
            OutputKind::Momentum => To::Momentum,
            OutputKind::CenterOfMass => To::CenterOfMass,
            OutputKind::Residual => To::Residual,
            OutputKind::NaturalFrequency | OutputKind::Eigenvalue => {
                let count = needed(path, "count", "a count", output.count)?;
                let body = output.body.as_deref();
                if let Some(name) = body {
                    self.validate_body_output(&format!("{path}.body"), name)?;
                }
                match output.kind {
                    OutputKind::Eigenvalue => To::Eigenvalue(body, count),
                    _ => To::NaturalFrequency(body, count),
                }
            }
        })
    }

    pub(super) fn count_angle(&mut self, turning: Turning<'a>) -> AngleId {
        self.angles.push(turning);
        AngleId(self.angles.len() - 1)
    }

    fn travel(&self, path: &str, name: &str) -> Result<resolved::Output<'a>, Error> {
        let joint = self.require_joint(path, name)?;
        let slide = joint.slide();
        let slide = slide.ok_or_else(|| expected(path, "a joint of kind along", quoted(name)))?;
        Ok(resolved::Output::Travel(joint.name, slide))
    }

    fn reaction(&self, path: &str, output: &'a Output) -> Result<Reaction<'a>, Error> {
        let is_moment = output.kind == OutputKind::ReactionMoment;
        if let Some(name) = &output.motion {
            return self.motion_reaction(&format!("{path}.motion"), name, is_moment);
        }
        let name = needed(path, "joint", "a name", output.joint.as_deref())?;
        let path = format!("{path}.joint");
        let joint = self.require_joint(&path, name)?;
        if is_moment {
            planar(&path, self.scene.dimension, "no moment", &quoted(name))?;
        }
        let (wanted, offered) = match is_moment {
            false => ("a joint that transmits a force", joint.holds_position()),
            true => ("a joint that transmits a moment", joint.holds_direction()),
        };
        if !offered {
            return Err(expected(&path, wanted, quoted(name)));
        }
        Ok(Reaction {
            name: joint.name,
            holder: joint.holder,
            is_motion: false,
        })
    }

    fn motion_reaction(
        &self,
        path: &str,
        name: &str,
        is_moment: bool,
    ) -> Result<Reaction<'a>, Error> {
        let Some(motion) = self.motions.iter().find(|motion| motion.name == name) else {
            return Err(expected(path, "a motion of this scene", quoted(name)));
        };
        if matches!(motion.kind, MotionKind::Angle(..)) != is_moment {
            let wanted = match is_moment {
                true => "a motion driven by a moment",
                false => "a motion driven by a force",
            };
            return Err(expected(path, wanted, quoted(name)));
        }
        Ok(Reaction {
            name: motion.name,
            holder: motion.holder,
            is_motion: true,
        })
    }

    /// Natural frequencies and eigenvalues belong to the scene; one body may stand for it.
    fn validate_body_output(&self, path: &str, name: &str) -> Result<(), Error> {
        if !self.bodies_by_name.contains_key(name) {
            return Err(expected(path, "a body of this scene", quoted(name)));
        }
        if self.bodies.len() > 1 {
            let wanted = "nothing in a scene of several bodies, which vibrate together";
            return Err(expected(path, wanted, quoted(name)));
        }
        Ok(())
    }
}
