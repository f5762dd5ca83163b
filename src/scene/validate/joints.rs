//! Checks of joints.

use nalgebra::Vector3;

use super::checks::{
    Key, direction, expected, finite, keys, not_negative, not_zero, planar, positive, quoted,
    spring_damper,
};
use crate::scene::description::{Condition, Joint, JointKind, JointSpec, Kind as _};
use crate::scene::marker::GROUND;
use crate::scene::resolved::{self, Ends, First, Hold, Marker, Place, Resolved, SlideId};
use crate::scene::{Error, Vector};
use crate::system::Release;

/// Cosine of an angle that is a right one but for rounding.
const RIGHT: f64 = 1e-6;

/// A direction that a joint demands.
fn given(direction: Option<Vector>) -> [f64; 3] {
    direction.map_or([1.0, 0.0, 0.0], |of| of.full())
}

impl Joint {
    fn validate_keys(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let (point, direction) = match dimension {
            2 => ("a point [x, y]", "a direction [x, y]"),
            _ => ("a point [x, y, z]", "a direction [x, y, z]"),
        };
        let all: [Key; 9] = [
            ("point", self.point.is_some(), point),
            ("direction", self.direction.is_some(), direction),
            (
                "second_direction",
                self.second_direction.is_some(),
                "a direction [x, y, z]",
            ),
            ("angle", self.angle.is_some(), "an angle"),
            ("length", self.length.is_some(), "a length"),
            ("pitch", self.pitch.is_some(), "a pitch"),
            ("free", self.free.is_some(), "a list of freedoms"),
            ("stiffness", self.stiffness.is_some(), "a stiffness"),
            ("damping", self.damping.is_some(), "a damping"),
        ];
        keys(path, "joint", &all, self.kind.keys())
    }

    /// Refuses kinds that exist only in the plane or only in space.
    fn validate_dimension(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let JointSpec { name, holds, .. } = self.kind.declaration();
        let kind = format!("{path}.kind");
        if holds.contains(&Condition::Direction) && self.angle.is_some() {
            planar(&format!("{path}.angle"), dimension, "nothing", "an angle")?;
        }
        if dimension == 3 {
            let demands = [Condition::Line, Condition::Axis];
            let demands = holds.iter().any(|of| demands.contains(of));
            if !demands || self.direction.is_some() {
                return Ok(());
            }
            let wanted = match self.kind {
                JointKind::Revolute => {
                    "the axis [x, y, z] that a revolute joint turns about (a ball joint is `spherical`)"
                }
                _ => "a direction [x, y, z]",
            };
            return Err(expected(&format!("{path}.direction"), wanted, "nothing"));
        }
        if self.kind.is_spatial() {
            let wanted = "revolute, weld, point_on_line, prismatic, orientation, distance or point_on_cable in the plane";
            return Err(expected(&kind, wanted, name));
        }
        if holds.contains(&Condition::Axis) && self.direction.is_some() {
            let place = format!("{path}.direction");
            return Err(expected(&place, "nothing in the plane", "a direction"));
        }
        Ok(())
    }

    fn validate_numbers(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        let directions = [
            ("direction", self.direction),
            ("second_direction", self.second_direction),
        ];
        for (key, given) in directions {
            if let Some(given) = given {
                direction(&at(key), dimension, &given)?;
            }
        }
        if let (Some(a), Some(b)) = (self.direction, self.second_direction) {
            let [a, b] = [a, b].map(|of| Vector3::from(of.full()).normalize());
            if a.dot(&b).abs() > RIGHT {
                let wanted = "a direction across `direction`";
                let found = format!("one at {} rad from it", a.dot(&b).acos());
                return Err(expected(&at("second_direction"), wanted, found));
            }
        }
        if let Some(angle) = self.angle {
            finite(&at("angle"), angle)?;
            if self.kind == JointKind::Revolute && !self.is_sprung() {
                let wanted = "a stiffness or a damping beside the angle of a revolute joint";
                return Err(expected(&at("angle"), wanted, "neither"));
            }
        }
        if let Some(length) = self.length {
            positive(&at("length"), "m", length)?;
        }
        if let Some(time) = self.release_time {
            not_negative(&at("release_time"), "s", time)?;
        }
        if let Some(pitch) = self.pitch {
            not_zero(&at("pitch"), "m", pitch)?;
        }
        let Some(free) = &self.free else {
            return Ok(());
        };
        let twice = (1..free.len()).find(|k| free[..*k].contains(&free[*k]));
        if let Some(k) = twice {
            let wanted = "a freedom that is not in the list yet";
            let found = format!("{:?} again", free[k]);
            return Err(expected(&format!("{}[{k}]", at("free")), wanted, found));
        }
        match free.len() {
            6 => Err(expected(
                &at("free"),
                "freedoms that leave something to hold",
                "all six",
            )),
            _ => Ok(()),
        }
    }

