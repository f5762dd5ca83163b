//! Masses in points of bodies, and straight rigid bodies with a uniform mass along them: cables that do not bend.

use nalgebra::SMatrix;

use super::Marker;
use super::assembly::{Assembly, Links};
use super::body::{BodyPart, Momentum, NodalMotion};
use super::connectivity::{Node, no_node};
use super::linearized::{LinearTerms, LinearizationPoint};
use crate::math::jet::Number;
use crate::math::space::{Vector, spin_matrix};
use crate::math::sparse::Matrix;

/// Mass in a point of a body: a point mass, or a rigid body about its centre of mass.
#[derive(Clone, Copy, Debug)]
pub struct LumpedMass {
    /// Where it is.
    pub marker: Marker,
    /// Mass, kg.
    pub mass: f64,
    /// Mass of the fluid that moves along, kg: it has inertia and no weight.
    pub added: f64,
    /// Inertia of the direction against rotating (and of a slope against stretching), kg m^2.
    pub inertia: f64,
}

impl LumpedMass {
    /// Mass that is moved, kg.
    pub fn moved(&self) -> f64 {
        self.mass + self.added
    }
}

/// A rigid body along its direction, its mass uniform and its node in the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidRod {
    /// Index of the node.
    pub node: usize,
    /// Length, m.
    pub length: f64,
    /// Place of its own mass among the lumped masses.
    pub mass: usize,
}

impl<const D: usize> BodyPart<D> for LumpedMass {
    fn mass(&self) -> f64 {
        self.mass
    }

    fn cost(&self) -> usize {
        1
    }

    fn add_links(&self, links: &mut Links) {
        let [a, b] = self.marker.nodes;
        links.mass.push((a, b));
    }

    fn add_mass(&self, assembly: &Assembly<D>, mass: &mut Matrix<f64>) {
        self.add_mass_along(&SMatrix::identity(), assembly, mass);
    }

    fn add_centrifugal(
        &self,
        rotation: [f64; 3],
        _x: &[Node<D>],
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        let spin = spin_matrix::<D>(rotation);
        self.add_mass_along(&(spin * spin), assembly, matrix);
    }

    fn add_inertia<N: Number>(&self, s: f64, a: &[Node<D, N>], f: &mut [Node<D, N>]) {
        let marker = self.marker.lift();
        let at: Vector<D, N> = marker.position(a) * N::of(s * self.moved());
        let on = marker.direction(a) * N::of(s * self.inertia);
        marker.add_force(at, on, f);
    }

    fn add_weight(&self, gravity: &Vector<D>, f: &mut [Node<D>]) {
        let force = gravity * self.mass;
        self.marker.add_force(force, Vector::zeros(), f);
    }

    fn add_quadratic<N: Number>(
        &self,
        x: &[Node<D, N>],
        map: &impl Fn(Vector<D, N>) -> Vector<D, N>,
        sum: &mut N,
    ) {
        let marker = self.marker.lift();
        let (at, on) = (map(marker.position(x)), map(marker.direction(x)));
        *sum += at.norm_squared() * N::of(self.moved()) + on.norm_squared() * N::of(self.inertia);
    }

    fn add_momentum<N: Number>(&self, motion: NodalMotion<'_, D, N>, sum: &mut Momentum<D, N>) {
        let marker = self.marker.lift();
        let (m, j) = (N::of(self.moved()), N::of(self.inertia));
        let (at, d) = (marker.position(motion.x), marker.direction(motion.x));
        let (p, s) = (
            marker.position(motion.v) * m,
            marker.direction(motion.v) * j,
        );
        sum.add(at, p, true);
        sum.add(d, s, false);
    }

    fn add_center<N: Number>(
        &self,
        _drives: &[[N; 3]],
        x: &[Node<D, N>],
        sum: &mut Vector<D, N>,
    ) -> N {
        *sum += self.marker.lift().position(x) * N::of(self.mass);
        N::of(0.0)
    }

    fn linearize(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        if at.rotation == [0.0; 3] {
            return;
        }
        let marker = self.marker;
        let nodes = &marker.nodes[..if marker.is_nodal() { 1 } else { 2 }];
        let mut nodal = vec![no_node(); at.motion.x.len()];
        terms.add_coriolis(nodes, at, |x, a, b| {
            nodal[b] = x;
            let position: Vector<D> = marker.position(&nodal) * self.moved();
            let direction = marker.direction(&nodal) * self.inertia;
            nodal[b] = no_node();
            let forces = marker.forces(position, direction);
            forces[usize::from(a != nodes[0])].1
        });
    }
}

impl LumpedMass {
    /// Adds its mass times a matrix over the axes of space.
    fn add_mass_along<const D: usize>(
        &self,
        axes: &SMatrix<f64, D, D>,
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        for (part, size) in [self.moved(), self.inertia].into_iter().enumerate() {
            self.marker
                .for_each_block(part, &(axes * size), |a, b, block| {
                    assembly.add(a, b, block, matrix);
                });
        }
    }
}
