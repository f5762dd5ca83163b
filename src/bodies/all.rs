//! All bodies of a system, behind operations over all of them. Each kind of part has one list, over which [`each`](super::body::each) runs. A
//! new kind of body is a list here and a line in that macro. One list, `rods`, is no kind: it names bodies whose masses are among `masses`.

use std::ops::Range;

use super::body::{BodyPart, each};
use super::connectivity::Node;
use super::frame::{RigidBodyFrame, SectionFrame};
use super::nodes::{NodeKind, NodeOwner};
use super::winch::PaidOut;
use super::{LineChain, LumpedMass, Marker, Patch, ReducedBody, RigidRod, RodChain, Winch};
use crate::math::jet::Number;
use crate::math::space::Vector;

/// Bodies of a system and the nodes that they stand in.
#[derive(Clone, Debug, Default)]
pub struct Bodies<const D: usize = 2> {
    /// Nodal coordinates where `q` and all prescribed coordinates are zero, `[nodes]`.
    pub reference: Vec<Node<D>>,
    /// Nodes of every body, `[bodies]`.
    pub ranges: Vec<Range<usize>>,
    /// Lines of flexible bodies.
    pub(super) lines: Vec<LineChain<D>>,
    /// Sections of rods and beams along these lines: bending, shear and torsion.
    pub(super) sections: Vec<RodChain>,
    /// Masses in points: particles, planar rigid bodies, and masses on other bodies.
    pub(super) masses: Vec<LumpedMass>,
    /// Straight rigid bodies whose sections are read. Their masses are among `masses`.
    pub(super) rods: Vec<RigidRod>,
    /// Rigid bodies of space.
    pub(super) rigid: Vec<RigidBodyFrame>,
    /// Bodies of reduced finite element models.
    pub(super) reduced: Vec<ReducedBody>,
    /// Plates and shells.
    pub(super) patches: Vec<Patch>,
    /// Nodes of stiffeners, with the first nodes of the mesh nodes of the surface that they are at.
    pub(super) stiffeners: Vec<(usize, usize)>,
    /// Owner of every node, `[nodes]`.
    pub(super) owners: Vec<NodeOwner>,
    /// Number of frames that a state holds: of rigid bodies of space, of reduced bodies, then of sections.
    pub(super) frame_count: usize,
    /// Whether a winch pays out any of the lines.
    pub(super) pays_out: bool,
}

impl<const D: usize> Bodies<D> {
    /// Whether nothing has axes of its own: no rigid body of space, no rod, no reduced body and no plate.
    #[inline(always)]
    pub fn has_no_frames(&self) -> bool {
        self.frame_count == 0 && self.patches.is_empty()
    }

    /// Whether nodal coordinates are those that are integrated: no rotations and no cable of changing length.
    #[inline(always)]
    pub fn has_identity_map(&self) -> bool {
        self.has_no_frames() && !self.pays_out
    }

    /// Size: the length of the longest line, or the largest distance of two nodes if that is more, m. Where rigid bodies rotate in space it
    /// is `reach` instead of the distance.
    pub fn size(&self, reach: f64) -> f64 {
        let cables = self.lines.iter().map(LineChain::length);
        let lengths = cables.chain(self.rods.iter().map(|rod| rod.length));
        let longest = lengths.fold(0.0, f64::max);
        if self.lines.len() + self.rods.len() == 1 && self.ranges.len() == 1 {
            return longest;
        }
        longest.max(if self.has_no_frames() {
            self.extent(&self.reference)
        } else {
            reach
        })
    }

    /// Largest distance of a node from the first one, m; 1 where there is none.
    pub fn extent(&self, x: &[Node<D>]) -> f64 {
        let first = Vector::from(x[0][0]);
        let points = (0..x.len()).filter(|node| self.kind(*node) == NodeKind::Point);
        let far = points.map(|node| (Vector::from(x[node][0]) - first).norm());
        let largest = far.fold(0.0, f64::max);
        if largest > 0.0 { largest } else { 1.0 }
    }

    /// Cost of an evaluation of the bodies: numbers of elements, lumped masses and rigid bodies.
    pub fn cost_units(&self) -> usize {
        let mut cost = 0;
        each!(self, |body| cost += BodyPart::<D>::cost(body));
        cost
    }

    /// Whether anything in a body dissipates.
    pub fn is_damped(&self) -> bool {
        let mut is_damped = false;
        each!(self, |body| is_damped |= BodyPart::<D>::is_damped(body));
        is_damped
    }

    /// Lines of flexible bodies.
    pub fn lines(&self) -> &[LineChain<D>] {
        &self.lines
    }

    /// Lines of flexible bodies, to be changed.
    pub fn lines_mut(&mut self) -> &mut [LineChain<D>] {
        &mut self.lines
    }

    /// Sections along lines, body by body.
    pub fn all_sections(&self) -> &[RodChain] {
        &self.sections
    }

    /// Masses in points.
    pub fn masses(&self) -> &[LumpedMass] {
        &self.masses
    }

    /// Straight rigid bodies whose sections are read.
    pub fn rods(&self) -> &[RigidRod] {
        &self.rods
    }

