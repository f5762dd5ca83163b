//! Eigenvalues of dense matrices, at set-up only.

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{DMatrix, Dyn, Hessenberg, SymmetricEigen};

use super::hessenberg;

/// Iterations over rows; two or three a row are usual.
const ITERATIONS: usize = 60;

/// Eigenvalues of a symmetric `n` x `n` matrix given by its entries (row, column), ascending.
/// Returns `None` when the iteration does not converge (entries that are not finite).
pub fn symmetric_eigenvalues(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<Vec<f64>> {
    let matrix = finite(n, entry)?;
    if n == 0 {
        return Some(Vec::new());
    }
    let mut values = symmetric(matrix)?.eigenvalues.data.as_vec().clone();
    values.sort_by(f64::total_cmp);
    Some(values)
}

/// Eigenvalues of a symmetric matrix, ascending, and its eigenvectors as columns.
/// Returns `None` when the iteration does not converge (entries that are not finite).
pub fn symmetric_eigenvectors(matrix: DMatrix<f64>) -> Option<(Vec<f64>, DMatrix<f64>)> {
    let n = matrix.nrows();
    let matrix = finite(n, |i, j| matrix[(i, j)])?;
    if n == 0 {
        return Some((Vec::new(), matrix));
    }
    let found = symmetric(matrix)?;
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| found.eigenvalues[*a].total_cmp(&found.eigenvalues[*b]));
    let values = order.iter().map(|k| found.eigenvalues[*k]).collect();
    Some((values, found.eigenvectors.select_columns(&order)))
}

fn symmetric(matrix: DMatrix<f64>) -> Option<SymmetricEigen<f64, Dyn>> {
    let most = ITERATIONS * matrix.nrows();
    SymmetricEigen::try_new(matrix, f64::EPSILON, most)
}

/// Eigenvalues (real and imaginary part) of an `n` x `n` matrix given by its entries (row, column), in no
/// order. Returns `None` when the iteration does not converge (entries that are not finite).
pub fn eigenvalues(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<Vec<(f64, f64)>> {
    let mut matrix = finite(n, entry)?;
    let size = matrix.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    if size == 0.0 {
        return Some(vec![(0.0, 0.0); n]);
    }
    matrix.unscale_mut(size);
    balance_parlett_reinsch(&mut matrix);
    let mut values = hessenberg::eigenvalues(Hessenberg::new(matrix).unpack_h())?;
    for (re, im) in &mut values {
        *re *= size;
        *im *= size;
    }
    let finite = values
        .iter()
        .all(|(re, im)| re.is_finite() && im.is_finite());
    finite.then_some(values)
}

/// A matrix given by its entries, unless one is not finite.
fn finite(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<DMatrix<f64>> {
    let matrix = DMatrix::from_fn(n, n, entry);
    matrix.iter().all(|x| x.is_finite()).then_some(matrix)
}
