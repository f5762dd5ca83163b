//! The triangular factor of a positive definite matrix, as a change of coordinates.

use super::{Matrix, Pattern, kernels};

/// Cholesky factor W, lower triangular in elimination order, of a positive definite A = W W^T,
/// kept as W = L sqrt(D) with the factors L D L^T of A.
#[derive(Clone, Debug)]
pub struct Cholesky {
    factors: Matrix<f64>,
    roots: Vec<f64>,
    inverse_roots: Vec<f64>,
}

impl Cholesky {
    /// Factors `a` (not yet factored); `None` if it is not positive definite.
    pub fn new(pattern: &Pattern, a: &Matrix<f64>) -> Option<Self> {
        let mut factors = a.clone();
        if factors.factor(pattern)? > 0 {
            return None;
        }
        let mut inverse_roots = Vec::with_capacity(pattern.len());
        for column in &pattern.columns {
            let pivots = (0..column.size).map(|i| column.at + i * (column.size + 1));
            inverse_roots.extend(pivots.map(|i| factors.values[i].sqrt()));
        }
        Some(Self {
            factors,
            roots: inverse_roots.iter().map(|root| 1.0 / root).collect(),
            inverse_roots,
        })
    }

    /// `x <- W^-1 x`.
    pub fn forward(&self, pattern: &Pattern, x: &mut [f64]) {
        kernels::forward(pattern, &pattern.steps, &self.factors.values, 0, x);
        scale(x, &self.inverse_roots);
    }

    /// `x <- W^-1 x` for one component; `x` holds the variables of this component alone.
    pub fn forward_component(&self, pattern: &Pattern, component: usize, x: &mut [f64]) {
        let component = &pattern.components()[component];
        let (steps, base) = (
            &pattern.steps[component.steps.clone()],
            component.variables.start,
        );
        kernels::forward(pattern, steps, &self.factors.values, base, x);
        scale(x, &self.inverse_roots[component.variables.clone()]);
    }

    /// `x <- W^-T x`.
    pub fn backward(&self, pattern: &Pattern, x: &mut [f64]) {
        scale(x, &self.inverse_roots);
        kernels::backward::<f64, false>(pattern, &pattern.steps, &self.factors.values, 0, x);
    }

    /// `x <- W x`.
    pub fn multiply(&self, pattern: &Pattern, x: &mut [f64]) {
        scale(x, &self.roots);
        for column in pattern.columns.iter().rev() {
            kernels::multiply_lower(pattern, column, &self.factors.values, 0, x);
        }
    }

    /// `x <- W x` for one component; `x` holds the variables of this component alone.
    pub fn multiply_component(&self, pattern: &Pattern, component: usize, x: &mut [f64]) {
        let component = &pattern.components()[component];
        let range = component.variables.clone();
        scale(x, &self.roots[range.clone()]);
        let order = &pattern.order()[component.vertices.clone()];
        for vertex in order
            .iter()
            .rev()
            .filter(|v| !pattern.range(**v).is_empty())
        {
            let column = &pattern.columns[pattern.column_of[*vertex]];
            kernels::multiply_lower(pattern, column, &self.factors.values, range.start, x);
        }
    }

    /// `x <- W^T x`.
    pub fn multiply_transposed(&self, pattern: &Pattern, x: &mut [f64]) {
        for column in &pattern.columns {
            kernels::multiply_lower_transposed(pattern, column, &self.factors.values, x);
        }
        scale(x, &self.roots);
    }
}

fn scale(x: &mut [f64], factors: &[f64]) {
    for (x, factor) in x.iter_mut().zip(factors) {
        *x *= factor;
    }
}
