//! Joints of a scene. One file holds the scene side of a kind: keys and their checks, and the primitives that it is made of. The equations,
//! words and coordinates of a joint follow from its primitives.

mod coaxial;
mod constant_velocity;
mod cylindrical;
mod distance;
mod edge;
mod ends;
mod gear;
mod generic;
mod latch;
mod orientation;
mod planar;
mod point_on_cable;
mod point_on_line;
mod primitive;
mod prismatic;
mod revolute;
mod screw;
mod spherical;
mod universal;
mod weld;

pub use gear::{Gear, ResolvedGear};
pub use latch::{Latch, ResolvedLatch};
pub use primitive::JointPrimitive;
pub use revolute::Revolute;

// What follows is there for the files of the kinds too.
use std::ops::Deref;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::assemble::{Builder, unit};
use super::description::SceneVector;
use super::description::tagged::{Kinds, kinds, part};
use super::marker::length;
use super::resolved::{
    ConstraintOwnerId, EdgeHold, Ends, First, Pivot, Place, Resolved, ResolvedMarker, SlideId,
    Slider,
};
use super::unit::spring_units;
use super::validate::checks::{
    direction, expected, finite, not_negative, not_zero, or, planar, positive, quoted, shape,
    spring_damper,
};
use super::{Error, Found, number, words};
use crate::math::space::vector;
use crate::system::joints::{JointEquations, Primitive};
use crate::system::{Angle, Attachment, AxisRotation, Coordinate, Release};
use JointPrimitive::{
    AtPoint, Distance, Homokinetic, Inline, Inplane, Orientation, ParallelAxes, Perpendicular,
    PointOnCurve,
};

/// Cosine of an angle that is a right one but for rounding.
const RIGHT: f64 = 1e-6;

/// A joint between two markers.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Joint {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Kind of the joint.
    #[serde(flatten)]
    pub kind: JointKind,
    /// Time at which the joint is released for good, s. No spring, load or motion may act on its coordinates. An input of kind `release`
    /// does the same. A release is no impact: positions and velocities stay continuous, and reactions are zero from then on.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub release_time: Option<f64>,
}
part!(Joint { name: String, release_time: Option<f64> });

/// A coordinate of a joint by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CoordinateKind {
    /// The way along its line from the first marker or its point, m.
    Displacement,
    /// The angle about its axis, rad.
    Angle,
}

/// A joint with its references resolved.
#[derive(Clone, Debug)]
pub struct ResolvedJoint<'a> {
    /// Place among the joints of the scene.
    pub index: usize,
    /// Name.
    pub name: &'a str,
    /// Which holder it is.
    pub holder: ConstraintOwnerId,
    /// As described.
    given: &'a JointKind,
    /// Whether the scene is planar.
    is_planar: bool,
    /// Ends of the joint.
    pub ends: Ends<'a>,
    /// Primitives of the joint, in space with directions in global axes at the start.
    pub primitives: Vec<JointPrimitive>,
    /// Number of the slide, of a point on the curve of a cable.
    pub slide: Option<SlideId>,
    /// Time or input of the release, if the joint can be released.
    pub release: Option<Release>,
}

/// How a joint is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// A circle, on a foot where one end is the ground.
    Pin,
    /// A spiral spring around a pin.
    Spiral,
    /// A hatched wall, or a block between two bodies.
    Weld,
    /// A pin between two rails.
    Slider,
    /// A block between two rails.
    Prismatic,
    /// A square.
    Orientation,
    /// A rod between two pins.
    Link,
    /// A ring around a cable.
    Ring,
}

/// Parts and shared keys of a joint.
pub struct JointParts {
    /// Primitives. Directions are in the axes of the first marker's body.
    primitives: Vec<JointPrimitive>,
    /// How it is drawn.
    symbol: Symbol,
    /// Point on the ground, m, of a joint that is given one.
    point: Option<SceneVector>,
    /// Values of `direction` and `second_direction`, of a joint that has them.
    directions: [Option<SceneVector>; 2],
    /// Whether both markers need axes and moments of inertia about all of them, whatever the primitives need.
    needs_axes: bool,
}

impl JointParts {
    /// A joint without a point on the ground and directions.
    fn new(symbol: Symbol, primitives: impl IntoIterator<Item = JointPrimitive>) -> Self {
        Self {
            primitives: primitives.into_iter().collect(),
            symbol,
            point: None,
            directions: [None; 2],
            needs_axes: false,
        }
    }

    /// Sets the point on the ground.
    fn at(mut self, point: Option<SceneVector>) -> Self {
        self.point = point;
        self
    }

