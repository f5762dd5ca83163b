//! Sections of rods and beams as bodies, beside the lines that they stand along.

use nalgebra::DMatrix;

use super::frame_spin::along;
use super::loaded::add_moment;
use super::{RodChain, plane, untwisted};
use crate::bodies::assembly::{Assembly, Links, NodeBlock, no_block};
use crate::bodies::body::{BodyPart, Momentum, NodalMotion};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{Derivative, combined, unplaced};
use crate::bodies::linearized::{ElementTangent, LinearTerms, LinearizationPoint};
use crate::bodies::map::Rotations;
use crate::bodies::probe::Nodes;
use crate::bodies::setup::NodeNumber;
use crate::bodies::stages::RotatingNodes;
use crate::elements::beam::VELOCITIES;
use crate::elements::rod::Tangent;
use crate::math::jet::Number;
use crate::math::rotation::Quaternion;
use crate::math::sparse::Matrix;

impl<const D: usize> BodyPart<D> for RodChain {
    fn is_damped(&self) -> bool {
        RodChain::is_damped(self)
    }

    /// In the plane sections have their inertia at nodes.
    fn add_links(&self, links: &mut Links) {
        for j in 0..self.count() {
            let nodes = self.nodes(j);
            let [_, a, _, b, inner] = nodes;
            if D > 2 {
                links.mass.extend([(a, inner), (a, b), (b, inner)]);
            }
            for (i, row) in nodes.iter().enumerate() {
                (links.stiffness).extend(nodes[..i].iter().map(|column| (*row, *column)));
            }
        }
    }

    /// In the plane directions stand as they are.
    fn unplace(&self, nodes: &mut [Node<D>]) {
        if D == 2 {
            return;
        }
        for (node, line) in self.frames() {
            let at = unplaced(&nodes[line]);
            nodes[node..][..2].fill(at);
        }
        for (j, node) in self.inner().enumerate() {
            let [line, ..] = self.nodes(j);
            nodes[node] = [nodes[line][0], untwisted::<D>()[1]];
        }
    }

    /// Of a section frame only rotations are coordinates: one about the tangent of a rod, three of a beam. Of an inner node only the internal
    /// twist and shear rotations are. In the plane the coordinates are the direction of a section and the angle of the section inside.
    fn add_fixed_numbers(&self, unplaced: &[Node<D>], fixed: &mut Vec<(NodeNumber, f64)>) {
        let turns = if D == 2 { D } else { self.rotations() };
        let turns: Vec<_> = (0..turns).map(|axis| (1, axis)).collect();
        let inside: Vec<_> = self.inside().map(|(_, place)| place).collect();
        let frames = self.frames().map(|(node, _)| (node, &turns[..]));
        let second = (self.axes_nodes()).filter(|_| D > 2);
        let held = frames.chain(second.map(|node| (node, &[][..])));
        for (node, free) in held.chain(self.inner().map(|node| (node, &inside[..]))) {
            let numbers = (0..2).flat_map(|part| (0..D).map(move |axis| (part, axis)));
            let numbers = numbers.filter(|number| !free.contains(number));
            fixed.extend(
                numbers.map(|(part, axis)| ((node, part, axis), unplaced[node][part][axis])),
            );
        }
    }

    /// Lines of beams rotate with their sections; in the plane by directions, as cables do.
    fn mark_rotating(&self, rotating: &mut RotatingNodes) {
        if self.has_shear() {
            let pairs = self.frames().map(|(frame, line)| (line, frame));
            rotating.sections.extend(pairs);
            for (_, line) in self.frames() {
                rotating.elastic[line] &= D == 2;
            }
        }
        let frames = self.frames().map(|(node, _)| node);
        let held = frames.chain(self.axes_nodes()).chain(self.inner());
        held.for_each(|node| rotating.still[node] = true);
    }

    fn frame_count(&self) -> usize {
        self.section_frames.len()
    }

    fn place(&self, from: &[Quaternion], rotations: &mut Rotations, x: &mut [Node<D>]) {
        let from = &from[rotations.rigid.len() + self.first_section..];
        let states = &mut rotations.sections[self.first_section..];
        for ((frame, from), state) in self.section_frames.iter().zip(from).zip(states) {
            frame.place(from, state, x);
        }
    }

