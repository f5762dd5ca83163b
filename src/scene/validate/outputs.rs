//! Checks of outputs.

use std::collections::BTreeSet;

use super::checks::{Key, expected, keys, needed, quoted, unknown};
use crate::scene::Error;
use crate::scene::description::{Kind as _, Output, OutputKind, ReadAt};
use crate::scene::resolved::{
    self, AngleId, First, Marker, MotionKind, Of, Reaction, Resolved, Turning,
};

/// Replacement in space for an angle of a marker, in a message.
const NO_ANGLE: &str = "nothing in space, where `orientation`, `quaternion` and `rotation_vector` say how a marker stands, and `angle` is of a `joint`,";
/// Most natural frequencies or eigenvalues.
const MOST_FREQUENCIES: u32 = 100;

impl Output {
    fn validate_keys(&self, path: &str) -> Result<(), Error> {
        let all: [Key; 10] = [
            ("marker", self.marker.is_some(), "a name"),
            ("from", self.from.is_some(), "a name"),
            ("joint", self.joint.is_some(), "a name"),
            ("gear", self.gear.is_some(), "a name"),
            ("load", self.load.is_some(), "a name"),
            ("motion", self.motion.is_some(), "a name"),
            ("axes", !self.axes.is_global(), "axes"),
            ("body", self.body.is_some(), "a name"),
            ("count", self.count.is_some(), "a count"),
            ("points", self.points.is_some(), "points"),
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
        let is_spectrum = self.kind.read_at() == ReadAt::Spectrum;
        if !is_spectrum || self.count.is_some_and(is_right) {
            return Ok(());
        }
        let wanted = format!("an integer from 1 to {MOST_FREQUENCIES}");
        let found = self.count.map_or("nothing".into(), |n| n.to_string());
        Err(expected(&format!("{path}.count"), &wanted, found))
    }
}

impl<'a> Resolved<'a> {
    /// Resolves the outputs without those of ports.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, a quantity that the object does not have, or an output that is
    /// listed twice.
    pub(super) fn resolve_outputs(&mut self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (index, output) in self.scene.outputs.iter().enumerate() {
            let path = format!("outputs[{index}]");
            output.validate_keys(&path)?;
            output.validate_count(&path)?;
            let of = self.resolve_output(&path, output)?;
            self.validate_axes(&path, output, &of)?;
            let named = [
                &output.marker,
                &output.from,
                &output.joint,
                &output.gear,
                &output.load,
                &output.motion,
                &output.body,
            ];
            if !seen.insert((output.kind as u8, output.axes as u8, named)) {
                return Err(expected(&path, "an output not declared before", "it again"));
            }
            let (kind, along) = (output.kind, output.axes);
            self.outputs.push(resolved::Output { kind, of, along });
        }
        Ok(())
    }

    /// Axes of a body are those of a rigid body in space that turns.
    fn validate_axes(&self, path: &str, output: &Output, of: &Of<'_>) -> Result<(), Error> {
        if output.axes.is_global() {
            return Ok(());
        }
        let (path, found) = (format!("{path}.axes"), "axes of a body");
        if self.scene.dimension == 2 {
            return Err(expected(&path, "nothing in the plane", found));
        }
        let Of::Reaction(reaction) = of else {
            return Ok(());
        };
        let joint = self
            .joints
            .iter()
            .find(|joint| joint.holder == reaction.holder);
        match joint.map(|joint| joint.ends.first) {
            Some(First::Ground(_)) => Ok(()),
            Some(First::Marker(marker)) if marker.place.is_framed() => Ok(()),
            _ => {
                let wanted = "a joint whose first marker is one of a rigid body with inertia, or of the ground";
                Err(expected(&path, wanted, quoted(reaction.name)))
            }
        }
    }

