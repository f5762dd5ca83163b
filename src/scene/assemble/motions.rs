//! Driven motions: those of the scene, then those of ports.

use super::{Builder, unit};
use crate::scene::resolved::{MotionKind, PortKind};
use crate::system::{Drive, joints};

impl<const D: usize> Builder<'_, D> {
    pub(super) fn motions(&mut self) {
        for motion in &self.resolved.motions {
            self.motion(&motion.kind);
        }
        for port in &self.resolved.ports {
            if let PortKind::Motion { position, angle } = &port.kind {
                self.motion(&position.kind);
                angle.iter().for_each(|angle| self.motion(&angle.kind));
            }
        }
    }

    fn motion(&mut self, motion: &MotionKind<'_>) {
        match motion {
            MotionKind::Angle(turning, drive) => {
                let kind = joints::JointKind::DrivenAngle(self.drive(drive));
                self.hold(kind, self.turning(turning));
            }
            MotionKind::Position(marker, drives) => {
                let drives = std::array::from_fn(|k| self.drive(&drives[k]));
                let kind = joints::JointKind::DrivenPosition(drives);
                self.hold(kind, self.on_marker(*marker));
            }
            MotionKind::Displacement(slider, drive) => {
                let along = unit(slider.direction);
                let kind = joints::JointKind::DrivenWay(along, self.drive(drive));
                self.hold(kind, self.ends(slider.ends()));
            }
        }
    }

    fn drive(&mut self, drive: &Drive) -> usize {
        self.parts.drives.push(drive.clone());
        self.parts.drives.len() - 1
    }
}
