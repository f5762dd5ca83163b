//! Patches as bodies.

use std::ops::Range;

use super::Patch;
use crate::bodies::assembly::{Assembly, Links, NodeBlock, block_of_parts, no_block};
use crate::bodies::body::{BodyPart, Momentum, NodalMotion};
use crate::bodies::chain::Pack;
use crate::bodies::connectivity::{Node, no_node};
use crate::bodies::linearized::{ElementTangent, LinearTerms, LinearizationPoint};
use crate::bodies::map::Rotations;
use crate::bodies::probe::{NodeBlocks, Nodes};
use crate::bodies::setup::NodeNumber;
use crate::bodies::stages::RotatingNodes;
use crate::elements::shell::{CornerPack, PackBlocks, ShellPack, VECTORS};
use crate::math::jet::{Jet, Number};
use crate::math::lanes::{PACK, Simd, Vectorized, vectorized};
use crate::math::rotation::Quaternion;
use crate::math::space::{Vector, components, spin_matrix, vector};
use crate::math::sparse::Matrix;

/// Dimension of the scenes that patches are in. What takes long to compile is compiled for these alone.
const SPACE: usize = 3;

/// Adds forces of all packs.
struct AddPatchForce<'a, const D: usize> {
    patch: &'a Patch,
    motion: (&'a [Node<D>], &'a [Node<D>]),
    force: &'a mut [Node<D>],
    power: &'a mut f64,
}

impl<const D: usize> Vectorized for AddPatchForce<'_, D> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let (patch, (x, v)) = (self.patch, self.motion);
        let [mut e, mut rates, mut f] = [[[[[0.0; PACK]; 3]; VECTORS]; 4]; 3];
        for pack in &patch.packs {
            patch.read(pack, x, &mut e);
            *self.power += if patch.is_damped {
                patch.read(pack, v, &mut rates);
                pack.kernel.force(simd, (&e, Some(&rates)), &mut f)
            } else {
                pack.kernel.force(simd, (&e, None), &mut f)
            };
            for (lane, element) in pack.elements.clone().enumerate() {
                let nodes = patch.corner_nodes(element);
                for corner in 0..4 {
                    for k in 0..VECTORS {
                        let sum = &mut self.force[nodes[corner] + k / 2][k % 2];
                        for d in 0..D {
                            sum[d] += f[corner][k][d][lane];
                        }
                    }
                }
            }
        }
    }
}

/// Adds tangents of all packs.
struct AddPatchTangent<'a, const D: usize> {
    patch: &'a Patch,
    motion: NodalMotion<'a, D>,
    assembly: &'a Assembly<D>,
    stiffness: &'a mut Matrix<f64>,
    damping: &'a mut Matrix<f64>,
}

impl<const D: usize> Vectorized for AddPatchTangent<'_, D> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let (patch, motion) = (self.patch, self.motion);
        let [mut e, mut rates, mut from] = [[[[[0.0; PACK]; 3]; VECTORS]; 4]; 3];
        let mut blocks: PackBlocks = [[[[[0.0; PACK]; 3]; 3]; VECTORS]; VECTORS];
        for pack in &patch.packs {
            patch.read(pack, motion.x, &mut e);
            if patch.is_damped {
                patch.read(pack, motion.v, &mut rates);
            }
            if let Some(x) = motion.from {
                patch.read(pack, x, &mut from);
            }
            let before = (motion.from.is_some()).then_some(&from);
            let rates = patch.is_damped.then_some(&rates);
            let (stiffness, damping) = (&mut *self.stiffness, &mut *self.damping);
            let assembly = self.assembly;
            let call = |pair: (usize, usize), group: usize, is_damping: bool, of: &PackBlocks| {
                let matrix = if is_damping {
                    &mut *damping
                } else {
                    &mut *stiffness
                };
                let elements = pack.elements.clone().enumerate();
                let of_group = elements.skip(group * S::F64_LANES).take(S::F64_LANES);
                for (lane, element) in of_group {
                    patch.add_blocks((element, lane), pair, of, (assembly, &mut *matrix));
                }
            };
            (pack.kernel).tangent(simd, &e, (rates, before), &mut blocks, call);
        }
    }
}

impl Patch {
    /// Copies vectors of the corners of the elements of a pack, or their rates. The last element fills up.
    #[inline(always)]
    fn read<const D: usize>(&self, pack: &Pack<ShellPack>, x: &[Node<D>], e: &mut CornerPack) {
        let Range { start, end } = pack.elements;
        for lane in 0..PACK {
            let nodes = self.corner_nodes((start + lane).min(end - 1));
            for corner in 0..4 {
                for k in 0..VECTORS {
                    let vector = &x[nodes[corner] + k / 2][k % 2];
                    for d in 0..D {
                        e[corner][k][d][lane] = vector[d];
                    }
                }
            }
        }
    }

