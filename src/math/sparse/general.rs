//! Block-sparse systems that are not symmetric, over the same patterns: factored as L U with pivoting
//! inside the diagonal blocks. The work follows the stored blocks: for chains it is linear.
//!
//! Source: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., sections 3.4 and 4.5.

use super::pattern::{Column, Pattern, Slot};
use super::{Matrix, Number};

/// A matrix over a [`Pattern`]. Every call takes the pattern the matrix was made for.
#[derive(Clone, Debug)]
pub struct General<T> {
    /// Diagonal blocks and those below, as in [`Matrix`].
    lower: Vec<T>,
    /// Blocks above, each in the place of the one below and transposed.
    upper: Vec<T>,
}

impl General<f64> {
    /// Overwrites `into` with the symmetric part of this matrix.
    pub fn symmetric_part(&self, pattern: &Pattern, into: &mut Matrix<f64>) {
        let pairs = self.lower.iter().zip(&self.upper);
        for (into, (lower, upper)) in into.values.iter_mut().zip(pairs) {
            *into = 0.5 * (lower + upper);
        }
        // Diagonal blocks stand in full below.
        for Column { at, size, .. } in &pattern.columns {
            let block = &self.lower[*at..at + size * size];
            for (r, c) in (0..*size).flat_map(|r| (0..*size).map(move |c| (r, c))) {
                into.values[at + r * size + c] = 0.5 * (block[r * size + c] + block[c * size + r]);
            }
        }
    }
}

impl<T: Number> General<T> {
    /// The zero matrix.
    pub fn zeros(pattern: &Pattern) -> Self {
        let zeros = vec![T::from(0.0); pattern.stored];
        Self {
            lower: zeros.clone(),
            upper: zeros,
        }
    }

    /// Adds a factor times a symmetric matrix whose diagonal blocks are filled on both sides.
    pub fn add_symmetric(&mut self, factor: T, matrix: &Matrix<f64>) {
        for part in [&mut self.lower, &mut self.upper] {
            for (to, from) in part.iter_mut().zip(&matrix.values) {
                *to = *to + factor * T::from(*from);
            }
        }
    }

    /// Adds a factor times another matrix.
    pub fn add(&mut self, factor: T, matrix: &General<f64>) {
        let parts = [
            (&mut self.lower, &matrix.lower),
            (&mut self.upper, &matrix.upper),
        ];
        for (to, from) in parts {
            for (to, from) in to.iter_mut().zip(from) {
                *to = *to + factor * T::from(*from);
            }
        }
    }

    /// Adds to an entry of the block that stands in a slot.
    pub fn add_entry(&mut self, slot: Slot, row: usize, column: usize, value: T) {
        let part = if slot.transposed {
            &mut self.upper
        } else {
            &mut self.lower
        };
        let entry = &mut part[slot.entry(row, column)];
        *entry = *entry + value;
    }

    /// `y = A x`, not yet factored.
    pub fn multiply(&self, pattern: &Pattern, x: &[T], y: &mut [T]) {
        y.fill(T::from(0.0));
        for column in &pattern.columns {
            let (size, start) = (column.size, column.start);
            let diagonal = &self.lower[column.at..column.at + size * size];
            for (r, row) in diagonal.chunks_exact(size).enumerate() {
                y[start + r] = y[start + r] + product(row, &x[start..start + size]);
            }
            for row in &pattern.rows[column.rows.clone()] {
                for r in 0..row.size {
                    let at = row.at + r * size;
                    let sum = product(&self.lower[at..at + size], &x[start..start + size]);
                    y[row.start + r] = y[row.start + r] + sum;
                    let factor = x[row.start + r];
                    for c in 0..size {
                        y[start + c] = y[start + c] + self.upper[at + c] * factor;
                    }
                }
            }
        }
    }

    /// Largest size of an entry, and of one of the matrix less its transpose.
    pub fn largest(&self, pattern: &Pattern) -> [f64; 2] {
        let (mut whole, mut skew) = (0.0_f64, 0.0_f64);
        let mut note = |a: T, b: T| {
            whole = whole.max(a.size()).max(b.size());
            skew = skew.max((a - b).size());
        };
        for column in &pattern.columns {
            let size = column.size;
            for r in 0..size {
                for c in 0..r {
                    let [a, b] = [r * size + c, c * size + r];
                    note(self.lower[column.at + a], self.lower[column.at + b]);
                }
                let diagonal = self.lower[column.at + r * size + r];
                note(diagonal, diagonal);
            }
            for row in &pattern.rows[column.rows.clone()] {
                for at in row.at..row.at + row.size * size {
                    note(self.lower[at], self.upper[at]);
                }
            }
        }
        [whole, skew]
    }

    /// Factors the matrix, whose content is taken. `None` at a diagonal block that is singular or not
    /// finite.
    pub fn factor(mut self, pattern: &Pattern) -> Option<Factors<T>> {
        let variables = pattern.len();
        let mut pivots = vec![0; variables];
        let mut diagonal = Vec::with_capacity(variables);
        let mut odd = Vec::with_capacity(pattern.columns.len());
        for column in &pattern.columns {
            let (size, start) = (column.size, column.start);
            let block = &mut self.lower[column.at..column.at + size * size];
            let pivots = &mut pivots[start..start + size];
            odd.push(factor_block(block, pivots)?);
            diagonal.extend((0..size).map(|k| block[k * size + k]));
            self.eliminate(pattern, column, pivots);
        }
        Some(Factors {
            matrix: self,
            pivots,
            diagonal,
            odd,
        })
    }

