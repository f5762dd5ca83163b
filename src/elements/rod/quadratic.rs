//! Linear and quadratic forms of the rates of vectors and of three scalars, as blocks.
//!
//! Source: products of blocks, G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed. (2013), section 1.3.

use super::kernel::Square;
use super::vectors::{Vector, plus};
use crate::elements::line::times;
use crate::math::lanes::Real;

/// A linear form of vectors (at a section `u'`, `w'`, `z'`; of an element the three of the line, then `z'`), and of the
/// rotate at the middle, the twist and the internal twist (of an element, in the end: both spins and the internal twist).
#[derive(Clone, Copy)]
pub(super) struct Form<N, const K: usize> {
    pub vectors: [Vector<N>; K],
    pub scalars: [N; 3],
}

/// A quadratic form: blocks of vectors with vectors not before them, scalars with vectors, scalars.
pub(super) struct Quadratic<N, const K: usize> {
    pub blocks: [[Square<N>; K]; K],
    pub mixed: [[Vector<N>; K]; 3],
    pub scalars: Square<N>,
}

impl<N: Real, const K: usize> Quadratic<N, K> {
    #[inline(always)]
    pub fn nothing(zero: N) -> Self {
        Self {
            blocks: [[[[zero; 3]; 3]; K]; K],
            mixed: [[[zero; 3]; K]; 3],
            scalars: [[zero; 3]; 3],
        }
    }

    /// Adds `a b^T` to a block.
    #[inline(always)]
    pub fn add_block(&mut self, i: usize, j: usize, a: &Vector<N>, b: &Vector<N>) {
        let block = &mut self.blocks[i][j];
        for r in 0..3 {
            for c in 0..3 {
                block[r][c] = a[r].times_plus(b[c], block[r][c]);
            }
        }
    }

    /// Adds the matrix of `x -> factor v x x` to a block.
    #[inline(always)]
    pub fn add_cross(&mut self, i: usize, j: usize, v: &Vector<N>, factor: N) {
        let (block, v) = (&mut self.blocks[i][j], times(v, factor));
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            block[b][a] += v[k];
            block[a][b] = block[a][b] - v[k];
        }
    }

    #[inline(always)]
    pub fn add_multiple(&mut self, i: usize, j: usize, factor: N) {
        for k in 0..3 {
            self.blocks[i][j][k][k] += factor;
        }
    }

    /// Adds `a b^T` of forms: all of it, which is to be symmetric in the end.
    #[inline(always)]
    pub fn add_product(&mut self, a: &Form<N, K>, b: &Form<N, K>) {
        for i in 0..K {
            for j in i..K {
                self.add_block(i, j, &a.vectors[i], &b.vectors[j]);
            }
        }
        for s in 0..3 {
            for i in 0..K {
                self.mixed[s][i] = plus(&b.vectors[i], a.scalars[s], &self.mixed[s][i]);
            }
            for r in 0..3 {
                self.scalars[s][r] = a.scalars[s].times_plus(b.scalars[r], self.scalars[s][r]);
            }
        }
    }

    /// Adds `a b^T + b a^T` where `a` is a form of vector `k` alone.
    #[inline(always)]
    pub fn add_symmetric(&mut self, k: usize, a: &Vector<N>, b: &[Vector<N>; K]) {
        for j in 0..K {
            if j <= k {
                self.add_block(j, k, &b[j], a);
            }
            if j >= k {
                self.add_block(k, j, a, &b[j]);
            }
        }
    }
}
