//! Checks of outputs.

use std::collections::BTreeSet;

use super::checks::{expected, needed, or, quoted, unknown};
use super::references::refuse_point;
use crate::scene::Error;
use crate::scene::description::{Along, DeflectionOutput, OfGear, OfLoad, Output, ReactionOutput};
use crate::scene::loads::{LoadKind, ResolvedLoad};
use crate::scene::resolved::{
    self, AngleId, DirectionSource, EdgeBase, First, OutputTarget, Place, Reaction, Resolved,
    ResolvedMarker,
};

/// Replacement in space for an angle of a marker, in a message.
const NO_ANGLE: &str = "nothing in space, where `orientation`, `quaternion` and `rotation_vector` say how a marker stands, and `angle` is of a `joint`,";
/// Most natural frequencies or eigenvalues.
const MOST_FREQUENCIES: u32 = 100;

/// What an output is read at that has a key for either of two things.
enum Either<'a> {
    First(&'a str),
    Last(&'a str),
}

/// A key of an output, with the name that it may hold.
#[derive(Clone, Copy)]
struct NamedKey<'a> {
    key: &'static str,
    name: &'a Option<String>,
}

impl<'a> NamedKey<'a> {
    fn new(key: &'static str, name: &'a Option<String>) -> Self {
        Self { key, name }
    }
}

/// What an output is read at by one of two keys, the last of which is asked for where neither is there. Axes are those of the last.
fn either<'a>(
    path: &str,
    first: NamedKey<'a>,
    last: NamedKey<'a>,
    axes: Along,
) -> Result<Either<'a>, Error> {
    match (first.name, last.name) {
        (Some(_), Some(_)) => Err(expected(path, "one name of what is read", "two")),
        (Some(_), None) if !axes.is_global() => {
            let wanted = format!("nothing beside `{}`", first.key);
            Err(expected(&format!("{path}.axes"), &wanted, "axes"))
        }
        (Some(name), None) => Ok(Either::First(name)),
        (None, name) => needed(path, last.key, "a name", name.as_deref()).map(Either::Last),
    }
}

/// What an output of a joint or a marker is read at.
fn joint_or_marker<'a>(
    path: &str,
    joint: &'a Option<String>,
    marker: &'a Option<String>,
    axes: Along,
) -> Result<Either<'a>, Error> {
    let joint = NamedKey::new("joint", joint);
    either(path, joint, NamedKey::new("marker", marker), axes)
}

