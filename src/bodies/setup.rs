//! How bodies are put together, and what they say of their nodes while a system is built: numbers that are no coordinates, and nodes that
//! bodies couple.

use std::ops::Range;

use super::assembly::Links;
use super::body::{BodyPart, each};
use super::connectivity::Node;
use super::frame::RigidBodyFrame;
use super::nodes::NodeOwner;
use super::stages::RotatingNodes;
use super::{Bodies, LineChain, LumpedMass, Patch, ReducedBody, RigidRod, RodChain, Winch};
use crate::math::space::Vector;

/// A number of a node: node, part and axis.
pub type NodeNumber = (usize, usize, usize);

impl<const D: usize> Bodies<D> {
    /// Bodies whose nodes these are, with the nodes of each; what they consist of is added afterwards.
    pub fn new(reference: Vec<Node<D>>, ranges: Vec<Range<usize>>) -> Self {
        Self {
            reference,
            ranges,
            ..Self::default()
        }
    }

    /// Adds the line of a flexible body.
    pub fn add_line(&mut self, line: LineChain<D>) {
        self.lines.push(line);
    }

    /// Adds the sections of a rod or beam along a line.
    pub fn add_sections(&mut self, sections: RodChain) {
        self.sections.push(sections);
    }

    /// Adds a mass in a point.
    pub fn add_mass(&mut self, mass: LumpedMass) {
        self.masses.push(mass);
    }

    /// Adds a straight rigid body whose sections are read.
    pub fn add_rod(&mut self, rod: RigidRod) {
        self.rods.push(rod);
    }

    /// Adds a rigid body of space.
    pub fn add_rigid(&mut self, frame: RigidBodyFrame) {
        let index = self.rigid.len();
        self.rigid.push(RigidBodyFrame { index, ..frame });
    }

    /// Adds the body of a reduced finite element model.
    pub fn add_reduced(&mut self, body: ReducedBody) {
        self.reduced.push(body);
    }

    /// Adds a plate or shell.
    pub fn add_patch(&mut self, patch: Patch) {
        self.patches.push(patch);
    }

    /// Puts a line on a winch at its last end or its first one. The driven coordinate is the length that has been paid out, m.
    pub fn pay_out(
        &mut self,
        line: usize,
        (at_last, coordinate): (bool, usize),
        gravity: Vector<D>,
    ) {
        let winch = Winch::new(&self.lines[line], (at_last, coordinate), gravity);
        self.lines[line].set_winch(winch);
        self.pays_out = true;
    }

    /// Tells lines which of their ends are free, from the nodes that are used, `[nodes]`.
    pub fn set_free_ends(&mut self, used: &[bool]) {
        for line in &mut self.lines {
            let first = line.first_node();
            let last = first + line.node_count() - 1;
            line.set_free_ends([!used[first], !used[last]], &self.reference);
        }
    }

    /// Number of sections at nodes of lines.
    pub fn section_count(&self) -> usize {
        self.sections.iter().map(|chain| chain.count() + 1).sum()
    }

    /// Finds the owners of nodes. To be called when all bodies are there.
    pub fn complete(&mut self) {
        let first = self.rigid.len();
        for (index, body) in self.reduced.iter_mut().enumerate() {
            body.index = index;
            body.frame.index = first + index;
        }
        self.find_owners();
        let mut count = 0;
        each!(self, |body| count += BodyPart::<D>::frame_count(body));
        self.frame_count = count;
    }

    /// Puts the reference where nothing has rotated and nothing is twisted: into nodes of frames and inside elements.
    pub fn unplace(&mut self) {
        let mut nodes = std::mem::take(&mut self.reference);
        each!(self, |body| BodyPart::unplace(body, &mut nodes));
        self.reference = nodes;
    }

    /// Numbers of nodes that are no coordinates, and their values.
    pub fn fixed_numbers(&self) -> Vec<(NodeNumber, f64)> {
        let (mut fixed, mut unplaced) = (Vec::new(), self.reference.clone());
        each!(self, |body| BodyPart::unplace(body, &mut unplaced));
        each!(self, |body| BodyPart::add_fixed_numbers(
            body, &unplaced, &mut fixed
        ));
        fixed
    }

    /// Lets nodes of lines rotate between the stages of a step with the mesh nodes of a surface, whose first nodes these are: their
    /// positions and slopes are those of the surface.
    pub fn rotate_with_surface(&mut self, nodes: impl Iterator<Item = (usize, usize)>) {
        self.stiffeners.extend(nodes);
    }

    /// How nodes rotate between the stages of a step.
    pub fn rotating_nodes(&self) -> RotatingNodes {
        let none = vec![false; self.reference.len()];
        let mut rotating = RotatingNodes {
            elastic: none.clone(),
            modal: none.clone(),
            still: none,
            sections: Vec::new(),
            surfaces: Vec::new(),
            stiffeners: self.stiffeners.clone(),
        };
        each!(self, |body| BodyPart::<D>::mark_rotating(
            body,
            &mut rotating
        ));
        for (line, _) in &self.stiffeners {
            rotating.elastic[*line] = false;
            rotating.sections.retain(|(node, _)| node != line);
        }
        rotating
    }

    /// Pairs of nodes that masses and internal forces of bodies couple.
    pub fn links(&self) -> Links {
        let mut links = Links::default();
        each!(self, |body| BodyPart::<D>::add_links(body, &mut links));
        links
    }

    /// Nodes whose coordinates a force on a node acts on, `[nodes]`; none if these are the nodes themselves. A force on an axis of a rigid body
    /// acts on its first node, one on an axis of a section frame on the node of the line as well, one on an interface of a reduced body on
    /// the body's first node and on those with amplitudes.
    pub fn acted_nodes(&self) -> Option<Vec<Vec<usize>>> {
        if self.has_no_frames() {
            return None;
        }
        let acted = |node: usize| match self.owner(node) {
            NodeOwner::Rigid(index, _) => vec![self.rigid[index].node],
            NodeOwner::Section(chain, k, _) => {
                let frame = self.sections[chain].frame(k);
                vec![frame.line, frame.node]
            }
            NodeOwner::Reduced(index, ..) => self.reduced[index].acted().collect(),
            NodeOwner::Point(index, point, _) => self.patches[index].acted(point).collect(),
            _ => vec![node],
        };
        Some((0..self.reference.len()).map(acted).collect())
    }
}
