//! Inertia, internal forces and their tangents of all bodies.

use super::Bodies;
use super::assembly::{Assembly, NodeBlock};
use super::body::{BodyPart, NodalMotion, each};
use super::connectivity::{Node, no_node, node_frame_acceleration};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::math::sparse::Matrix;

impl<const D: usize> Bodies<D> {
    /// Mass, kg.
    pub fn mass(&self) -> f64 {
        let mut mass = 0.0;
        each!(self, |body| mass += BodyPart::<D>::mass(body));
        mass
    }

    /// `f += s M a` over the nodes.
    pub fn add_inertia<N: Number>(&self, s: f64, a: &[Node<D, N>], f: &mut [Node<D, N>]) {
        each!(self, |body| BodyPart::add_inertia(body, s, a, f));
    }

    /// `f += M a` with cables as long as they are.
    pub fn add_inertia_now(&self, drives: &[[f64; 3]], a: &[Node<D>], f: &mut [Node<D>]) {
        each!(self, |body| BodyPart::add_inertia_now(body, drives, a, f));
    }

    /// `M dx` of a displacement or velocity at coordinates `x`, in terms of what is integrated.
    pub fn momentum_of(&self, dx: &[Node<D>], x: &[Node<D>], momentum: &mut [Node<D>]) {
        momentum.fill(no_node());
        self.add_inertia(1.0, dx, momentum);
        let motion = (x, dx);
        each!(self, |body| BodyPart::add_spin_momentum(
            body, motion, momentum
        ));
        each!(self, |body| BodyPart::pull_back(body, (x, None), momentum));
    }

    /// Returns the forces of gravity on the nodes, N, `[nodes]`.
    pub fn weight(&self, gravity: Vector<D>) -> Vec<Node<D>> {
        let mut weight = vec![no_node(); self.reference.len()];
        each!(self, |body| BodyPart::add_weight(
            body,
            &gravity,
            &mut weight
        ));
        weight
    }

    /// Adds the forces of bodies on their nodes to `f`: elastic and damping forces, and what a cable on a winch has more of than its
    /// reference. `torques` become the moments of sections, N m; `other` is scratch. Returns the power that damping dissipates, W.
    #[inline(always)]
    pub fn add_forces(
        &self,
        motion: NodalMotion<'_, D>,
        (f, torques): (&mut [Node<D>], &mut [[f64; 3]]),
        other: &mut [Node<D>],
    ) -> f64 {
        let mut dissipated = 0.0;
        if self.pays_out {
            self.add_paid_out_forces(motion, other, f);
        }
        torques.fill([0.0; 3]);
        each!(self, |body| {
            dissipated += BodyPart::add_force(body, motion, (&mut *f, &mut *torques));
        });
        dissipated
    }

    /// [`Self::add_forces`] of numbers of any kind, element by element; without elastic forces if nothing moves.
    pub fn add_forces_of<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        (f, torques): (&mut [Node<D, N>], &mut [[N; 3]]),
        other: &mut [Node<D, N>],
        is_elastic: bool,
    ) {
        if self.pays_out {
            self.add_paid_out_forces(motion, other, f);
        }
        torques.fill([N::of(0.0); 3]);
        if is_elastic {
            each!(self, |body| {
                BodyPart::add_force_of(body, motion, (&mut *f, &mut *torques));
            });
        }
    }

    /// Adds the inertial forces of a scene's frame that rotates at a rate, rad/s, to forces on nodes: centrifugal and Coriolis forces, and
    /// moments on sections that spin. `other` is scratch.
    pub fn add_frame_inertia<N: Number>(
        &self,
        rotation: [f64; 3],
        motion: NodalMotion<'_, D, N>,
        other: &mut [Node<D, N>],
        f: &mut [Node<D, N>],
    ) {
        for (carried, (x, v)) in other.iter_mut().zip(motion.x.iter().zip(motion.v)) {
            *carried = node_frame_acceleration(rotation, x, v);
        }
        self.add_inertia(-1.0, other, f);
        each!(self, |body| BodyPart::add_frame_spin(
            body, motion, rotation, f
        ));
    }

    /// Adds stiffness and damping of bodies to matrices over the free coordinates.
    #[inline(always)]
    pub fn add_tangent(
        &self,
        motion: NodalMotion<'_, D>,
        assembly: &Assembly<D>,
        [stiffness, damping]: [&mut Matrix<f64>; 2],
    ) {
        each!(self, |body| {
            let matrices = [&mut *stiffness, &mut *damping];
            BodyPart::add_tangent(body, motion, assembly, matrices);
        });
    }

    /// Adds the geometric stiffness of forces on axes that rotate, over the nodes, to a matrix over the free coordinates.
    pub fn add_geometric(
        &self,
        forces: &[Node<D>],
        x: &[Node<D>],
        assembly: &Assembly<D>,
        stiffness: &mut Matrix<f64>,
    ) {
        let mut add = |a: usize, b: usize, block: &NodeBlock<D>| {
            assembly.add(a, b, block, stiffness);
        };
        each!(self, |body| BodyPart::for_each_geometric(
            body, forces, x, &mut add
        ));
    }

    /// Returns the mass over the free coordinates.
    pub fn mass_matrix(&self, assembly: &Assembly<D>) -> Matrix<f64> {
        let mut mass = Matrix::zeros(assembly.pattern());
        each!(self, |body| BodyPart::add_mass(body, assembly, &mut mass));
        mass
    }
}
