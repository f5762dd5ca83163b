//! Driven motions: those of the scene, then those of ports.

use nalgebra::Vector2;

use super::{Builder, direction};
use crate::math::function::Function;
use crate::scene::{Motion, MotionKind, MotionValue};
use crate::system::joints::{self, Joint};
use crate::system::{Drive, End};

impl Builder<'_> {
    pub(super) fn motions(&mut self) {
        let scene = self.scene;
        let mut driven = self.layout.of_motions.clone().into_iter();
        for motion in &scene.motions {
            let first = motion.input_count().and_then(|_| driven.next());
            self.motion(motion, first.unwrap_or(0));
        }
        for (place, port) in scene.ports.iter().enumerate() {
            let mut first = self.layout.of_ports[place];
            for motion in port.motions().iter().filter(|_| port.drives()) {
                self.motion(motion, first);
                first += motion.input_count().unwrap_or(0);
            }
        }
    }

    /// A motion; `first` is the index of its first input if it has any.
    fn motion(&mut self, motion: &Motion, first: usize) {
        let drives: Vec<usize> = (0..motion.coordinates())
            .map(|k| self.drive(&motion.value, first, k))
            .collect();
        let ground = End::Ground(Vector2::zeros());
        let ends = match (&motion.marker, &motion.joint) {
            (Some(marker), _) => [ground, End::Body(self.marker(marker))],
            (None, joint) => self.joint_ends(joint.as_deref().unwrap_or_default()),
        };
        let kind = match motion.kind {
            MotionKind::Angle => joints::JointKind::DrivenAngle(drives[0]),
            MotionKind::Position => joints::JointKind::DrivenPosition([drives[0], drives[1]]),
            MotionKind::Displacement => {
                let joint = motion
                    .joint
                    .as_deref()
                    .and_then(|name| self.scene.joint(name));
                let along = direction(self.scene.joints[joint.unwrap_or(0)].direction);
                joints::JointKind::DrivenWay(along, drives[0])
            }
        };
        self.parts.joints.push(Joint {
            kind,
            ends,
            spring: None,
        });
    }

    /// Component `k` of a motion.
    fn drive(&mut self, value: &MotionValue, first: usize, k: usize) -> usize {
        self.parts.drives.push(match value {
            MotionValue::Input(master) => {
                let derivatives = usize::from(master.input);
                Drive::Input {
                    first: first + k * (derivatives + 1),
                    derivatives,
                }
            }
            given => {
                let function = given.components()[k].motion_function();
                Drive::Function(function.unwrap_or(Function::Constant(0.0)))
            }
        });
        self.parts.drives.len() - 1
    }
}