/// Checks a number of natural frequencies or eigenvalues.
fn validate_count(path: &str, count: u32) -> Result<(), Error> {
    if (1..=MOST_FREQUENCIES).contains(&count) {
        return Ok(());
    }
    let wanted = format!("an integer from 1 to {MOST_FREQUENCIES}");
    Err(expected(&format!("{path}.count"), &wanted, count))
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
            let of = self.resolve_output(&path, output)?;
            self.validate_axes(&path, output, &of)?;
            let (kind, along) = (output.kind(), output.axes());
            if !seen.insert((kind as u8, along as u8, output.names())) {
                return Err(expected(&path, "an output not declared before", "it again"));
            }
            self.outputs.push(resolved::Output { kind, of, along });
        }
        Ok(())
    }

    /// Axes of a body are those of a rigid body in space that rotates.
    fn validate_axes(
        &self,
        path: &str,
        output: &Output,
        of: &OutputTarget<'_>,
    ) -> Result<(), Error> {
        if output.axes().is_global() {
            return Ok(());
        }
        let (path, found) = (format!("{path}.axes"), "axes of a body");
        if self.scene.dimension == 2 {
            return Err(expected(&path, "nothing in the plane", found));
        }
        let OutputTarget::Reaction(reaction) = of else {
            return Ok(());
        };
        let joint = self
            .joints
            .iter()
            .find(|joint| joint.holder == reaction.holder);
        let edge = self.edges.iter().find(|of| of.holder == reaction.holder);
        let first = match edge.map(|edge| &edge.base) {
            Some(EdgeBase::Ground) => Some(First::Ground(None)),
            Some(EdgeBase::Marker(marker)) => Some(First::Marker(*marker)),
            _ => joint.map(|joint| joint.ends.first),
        };
        if let Some(First::Marker(marker)) = first {
            refuse_point(&path, marker)?;
        }
        match first {
            Some(First::Ground(_)) => Ok(()),
            Some(First::Marker(marker)) if marker.place.is_framed() => Ok(()),
            _ => {
                let wanted = "a joint whose first marker is one of a rigid body with inertia, or of the ground";
                Err(expected(&path, wanted, quoted(reaction.name)))
            }
        }
    }

    fn resolve_output(
        &mut self,
        path: &str,
        output: &'a Output,
    ) -> Result<OutputTarget<'a>, Error> {
        let at = |key: &str| format!("{path}.{key}");
        Ok(match output {
            Output::Position(of) => {
                OutputTarget::Marker(self.require_marker(&at("marker"), &of.marker)?)
            }
            Output::Direction(of) => {
                OutputTarget::Marker(self.require_directed(&at("marker"), &of.marker)?)
            }
            Output::Velocity(of) | Output::Acceleration(of) => {
                match joint_or_marker(path, &of.joint, &of.marker, Along::Global)? {
                    Either::First(joint) => {
                        OutputTarget::Sliding(self.require_slider(&at("joint"), joint)?)
                    }
                    Either::Last(marker) => {
                        OutputTarget::Marker(self.require_marker(&at("marker"), marker)?)
                    }
                }
            }
            Output::Displacement(of) => {
                OutputTarget::Sliding(self.require_slider(&at("joint"), &of.joint)?)
            }
            Output::Deflection(of) => {
                let marker = self.require_deformable_marker(&at("marker"), &of.marker)?;
                OutputTarget::Deflected(marker, self.deflected_from(path, of, &marker)?)
            }
            Output::Angle(of) => {
                let source = match joint_or_marker(path, &of.joint, &of.marker, Along::Global)? {
                    Either::First(joint) => {
                        DirectionSource::Pivot(self.require_pivot(&at("joint"), joint)?)
                    }
                    Either::Last(marker) => DirectionSource::Marker(self.require_turning(
                        &at("marker"),
                        marker,
                        NO_ANGLE,
                    )?),
                };
                self.count_angle(source)
            }
            Output::AngularVelocity(of) | Output::AngularAcceleration(of) => {
                OutputTarget::Rotation(
                    match joint_or_marker(path, &of.joint, &of.marker, of.axes)? {
                        Either::First(joint) => {
                            DirectionSource::Pivot(self.require_pivot(&at("joint"), joint)?)
                        }
                        Either::Last(marker) => {
                            DirectionSource::Marker(self.require_spinning(&at("marker"), marker)?)
                        }
                    },
                )
            }
            Output::Orientation(of) | Output::Quaternion(of) | Output::RotationVector(of) => {
                OutputTarget::Marker(self.require_standing(&at("marker"), &of.marker)?)
            }
            Output::Strain(_)
            | Output::Curvature(_)
            | Output::AxialForce(_)
            | Output::BendingMoment(_)
            | Output::ConnectivityForce(_)
            | Output::Torque(_)
            | Output::MembraneStrain(_)
            | Output::MembraneForce(_)
            | Output::SurfaceStress(_)
            | Output::PlyStress(_) => self.section_output(path, output)?,
            Output::Stress(_) | Output::TorsionStress(_) => self.point_stress(path, output)?,
            Output::StressTensor(of) => self.gauge(&at("gauge"), &of.gauge)?,
            Output::Travel(of) => self.travel(&at("joint"), &of.joint)?,
            Output::Reaction(of) => OutputTarget::Reaction(self.reaction(path, of, false)?),
            Output::ReactionMoment(of) => OutputTarget::Reaction(self.reaction(path, of, true)?),
            Output::GearForce(of) | Output::GearTorque(of) => self.gear(&at("gear"), of, output)?,
            Output::LatchForce(of) | Output::LatchTorque(of) | Output::LatchState(of) => {
                self.latch(&at("latch"), &of.latch, output)?
            }
            Output::LoadForce(of) | Output::LoadMoment(of) => self.exerting(path, of, output)?,
            Output::Tension(of) | Output::Length(of) => self.pulling(&at("load"), &of.load)?,
            Output::Energy(_)
            | Output::Work(_)
            | Output::Momentum(_)
            | Output::CenterOfMass(_)
            | Output::Resolution(_)
            | Output::Residual(_) => OutputTarget::Scene,
            Output::NaturalFrequency(of) => self.spectrum(path, &of.body, of.count)?,
            Output::Eigenvalue(of) => self.spectrum(path, &of.body, of.count)?,
        })
    }

    fn spectrum(
        &self,
        path: &str,
        body: &'a Option<String>,
        count: u32,
    ) -> Result<OutputTarget<'a>, Error> {
        validate_count(path, count)?;
        if let Some(name) = body {
            self.validate_body_output(&format!("{path}.body"), name)?;
        }
        Ok(OutputTarget::Spectrum(body.as_deref(), count))
    }

    /// The marker whose frame carries the rigid body that another one of its body is compared with.
    fn deflected_from(
        &self,
        path: &str,
        output: &'a DeflectionOutput,
        marker: &ResolvedMarker<'a>,
    ) -> Result<Option<ResolvedMarker<'a>>, Error> {
        let Some(name) = &output.from else {
            if let Place::Patch(..) = marker.place {
                let wanted = "another marker of the plate or shell, whose frame is compared with";
                return Err(expected(&format!("{path}.from"), wanted, "nothing"));
            }
            return Ok(None);
        };
        let path = format!("{path}.from");
        let from = self.require_marker(&path, name)?;
        refuse_point(&path, from)?;
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

    pub(super) fn count_angle(&mut self, source: DirectionSource<'a>) -> OutputTarget<'a> {
        self.angles.push(source);
        OutputTarget::Angle(source, AngleId(self.angles.len() - 1))
    }

    fn travel(&self, path: &str, name: &str) -> Result<OutputTarget<'a>, Error> {
        let joint = self.require_joint(path, name)?;
        let slide = joint
            .slide
            .ok_or_else(|| expected(path, "a joint of kind point_on_cable", quoted(name)))?;
        Ok(OutputTarget::Slide(joint.name, slide))
    }

    /// A gear whose second coordinate is an angle for its torque, a displacement for its force.
    fn gear(&self, path: &str, of: &OfGear, output: &Output) -> Result<OutputTarget<'a>, Error> {
        let name = &of.gear;
        let Some(gear) = self.gears.iter().find(|gear| gear.name == *name) else {
            let known = self.gears.iter().map(|gear| gear.name);
            return Err(unknown(path, "a gear of this scene", name, known));
        };
        let [_, second] = &gear.coordinates;
        if second.is_angle() != matches!(output, Output::GearTorque(_)) {
            let wanted = if second.is_angle() {
                "a gear whose second coordinate is a displacement; gear_torque reads angles"
            } else {
                "a gear whose second coordinate is an angle; gear_force reads displacements"
            };
            return Err(expected(path, wanted, quoted(name)));
        }
        Ok(OutputTarget::Relation(gear.name, gear.holder))
    }

    /// A latch; one on an angle for its torque, one on a displacement for its force.
    fn latch(&self, path: &str, name: &str, output: &Output) -> Result<OutputTarget<'a>, Error> {
        let latch = &self.latches[self.latch_place(path, name)?];
        let is_angle = latch.coordinate.is_angle();
        match output {
            Output::LatchTorque(_) if !is_angle => {
                let wanted = "a latch on an angle; latch_force reads displacements";
                Err(expected(path, wanted, quoted(name)))
            }
            Output::LatchForce(_) if is_angle => {
                let wanted = "a latch on a displacement; latch_torque reads angles";
                Err(expected(path, wanted, quoted(name)))
            }
            _ => Ok(OutputTarget::Relation(latch.name, latch.holder)),
        }
    }

    fn read_load(
        &self,
        path: &str,
        name: &str,
    ) -> Result<(resolved::LoadId, &ResolvedLoad<'a>), Error> {
        let mut loads = self.numbered_loads();
        loads.find(|(_, load)| load.name == name).ok_or_else(|| {
            let known = self.numbered_loads().map(|(_, load)| load.name);
            unknown(path, "a load of this scene", name, known)
        })
    }

    /// A load that pulls along a line.
    fn pulling(&self, path: &str, name: &str) -> Result<OutputTarget<'a>, Error> {
        let (id, load) = self.read_load(path, name)?;
        if load.kind.has_tension() {
            return Ok(OutputTarget::Rope(load.name, id));
        }
        let wanted =
            "a reeving or a spring_damper, or a table_spring or a force_law between markers";
        Err(expected(path, wanted, quoted(name)))
    }

    /// A load whose force or moment is read.
    fn exerting(
        &self,
        path: &str,
        of: &OfLoad,
        output: &Output,
    ) -> Result<OutputTarget<'a>, Error> {
        let (path, name) = (&format!("{path}.load"), &of.load);
        let is_moment = matches!(output, Output::LoadMoment(_));
        let (id, load) = self.read_load(path, name)?;
        if load.kind.exerts()[usize::from(is_moment)] {
            return Ok(OutputTarget::Load(load.name, id, load.kind.exerts_on()));
        }
        let [always, by_coordinate] = LoadKind::exerting(is_moment).map(|kinds| or(&kinds));
        let coordinate = if is_moment {
            "an angle"
        } else {
            "a displacement"
        };
        let wanted = format!("a {always}, or a {by_coordinate} on {coordinate}");
        Err(expected(path, &wanted, quoted(name)))
    }

    fn reaction(
        &self,
        path: &str,
        output: &'a ReactionOutput,
        is_moment: bool,
    ) -> Result<Reaction<'a>, Error> {
        let motion = NamedKey::new("motion", &output.motion);
        let joint = NamedKey::new("joint", &output.joint);
        let name = match either(path, motion, joint, output.axes)? {
            Either::First(name) => {
                return self.motion_reaction(&format!("{path}.motion"), name, is_moment);
            }
            Either::Last(name) => name,
        };
        let path = format!("{path}.joint");
        if let Some(edge) = self.edges.iter().find(|edge| edge.name == name) {
            return Ok(Reaction {
                name: edge.name,
                holder: edge.holder,
                is_motion: false,
            });
        }
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
        let [has_force, has_moment] = motion.driven.quantity().exerts;
        if !has_force && !has_moment {
            let wanted = "a motion other than a winch, whose force is `axial_force` of its marker";
            return Err(expected(
                path,
                wanted,
                quoted(motion.driven.quantity().place.name()),
            ));
        }
        if has_moment != is_moment {
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
