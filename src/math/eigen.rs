//! Eigenvalues of dense matrices, at set-up only.

/// Eigenvalues of a symmetric `n` x `n` matrix given by its entries (row, column), ascending.
/// Returns `None` when the iteration does not converge (entries that are not finite).
pub fn symmetric_eigenvalues(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<Vec<f64>> {
    let matrix = faer::Mat::from_fn(n, n, entry);
    if !matrix.col_iter().all(|c| c.iter().all(|v| v.is_finite())) {
        return None;
    }
    matrix.self_adjoint_eigenvalues(faer::Side::Lower).ok()
}

/// Eigenvalues (real and imaginary part) of an `n` x `n` matrix given by its entries (row, column), in no
/// order. Returns `None` when the iteration does not converge (entries that are not finite).
pub fn eigenvalues(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<Vec<(f64, f64)>> {
    let matrix = faer::Mat::from_fn(n, n, entry);
    if !matrix.col_iter().all(|c| c.iter().all(|v| v.is_finite())) {
        return None;
    }
    let values = matrix.eigenvalues().ok()?;
    Some(values.into_iter().map(|z| (z.re, z.im)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_eigenvalues_of_a_chain() {
        // Fixed-fixed chain of springs: 2 - 2 cos(k pi / (n + 1)).
        let n = 12;
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        };
        let values = symmetric_eigenvalues(n, entry).expect("a finite matrix");
        for (k, value) in values.iter().enumerate() {
            let angle = (k + 1) as f64 * std::f64::consts::PI / (n + 1) as f64;
            assert!((value - (2.0 - 2.0 * angle.cos())).abs() < 1e-14);
        }
        assert!(symmetric_eigenvalues(2, |_, _| f64::NAN).is_none());
    }

    #[test]
    fn finds_the_eigenvalues_of_a_turning_pair() {
        // Two oscillators coupled by a gyroscopic force: x'' = -x + g y', y'' = -4 y - g x'.
        let g = 0.7;
        let rows = [
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [-1.0, 0.0, 0.0, g],
            [0.0, -4.0, -g, 0.0],
        ];
        let values = eigenvalues(4, |i, j| rows[i][j]).expect("a finite matrix");
        for (re, im) in values {
            // w^4 - (5 + g^2) w^2 + 4 = 0
            let square = im * im;
            let left = square * square - (5.0 + g * g) * square + 4.0;
            assert!(re.abs() < 1e-13 && left.abs() < 1e-12);
        }
    }
}
