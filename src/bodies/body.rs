//! What every kind of body does. A kind implements [`BodyPart`] in a file of its own and stands once in [`each`]; [`Bodies`](super::Bodies)
//! goes through the kinds list by list, so there is no virtual call.
//!
//! Terms, with more in `docs/NOTATION.md`:
//!
//! - `x` are nodal coordinates. Each node has two vectors: a position and a direction, or two axes, or numbers inside an element. `v` are
//!   their rates, `a` their accelerations, `f` the forces on them.
//! - `y` are free coordinates: those of the nodes that linear constraints leave free. Where axes rotate, rotations are among them, and the
//!   axes follow.
//! - `q` are the coordinates that are integrated: the displacement of `y` from the reference, transformed so that its inertia is the identity.
//! - A *frame* is a unit quaternion that the state stores for a rigid body in space or for a section in space.
//! - A *rotation* leads from the stored frame to the present axes: three numbers, of a section of a rod one, about its tangent. It is nearly
//!   an angle, in rad, and begins at zero wherever the frame is renewed.
//! - A *spin* is an angular velocity along these axes, of a section of a rod about its tangent, rad/s.

use nalgebra::Vector3;

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
    /// Coordinates from which a linear step led here, whose predicted stress tangents take: of a search for an equilibrium.
    pub from: Option<&'a [Node<D, N>]>,
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
        for $body in &$bodies.patches {
            $run;
        }
        for $body in &$bodies.sections {
            $run;
        }
    }};
}
pub(super) use each;

/// A kind of body, or a part of bodies that several kinds have: a line, a mass in a point, a rigid body of space, the sections along a
/// line.
///
/// Each default means that the part contributes nothing. Only that of [`BodyPart::add_inertia_now`] falls back on another item. The compiler
/// does not see that an item is missing, and results are then wrong. By groups, a part implements:
///
/// - Building: `add_links`, `cost`, and `tangent_cost` where tangents are dearer than those of lines. Damped parts implement `is_damped`. Parts with constant node entries implement `unplace` and
///   `add_fixed_numbers`, those with frames `frame_count`. Parts with stiffness or with nodes of sections implement `mark_rotating`.
/// - Map, where axes follow from rotations: `place`, `place_rates`, `place_changes`, `add_centripetal`, `pull_back`, `for_each_geometric`.
///   Rotations that `q` alone tells need `convert`, `rotation_in` and `renew`. Those of sections need `convert_free`, `rotation_at` and
///   `renew_free`.
/// - Mass: `add_mass`. Mass at nodes needs `mass`, `add_center`, `add_weight`, `add_inertia`, `add_centrifugal` and `add_quadratic`. A mass
///   that changes needs `add_inertia_now` and `kinetic_beside`. Inertia against spins of sections needs `add_spin_momentum`,
///   `add_gyroscopic`, `add_frame_spin`, `frame_spin_energy` and `kinetic_beside`.
/// - Forces, of parts with stiffness: `add_force`, `add_force_of`, `add_tangent`. Moments on sections in space need `add_torques`.
/// - Energies and momenta: `add_momentum`. Parts with stiffness implement `strain_energy` and `for_each_strain_energy`, damped ones
///   `dissipation`.
/// - Linearization: `linearize` of parts with mass or axes, `linearize_elements` of parts with stiffness.
pub(super) trait BodyPart<const D: usize> {
    /// Mass at the reference length, kg.
    fn mass(&self) -> f64 {
        0.0
    }

    /// Cost of one evaluation, where one line element costs 1.
    fn cost(&self) -> usize {
        0
    }

    /// Cost of a tangent beyond that of lines whose evaluation costs as much, in the same unit.
    fn tangent_cost(&self) -> usize {
        0
    }

    /// Whether it dissipates.
    fn is_damped(&self) -> bool {
        false
    }

    /// Adds pairs of nodes that its mass and its internal forces couple.
    fn add_links(&self, links: &mut Links);

    /// Sets its nodes in `nodes` to the unrotated, untwisted reference.
    fn unplace(&self, _nodes: &mut [Node<D>]) {}

    /// Adds node entries that are constant, not unknowns, with their values in the reference (`unplaced`).
    fn add_fixed_numbers(&self, _unplaced: &[Node<D>], _fixed: &mut Vec<(NodeNumber, f64)>) {}

    /// Marks how its nodes rotate between the stages of a step. Sections come after lines.
    fn mark_rotating(&self, _rotating: &mut RotatingNodes) {}

    /// Number of frames (quaternions) that a state stores for it.
    fn frame_count(&self) -> usize {
        0
    }

    /// Computes axes from rotations. On entry `x` holds rotation numbers where axes belong; on return it holds the axes. `from` are the frames
    /// that the state stores. `rotations` keeps the rotations for the other items.
    fn place(&self, _from: &[Quaternion], _rotations: &mut Rotations, _x: &mut [Node<D>]) {}

    /// Computes rates of axes. On entry `v` holds rates of rotations where rates of axes belong; on return it holds the rates of axes.
    fn place_rates(&self, _x: &[Node<D>], _rotations: &mut Rotations, _v: &mut [Node<D>]) {}

    /// Computes changes of axes. On entry `dx` holds small rotations about the axes where changes of axes belong; on return it holds the
    /// changes of axes.
    fn place_changes<N: Number>(&self, _x: &[Node<D, N>], _dx: &mut [Node<D, N>]) {}

