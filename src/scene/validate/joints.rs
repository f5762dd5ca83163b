//! Checks of joints.

use super::checks::{
    Key, expected, finite, keys, needed, planar, positive, quoted, spring_damper, vector,
};
use crate::scene::Error;
use crate::scene::description::{Joint, JointKind, Kind as _};
use crate::scene::marker::GROUND;
use crate::scene::resolved::{self, Ends, Resolved, SlideId, Slider};

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

    /// In space there is nothing yet that has an angle.
    fn validate_dimension(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let instead = "revolute, slider, distance or along, or weld from the ground to a cable,";
        let found = match self.kind {
            JointKind::Prismatic => "prismatic",
            JointKind::Orientation => "orientation",
            JointKind::Hinge => "hinge",
            JointKind::Weld if self.markers[0] != GROUND => "weld between two bodies",
            JointKind::Weld if self.angle.is_some() => {
                let place = format!("{path}.angle");
                return planar(&place, dimension, "nothing", "an angle");
            }
            _ => return Ok(()),
        };
        planar(&format!("{path}.kind"), dimension, instead, found)
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
            let kind = self.resolve_joint(&path, joint)?;
            let holder = self.hold(&path, &joint.name);
            self.joints.push(resolved::Joint {
                name: &joint.name,
                holder,
                kind,
            });
        }
        Ok(())
    }

    fn resolve_slide(
        &self,
        path: &str,
        joint: &'a Joint,
    ) -> Result<resolved::JointKind<'a>, Error> {
        let [first, second] = [0, 1].map(|side| format!("{path}.markers[{side}]"));
        let cable = self.require_cable(&first, &joint.markers[0])?;
        let marker = self.require_marker(&second, &joint.markers[1])?;
        self.require_two(path, [cable.id.body, marker.place.body_index()])?;
        let is_slide =
            |joint: &&resolved::Joint| matches!(joint.kind, resolved::JointKind::Along { .. });
        Ok(resolved::JointKind::Along {
            cable,
            marker,
            slide: SlideId(self.joints.iter().filter(is_slide).count()),
        })
    }

    /// What a joint between two ends joins; their values are checked.
    fn joint_ends(&self, path: &str, joint: &'a Joint) -> Result<Ends<'a>, Error> {
        let [first, second] = [0, 1].map(|side| format!("{path}.markers[{side}]"));
        let [a, b] = &joint.markers;
        if joint.kind == JointKind::Slider && a != GROUND {
            return Err(expected(&first, "\"ground\"", quoted(a)));
        }
        let ends = self.require_pair(path, &joint.markers, joint.point)?;
        use JointKind::{Hinge, Orientation, Prismatic, Weld};
        if joint.kind == Weld && self.scene.dimension == 3 {
            self.require_cable_marker(&second, b)?;
        } else if matches!(joint.kind, Weld | Orientation | Hinge | Prismatic) {
            if a != GROUND {
                self.require_turning(&first, a)?;
            }
            self.require_turning(&second, b)?;
        }
        joint.validate_numbers(path, self.scene.dimension)?;
        Ok(ends)
    }

    fn resolve_joint(
        &self,
        path: &str,
        joint: &'a Joint,
    ) -> Result<resolved::JointKind<'a>, Error> {
        use resolved::JointKind as Kind;
        let ends = || self.joint_ends(path, joint);
        Ok(match joint.kind {
            JointKind::Revolute => Kind::Revolute(ends()?),
            JointKind::Weld => Kind::Weld(ends()?, joint.angle),
            JointKind::Slider => Kind::Slider(Slider {
                name: &joint.name,
                point: joint.point.map(|point| point.full()),
                marker: ends()?.second,
                direction: needed(path, "direction", "a direction [x, y]", joint.direction)?.full(),
            }),
            JointKind::Prismatic => Kind::Prismatic {
                ends: ends()?,
                direction: joint.direction.map_or([1.0, 0.0, 0.0], |of| of.full()),
                angle: joint.angle,
            },
            JointKind::Orientation => Kind::Orientation(ends()?, joint.angle),
            JointKind::Distance => {
                let ends = ends()?;
                if joint.length.is_none() && ends.distance() <= 0.0 {
                    let wanted = "a length, since the markers are at the same place at the start";
                    return Err(expected(&format!("{path}.length"), wanted, "nothing"));
                }
                Kind::Distance(ends, joint.length)
            }
            JointKind::Hinge => {
                let (ends, stiffness) = (ends()?, (joint.stiffness, "N m/rad"));
                let [stiffness, damping] =
                    spring_damper(path, stiffness, (joint.damping, "N m s/rad"))?;
                Kind::Hinge {
                    ends,
                    rest: joint.angle,
                    stiffness,
                    damping,
                }
            }
            JointKind::Along => self.resolve_slide(path, joint)?,
        })
    }
}
