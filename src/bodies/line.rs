//! Lines of flexible bodies as bodies: chains of cable elements, which a winch may pay out.

use nalgebra::{DMatrix, SMatrix};

use super::LineChain;
use super::assembly::{Assembly, Links, block_of_parts};
use super::body::{BodyPart, Momentum, NodalMotion};
use super::connectivity::{Node, no_node};
use super::linearized::{ElementTangent, LinearTerms, LinearizationPoint};
use super::probe::Nodes;
use super::stages::RotatingNodes;
use super::winch::PaidOut;
use crate::elements::{Blocks, Element as _, Nodal};
use crate::math::jet::{Jet, Number};
use crate::math::space::{Vector, spin_matrix};
use crate::math::sparse::{General, Matrix};

impl<const D: usize> LineChain<D> {
    /// The line with the winch that pays it out, if there is one.
    #[inline(always)]
    pub fn paid_out<N: Number>(&self, drives: &[[N; 3]]) -> Option<PaidOut<'_, D, N>> {
        let winch = self.winch()?;
        Some(PaidOut {
            winch,
            chain: self,
            now: winch.now(drives),
        })
    }
}

/// A matrix of an element from its blocks over positions and slopes of both nodes.
fn whole<const D: usize>(blocks: &Blocks<D>) -> DMatrix<f64> {
    DMatrix::from_fn(4 * D, 4 * D, |r, c| blocks[r / D][c / D][(r % D, c % D)])
}

impl<const D: usize> BodyPart<D> for LineChain<D> {
    fn mass(&self) -> f64 {
        LineChain::mass(self)
    }

    fn cost(&self) -> usize {
        self.elements().len()
    }

    fn is_damped(&self) -> bool {
        LineChain::is_damped(self)
    }

    fn add_links(&self, links: &mut Links) {
        let elements = 0..self.elements().len();
        (links.mass).extend(elements.map(|j| <(usize, usize)>::from(self.nodes(j))));
    }

    fn mark_rotating(&self, rotating: &mut RotatingNodes) {
        rotating.elastic[self.range()].fill(true);
    }

    fn add_mass(&self, assembly: &Assembly<D>, mass: &mut Matrix<f64>) {
        LineChain::add_mass(self, &SMatrix::identity(), assembly, mass);
    }

    fn add_centrifugal(
        &self,
        rotation: [f64; 3],
        _x: &[Node<D>],
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        let spin = spin_matrix::<D>(rotation);
        LineChain::add_mass(self, &(spin * spin), assembly, matrix);
    }

    fn add_inertia<N: Number>(&self, s: f64, a: &[Node<D, N>], f: &mut [Node<D, N>]) {
        LineChain::add_inertia(self, N::of(s), a, f);
    }

    fn add_inertia_now(&self, drives: &[[f64; 3]], a: &[Node<D>], f: &mut [Node<D>]) {
        LineChain::add_inertia(self, self.length_now(drives).length_ratio(), a, f);
    }

    fn add_weight(&self, gravity: &Vector<D>, f: &mut [Node<D>]) {
        LineChain::add_weight(self, gravity, f);
    }

    #[inline(always)]
    fn add_force(
        &self,
        motion: NodalMotion<'_, D>,
        (f, _): (&mut [Node<D>], &mut [[f64; 3]]),
    ) -> f64 {
        let longer = self.length_now(motion.drives).scaling();
        LineChain::add_force(self, motion.pair(), longer, f)
    }

