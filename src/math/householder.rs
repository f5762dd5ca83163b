//! Householder reflections, H = I - tau v v^T, on slices.
//!
//! Source: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., algorithm 5.1.1.

use super::vector::{dot, norm};

/// Converts `x` into the vector `v` of a reflection that maps `x` to `beta` times the first unit
/// vector, with `v[0] = 1`. Returns (`tau`, `beta`); a zero vector gives `tau = 0`.
pub fn reflector(x: &mut [f64]) -> (f64, f64) {
    let norm = norm(x);
    if norm == 0.0 {
        return (0.0, 0.0);
    }
    let beta = -norm.copysign(x[0]);
    let head = x[0] - beta;
    x[0] = 1.0;
    x[1..].iter_mut().for_each(|v| *v /= head);
    (-head / beta, beta)
}

/// Applies I - tau v v^T to `x`.
pub fn reflect(v: &[f64], tau: f64, x: &mut [f64]) {
    let factor = tau * dot(v, x);
    x.iter_mut().zip(v).for_each(|(x, v)| *x -= factor * v);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_a_vector_to_the_first_axis() {
        let x = [3.0, -1.0, 2.0, 0.5];
        let mut v = x;
        let (tau, beta) = reflector(&mut v);
        let mut y = x;
        reflect(&v, tau, &mut y);
        assert!((y[0] - beta).abs() < 1e-15 && norm(&y[1..]) < 1e-15);
        assert!((beta.abs() - norm(&x)).abs() < 1e-15);
        assert_eq!(reflector(&mut [0.0, 0.0]), (0.0, 0.0));
    }
}
