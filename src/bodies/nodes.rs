//! What the nodes of bodies stand for, and what joints, placement and outputs ask of them.

use nalgebra::Vector3;

use super::body::NodalMotion;
use super::connectivity::{Node, add_node, no_node};
use super::frame::NodeKind;
use super::marker::Marker;
use super::{Bodies, Elimination};
use crate::math::jet::Number;
use crate::math::rotation::Quaternion;
use crate::math::space::{Vector, components, vector};

impl<const D: usize> Bodies<D> {
    /// Returns the meaning of the two vectors of a node.
    pub fn kind(&self, node: usize) -> NodeKind {
        self.frames.kind(node)
    }

    /// Whether a node belongs to a frame or is inside an element: rows between its numbers are none that joints see.
    pub fn holds(&self, node: usize) -> bool {
        self.frames.holds(node)
    }

    /// Whether a node is the first of a frame, which its axes begin in.
    pub fn has_axes(&self, node: usize) -> bool {
        self.frames.has_axes(node)
    }

    /// The place of the frame that a node belongs to, in the order of the state's.
    pub fn frame_index(&self, node: usize) -> Option<usize> {
        self.frames.index_of(node)
    }

    /// The rigid body of space, among all of them, that a node is the first of.
    pub fn rigid_at(&self, node: usize) -> Option<usize> {
        self.frames.body_of(node)
    }

    /// Pulls forces on position and direction of a marker back to the coordinates of its body: forces and moments by node, passed to `term`.
    #[inline(always)]
    pub fn pull_marker<N: Number>(
        &self,
        marker: &Marker<N>,
        [position, direction]: [&Vector<D, N>; 2],
        x: &[Node<D, N>],
        term: &mut impl FnMut(usize, &Node<D, N>),
    ) {
        if (self.frames).pull_marker(marker, [position, direction], x, term) {
            return;
        }
        let [a, b] = marker.forces(*position, *direction);
        term(a.0, &a.1);
        if !marker.is_nodal() {
            term(b.0, &b.1);
        }
    }

    /// Takes forces on nodes back to what is integrated, without what rates ask for.
    pub fn pull_back<N: Number>(&self, drives: &[[N; 3]], x: &[Node<D, N>], f: &mut [Node<D, N>]) {
        self.shorten(drives, f);
        self.frames.pull_back((x, None), f);
    }

    /// For every rigid body of space its first node, its frame, and the quaternion at coordinates on the same side of it.
    pub fn quaternions<'a>(
        &'a self,
        frames: &'a mut [Quaternion],
        q: &'a [f64],
    ) -> impl Iterator<Item = (usize, &'a mut Quaternion, Quaternion)> {
        self.frames.quaternions(frames, q)
    }

    /// Sets the frames of a state to those at nodal coordinates `x`. Frames that the ground holds stand as in `described`, and so become in
    /// `x`.
    pub fn start_frames(
        &self,
        described: &[Node<D>],
        x: &mut [Node<D>],
        frames: &mut [Quaternion],
    ) {
        self.frames.keep_held(described, x);
        self.frames.frames_at(x, frames);
    }

    /// Takes over all axes of `described` nodes.
    pub fn take_axes(&self, described: &[Node<D>], x: &mut [Node<D>]) {
        for frame in self.frames.list() {
            frame.set_axes(&frame.axes(described), x);
        }
        for frame in self.frames.carried() {
            x[frame.node..][..2].copy_from_slice(&described[frame.node..][..2]);
        }
    }

    /// Sets what nodes of rigid bodies hold besides the centre of mass to zero in their second node, which holds axes alone.
    pub fn clear_axes(&self, x: &mut [Node<D>]) {
        for frame in self.frames.list() {
            x[frame.node + 1] = no_node();
        }
    }

    /// For every node how far a rigid body of space reaches from it by its radius of gyration, `[nodes]`, m.
    pub fn gyrations(&self) -> Vec<f64> {
        let mut arms = vec![0.0; self.reference.len()];
        for frame in self.frames.list() {
            arms[frame.node] = frame.gyration();
        }
        arms
    }

    /// Finds the rotations of rigid bodies and sections among the coordinates.
    pub fn find_rotations(&mut self, elimination: &Elimination<D>) {
        let mut y = vec![0.0; elimination.scratch()];
        let turned = |axis: usize, moment: f64| {
            let mut unit = no_node();
            unit[1][axis] = moment;
            unit
        };
        for frame in self.frames.list_mut() {
            for axis in (0..3).filter(|axis| frame.moments[*axis] > 0.0) {
                let unit = turned(axis, frame.moments[axis]);
                let moved = elimination.reduce_node(frame.node, &unit, &mut y);
                frame.places[axis] = moved.first().copied();
            }
        }
        let assembly = &elimination.assembly;
        for frame in self.frames.carried_mut() {
            for axis in 0..frame.turns() {
                assembly.restrict_node(frame.node, &turned(axis, 1.0), &mut y);
                let mut range = assembly.range_of(frame.node);
                let place = range.clone().find(|at| y[*at] != 0.0);
                frame.places[axis] = place.map(|at| (at, y[at]));
                range.by_ref().for_each(|at| y[at] = 0.0);
            }
        }
    }

    /// Largest angular velocity, rad/s, of thin rods, whose spin about themselves nothing tells, and of sections.
    pub fn largest_spin(&self, motion: NodalMotion<'_, D>) -> f64 {
        let thin = self.frames.list().iter().filter(|frame| frame.is_thin());
        let spins = thin.map(|frame| frame.spin(motion.x, motion.v).norm());
        spins.fold(self.largest_section_spin(motion), f64::max)
    }

    /// Largest angular velocity of sections, rad/s.
    pub fn largest_section_spin(&self, motion: NodalMotion<'_, D>) -> f64 {
        let sections = self.frames.carried().iter();
        let spins = sections.map(|frame| frame.velocity(motion.x, motion.v).norm());
        spins.fold(0.0, f64::max)
    }

    /// Adds minus the product of the rate of inertia over axes that stand still with a displacement in `q` to forces on it.
    pub fn subtract_inertia_rate(&self, motion: NodalMotion<'_, D>, unit: &[f64], y: &mut [f64]) {
        for frame in self.frames.list() {
            let spin = frame.spin(motion.x, motion.v);
            frame.add_moment(&-(frame.inertia_rate(&spin) * frame.read(unit)), y);
        }
    }

    /// Takes the rate of a force on a node, which counts moments along axes that rotate with a rigid body, to one along axes that stand
    /// still.
    pub fn in_still_axes(
        &self,
        node: usize,
        motion: NodalMotion<'_, D>,
        term: &Node<D>,
        rate: &mut Node<D>,
    ) {
        if let Some((frame, _)) = self.frames.of_node::<D>(node) {
            let spin = frame.spin(motion.x, motion.v);
            let moment = components(&term[1].into());
            let along = Vector3::from(moment).cross(&spin);
            let turned: Vector<D> = vector(along.into());
            add_node(rate, -1.0, &[[0.0; D], turned.into()]);
        }
    }
}