    /// Converts the blocks below a factored diagonal block into those of L, and takes their products with the
    /// blocks above out of the later columns.
    fn eliminate(&mut self, pattern: &Pattern, column: &Column, pivots: &[usize]) {
        let size = column.size;
        let end = column.at + size * size;
        let (before, after) = self.lower.split_at_mut(end);
        let block = &before[column.at..];
        let rows = &pattern.rows[column.rows.clone()];
        let count: usize = rows.iter().map(|row| row.size).sum();
        for row in after[..count * size].chunks_exact_mut(size) {
            solve_row(block, pivots, row);
        }
        let targets = &pattern.targets[column.targets..];
        let mut pair = 0;
        for (a, late) in rows.iter().enumerate() {
            for early in &rows[..=a] {
                let target = targets[pair];
                pair += 1;
                for r in 0..late.size {
                    for c in 0..early.size {
                        let (at, of) = (late.at + r * size, early.at + c * size);
                        let entry = target + r * early.size + c;
                        let sum = product(&self.lower[at..at + size], &self.upper[of..of + size]);
                        self.lower[entry] = self.lower[entry] - sum;
                        if late.at != early.at {
                            let sum =
                                product(&self.upper[at..at + size], &self.lower[of..of + size]);
                            self.upper[entry] = self.upper[entry] - sum;
                        }
                    }
                }
            }
        }
    }
}

/// The factors of a matrix.
#[derive(Clone, Debug)]
pub struct Factors<T> {
    matrix: General<T>,
    /// Row that was exchanged with each.
    pivots: Vec<usize>,
    diagonal: Vec<T>,
    /// For every diagonal block whether an odd number of rows was exchanged.
    odd: Vec<bool>,
}

impl<T: Number> Factors<T> {
    /// Determinants of the diagonal blocks, whose product is that of the matrix: pivots, and whether the sign changes.
    pub fn blocks<'a>(&'a self, pattern: &'a Pattern) -> impl Iterator<Item = (&'a [T], bool)> {
        let columns = pattern.columns.iter().zip(&self.odd);
        columns.map(|(column, odd)| {
            let range = column.start..column.start + column.size;
            (&self.diagonal[range], *odd)
        })
    }

    /// Solves in place.
    pub fn solve(&self, pattern: &Pattern, x: &mut [T]) {
        let General { lower, upper } = &self.matrix;
        for column in &pattern.columns {
            let (size, start) = (column.size, column.start);
            for row in &pattern.rows[column.rows.clone()] {
                for r in 0..row.size {
                    let at = row.at + r * size;
                    let sum = product(&lower[at..at + size], &x[start..start + size]);
                    x[row.start + r] = x[row.start + r] - sum;
                }
            }
        }
        for column in pattern.columns.iter().rev() {
            let (size, start) = (column.size, column.start);
            for row in &pattern.rows[column.rows.clone()] {
                for r in 0..row.size {
                    let (at, factor) = (row.at + r * size, x[row.start + r]);
                    for c in 0..size {
                        x[start + c] = x[start + c] - upper[at + c] * factor;
                    }
                }
            }
            let block = &lower[column.at..column.at + size * size];
            let range = start..start + size;
            solve_block(block, &self.pivots[range.clone()], &mut x[range]);
        }
    }
}

fn product<T: Number>(a: &[T], b: &[T]) -> T {
    let pairs = a.iter().zip(b);
    pairs.fold(T::from(0.0), |sum, (a, b)| sum + *a * *b)
}

/// `P A = L U` in place with the larger of the pivots at hand. Whether the number of exchanges is odd.
fn factor_block<T: Number>(a: &mut [T], pivots: &mut [usize]) -> Option<bool> {
    let n = pivots.len();
    let mut is_odd = false;
    for k in 0..n {
        let size = |i: &usize| a[i * n + k].size();
        let best = (k..n).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        pivots[k] = best;
        if best != k {
            is_odd = !is_odd;
            (0..n).for_each(|c| a.swap(k * n + c, best * n + c));
        }
        let inverse = a[k * n + k].inverse()?;
        for i in k + 1..n {
            let factor = a[i * n + k] * inverse;
            a[i * n + k] = factor;
            for c in k + 1..n {
                a[i * n + c] = a[i * n + c] - factor * a[k * n + c];
            }
        }
    }
    Some(is_odd)
}

/// `x <- A^-1 x`.
fn solve_block<T: Number>(a: &[T], pivots: &[usize], x: &mut [T]) {
    let n = pivots.len();
    for k in 0..n {
        x.swap(k, pivots[k]);
    }
    for k in 0..n {
        x[k] = x[k] - product(&a[k * n..k * n + k], &x[..k]);
    }
    for k in (0..n).rev() {
        let later = product(&a[k * n + k + 1..(k + 1) * n], &x[k + 1..]);
        x[k] = (x[k] - later) / a[k * n + k];
    }
}

/// `x <- x A^-1` of a row.
fn solve_row<T: Number>(a: &[T], pivots: &[usize], x: &mut [T]) {
    let n = pivots.len();
    for k in 0..n {
        let before = (0..k).fold(x[k], |sum, i| sum - x[i] * a[i * n + k]);
        x[k] = before / a[k * n + k];
    }
    for k in (0..n).rev() {
        x[k] = (k + 1..n).fold(x[k], |sum, i| sum - x[i] * a[i * n + k]);
    }
    for k in (0..n).rev() {
        x.swap(k, pivots[k]);
    }
}