    /// Sets the values of `direction` and `second_direction`.
    fn along(mut self, directions: [Option<SceneVector>; 2]) -> Self {
        self.directions = directions;
        self
    }

    /// Whether one of the primitives is as asked for.
    fn has(&self, of: impl Fn(&JointPrimitive) -> bool) -> bool {
        self.primitives.iter().any(of)
    }

    /// Checks directions, and the angle.
    fn check(&self, path: &str, dimension: usize) -> Found<()> {
        let keys = ["direction", "second_direction"].into_iter();
        for (key, given) in keys.zip(self.directions) {
            if let Some(given) = given {
                direction(&format!("{path}.{key}"), dimension, &given)?;
            }
        }
        for primitive in &self.primitives {
            if let Orientation(Some(angle))
            | JointPrimitive::Spring {
                rest: Some(angle), ..
            } = primitive
            {
                finite(&format!("{path}.angle"), *angle)?;
            }
        }
        Ok(())
    }
}

/// Joint as a scene describes it: one struct of keys for each kind.
///
/// A new kind of joint is one file with its `SceneJoint`, and one line among the kinds below.
pub trait SceneJoint {
    /// Returns its parts and shared keys.
    fn parts(&self) -> JointParts;

    /// Refuses keys that exist only in the plane or only in space.
    ///
    /// # Errors
    /// A key that is missing, or has no place in this dimension.
    fn check_dimension(&self, _path: &str, _dimension: usize) -> Result<(), Error> {
        Ok(())
    }

    /// Returns the freedoms that it holds of a mesh line of a plate or shell, if it is a joint of one.
    fn edge(&self) -> Option<EdgeHold> {
        None
    }

    /// Checks the values of its own keys.
    ///
    /// # Errors
    /// A value out of range, or two that do not fit.
    fn check(&self, _path: &str, _ends: &Ends<'_>) -> Result<(), Error> {
        Ok(())
    }
}

