//! Symmetric banded matrices and their factors without pivoting.
//!
//! Source: G. H. Golub, C. F. Van Loan, Matrix Computations (2013), sections 4.3.5 and 4.1.2.

/// Lower triangle of a symmetric banded matrix, or `L` and `1 / D` of `L D L^T` in its place. Row
/// `i` holds columns `i - width` to `i`.
#[derive(Clone, Debug)]
pub struct Band {
    size: usize,
    width: usize,
    values: Vec<f64>,
}

impl Band {
    /// Zero matrix of a size with a number of diagonals below the main one.
    pub fn zeros(size: usize, width: usize) -> Self {
        Self {
            size,
            width,
            values: vec![0.0; size * (width + 1)],
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Entry of the lower triangle.
    pub fn at(&mut self, row: usize, column: usize) -> &mut f64 {
        &mut self.values[row * (self.width + 1) + self.width + column - row]
    }

    /// `y = A x`.
    pub fn multiply<const D: usize>(&self, x: &[[f64; D]], y: &mut [[f64; D]]) {
        y.fill([0.0; D]);
        for row in 0..self.size {
            let first = row.saturating_sub(self.width);
            let base = row * (self.width + 1) + self.width - row;
            for column in first..=row {
                let a = self.values[base + column];
                for k in 0..D {
                    y[row][k] += a * x[column][k];
                    if column < row {
                        y[column][k] += a * x[row][k];
                    }
                }
            }
        }
    }

    /// Makes a row and its column those of the identity.
    pub fn hold(&mut self, held: usize) {
        for row in held..(held + self.width + 1).min(self.size) {
            *self.at(row, held) = 0.0;
        }
        for column in held.saturating_sub(self.width)..held {
            *self.at(held, column) = 0.0;
        }
        *self.at(held, held) = 1.0;
    }

    /// Factors in place. Whether all pivots were positive.
    pub fn factor(&mut self) -> bool {
        let width = self.width;
        let mut positive = true;
        let mut scaled = vec![0.0; width];
        for row in 0..self.size {
            let first = row.saturating_sub(width);
            let start = row * (width + 1) + width - row;
            let mut diagonal = self.values[start + row];
            for column in first..row {
                let base = column * (width + 1) + width - column;
                let from = first.max(column.saturating_sub(width));
                let mut sum = self.values[start + column];
                for k in from..column {
                    sum -= scaled[k - first] * self.values[base + k];
                }
                scaled[column - first] = sum;
                let l = sum * self.values[base + column];
                self.values[start + column] = l;
                diagonal -= sum * l;
            }
            positive &= diagonal > 0.0;
            self.values[start + row] = 1.0 / diagonal;
        }
        positive
    }

    /// `x = A^-1 x` of a factored matrix with `width < W`.
    pub fn solve<const D: usize, const W: usize>(&self, x: &mut [[f64; D]]) {
        let rows = self.values.as_chunks::<W>().0;
        debug_assert_eq!(self.width + 1, W);
        for i in 0..self.size {
            let mut sum = x[i];
            let row = &rows[i];
            if i >= W - 1 {
                for (j, y) in x[i + 1 - W..i].iter().enumerate() {
                    for k in 0..D {
                        sum[k] -= row[j] * y[k];
                    }
                }
            } else {
                for j in 0..i {
                    for k in 0..D {
                        sum[k] -= row[W - 1 + j - i] * x[j][k];
                    }
                }
            }
            x[i] = sum;
        }
        for i in (0..self.size).rev() {
            let row = &rows[i];
            let mut sum = x[i];
            for k in 0..D {
                sum[k] *= row[W - 1];
            }
            for j in i + 1..(i + W).min(self.size) {
                let a = rows[j][W - 1 + i - j];
                for k in 0..D {
                    sum[k] -= a * x[j][k];
                }
            }
            x[i] = sum;
        }
    }

    /// `x = A^-1 x` of a factored matrix of any width.
    pub fn solve_any(&self, x: &mut [f64]) {
        let start = |row: usize| row * (self.width + 1) + self.width - row;
        for i in 0..self.size {
            for j in i.saturating_sub(self.width)..i {
                x[i] -= self.values[start(i) + j] * x[j];
            }
        }
        for i in (0..self.size).rev() {
            x[i] *= self.values[start(i) + i];
            for j in i + 1..(i + self.width + 1).min(self.size) {
                x[i] -= self.values[start(j) + i] * x[j];
            }
        }
    }
}