    /// Adds the blocks of a pair of corners of an element in a lane. Of a corner with itself the lower triangle is there.
    #[inline(always)]
    fn add_blocks<const D: usize>(
        &self,
        (element, lane): (usize, usize),
        (a, b): (usize, usize),
        blocks: &PackBlocks,
        (assembly, matrix): (&Assembly<D>, &mut Matrix<f64>),
    ) {
        let nodes = self.element_nodes(element);
        for (half_a, half_b) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
            if a == b && half_a < half_b {
                continue;
            }
            let mut block = no_block::<D>();
            for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let (k, l) = (2 * half_a + p, 2 * half_b + q);
                for r in 0..D {
                    for c in 0..D {
                        block[p][r][q][c] = if a == b && k < l {
                            blocks[l][k][c][r][lane]
                        } else {
                            blocks[k][l][r][c][lane]
                        };
                    }
                }
            }
            let of = (self.first_element + element, &nodes);
            assembly.add_of_element(of, (2 * a + half_a, 2 * b + half_b), &block, matrix);
        }
    }

    /// Nodes of the corners of an element.
    pub fn element_nodes(&self, element: usize) -> [usize; 8] {
        let corners = self.corner_nodes(element);
        std::array::from_fn(|k| corners[k / 2] + k % 2)
    }

    /// `f += s M a` with what a vector `a` becomes before.
    fn add_mass_times<const D: usize, N: Number>(
        &self,
        s: N,
        a: &[Node<D, N>],
        f: &mut [Node<D, N>],
    ) {
        for (index, element) in self.elements.iter().enumerate() {
            let rates = self.element(index, a);
            let rates = rates.as_flattened();
            let mut force = [[[N::of(0.0); 3]; VECTORS]; 4];
            for (row, force) in force.as_flattened_mut().iter_mut().enumerate() {
                for (column, rate) in rates.iter().enumerate() {
                    let mass = s * N::of(element.mass()[(row, column)]);
                    for (force, rate) in force.iter_mut().zip(rate) {
                        *force += mass * *rate;
                    }
                }
            }
            self.add_to(index, &force, f);
        }
    }

    /// Adds the mass times a matrix over the axes.
    fn add_mass_matrix<const D: usize>(
        &self,
        axes: &nalgebra::SMatrix<f64, D, D>,
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        for (index, element) in self.elements.iter().enumerate() {
            let nodes = self.element_nodes(index);
            for (a, first) in nodes.iter().enumerate() {
                for (b, second) in nodes.iter().enumerate().take(a + 1) {
                    let mass = element.mass();
                    let block = block_of_parts(|p, q| axes * mass[(2 * a + p, 2 * b + q)]);
                    assembly.add(*first, *second, &block, matrix);
                }
            }
        }
    }

    /// Accelerations of points with their derivatives, of those of mesh nodes.
    pub(in crate::bodies) fn differentiate<const D: usize>(
        &self,
        x: &[Node<D, Jet>],
        bias: &[Node<D, Jet>],
        acceleration: &mut [Node<D, Jet>],
    ) {
        self.place_point_rates(x, acceleration);
        for node in self.followers() {
            let sums = acceleration[node].as_flattened_mut().iter_mut();
            sums.zip(bias[node].as_flattened())
                .for_each(|(sum, bias)| *sum += *bias);
        }
    }
}

impl<const D: usize> BodyPart<D> for Patch {
    fn mass(&self) -> f64 {
        self.total_mass()
    }

    /// An element takes as long as some ten of a line.
    fn cost(&self) -> usize {
        10 * self.elements.len()
    }

    /// A tangent of an element takes as long as ten of its forces, of a damped one as twenty.
    fn tangent_cost(&self) -> usize {
        let of_element = if self.is_damped { 150 } else { 75 };
        of_element * self.elements.len()
    }

    fn is_damped(&self) -> bool {
        self.is_damped
    }

    fn add_links(&self, links: &mut Links) {
        for index in 0..self.elements.len() {
            let nodes = self.element_nodes(index);
            links.surfaces.push(nodes);
            for (a, first) in nodes.iter().enumerate() {
                (links.mass).extend(nodes[..=a].iter().map(|second| (*first, *second)));
            }
        }
        for point in &self.points {
            let followed: Vec<usize> = point.followed().flat_map(|node| [node, node + 1]).collect();
            for (a, first) in followed.iter().enumerate() {
                (links.stiffness).extend(followed[..a].iter().map(|second| (*first, *second)));
            }
        }
    }

