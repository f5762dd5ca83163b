//! Shape functions of elements with position and slope at both ends: cubic Hermite polynomials.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eqs. 5 and 9; the fourth function is misprinted
//! there and reads `l (xi^3 - xi^2)`, which is what Eq. 12 integrates.

use nalgebra::{RowVector4, SVector};

use super::Nodal;
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::Vector;

/// Values at the Gauss points of an element or of another segment.
pub type Values<const K: usize, N> = [Vector<K, N>; GAUSS_5.len()];

/// Shape functions `S` at `xi` in [0, 1] of an element of length `l` (m): `r = S e`.
pub fn values<N: Number>(xi: N, l: f64) -> SVector<N, 4> {
    let (x2, x3, l) = (xi * xi, xi * xi * xi, N::of(l));
    let rise = N::of(3.0) * x2 - N::of(2.0) * x3;
    [
        N::of(1.0) - rise,
        l * (xi - N::of(2.0) * x2 + x3),
        rise,
        l * (x3 - x2),
    ]
    .into()
}

/// Derivatives of the shape functions by the reference length: `r' = S' e`.
pub fn slopes<N: Number>(xi: N, l: f64) -> SVector<N, 4> {
    let x2 = xi * xi;
    let rise = N::of(6.0) * (xi - x2) / N::of(l);
    let end = N::of(3.0) * x2 - N::of(2.0) * xi;
    [-rise, N::of(1.0) - N::of(2.0) * xi + end, rise, end].into()
}

/// Second derivatives of the shape functions by the reference length: `r'' = S'' e`.
pub fn curvatures<N: Number>(xi: N, l: f64) -> SVector<N, 4> {
    let (six, l) = (N::of(6.0) * xi, N::of(l));
    let bend = (N::of(6.0) - N::of(2.0) * six) / (l * l);
    let [first, second] = [4.0, 2.0].map(|less| (six - N::of(less)) / l);
    [-bend, first, bend, second].into()
}

/// Integrals of the shape functions over the reference length up to `xi`, m.
pub fn integrals<N: Number>(xi: N, l: f64) -> SVector<N, 4> {
    let [x2, x3, x4] = [xi * xi, xi * xi * xi, xi * xi * xi * xi];
    let (l, over) = (N::of(l), |x: N, divisor: f64| x / N::of(divisor));
    let rise = x3 - over(x4, 2.0);
    let first = over(x2, 2.0) - over(x3 + x3, 3.0) + over(x4, 4.0);
    let second = over(x4, 4.0) - over(x3, 3.0);
    [l * (xi - rise), l * l * first, l * rise, l * l * second].into()
}

/// Weights at the Gauss points, m, of a vector per length of an element of this length (m) on its coordinates: position and slope at both
/// ends.
pub fn weights(length: f64) -> [[f64; 4]; GAUSS_5.len()] {
    GAUSS_5.map(|point| (values(point.at, length) * (point.weight * length)).into())
}

/// Returns the forces on the coordinates of an element of this length (m) of a force per length with these values at the Gauss points.
pub fn on_coordinates<const D: usize, N: Number>(
    values: &Values<D, N>,
    length: f64,
) -> Nodal<D, N> {
    let terms = values.iter().zip(weights(length));
    terms.fold(Nodal::zeros(), |sum, (value, weights)| {
        sum + value * RowVector4::from(weights).map(N::of)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolate_positions_and_slopes_at_both_ends() {
        let l = 0.7;
        assert_eq!(values(0.0, l), SVector::from([1.0, 0.0, 0.0, 0.0]));
        assert_eq!(slopes(0.0, l), SVector::from([0.0, 1.0, 0.0, 0.0]));
        assert_eq!(values(1.0, l), SVector::from([0.0, 0.0, 1.0, 0.0]));
        assert_eq!(slopes(1.0, l), SVector::from([0.0, 0.0, 0.0, 1.0]));
    }

    #[test]
    fn derivatives_match_central_differences() {
        let (l, h) = (0.7, 1e-5);
        for xi in [0.2, 0.5, 0.9] {
            let slope = (values(xi + h, l) - values(xi - h, l)) / (2.0 * h * l);
            let bend = (slopes(xi + h, l) - slopes(xi - h, l)) / (2.0 * h * l);
            let value = (integrals(xi + h, l) - integrals(xi - h, l)) / (2.0 * h * l);
            assert!((value - values(xi, l)).norm() < 1e-9);
            assert!((slope - slopes(xi, l)).norm() < 1e-9);
            assert!((bend - curvatures(xi, l)).norm() < 1e-8);
        }
    }
}
