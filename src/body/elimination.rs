//! Elimination of all linear constraints: coordinates `q` with `x = x_ref + T q`, `Phi T = 0` and
//! `T^T M T = I`, so that `q'' = T^T F`.
//!
//! The QR of the constraints gives `x = N y` (see `connectivity`); the Cholesky factor of the mass over
//! the free coordinates, `N^T M N = W W^T`, turns that into `T = N W^-T`. Both are sparse and applied,
//! never formed: O(nodes). With `M = L L^T` this is the same `T` as `L^-T Q2` from `L^-1 Phi^T = Q R`, up
//! to a rotation of `q`, at a third of the cost (docs/decisions/0001-mass-weighted-elimination.md and
//! 0008-nodes-clusters-cholesky.md).
//!
//! As printed, the report takes `M^-1 Phi^T = Q R` and `T = Q2`, `q'' = Q2^T M^-1 F`: then `Phi T` does not
//! vanish and connectivity breaks. That form is kept, dense, to be shown on a chart.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), sections 5-6.

use nalgebra::DMatrix;

use super::assembly::Assembly;
use super::connectivity::Node;
use crate::math::householder::{reflect, reflector};
use crate::math::sparse::{Cholesky, Matrix};
use crate::math::vector::norm;

/// How constraints are eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formulation {
    /// Weighted by the square root of the mass: exact.
    MassWeighted,
    /// Report Eqs. 23-34 as printed, kept to show on a chart that it fails.
    AsPrinted,
}

/// The transformation `T`.
#[derive(Clone, Debug)]
pub struct Elimination<const B: usize> {
    /// Nodal coordinates from free ones.
    pub assembly: Assembly<B>,
    /// Mass over the free coordinates, kg.
    pub mass: Matrix<f64>,
    factor: Factor,
    coordinates: usize,
}

#[derive(Clone, Debug)]
enum Factor {
    MassWeighted(Cholesky),
    AsPrinted {
        expand: DMatrix<f64>,
        reduce: DMatrix<f64>,
    },
}

impl<const B: usize> Elimination<B> {
    /// Exact elimination, with this mass over the free coordinates. `None` where the mass is not
    /// positive definite.
    pub fn new(assembly: Assembly<B>, mass: Matrix<f64>) -> Option<Self> {
        let factor = Factor::MassWeighted(Cholesky::new(assembly.pattern(), &mass)?);
        Some(Self {
            coordinates: assembly.pattern().len(),
            assembly,
            mass,
            factor,
        })
    }

    /// Elimination as printed of these rows over the nodal coordinates (dense), which the assembly
    /// must leave alone. `None` where the mass is not positive definite.
    pub fn as_printed(assembly: Assembly<B>, mass: Matrix<f64>, rows: &[Vec<f64>]) -> Option<Self> {
        let pattern = assembly.pattern();
        let n = pattern.len();
        let cholesky = Cholesky::new(pattern, &mass)?;
        let mut columns: Vec<Vec<f64>> = Vec::new();
        for row in rows {
            let mut column = row.clone();
            cholesky.forward(pattern, &mut column);
            cholesky.backward(pattern, &mut column);
            columns.push(column);
        }
        let mut reflectors: Vec<(Vec<f64>, f64)> = Vec::new();
        for mut column in columns {
            let size = norm(&column);
            for (i, (vector, tau)) in reflectors.iter().enumerate() {
                reflect(vector, *tau, &mut column[i..]);
            }
            let rank = reflectors.len();
            if rank < n && norm(&column[rank..]) > super::RANK_TOLERANCE * size {
                let (tau, _) = reflector(&mut column[rank..]);
                reflectors.push((column[rank..].to_vec(), tau));
            }
        }
        let free = n - reflectors.len();
        let (mut expand, mut reduce) = (DMatrix::zeros(n, free), DMatrix::zeros(free, n));
        for k in 0..free {
            let mut column = vec![0.0; n];
            column[n - free + k] = 1.0;
            for (i, (vector, tau)) in reflectors.iter().enumerate().rev() {
                reflect(vector, *tau, &mut column[i..]);
            }
            expand.column_mut(k).copy_from_slice(&column);
            cholesky.forward(pattern, &mut column);
            cholesky.backward(pattern, &mut column);
            for (c, value) in column.iter().enumerate() {
                reduce[(k, c)] = *value;
            }
        }
        Some(Self {
            assembly,
            mass,
            factor: Factor::AsPrinted { expand, reduce },
            coordinates: free,
        })
    }

    /// Number of independent coordinates `q`.
    pub fn coordinates(&self) -> usize {
        self.coordinates
    }

    /// Length of the scratch vector `y` of the calls below.
    pub fn scratch(&self) -> usize {
        self.assembly.pattern().len()
    }

    /// `x = T q`, for rates and increments alike.
    pub fn expand(&self, q: &[f64], y: &mut [f64], x: &mut [Node<B>]) {
        self.displacements(q, y);
        self.assembly.spread(y, x);
    }

    /// `q = T^T f`.
    pub fn reduce(&self, f: &[Node<B>], y: &mut [f64], q: &mut [f64]) {
        self.assembly.gather(f, y);
        self.project(y, q);
    }

    /// Free coordinates `y = W^-T q`.
    pub fn displacements(&self, q: &[f64], y: &mut [f64]) {
        match &self.factor {
            Factor::MassWeighted(w) => {
                y.copy_from_slice(q);
                w.backward(self.assembly.pattern(), y);
            }
            Factor::AsPrinted { expand, .. } => multiply(expand, q, y),
        }
    }

    /// `q = W^-1 y` of forces `y` on the free coordinates; the content of `y` is lost.
    pub fn project(&self, y: &mut [f64], q: &mut [f64]) {
        match &self.factor {
            Factor::MassWeighted(w) => {
                q.copy_from_slice(y);
                w.forward(self.assembly.pattern(), q);
            }
            Factor::AsPrinted { reduce, .. } => multiply(reduce, y, q),
        }
    }

    /// `x <- W^-1 x` for one component of the system.
    pub fn project_component(&self, component: usize, x: &mut [f64]) {
        if let Factor::MassWeighted(w) = &self.factor {
            w.forward_component(self.assembly.pattern(), component, x);
        }
    }

    /// `x <- W^-1 x`.
    pub fn project_in_place(&self, x: &mut [f64]) {
        if let Factor::MassWeighted(w) = &self.factor {
            w.forward(self.assembly.pattern(), x);
        }
    }

    /// `y <- W y` for one component of the system.
    pub fn forces_component(&self, component: usize, y: &mut [f64]) {
        if let Factor::MassWeighted(w) = &self.factor {
            w.multiply_component(self.assembly.pattern(), component, y);
        }
    }

    /// Forces on the free coordinates from those on `q`: `y <- W y`.
    pub fn forces(&self, y: &mut [f64]) {
        if let Factor::MassWeighted(w) = &self.factor {
            w.multiply(self.assembly.pattern(), y);
        }
    }

    /// Displacements `q` from those of the free coordinates: `y <- W^T y`.
    pub fn coordinates_of(&self, y: &mut [f64]) {
        if let Factor::MassWeighted(w) = &self.factor {
            w.multiply_transposed(self.assembly.pattern(), y);
        }
    }
}

fn multiply(a: &DMatrix<f64>, x: &[f64], y: &mut [f64]) {
    for (value, row) in y.iter_mut().zip(a.row_iter()) {
        *value = row.iter().zip(x).map(|(a, x)| a * x).sum();
    }
}
