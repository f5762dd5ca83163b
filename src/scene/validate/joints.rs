//! Checks of joints.

use nalgebra::Vector3;

use super::checks::{
    direction, expected, finite, not_negative, not_zero, planar, positive, quoted, shape,
    spring_damper,
};
use super::references::refuse_point;
use crate::scene::Error;
use crate::scene::description::{Generic, JointKind, JointPrimitive, Kinds as _};
use crate::scene::marker::GROUND;
use crate::scene::resolved::{self, Ends, First, Place, Resolved, ResolvedMarker, SlideId};
use crate::scene::unit::spring_units;
use crate::system::Release;

/// Cosine of an angle that is a right one but for rounding.
const RIGHT: f64 = 1e-6;

/// Refuses kinds that exist only in the plane or only in space.
impl JointKind {
    /// Refuses kinds that exist only in the plane or only in space.
    ///
    /// # Errors
    /// The joint has no place in this dimension.
    fn validate_dimension(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let is_held = |of: &JointPrimitive| matches!(of, JointPrimitive::Orientation(Some(_)));
        if self.primitives().iter().any(is_held) {
            planar(&format!("{path}.angle"), dimension, "nothing", "an angle")?;
        }
        let place = format!("{path}.direction");
        match (self, dimension, self.directions()) {
            (Self::Revolute(_), 3, [None, _]) => {
                let wanted = "the axis [x, y, z] that a revolute joint rotates about (a ball joint is `spherical`)";
                Err(expected(&place, wanted, "nothing"))
            }
            (Self::Prismatic(_), 3, [None, _]) => {
                Err(expected(&place, "a direction [x, y, z]", "nothing"))
            }
            (Self::Revolute(_), 2, [Some(_), _]) => {
                Err(expected(&place, "nothing in the plane", "a direction"))
            }
            (Self::PointOnLine(of), _, _) if of.direction.is_unsaid() => {
                let wanted = format!("a direction {}", shape(dimension));
                Err(expected(&place, &wanted, "nothing"))
            }
            (_, 2, _) if self.is_spatial() => {
                let wanted = "revolute, weld, point_on_line, prismatic, orientation, distance or point_on_cable in the plane";
                Err(expected(&format!("{path}.kind"), wanted, self.name()))
            }
            _ => Ok(()),
        }
    }

    fn validate_numbers(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        let directions = ["direction", "second_direction"].into_iter();
        for (key, given) in directions.zip(self.directions()) {
            if let Some(given) = given {
                direction(&at(key), dimension, &given)?;
            }
        }
        if let Some(angle) = self.angle() {
            finite(&at("angle"), angle)?;
        }
        match self {
            Self::Revolute(of) if of.angle.is_some() && !of.is_sprung() => {
                let wanted = "a stiffness or a damping beside the angle of a revolute joint";
                Err(expected(&at("angle"), wanted, "neither"))
            }
            Self::Universal(of) => {
                let both = [of.direction, of.second_direction];
                let [a, b] = both.map(|of| Vector3::from(of.full()).normalize());
                if a.dot(&b).abs() <= RIGHT {
                    return Ok(());
                }
                let wanted = "a direction across `direction`";
                let found = format!("one at {} rad from it", a.dot(&b).acos());
                Err(expected(&at("second_direction"), wanted, found))
            }
            Self::ConstantVelocity(of) => {
                let second = of.second_direction.unwrap_or(of.direction);
                let [a, b] = [of.direction, second].map(|of| Vector3::from(of.full()).normalize());
                if a.dot(&b) > RIGHT {
                    return Ok(());
                }
                let wanted = "a direction less than a right angle from `direction`";
                let found = format!("one at {} rad from it", a.dot(&b).acos());
                Err(expected(&at("second_direction"), wanted, found))
            }
            Self::Distance(of) => (of.length).map_or(Ok(()), |of| positive(&at("length"), "m", of)),
            Self::Screw(of) => not_zero(&at("pitch"), "m", of.pitch),
            Self::Generic(of) => of.validate_free(&at("free")),
            _ => Ok(()),
        }
    }
}

impl Generic {
    fn validate_free(&self, path: &str) -> Result<(), Error> {
        let free = &self.free;
        let twice = (1..free.len()).find(|k| free[..*k].contains(&free[*k]));
        if let Some(k) = twice {
            let wanted = "a freedom that is not in the list yet";
            let found = format!("{:?} again", free[k]);
            return Err(expected(&format!("{path}[{k}]"), wanted, found));
        }
        match free.len() {
            6 => Err(expected(
                path,
                "freedoms that leave something to hold",
                "all six",
            )),
            _ => Ok(()),
        }
    }
}

