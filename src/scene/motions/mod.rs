//! Driven motions of a scene. One file holds the scene side of a kind: keys and their checks, resolved references, inputs, words, and the
//! primitive of the system that is built of them.

mod angle;
mod displacement;
mod distance;
mod drives;
mod orientation;
mod position;
mod winch;

use std::collections::HashSet;
use std::mem::discriminant;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

// What follows is there for the files of the kinds too.
use super::assemble::{Builder, unit};
use super::description::tagged::{kinds, part};
use super::description::{MotionValue, SceneVector, Value};
use super::loads::LoadPlace;
use super::resolved::{
    Cable, ConstraintOwnerId, DirectionSource, Ends, JointCoordinate, Place, PortKind, Resolved,
    ResolvedMarker, Slider,
};
use super::unit::*;
use super::validate::checks::{components, expected, quoted, shape, value};
use super::{Error, Found};
use crate::system::joints::{DrivenRotation, Primitive};
use crate::system::{Attitude, Coordinate, Drive};

/// Key, meaning and unit of an input that drives a quantity, or of one that drives its first or second derivative.
pub type Order = (&'static str, &'static str, Unit);

/// Inputs of an angle and its derivatives.
pub const ROTATION_ORDERS: [Order; 3] = [
    ("angle", "Angle", RADIAN),
    ("angular_velocity", "Angular velocity", RADIAN_PER_SECOND),
    (
        "angular_acceleration",
        "Angular acceleration",
        RADIAN_PER_SECOND_2,
    ),
];

/// Inputs of a length and its derivatives.
fn displacement(key: &'static str, what: &'static str) -> [Order; 3] {
    [
        (key, what, METRE),
        ("velocity", "Velocity", METRE_PER_SECOND),
        ("acceleration", "Acceleration", METRE_PER_SECOND_2),
    ]
}

/// A driven motion.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Motion {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Kind of the motion.
    #[serde(flatten)]
    pub kind: MotionKind,
}
part!(Motion { name: String });

/// A driven motion with its references resolved.
#[derive(Clone, Debug)]
pub struct ResolvedMotion<'a> {
    /// Name; of a port, where it belongs to one.
    pub name: &'a str,
    /// Which holder it is.
    pub holder: ConstraintOwnerId,
    /// Driven quantity and the course of each of its coordinates.
    pub driven: Driven<'a>,
    /// Course as written in the scene. Empty if the master sets it.
    pub values: &'a [Value],
}

/// Driven quantity, with the course of every coordinate.
#[derive(Clone, Debug)]
pub struct Driven<'a> {
    /// Driven marker or joint.
    pub kind: DrivenKind<'a>,
    /// Course of every coordinate: m, rad, or parts of a quaternion, scalar first.
    pub drives: Vec<Drive>,
}

/// Quantity that a motion drives.
#[derive(Clone, Debug)]
pub struct DrivenQuantity<'a> {
    /// Marker or coordinate of a joint.
    pub place: LoadPlace<'a>,
    /// Whether the motion has a force, and whether it has a moment, that outputs read.
    pub exerts: [bool; 2],
    /// Values as described, one number a coordinate: m, rad, or parts of a quaternion.
    pub start: Vec<f64>,
    /// Inputs of a coordinate and its derivatives.
    pub orders: [Order; 3],
    /// Words before the name of the marker or joint.
    pub words: &'static str,
}

/// Motion as a scene describes it: one struct of keys for each kind.
///
/// A new kind of motion is one file with its `SceneMotion`, and one line among the kinds below.
trait SceneMotion {
    /// Marker or joint that is driven.
    type Of<'a>
    where
        Self: 'a;

    /// Checks the keys and resolves the references.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a value out of range.
    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Of<'a>>;

    /// Reads the course of every coordinate; by default there is one.
    ///
    /// # Errors
    /// A course that is not valid, or another number of them.
    fn drives(path: &str, given: &MotionValue, scene: &mut Resolved<'_>) -> Found<Vec<Drive>> {
        Ok(vec![scene.one_drive(path, given)?])
    }

    /// Returns the driven quantity.
    fn quantity<'a>(of: &Self::Of<'a>) -> DrivenQuantity<'a>;

    /// Builds the primitive with the drives of these indices.
    fn primitive<const D: usize>(
        of: &Self::Of<'_>,
        builder: &mut Builder<'_, D>,
        drives: &[usize],
    ) -> Primitive<D>;
}

