//! Eigenvalues of dense symmetric matrices, at set-up only.

/// Eigenvalues of a symmetric `n` x `n` matrix given by its entries (row, column), ascending.
/// Returns `None` when the iteration does not converge (entries that are not finite).
pub fn symmetric_eigenvalues(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<Vec<f64>> {
    let matrix = faer::Mat::from_fn(n, n, entry);
    if !matrix.col_iter().all(|c| c.iter().all(|v| v.is_finite())) {
        return None;
    }
    matrix.self_adjoint_eigenvalues(faer::Side::Lower).ok()
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
}
