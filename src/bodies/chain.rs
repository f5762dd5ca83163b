//! A flexible body: a chain of elements through nodes.

use std::ops::Range;

use nalgebra::{SMatrix, SVector};

use super::assembly::{Assembly, block_of_parts, no_block};
use super::connectivity::Node;
use super::winch::{Length, Winch};
use crate::elements::{BlockPack, Element, ElementMotion, Nodal, NodalView, shape};
use crate::math::jet::Number;
use crate::math::lanes::{PACK, Simd, Vectorized, vectorized};
use crate::math::sparse::Matrix;

/// A chain of elements in `D` dimensions; its nodes stand in a row in those of the system.
#[derive(Clone, Debug)]
pub struct Chain<E: Element<D>, const D: usize> {
    elements: Vec<E>,
    packs: Vec<Pack<E::Pack>>,
    first: usize,
    is_damped: bool,
    /// The winch that pays it out, if there is one.
    winch: Option<Winch<D>>,
}

/// Elements that are computed together, at most [`PACK`].
#[derive(Clone, Debug)]
pub(super) struct Pack<P> {
    /// Indices of the elements.
    pub elements: Range<usize>,
    /// Constants of all these elements.
    pub kernel: P,
}

/// Groups those of some elements that count, where each `goes_with` the first of its pack and `pack` joins them.
pub(super) fn packs<E, P>(
    elements: &[E],
    counts: impl Fn(&E) -> bool,
    goes_with: impl Fn(&E, &E) -> bool,
    pack: impl Fn(&[E]) -> P,
) -> Vec<Pack<P>> {
    let (mut packs, mut start) = (Vec::new(), 0);
    while start < elements.len() {
        let rest = &elements[start..];
        if !counts(&rest[0]) {
            start += 1;
            continue;
        }
        let alike = |element: &&E| counts(element) && goes_with(&rest[0], element);
        let count = rest.iter().take_while(alike).take(PACK).count();
        packs.push(Pack {
            elements: start..start + count,
            kernel: pack(&rest[..count]),
        });
        start += count;
    }
    packs
}

/// Packs of the elements of a line that have forces of their own.
fn line_packs<E: Element<D>, const D: usize>(elements: &[E]) -> Vec<Pack<E::Pack>> {
    packs(elements, E::resists, E::goes_with, E::pack)
}

impl<E: Element<D>, const D: usize> Chain<E, D> {
    /// A chain from node `first` on.
    pub fn new(elements: Vec<E>, first: usize) -> Self {
        Self {
            is_damped: elements.iter().any(Element::is_damped),
            packs: line_packs(&elements),
            elements,
            first,
            winch: None,
        }
    }

    /// Puts the chain on a winch.
    pub fn set_winch(&mut self, winch: Winch<D>) {
        self.winch = Some(winch);
    }

    /// The winch that pays it out.
    #[inline(always)]
    pub fn winch(&self) -> Option<&Winch<D>> {
        self.winch.as_ref()
    }

    /// Returns its length now, from the coordinates `drives` that are driven.
    #[inline(always)]
    pub fn length_now<N: Number>(&self, drives: &[[N; 3]]) -> Length<N> {
        self.winch
            .as_ref()
            .map_or_else(Length::same, |winch| winch.now(drives))
    }

    /// Tells the first and the last element whether something is joined to the ends of the chain, or acts there;
    /// `shape` are nodal coordinates of the unstressed shape.
    pub fn set_free_ends(&mut self, free: [bool; 2], shape: &[Node<D>]) {
        let last = self.elements.len() - 1;
        for j in [0, last] {
            let own = [j == 0 && free[0], j == last && free[1]];
            self.elements[j] = self.elements[j].with_free_ends(&self.element(j, shape), own);
        }
        self.packs = line_packs(&self.elements);
    }

