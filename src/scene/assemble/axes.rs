//! What joints in space hold of axes: right angles between directions that are fixed in both bodies.

use nalgebra::Vector3;

use super::Builder;
use crate::bodies::{Marker, axes_at};
use crate::math::space::{Vector, components, moment, normal, normals, vector};
use crate::scene::joints::{JointPrimitive, ResolvedJoint};
use crate::scene::resolved::{self, DirectionSource, Pivot, Place};
use crate::system::joints::{Across, Clamp, Homokinetic, Perpendicular, Primitive};
use crate::system::{Attachment, AxisRotation, Direction, reach};

impl<const D: usize> Builder<'_, D> {
    /// A direction at the start, fixed in the body of an end; of a cable its own.
    pub(crate) fn fixed(&self, end: &Attachment<D>, direction: Vector<D>) -> Direction<D> {
        let Attachment::Body(marker) = end else {
            return Direction::Fixed(direction);
        };
        if !marker.is_framed() {
            return Direction::Of(*marker);
        }
        let axes = axes_at(marker.nodes[0], &self.parts.bodies.reference);
        let direction = Vector3::from(components(&direction));
        Direction::Of(marker.directed(axes.map(|axis| axis.dot(&direction))))
    }

    /// A marker in the directions of the axes of its body's frame.
    pub(crate) fn frame_axes(&self, marker: resolved::ResolvedMarker<'_>) -> [Marker; D] {
        std::array::from_fn(|k| self.directed(marker, Vector::<3>::ith(k, 1.0)))
    }

    /// A marker in a direction along the axes of its body's frame; itself where it has a direction alone.
    pub(crate) fn directed(
        &self,
        marker: resolved::ResolvedMarker<'_>,
        direction: Vector<3>,
    ) -> Marker {
        let (built, direction) = (self.marker(marker), direction.into());
        match marker.place {
            Place::Point(rigid, _) if built.is_framed() => {
                built.directed(self.resolved.solid(rigid).directed(direction))
            }
            Place::Interface(reduced, _) => {
                built.directed(reduced.body.contained().directed(direction))
            }
            Place::Patch(..) => built.directed(direction),
            Place::Along(cable, _) if built.is_framed() => {
                let line = self.lines.get(&cable.id.body_index());
                built.directed(line.map_or(direction, |line| line.directed(direction)))
            }
            _ => built,
        }
    }

    /// In space, the rotation that a joint with an axis lets its bodies make.
    pub(crate) fn turn_of(&self, joint: &ResolvedJoint<'_>) -> Option<AxisRotation<D>> {
        self.turn(joint.pivot()?)
    }

    /// Returns the rotation of a joint about its axis. `None` for a marker.
    pub(crate) fn axis_turn(&self, source: &DirectionSource<'_>) -> Option<AxisRotation<D>> {
        match source {
            DirectionSource::Pivot(pivot) => self.turn(*pivot),
            DirectionSource::Marker(_) => None,
        }
    }

    /// The rotation about the axis of a joint, zero at the start.
    fn turn(&self, pivot: Pivot<'_>) -> Option<AxisRotation<D>> {
        let (ends, axis) = (self.ends(pivot.ends), super::unit(pivot.axis?));
        let across = normal(&axis, 0);
        let left = vector(moment(&axis, &across));
        Some(AxisRotation {
            across: [across, left].map(|direction| self.fixed(&ends[0], direction)),
            of: self.fixed(&ends[1], across),
        })
    }

    /// A direction of the first body across one of the second.
    pub(crate) fn right_angle(&self, ends: [Attachment<D>; 2], of: [Vector<D>; 2]) -> Primitive<D> {
        let [first, second] = of.map(|direction| direction.normalize());
        Primitive::Perpendicular(Perpendicular {
            direction: self.fixed(&ends[0], first),
            across: Across::Direction(self.fixed(&ends[1], second)),
        })
    }

    /// Equal rotation about an axis of the first body and one of the second.
    pub(crate) fn equal_rotation(
        &self,
        ends: [Attachment<D>; 2],
        axes: [Vector<D>; 2],
    ) -> Primitive<D> {
        let [first, second] = axes.map(|axis| axis.normalize());
        let n = normal(&first, 0);
        // The smallest rotation that takes the first axis to the second.
        let halved = first + second;
        let carried = n - halved * (n.dot(&second) / first.dot(&halved));
        let across =
            [(first, n), (second, carried)].map(|(axis, n)| [n, vector(moment(&axis, &n))]);
        let [first, second] =
            [0, 1].map(|end| across[end].map(|direction| self.fixed(&ends[end], direction)));
        Primitive::Homokinetic(Homokinetic { first, second })
    }

    /// The way between both ends across a direction of the first body.
    pub(crate) fn across_way(
        &self,
        ends: [Attachment<D>; 2],
        direction: Vector<D>,
    ) -> Primitive<D> {
        Primitive::Perpendicular(Perpendicular {
            direction: self.fixed(&ends[0], direction),
            across: Across::Translation(ends, self.size_of(&ends)),
        })
    }

    /// Returns the reference size of residuals of displacements between two ends, m.
    pub(crate) fn size_of(&self, ends: &[Attachment<D>; 2]) -> f64 {
        let size = reach(ends).max(self.distance_at_start(ends));
        if size > 0.0 { size } else { 1.0 }
    }

    /// The second end on a line of the first body.
    pub(crate) fn on_line(&self, ends: [Attachment<D>; 2], along: [f64; 3]) -> Vec<Primitive<D>> {
        let along = super::unit(along);
        let normals = normals(&along);
        normals
            .map(|normal| self.across_way(ends, normal))
            .collect()
    }

    /// An axis of the second body along that of the first.
    pub(crate) fn along_axis(&self, ends: [Attachment<D>; 2], axis: [f64; 3]) -> Vec<Primitive<D>> {
        let axis = super::unit(axis);
        let normals = normals(&axis);
        normals
            .map(|normal| self.right_angle(ends, [normal, axis]))
            .collect()
    }

    /// A section of a rod or beam that is welded to the ground is held by rows alone, if no other joint does so already.
    pub(crate) fn clamp(&self, joint: &ResolvedJoint<'_>) -> Option<Primitive<D>> {
        let (
            [JointPrimitive::AtPoint, JointPrimitive::Orientation(_)],
            true,
            Place::Along(cable, s),
        ) = (
            &joint.primitives[..],
            D == 3 && joint.ends.is_grounded(),
            joint.ends.second.place,
        )
        else {
            return None;
        };
        if cable.is_modal() {
            return None;
        }
        let marker = self.marker(joint.ends.second);
        let (line, frame) = (self.on_line_of(cable, s), marker.nodes[0]);
        let before = self.parts.joints.iter().filter_map(|joint| joint.clamp());
        let is_held = before.map(|clamp| clamp.frame).any(|held| held == frame);
        let has_shear = cable.body.is_beam();
        let clamp = Clamp {
            line,
            frame,
            has_shear,
        };
        (marker.is_framed() && !is_held).then_some(Primitive::Clamp(clamp))
    }

    /// How both bodies stand to each other; the direction of a cable across two axes of a rigid body.
    pub(crate) fn standing(&self, ends: [Attachment<D>; 2]) -> Vec<Primitive<D>> {
        let nodes = &self.parts.bodies.reference;
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
