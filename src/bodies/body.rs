//! What every kind of body does. A kind implements [`BodyPart`] in a file of its own and stands once in [`each`]; [`Bodies`](super::Bodies)
//! goes through the kinds list by list, so there is no virtual call.

use nalgebra::{SMatrix, Vector3};

use super::assembly::{Assembly, Links};
use super::connectivity::Node;
use super::frame::RotationMaps;
use super::linearized::{LinearTerms, LinearizationPoint};
use super::setup::NodeNumber;
use super::stages::RotatingNodes;
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::math::sparse::Matrix;

/// Configuration and rates of all bodies at an instant.
#[derive(Clone, Copy, Debug)]
pub struct NodalMotion<'a, const D: usize, N = f64> {
    /// Driven coordinates with two time derivatives, `[drives][3]`.
    pub drives: &'a [[N; 3]],
    /// Nodal coordinates, `[nodes]`, m.
    pub x: &'a [Node<D, N>],
    /// Rates of the nodal coordinates, `[nodes]`.
    pub v: &'a [Node<D, N>],
}

impl<'a, const D: usize, N> NodalMotion<'a, D, N> {
    /// Nodal coordinates and their rates.
    #[inline(always)]
    pub fn pair(&self) -> (&'a [Node<D, N>], &'a [Node<D, N>]) {
        (self.x, self.v)
    }
}

/// Momentum of bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Momentum<const D: usize, N> {
    /// Momentum, kg m/s.
    pub linear: Vector<D, N>,
    /// Angular momentum about the origin, kg m^2/s.
    pub angular: Vector3<N>,
}

/// Runs an expression for every body, kind by kind.
macro_rules! each {
    ($bodies:expr, |$body:ident| $run:expr) => {{
        for $body in &$bodies.lines {
            $run;
        }
        for $body in &$bodies.masses {
            $run;
        }
        for $body in $bodies.frames.list() {
            $run;
        }
        for $body in &$bodies.sections {
            $run;
        }
    }};
}
pub(super) use each;

/// A kind of body, or a part of bodies that several kinds have: a line, a mass in a point, a rigid body of space, the sections along a
/// line. What a kind does not implement it does not have. `maps` are the rotations of all bodies.
pub(super) trait BodyPart<const D: usize> {
    /// Mass, kg.
    fn mass(&self) -> f64 {
        0.0
    }

    /// Cost of an evaluation, in that of an element of a line.
    fn cost(&self) -> usize {
        0
    }

    /// Whether it dissipates.
    fn is_damped(&self) -> bool {
        false
    }

    /// Adds pairs of nodes that its mass and its internal forces couple.
    fn add_links(&self, links: &mut Links);

    /// Puts what has rotated or is twisted into the place where it has not.
    fn unplace(&self, _nodes: &mut [Node<D>]) {}

    /// Adds numbers of its nodes that are no coordinates, with their values in `unplaced` nodes.
    fn add_fixed_numbers(&self, _unplaced: &[Node<D>], _fixed: &mut Vec<(NodeNumber, f64)>) {}

    /// Sets the nodes whose coordinates a force on each of its nodes acts on.
    fn set_owners(&self, _owners: &mut [[usize; 2]]) {}

    /// Marks how its nodes rotate between the stages of a step. Sections come after lines.
    fn mark_rotating(&self, _rotating: &mut RotatingNodes) {}

    /// Adds its mass over the free coordinates.
    fn add_mass(&self, assembly: &Assembly<D>, mass: &mut Matrix<f64>);

    /// Adds its mass times a matrix over the axes of space to a stiffness over the free coordinates.
    fn add_mass_times(
        &self,
        _axes: &SMatrix<f64, D, D>,
        _at: (&RotationMaps, &[Node<D>]),
        _assembly: &Assembly<D>,
        _matrix: &mut Matrix<f64>,
    ) {
    }

    /// `f += s M a`, with axes of rigid bodies as coordinates.
    fn add_inertia<N: Number>(&self, _s: f64, _a: &[Node<D, N>], _f: &mut [Node<D, N>]) {}

    /// `f += M a` of the mass that it has at the time.
    fn add_inertia_now(&self, _drives: &[[f64; 3]], a: &[Node<D>], f: &mut [Node<D>]) {
        self.add_inertia(1.0, a, f);
    }

    /// Adds the momentum conjugate to spins of sections, where a velocity or displacement is `dx`.
    fn add_spin_momentum(
        &self,
        _motion: (&[Node<D>], &[Node<D>]),
        _maps: &RotationMaps,
        _momentum: &mut [Node<D>],
    ) {
    }

