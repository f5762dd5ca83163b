//! Symmetric block-sparse systems, real or complex symmetric (not Hermitian), factored as
//! L D L^T without pivoting. The work follows the stored blocks: for chains it is linear.
//!
//! Sources: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., sections 4.1.2 and 4.2.5;
//! A. George, J. W. H. Liu, Computer Solution of Large Sparse Positive Definite Systems (1981);
//! complex symmetric matrices with definite real or imaginary part need no pivoting: N. J. Higham,
//! Factorizing complex symmetric matrices with positive definite real and imaginary parts,
//! Math. Comp. 67 (1998).

mod chains;
mod cholesky;
mod general;
mod kernels;
mod pattern;
#[cfg(test)]
mod tests;

pub use cholesky::Cholesky;
pub use general::{Factors, General};
pub use pattern::{Component, Pattern, Slot};

use std::ops::{Add, Div, Mul, Sub};

/// Numbers the factorization works on: `f64` and `Complex<f64>`.
pub trait Number:
    Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// 1 / self; `None` if that or the number itself is not finite.
    fn inverse(self) -> Option<Self>;
    /// Whether a pivot counts as negative; never for complex numbers.
    fn is_negative(self) -> bool;
    /// Absolute value.
    fn size(self) -> f64;
}

impl Number for f64 {
    fn inverse(self) -> Option<Self> {
        self.is_normal().then(|| 1.0 / self)
    }

    fn is_negative(self) -> bool {
        self < 0.0
    }

    fn size(self) -> f64 {
        self.abs()
    }
}

impl Number for nalgebra::Complex<f64> {
    fn inverse(self) -> Option<Self> {
        let square = self.norm_sqr();
        square.is_normal().then(|| self.conj() * (1.0 / square))
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
        kernels::multiply(pattern, &self.values, x, y);
    }

    /// Factors in place, reading only the lower triangles of the diagonal blocks. Returns the
    /// number of negative pivots (0 for complex matrices), or `None`, with the content undefined,
    /// at a pivot that is zero or not finite.
    pub fn factor(&mut self, pattern: &Pattern) -> Option<usize> {
        kernels::factor(pattern, &mut self.values)
    }

    /// Solves in place with the factors.
    pub fn solve(&self, pattern: &Pattern, x: &mut [T]) {
        kernels::forward(pattern, &pattern.steps, &self.values, 0, x);
        kernels::backward::<T, true>(pattern, &pattern.steps, &self.values, 0, x);
    }

    /// Solves for one component in place with the factors; `x` holds the variables of this
    /// component alone.
    pub fn solve_component(&self, pattern: &Pattern, component: usize, x: &mut [T]) {
        let component = &pattern.components()[component];
        let (steps, base) = (
            &pattern.steps[component.steps.clone()],
            component.variables.start,
        );
        kernels::forward(pattern, steps, &self.values, base, x);
        kernels::backward::<T, true>(pattern, steps, &self.values, base, x);
    }
}
