//! What every kind of body does. A kind implements [`BodyPart`] in a file of its own and stands once in [`each`]; [`Bodies`](super::Bodies)
//! goes through the kinds list by list, so there is no virtual call.

use nalgebra::{SMatrix, Vector3};

use super::assembly::{Assembly, Links, NodeBlock};
use super::connectivity::Node;
use super::frame::Derivative;
use super::linearized::{LinearTerms, LinearizationPoint};
use super::map::Rotations;
use super::setup::NodeNumber;
use super::stages::RotatingNodes;
use crate::math::jet::Number;
use crate::math::rotation::Quaternion;
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
        for $body in &$bodies.rigid {
            $run;
        }
        for $body in &$bodies.reduced {
            $run;
        }
        for $body in &$bodies.sections {
            $run;
        }
    }};
}
pub(super) use each;

/// A kind of body, or a part of bodies that several kinds have: a line, a mass in a point, a rigid body of space, the sections along a
/// line. What a kind does not implement it does not have.
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

    /// Marks how its nodes rotate between the stages of a step. Sections come after lines.
    fn mark_rotating(&self, _rotating: &mut RotatingNodes) {}

    /// Number of frames that a state holds of it.
    fn frame_count(&self) -> usize {
        0
    }

    /// Takes rotations, which `x` holds before in their places, to axes. Rotations count from the frames `from` of a state.
    fn place(&self, _from: &[Quaternion], _rotations: &mut Rotations, _x: &mut [Node<D>]) {}

    /// Takes rates of rotations, which `v` holds before in their places, to rates of axes.
    fn place_rates(&self, _x: &[Node<D>], _rotations: &mut Rotations, _v: &mut [Node<D>]) {}

    /// Takes small rotations about axes, which `dx` holds before in their places, to changes of axes.
    fn place_changes<N: Number>(&self, _x: &[Node<D, N>], _dx: &mut [Node<D, N>]) {}

    /// Adds to accelerations of axes what rates alone ask for.
    fn add_centripetal<N: Number>(&self, _motion: NodalMotion<'_, D, N>, _a: &mut [Node<D, N>]) {}

    /// Takes forces on axes to moments, with rates less what these ask for.
    fn pull_back<N: Number>(
        &self,
        _motion: (&[Node<D, N>], Option<&[Node<D, N>]>),
        _f: &mut [Node<D, N>],
    ) {
    }

    /// Adds the moments of sections to what is pulled back.
    fn add_torques<N: Number>(&self, _torques: &[[N; 3]], _f: &mut [Node<D, N>]) {}

    /// Converts changes of `q` between spins, or their derivatives, and rotations from the frames of the state.
    fn convert(&self, _order: Derivative, _at: &Rotations, _q: &mut [f64]) {}

    /// [`BodyPart::convert`] over the free coordinates `y`, where nodal vectors count as well.
    fn convert_free(
        &self,
        _order: Derivative,
        _at: &Rotations,
        _nodal: &[Node<D>],
        _y: &mut [f64],
    ) {
    }

    /// Rotation in the coordinates `q`, rad.
    fn rotation_in(&self, _q: &[f64]) -> f64 {
        0.0
    }

    /// Largest rotation that does not stand in `q` alone, rad.
    fn rotation_at(&self, _at: &Rotations) -> f64 {
        0.0
    }

    /// Rotations in `q` begin at zero anew, and rates in `v` become spins.
    fn renew(&self, _frames: &mut [Quaternion], _q: &mut [f64], _v: &mut [f64]) {}

    /// Rotations over the free coordinates begin at zero anew, and rates become spins.
    fn renew_free(
        &self,
        _at: (&[Node<D>], &Rotations),
        _frames: &mut [Quaternion],
        _free: [&mut [f64]; 2],
    ) {
    }

    /// Calls with the geometric stiffness of forces on axes, pair by pair of nodes that have coordinates.
    fn for_each_geometric(
        &self,
        _f: &[Node<D>],
        _x: &[Node<D>],
        _add: &mut impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
    }

    /// Adds its mass over the free coordinates.
    fn add_mass(&self, assembly: &Assembly<D>, mass: &mut Matrix<f64>);

    /// Adds its mass times a matrix over the axes of space to a stiffness over the free coordinates.
    fn add_mass_times(
        &self,
        _axes: &SMatrix<f64, D, D>,
        _x: &[Node<D>],
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
    fn add_spin_momentum(&self, _motion: (&[Node<D>], &[Node<D>]), _momentum: &mut [Node<D>]) {}

    /// Adds the forces of gravity (m/s^2), N.
    fn add_weight(&self, _gravity: &Vector<D>, _f: &mut [Node<D>]) {}

    /// Adds elastic and damping forces to those on nodes, N, and to moments of sections, N m. Returns the power that damping dissipates, W.
    #[inline(always)]
    fn add_force(
        &self,
        _motion: NodalMotion<'_, D>,
        _out: (&mut [Node<D>], &mut [[f64; 3]]),
    ) -> f64 {
        0.0
    }

    /// [`BodyPart::add_force`] of numbers of any kind, element by element.
    fn add_force_of<N: Number>(
        &self,
        _motion: NodalMotion<'_, D, N>,
        _out: (&mut [Node<D, N>], &mut [[N; 3]]),
    ) {
    }

    /// Adds gyroscopic forces of sections that spin.
    #[inline(always)]
    fn add_gyroscopic<N: Number>(&self, _motion: NodalMotion<'_, D, N>, _f: &mut [Node<D, N>]) {}

    /// Adds what a frame of the scene that rotates, rad/s, adds to the inertia of spins.
    fn add_frame_spin<N: Number>(
        &self,
        _motion: NodalMotion<'_, D, N>,
        _rotation: [f64; 3],
        _f: &mut [Node<D, N>],
    ) {
    }

    /// Adds stiffness and damping over the free coordinates.
    #[inline(always)]
    fn add_tangent(
        &self,
        _motion: NodalMotion<'_, D>,
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
    fn kinetic_beside<N: Number>(&self, _motion: NodalMotion<'_, D, N>) -> N {
        N::of(0.0)
    }

    /// Kinetic energy of the spins that a frame of the scene which rotates, rad/s, gives to sections, J.
    fn frame_spin_energy<N: Number>(&self, _x: &[Node<D, N>], _rotation: [f64; 3]) -> N {
        N::of(0.0)
    }

    /// Strain energy, J.
    fn strain_energy<N: Number>(&self, _drives: &[[N; 3]], _x: &[Node<D, N>]) -> N {
        N::of(0.0)
    }

    /// Calls with strain energies, J, of every element at two configurations at the reference length.
    fn for_each_strain_energy(&self, _x: [&[Node<D>]; 2], _call: &mut impl FnMut([f64; 2])) {}

    /// Power that damping dissipates, W.
    fn dissipation<N: Number>(&self, _motion: NodalMotion<'_, D, N>) -> N {
        N::of(0.0)
    }

    /// Adds its momentum.
    fn add_momentum<N: Number>(&self, motion: NodalMotion<'_, D, N>, sum: &mut Momentum<D, N>);

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
    fn linearize(&self, _at: &mut LinearizationPoint<'_, D>, _terms: &mut LinearTerms) {}

    /// Adds stiffness and damping of its elements to the linearized equations of motion.
    fn linearize_elements(&self, _at: &mut LinearizationPoint<'_, D>, _terms: &mut LinearTerms) {}
}