    /// Adds the forces of gravity (m/s^2), N.
    fn add_weight(&self, _gravity: &Vector<D>, _f: &mut [Node<D>]) {}

    /// Adds elastic and damping forces to those on nodes, N, and to moments of sections, N m. Returns the power that damping dissipates, W.
    #[inline(always)]
    fn add_force(
        &self,
        _motion: NodalMotion<'_, D>,
        _maps: &RotationMaps,
        _out: (&mut [Node<D>], &mut [[f64; 3]]),
    ) -> f64 {
        0.0
    }

    /// [`BodyPart::add_force`] of numbers of any kind, element by element.
    fn add_force_of<N: Number>(
        &self,
        _motion: NodalMotion<'_, D, N>,
        _maps: &RotationMaps,
        _out: (&mut [Node<D, N>], &mut [[N; 3]]),
    ) {
    }

    /// Adds gyroscopic forces of sections that spin.
    #[inline(always)]
    fn add_gyroscopic<N: Number>(
        &self,
        _motion: NodalMotion<'_, D, N>,
        _maps: &RotationMaps,
        _f: &mut [Node<D, N>],
    ) {
    }

    /// Adds what a frame of the scene that rotates, rad/s, adds to the inertia of spins.
    fn add_frame_spin<N: Number>(
        &self,
        _motion: NodalMotion<'_, D, N>,
        _rotation: [f64; 3],
        _maps: &RotationMaps,
        _f: &mut [Node<D, N>],
    ) {
    }

    /// Adds stiffness and damping over the free coordinates.
    #[inline(always)]
    fn add_tangent(
        &self,
        _motion: NodalMotion<'_, D>,
        _maps: &RotationMaps,
        _assembly: &Assembly<D>,
        _matrices: [&mut Matrix<f64>; 2],
    ) {
    }

    /// Adds `x^T M x` of vectors over the nodes that are mapped one by one; nothing of what a winch pays out.
    fn add_quadratic<N: Number>(
        &self,
        _x: &[Node<D, N>],
        _map: &impl Fn(Vector<D, N>) -> Vector<D, N>,
        _sum: &mut N,
    ) {
    }

    /// Kinetic energy that is not half of [`BodyPart::add_quadratic`] of the rates, J.
    fn kinetic_beside<N: Number>(&self, _motion: NodalMotion<'_, D, N>, _maps: &RotationMaps) -> N {
        N::of(0.0)
    }

    /// Kinetic energy of the spins that a frame of the scene which rotates, rad/s, gives to sections, J.
    fn frame_spin_energy<N: Number>(
        &self,
        _x: &[Node<D, N>],
        _rotation: [f64; 3],
        _maps: &RotationMaps,
    ) -> N {
        N::of(0.0)
    }

    /// Strain energy, J.
    fn strain_energy<N: Number>(&self, _drives: &[[N; 3]], _x: &[Node<D, N>]) -> N {
        N::of(0.0)
    }

    /// Calls with strain energies, J, of every element at two configurations at the reference length.
    fn for_each_strain_energy(&self, _x: [&[Node<D>]; 2], _call: &mut impl FnMut([f64; 2])) {}

    /// Power that damping dissipates, W.
    fn dissipation<N: Number>(&self, _motion: NodalMotion<'_, D, N>, _maps: &RotationMaps) -> N {
        N::of(0.0)
    }

    /// Adds its momentum.
    fn add_momentum<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        maps: &RotationMaps,
        sum: &mut Momentum<D, N>,
    );

    /// Adds mass times centre of mass, kg m. Returns the mass now less the mass at reference, kg.
    fn add_center<N: Number>(
        &self,
        _drives: &[[N; 3]],
        _x: &[Node<D, N>],
        _sum: &mut Vector<D, N>,
    ) -> N {
        N::of(0.0)
    }

    /// Adds what is not elastic to the linearized equations of motion: gyroscopic and Coriolis terms, geometric stiffness.
    fn linearize(
        &self,
        _at: &mut LinearizationPoint<'_, D>,
        _maps: &RotationMaps,
        _terms: &mut LinearTerms,
    ) {
    }

    /// Adds stiffness and damping of its elements to the linearized equations of motion.
    fn linearize_elements(
        &self,
        _at: &mut LinearizationPoint<'_, D>,
        _maps: &RotationMaps,
        _terms: &mut LinearTerms,
    ) {
    }
}