    fn add_force_of<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        (f, _): (&mut [Node<D, N>], &mut [[N; 3]]),
    ) {
        let longer = self.length_now(motion.drives).scaling();
        LineChain::add_force_of(self, motion.pair(), longer, f);
    }

    #[inline(always)]
    fn add_tangent(
        &self,
        motion: NodalMotion<'_, D>,
        assembly: &Assembly<D>,
        [stiffness, damping]: [&mut Matrix<f64>; 2],
    ) {
        let longer = self.length_now(motion.drives).scaling();
        let matrices = (stiffness, damping);
        LineChain::add_tangent(self, motion.pair(), longer, assembly, matrices);
    }

    fn add_quadratic<N: Number>(
        &self,
        x: &[Node<D, N>],
        map: &impl Fn(Vector<D, N>) -> Vector<D, N>,
        sum: &mut N,
    ) {
        if self.winch().is_some() {
            return;
        }
        for (j, element) in self.elements().iter().enumerate() {
            let e: Nodal<D, N> = self.element(j, x);
            let e = Nodal::from_columns(&[0, 1, 2, 3].map(|k| map(e.column(k).into())));
            *sum += (e * element.mass().map(N::of)).dot(&e);
        }
    }

    fn kinetic_beside<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> N {
        let of = |PaidOut { winch, now, .. }| winch.kinetic(self, motion.pair(), &now);
        self.paid_out(motion.drives).map_or(N::of(0.0), of)
    }

    fn strain_energy<N: Number>(&self, drives: &[[N; 3]], x: &[Node<D, N>]) -> N {
        LineChain::strain_energy(self, x, self.length_now(drives).by)
    }

    fn for_each_strain_energy(&self, x: [&[Node<D>]; 2], call: &mut impl FnMut([f64; 2])) {
        for (j, element) in self.elements().iter().enumerate() {
            call(x.map(|x| element.energy(&self.element(j, x))));
        }
    }

    fn dissipation<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> N {
        let longer = self.length_now(motion.drives).scaling();
        LineChain::dissipation(self, motion.pair(), longer)
    }

    fn add_momentum<N: Number>(&self, motion: NodalMotion<'_, D, N>, sum: &mut Momentum<D, N>) {
        let paid_out = self.paid_out(motion.drives);
        for (j, element) in self.elements().iter().enumerate() {
            let at: Nodal<D, N> = self.element(j, motion.x);
            let mut p = self.element(j, motion.v) * element.mass().map(N::of);
            if let Some(PaidOut { winch, now, .. }) = &paid_out {
                p = p / now.by + winch.convective_momentum(self, j, motion.x, now);
            }
            for k in 0..4 {
                sum.add(at.column(k).into(), p.column(k).into(), k % 2 == 0);
            }
        }
    }

    fn add_center<N: Number>(
        &self,
        drives: &[[N; 3]],
        x: &[Node<D, N>],
        sum: &mut Vector<D, N>,
    ) -> N {
        let longer = N::of(1.0) / self.length_now(drives).by;
        *sum += self.weighted_positions(x) * longer;
        (longer - N::of(1.0)) * N::of(LineChain::mass(self))
    }

    fn linearize(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        if at.rotation == [0.0; 3] {
            return;
        }
        for (j, element) in self.elements().iter().enumerate() {
            let (nodes, mass) = (self.nodes(j), element.mass());
            terms.add_coriolis(&nodes, at, |x, a, b| {
                let (row, column) = (2 * (a - nodes[0]), 2 * (b - nodes[0]));
                [0, 1].map(|p| {
                    let m = |k: usize| mass[(row + p, column + k)];
                    std::array::from_fn(|d| m(0) * x[0][d] + m(1) * x[1][d])
                })
            });
        }
    }

    /// Damped elements are differentiated where they move: what damping adds to stiffness there is not symmetric.
    fn linearize_elements(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        let is_damped = LineChain::is_damped(self) && !at.at_rest;
        let moves = is_damped && at.motion.v.iter().any(|v| *v != no_node());
        terms.is_damped |= is_damped;
        terms.is_symmetric &= !moves;
        for (j, element) in self.elements().iter().enumerate() {
            let (nodes, e) = (self.nodes(j), self.element(j, at.motion.x));
            let stiffness = if moves {
                let force = |x: &Nodes<D>, v: &Nodes<D>, f: &mut Nodes<D>| {
                    let force: Nodal<D, Jet> =
                        element.force(&self.element(j, x), &self.element(j, v));
                    self.add_to(j, &force, f);
                };
                at.probe.differentiate(&nodes, false, &force).vectors()
            } else {
                element.stiffness(&e, &Nodal::zeros())
            };
            let damping = is_damped.then(|| element.damping(&e));
            add_blocks(&nodes, &stiffness, at.assembly, &mut terms.stiffness);
            if let Some(damping) = &damping {
                add_blocks(&nodes, damping, at.assembly, &mut terms.damping);
            }
            let numbers = |node: usize| {
                (0..2).flat_map(move |part| (0..D).map(move |axis| ((node, part, axis), part == 0)))
            };
            terms.elements.push(ElementTangent {
                places: nodes.into_iter().flat_map(numbers).collect(),
                stiffness: whole(&stiffness),
                damping: damping.as_ref().map(whole),
            });
        }
    }
}

/// Adds the blocks of an element to a matrix over the free coordinates.
fn add_blocks<const D: usize>(
    nodes: &[usize; 2],
    blocks: &Blocks<D>,
    assembly: &Assembly<D>,
    matrix: &mut General<f64>,
) {
    for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let block = block_of_parts(|p, q| blocks[2 * a + p][2 * b + q]);
        let place = (nodes[a], nodes[b]);
        assembly.add_block(place, &block, matrix, &mut |_, _, _| {});
    }
}