    /// Number of frames that a state holds: of rigid bodies of space, of reduced bodies, then of sections.
    pub fn frame_count(&self) -> usize {
        self.frame_count
    }

    /// Number of sections whose moments are forces of their own: those of space.
    pub fn moments(&self) -> usize {
        self.frame_count - self.whole_frames()
    }

    /// Whether there are rigid bodies of space or reduced bodies.
    pub fn has_whole_frames(&self) -> bool {
        self.whole_frames() > 0
    }

    /// Number of frames of bodies as a whole: of rigid bodies of space and of reduced bodies.
    pub(super) fn whole_frames(&self) -> usize {
        self.rigid.len() + self.reduced.len()
    }

    /// Frames of bodies as a whole: of rigid bodies of space, then of reduced bodies.
    pub(super) fn frames(&self) -> impl Iterator<Item = &RigidBodyFrame> {
        (self.rigid.iter()).chain(self.reduced.iter().map(|body| &body.frame))
    }

    /// Frames of sections in space, body by body.
    pub(super) fn section_frames(&self) -> impl Iterator<Item = &SectionFrame> {
        self.sections.iter().flat_map(RodChain::section_frames)
    }

    /// Rigid bodies of space.
    pub fn rigid(&self) -> &[RigidBodyFrame] {
        &self.rigid
    }

    /// Plates and shells.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// Bodies of reduced finite element models.
    pub fn reduced(&self) -> &[ReducedBody] {
        &self.reduced
    }

    /// A marker at the mean axes of a reduced body, by its place among all bodies; none of another one.
    pub fn mean_axes(&self, body: usize) -> Option<Marker> {
        let node = self.ranges.get(body)?.start;
        let is_reduced = self.reduced.iter().any(|body| body.frame.node == node);
        is_reduced.then(|| Marker::framed(body, node, [0.0; 3], [1.0, 0.0, 0.0]))
    }

    /// The body with this first node. Bodies stand in the order of their nodes.
    pub fn body_from(&self, first: usize) -> Option<usize> {
        let start = |nodes: &Range<usize>| nodes.start;
        self.ranges.binary_search_by_key(&first, start).ok()
    }

    /// The body that a node belongs to.
    pub fn body_of(&self, node: usize) -> Option<usize> {
        self.ranges.iter().position(|nodes| nodes.contains(&node))
    }

    /// The first rod or beam, among the bodies, with an element that is bent or twisted beyond what its frames hold, and the element.
    pub fn overbent(&self, x: &[Node<D>]) -> Option<(usize, usize)> {
        let mut found = self.sections.iter().filter_map(|chain| {
            let element = chain.overbent(x)?;
            Some((self.body_from(chain.line())?, element))
        });
        found.next()
    }

    /// Whether a winch pays out any of the lines: their meshes scale.
    pub fn pays_out(&self) -> bool {
        self.pays_out
    }

    /// Lines that are paid out, each with its winch.
    #[inline(always)]
    pub fn winches(&self) -> impl Iterator<Item = (&LineChain<D>, &Winch<D>)> {
        let lines = self.lines.iter().filter(|_| self.pays_out);
        lines.filter_map(|line| Some((line, line.winch()?)))
    }

    /// A line that is paid out, by its first node.
    pub fn paid_out<N: Number>(
        &self,
        first: usize,
        drives: &[[N; 3]],
    ) -> Option<PaidOut<'_, D, N>> {
        let mut winches = self.winches();
        let (line, _) = winches.find(|(line, _)| line.first_node() == first)?;
        line.paid_out(drives)
    }

    /// The line of a body.
    pub fn line(&self, body: usize) -> Option<&LineChain<D>> {
        let first = self.ranges[body].start;
        self.lines.iter().find(|chain| chain.first_node() == first)
    }

    /// Chain, element and place inside it of a marker of a flexible body.
    pub fn element(&self, marker: &Marker) -> Option<(&LineChain<D>, usize, f64)> {
        let chain = self.line(marker.body)?;
        let (j, xi) = match self.sections(chain) {
            Some(sections) if marker.element.is_none() => sections.element_at(marker.nodes[0]),
            _ => marker.element?,
        };
        Some((chain, j, xi))
    }

    /// Chain, element and place inside it of a marker of a flexible body. At an inner node it is the element after the node.
    pub fn element_after(&self, marker: &Marker) -> Option<(&LineChain<D>, usize, f64)> {
        let (chain, j, xi) = self.element(marker)?;
        let is_before = xi == 1.0 && j + 1 < chain.elements().len();
        Some(if is_before {
            (chain, j + 1, 0.0)
        } else {
            (chain, j, xi)
        })
    }

    /// Bending and torsion of a rod or beam with this line.
    pub fn sections(&self, chain: &LineChain<D>) -> Option<&RodChain> {
        let first = chain.first_node();
        self.sections.iter().find(|rod| rod.line() == first)
    }

    /// The straight rigid body with this node.
    pub fn rod(&self, node: usize) -> Option<&RigidRod> {
        self.rods.iter().find(|rod| rod.node == node)
    }
}