impl<'a> Resolved<'a> {
    /// Resolves the joints.
    ///
    /// # Errors
    /// A missing key, a marker that does not exist, or ends or axes that the kind does not allow.
    pub(super) fn resolve_joints(&mut self) -> Result<(), Error> {
        for (index, joint) in self.scene.joints.iter().enumerate() {
            let path = format!("joints[{index}]");
            let kind = &joint.kind;
            kind.validate_dimension(&path, self.scene.dimension)?;
            let ends = self.joint_ends(&path, kind)?;
            kind.validate_numbers(&path, self.scene.dimension)?;
            if let Some(time) = joint.release_time {
                not_negative(&format!("{path}.release_time"), "s", time)?;
            }
            let primitives = self.resolve_primitives(&path, kind, &ends)?;
            let slide = self.resolve_slide(&path, kind, &ends)?;
            let holder = self.hold(&path, &joint.name);
            self.joints.push(resolved::ResolvedJoint {
                name: &joint.name,
                holder,
                kind,
                is_planar: self.scene.dimension == 2,
                ends,
                primitives,
                slide,
                release: joint.release_time.map(|time| Release {
                    time: Some(time),
                    input: None,
                }),
            });
        }
        self.unite_axes();
        Ok(())
    }

    /// Resolves the ends of a joint.
    fn joint_ends(&self, path: &str, joint: &'a JointKind) -> Result<Ends<'a>, Error> {
        let primitives = joint.primitives();
        let [first, second] = [0, 1].map(|side| format!("{path}.markers[{side}]"));
        let markers = joint.markers();
        let [a, b] = markers;
        if let JointKind::PointOnCable(_) = joint {
            let (cable, _) = self.require_flexible(&first, a)?;
            let marker = self.require_marker(&second, b)?;
            self.require_two(path, [cable.id.body, marker.place.body_index()])?;
            let first = First::Cable(cable);
            return Ok(Ends {
                first,
                second: marker,
            });
        }
        let ends = self.require_pair(path, markers, joint.point())?;
        if self.scene.dimension == 3 {
            self.require_axes(path, joint, &ends)?;
            Self::require_moments(path, joint, &ends)?;
            return Ok(ends);
        }
        let turns = |of: &JointPrimitive| {
            matches!(
                of,
                JointPrimitive::Orientation(_) | JointPrimitive::Spring { .. }
            )
        };
        let holds_direction = primitives.iter().any(turns);
        let is_line = |of: &JointPrimitive| matches!(of, JointPrimitive::Inline(_));
        if a != GROUND && (holds_direction || primitives.iter().any(is_line)) {
            self.require_directed(&first, a)?;
        }
        if holds_direction {
            self.require_directed(&second, b)?;
        }
        Ok(ends)
    }

    /// In space: axes belong to the ground and to rigid bodies with inertia; a cable has a direction alone, which the ground
    /// or such a body can hold.
    fn require_axes(&self, path: &str, joint: &JointKind, ends: &Ends<'a>) -> Result<(), Error> {
        let primitives = joint.primitives();
        let is_cable = |marker: &ResolvedMarker<'_>| {
            matches!(marker.place, Place::Along(..)) && !marker.place.is_framed()
        };
        let first = match ends.first {
            First::Marker(marker) => Some(marker),
            First::Ground(_) | First::Cable(_) => None,
        };
        let is_any = |of: fn(&JointPrimitive) -> bool| primitives.iter().any(of);
        let needs_frames =
            is_any(JointPrimitive::needs_axes) || matches!(joint, JointKind::Generic(_));
        let is_line = is_any(|of| matches!(of, JointPrimitive::Inline(_)));
        let holds_direction = is_any(|of| matches!(of, JointPrimitive::Orientation(_)));
        let sides = [
            (0, first, needs_frames || is_line),
            (1, Some(ends.second), needs_frames),
        ];
        for (side, marker, needs_frame) in sides {
            let Some(marker) = marker.filter(|_| needs_frame || holds_direction) else {
                continue;
            };
            let is_clamped = holds_direction && is_cable(&marker);
            let place = format!("{path}.markers[{side}]");
            refuse_point(&place, marker)?;
            if needs_frame && is_cable(&marker) || !marker.place.turns() {
                let wanted = "a marker of a rigid body with inertia or of a rod, which has axes";
                return Err(expected(&place, wanted, quoted(marker.name)));
            }
            let both = first.is_some_and(|first| is_cable(&first)) && is_cable(&ends.second);
            if is_clamped && both {
                let wanted = "a rigid body or the ground beside a cable, which has no axes";
                return Err(expected(&format!("{path}.markers"), wanted, "two cables"));
            }
        }
        Ok(())
    }