    /// Gives elements without bending stiffness one (N m^2), from the shape with these nodal
    /// coordinates on.
    pub fn stiffen(&mut self, stiffness: f64, shape: &[Node<D>]) {
        for j in 0..self.elements.len() {
            self.elements[j] = self.elements[j].with_bending(&self.element(j, shape), stiffness);
        }
        self.packs = line_packs(&self.elements);
    }

    /// Mean of the axial strain in the middle of the elements.
    pub fn mean_strain(&self, x: &[Node<D>]) -> f64 {
        let elements = self.elements.iter().enumerate();
        let of = |(j, e): (usize, &E)| e.length() * e.strain(&self.element(j, x), 0.5).0;
        elements.map(of).sum::<f64>() / self.length()
    }

    /// Mean axial stiffness, N.
    pub fn axial_stiffness(&self) -> f64 {
        let sum: f64 = self
            .elements
            .iter()
            .map(|e| e.length() * e.axial_stiffness())
            .sum();
        sum / self.length()
    }

    /// The elements, in order from the first end.
    pub fn elements(&self) -> &[E] {
        &self.elements
    }

    /// Nodes of element `j`.
    pub fn nodes(&self, j: usize) -> [usize; 2] {
        let node = self.first + j;
        [node, node + 1]
    }

    /// First node.
    pub fn first_node(&self) -> usize {
        self.first
    }

    /// Nodes in order.
    pub fn range(&self) -> Range<usize> {
        self.first..self.first + self.node_count()
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.nodes(self.elements.len() - 1)[1] + 1 - self.first
    }

    /// Reference length, m.
    pub fn length(&self) -> f64 {
        self.elements.iter().map(Element::length).sum()
    }

    /// Reference length of element `j`, m.
    pub fn element_length(&self, j: usize) -> f64 {
        self.elements[j].length()
    }

    /// Mass, kg.
    pub fn mass(&self) -> f64 {
        let of_element = |e: &E| e.weight()[0] + e.weight()[2];
        self.elements.iter().map(of_element).sum()
    }

    /// Whether any element dissipates.
    pub fn is_damped(&self) -> bool {
        self.is_damped
    }

    /// Element `j` and its part along the chain, both from a length in m.
    pub fn find(&self, length: f64) -> (usize, f64) {
        let (mut start, mut j) = (0.0, 0);
        while j + 1 < self.elements.len() && start + self.elements[j].length() <= length {
            start += self.elements[j].length();
            j += 1;
        }
        (j, (length - start) / self.elements[j].length())
    }

    /// Second derivative of the curve by its length inside element `j`, `xi` in [0, 1], 1/m.
    pub fn bend<N: Number>(&self, j: usize, xi: N, x: &[Node<D, N>]) -> SVector<N, D> {
        self.element(j, x) * shape::curvatures(xi, self.elements[j].length())
    }

    /// Tangents of element `j` at its ends and three points between, equally spaced.
    pub fn tangents<N: Number>(&self, j: usize, x: &[Node<D, N>]) -> [SVector<N, D>; 5] {
        let (e, length) = (self.element(j, x), self.elements[j].length());
        std::array::from_fn(|k| e * shape::slopes(N::of(k as f64 / 4.0), length))
    }

    /// Whether element `j` folds back on itself: its tangent rotates by more than a right angle over a quarter of the element.
    pub fn is_folded(&self, j: usize, x: &[Node<D>]) -> bool {
        let tangents = self.tangents(j, x);
        tangents.windows(2).any(|pair| pair[0].dot(&pair[1]) < 0.0)
    }

    /// Length along the chain to the nearest of a few points of every element, m.
    pub fn near(&self, point: &SVector<f64, D>, x: &[Node<D>]) -> f64 {
        let (mut best, mut distance, mut start) = (0.0, f64::INFINITY, 0.0);
        for (j, element) in self.elements.iter().enumerate() {
            let (e, length) = (self.element(j, x), element.length());
            for k in 0..=4 {
                let xi = 0.25 * f64::from(k);
                let away = (point - e * shape::values(xi, length)).norm();
                if away < distance {
                    (best, distance) = (start + xi * length, away);
                }
            }
            start += length;
        }
        best
    }

