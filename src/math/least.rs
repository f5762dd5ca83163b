//! Least solutions of dense equations whose rows or columns may depend on each other, and what these leave free, by
//! orthogonal transformations of a known number of steps. The iteration of a singular value decomposition (nalgebra 0.35) was
//! found to stop a tenth off the matrix where rows depend on each other: for one in fifty of linkages held twice.
//!
//! Source: complete orthogonal decomposition: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., section 5.4.7.

use nalgebra::{DMatrix, DVector, Dyn, QR};

/// A matrix `A` that may have any rank: `A = (A V) V^T` with orthonormal columns `V`.
pub struct Least {
    /// `V`.
    row_space: DMatrix<f64>,
    /// Factors of `A V`, whose columns are independent.
    factors: QR<f64, Dyn, Dyn>,
}

impl Least {
    /// Factors a matrix. Pivots up to `part` times its largest entry count as zero.
    pub fn new(matrix: &DMatrix<f64>, part: f64) -> Self {
        let none = part * matrix.amax();
        let pivoted = matrix.transpose().col_piv_qr();
        let r = pivoted.r();
        let rank = (0..r.nrows()).take_while(|k| r[(*k, *k)].abs() > none);
        let row_space = pivoted.q().columns(0, rank.count()).into_owned();
        let factors = (matrix * &row_space).qr();
        Self { row_space, factors }
    }

    /// The least of all `x` that leave the least of `A x = b`.
    pub fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let mut y = self.factors.q().tr_mul(b);
        // Pivots are not zero: columns are independent.
        self.factors.r().solve_upper_triangular_mut(&mut y);
        &self.row_space * y
    }

    /// Orthonormal vectors that the matrix makes zero.
    pub fn free(&self) -> Vec<DVector<f64>> {
        let n = self.row_space.nrows();
        let others = DMatrix::identity(n, n) - &self.row_space * self.row_space.transpose();
        // Eigenvalues of a projection are zeros and ones.
        let modes = others.symmetric_eigen();
        let modes = modes
            .eigenvalues
            .iter()
            .zip(modes.eigenvectors.column_iter());
        let free = modes.filter(|(size, _)| **size > 0.5);
        free.map(|(_, way)| way.into_owned()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers in (-1, 1), the same in every run.
    fn numbers() -> impl FnMut() -> f64 {
        let mut seed = 5_u64;
        move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    /// Products of matrices of known rank, half of one filled with zeros. The singular value decomposition at hand misses
    /// `A` by up to its own size for one in forty of these.
    #[test]
    fn solutions_are_least_and_complete_where_rows_depend_on_each_other() {
        let mut number = numbers();
        for (m, n) in [(1, 3), (5, 6), (6, 3), (30, 6), (12, 20), (30, 30)] {
            for run in 0..200 {
                let rank = run % 4.min(m + 1).min(n + 1);
                let tall = DMatrix::from_fn(m, rank, |_, _| number());
                let wide =
                    DMatrix::from_fn(rank, n, |_, _| number() * (number() > 0.0) as u8 as f64);
                let matrix = tall * wide;
                let least = Least::new(&matrix, 1e-9);
                // What is in the row space is found again, what no row gives is left over.
                let wanted = matrix.tr_mul(&DVector::from_fn(m, |_, _| number()));
                let found = least.solve(&(&matrix * &wanted));
                let left = (&matrix * (&found - &wanted)).amax();
                assert!(
                    left <= 1e-12 * matrix.amax() * wanted.amax(),
                    "{m} x {n}, {run}: {left:e}"
                );
                let other = DVector::from_fn(m, |_, _| number());
                let missed = &matrix * least.solve(&other) - &other;
                let normal = matrix.tr_mul(&missed).amax();
                assert!(
                    normal <= 1e-11 * matrix.amax().max(1e-30),
                    "{m} x {n}, {run}: {normal:e}"
                );
                let free = least.free();
                let zero = free.iter().map(|way| (&matrix * way).amax());
                let zero = zero.fold(0.0, f64::max);
                assert!(zero <= 1e-13 * matrix.amax(), "{m} x {n}, {run}: {zero:e}");
                assert_eq!(free.len() + least.row_space.ncols(), n, "{run}");
                for way in &free {
                    let along = way.dot(&found).abs();
                    assert!(along <= 1e-12 * found.amax(), "{m} x {n}, {run}: {along:e}");
                }
            }
        }
    }
}
