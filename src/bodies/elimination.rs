//! Elimination of all linear constraints: coordinates `q` with `x = x_ref + T q`, `Phi T = 0` and
//! `T^T M T = I`, so that `q'' = T^T F`.
//!
//! The QR of the constraints gives `x = N y` (see `connectivity`); the Cholesky factor of the mass over
//! the free coordinates, `N^T M N = W W^T`, converts that into `T = N W^-T`. Both are sparse and applied,
//! never formed: O(nodes). With `M = L L^T` this is the same `T` as `L^-T Q2` from `L^-1 Phi^T = Q R`, up
//! to a rotation of `q`, at a third of the cost (docs/decisions/0001-mass-weighted-elimination.md and
//! 0008-nodes-clusters-cholesky.md).
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), sections 5-6.

use super::assembly::Assembly;
use super::connectivity::Node;
use crate::math::sparse::{Cholesky, Matrix, Reach};

/// The transformation `T`.
#[derive(Clone, Debug)]
pub struct Elimination<const D: usize = 2> {
    /// Nodal coordinates from free ones.
    pub assembly: Assembly<D>,
    /// Mass over the free coordinates, kg; nothing at multipliers.
    pub mass: Matrix<f64>,
    /// `W`.
    factor: Cholesky,
}

impl<const D: usize> Elimination<D> {
    /// With this mass over the free coordinates. `None` where it is not positive definite.
    pub fn new(assembly: Assembly<D>, mass: Matrix<f64>) -> Option<Self> {
        let of_mass = mass.part(assembly.pattern(), assembly.of_mass());
        let factor = Cholesky::new(assembly.of_mass(), &of_mass)?;
        Some(Self {
            assembly,
            mass,
            factor,
        })
    }

    /// Number of independent coordinates `q`.
    pub fn coordinates(&self) -> usize {
        self.assembly.free()
    }

    /// Length of the scratch vector `y` of the calls below.
    pub fn scratch(&self) -> usize {
        self.assembly.free()
    }

    /// `x = T q`, for rates and increments alike.
    pub fn expand(&self, q: &[f64], y: &mut [f64], x: &mut [Node<D>]) {
        self.displacements(q, y);
        self.assembly.prolong(y, x);
    }

    /// `x = start + T q`.
    pub fn expand_from(&self, start: &[Node<D>], q: &[f64], y: &mut [f64], x: &mut [Node<D>]) {
        self.displacements(q, y);
        self.assembly.prolong_from(start, y, x);
    }

    /// `q = T^T f`.
    pub fn reduce(&self, f: &[Node<D>], y: &mut [f64], q: &mut [f64]) {
        self.assembly.restrict(f, y);
        self.project(y, q);
    }

    /// Applies `T^T` to a force on one node. Returns the nonzero entries in order, as pairs of index and value. Work is
    /// limited to the entries that the force reaches. `y` is scratch that must hold zeros, and holds zeros again on
    /// return.
    pub fn reduce_node(&self, node: usize, f: &Node<D>, y: &mut [f64]) -> Vec<(usize, f64)> {
        self.assembly.restrict_node(node, f, y);
        let reach = self.assembly.reach_of_node(node, &self.factor);
        self.project_within(&reach, y);
        let mut found = Vec::new();
        for place in reach.variables.into_iter().flatten() {
            let value = std::mem::take(&mut y[place]);
            if value != 0.0 {
                found.push((place, value));
            }
        }
        found
    }

    /// Free coordinates `y = W^-T q`.
    pub fn displacements(&self, q: &[f64], y: &mut [f64]) {
        self.factor.backward(self.assembly.of_mass(), q, y);
    }

    /// `q = W^-1 y` of forces `y` on the free coordinates.
    pub fn project(&self, y: &[f64], q: &mut [f64]) {
        q.copy_from_slice(y);
        self.factor.forward(self.assembly.of_mass(), q);
    }

    /// Returns the nonzero variables of `W^-1 y` for the forces `y` of a constraint.
    pub fn reach(&self, constraint: usize) -> Reach {
        self.assembly.reach(constraint, &self.factor)
    }

    /// `y <- W^-1 y` where it is not zero.
    pub fn project_within(&self, reach: &Reach, y: &mut [f64]) {
        self.factor
            .forward_within(self.assembly.of_mass(), reach, y);
    }

    /// `x <- W^-1 x`.
    pub fn project_in_place(&self, x: &mut [f64]) {
        self.factor.forward(self.assembly.of_mass(), x);
    }

    /// Forces on the free coordinates from those on `q`: `y <- W y`.
    pub fn forces(&self, y: &mut [f64]) {
        self.factor.multiply(self.assembly.of_mass(), y);
    }

    /// Displacements `q` from those of the free coordinates: `y <- W^T y`.
    pub fn coordinates_of(&self, y: &mut [f64]) {
        self.factor.multiply_transposed(self.assembly.of_mass(), y);
    }
}
