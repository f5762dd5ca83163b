//! The row space of a small number of long rows, rank-revealing, for what is computed once: eigenvalues.
//!
//! Source: modified Gram-Schmidt with column pivoting and a second pass ("twice is enough"):
//! G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., sections 5.2.8, 5.4.1 and 5.5.5.

use super::vector::{dot, norm};

/// Rows `A = D P R^T Q` with `D` the sizes of the rows: `Q` has orthonormal rows, `R` is upper triangular, `P` permutes.
#[derive(Clone, Debug, Default)]
pub struct RowSpace {
    length: usize,
    /// The rows, and after [`RowSpace::factor`] in pivoted order `Q`.
    rows: Vec<f64>,
    /// `R` by columns: entry (i, j) at `j * count + i`.
    r: Vec<f64>,
    pivots: Vec<usize>,
    /// Sizes of the rows as they were filled in.
    sizes: Vec<f64>,
    rank: usize,
}

impl RowSpace {
    /// Storage for `count` rows of `length` numbers.
    pub fn new(count: usize, length: usize) -> Self {
        Self {
            length,
            rows: vec![0.0; count * length],
            r: vec![0.0; count * count],
            pivots: (0..count).collect(),
            sizes: vec![0.0; count],
            rank: 0,
        }
    }

    /// Number of rows.
    pub fn count(&self) -> usize {
        self.pivots.len()
    }

    /// Number of independent rows.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Row `i`, to be filled in before [`RowSpace::factor`].
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.rows[i * self.length..(i + 1) * self.length]
    }

    /// Orthonormal row `i`, below the rank.
    pub fn unit(&self, i: usize) -> &[f64] {
        &self.rows[i * self.length..(i + 1) * self.length]
    }

    /// Makes the rows orthonormal, largest remainder first. A row of which others leave less than
    /// `least`, relative to its size, counts as dependent.
    pub fn factor(&mut self, least: f64) {
        let (count, length) = (self.count(), self.length);
        self.pivots.iter_mut().enumerate().for_each(|(i, p)| *p = i);
        self.r.fill(0.0);
        self.rank = 0;
        for (row, size) in self
            .rows
            .chunks_exact_mut(length.max(1))
            .zip(&mut self.sizes)
        {
            *size = norm(row);
            if *size > 0.0 {
                row.iter_mut().for_each(|x| *x /= *size);
            }
        }
        for k in 0..count {
            let remainder = |i: usize| {
                let row = &self.rows[i * length..(i + 1) * length];
                dot(row, row)
            };
            let (mut best, mut size) = (k, remainder(k));
            for i in k + 1..count {
                let other = remainder(i);
                if other > size {
                    (best, size) = (i, other);
                }
            }
            self.exchange(k, best);
            let (done, rest) = self.rows.split_at_mut(k * length);
            let (pivot, rest) = rest.split_at_mut(length);
            // Rounding of the first pass is taken out by a second one.
            for i in 0..k {
                let unit = &done[i * length..(i + 1) * length];
                let part = dot(unit, pivot);
                subtract(part, unit, pivot);
                self.r[k * count + i] += part;
            }
            let size = norm(pivot);
            if size.is_nan() || size <= least {
                return;
            }
            self.r[k * count + k] = size;
            pivot.iter_mut().for_each(|x| *x /= size);
            for (i, row) in rest.chunks_exact_mut(length).enumerate() {
                let part = dot(pivot, row);
                subtract(part, pivot, row);
                self.r[(k + 1 + i) * count + k] = part;
            }
            self.rank = k + 1;
        }
    }

    fn exchange(&mut self, a: usize, b: usize) {
        if a == b {
            return;
        }
        let (count, length) = (self.count(), self.length);
        self.pivots.swap(a, b);
        for i in 0..length {
            self.rows.swap(a * length + i, b * length + i);
        }
        for i in 0..count {
            self.r.swap(a * count + i, b * count + i);
        }
    }

    /// Combines other rows, as many and as long as these, as the orthonormal ones were: `R^-T P^T D^-1`
    /// times them; so many as the rank.
    pub fn combine(&self, rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let count = self.count();
        let mut combined: Vec<Vec<f64>> = Vec::with_capacity(self.rank);
        for i in 0..self.rank {
            let (column, pivot) = (&self.r[i * count..(i + 1) * count], self.pivots[i]);
            let mut row = rows[pivot].clone();
            row.iter_mut().for_each(|x| *x /= self.sizes[pivot]);
            for (factor, before) in column.iter().zip(&combined) {
                subtract(*factor, before, &mut row);
            }
            row.iter_mut().for_each(|x| *x /= column[i]);
            combined.push(row);
        }
        combined
    }
}

fn subtract(factor: f64, a: &[f64], b: &mut [f64]) {
    b.iter_mut().zip(a).for_each(|(b, a)| *b -= factor * a);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(rows: &[[f64; 4]]) -> RowSpace {
        let mut space = RowSpace::new(rows.len(), 4);
        for (i, row) in rows.iter().enumerate() {
            space.row_mut(i).copy_from_slice(row);
        }
        space.factor(1e-7);
        space
    }

    const ROWS: [[f64; 4]; 3] = [
        [1.0, 2.0, 0.0, -1.0],
        [0.5, 1.0, 3.0, 0.0],
        [2.0, 0.0, 1.0, 1.0],
    ];

    #[test]
    fn units_are_orthonormal_and_span_the_rows() {
        let space = filled(&ROWS);
        assert_eq!(space.rank(), 3);
        for i in 0..3 {
            for j in 0..3 {
                let expected = f64::from(u8::from(i == j));
                assert!((dot(space.unit(i), space.unit(j)) - expected).abs() < 1e-15);
            }
        }
        for row in ROWS {
            let mut left = row;
            for i in 0..3 {
                let unit = space.unit(i);
                subtract(dot(unit, &row), unit, &mut left);
            }
            assert!(norm(&left) < 1e-14);
        }
    }

    #[test]
    fn combines_rows_as_its_own() {
        let space = filled(&ROWS);
        let combined = space.combine(&ROWS.map(|row| row.to_vec()));
        for (i, row) in combined.iter().enumerate() {
            let off = row.iter().zip(space.unit(i)).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-14);
        }
    }

    #[test]
    fn finds_dependent_rows() {
        let sum: [f64; 4] = std::array::from_fn(|i| ROWS[0][i] - ROWS[2][i]);
        let space = filled(&[ROWS[0], ROWS[1], ROWS[2], sum]);
        assert_eq!(space.rank(), 3);
        assert_eq!(filled(&[[0.0; 4]]).rank(), 0);
    }
}
