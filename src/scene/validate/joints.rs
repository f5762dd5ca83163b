//! Checks of joints.

use super::checks::{Key, expected, finite, keys, planar, positive, spring_damper, vector};
use crate::scene::Error;
use crate::scene::description::{Condition, Declaration, Joint, Kind as _};
use crate::scene::marker::GROUND;
use crate::scene::resolved::{self, Ends, First, Hold, Resolved, SlideId};

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
        keys(path, "joint", &all, self.kind.keys())
    }

    /// In space nothing has an angle yet, but a cable has a direction.
    fn validate_dimension(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let Declaration { name, holds, .. } = self.kind.declaration();
        let instead = "revolute, distance or along, or slider, weld, orientation or prismatic from the ground,";
        let kind = format!("{path}.kind");
        if holds.contains(&Condition::Spring) {
            return planar(&kind, dimension, instead, name);
        }
        let has_axes = |of: &Condition| matches!(of, Condition::Direction | Condition::Line);
        if holds.iter().any(has_axes) && self.markers[0] != GROUND {
            let found = format!("{name} between two bodies");
            planar(&kind, dimension, instead, &found)?;
        }
        if holds.contains(&Condition::Direction) && self.angle.is_some() {
            planar(&format!("{path}.angle"), dimension, "nothing", "an angle")?;
        }
        Ok(())
    }

    fn validate_numbers(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        if let Some(direction) = self.direction {
            vector(&at("direction"), dimension, &direction)?;
            if direction.full() == [0.0; 3] {
                let wanted = "a direction that is not zero";
                let found = format!("{:?}", direction.given());
                return Err(expected(&at("direction"), wanted, found));
            }
        }
        if let Some(angle) = self.angle {
            finite(&at("angle"), angle)?;
        }
        if let Some(length) = self.length {
            positive(&at("length"), "m", length)?;
        }
        Ok(())
    }
}

impl<'a> Resolved<'a> {
    pub(super) fn resolve_joints(&mut self) -> Result<(), Error> {
        for (index, joint) in self.scene.joints.iter().enumerate() {
            let path = format!("joints[{index}]");
            joint.validate_keys(&path)?;
            joint.validate_dimension(&path, self.scene.dimension)?;
            let ends = self.joint_ends(&path, joint)?;
            joint.validate_numbers(&path, self.scene.dimension)?;
            let holds = joint.kind.declaration().holds.iter();
            let holds =
                holds.map(|condition| self.resolve_condition(&path, joint, *condition, &ends));
            let holds = holds.collect::<Result<_, _>>()?;
            let holder = self.hold(&path, &joint.name);
            self.joints.push(resolved::Joint {
                name: &joint.name,
                holder,
                kind: joint.kind,
                ends,
                holds,
            });
        }
        Ok(())
    }

    /// What a joint joins.
    fn joint_ends(&self, path: &str, joint: &'a Joint) -> Result<Ends<'a>, Error> {
        let holds = joint.kind.declaration().holds;
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
        let turns = |of: &Condition| matches!(of, Condition::Direction | Condition::Spring);
        let holds_direction = holds.iter().any(turns);
        if a != GROUND && (holds_direction || holds.contains(&Condition::Line)) {
            self.require_turning(&first, a)?;
        }
        if holds_direction {
            match self.scene.dimension {
                2 => self.require_turning(&second, b)?,
                _ => self.require_cable_marker(&second, b)?,
            };
        }
        Ok(ends)
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
            Condition::Line => {
                // By default the direction of the first end itself.
                Hold::Line(joint.direction.map_or([1.0, 0.0, 0.0], |of| of.full()))
            }
            Condition::Direction => Hold::Direction(joint.angle),
            Condition::Distance if joint.length.is_none() && ends.distance() <= 0.0 => {
                let wanted = "a length, since the markers are at the same place at the start";
                return Err(expected(&format!("{path}.length"), wanted, "nothing"));
            }
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