    fn place_rates(&self, x: &[Node<D>], rotations: &mut Rotations, v: &mut [Node<D>]) {
        let states = &mut rotations.sections[self.first_section..];
        for (frame, state) in self.section_frames.iter().zip(states) {
            frame.place_rates(x, state, v);
        }
    }

    fn place_changes<N: Number>(&self, x: &[Node<D, N>], dx: &mut [Node<D, N>]) {
        for frame in &self.section_frames {
            frame.place_changes(x, dx);
        }
    }

    fn add_centripetal<N: Number>(&self, motion: NodalMotion<'_, D, N>, a: &mut [Node<D, N>]) {
        for frame in &self.section_frames {
            frame.add_centripetal(motion.pair(), a);
        }
    }

    fn pull_back<N: Number>(
        &self,
        (x, _): (&[Node<D, N>], Option<&[Node<D, N>]>),
        f: &mut [Node<D, N>],
    ) {
        for frame in &self.section_frames {
            frame.pull_back(x, f);
        }
    }

    fn add_torques<N: Number>(&self, torques: &[[N; 3]], f: &mut [Node<D, N>]) {
        let torques = torques.iter().skip(self.first_section);
        for (frame, torque) in self.section_frames.iter().zip(torques) {
            let moment = f[frame.node][1].iter_mut().zip(torque);
            moment.for_each(|(sum, torque)| *sum += *torque);
        }
    }

    fn convert_free(&self, order: Derivative, at: &Rotations, nodal: &[Node<D>], y: &mut [f64]) {
        let states = &at.sections[self.first_section..];
        for (frame, state) in self.section_frames.iter().zip(states) {
            frame.convert(order, state, nodal, y);
        }
    }

    fn rotation_at(&self, at: &Rotations) -> f64 {
        let frames = self.section_frames.iter();
        let states = &at.sections[self.first_section..];
        let sizes = frames.zip(states).map(|(frame, state)| state.size(frame));
        sizes.fold(0.0, f64::max)
    }

    fn renew_free(
        &self,
        (x, at): (&[Node<D>], &Rotations),
        frames: &mut [Quaternion],
        [q, v]: [&mut [f64]; 2],
    ) {
        let from = &mut frames[at.rigid.len() + self.first_section..];
        let states = &at.sections[self.first_section..];
        for ((frame, state), from) in self.section_frames.iter().zip(states).zip(from) {
            frame.renew((x, state), from, [&mut *q, &mut *v]);
        }
    }

    fn for_each_geometric(
        &self,
        f: &[Node<D>],
        x: &[Node<D>],
        add: &mut impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        for frame in &self.section_frames {
            frame.for_each_geometric(f, x, &mut *add);
        }
    }

    fn add_mass(&self, assembly: &Assembly<D>, mass: &mut Matrix<f64>) {
        let turns: Vec<_> = self.parts.clone().map(|k| (k, (1, k))).collect();
        let inside: Vec<_> = self.inside().collect();
        for (j, (_, inertia)) in self.elements.iter().enumerate() {
            let [_, a, _, b, inner] = self.nodes(j);
            let places = [(a, &turns), (inner, &inside), (b, &turns)];
            for r in self.massive() {
                for c in self.massive().take_while(|c| *c <= r) {
                    let (mut block, ((row, at), (column, on))) =
                        (no_block(), (places[r], places[c]));
                    for (i, (p, axis)) in at {
                        for (k, (q, other)) in on {
                            block[*p][*axis][*q][*other] = inertia[r][c][*i][*k];
                        }
                    }
                    assembly.add(row, column, &block, mass);
                }
            }
        }
    }

    fn add_spin_momentum(&self, motion: (&[Node<D>], &[Node<D>]), momentum: &mut [Node<D>]) {
        for j in 0..self.elements.len() {
            let [a, inner, b] = self.momenta(j, motion);
            for (k, moment) in [(j, a), (j + 1, b)].into_iter().filter(|_| D > 2) {
                add_moment(self.frame(k).node, &moment, motion.0, momentum);
            }
            for (k, (part, axis)) in self.inside() {
                momentum[self.inner + j][part][axis] += inner[k];
            }
        }
    }

