//! Symmetric block-sparse systems, real or complex symmetric (not Hermitian), factored as
//! L D L^T without pivoting. The work follows the stored blocks: for chains it is linear.
//!
//! Sources: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., sections 4.1.2 and 4.2.5;
//! A. George, J. W. H. Liu, Computer Solution of Large Sparse Positive Definite Systems (1981);
//! complex symmetric matrices with definite real or imaginary part need no pivoting: N. J. Higham,
//! Factorizing complex symmetric matrices with positive definite real and imaginary parts,
//! Math. Comp. 67 (1998).

mod cholesky;
mod kernels;
mod pattern;
#[cfg(test)]
mod tests;

pub use cholesky::Cholesky;
pub use pattern::{Component, Pattern, Slot};

use std::ops::{Add, Div, Mul, Sub};

/// Numbers the factorization works on: `f64` and `Complex<f64>`.
pub trait Number:
    Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Whether one can divide by it: neither zero nor as good as zero, and finite.
    fn is_pivot(self) -> bool;
    /// Whether a pivot counts as negative; never for complex numbers.
    fn is_negative(self) -> bool;
    /// Absolute value.
    fn size(self) -> f64;
}

impl Number for f64 {
    fn is_pivot(self) -> bool {
        self.is_normal()
    }

    fn is_negative(self) -> bool {
        self < 0.0
    }

    fn size(self) -> f64 {
        self.abs()
    }
}

impl Number for nalgebra::Complex<f64> {
    fn is_pivot(self) -> bool {
        self.norm_sqr().is_normal()
    }

    fn is_negative(self) -> bool {
        false
    }

    fn size(self) -> f64 {
        self.norm()
    }
}

/// A symmetric matrix over a [`Pattern`], and after [`Matrix::factor`] its factors. Every call
/// takes the pattern the matrix was made for.
#[derive(Clone, Debug)]
pub struct Matrix<T> {
    /// The stored blocks, each row by row: [`Pattern::slot`] says where. Diagonal blocks stand in
    /// full, others once. Factored: rows of the unit lower triangular L, with the inverse pivots
    /// on the diagonal.
    pub values: Vec<T>,
}

impl<T: Number> Matrix<T> {
    /// The zero matrix.
    pub fn zeros(pattern: &Pattern) -> Self {
        Self {
            values: vec![T::from(0.0); pattern.stored],
        }
    }

    /// `y = A x` with the matrix not yet factored and its diagonal blocks filled on both sides of
    /// the diagonal.
    pub fn multiply(&self, pattern: &Pattern, x: &[T], y: &mut [T]) {
        y.fill(T::from(0.0));
        for column in &pattern.columns {
            kernels::multiply(pattern, column, &self.values, x, y);
        }
    }

    /// Factors in place, reading only the lower triangles of the diagonal blocks. Returns the
    /// number of negative pivots (0 for complex matrices), or `None`, with the content undefined,
    /// at a pivot that is zero or not finite.
    pub fn factor(&mut self, pattern: &Pattern) -> Option<usize> {
        kernels::factor(pattern, &mut self.values)
    }

    /// Solves in place with the factors.
    pub fn solve(&self, pattern: &Pattern, x: &mut [T]) {
        let all = 0..pattern.columns.len();
        kernels::forward(pattern, all.clone(), &self.values, x);
        kernels::backward::<T, true>(pattern, all, &self.values, x);
    }

    /// Solves for one component in place with the factors; `x` holds the variables of this
    /// component alone.
    pub fn solve_component(&self, pattern: &Pattern, component: usize, x: &mut [T]) {
        let columns = &pattern.components()[component].columns;
        kernels::forward(pattern, columns.clone(), &self.values, x);
        kernels::backward::<T, true>(pattern, columns.clone(), &self.values, x);
    }
}