    /// Coordinates of element `j`, or rates or forces.
    pub fn element<N: Number>(&self, j: usize, x: &[Node<D, N>]) -> Nodal<D, N> {
        let node = self.first + j;
        Nodal::from_column_slice(x[node..node + 2].as_flattened().as_flattened())
    }

    /// Adds forces on the coordinates of element `j`.
    pub fn add_to<N: Number>(&self, j: usize, f: &Nodal<D, N>, force: &mut [Node<D, N>]) {
        let node = self.first + j;
        let force = force[node..node + 2].as_flattened_mut();
        for (sum, f) in force.as_flattened_mut().iter_mut().zip(f.as_slice()) {
            *sum += *f;
        }
    }

    /// Adds elastic and damping forces of a chain that is longer than its reference length `L_0`: `longer` tells `L_0 / L` and `L' / L`
    /// (1/s) of the length `L` now. The power that damping takes out, W.
    pub fn add_force(
        &self,
        (x, rate): (&[Node<D>], &[Node<D>]),
        longer: [f64; 2],
        force: &mut [Node<D>],
    ) -> f64 {
        let (chain, mut power) = (self, 0.0);
        vectorized(AddForce {
            chain,
            x,
            rate,
            longer,
            force,
            power: &mut power,
        });
        power / longer[0]
    }

