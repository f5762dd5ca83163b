//! The same loops for runs of equal blocks, each joined to the next one alone: block sizes are
//! known when compiling. Blocks stand as in the values: diagonal, below, diagonal, below, ...
//!
//! Long runs go by the vector instructions that the processor has, with the same bits: nothing is multiplied and added
//! at once.

use super::Number;
use super::kernels::Pivots;
use crate::math::lanes::{Simd, Vectorized, vectorized_where};

/// Numbers of stored blocks from which on a run is long: 16 columns of a cable in the plane, 7 in space.
const LONG: usize = 512;

/// Factors the columns of a run; `values` ends with the diagonal block that the last of them
/// changes; `start` is the first of their variables. Nothing where a pivot ends it.
pub(super) fn factor<T: Number, const B: usize>(
    values: &mut [T],
    start: usize,
    pivots: &mut impl Pivots<T>,
) -> Option<()> {
    let is_long = values.len() >= LONG;
    let mut outcome = None;
    let work = Factor::<'_, T, _, B> {
        values,
        start,
        pivots,
        outcome: &mut outcome,
    };
    vectorized_where(is_long, work);
    outcome
}

/// [`factor`].
struct Factor<'a, T, P, const B: usize> {
    values: &'a mut [T],
    start: usize,
    pivots: &'a mut P,
    outcome: &'a mut Option<()>,
}

impl<T: Number, P: Pivots<T>, const B: usize> Vectorized for Factor<'_, T, P, B> {
    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        *self.outcome = factor_blocks::<T, B>(self.values, self.start, self.pivots);
    }
}

#[inline(always)]
fn factor_blocks<T: Number, const B: usize>(
    values: &mut [T],
    mut start: usize,
    pivots: &mut impl Pivots<T>,
) -> Option<()> {
    let blocks = values.as_chunks_mut::<B>().0.as_chunks_mut::<B>().0;
    let mut blocks = blocks.iter_mut();
    let mut diagonal = blocks.next()?;
    while let (Some(below), Some(next)) = (blocks.next(), blocks.next()) {
        for j in 0..B {
            let inverse = pivots(start + j, diagonal[j][j])?;
            diagonal[j][j] = inverse;
            let mut column = [T::from(0.0); B];
            for i in j + 1..B {
                column[i] = diagonal[i][j] * inverse;
                for k in j + 1..=i {
                    diagonal[i][k] = diagonal[i][k] - diagonal[i][j] * column[k];
                }
                diagonal[i][j] = column[i];
            }
            let mut lower = [T::from(0.0); B];
            for i in 0..B {
                let value = below[i][j];
                lower[i] = value * inverse;
                for k in j + 1..B {
                    below[i][k] = below[i][k] - value * column[k];
                }
                for k in 0..=i {
                    next[i][k] = next[i][k] - value * lower[k];
                }
                below[i][j] = lower[i];
            }
        }
        diagonal = next;
        start += B;
    }
    Some(())
}

/// Forward substitution over a run; `x` ends with the variables the last column changes.
pub(super) fn forward<T: Number, const B: usize>(values: &[T], x: &mut [T]) {
    vectorized_where(values.len() >= LONG, Forward::<'_, T, B> { values, x });
}

/// [`forward`].
struct Forward<'a, T, const B: usize> {
    values: &'a [T],
    x: &'a mut [T],
}

impl<T: Number, const B: usize> Vectorized for Forward<'_, T, B> {
    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        forward_blocks::<T, B>(self.values, self.x);
    }
}

#[inline(always)]
fn forward_blocks<T: Number, const B: usize>(values: &[T], x: &mut [T]) {
    let blocks = values.as_chunks::<B>().0.as_chunks::<B>().0;
    let mut x = x.as_chunks_mut::<B>().0.iter_mut();
    let Some(mut own) = x.next() else {
        return;
    };
    for ([diagonal, below], next) in blocks.as_chunks::<2>().0.iter().zip(x) {
        let mut y = *own;
        for c in 0..B {
            for r in c + 1..B {
                y[r] = y[r] - diagonal[r][c] * y[c];
            }
        }
        *own = y;
        for c in 0..B {
            for r in 0..B {
                next[r] = next[r] - below[r][c] * y[c];
            }
        }
        own = next;
    }
}

/// Backward substitution over a run, with the inverse pivots if `SCALE`; `x` ends with the
/// variables below the last column.
pub(super) fn backward<T: Number, const B: usize, const SCALE: bool>(values: &[T], x: &mut [T]) {
    vectorized_where(
        values.len() >= LONG,
        Backward::<'_, T, B, SCALE> { values, x },
    );
}

/// [`backward`].
struct Backward<'a, T, const B: usize, const SCALE: bool> {
    values: &'a [T],
    x: &'a mut [T],
}

impl<T: Number, const B: usize, const SCALE: bool> Vectorized for Backward<'_, T, B, SCALE> {
    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        backward_blocks::<T, B, SCALE>(self.values, self.x);
    }
}

#[inline(always)]
fn backward_blocks<T: Number, const B: usize, const SCALE: bool>(values: &[T], x: &mut [T]) {
    let blocks = values.as_chunks::<B>().0.as_chunks::<B>().0;
    let mut x = x.as_chunks_mut::<B>().0.iter_mut().rev();
    let Some(mut next) = x.next() else {
        return;
    };
    for ([diagonal, below], own) in blocks.as_chunks::<2>().0.iter().rev().zip(x) {
        let mut y = *own;
        if SCALE {
            for (k, y) in y.iter_mut().enumerate() {
                *y = *y * diagonal[k][k];
            }
        }
        // The first number of `next` is known last.
        for r in (0..B).rev() {
            for c in 0..B {
                y[c] = y[c] - below[r][c] * next[r];
            }
        }
        for r in (1..B).rev() {
            for c in 0..r {
                y[c] = y[c] - diagonal[r][c] * y[r];
            }
        }
        *own = y;
        next = own;
    }
}

/// Adds what the blocks of a run and their transposes give in `A x`; `x` and `y` end with the
/// variables below the last column.
pub(super) fn multiply<T: Number, const B: usize>(values: &[T], x: &[T], y: &mut [T]) {
    let blocks = values.as_chunks::<B>().0.as_chunks::<B>().0;
    let x = x.as_chunks::<B>().0;
    let mut y = y.as_chunks_mut::<B>().0.iter_mut();
    let Some(mut own) = y.next() else {
        return;
    };
    for (([diagonal, below], x), next) in blocks.as_chunks::<2>().0.iter().zip(x.windows(2)).zip(y)
    {
        let [x, later] = [x[0], x[1]];
        let (mut sum, mut passed) = (*own, *next);
        for r in 0..B {
            for c in 0..B {
                sum[r] = sum[r] + diagonal[r][c] * x[c];
                passed[r] = passed[r] + below[r][c] * x[c];
                sum[c] = sum[c] + below[r][c] * later[r];
            }
        }
        *own = sum;
        *next = passed;
        own = next;
    }
}