/// Declares the kinds of joint with the structs of their keys and the least dimension of a scene with one, and passes each item of
/// [`SceneJoint`] to the kind at hand.
macro_rules! joints {
    ($($(#[$doc:meta])* $kind:ident($joint:ty) from $dimension:literal,)*) => {
        kinds! {
            /// Joints by kind.
            JointKind of "Joint", speaks: true {
                $($(#[$doc])* $kind($joint),)*
            }
        }

        impl JointKind {
            /// Least dimension of a scene with a joint, in the order of the kinds.
            const DIMENSIONS: &'static [usize] = &[$($dimension,)*];

            /// Names of what it joins: `ground`, a marker or a cable, then a marker.
            pub(in crate::scene) fn markers(&self) -> &[String; 2] {
                match self {
                    $(Self::$kind(joint) => &joint.markers,)*
                }
            }
        }

        impl Deref for JointKind {
            type Target = dyn SceneJoint;

            fn deref(&self) -> &Self::Target {
                match self {
                    $(Self::$kind(joint) => joint,)*
                }
            }
        }
    };
}

joints! {
    /// Holds the position, in space also an axis of rotation. A spring and a damper may act against the rotation.
    Revolute(Revolute) from 2,
    /// Holds the position, in space: a ball in its socket.
    Spherical(spherical::Spherical) from 3,
    /// Holds the position and a right angle between an axis of each body, in space: a cross between two forks.
    Universal(universal::Universal) from 3,
    /// Holds the position and lets both bodies rotate alike about an axis of each, in space: the homokinetic joint of drive shafts.
    ConstantVelocity(constant_velocity::ConstantVelocity) from 3,
    /// Holds the position and the direction, in space how bodies stand to each other.
    Weld(weld::Weld) from 2,
    /// Holds the marker on a line of the first one, which may move. The marker rotates freely.
    PointOnLine(point_on_line::PointOnLineJoint) from 2,
    /// Holds the marker on a line of the first one, in space, and lets it rotate about that line only.
    Cylindrical(cylindrical::Cylindrical) from 3,
    /// Holds the marker on a line of the first one, in space, along which it goes as it rotates about it.
    Screw(screw::Screw) from 3,
    /// Holds the marker on a line of the first one, and the direction, in space how bodies stand to each other.
    Prismatic(prismatic::Prismatic) from 2,
    /// Holds the marker in a plane of the first one, in space, and lets it rotate in that plane only.
    Planar(planar::Planar) from 3,
    /// Holds the direction, in space how bodies stand to each other.
    Orientation(orientation::OrientationJoint) from 2,
    /// Holds the distance.
    Distance(distance::DistanceJoint) from 2,
    /// Holds the marker on the line of a cable.
    PointOnCable(point_on_cable::PointOnCable) from 2,
    /// Holds, in space, what `free` does not name.
    Generic(generic::Generic) from 3,
    /// Holds an edge of a plate or shell, and the normal along it, on the ground, on a rigid body or on another edge. On the ground and on a
    /// rigid body the edge may not stretch; beside it the surface may. Two edges keep the angle between both surfaces. A rod or beam along
    /// the edge stiffens it: its line is that of the edge, and its sections rotate about it with the surface.
    Clamped(edge::ClampedEdge) from 3,
    /// Holds an edge of a plate or shell on the ground, on a rigid body or on another edge. The surface may rotate about the edge. The line
    /// of a cable, rod or beam along the edge is that of the edge.
    Pinned(edge::PinnedEdge) from 3,
    /// Continues a plate or shell smoothly beyond an edge by another one, or by its own opposite edge.
    Smooth(edge::SmoothEdges) from 3,
    /// Holds an edge of a plate or shell in a plane of symmetry, and the normal of the surface there.
    Symmetry(edge::SymmetryEdge) from 3,
}

impl JointKind {
    /// Refuses kinds and keys that exist only in the plane or only in space.
    fn validate_dimension(&self, path: &str, dimension: usize) -> Found<()> {
        if self.parts().has(|of| matches!(of, Orientation(Some(_)))) {
            planar(&format!("{path}.angle"), dimension, "nothing", "an angle")?;
        }
        self.check_dimension(path, dimension)?;
        let kinds = Self::all().into_iter().zip(Self::DIMENSIONS);
        let kinds = kinds.filter(|(_, least)| **least <= dimension);
        let kinds: Vec<&str> = kinds.map(|(kind, _)| kind.name).collect();
        if kinds.contains(&self.name()) {
            return Ok(());
        }
        let wanted = format!("{} in the plane", or(&kinds));
        Err(expected(&format!("{path}.kind"), &wanted, self.name()))
    }
}

/// Cosine of the angle between two directions.
fn cosine(a: SceneVector, b: SceneVector) -> f64 {
    let [a, b] = [a, b].map(|of| unit::<3>(of.full()));
    a.dot(&b)
}

/// Describes a second direction at the wrong angle from the first.
fn wrong_second(path: &str, wanted: &str, cosine: f64) -> Error {
    let found = format!("one at {} rad from it", cosine.acos());
    expected(&format!("{path}.second_direction"), wanted, found)
}

impl<'a> Resolved<'a> {
    /// Resolves the joints.
    ///
    /// # Errors
    /// A missing key, a marker that does not exist, or ends or axes that the kind does not allow.
    pub(super) fn resolve_joints(&mut self) -> Result<(), Error> {
        let dimension = self.scene.dimension;
        for (index, joint) in self.scene.joints.iter().enumerate() {
            let Joint {
                name,
                kind,
                release_time,
            } = joint;
            let path = format!("joints[{index}]");
            kind.validate_dimension(&path, dimension)?;
            if kind.edge().is_some() {
                continue;
            }
            let parts = kind.parts();
            let ends = self.joint_ends(&path, kind.markers(), &parts)?;
            parts.check(&path, dimension)?;
            kind.check(&path, &ends)?;
            if let Some(time) = release_time {
                not_negative(&format!("{path}.release_time"), "s", *time)?;
            }
            let is_slide = parts.has(|of| matches!(of, PointOnCurve));
            let before = self.joints.iter().filter(|joint| joint.slide.is_some());
            let slide = is_slide.then(|| SlideId(before.count()));
            let holder = self.hold(&path, name);
            self.joints.push(ResolvedJoint {
                index,
                name,
                holder,
                given: kind,
                is_planar: dimension == 2,
                ends,
                primitives: self.directed(parts.primitives, &ends),
                slide,
                release: release_time.map(|time| Release {
                    time: Some(time),
                    ..Release::default()
                }),
            });
        }
        self.unite_axes();
        for (index, joint) in self.scene.joints.iter().enumerate() {
            if let Some(hold) = joint.kind.edge() {
                self.resolve_edge(&format!("joints[{index}]"), joint, hold)?;
            }
        }
        Ok(())
    }
}

impl<'a> ResolvedJoint<'a> {
    /// Returns the specification of the joint's kind.
    pub fn kind_name(&self) -> &'static str {
        self.given.name()
    }

    /// How it is drawn.
    pub fn symbol(&self) -> Symbol {
        self.given.parts().symbol
    }

    /// Describes what the joint holds in a scene of this dimension, and until when.
    pub fn words(&self, dimension: usize) -> String {
        let holds = self.primitives.iter();
        let holds = holds.map(|hold| hold.words(dimension, &self.ends));
        let until = self.release.and_then(|release| release.time);
        let until = until.map(|time| format!("lets go at {} s", number(time)));
        holds.chain(until).collect::<Vec<_>>().join("; ")
    }

    /// Stiffness (N m/rad) and damping (N m s/rad) of its spring.
    pub fn spring(&self) -> Option<[f64; 2]> {
        self.primitives.iter().find_map(|hold| match hold {
            JointPrimitive::Spring {
                stiffness, damping, ..
            } => Some([*stiffness, *damping]),
            _ => None,
        })
    }

    /// Whether it holds the direction of what it joins.
    pub fn holds_direction(&self) -> bool {
        self.primitives.iter().any(JointPrimitive::is_directional)
    }

    /// Whether it holds a position or a distance.
    pub fn holds_position(&self) -> bool {
        let is_spring = |of: &JointPrimitive| matches!(of, JointPrimitive::Spring { .. });
        let mut primitives = self.primitives.iter();
        primitives.any(|of| !of.is_directional() && !is_spring(of))
    }

    /// As a joint with an angle: its ends rotate about one point.
    pub(super) fn pivot(&self) -> Option<Pivot<'a>> {
        let axis = self.primitives.iter().find_map(|hold| match hold {
            ParallelAxes(axis) => Some(*axis),
            _ => None,
        });
        let has_angle = match self.primitives[..] {
            [AtPoint] | [AtPoint, JointPrimitive::Spring { .. }] => true,
            [Inplane(_), ..] => false,
            _ => axis.is_some(),
        };
        has_angle.then_some(Pivot {
            name: self.name,
            joint: self.holder,
            ends: self.ends,
            axis,
        })
    }

    /// As a joint along a line of the ground or of a rigid body.
    pub(super) fn slider(&self) -> Option<Slider<'a>> {
        let direction = self.primitives.iter().find_map(|hold| match hold {
            Inline(direction) => Some(*direction),
            _ => None,
        })?;
        let along = match self.ends.first {
            First::Ground(_) => direction,
            First::Marker(ResolvedMarker {
                place: Place::Point(..),
                direction: [cos, sin, _],
                ..
            }) if self.is_planar => {
                let [x, y, _] = direction;
                [cos * x - sin * y, sin * x + cos * y, 0.0]
            }
            First::Marker(ResolvedMarker {
                place: Place::Point(..) | Place::Interface(..) | Place::Patch(..),
                ..
            }) => direction,
            First::Marker(_) | First::Cable(_) => return None,
        };
        let size = length(along);
        Some(Slider {
            name: self.name,
            joint: self.holder,
            ends: self.ends,
            direction,
            along: along.map(|part| part / size),
        })
    }
}

impl<const D: usize> Builder<'_, D> {
    /// Builds all joints, and their springs.
    pub(super) fn joints(&mut self) {
        for joint in &self.resolved.joints {
            let ends = self.ends(joint.ends);
            let mut holds = Vec::new();
            for primitive in &joint.primitives {
                holds.extend(primitive.assemble(self, joint, ends));
            }
            // A joint that can be released needs multipliers.
            holds.extend(self.clamp(joint).filter(|_| joint.release.is_none()));
            let turn = self.turn_of(joint);
            let mut primitives = joint.primitives.iter();
            let spring = primitives.find_map(|primitive| self.spring_of(primitive, ends, turn));
            self.parts.joints.push(JointEquations {
                holds,
                ends,
                spring,
                turn,
                way: joint.slider().map(|slider| self.way(&slider)),
                release: joint.release,
            });
        }
    }

    /// Appends the spring of a revolute joint to the loads; its place there.
    fn spring_of(
        &mut self,
        hold: &JointPrimitive,
        ends: [Attachment<D>; 2],
        turn: Option<AxisRotation<D>>,
    ) -> Option<usize> {
        let JointPrimitive::Spring {
            rest,
            stiffness,
            damping,
        } = *hold
        else {
            return None;
        };
        let counted = self.count_angle(ends, turn);
        let angle = Coordinate::Angle(Angle { ends, turn }, counted);
        let spring = self.joint_spring(angle, [stiffness, damping], rest);
        self.parts.loads.push(spring);
        Some(self.parts.loads.len() - 1)
    }
}
