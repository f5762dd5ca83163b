//! Driven motions: those of the scene, then those of ports.

use super::{Builder, unit};
use crate::scene::resolved::{Form, MotionKind, Place, PortKind};
use crate::system::joints::{Coupler, DrivenRotation, Primitive};
use crate::system::{Coordinate, Drive};

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
            MotionKind::Angle(source, drive) => {
                let (turn, drive) = (self.axis_turn(source), self.drive(drive));
                let driven = match turn {
                    Some(turn) => Primitive::DrivenRotation(DrivenRotation { turn, drive }),
                    None => Primitive::DrivenDirection(drive),
                };
                self.hold(driven, self.ends_of(source));
            }
            MotionKind::Position(marker, drives) => {
                let drives = std::array::from_fn(|k| self.drive(&drives[k]));
                self.hold(Primitive::DrivenPosition(drives), self.on_marker(*marker));
            }
            MotionKind::Orientation(marker, drives) => {
                let axes = self.frame_axes(*marker);
                let axes = std::array::from_fn(|k| axes[k]);
                let drives = std::array::from_fn(|k| self.drive(&drives[k]));
                let driven = Primitive::DrivenOrientation(axes, drives);
                self.hold(driven, self.on_marker(*marker));
            }
            MotionKind::Winch(marker, drive) => {
                let drive = self.drive(drive);
                self.hold(Primitive::PaidOut(drive), self.on_marker(*marker));
                if let Place::Along(cable, at) = marker.place
                    && let Form::Chain(chain) = cable.id.form
                {
                    self.parts.winches.push((chain, at > 0.5, drive));
                }
            }
            MotionKind::Displacement(slider, drive) => {
                let (ends, drive) = (self.ends(slider.ends), self.drive(drive));
                let driven = if slider.ends.is_grounded() {
                    Primitive::DrivenDistance(unit(slider.direction), drive)
                } else {
                    Primitive::Coupler(Coupler {
                        terms: vec![(1.0, Coordinate::Translation(self.way(slider)))],
                        offset: 0.0,
                        drive: Some(drive),
                        size: self.size_of(&ends),
                    })
                };
                self.hold(driven, ends);
            }
        }
    }

    fn drive(&mut self, drive: &Drive) -> usize {
        self.parts.drives.push(drive.clone());
        self.parts.drives.len() - 1
    }
}