    #[inline(always)]
    fn add_force(&self, motion: NodalMotion<'_, D>, out: (&mut [Node<D>], &mut [[f64; 3]])) -> f64 {
        RodChain::add_force(self, motion.pair(), out)
    }

    fn add_force_of<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        (force, moments): (&mut [Node<D, N>], &mut [[N; 3]]),
    ) {
        for (j, (section, _)) in self.elements.iter().enumerate() {
            let at = self.at(j, motion.x);
            let rates = section.is_damped().then(|| self.rates(j, motion.pair()));
            let (of_element, _) = section.force(&at, rates.as_ref());
            let [a, first, b, last, inner] = self.nodes(j);
            for (k, vector) in of_element.e.iter().enumerate() {
                let node = &mut force[[a, b][k / 2]][k % 2];
                for (sum, f) in node.iter_mut().zip(vector) {
                    *sum += *f;
                }
            }
            for (k, moment) in of_element.moment.into_iter().enumerate() {
                if D == 2 {
                    let node = [first, last][k];
                    plane::turn(&motion.x[node][1], &moment, &mut force[node][1]);
                    continue;
                }
                for (sum, m) in moments[self.first_section + j + k].iter_mut().zip(moment) {
                    *sum += m;
                }
            }
            for (k, (part, axis)) in self.inside() {
                force[inner][part][axis] += of_element.inner[k];
            }
        }
    }

    #[inline(always)]
    fn add_gyroscopic<N: Number>(&self, motion: NodalMotion<'_, D, N>, f: &mut [Node<D, N>]) {
        let pair = motion.pair();
        self.for_each_momentum(pair, |frame, momentum| {
            frame.add_gyroscopic(momentum, pair, f);
        });
    }

    fn add_frame_spin<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        rotation: [f64; 3],
        f: &mut [Node<D, N>],
    ) {
        // In the plane directions of sections have inertia as other directions have.
        for j in (0..self.count()).filter(|_| D > 2) {
            let force = self.frame_spin_force(j, motion.pair(), rotation);
            self.add_load(j, &force, motion.x, f);
        }
    }

    #[inline(always)]
    fn add_tangent(
        &self,
        motion: NodalMotion<'_, D>,
        assembly: &Assembly<D>,
        matrices: [&mut Matrix<f64>; 2],
    ) {
        RodChain::add_tangent(self, motion.pair(), assembly, matrices);
    }

    fn kinetic_beside<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> N {
        let mut sum = N::of(0.0);
        for j in 0..self.elements.len() {
            let rates = self.rates(j, motion.pair());
            let momenta = self.momenta_of(j, &rates);
            let rates = [rates.spin[0], rates.inner, rates.spin[1]];
            for place in self.massive() {
                let terms = momenta[place].iter().zip(&rates[place]);
                sum = terms.fold(sum, |sum, (p, w)| sum + *p * *w);
            }
        }
        sum * N::of(0.5)
    }

    fn frame_spin_energy<N: Number>(&self, x: &[Node<D, N>], rotation: [f64; 3]) -> N {
        let mut sum = N::of(0.0);
        for j in (0..self.count()).filter(|_| D > 2) {
            let spin = [j, j + 1].map(|k| along(self.frame(k), rotation, x));
            let [first, _, last] = self.momenta_of_spins(j, spin);
            let pairs = [first, last].into_iter().flatten();
            let terms = pairs.zip(spin.into_iter().flatten());
            sum = terms.fold(sum, |sum, (momentum, rate)| sum + momentum * rate);
        }
        sum * N::of(0.5)
    }

    fn strain_energy<N: Number>(&self, _drives: &[[N; 3]], x: &[Node<D, N>]) -> N {
        let elements = self.elements.iter().enumerate();
        let energies = elements.map(|(j, (section, _))| section.energy(&self.at(j, x)));
        energies.fold(N::of(0.0), |sum, energy| sum + energy)
    }

    fn for_each_strain_energy(&self, x: [&[Node<D>]; 2], call: &mut impl FnMut([f64; 2])) {
        for j in 0..self.count() {
            call(x.map(|x| self.element(j).energy(&self.at(j, x))));
        }
    }

    fn dissipation<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> N {
        let mut sum = N::of(0.0);
        for (j, (section, _)) in self.elements.iter().enumerate() {
            if section.is_damped() {
                let rates = self.rates(j, motion.pair());
                sum += section.force(&self.at(j, motion.x), Some(&rates)).1;
            }
        }
        sum
    }

    fn add_momentum<N: Number>(&self, motion: NodalMotion<'_, D, N>, sum: &mut Momentum<D, N>) {
        self.for_each_momentum(motion.pair(), |frame, momentum| {
            sum.angular += combined(&frame.axes(motion.x), &momentum.into());
        });
        if D == 2 {
            sum.angular[2] += self.planar_momentum(motion.pair());
        }
    }

    /// Geometric stiffness of forces on section axes, which rotate, and what a frame of the scene that rotates adds to the inertia of spins.
    fn linearize(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        if D == 2 {
            return;
        }
        let [stiffness, _] = &mut terms.symmetric;
        for frame in &self.section_frames {
            frame.for_each_geometric(at.forces, at.motion.x, |a, b, block| {
                at.assembly.add(a, b, block, stiffness);
            });
        }
        if at.rotation != [0.0; 3] {
            self.linearize_frame_spin(at, terms);
        }
    }

    fn linearize_elements(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        terms.is_damped |= !at.at_rest && RodChain::is_damped(self);
        let first = terms.elements.len();
        self.for_each_tangent(at.motion.pair(), |kind, j, whole| {
            if kind == Tangent::Damping && at.at_rest {
                return;
            }
            let (used, places) = self.velocities(j);
            let matrix = DMatrix::from_fn(used.len(), used.len(), |r, c| whole[used[r]][used[c]]);
            match kind {
                Tangent::Stiffness => terms.elements.push(ElementTangent {
                    places,
                    stiffness: matrix,
                    damping: None,
                }),
                Tangent::Damping => terms.elements[first + j].damping = Some(matrix),
            }
            let sum = &mut terms.symmetric[kind as usize];
            self.for_each_block(j, whole, |row, column, block| {
                at.assembly.add(row, column, block, sum);
            });
        });
    }
}