    /// In space: a thin rod has no inertia that could follow a joint which rotates it about its own axis, and does not rotate
    /// about it. So a joint holds that axis alone, or stands on the ground and rotates the rod across it.
    fn require_moments(path: &str, joint: &JointKind, ends: &Ends<'a>) -> Result<(), Error> {
        let primitives = joint.primitives();
        let first = match ends.first {
            First::Marker(marker) => Some(marker),
            First::Ground(_) | First::Cable(_) => None,
        };
        let [direction, second] = joint.directions();
        let both = [direction, second.or(direction)].map(|of| {
            let of = of.map_or([1.0, 0.0, 0.0], |of| of.full());
            Vector3::from(Self::global(ends, of)).normalize()
        });
        for (side, marker) in [(0, first), (1, Some(ends.second))] {
            let Some(marker) = marker else {
                continue;
            };
            let Place::Point(rigid, _) = marker.place else {
                continue;
            };
            let Some(axis) = rigid.body.inertia().thin() else {
                continue;
            };
            let axis = Vector3::from(rigid.body.directed(axis.into()));
            let cosine = both[side].dot(&axis);
            let (is_along, on_ground) = (1.0 - cosine.abs() < RIGHT, first.is_none());
            let is_pivot = on_ground && cosine.abs() < RIGHT;
            let may_hold = |primitive: &JointPrimitive| match primitive {
                JointPrimitive::ParallelAxes(_) | JointPrimitive::Inplane(_) => {
                    is_along || is_pivot
                }
                JointPrimitive::Perpendicular(..) => is_along,
                JointPrimitive::Inline(_) => side == 1 || is_along,
                JointPrimitive::Orientation(_) => on_ground,
                JointPrimitive::Spring { .. } => is_pivot,
                JointPrimitive::Homokinetic(..) | JointPrimitive::Screw(_) => false,
                JointPrimitive::AtPoint
                | JointPrimitive::Distance(_)
                | JointPrimitive::PointOnCurve => true,
            };
            if matches!(joint, JointKind::Generic(_)) || !primitives.iter().all(may_hold) {
                let wanted = "a body with a moment of inertia about every axis, about which the joint rotates it";
                let place = format!("{path}.markers[{side}]");
                return Err(expected(&place, wanted, quoted(marker.name)));
            }
        }
        Ok(())
    }

    /// A direction in the axes of the first end's body, in global axes at the start.
    fn global(ends: &Ends<'a>, direction: [f64; 3]) -> [f64; 3] {
        match ends.first {
            First::Marker(ResolvedMarker {
                place: Place::Point(rigid, _),
                ..
            }) => rigid.body.directed(direction),
            First::Marker(ResolvedMarker {
                place: Place::Along(cable, s),
                ..
            }) if cable.body.is_rod() => cable.body.directed(s, direction),
            First::Marker(ResolvedMarker {
                place: Place::Interface(reduced, _),
                ..
            }) => reduced.body.directed(direction),
            _ => direction,
        }
    }

    /// Resolves the primitives of a joint: in space with directions in global axes at the start.
    fn resolve_primitives(
        &self,
        path: &str,
        joint: &JointKind,
        ends: &Ends<'a>,
    ) -> Result<Vec<JointPrimitive>, Error> {
        if let JointKind::Revolute(of) = joint
            && of.is_sprung()
        {
            spring_damper(path, of.stiffness, of.damping, spring_units(true))?;
        }
        let mut primitives = joint.primitives();
        if primitives.contains(&JointPrimitive::Distance(None)) && ends.distance() <= 0.0 {
            let wanted = "a length, since the markers are at the same place at the start";
            return Err(expected(&format!("{path}.length"), wanted, "nothing"));
        }
        if self.scene.dimension == 3 {
            for primitive in &mut primitives {
                *primitive = primitive.directed(|of| Self::global(ends, of));
            }
        }
        Ok(primitives)
    }

    /// Resolves the cable and the number of a slide.
    fn resolve_slide(
        &self,
        path: &str,
        joint: &JointKind,
        ends: &Ends<'a>,
    ) -> Result<Option<(usize, SlideId)>, Error> {
        let JointKind::PointOnCable(_) = joint else {
            return Ok(None);
        };
        let first = format!("{path}.markers[0]");
        let (_, chain) = self.require_flexible(&first, ends.first_name())?;
        let before = self.joints.iter().filter(|joint| joint.slide.is_some());
        Ok(Some((chain, SlideId(before.count()))))
    }
}
