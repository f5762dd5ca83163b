//! What the nodes of bodies stand for, and what joints, placement and outputs ask of them.

use nalgebra::Vector3;

use super::body::{BodyPart, NodalMotion, each};
use super::connectivity::{Node, add_node, no_node};
use super::frame::{along, axes_at, completed, rotation_axes};
use super::marker::Marker;
use super::reduced::Site;
use super::{Bodies, Elimination, Patch, RodChain};
use crate::math::jet::Number;
use crate::math::rotation::{Quaternion, normalized, quaternion};
use crate::math::space::{Vector, components, is_nothing, vector};

/// Meaning of the two vectors of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// A position and a direction.
    Point,
    /// Two axes.
    Axes,
    /// Neither: numbers inside an element.
    Inner,
    /// Neither: amplitudes of modes, or what follows from them.
    Modal,
}

/// Owner of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum NodeOwner {
    /// A position and a direction that are coordinates themselves.
    #[default]
    Own,
    /// Numbers inside an element.
    Inner,
    /// Amplitudes of the modes of a reduced body, or what follows from them.
    Modal,
    /// The direction of a section in the plane.
    Direction,
    /// A rigid body of space, by index, and whether this is its second node.
    Rigid(usize, bool),
    /// A section frame, by the index of the sections of its body and its own there, and whether this is its second node.
    Section(usize, usize, bool),
    /// A frame of a reduced body, by index, with its place, and whether this is its second node.
    Reduced(usize, Site, bool),
    /// Second node of a mesh node of a plate or shell.
    Surface,
    /// A point of a plate or shell, by the index of its body and its own there, and whether this is its second node.
    Point(usize, usize, bool),
}

impl<const D: usize> Bodies<D> {
    /// Owner of a node.
    #[inline(always)]
    pub(super) fn owner(&self, node: usize) -> NodeOwner {
        self.owners.get(node).copied().unwrap_or_default()
    }

    /// Finds the owners of all nodes.
    pub(super) fn find_owners(&mut self) {
        let mut owners = vec![NodeOwner::Own; self.reference.len()];
        for (index, chain) in self.sections.iter().enumerate() {
            chain
                .inner()
                .for_each(|node| owners[node] = NodeOwner::Inner);
            for (k, (node, _)) in chain.frames().enumerate() {
                if D == 2 {
                    owners[node] = NodeOwner::Direction;
                } else {
                    owners[node] = NodeOwner::Section(index, k, false);
                    owners[node + 1] = NodeOwner::Section(index, k, true);
                }
            }
        }
        for (index, frame) in self.rigid.iter().enumerate() {
            owners[frame.node] = NodeOwner::Rigid(index, false);
            owners[frame.node + 1] = NodeOwner::Rigid(index, true);
        }
        for (index, body) in self.reduced.iter().enumerate() {
            for (node, site) in body.sites() {
                owners[node] = NodeOwner::Reduced(index, site, false);
                owners[node + 1] = NodeOwner::Reduced(index, site, true);
            }
            owners[body.inner()..body.all().end].fill(NodeOwner::Modal);
        }
        for (index, patch) in self.patches.iter().enumerate() {
            patch
                .mesh()
                .skip(1)
                .step_by(2)
                .for_each(|node| owners[node] = NodeOwner::Surface);
            for (k, node) in patch.followers().enumerate() {
                owners[node] = NodeOwner::Point(index, k / 2, k % 2 == 1);
            }
        }
        self.owners = owners;
    }

    /// Returns the meaning of the two vectors of a node.
    pub fn kind(&self, node: usize) -> NodeKind {
        match self.owner(node) {
            NodeOwner::Own
            | NodeOwner::Rigid(_, false)
            | NodeOwner::Section(.., false)
            | NodeOwner::Reduced(.., false)
            | NodeOwner::Point(.., false) => NodeKind::Point,
            NodeOwner::Direction
            | NodeOwner::Surface
            | NodeOwner::Point(.., true)
            | NodeOwner::Rigid(_, true)
            | NodeOwner::Section(.., true)
            | NodeOwner::Reduced(.., true) => NodeKind::Axes,
            NodeOwner::Inner => NodeKind::Inner,
            NodeOwner::Modal => NodeKind::Modal,
        }
    }