    /// Adds the part of the acceleration of axes that is quadratic in rates.
    fn add_centripetal<N: Number>(&self, _motion: NodalMotion<'_, D, N>, _a: &mut [Node<D, N>]) {}

    /// Converts forces on axes into moments. Where rates are given, it also subtracts the quadratic inertia forces of rigid bodies. Those of
    /// sections are in [`BodyPart::add_gyroscopic`].
    fn pull_back<N: Number>(
        &self,
        _motion: (&[Node<D, N>], Option<&[Node<D, N>]>),
        _f: &mut [Node<D, N>],
    ) {
    }

    /// Adds moments on sections in space, N m, to forces that [`BodyPart::pull_back`] has returned. `torques` are along the axes of the
    /// sections, `[section frames][3]`.
    fn add_torques<N: Number>(&self, _torques: &[[N; 3]], _f: &mut [Node<D, N>]) {}

    /// Converts a vector over `q` between spins and rates of rotations. `First` converts spins to rates of rotations, or small rotations about
    /// axes to changes of rotations. `Second` converts rates of spins to second derivatives of rotations. `Back` is the inverse of `First`.
    fn convert(&self, _order: Derivative, _at: &Rotations, _q: &mut [f64]) {}

    /// [`BodyPart::convert`] over the free coordinates `y`, for rotations of sections, which also depend on slopes of the line. `nodal` is the
    /// same vector over the nodes.
    fn convert_free(
        &self,
        _order: Derivative,
        _at: &Rotations,
        _nodal: &[Node<D>],
        _y: &mut [f64],
    ) {
    }

    /// Size of the rotation that the coordinates `q` hold, rad.
    fn rotation_in(&self, _q: &[f64]) -> f64 {
        0.0
    }

    /// Largest rotation of its sections from their stored frames, rad. Sections rotate with their tangents as well, so `q` alone does not tell
    /// it.
    fn rotation_at(&self, _at: &Rotations) -> f64 {
        0.0
    }

    /// Moves the rotation in `q` into the stored frame and sets it to zero; converts rates in `v` to angular velocities.
    fn renew(&self, _frames: &mut [Quaternion], _q: &mut [f64], _v: &mut [f64]) {}

    /// [`BodyPart::renew`] for rotations of sections. `at` holds nodal coordinates and rotations, `free` coordinates and rates over `y`. Rates
    /// become those of rotations from the renewed frames.
    fn renew_free(
        &self,
        _at: (&[Node<D>], &Rotations),
        _frames: &mut [Quaternion],
        _free: [&mut [f64]; 2],
    ) {
    }

    /// Calls `add` with the symmetric geometric stiffness of the forces `f` on axes: two nodes that have coordinates, and their block.
    fn for_each_geometric(
        &self,
        _f: &[Node<D>],
        _x: &[Node<D>],
        _add: &mut impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
    }

    /// Adds its mass over the free coordinates.
    fn add_mass(&self, assembly: &Assembly<D>, mass: &mut Matrix<f64>);

    /// Adds the stiffness of centrifugal forces in a scene described in a frame rotating at `rotation` (rad/s) to a matrix over the free
    /// coordinates: of masses at nodes the mass times the squared matrix of the rotation.
    fn add_centrifugal(
        &self,
        _rotation: [f64; 3],
        _x: &[Node<D>],
        _assembly: &Assembly<D>,
        _matrix: &mut Matrix<f64>,
    ) {
    }

    /// `f += s M a`, with axes of rigid bodies as coordinates; without inertia against spins of sections.
    fn add_inertia<N: Number>(&self, _s: f64, _a: &[Node<D, N>], _f: &mut [Node<D, N>]) {}

    /// `f += M a` with the present mass (a winch pays out).
    fn add_inertia_now(&self, _drives: &[[f64; 3]], a: &[Node<D>], f: &mut [Node<D>]) {
        self.add_inertia(1.0, a, f);
    }

    /// Adds the momentum conjugate to spins of sections. `motion` holds nodal coordinates, and rates or displacements.
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

    /// [`BodyPart::add_force`] for any number type (duals), without vector lanes.
    fn add_force_of<N: Number>(
        &self,
        _motion: NodalMotion<'_, D, N>,
        _out: (&mut [Node<D, N>], &mut [[N; 3]]),
    ) {
    }

    /// Adds gyroscopic forces of sections that spin.
    #[inline(always)]
    fn add_gyroscopic<N: Number>(&self, _motion: NodalMotion<'_, D, N>, _f: &mut [Node<D, N>]) {}

    /// Adds the inertia forces on spins of sections in a scene described in a frame rotating at `rotation` (rad/s).
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

    /// Adds `map(x)^T M map(x)`, where `map` takes each vector of a node. A line that a winch pays out adds nothing.
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

    /// Kinetic energy of the spins that sections have from a frame of the scene rotating at `rotation` (rad/s), J.
    fn frame_spin_energy<N: Number>(&self, _x: &[Node<D, N>], _rotation: [f64; 3]) -> N {
        N::of(0.0)
    }

    /// Strain energy, J.
    fn strain_energy<N: Number>(&self, _drives: &[[N; 3]], _x: &[Node<D, N>]) -> N {
        N::of(0.0)
    }

    /// Calls once per element with its strain energy, J, in configurations `x[0]` and `x[1]`, without winches.
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
