//! Joints, springs, driven motions, and ports that motions come into.

use super::{Picture, Place};
use crate::fmi2::canvas::{direction, moved};
use crate::fmi2::symbols;
use crate::scene::{At, GROUND, Joint, JointKind, LoadKind, MotionKind, PortKind};

/// The way out of a body at a marker: at the first half of a cable backwards.
fn outward(place: &Place) -> [f64; 2] {
    match place.at {
        At::Along(s) if s < 0.5 => place.direction.map(|part| -part),
        _ => place.direction,
    }
}

impl Picture<'_> {
    pub(super) fn joints(&mut self) {
        for joint in &self.scene.joints {
            self.joint(joint);
        }
    }

    fn joint(&mut self, joint: &Joint) {
        let Some(place) = self.place(&joint.markers[1]) else {
            return;
        };
        let is_ground = joint.markers[0] == GROUND;
        // The cable that a joint of kind `along` runs on is no place of its own.
        let ends = match joint.kind {
            JointKind::Along => None,
            _ => self.ends(&joint.markers, joint.point),
        };
        let [first, second] = ends.unwrap_or([place.point; 2]);
        let (canvas, unit) = (&mut self.canvas, self.unit);
        match joint.kind {
            JointKind::Revolute if is_ground => symbols::revolute(canvas, first, unit),
            JointKind::Revolute => symbols::pin(canvas, second, unit),
            JointKind::Hinge => {
                symbols::spiral(canvas, second, unit);
                if is_ground {
                    symbols::revolute(canvas, first, unit);
                } else {
                    symbols::pin(canvas, second, unit);
                }
            }
            JointKind::Weld if is_ground => symbols::weld(canvas, first, outward(&place), unit),
            JointKind::Weld => symbols::block(canvas, second, place.direction, unit),
            JointKind::Slider => {
                let [x, y] = joint.direction.unwrap_or([1.0, 0.0]);
                symbols::slider(canvas, second, direction([x, -y]), unit);
            }
            JointKind::Orientation => symbols::orientation(canvas, second, place.direction, unit),
            JointKind::Distance => {
                symbols::link(canvas, first, second, unit);
                if is_ground {
                    symbols::revolute(canvas, first, unit);
                } else {
                    symbols::pin(canvas, first, unit);
                }
                symbols::pin(canvas, second, unit);
            }
            JointKind::Along => symbols::ring(canvas, second, unit),
        }
    }

    pub(super) fn springs(&mut self) {
        let loads = self.scene.loads.iter();
        for load in loads.filter(|load| load.kind == LoadKind::SpringDamper) {
            let Some(markers) = &load.markers else {
                continue;
            };
            let Some([from, to]) = self.ends(markers, load.point) else {
                continue;
            };
            symbols::spring(&mut self.canvas, from, to, self.unit);
            if markers[0] == GROUND {
                symbols::revolute(&mut self.canvas, from, self.unit);
            }
        }
    }

    pub(super) fn ports(&mut self) {
        let ports = self.scene.ports.iter();
        for port in ports.filter(|port| port.kind == PortKind::Motion) {
            let Some(place) = self.place(&port.marker) else {
                continue;
            };
            let (mut at, unit) = (place.point, self.unit);
            if port.is_coupling() {
                // Its other end is where the marker is; it is drawn aside, where bodies are rare.
                let aside = moved(at, direction([1.0, 1.0]), 4.0 * unit);
                symbols::spring(&mut self.canvas, at, aside, unit);
                at = aside;
            }
            symbols::way(&mut self.canvas, at, [1.0, 0.0], unit);
            symbols::way(&mut self.canvas, at, [0.0, 1.0], unit);
            if port.turns() {
                symbols::turn(&mut self.canvas, at, unit, symbols::MOTION);
            }
        }
    }

    pub(super) fn motions(&mut self) {
        for motion in &self.scene.motions {
            let joint = motion
                .joint
                .as_deref()
                .and_then(|name| self.scene.joint(name));
            let joint = joint.map(|joint| &self.scene.joints[joint]);
            let marker = motion
                .marker
                .as_ref()
                .or(joint.map(|joint| &joint.markers[1]));
            let Some(place) = marker.and_then(|marker| self.place(marker)) else {
                continue;
            };
            let (canvas, at, unit) = (&mut self.canvas, place.point, self.unit);
            match motion.kind {
                MotionKind::Angle => symbols::turn(canvas, at, unit, symbols::MOTION),
                MotionKind::Position => {
                    symbols::way(canvas, at, [1.0, 0.0], unit);
                    symbols::way(canvas, at, [0.0, 1.0], unit);
                }
                MotionKind::Displacement => {
                    let along = joint.and_then(|joint| joint.direction);
                    let [x, y] = along.unwrap_or([1.0, 0.0]);
                    symbols::way(canvas, at, direction([x, -y]), unit);
                }
            }
        }
    }
}