    /// Whether a node belongs to a frame or is inside an element: rows between its numbers are none that joints see.
    pub fn holds(&self, node: usize) -> bool {
        !matches!(
            self.owner(node),
            NodeOwner::Own | NodeOwner::Direction | NodeOwner::Surface
        )
    }

    /// Whether a node is the first of a frame, which its axes begin in.
    pub fn has_axes(&self, node: usize) -> bool {
        self.kind(node) == NodeKind::Point && self.holds(node)
    }

    /// The plate or shell that a marker is on, and the index of its point there; none of a marker elsewhere.
    pub fn patch_point(&self, marker: &Marker) -> Option<(&Patch, usize)> {
        match self.owner(marker.nodes[0]) {
            NodeOwner::Point(index, point, _) => Some((&self.patches[index], point)),
            _ => None,
        }
    }

    /// The place of the frame that a node belongs to, in the order of the state's.
    pub fn frame_index(&self, node: usize) -> Option<usize> {
        match self.owner(node) {
            NodeOwner::Rigid(index, _) => Some(index),
            NodeOwner::Reduced(index, ..) => Some(self.rigid.len() + index),
            NodeOwner::Section(chain, k, _) => {
                Some(self.whole_frames() + self.sections[chain].first_section() + k)
            }
            _ => None,
        }
    }

    /// The rigid body of space, among all of them, that a node is the first of.
    pub fn rigid_at(&self, node: usize) -> Option<usize> {
        match self.owner(node) {
            NodeOwner::Rigid(index, false) => Some(index),
            _ => None,
        }
    }

    /// Forces over the nodes on a node, with those on the frame of the section there.
    pub fn with_section<N: Number>(
        &self,
        node: usize,
        x: &[Node<D, N>],
        f: &[Node<D, N>],
    ) -> Node<D, N> {
        let mut chains = self.sections.iter();
        let frame = chains.find_map(|chain| chain.frame_at(node));
        let Some(frame) = frame else {
            return f[node];
        };
        let mut sum = f[node];
        let on_line = frame.on_line(x, f);
        let parts = sum.as_flattened_mut().iter_mut();
        parts
            .zip(on_line.as_flattened())
            .for_each(|(sum, on)| *sum += *on);
        sum
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
        if self.has_no_frames() || !marker.is_framed() {
            let [a, b] = marker.forces(*position, *direction);
            term(a.0, &a.1);
            if !marker.is_nodal() {
                term(b.0, &b.1);
            }
            return;
        }
        let node = marker.nodes[0];
        let axes = axes_at(node, x);
        let [arm, own] = marker.components();
        let mut moment = arm.cross(&along(&axes, position));
        if !is_nothing(direction) {
            moment += own.cross(&along(&axes, direction));
        }
        let force = (*position).into();
        match self.owner(node) {
            NodeOwner::Section(chain, k, _) => {
                let frame = self.sections[chain].frame(k);
                frame.pull_marker((&force, &moment), x, term);
            }
            NodeOwner::Reduced(index, site, _) => {
                self.reduced[index].pull_marker(site, (&force, &moment), x, term);
            }
            NodeOwner::Point(index, point, _) => {
                self.patches[index].pull_marker(point, (&force, &moment), x, term);
            }
            _ => term(node, &[force, vector::<D, N>(moment.into()).into()]),
        }
    }

    /// Takes forces on nodes back to what is integrated, without what rates ask for.
    pub fn pull_back<N: Number>(&self, drives: &[[N; 3]], x: &[Node<D, N>], f: &mut [Node<D, N>]) {
        self.pull_back_scaled(drives, f);
        each!(self, |body| BodyPart::pull_back(body, (x, None), f));
    }