/// Declares the kinds of motion with the structs of their keys and the types of what they drive, and passes each item of [`SceneMotion`]
/// to the kind at hand.
macro_rules! motions {
    ($($(#[$doc:meta])* $kind:ident($motion:ty): $of:ty,)*) => {
        kinds! {
            /// Driven motions by kind.
            MotionKind of "Motion" {
                $($(#[$doc])* $kind($motion),)*
            }
        }

        /// Driven markers and joints by kind of motion.
        #[derive(Clone, Debug)]
        pub enum DrivenKind<'a> {
            $($(#[$doc])* $kind($of),)*
        }

        impl MotionKind {
            /// Course in time.
            pub fn value(&self) -> &MotionValue {
                match self {
                    $(Self::$kind(motion) => &motion.value,)*
                }
            }

            fn resolve<'a>(&'a self, path: &str, scene: &mut Resolved<'a>) -> Found<Driven<'a>> {
                let place = format!("{path}.value");
                Ok(match self {
                    $(Self::$kind(motion) => Driven {
                        kind: DrivenKind::$kind(motion.resolve(path, scene)?),
                        drives: <$motion>::drives(&place, &motion.value, scene)?,
                    },)*
                })
            }
        }

        impl<'a> Driven<'a> {
            /// Returns the driven quantity.
            pub fn quantity(&self) -> DrivenQuantity<'a> {
                match &self.kind {
                    $(DrivenKind::$kind(of) => <$motion>::quantity(of),)*
                }
            }

            fn primitive<const D: usize>(&self, builder: &mut Builder<'_, D>, drives: &[usize]) -> Primitive<D> {
                match &self.kind {
                    $(DrivenKind::$kind(of) => <$motion>::primitive(of, builder, drives),)*
                }
            }
        }
    };
}

motions! {
    /// Direction of a marker, or direction of the second marker of a joint less that of its first,
    /// rad.
    Angle(angle::AngleMotion): DirectionSource<'a>,
    /// Position of a marker, m.
    Position(position::PositionMotion): ResolvedMarker<'a>,
    /// In space how a rigid body stands: the quaternion, scalar first, of the frame of a marker's body in global axes, of any
    /// length and either sign. As an input with rates: the angular velocity and the angular acceleration, in global axes.
    Orientation(orientation::OrientationMotion): ResolvedMarker<'a>,
    /// Displacement along the line of a point on a line, a prismatic, a cylindrical joint or a screw from its first marker or its point, m; not where
    /// that line belongs to a cable.
    Displacement(displacement::DisplacementMotion): Slider<'a>,
    /// Distance between two markers, or of a marker from a point of the ground, m: a hydraulic cylinder, a screw jack.
    Distance(distance::DistanceMotion): Ends<'a>,
    /// Length that a winch at a marker, an end of a cable, has paid out since the start, m; negative where it has taken in. The mass of the
    /// cable changes with it. What is on the winch has no part in the scene; what acts between its ends acts all along it: `distributed_force`
    /// (where `s` is the share of the length now), `contact`, `fluid` without added mass.
    Winch(winch::WinchMotion): ResolvedMarker<'a>,
}

impl<'a> Resolved<'a> {
    /// Motions of the scene, then those of ports.
    pub(super) fn all_motions(&self) -> impl Iterator<Item = &ResolvedMotion<'a>> {
        let of_ports = self.ports.iter().flat_map(|port| match &port.kind {
            PortKind::Motion { position, angle } => [Some(position), angle.as_ref()],
            PortKind::Force { .. } | PortKind::Coupling { .. } => [None; 2],
        });
        self.motions
            .iter()
            .chain(of_ports.flatten().map(Box::as_ref))
    }

    /// Resolves the motions without those of ports.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, a coordinate that is driven twice, or a course that is not
    /// valid.
    pub(super) fn resolve_motions(&mut self) -> Found<()> {
        // Inputs have the first numbers.
        let inputs = self.scene.inputs.iter();
        let dimension = self.scene.dimension;
        self.numbers = inputs.map(|input| input.components(dimension)).sum();
        let mut seen = HashSet::new();
        for (index, Motion { name, kind }) in self.scene.motions.iter().enumerate() {
            let path = format!("motions[{index}]");
            let driven = kind.resolve(&path, self)?;
            let place = driven.quantity().place;
            let of = place.name();
            // Many distances may end at one marker.
            let from = place.ends().map(|ends| {
                (
                    ends.first_name(),
                    ends.point().map(|at| at.map(f64::to_bits)),
                )
            });
            if !seen.insert((discriminant(kind), of, from)) {
                let wanted = "a motion of what is not driven yet";
                return Err(expected(&path, wanted, quoted(of)));
            }
            let holder = self.hold(&path, name);
            self.motions.push(ResolvedMotion {
                name,
                holder,
                driven,
                values: kind.value().components(),
            });
        }
        Ok(())
    }
}

impl<const D: usize> Builder<'_, D> {
    /// Builds the motions of the scene, then those of ports.
    pub(super) fn motions(&mut self) {
        let resolved = self.resolved;
        for motion in resolved.all_motions() {
            let drives = motion.driven.drives.iter();
            let first = self.parts.drives.len();
            self.parts.drives.extend(drives.cloned());
            let drives: Vec<usize> = (first..self.parts.drives.len()).collect();
            let primitive = motion.driven.primitive(self, &drives);
            let ends = match motion.driven.quantity().place {
                LoadPlace::Marker(marker) => self.on_marker(marker),
                LoadPlace::Coordinate(of) => self.ends(of.ends()),
                LoadPlace::Ends(ends) => self.ends(ends),
                LoadPlace::Line(_) | LoadPlace::Surface(_) => continue,
            };
            self.hold(primitive, ends);
        }
    }
}
