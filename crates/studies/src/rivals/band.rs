//! Banded matrices without symmetry and their factors with partial pivoting: tangents with multipliers, and dense
//! ones as bands of full width.
//!
//! Source: G. H. Golub, C. F. Van Loan, Matrix Computations (2013), section 4.3.3 (as LAPACK's dgbtrf keeps it: row
//! interchanges widen the upper band to twice the half width).

/// A banded matrix, or its factors in its place.
#[derive(Clone, Debug)]
pub struct Band {
    size: usize,
    half: usize,
    /// Row `i` holds columns `i - half` to `i + 2 half`.
    values: Vec<f64>,
    pivots: Vec<usize>,
}

impl Band {
    /// Zero matrix of a size with a number of diagonals on either side of the main one.
    pub fn zeros(size: usize, half: usize) -> Self {
        Self {
            size,
            half,
            values: vec![0.0; size * (3 * half + 1)],
            pivots: vec![0; size],
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    #[inline(always)]
    fn place(&self, row: usize, column: usize) -> usize {
        row * (3 * self.half + 1) + self.half + column - row
    }

    /// Adds to an entry.
    #[inline(always)]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row, column);
        self.values[place] += value;
    }

    /// `A x`, before the matrix is factored.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let row = |i: usize| {
            let columns = i.saturating_sub(self.half)..(i + self.half + 1).min(self.size);
            columns.map(|j| self.values[self.place(i, j)] * x[j]).sum()
        };
        (0..self.size).map(row).collect()
    }

    /// Factors in place; `None` where a pivot vanishes or is no number.
    pub fn factor(&mut self) -> Option<()> {
        let (n, half) = (self.size, self.half);
        for k in 0..n {
            let below = (k + half).min(n - 1);
            let size = |i: usize| self.values[self.place(i, k)].abs();
            let pivot = (k..=below).fold(k, |best, i| if size(i) > size(best) { i } else { best });
            let largest = size(pivot);
            if !(largest > 0.0 && largest.is_finite()) {
                return None;
            }
            self.pivots[k] = pivot;
            let last = (k + 2 * half).min(n - 1);
            if pivot != k {
                for j in k..=last {
                    let (a, b) = (self.place(k, j), self.place(pivot, j));
                    self.values.swap(a, b);
                }
            }
            let width = last - k;
            let start = self.place(k, k);
            let (above, rest) = self.values.split_at_mut(start + width + 1);
            let source = &above[start..];
            for i in k + 1..=below {
                let at = i * (3 * half + 1) + half + k - i - (start + width + 1);
                let row = &mut rest[at..=at + width];
                if row[0] == 0.0 {
                    continue;
                }
                let factor = row[0] / source[0];
                row[0] = factor;
                for (r, s) in row[1..].iter_mut().zip(&source[1..]) {
                    *r -= factor * s;
                }
            }
        }
        Some(())
    }

    /// `A^-1 b` in place, after [`Band::factor`].
    pub fn solve(&self, b: &mut [f64]) {
        let (n, half) = (self.size, self.half);
        for k in 0..n {
            b.swap(k, self.pivots[k]);
            for i in k + 1..=(k + half).min(n - 1) {
                b[i] -= self.values[self.place(i, k)] * b[k];
            }
        }
        for k in (0..n).rev() {
            let start = self.place(k, k);
            let width = (2 * half).min(n - 1 - k);
            let row = &self.values[start + 1..=start + width];
            let known: f64 = row.iter().zip(&b[k + 1..]).map(|(a, x)| a * x).sum();
            b[k] = (b[k] - known) / self.values[start];
        }
    }
}

#[test]
fn a_band_solves_what_it_multiplies() {
    for (n, half) in [(1, 0), (7, 2), (9, 8), (20, 4)] {
        let mut band = Band::zeros(n, half);
        for i in 0..n {
            for j in i.saturating_sub(half)..(i + half + 1).min(n) {
                // Small diagonals: nothing goes without exchanging rows.
                let value = ((3 * i + 5 * j + 1) as f64).sin();
                band.add(i, j, if i == j && n > 1 { 1e-9 } else { value });
            }
        }
        let x: Vec<f64> = (0..n).map(|i| 1.0 + i as f64).collect();
        let mut b = band.times(&x);
        band.factor().expect("a regular matrix");
        band.solve(&mut b);
        for (found, expected) in b.iter().zip(&x) {
            assert!(
                (found - expected).abs() < 1e-7,
                "{n} {half}: {found} {expected}"
            );
        }
    }
}