    /// For every rigid body of space its first node, its frame, and the quaternion at coordinates on the same side of it.
    pub fn quaternions<'a>(
        &'a self,
        frames: &'a mut [Quaternion],
        q: &'a [f64],
    ) -> impl Iterator<Item = (usize, &'a mut Quaternion, Quaternion)> {
        (self.frames().zip(frames)).map(|(frame, from)| {
            let now = normalized(frame.increment(q).quaternion(from));
            (frame.node, from, now)
        })
    }

    /// Sets the frames of a state to those at nodal coordinates `x`. Frames that the ground holds stand as in `described`, and so become in
    /// `x`.
    pub fn start_frames(
        &self,
        described: &[Node<D>],
        x: &mut [Node<D>],
        frames: &mut [Quaternion],
    ) {
        for frame in self.section_frames().filter(|frame| frame.is_held()) {
            frame.set_axes(&frame.axes(described), x);
        }
        let nodes = self.frames().map(|frame| frame.node);
        let nodes = nodes.chain(self.section_frames().map(|frame| frame.node));
        for (node, at) in nodes.zip(frames) {
            *at = normalized(quaternion(&completed::<D, _>(axes_at(node, x))));
        }
    }

    /// Takes over all axes of `described` nodes.
    pub fn take_axes(&self, described: &[Node<D>], x: &mut [Node<D>]) {
        for frame in &self.rigid {
            frame.set_axes(&frame.axes(described), x);
        }
        for body in &self.reduced {
            x[body.all()].copy_from_slice(&described[body.all()]);
        }
        for patch in &self.patches {
            x[patch.followers()].copy_from_slice(&described[patch.followers()]);
        }
        for frame in self.section_frames() {
            x[frame.node..][..2].copy_from_slice(&described[frame.node..][..2]);
        }
    }

    /// Sets what nodes of rigid bodies hold besides the centre of mass to zero in their second node, which holds axes alone.
    pub fn clear_axes(&self, x: &mut [Node<D>]) {
        for frame in &self.rigid {
            x[frame.node + 1] = no_node();
        }
    }

    /// For every node how far a rigid body of space reaches from it by its radius of gyration, `[nodes]`, m.
    pub fn gyrations(&self) -> Vec<f64> {
        let mut arms = vec![0.0; self.reference.len()];
        for frame in self.frames() {
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
        let rigid = self.rigid.iter_mut();
        for frame in rigid.chain(self.reduced.iter_mut().map(|body| &mut body.frame)) {
            for (number, axis) in rotation_axes::<D>() {
                if frame.moments[axis] <= 0.0 {
                    continue;
                }
                let unit = turned(number, frame.moments[axis]);
                let moved = elimination.reduce_node(frame.node, &unit, &mut y);
                frame.places[axis] = moved.first().copied();
            }
        }
        for body in &mut self.reduced {
            body.find_amplitudes(elimination, &mut y);
        }
        let assembly = &elimination.assembly;
        let sections = self.sections.iter_mut();
        for frame in sections.flat_map(RodChain::section_frames_mut) {
            for axis in 0..frame.rotations() {
                assembly.restrict_node(frame.node, &turned(axis, 1.0), &mut y);
                let mut range = assembly.range_of(frame.node);
                let place = range.clone().find(|at| y[*at] != 0.0);
                frame.places[axis] = place.map(|at| (at, y[at]));
                range.by_ref().for_each(|at| y[at] = 0.0);
            }
        }
    }

    /// Largest angular velocity, rad/s, of thin rods, whose spin about themselves nothing tells, of reduced bodies and of sections.
    pub fn largest_spin(&self, motion: NodalMotion<'_, D>) -> f64 {
        let thin = self.rigid.iter().filter(|frame| frame.is_thin());
        let reduced = self.reduced.iter().map(|body| &body.frame);
        let spins = thin
            .chain(reduced)
            .map(|frame| frame.spin(motion.x, motion.v).norm());
        spins.fold(self.largest_section_spin(motion), f64::max)
    }

    /// Largest angular velocity of sections, rad/s.
    pub fn largest_section_spin(&self, motion: NodalMotion<'_, D>) -> f64 {
        let sections = self.section_frames();
        let spins = sections.map(|frame| frame.velocity(motion.x, motion.v).norm());
        spins.fold(0.0, f64::max)
    }

    /// Adds minus the product of the rate of inertia over axes that stand still with a displacement in `q` to forces on it.
    pub fn subtract_inertia_rate(&self, motion: NodalMotion<'_, D>, unit: &[f64], y: &mut [f64]) {
        for frame in &self.rigid {
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
        if let NodeOwner::Rigid(index, _) = self.owner(node) {
            let frame = &self.rigid[index];
            let spin = frame.spin(motion.x, motion.v);
            let moment = components(&term[1].into());
            let along = Vector3::from(moment).cross(&spin);
            let turned: Vector<D> = vector(along.into());
            add_node(rate, -1.0, &[[0.0; D], turned.into()]);
        }
    }
}