    /// Adds the forces of all elements for any number type, element by element.
    pub fn add_force_of<N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        longer: [N; 2],
        force: &mut [Node<D, N>],
    ) {
        for j in 0..self.elements.len() {
            let (f, _) = self.force_of(j, motion, longer);
            self.add_to(j, &f, force);
        }
    }

    /// Elastic and damping force of element `j` on its coordinates, N and N m, and the power that damping takes out, W.
    pub fn force_of<N: Number>(
        &self,
        j: usize,
        (x, rate): (&[Node<D, N>], &[Node<D, N>]),
        [by, growth]: [N; 2],
    ) -> (Nodal<D, N>, N) {
        let e = self.element(j, x);
        let rate = self.element(j, rate) - e * growth;
        self.elements[j].force_by(&e, &rate, by)
    }

    /// Strain energy, J; `by` is the reference length over the length now.
    pub fn strain_energy<N: Number>(&self, x: &[Node<D, N>], by: N) -> N {
        let elements = self.elements.iter().enumerate();
        let energies = elements.map(|(j, e)| e.energy_by(&self.element(j, x), by));
        energies.fold(N::of(0.0), |sum, energy| sum + energy)
    }

    /// Power that damping takes out, W, as of [`Chain::add_force`].
    pub fn dissipation<N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        longer: [N; 2],
    ) -> N {
        if !self.is_damped {
            return N::of(0.0);
        }
        let powers = (0..self.elements.len()).map(|j| self.force_of(j, motion, longer).1);
        powers.fold(N::of(0.0), |sum, power| sum + power)
    }

    /// `f += s M a`.
    pub fn add_inertia<N: Number>(&self, s: N, a: &[Node<D, N>], f: &mut [Node<D, N>]) {
        for (j, element) in self.elements.iter().enumerate() {
            let mass = element.mass().map(N::of);
            self.add_to(j, &(self.element(j, a) * mass * s), f);
        }
    }

    /// Adds the forces of an acceleration of space that is the same everywhere, or of any other load
    /// in proportion to mass.
    pub fn add_weight<N: Number>(&self, acceleration: &SMatrix<N, D, 1>, force: &mut [Node<D, N>]) {
        for (j, element) in self.elements.iter().enumerate() {
            let weight = element.weight().transpose().map(N::of);
            self.add_to(j, &(acceleration * weight), force);
        }
    }

    /// Adds the mass, times a matrix over the axes, to a matrix of the system.
    pub fn add_mass(
        &self,
        axes: &SMatrix<f64, D, D>,
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        for (j, element) in self.elements.iter().enumerate() {
            let m = element.mass();
            let [a, b] = self.nodes(j);
            for (row, column, at) in [(a, a, (0, 0)), (b, a, (2, 0)), (b, b, (2, 2))] {
                let block = block_of_parts(|p, q| axes * m[(at.0 + p, at.1 + q)]);
                assembly.add(row, column, &block, matrix);
            }
        }
    }

    /// Adds the tangent stiffness, and damping where there is any, of a chain as of [`Chain::add_force`]: over its coordinates times
    /// the root of its reference length over the length now.
    pub fn add_tangent(
        &self,
        (x, rate): (&[Node<D>], &[Node<D>]),
        longer: [f64; 2],
        assembly: &Assembly<D>,
        matrices: (&mut Matrix<f64>, &mut Matrix<f64>),
    ) {
        let chain = self;
        vectorized(AddTangent {
            chain,
            x,
            rate,
            longer,
            assembly,
            matrices,
        });
    }

    /// Copies coordinates of the nodes of a pack, or rates, times a factor.
    #[inline(always)]
    fn read(&self, pack: &Pack<E::Pack>, x: &[Node<D>], by: f64, e: &mut NodePack<D>) {
        let first = self.first + pack.elements.start;
        let nodes = &x[first..][..=pack.elements.len().min(PACK)];
        for (lane, node) in nodes.iter().enumerate() {
            for p in 0..2 {
                for d in 0..D {
                    e[p][d][lane] = node[p][d] * by;
                }
            }
        }
    }

    /// Copies rates of the nodes of a pack without what lengthening by itself adds, times a factor.
    #[inline(always)]
    fn read_rates(
        &self,
        pack: &Pack<E::Pack>,
        (x, rate): (&[Node<D>], &[Node<D>]),
        [by, growth]: [f64; 2],
        v: &mut NodePack<D>,
    ) {
        let first = self.first + pack.elements.start;
        let nodes = first..=first + pack.elements.len().min(PACK);
        let nodes = x[nodes.clone()].iter().zip(&rate[nodes]);
        for (lane, (x, rate)) in nodes.enumerate() {
            for p in 0..2 {
                for d in 0..D {
                    v[p][d][lane] = (rate[p][d] - growth * x[p][d]) * by;
                }
            }
        }
    }

    #[inline(always)]
    fn add_blocks(
        &self,
        pack: &Pack<E::Pack>,
        blocks: &BlockPack<D>,
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        for (lane, j) in pack.elements.clone().enumerate() {
            let [a, b] = self.nodes(j);
            for (part, (row, column)) in [(a, a), (b, a), (b, b)].into_iter().enumerate() {
                let mut block = no_block();
                for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    for r in 0..D {
                        for c in 0..D {
                            block[p][r][q][c] = blocks[part][p][q][r][c][lane];
                        }
                    }
                }
                assembly.add(row, column, &block, matrix);
            }
        }
    }
}

/// [`Chain::add_force`].
struct AddForce<'a, E: Element<D>, const D: usize> {
    chain: &'a Chain<E, D>,
    x: &'a [Node<D>],
    rate: &'a [Node<D>],
    longer: [f64; 2],
    force: &'a mut [Node<D>],
    /// Power that damping takes out, W.
    power: &'a mut f64,
}

