//! Inertia, internal forces and their tangents of all bodies.

use nalgebra::SMatrix;

use super::assembly::{Assembly, NodeBlock, no_block};
use super::connectivity::{Node, carried_node, no_node};
use super::frame::RigidBodyFrame;
use super::{Bodies, LineChain, LumpedMass};
use crate::math::jet::Number;
use crate::math::space::{Vector, spin_matrix};
use crate::math::sparse::Matrix;

impl<const D: usize> Bodies<D> {
    /// Mass, kg.
    pub fn mass(&self) -> f64 {
        let chains: f64 = self.chains.iter().map(LineChain::mass).sum();
        let frames = self.frames.list().iter().map(|frame| frame.mass);
        let lumps = self.lumped_masses.iter().map(|lump| lump.mass);
        chains + lumps.chain(frames).sum::<f64>()
    }

    /// `f += s M a` over the nodes.
    pub fn add_inertia<N: Number>(&self, s: f64, a: &[Node<D, N>], f: &mut [Node<D, N>]) {
        for chain in &self.chains {
            chain.add_inertia(N::of(s), a, f);
        }
        self.add_rigid_inertia(s, a, f);
    }

    /// `f += M a` with cables as long as they are.
    pub fn add_inertia_now(&self, drives: &[[f64; 3]], a: &[Node<D>], f: &mut [Node<D>]) {
        for chain in &self.chains {
            chain.add_inertia(chain.length_now(drives).longer_by(), a, f);
        }
        self.add_rigid_inertia(1.0, a, f);
    }

    /// `f += s M a` of all but cables.
    fn add_rigid_inertia<N: Number>(&self, s: f64, a: &[Node<D, N>], f: &mut [Node<D, N>]) {
        for lump in &self.lumped_masses {
            let marker = lump.marker.lift();
            let at: Vector<D, N> = marker.position(a) * N::of(s * lump.moved());
            let on = marker.direction(a) * N::of(s * lump.inertia);
            marker.add_force(at, on, f);
        }
        for frame in self.frames.list() {
            frame.add_inertia(s, a, f);
        }
    }

    /// `M dx` of a displacement or velocity at coordinates `x`, in terms of what is integrated.
    pub fn momentum_of(&self, dx: &[Node<D>], x: &[Node<D>], momentum: &mut [Node<D>]) {
        momentum.fill(no_node());
        self.add_inertia(1.0, dx, momentum);
        for chain in &self.rod_chains {
            chain.add_spin_inertia((x, dx), &self.frames, momentum);
        }
        self.frames.pull_back((x, None), momentum);
    }

    /// Returns the forces of gravity on the nodes, N, `[nodes]`.
    pub fn weight(&self, gravity: Vector<D>) -> Vec<Node<D>> {
        let mut weight = vec![no_node(); self.reference.len()];
        for chain in &self.chains {
            chain.add_weight(&gravity, &mut weight);
        }
        for lump in &self.lumped_masses {
            let force = gravity * lump.mass;
            lump.marker.add_force(force, Vector::zeros(), &mut weight);
        }
        for frame in self.frames.list() {
            weight[frame.node][0] = (gravity * frame.mass).into();
        }
        weight
    }

    /// Adds the forces of bodies on their nodes to `f`: elastic and damping forces, and what a cable on a winch has more of than its
    /// reference. `torques` become the moments of sections, N m; `other` is scratch. Returns the power that damping dissipates, W.
    #[inline(always)]
    pub fn add_forces(
        &self,
        drives: &[[f64; 3]],
        motion: (&[Node<D>], &[Node<D>]),
        (f, torques): (&mut [Node<D>], &mut [[f64; 3]]),
        other: &mut [Node<D>],
    ) -> f64 {
        let mut dissipated = 0.0;
        if self.pays_out {
            self.add_lengthening(drives, motion, other, f);
        }
        for chain in &self.chains {
            let longer = chain.length_now(drives).longer();
            dissipated += chain.add_force(motion, longer, f);
        }
        if !self.rod_chains.is_empty() {
            torques.fill([0.0; 3]);
        }
        for chain in &self.rod_chains {
            dissipated += chain.add_force(motion, &self.frames, (&mut *f, &mut *torques));
        }
        dissipated
    }