impl RodChain {
    /// Where the velocities of element `j` stand among those of its matrices, and among the numbers of nodes with whether they are
    /// components of a position.
    fn velocities(&self, j: usize) -> (Vec<usize>, Vec<(NodeNumber, bool)>) {
        let nodes = self.nodes(j).into_iter().enumerate();
        let entries = nodes.flat_map(|(k, node)| {
            let entries = self.entries(k);
            let is_line = k == 0 || k == 2;
            entries.map(move |(at, (part, axis))| (at, ((node, part, axis), is_line && part == 0)))
        });
        let found: Vec<_> = entries.collect();
        debug_assert!(found.len() <= VELOCITIES);
        found.into_iter().unzip()
    }

    /// What a frame of the scene that rotates adds to the inertia of spins.
    fn linearize_frame_spin<const D: usize>(
        &self,
        at: &mut LinearizationPoint<'_, D>,
        terms: &mut LinearTerms,
    ) {
        let mut none = |_: usize, _: usize, _: f64| {};
        let rotation = at.rotation;
        for j in 0..self.count() {
            let force = |x: &Nodes<D>, v: &Nodes<D>, f: &mut Nodes<D>| {
                let force = self.frame_spin_force(j, (x, v), rotation);
                self.add_load(j, &force, x, f);
            };
            let nodes = self.all_nodes(j);
            let blocks = at.probe.differentiate(&nodes, false, &force);
            let mut blocks = blocks.pulled(at.bodies, at.motion.x);
            let by_rates = at.probe.differentiate(&nodes, true, &force);
            blocks.add_by_rates_of_axes(&by_rates, at.bodies, at.motion.pair());
            blocks.add(at.assembly, &mut terms.stiffness, &mut none);
            let by_rates = by_rates.pulled(at.bodies, at.motion.x);
            by_rates.add(at.assembly, &mut terms.damping, &mut none);
        }
    }
}
