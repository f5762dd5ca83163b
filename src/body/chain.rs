//! A flexible body: a chain of elements through nodes.

use nalgebra::{SMatrix, SVector};

use super::assembly::{Assembly, NodeBlock};
use super::connectivity::Node;
use crate::elements::{Blocks, Element, Nodal, shape};
use crate::math::sparse::Matrix;

/// A chain of elements in `D` dimensions; its nodes have `B = 2 D` coordinates (position, slope) and
/// stand in a row in those of the system.
#[derive(Clone, Debug)]
pub struct Chain<E, const D: usize, const B: usize> {
    elements: Vec<E>,
    first: usize,
    /// Nodes from one element to the next: 1 where they share one, 2 where they do not.
    stride: usize,
    is_damped: bool,
}

impl<E: Element<D>, const D: usize, const B: usize> Chain<E, D, B> {
    /// A chain from node `first` on. Elements that are not `connected` have both their nodes for
    /// themselves: as many rows of `Phi` must connect them.
    pub fn new(elements: Vec<E>, first: usize, connected: bool) -> Self {
        assert!(B == 2 * D);
        Self {
            is_damped: elements.iter().any(Element::is_damped),
            elements,
            first,
            stride: if connected { 1 } else { 2 },
        }
    }

    /// The elements, in order from the first end.
    pub fn elements(&self) -> &[E] {
        &self.elements
    }

    /// Nodes of element `j`.
    pub fn nodes(&self, j: usize) -> [usize; 2] {
        let node = self.first + j * self.stride;
        [node, node + 1]
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.nodes(self.elements.len() - 1)[1] + 1 - self.first
    }

    /// Reference length, m.
    pub fn length(&self) -> f64 {
        self.elements.iter().map(Element::length).sum()
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
    pub fn bend(&self, j: usize, xi: f64, x: &[Node<B>]) -> SVector<f64, D> {
        self.element(j, x) * shape::curvatures(xi, self.elements[j].length())
    }

    /// Length along the chain to the nearest of a few points of every element, m.
    pub fn near(&self, point: &SVector<f64, D>, x: &[Node<B>]) -> f64 {
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
    pub fn element(&self, j: usize, x: &[Node<B>]) -> Nodal<D> {
        let node = self.first + j * self.stride;
        Nodal::from_column_slice(x[node..node + 2].as_flattened())
    }

    fn add_to(&self, j: usize, f: &Nodal<D>, force: &mut [Node<B>]) {
        let node = self.first + j * self.stride;
        let force = force[node..node + 2].as_flattened_mut();
        for (sum, f) in force.iter_mut().zip(f.as_slice()) {
            *sum += f;
        }
    }

    /// Adds elastic and damping forces.
    pub fn add_force(&self, x: &[Node<B>], rate: &[Node<B>], force: &mut [Node<B>]) {
        let rest = Nodal::zeros();
        for (j, element) in self.elements.iter().enumerate() {
            let e = self.element(j, x);
            // Only damping reads rates.
            let f = if self.is_damped {
                element.force(&e, &self.element(j, rate))
            } else {
                element.force(&e, &rest)
            };
            self.add_to(j, &f, force);
        }
    }

    /// Strain energy, J.
    pub fn strain_energy(&self, x: &[Node<B>]) -> f64 {
        let elements = self.elements.iter().enumerate();
        elements.map(|(j, e)| e.energy(&self.element(j, x))).sum()
    }

    /// Power that damping takes out, W.
    pub fn dissipation(&self, x: &[Node<B>], rate: &[Node<B>]) -> f64 {
        if !self.is_damped {
            return 0.0;
        }
        let power = |(j, element): (usize, &E)| {
            let (e, v) = (self.element(j, x), self.element(j, rate));
            (element.force(&e, &Nodal::zeros()) - element.force(&e, &v)).dot(&v)
        };
        self.elements.iter().enumerate().map(power).sum()
    }

    /// `f += s M a`.
    pub fn add_inertia(&self, s: f64, a: &[Node<B>], f: &mut [Node<B>]) {
        for (j, element) in self.elements.iter().enumerate() {
            self.add_to(j, &(self.element(j, a) * element.mass() * s), f);
        }
    }

    /// Adds the forces of an acceleration of space that is the same everywhere, or of any other load
    /// in proportion to mass.
    pub fn add_weight(&self, acceleration: &SMatrix<f64, D, 1>, force: &mut [Node<B>]) {
        for (j, element) in self.elements.iter().enumerate() {
            self.add_to(j, &(acceleration * element.weight().transpose()), force);
        }
    }

    /// Adds the mass to that of the system.
    pub fn add_mass(&self, assembly: &Assembly<B>, matrix: &mut Matrix<f64>) {
        for (j, element) in self.elements.iter().enumerate() {
            let m = element.mass();
            let blocks: Blocks<D> =
                std::array::from_fn(|a| std::array::from_fn(|b| SMatrix::identity() * m[(a, b)]));
            self.add_blocks(j, &blocks, assembly, matrix);
        }
    }

    /// Adds the tangent stiffness, and damping where there is any.
    pub fn add_tangent(
        &self,
        (x, rate): (&[Node<B>], &[Node<B>]),
        assembly: &Assembly<B>,
        stiffness: &mut Matrix<f64>,
        damping: &mut Matrix<f64>,
    ) {
        for (j, element) in self.elements.iter().enumerate() {
            let e = self.element(j, x);
            let blocks = if self.is_damped {
                element.stiffness(&e, &self.element(j, rate))
            } else {
                element.stiffness(&e, &Nodal::zeros())
            };
            self.add_blocks(j, &blocks, assembly, stiffness);
            if self.is_damped {
                self.add_blocks(j, &element.damping(&e), assembly, damping);
            }
        }
    }

    fn add_blocks(
        &self,
        j: usize,
        blocks: &Blocks<D>,
        assembly: &Assembly<B>,
        matrix: &mut Matrix<f64>,
    ) {
        let part = |row: usize, column: usize| -> NodeBlock<B> {
            std::array::from_fn(|r| {
                std::array::from_fn(|c| blocks[row + r / D][column + c / D][(r % D, c % D)])
            })
        };
        let [a, b] = self.nodes(j);
        assembly.add(a, a, &part(0, 0), matrix);
        assembly.add(a, b, &part(0, 2), matrix);
        assembly.add(b, b, &part(2, 2), matrix);
    }
}
