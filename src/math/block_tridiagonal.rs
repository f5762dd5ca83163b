//! Symmetric block-tridiagonal systems, real or complex symmetric (not Hermitian), factored as
//! L D L^T without pivoting: O(blocks).
//!
//! Source: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., sections 4.1.2 and 4.5.1;
//! complex symmetric matrices with definite real or imaginary part need no pivoting: N. J. Higham,
//! Factorizing complex symmetric matrices with positive definite real and imaginary parts,
//! Math. Comp. 67 (1998).

use std::ops::{Add, Div, Mul, Sub};

/// Numbers the factorization works on: `f64` and `Complex<f64>`.
pub trait Number:
    Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Whether a pivot keeps the matrix positive definite (real) or usable (complex).
    fn is_pivot(self) -> bool;
    /// Absolute value.
    fn size(self) -> f64;
}

impl Number for f64 {
    fn is_pivot(self) -> bool {
        self > 0.0 && self.is_finite()
    }

    fn size(self) -> f64 {
        self.abs()
    }
}

impl Number for nalgebra::Complex<f64> {
    fn is_pivot(self) -> bool {
        let size = self.norm_sqr();
        size > 0.0 && size.is_finite()
    }

    fn size(self) -> f64 {
        self.norm()
    }
}

/// A block of `B` x `B` numbers, row by row.
pub type Block<T, const B: usize> = [[T; B]; B];

/// A symmetric block-tridiagonal matrix, and after [`BlockTridiagonal::factor`] its factors.
#[derive(Clone, Debug)]
pub struct BlockTridiagonal<T, const B: usize> {
    /// Diagonal blocks; factored: unit lower triangles and, on the diagonal, the inverse pivots.
    pub diagonal: Vec<Block<T, B>>,
    /// Block `i` couples row `i + 1` to column `i`; factored: blocks of L.
    pub lower: Vec<Block<T, B>>,
}

impl<T: Number, const B: usize> BlockTridiagonal<T, B> {
    /// The zero matrix of `blocks` block rows.
    pub fn zeros(blocks: usize) -> Self {
        let zero = [[T::from(0.0); B]; B];
        Self {
            diagonal: vec![zero; blocks],
            lower: vec![zero; blocks.saturating_sub(1)],
        }
    }

    /// `y = A x` with the matrix not yet factored.
    pub fn multiply(&self, x: &[[T; B]], y: &mut [[T; B]]) {
        for (i, d) in self.diagonal.iter().enumerate() {
            y[i] = [T::from(0.0); B];
            add_product(d, &x[i], &mut y[i]);
        }
        for (i, l) in self.lower.iter().enumerate() {
            add_product(l, &x[i], &mut y[i + 1]);
            for (row, factor) in l.iter().zip(x[i + 1]) {
                for (value, coefficient) in y[i].iter_mut().zip(row) {
                    *value = *value + *coefficient * factor;
                }
            }
        }
    }

    /// Factors in place. Returns false, with the content undefined, at a pivot that is zero, not
    /// finite or, for real matrices, not positive.
    pub fn factor(&mut self) -> bool {
        for i in 0..self.diagonal.len() {
            let d = &mut self.diagonal[i];
            if !factor_block(d) {
                return false;
            }
            if i == self.lower.len() {
                break;
            }
            let mut pivots = [T::from(0.0); B];
            for (j, pivot) in pivots.iter_mut().enumerate() {
                *pivot = T::from(1.0) / d[j][j];
            }
            let d = self.diagonal[i];
            let l = &mut self.lower[i];
            for row in l.iter_mut() {
                for j in 0..B {
                    let mut value = row[j];
                    for k in 0..j {
                        value = value - row[k] * pivots[k] * d[j][k];
                    }
                    row[j] = value * d[j][j];
                }
            }
            let l = &self.lower[i];
            let next = &mut self.diagonal[i + 1];
            for r in 0..B {
                let mut scaled = l[r];
                for (value, pivot) in scaled.iter_mut().zip(pivots) {
                    *value = *value * pivot;
                }
                for c in 0..=r {
                    let mut sum = next[r][c];
                    for k in 0..B {
                        sum = sum - scaled[k] * l[c][k];
                    }
                    next[r][c] = sum;
                }
            }
        }
        true
    }

