//! What joints in space hold of axes: right angles between directions that are fixed in both bodies.

use nalgebra::Vector3;

use super::Builder;
use crate::body::Frame;
use crate::math::space::{Vector, components, normals};
use crate::system::End;
use crate::system::joints::{Across, Direction, Perpendicular, Primitive};

impl<const D: usize> Builder<'_, D> {
    /// A direction at the start, fixed in the body of an end; of a cable its own.
    fn fixed(&self, end: &End<D>, direction: Vector<D>) -> Direction<D> {
        let End::Body(marker) = end else {
            return Direction::Fixed(direction);
        };
        let frame = self.parts.frames.iter();
        let Some(frame) = frame.clone().find(|frame| frame.node == marker.nodes[0]) else {
            return Direction::Of(*marker);
        };
        let axes = Frame::axes(frame, &self.parts.nodes);
        let direction = Vector3::from(components(&direction));
        Direction::Of(marker.directed(axes.map(|axis| axis.dot(&direction))))
    }

    /// A direction of the first body across one of the second.
    pub(super) fn right_angle(&self, ends: [End<D>; 2], of: [Vector<D>; 2]) -> Primitive<D> {
        let [first, second] = of.map(|direction| direction.normalize());
        Primitive::Perpendicular(Perpendicular {
            direction: self.fixed(&ends[0], first),
            across: Across::Direction(self.fixed(&ends[1], second)),
        })
    }

    /// The way between both ends across a direction of the first body.
    pub(super) fn across_way(&self, ends: [End<D>; 2], direction: Vector<D>) -> Primitive<D> {
        let reach = |end: &End<D>| end.marker().map_or(0.0, |marker| marker.arm());
        let size = ends
            .iter()
            .map(reach)
            .fold(self.distance_at_start(&ends), f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        Primitive::Perpendicular(Perpendicular {
            direction: self.fixed(&ends[0], direction),
            across: Across::Way(ends, size),
        })
    }

    /// The second end on a line of the first body.
    pub(super) fn on_line(&self, ends: [End<D>; 2], along: [f64; 3]) -> Vec<Primitive<D>> {
        let along = super::unit(along);
        let normals = normals(&along);
        normals
            .map(|normal| self.across_way(ends, normal))
            .collect()
    }

    /// An axis of the second body along that of the first.
    pub(super) fn along_axis(&self, ends: [End<D>; 2], axis: [f64; 3]) -> Vec<Primitive<D>> {
        let axis = super::unit(axis);
        let normals = normals(&axis);
        normals
            .map(|normal| self.right_angle(ends, [normal, axis]))
            .collect()
    }

    /// How both bodies stand to each other; the direction of a cable across two axes of a rigid body.
    pub(super) fn standing(&self, ends: [End<D>; 2]) -> Vec<Primitive<D>> {
        let nodes = &self.parts.nodes;
        let cable = ends.iter().position(|end| !end.is_rigid());
        let along: Vector<D> = match cable {
            Some(cable) => ends[cable].direction(nodes).normalize(),
            None => ends[1].direction(nodes),
        };
        let across: Vec<Vector<D>> = normals(&along).collect();
        let mut holds: Vec<Primitive<D>> = across
            .iter()
            .map(|normal| match cable {
                Some(0) => self.right_angle(ends, [along, *normal]),
                _ => self.right_angle(ends, [*normal, along]),
            })
            .collect();
        if let (None, [a, b]) = (cable, &across[..]) {
            holds.push(self.right_angle(ends, [*a, *b]));
        }
        holds
    }
}