    fn resolve_output(&mut self, path: &str, output: &'a Output) -> Result<Of<'a>, Error> {
        let marker = |require: fn(&Self, &str, &'a str) -> Result<Marker<'a>, Error>| {
            let name = needed(path, "marker", "a name", output.marker.as_deref())?;
            require(self, &format!("{path}.marker"), name)
        };
        let turning = || match &output.joint {
            Some(joint) => {
                let pivot = self.require_pivot(&format!("{path}.joint"), joint)?;
                Ok::<_, Error>(Turning::Pivot(pivot))
            }
            None => Ok(Turning::Marker(marker(|of, path, name| {
                of.require_turning(path, name, NO_ANGLE)
            })?)),
        };
        let spinning = || match &output.joint {
            Some(_) => turning(),
            None => Ok(Turning::Marker(marker(Self::require_spinning)?)),
        };
        Ok(match output.kind.read_at() {
            ReadAt::Moving if output.joint.is_none() => Of::Marker(marker(Self::require_marker)?),
            ReadAt::Moving | ReadAt::Sliding => {
                let name = needed(path, "joint", "a name", output.joint.as_deref())?;
                Of::Sliding(self.require_slider(&format!("{path}.joint"), name)?)
            }
            ReadAt::Gear => self.gear(path, output)?,
            ReadAt::Load => self.exerting(path, output)?,
            ReadAt::Marker => Of::Marker(marker(Self::require_marker)?),
            ReadAt::Directed => Of::Marker(marker(Self::require_directed)?),
            ReadAt::Standing => Of::Marker(marker(Self::require_standing)?),
            ReadAt::Cable | ReadAt::Node => Of::Marker(marker(Self::require_cable_marker)?),
            ReadAt::Rod => Of::Marker(marker(Self::require_rod_marker)?),
            ReadAt::Flexible => Of::Marker(marker(Self::require_flexible_marker)?),
            ReadAt::Points => self.section_points(path, output)?,
            ReadAt::Deflected => {
                let marker = marker(Self::require_cable_marker)?;
                Of::Deflected(marker, self.deflected_from(path, output, &marker)?)
            }
            ReadAt::Turning => Of::Turning(spinning()?),
            ReadAt::Angle => {
                let turning = turning()?;
                self.count_angle(turning)
            }
            ReadAt::Slide => {
                let name = needed(path, "joint", "a name", output.joint.as_deref())?;
                self.travel(&format!("{path}.joint"), name)?
            }
            ReadAt::Force | ReadAt::Moment => Of::Reaction(self.reaction(path, output)?),
            ReadAt::Scene => Of::Scene,
            ReadAt::Spectrum => {
                let count = needed(path, "count", "a count", output.count)?;
                let body = output.body.as_deref();
                if let Some(name) = body {
                    self.validate_body_output(&format!("{path}.body"), name)?;
                }
                Of::Spectrum(body, count)
            }
        })
    }

    /// The marker whose frame carries the rigid body that another one of its body is compared with.
    fn deflected_from(
        &self,
        path: &str,
        output: &'a Output,
        marker: &Marker<'a>,
    ) -> Result<Option<Marker<'a>>, Error> {
        let Some(name) = &output.from else {
            return Ok(None);
        };
        let path = format!("{path}.from");
        let from = self.require_marker(&path, name)?;
        if from.place.body_index() != marker.place.body_index() {
            let wanted = format!("a marker of {}", quoted(marker.place.body().name()));
            return Err(expected(&path, &wanted, quoted(name)));
        }
        if from.id == marker.id {
            return Err(expected(
                &path,
                "another marker",
                format!("{} itself", quoted(name)),
            ));
        }
        Ok(Some(from))
    }

    pub(super) fn count_angle(&mut self, turning: Turning<'a>) -> Of<'a> {
        self.angles.push(turning);
        Of::Angle(turning, AngleId(self.angles.len() - 1))
    }

    fn travel(&self, path: &str, name: &str) -> Result<Of<'a>, Error> {
        let joint = self.require_joint(path, name)?;
        let slide = joint.slide();
        let slide = slide.ok_or_else(|| expected(path, "a joint of kind along", quoted(name)))?;
        Ok(Of::Slide(joint.name, slide))
    }

    fn gear(&self, path: &str, output: &'a Output) -> Result<Of<'a>, Error> {
        let name = needed(path, "gear", "a name", output.gear.as_deref())?;
        let path = format!("{path}.gear");
        let Some(gear) = self.gears.iter().find(|gear| gear.name == name) else {
            let known = self.gears.iter().map(|gear| gear.name);
            return Err(unknown(&path, "a gear of this scene", name, known));
        };
        let [_, second] = &gear.coordinates;
        if second.is_angle() != (output.kind == OutputKind::GearTorque) {
            let wanted = if second.is_angle() {
                "a gear whose second coordinate is a displacement; gear_torque reads angles"
            } else {
                "a gear whose second coordinate is an angle; gear_force reads displacements"
            };
            return Err(expected(&path, wanted, quoted(name)));
        }
        Ok(Of::Gear(gear.name, gear.holder))
    }

    fn exerting(&self, path: &str, output: &'a Output) -> Result<Of<'a>, Error> {
        let name = needed(path, "load", "a name", output.load.as_deref())?;
        let path = format!("{path}.load");
        let mut loads = self.numbered_loads();
        let Some((id, load)) = loads.find(|(_, load)| load.name == name) else {
            let known = self.numbered_loads().map(|(_, load)| load.name);
            return Err(unknown(&path, "a load of this scene", name, known));
        };
        let is_moment = output.kind == OutputKind::LoadMoment;
        if load.kind.exerts()[usize::from(is_moment)] {
            return Ok(Of::Load(load.name, id, load.kind.exerts_on()));
        }
        let wanted = if is_moment {
            "a bushing, or a joint_spring or stop on an angle"
        } else {
            "a spring_damper, bushing or contact, or a joint_spring or stop on a displacement"
        };
        Err(expected(&path, wanted, quoted(name)))
    }

    fn reaction(&self, path: &str, output: &'a Output) -> Result<Reaction<'a>, Error> {
        let is_moment = output.kind.read_at() == ReadAt::Moment;
        if let Some(name) = &output.motion {
            return self.motion_reaction(&format!("{path}.motion"), name, is_moment);
        }
        let name = needed(path, "joint", "a name", output.joint.as_deref())?;
        let path = format!("{path}.joint");
        let joint = self.require_joint(&path, name)?;
        let (wanted, offered) = if is_moment {
            ("a joint that transmits a moment", joint.holds_direction())
        } else {
            ("a joint that transmits a force", joint.holds_position())
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
            let known = self.motions.iter().map(|motion| motion.name);
            return Err(unknown(path, "a motion of this scene", name, known));
        };
        if let MotionKind::Winch(marker, _) = motion.kind {
            let wanted = "a motion other than a winch, whose force is `axial_force` of its marker";
            return Err(expected(path, wanted, quoted(marker.name)));
        }
        let turns = matches!(
            motion.kind,
            MotionKind::Angle(..) | MotionKind::Orientation(..)
        );
        if turns != is_moment {
            let wanted = if is_moment {
                "a motion driven by a moment"
            } else {
                "a motion driven by a force"
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
            let known = self.bodies.iter().map(|body| body.name());
            return Err(unknown(path, "a body of this scene", name, known));
        }
        if self.bodies.len() > 1 {
            let wanted = "nothing in a scene of several bodies, which vibrate together";
            return Err(expected(path, wanted, quoted(name)));
        }
        Ok(())
    }
}