    /// Points have no coordinates.
    fn add_fixed_numbers(&self, at: &[Node<D>], fixed: &mut Vec<(NodeNumber, f64)>) {
        for node in self.followers() {
            for (part, axis) in (0..2).flat_map(|part| (0..D).map(move |axis| (part, axis))) {
                fixed.push(((node, part, axis), at[node][part][axis]));
            }
        }
    }

    fn mark_rotating(&self, rotating: &mut RotatingNodes) {
        rotating.still[self.followers()].fill(true);
        rotating.surfaces.extend(self.mesh().step_by(2));
    }

    fn place(&self, _from: &[Quaternion], _rotations: &mut Rotations, x: &mut [Node<D>]) {
        self.place_points(x);
    }

    fn place_rates(&self, x: &[Node<D>], _rotations: &mut Rotations, v: &mut [Node<D>]) {
        self.place_point_rates(x, v);
    }

    fn place_changes<N: Number>(&self, x: &[Node<D, N>], dx: &mut [Node<D, N>]) {
        self.place_point_rates(x, dx);
    }

    fn add_centripetal<N: Number>(&self, motion: NodalMotion<'_, D, N>, a: &mut [Node<D, N>]) {
        self.add_point_bias(motion.pair(), a);
    }

    fn pull_back<N: Number>(
        &self,
        (x, _): (&[Node<D, N>], Option<&[Node<D, N>]>),
        f: &mut [Node<D, N>],
    ) {
        self.pull_points(x, f);
    }

    fn for_each_geometric(
        &self,
        f: &[Node<D>],
        x: &[Node<D>],
        add: &mut impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        self.geometric_blocks(f, x, add);
    }

    fn add_mass(&self, assembly: &Assembly<D>, mass: &mut Matrix<f64>) {
        self.add_mass_matrix(&nalgebra::SMatrix::identity(), assembly, mass);
    }

    fn add_centrifugal(
        &self,
        rotation: [f64; 3],
        _x: &[Node<D>],
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        let spin = spin_matrix::<D>(rotation);
        self.add_mass_matrix(&(spin * spin), assembly, matrix);
    }

    fn add_inertia<N: Number>(&self, s: f64, a: &[Node<D, N>], f: &mut [Node<D, N>]) {
        self.add_mass_times(N::of(s), a, f);
    }

    fn add_weight(&self, gravity: &Vector<D>, f: &mut [Node<D>]) {
        let gravity = components(gravity);
        for (index, element) in self.elements.iter().enumerate() {
            let weight = element.weight();
            let force = std::array::from_fn(|corner| {
                std::array::from_fn(|k| gravity.map(|g| g * weight[VECTORS * corner + k]))
            });
            self.add_to(index, &force, f);
        }
    }

    #[inline(always)]
    fn add_force(
        &self,
        motion: NodalMotion<'_, D>,
        (f, _): (&mut [Node<D>], &mut [[f64; 3]]),
    ) -> f64 {
        let mut power = 0.0;
        if const { D == SPACE } {
            vectorized(AddPatchForce {
                patch: self,
                motion: motion.pair(),
                force: f,
                power: &mut power,
            });
        }
        power
    }

