//! Equations that may depend on each other: their least solution, and where it is not plain whether they do.

use faer::Mat;
use flexbody::system::{State, System, Workspace};
use nalgebra::{DMatrix, DVector};

/// Square of the part of the largest singular value below which rows depend on each other.
const DEPENDENT: f64 = 1e-12;

/// The least `x` of `A x = b`. By eigenvalues of `A A^T`, with what they leave solved for again: `x = A^T z` is least
/// however `z` is found. The singular value decomposition at hand (nalgebra 0.35) can leave a hundredth of `b`.
pub fn least(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let eigen = (a * a.transpose()).symmetric_eigen();
    let none = DEPENDENT * eigen.eigenvalues.max();
    let mut x = DVector::zeros(a.ncols());
    for _ in 0..4 {
        let mut z = eigen.eigenvectors.tr_mul(&(b - a * &x));
        for (part, square) in z.iter_mut().zip(&eigen.eigenvalues) {
            *part = if *square > none { *part / square } else { 0.0 };
        }
        x += a.tr_mul(&(&eigen.eigenvectors * z));
    }
    x
}

/// Part of a row of constraints that others must leave for it to count in accelerations: the product's own bound, for the
/// reasons in decision 29.
const COUNTS: f64 = 1e-3;
/// Singular value below which rows of unit length depend on each other but for rounding.
const ROUNDING: f64 = 1e-10;

/// Whether a state is so near a singular position that rows of constraints may not count which are not redundant: there
/// accelerations are not those of all constraints, by decision 29, and projections, which are finer, differ from them.
///
/// Each of `m` rows of unit length that does not count leaves less than [`COUNTS`] beside those that do. If `r` rows count,
/// singular values after the first `r` are therefore below `sqrt(m)` times that (Eckart and Young), in whatever order
/// rows are looked at: where none lies between this and rounding, rows that count give all others.
pub fn is_near_singular(system: &System<3>, state: &State, work: &mut Workspace<3>) -> bool {
    let n = system.coordinates();
    let mut rows = Vec::new();
    work.resume(state);
    system.visit_constraints(state.time, &state.coordinates, None, work, |row| {
        rows.push(DVector::from_vec(row.gradient(n)).normalize());
    });
    if rows.is_empty() {
        return false;
    }
    let matrix = Mat::from_fn(rows.len(), n, |i, j| rows[i][j]);
    let sizes = matrix.singular_values().expect("singular values");
    let doubtful = ROUNDING..(rows.len() as f64).sqrt() * COUNTS;
    sizes.iter().any(|size| doubtful.contains(size))
}
