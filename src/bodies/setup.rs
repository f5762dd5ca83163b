//! What bodies say of their nodes while a system is built: numbers that are no coordinates, and nodes that bodies couple.

use super::Bodies;
use super::assembly::Links;
use super::connectivity::Node;
use super::frame::{RotationMaps, SectionFrame};
use super::rod_chain::{RodChain, untwisted};

/// A number of a node: node, part and axis.
pub type NodeNumber = (usize, usize, usize);

impl<const D: usize> Bodies<D> {
    /// Finds the frames of sections, and which nodes have frames. To be called when all bodies are there.
    pub fn complete(&mut self) {
        let chains = || self.rod_chains.iter();
        let carried = chains().filter(|_| D > 2);
        let carried =
            carried.flat_map(|chain| chain.frames().map(|frame| (chain.has_shear(), frame)));
        let carried = carried.map(|(has_shear, (node, line))| SectionFrame {
            node,
            line,
            has_shear,
            places: [None; 3],
        });
        let inner = chains().flat_map(RodChain::inner);
        let planar = chains().filter(|_| D == 2).flat_map(RodChain::axes_nodes);
        let nodes = (self.reference.len(), inner, planar);
        self.frames = RotationMaps::new(self.frames.list().to_vec(), carried.collect(), nodes);
    }

    /// Puts the reference where nothing has rotated and nothing is twisted: into nodes of frames and inside elements.
    pub fn unplace(&mut self) {
        unplace_sections(&self.rod_chains, &mut self.reference);
        for frame in self.frames.list() {
            let at = unplaced(&self.reference[frame.node]);
            self.reference[frame.node..][..2].fill(at);
        }
    }

    /// Numbers of nodes that are no coordinates, and their values. The second node of a rigid body of space has no coordinates, and the
    /// first has no rotation about an axis without inertia. Of a section frame only rotations are coordinates: one about the tangent of a
    /// rod, three of a beam. Of an inner node only the internal twist and shear rotations are. In the plane the coordinates are the
    /// direction of a section and the angle of the section inside.
    pub fn fixed_numbers(&self) -> Vec<(NodeNumber, f64)> {
        let mut fixed = Vec::new();
        for frame in self.frames.list() {
            let second = unplaced(&self.reference[frame.node]);
            for (part, vector) in second.iter().enumerate() {
                let numbers = vector.iter().enumerate();
                fixed.extend(numbers.map(|(axis, value)| ((frame.node + 1, part, axis), *value)));
            }
            let without = (0..D).filter(|axis| frame.moments[*axis] <= 0.0);
            fixed.extend(without.map(|axis| ((frame.node, 1, axis), 0.0)));
        }
        if self.rod_chains.is_empty() {
            return fixed;
        }
        let mut nodes = self.reference.clone();
        unplace_sections(&self.rod_chains, &mut nodes);
        for chain in &self.rod_chains {
            let turns = if D == 2 { D } else { chain.turns() };
            let turns: Vec<_> = (0..turns).map(|axis| (1, axis)).collect();
            let inside: Vec<_> = chain.inside().map(|(_, place)| place).collect();
            let frames = chain.frames().map(|(node, _)| (node, &turns[..]));
            let second = (chain.axes_nodes()).filter(|_| D > 2);
            let held = frames.chain(second.map(|node| (node, &[][..])));
            for (node, free) in held.chain(chain.inner().map(|node| (node, &inside[..]))) {
                let numbers = (0..2).flat_map(|part| (0..D).map(move |axis| (part, axis)));
                let numbers = numbers.filter(|number| !free.contains(number));
                fixed.extend(
                    numbers.map(|(part, axis)| ((node, part, axis), nodes[node][part][axis])),
                );
            }
        }
        fixed
    }

    /// Pairs of nodes that masses and internal forces of bodies couple. Planar sections have their inertia at nodes.
    pub fn links(&self) -> Links {
        let mut links = Links::default();
        for chain in &self.chains {
            let elements = 0..chain.elements().len();
            (links.mass).extend(elements.map(|j| <(usize, usize)>::from(chain.nodes(j))));
        }
        for lump in &self.lumped_masses {
            let [a, b] = lump.marker.nodes;
            links.mass.push((a, b));
        }
        for frame in self.frames.list() {
            links.mass.push((frame.node, frame.node));
        }
        for chain in &self.rod_chains {
            for j in 0..chain.count() {
                let nodes = chain.nodes(j);
                let [_, a, _, b, inner] = nodes;
                if D > 2 {
                    links.mass.extend([(a, inner), (a, b), (b, inner)]);
                }
                for (i, row) in nodes.iter().enumerate() {
                    (links.stiffness).extend(nodes[..i].iter().map(|column| (*row, *column)));
                }
            }
        }
        links
    }

    /// Nodes whose coordinates a force on a node acts on, `[nodes]`; none if these are the nodes themselves. A force on an axis of a rigid
    /// body acts on its first node, one on an axis of a section frame on the node of the line as well.
    pub fn owners(&self) -> Option<Vec<[usize; 2]>> {
        if self.has_no_frames() {
            return None;
        }
        let mut owners: Vec<[usize; 2]> = (0..self.reference.len()).map(|node| [node; 2]).collect();
        for frame in self.frames.list() {
            owners[frame.node + 1] = [frame.node; 2];
        }
        for chain in &self.rod_chains {
            for (node, line) in chain.frames() {
                owners[node..][..2].fill([line, node]);
            }
        }
        Some(owners)
    }
}

/// Puts the nodes of section frames and those inside elements where nothing has rotated and nothing is twisted.
fn unplace_sections<const D: usize>(chains: &[RodChain], nodes: &mut [Node<D>]) {
    for chain in chains.iter().filter(|_| D > 2) {
        for (node, line) in chain.frames() {
            let at = unplaced(&nodes[line]);
            nodes[node..][..2].fill(at);
        }
        for (j, node) in chain.inner().enumerate() {
            let [line, ..] = chain.nodes(j);
            nodes[node] = [nodes[line][0], untwisted::<D>()[1]];
        }
    }
}

/// Coordinates of both nodes of a rigid body of space where it has not rotated.
fn unplaced<const D: usize>([center, _]: &Node<D>) -> Node<D> {
    [*center, [0.0; D]]
}
