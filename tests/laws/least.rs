//! The least solution of equations that may depend on each other.

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
