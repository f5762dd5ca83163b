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
mod order;
mod panels;
mod pattern;
#[cfg(test)]
mod tests;
mod vectors;
mod work;

pub use cholesky::{Cholesky, Reach};
pub use general::{Factors, General};
pub use order::{graph, parts};
pub use pattern::{GraphComponent, Pattern, Slot};
pub use work::FactorWork;

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
    /// Number of parts: 2 of complex numbers, 1 of real ones.
    const PARTS: usize;
    /// Real and imaginary part.
    fn parts(self) -> [f64; 2];
    /// From real and imaginary part.
    fn from_parts(parts: [f64; 2]) -> Self;
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

    const PARTS: usize = 1;

    #[inline(always)]
    fn parts(self) -> [f64; 2] {
        [self, 0.0]
    }

    #[inline(always)]
    fn from_parts([real, _]: [f64; 2]) -> Self {
        real
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

    const PARTS: usize = 2;

    #[inline(always)]
    fn parts(self) -> [f64; 2] {
        [self.re, self.im]
    }

    #[inline(always)]
    fn from_parts([real, imaginary]: [f64; 2]) -> Self {
        Self::new(real, imaginary)
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
    /// Scratch of the factorization of panels.
    scratch: Vec<f64>,
}

impl<T: Number> Matrix<T> {
    /// The zero matrix.
    pub fn zeros(pattern: &Pattern) -> Self {
        Self {
            values: vec![T::from(0.0); pattern.stored],
            scratch: vec![0.0; T::PARTS * pattern.scratch()],
        }
    }

    /// The blocks of this matrix, over `whole`, that `part` stores: [`Pattern::of_part`] of it, in any order.
    pub fn part(&self, whole: &Pattern, part: &Pattern) -> Self {
        let mut blocks = Self::zeros(part);
        let vertices: Vec<usize> = part.vertices().copied().collect();
        for (&v, column) in vertices.iter().zip(&part.columns) {
            let size = column.size;
            let later = part.rows[column.rows.clone()].iter();
            let later = later.map(|row| (vertices[row.column], row.at, row.size));
            for (w, to, height) in later.chain([(v, column.at, size)]) {
                if let Some(slot) = whole.slot(w, v) {
                    for (r, row) in blocks.values[to..to + size * height]
                        .chunks_exact_mut(size)
                        .enumerate()
                    {
                        for (c, value) in row.iter_mut().enumerate() {
                            *value = self.values[slot.entry(r, c)];
                        }
                    }
                }
            }
        }
        blocks
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
        let mut negative = 0;
        let mut pivots = |_: usize, pivot: T| {
            negative += usize::from(pivot.is_negative());
            pivot.inverse()
        };
        kernels::factor(pattern, (&mut self.values, &mut self.scratch), &mut pivots)?;
        Some(negative)
    }

    /// Solves in place with the factors.
    pub fn solve(&self, pattern: &Pattern, x: &mut [T]) {
        kernels::forward(pattern, &pattern.steps, &self.values, x);
        kernels::backward::<T, true>(pattern, &pattern.steps, &self.values, x);
    }
}

impl Matrix<f64> {
    /// Factors a positive semidefinite matrix in place. A row whose pivot is not above its bound drops out: what solves say of it is
    /// zero. `counts` tells of every row whether it stays, and `pivots` what its pivot is.
    pub fn factor_semidefinite(
        &mut self,
        pattern: &Pattern,
        bounds: &[f64],
        counts: &mut [bool],
        pivots: &mut [f64],
    ) {
        let mut pivots = |row: usize, pivot: f64| {
            let stays = pivot.is_finite() && pivot > bounds[row];
            (counts[row], pivots[row]) = (stays, pivot);
            Some(if stays { 1.0 / pivot } else { 0.0 })
        };
        // No pivot ends it.
        let _ = kernels::factor(pattern, (&mut self.values, &mut self.scratch), &mut pivots);
    }
}