impl<E: Element<D>, const D: usize> Vectorized for AddForce<'_, E, D> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let (chain, [by, growth]) = (self.chain, self.longer);
        let (mut e, mut v) = (rest(), rest());
        let mut f = [[[0.0; PACK]; D]; 4];
        for pack in &chain.packs {
            chain.read(pack, self.x, by, &mut e);
            if chain.is_damped {
                chain.read_rates(pack, (self.x, self.rate), [by, growth], &mut v);
                let motion = ElementMotion::new(ends(&e), Some(ends(&v)));
                *self.power += E::pack_force(simd, &pack.kernel, motion, by, &mut f);
            } else {
                let motion = ElementMotion::new(ends(&e), None);
                E::pack_force(simd, &pack.kernel, motion, by, &mut f);
            }
            let first = chain.first + pack.elements.start;
            let count = pack.elements.len().min(PACK);
            let nodes = &mut self.force[first..][..=count];
            for p in 0..2 {
                for d in 0..D {
                    nodes[0][p][d] += f[p][d][0];
                }
            }
            for lane in 1..count {
                for p in 0..2 {
                    for d in 0..D {
                        nodes[lane][p][d] += f[2 + p][d][lane - 1] + f[p][d][lane];
                    }
                }
            }
            for p in 0..2 {
                for d in 0..D {
                    nodes[count][p][d] += f[2 + p][d][count - 1];
                }
            }
        }
    }
}

/// [`Chain::add_tangent`].
struct AddTangent<'a, E: Element<D>, const D: usize> {
    chain: &'a Chain<E, D>,
    x: &'a [Node<D>],
    rate: &'a [Node<D>],
    longer: [f64; 2],
    assembly: &'a Assembly<D>,
    /// Stiffness and damping.
    matrices: (&'a mut Matrix<f64>, &'a mut Matrix<f64>),
}

impl<E: Element<D>, const D: usize> Vectorized for AddTangent<'_, E, D> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let (chain, (stiffness, damping)) = (self.chain, self.matrices);
        let [by, growth] = self.longer;
        let (mut e, mut v) = (rest(), rest());
        let mut blocks = [[[[[[0.0; PACK]; D]; D]; 2]; 2]; 3];
        for pack in &chain.packs {
            chain.read(pack, self.x, by, &mut e);
            if chain.is_damped {
                chain.read_rates(pack, (self.x, self.rate), [by, growth], &mut v);
                let motion = ElementMotion::new(ends(&e), Some(ends(&v)));
                E::pack_stiffness(simd, &pack.kernel, motion, by, &mut blocks);
                chain.add_blocks(pack, &blocks, self.assembly, stiffness);
                E::pack_damping(simd, &pack.kernel, ends(&e), by, &mut blocks);
                chain.add_blocks(pack, &blocks, self.assembly, damping);
            } else {
                let motion = ElementMotion::new(ends(&e), None);
                E::pack_stiffness(simd, &pack.kernel, motion, by, &mut blocks);
                chain.add_blocks(pack, &blocks, self.assembly, stiffness);
            }
        }
    }
}

/// Positions and slopes of the nodes of a pack, or rates of them: every coordinate of all nodes side by side, so that
/// those of two elements are read once.
type NodePack<const D: usize> = [[[f64; PACK + 1]; D]; 2];

/// Coordinates that any element can be evaluated at, for lanes without one.
fn rest<const D: usize>() -> NodePack<D> {
    [[[1.0; PACK + 1]; D]; 2]
}

/// Coordinates of the elements from those of the nodes: the second end of one is the first of the next.
#[inline(always)]
fn ends<const D: usize>(nodes: &NodePack<D>) -> NodalView<'_, D> {
    let [first @ .., _] = &nodes[0][0];
    let mut ends = [[first; D]; 4];
    for p in 0..2 {
        for d in 0..D {
            [ends[p][d], ends[2 + p][d]] = both(&nodes[p][d]);
        }
    }
    ends
}

/// All numbers but the last, and all but the first.
#[inline(always)]
pub(super) fn both(numbers: &[f64; PACK + 1]) -> [&[f64; PACK]; 2] {
    let ([first @ .., _], [_, second @ ..]) = (numbers, numbers);
    [first, second]
}
