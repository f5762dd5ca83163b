//! Joints, springs, driven motions, and ports that motions come into.

use super::picture::{MarkerInImage, Picture};
use crate::page::canvas::{Point, direction, moved};
use crate::page::symbols;
use crate::scene::{
    Ends, First, JointCoordinate, JointPrimitive, LoadKind, MotionKind, Place as On, PortKind,
    ResolvedGear, ResolvedJoint, Symbol,
};

/// The way out of a body at a marker: at the first half of a cable backwards.
fn outward(place: &MarkerInImage<'_>) -> [f64; 2] {
    match place.on {
        On::Along(_, s) if s < 0.5 => place.direction.map(|part| -part),
        On::Along(..) | On::Point(..) => place.direction,
    }
}

impl Picture<'_> {
    pub(super) fn joints(&mut self) {
        for joint in &self.resolved.joints {
            self.joint(joint);
        }
    }

    fn joint(&mut self, joint: &ResolvedJoint<'_>) {
        let (ends, place) = (&joint.ends, self.place(joint.ends.second));
        let (second, unit) = (place.point, self.unit);
        match joint.symbol() {
            Symbol::Pin => self.pin(ends),
            Symbol::Spiral => {
                symbols::spiral(&mut self.canvas, second, unit);
                self.pin(ends);
            }
            Symbol::Weld if ends.is_grounded() => {
                let [first, _] = self.ends(ends);
                symbols::weld(&mut self.canvas, first, outward(&place), unit);
            }
            Symbol::Weld => symbols::block(&mut self.canvas, second, place.direction, unit),
            Symbol::Slider => {
                let along = self.along(joint);
                symbols::slider(&mut self.canvas, second, along, ends.is_grounded(), unit);
            }
            Symbol::Prismatic => {
                let along = self.along(joint);
                symbols::prismatic(&mut self.canvas, second, along, ends.is_grounded(), unit);
            }
            Symbol::Orientation => {
                symbols::orientation(&mut self.canvas, second, place.direction, unit);
            }
            Symbol::Link => {
                let [first, second] = self.ends(ends);
                symbols::link(&mut self.canvas, first, second, unit);
                self.foot(ends, first);
                symbols::pin(&mut self.canvas, second, unit);
            }
            Symbol::Ring => symbols::ring(&mut self.canvas, second, unit),
        }
    }

    /// Direction of the line that a joint holds its second marker on.
    fn along(&self, joint: &ResolvedJoint<'_>) -> [f64; 2] {
        if self.scene.dimension == 3 {
            let given = joint.primitives.iter().find_map(|hold| match hold {
                JointPrimitive::Inline(direction) | JointPrimitive::Inplane(direction) => {
                    Some(*direction)
                }
                _ => None,
            });
            return self.way(given.unwrap_or_default());
        }
        let given = joint.primitives.iter().find_map(|hold| match hold {
            JointPrimitive::Inline(direction) => Some(*direction),
            _ => None,
        });
        let [a, b] = self.way(given.unwrap_or_default());
        let [x, y] = match joint.ends.first {
            First::Marker(first) => self.place(first).direction,
            First::Ground(_) | First::Cable(_) => [1.0, 0.0],
        };
        [a * x - b * y, a * y + b * x]
    }

    /// A pin between two bodies, or between the ground and one.
    fn pin(&mut self, ends: &Ends<'_>) {
        let [first, second] = self.ends(ends);
        let at = if ends.is_grounded() { first } else { second };
        self.foot(ends, at);
    }

    /// A pin, on the ground if one end is.
    fn foot(&mut self, ends: &Ends<'_>, at: Point) {
        if ends.is_grounded() {
            symbols::revolute(&mut self.canvas, at, self.unit)
        } else {
            symbols::pin(&mut self.canvas, at, self.unit)
        }
    }

    pub(super) fn springs(&mut self) {
        for load in &self.resolved.loads {
            match &load.kind {
                LoadKind::JointSpring { on, .. } => self.joint_spring(on),
                LoadKind::JointLimit { on, limits, .. } => self.stop(on, limits),
                kind => kind.between().iter().for_each(|ends| self.spring(ends)),
            }
        }
    }

    fn spring(&mut self, ends: &Ends<'_>) {
        let [from, to] = self.ends(ends);
        symbols::spring(&mut self.canvas, from, to, self.unit);
        if ends.is_grounded() {
            symbols::revolute(&mut self.canvas, from, self.unit);
        }
    }

    fn joint_spring(&mut self, on: &JointCoordinate<'_>) {
        let [from, to] = self.ends(&on.ends());
        match on {
            JointCoordinate::Angle(_) => symbols::spiral(&mut self.canvas, to, self.unit),
            JointCoordinate::Displacement(_) => {
                symbols::spring(&mut self.canvas, from, to, self.unit);
            }
        }
    }

    /// Bars across the way of what stops limit, on the sides where they are.
    fn stop(&mut self, on: &JointCoordinate<'_>, limits: &[Option<f64>; 2]) {
        let at = self.at(on.ends().second.position);
        let along = match on {
            JointCoordinate::Angle(_) => [1.0, 0.0],
            JointCoordinate::Displacement(slider) => self.way(slider.along),
        };
        for (side, limit) in [-1.0, 1.0].into_iter().zip(limits) {
            if limit.is_some() {
                let way = along.map(|part| side * part);
                symbols::stop(&mut self.canvas, at, way, self.unit);
            }
        }
    }

    pub(super) fn gears(&mut self) {
        for gear in &self.resolved.gears {
            let both = gear
                .coordinates
                .map(|of| self.at(of.ends().second.position));
            let radii = self.wheels(gear, both);
            symbols::gear(&mut self.canvas, both, radii, self.unit);
        }
    }

    /// Radii of the wheels of a gear, pixels: in the ratio of two angles, in mesh where these are opposite; of a wheel on a rack as it is;
    /// 0 of a displacement.
    fn wheels(&self, gear: &ResolvedGear<'_>, [from, to]: [Point; 2]) -> [f64; 2] {
        let size = gear.ratio.abs();
        match gear.coordinates.map(|of| of.is_angle()) {
            [true, true] => {
                let reach = (to[0] - from[0]).hypot(to[1] - from[1]);
                let mesh = if gear.ratio < 0.0 { 1.0 } else { 0.6 };
                let second = mesh * reach.max(2.0 * self.unit) / (1.0 + size);
                [second * size, second]
            }
            [true, false] => [self.pixels(size), 0.0],
            [false, true] => [0.0, self.pixels(1.0 / size)],
            [false, false] => [0.0; 2],
        }
    }

    pub(super) fn ports(&mut self) {
        for port in &self.resolved.ports {
            let (mut at, unit) = (self.at(port.marker.position), self.unit);
            let turns = match &port.kind {
                PortKind::Force { .. } => continue,
                PortKind::Motion { angle, .. } => angle.is_some(),
                PortKind::Coupling { angle, .. } => {
                    // Its other end is where the marker is; it is drawn aside, where bodies are rare.
                    let aside = moved(at, direction([1.0, 1.0]), 4.0 * unit);
                    symbols::spring(&mut self.canvas, at, aside, unit);
                    at = aside;
                    angle.is_some()
                }
            };
            self.ways(at);
            if turns {
                symbols::turn(&mut self.canvas, at, unit, symbols::MOTION);
            }
        }
    }

    /// Ways along all axes.
    fn ways(&mut self, at: Point) {
        for axis in 0..self.scene.dimension {
            let along = self.way(std::array::from_fn(|k| f64::from(u8::from(k == axis))));
            symbols::way(&mut self.canvas, at, along, self.unit);
        }
    }

    pub(super) fn motions(&mut self) {
        for motion in &self.resolved.motions {
            let at = self.at(motion.kind.marker().position);
            let unit = self.unit;
            match &motion.kind {
                MotionKind::Angle(..) | MotionKind::Orientation(..) | MotionKind::Winch(..) => {
                    symbols::turn(&mut self.canvas, at, unit, symbols::MOTION);
                }
                MotionKind::Position(..) => self.ways(at),
                MotionKind::Displacement(slider, _) => {
                    let along = self.way(slider.along);
                    symbols::way(&mut self.canvas, at, along, unit);
                }
            }
        }
    }
}