    /// Returns the primitives of a generic joint, with its axes at the start in global components.
    fn rest(&self, ends: &Ends<'_>) -> Vec<Hold> {
        let axis = |k: usize| {
            let unit = std::array::from_fn(|i| f64::from(u8::from(i == k)));
            Resolved::global(ends, unit)
        };
        let named = |is_rotation: bool| {
            let free = self.free.iter().flatten().map(|freedom| freedom.axis());
            let free = free.filter(|(_, of)| *of == is_rotation).map(|(k, _)| k);
            free.collect::<Vec<usize>>()
        };
        let (ways, turns) = (named(false), named(true));
        let mut holds: Vec<Hold> = match ways[..] {
            [] => vec![Hold::Position],
            [along] => vec![Hold::Line(axis(along))],
            _ => {
                let held = (0..3).filter(|k| !ways.contains(k));
                held.map(|k| Hold::Plane(axis(k))).collect()
            }
        };
        holds.extend(match turns[..] {
            [] => Some(Hold::Direction(None)),
            [about] => Some(Hold::Axis(axis(about))),
            [first, second] => Some(Hold::Across(axis(first), axis(second))),
            _ => None,
        });
        holds
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
            joint.validate_keys(&path, self.scene.dimension)?;
            joint.validate_dimension(&path, self.scene.dimension)?;
            let ends = self.joint_ends(&path, joint)?;
            joint.validate_numbers(&path, self.scene.dimension)?;
            let holds = joint.holds();
            let is_held = |condition: &&Condition| match condition {
                Condition::Axis => self.scene.dimension == 3,
                _ => true,
            };
            let holds = holds
                .iter()
                .filter(is_held)
                .map(|condition| match condition {
                    Condition::Rest => Ok(joint.rest(&ends)),
                    _ => self
                        .resolve_condition(&path, joint, *condition, &ends)
                        .map(|hold| vec![hold]),
                });
            let holds = holds.collect::<Result<Vec<_>, _>>()?.concat();
            let holder = self.hold(&path, &joint.name);
            self.joints.push(resolved::Joint {
                name: &joint.name,
                holder,
                kind: joint.kind,
                is_planar: self.scene.dimension == 2,
                ends,
                holds,
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
    fn joint_ends(&self, path: &str, joint: &'a Joint) -> Result<Ends<'a>, Error> {
        let holds = joint.holds();
        let [first, second] = [0, 1].map(|side| format!("{path}.markers[{side}]"));
        let [a, b] = &joint.markers;
        if holds.contains(&Condition::Curve) {
            let (cable, _) = self.require_flexible(&first, a)?;
            let marker = self.require_marker(&second, b)?;
            self.require_two(path, [cable.id.body, marker.place.body_index()])?;
            let first = First::Cable(cable);
            return Ok(Ends {
                first,
                second: marker,
            });
        }
        let ends = self.require_pair(path, &joint.markers, joint.point)?;
        if self.scene.dimension == 3 {
            self.require_axes(path, joint, &ends)?;
            Self::require_moments(path, joint, &ends)?;
            return Ok(ends);
        }
        let turns = |of: &Condition| matches!(of, Condition::Direction | Condition::Spring);
        let holds_direction = holds.iter().any(turns);
        if a != GROUND && (holds_direction || holds.contains(&Condition::Line)) {
            self.require_directed(&first, a)?;
        }
        if holds_direction {
            self.require_directed(&second, b)?;
        }
        Ok(ends)
    }

    /// In space: axes belong to the ground and to rigid bodies with inertia; a cable has a direction alone, which the ground
    /// or such a body can hold.
    fn require_axes(&self, path: &str, joint: &Joint, ends: &Ends<'a>) -> Result<(), Error> {
        let holds = joint.holds();
        let is_cable = |marker: &Marker<'_>| {
            matches!(marker.place, Place::Along(..)) && !marker.place.is_framed()
        };
        let first = match ends.first {
            First::Marker(marker) => Some(marker),
            First::Ground(_) | First::Cable(_) => None,
        };
        let axes = [Condition::Axis, Condition::Across, Condition::Plane];
        let needs_frames = holds
            .iter()
            .any(|of| axes.contains(of) || *of == Condition::Rest);
        let holds_direction = holds.contains(&Condition::Direction);
        let sides = [
            (0, first, needs_frames || holds.contains(&Condition::Line)),
            (1, Some(ends.second), needs_frames),
        ];
        for (side, marker, needs_frame) in sides {
            let Some(marker) = marker.filter(|_| needs_frame || holds_direction) else {
                continue;
            };
            let is_clamped = holds_direction && is_cable(&marker);
            if needs_frame && is_cable(&marker) || !marker.place.turns() {
                let wanted = "a marker of a rigid body with inertia or of a rod, which has axes";
                let place = format!("{path}.markers[{side}]");
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

    /// In space: a thin rod has no inertia that could follow a joint which turns it about its own axis, and does not turn
    /// about it. So a joint holds that axis alone, or stands on the ground and turns the rod across it.
    fn require_moments(path: &str, joint: &Joint, ends: &Ends<'a>) -> Result<(), Error> {
        let holds = joint.holds();
        let first = match ends.first {
            First::Marker(marker) => Some(marker),
            First::Ground(_) | First::Cable(_) => None,
        };
        let both = [joint.direction, joint.second_direction.or(joint.direction)];
        let both = both.map(|of| Vector3::from(Self::global(ends, given(of))).normalize());
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
            let may_hold = |condition: &Condition| match condition {
                Condition::Axis | Condition::Plane => is_along || is_pivot,
                Condition::Across => is_along,
                Condition::Line => side == 1 || is_along,
                Condition::Direction => on_ground,
                Condition::Spring => is_pivot,
                Condition::Screw | Condition::Rest => false,
                Condition::Position | Condition::Distance | Condition::Curve => true,
            };
            if !holds.iter().all(may_hold) {
                let wanted = "a body with a moment of inertia about every axis, which the joint turns it about";
                let place = format!("{path}.markers[{side}]");
                return Err(expected(&place, wanted, quoted(marker.name)));
            }
        }
        Ok(())
    }

    /// A direction in the axes of the first end's body, in global axes at the start.
    fn global(ends: &Ends<'a>, direction: [f64; 3]) -> [f64; 3] {
        match ends.first {
            First::Marker(Marker {
                place: Place::Point(rigid, _),
                ..
            }) => rigid.body.directed(direction),
            First::Marker(Marker {
                place: Place::Along(cable, s),
                ..
            }) if cable.body.is_rod() => cable.body.directed(s, direction),
            _ => direction,
        }
    }

    /// A condition of a joint with its values.
    fn resolve_condition(
        &self,
        path: &str,
        joint: &Joint,
        condition: Condition,
        ends: &Ends<'a>,
    ) -> Result<Hold, Error> {
        Ok(match condition {
            Condition::Position => Hold::Position,
            Condition::Line if self.scene.dimension == 3 => {
                Hold::Line(Self::global(ends, given(joint.direction)))
            }
            Condition::Axis => Hold::Axis(Self::global(ends, given(joint.direction))),
            Condition::Plane => Hold::Plane(Self::global(ends, given(joint.direction))),
            Condition::Across => {
                let both = [joint.direction, joint.second_direction];
                let [a, b] = both.map(|of| Self::global(ends, given(of)));
                Hold::Across(a, b)
            }
            Condition::Line => {
                // By default the direction of the first end itself.
                Hold::Line(joint.direction.map_or([1.0, 0.0, 0.0], |of| of.full()))
            }
            Condition::Direction => Hold::Direction(joint.angle),
            Condition::Distance if joint.length.is_none() && ends.distance() <= 0.0 => {
                let wanted = "a length, since the markers are at the same place at the start";
                return Err(expected(&format!("{path}.length"), wanted, "nothing"));
            }
            Condition::Screw => Hold::Screw(joint.pitch.unwrap_or_default()),
            // Several, by `Joint::rest`.
            Condition::Rest => Hold::Position,
            Condition::Distance => Hold::Distance(joint.length),
            Condition::Curve => {
                let first = format!("{path}.markers[0]");
                let (_, chain) = self.require_flexible(&first, &joint.markers[0])?;
                let slides = self.joints.iter().filter_map(|joint| joint.slide());
                Hold::Curve(chain, SlideId(slides.count()))
            }
            Condition::Spring => {
                let stiffness = (joint.stiffness, "N m/rad");
                let [stiffness, damping] =
                    spring_damper(path, stiffness, (joint.damping, "N m s/rad"))?;
                Hold::Spring {
                    rest: joint.angle,
                    stiffness,
                    damping,
                }
            }
        })
    }
}