    fn add_force_of<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        (f, _): (&mut [Node<D, N>], &mut [[N; 3]]),
    ) {
        for (index, element) in self.elements.iter().enumerate() {
            let [at, rates] = [motion.x, motion.v].map(|x| self.element(index, x));
            self.add_to(index, &element.force(&at, &rates).0, f);
        }
    }

    #[inline(always)]
    fn add_tangent(
        &self,
        motion: NodalMotion<'_, D>,
        assembly: &Assembly<D>,
        [stiffness, damping]: [&mut Matrix<f64>; 2],
    ) {
        if const { D == SPACE } {
            vectorized(AddPatchTangent {
                patch: self,
                motion,
                assembly,
                stiffness,
                damping,
            });
        }
    }

    fn add_quadratic<N: Number>(
        &self,
        x: &[Node<D, N>],
        map: &impl Fn(Vector<D, N>) -> Vector<D, N>,
        sum: &mut N,
    ) {
        for (index, element) in self.elements.iter().enumerate() {
            let mut vectors = [Vector::<D, N>::zeros(); 16];
            for (corner, node) in self.corner_nodes(index).into_iter().enumerate() {
                for k in 0..VECTORS {
                    vectors[VECTORS * corner + k] = map(x[node + k / 2][k % 2].into());
                }
            }
            for (row, first) in vectors.iter().enumerate() {
                for (column, second) in vectors.iter().enumerate() {
                    *sum += first.dot(second) * N::of(element.mass()[(row, column)]);
                }
            }
        }
    }

    fn strain_energy<N: Number>(&self, _drives: &[[N; 3]], x: &[Node<D, N>]) -> N {
        let elements = self.elements.iter().enumerate();
        let energies = elements.map(|(index, element)| element.energy(&self.element(index, x)));
        energies.fold(N::of(0.0), |sum, energy| sum + energy)
    }

    fn for_each_strain_energy(&self, x: [&[Node<D>]; 2], call: &mut impl FnMut([f64; 2])) {
        for (index, element) in self.elements.iter().enumerate() {
            call(x.map(|x| element.energy(&self.element(index, x))));
        }
    }

    fn dissipation<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> N {
        if !self.is_damped {
            return N::of(0.0);
        }
        let powers = self.elements.iter().enumerate().map(|(index, element)| {
            let [at, rates] = [motion.x, motion.v].map(|x| self.element(index, x));
            element.force(&at, &rates).1
        });
        powers.fold(N::of(0.0), |sum, power| sum + power)
    }

    fn add_momentum<N: Number>(&self, motion: NodalMotion<'_, D, N>, sum: &mut Momentum<D, N>) {
        for (index, element) in self.elements.iter().enumerate() {
            let [at, rates] = [motion.x, motion.v].map(|x| self.element(index, x));
            let to_vector = |v: &[N; 3]| vector::<D, N>(*v);
            for (row, place) in at.as_flattened().iter().enumerate() {
                let mut momentum = Vector::<D, N>::zeros();
                for (column, rate) in rates.as_flattened().iter().enumerate() {
                    momentum += to_vector(rate) * N::of(element.mass()[(row, column)]);
                }
                sum.add(to_vector(place), momentum, row.is_multiple_of(VECTORS));
            }
        }
    }

    fn add_center<N: Number>(
        &self,
        _drives: &[[N; 3]],
        x: &[Node<D, N>],
        sum: &mut Vector<D, N>,
    ) -> N {
        for (index, element) in self.elements.iter().enumerate() {
            let weight = element.weight();
            for (corner, node) in self.corner_nodes(index).into_iter().enumerate() {
                for k in 0..VECTORS {
                    let vector = Vector::<D, N>::from(x[node + k / 2][k % 2]);
                    *sum += vector * N::of(weight[VECTORS * corner + k]);
                }
            }
        }
        N::of(0.0)
    }

    fn linearize(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        if at.rotation == [0.0; 3] {
            return;
        }
        for (index, element) in self.elements.iter().enumerate() {
            let nodes = self.element_nodes(index);
            let place = |node: usize| nodes.iter().position(|own| *own == node).unwrap_or(0);
            terms.add_coriolis(&nodes, at, |x, a, b| {
                let (row, column) = (2 * place(a), 2 * place(b));
                [0, 1].map(|p| {
                    let m = |k: usize| element.mass()[(row + p, column + k)];
                    std::array::from_fn(|d| m(0) * x[0][d] + m(1) * x[1][d])
                })
            });
        }
    }

    /// Elements are differentiated on numbers that carry derivatives: what damping adds to stiffness where they move is not symmetric.
    fn linearize_elements(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        let is_damped = self.is_damped && !at.at_rest;
        let moves = is_damped && at.motion.v.iter().any(|v| *v != no_node());
        terms.is_damped |= is_damped;
        terms.is_symmetric &= !moves;
        let corner = |(node, part, axis): NodeNumber| {
            let is_position = (node - self.first).is_multiple_of(2) && part == 0;
            ((node, part, axis), is_position)
        };
        for index in 0..self.elements.len() {
            let nodes = self.element_nodes(index);
            let still = [[[Jet::from_re(0.0); 3]; VECTORS]; 4];
            let force = |x: &Nodes<D>, v: &Nodes<D>, f: &mut Nodes<D>| {
                let rates = if is_damped {
                    self.element(index, v)
                } else {
                    still
                };
                let (force, _) = self.elements[index].force(&self.element(index, x), &rates);
                self.add_to(index, &force, f);
            };
            let add = |blocks: &NodeBlocks, matrix: &mut _| {
                blocks.add(at.assembly, matrix, &mut |_, _, _| {});
            };
            let stiffness = at.probe.differentiate(&nodes, false, &force);
            let damping = is_damped.then(|| at.probe.differentiate(&nodes, true, &force));
            add(&stiffness, &mut terms.stiffness);
            if let Some(damping) = &damping {
                add(damping, &mut terms.damping);
            }
            let mut sorted = nodes;
            sorted.sort_unstable();
            let numbers = sorted.into_iter().flat_map(|node| {
                (0..2).flat_map(move |part| (0..D).map(move |axis| (node, part, axis)))
            });
            terms.elements.push(ElementTangent {
                places: numbers.map(corner).collect(),
                stiffness: stiffness.into_whole(),
                damping: damping.map(NodeBlocks::into_whole),
            });
        }
    }
}