    /// Solves in place with the factors; `x` is one block of `B` numbers per block row.
    pub fn solve(&self, x: &mut [[T; B]]) {
        let blocks = self.diagonal.len();
        for i in 0..blocks {
            let d = &self.diagonal[i];
            let mut y = x[i];
            for r in 1..B {
                for c in 0..r {
                    y[r] = y[r] - d[r][c] * y[c];
                }
            }
            x[i] = y;
            if let Some(l) = self.lower.get(i) {
                for r in 0..B {
                    for c in 0..B {
                        x[i + 1][r] = x[i + 1][r] - l[r][c] * y[c];
                    }
                }
            }
        }
        for i in (0..blocks).rev() {
            let d = &self.diagonal[i];
            let mut y = x[i];
            for (r, value) in y.iter_mut().enumerate() {
                *value = *value * d[r][r];
            }
            if let Some(l) = self.lower.get(i) {
                let next = x[i + 1];
                for c in 0..B {
                    for r in 0..B {
                        y[c] = y[c] - l[r][c] * next[r];
                    }
                }
            }
            for c in (0..B).rev() {
                for r in c + 1..B {
                    y[c] = y[c] - d[r][c] * y[r];
                }
            }
            x[i] = y;
        }
    }
}

fn add_product<T: Number, const B: usize>(a: &Block<T, B>, x: &[T; B], y: &mut [T; B]) {
    for (row, value) in a.iter().zip(y) {
        for (coefficient, x) in row.iter().zip(x) {
            *value = *value + *coefficient * *x;
        }
    }
}

/// L D L^T of one block from its lower triangle; the diagonal becomes the inverse pivots.
fn factor_block<T: Number, const B: usize>(d: &mut Block<T, B>) -> bool {
    let mut pivots = [T::from(0.0); B];
    for j in 0..B {
        let mut pivot = d[j][j];
        for k in 0..j {
            pivot = pivot - d[j][k] * d[j][k] * pivots[k];
        }
        if !pivot.is_pivot() {
            return false;
        }
        pivots[j] = pivot;
        let inverse = T::from(1.0) / pivot;
        for i in j + 1..B {
            let mut value = d[i][j];
            for k in 0..j {
                value = value - d[i][k] * d[j][k] * pivots[k];
            }
            d[i][j] = value * inverse;
        }
        d[j][j] = inverse;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Complex;

    fn residual<T: Number>(size: impl Fn(T) -> f64, number: impl Fn(f64, f64) -> T) -> f64 {
        let (blocks, mut seed) = (7, 1_u64);
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
        };
        let mut a = BlockTridiagonal::<T, 3>::zeros(blocks);
        for i in 0..blocks {
            for r in 0..3 {
                for c in 0..=r {
                    let bump = if r == c { 6.0 } else { 0.0 };
                    let value = number(random() + bump, random());
                    a.diagonal[i][r][c] = value;
                    a.diagonal[i][c][r] = value;
                }
            }
        }
        for block in &mut a.lower {
            block
                .iter_mut()
                .flatten()
                .for_each(|v| *v = number(random(), random()));
        }
        let x: Vec<[T; 3]> = (0..blocks)
            .map(|_| [(); 3].map(|()| number(random(), random())))
            .collect();
        let mut b = vec![[T::from(0.0); 3]; blocks];
        a.multiply(&x, &mut b);
        assert!(a.factor());
        a.solve(&mut b);
        let pairs = b.iter().flatten().zip(x.iter().flatten());
        pairs.map(|(b, x)| size(*b - *x)).fold(0.0, f64::max)
    }

    #[test]
    fn solves_real_and_complex_systems() {
        assert!(residual::<f64>(f64::abs, |re, _| re) < 1e-14);
        assert!(residual::<Complex<f64>>(|z| z.norm(), Complex::new) < 1e-14);
    }

    #[test]
    fn refuses_an_indefinite_real_matrix() {
        let mut a = BlockTridiagonal::<f64, 1>::zeros(2);
        a.diagonal = vec![[[1.0]], [[1.0]]];
        a.lower = vec![[[2.0]]];
        assert!(!a.factor());
    }
}