    /// [`Self::add_forces`] of numbers of any kind, element by element; without elastic forces if nothing moves.
    pub fn add_forces_of<N: Number>(
        &self,
        drives: &[[N; 3]],
        motion: (&[Node<D, N>], &[Node<D, N>]),
        (f, torques): (&mut [Node<D, N>], &mut [[N; 3]]),
        other: &mut [Node<D, N>],
        is_elastic: bool,
    ) {
        if self.pays_out {
            self.add_lengthening(drives, motion, other, f);
        }
        torques.fill([N::of(0.0); 3]);
        if !is_elastic {
            return;
        }
        for chain in &self.chains {
            let longer = chain.length_now(drives).longer();
            chain.add_force_of(motion, longer, f);
        }
        for chain in &self.rod_chains {
            chain.add_force_of(motion, &self.frames, (&mut *f, &mut *torques));
        }
    }

    /// Adds the inertial forces of a scene's frame that rotates at a rate, rad/s, to forces on nodes: centrifugal and Coriolis forces, and
    /// moments on sections that spin. `other` is scratch.
    pub fn add_frame_inertia<N: Number>(
        &self,
        rotation: [f64; 3],
        motion @ (x, v): (&[Node<D, N>], &[Node<D, N>]),
        other: &mut [Node<D, N>],
        f: &mut [Node<D, N>],
    ) {
        for (carried, (x, v)) in other.iter_mut().zip(x.iter().zip(v)) {
            *carried = carried_node(rotation, x, v);
        }
        self.add_inertia(-1.0, other, f);
        for chain in &self.rod_chains {
            chain.add_turning(motion, rotation, &self.frames, f);
        }
    }

    /// Adds stiffness and damping of bodies to matrices over the free coordinates.
    #[inline(always)]
    pub fn add_tangent(
        &self,
        drives: &[[f64; 3]],
        motion: (&[Node<D>], &[Node<D>]),
        assembly: &Assembly<D>,
        (stiffness, damping): (&mut Matrix<f64>, &mut Matrix<f64>),
    ) {
        for chain in &self.chains {
            let longer = chain.length_now(drives).longer();
            let matrices = (&mut *stiffness, &mut *damping);
            chain.add_tangent(motion, longer, assembly, matrices);
        }
        for chain in &self.rod_chains {
            let matrices = [&mut *stiffness, &mut *damping];
            chain.add_tangent(motion, &self.frames, assembly, matrices);
        }
    }

    /// Returns the mass over the free coordinates.
    pub fn mass_matrix(&self, assembly: &Assembly<D>) -> Matrix<f64> {
        let mut mass = Matrix::zeros(assembly.pattern());
        self.add_linear_mass(&SMatrix::identity(), assembly, &mut mass);
        for chain in &self.rod_chains {
            chain.add_mass(assembly, &mut mass);
        }
        for frame in self.frames.list() {
            let mut block = no_block();
            for axis in 0..D {
                block[0][axis][0][axis] = frame.mass;
                block[1][axis][1][axis] = frame.moments[axis];
            }
            assembly.add(frame.node, frame.node, &block, &mut mass);
        }
        mass
    }

    /// Adds the stiffness of the centrifugal force at a rotation of the scene's frame, rad/s: the square of its matrix times the mass.
    pub fn add_centrifugal(
        &self,
        rotation: [f64; 3],
        x: &[Node<D>],
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        let spin = spin_matrix::<D>(rotation);
        let axes = spin * spin;
        self.add_linear_mass(&axes, assembly, matrix);
        for (node, part, mass) in self.frames.list().iter().flat_map(RigidBodyFrame::masses) {
            let mut block: NodeBlock<D> = no_block();
            for (r, c) in (0..D).flat_map(|r| (0..D).map(move |c| (r, c))) {
                block[part][r][part][c] = mass * axes[(r, c)];
            }
            self.pull_block((node, node), &block, (x, &[]), |a, b, block| {
                assembly.add(a, b, block, matrix);
            });
        }
    }

    /// Adds the mass of lines and of lumped masses, times a matrix over the axes, to a matrix over the free coordinates.
    fn add_linear_mass(
        &self,
        axes: &SMatrix<f64, D, D>,
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        for chain in &self.chains {
            chain.add_mass(axes, assembly, matrix);
        }
        for LumpedMass {
            marker,
            mass,
            added,
            inertia,
        } in &self.lumped_masses
        {
            for (part, size) in [mass + added, *inertia].into_iter().enumerate() {
                marker.for_each_block(part, &(axes * size), |a, b, block| {
                    assembly.add(a, b, block, matrix);
                });
            }
        }
    }
}
