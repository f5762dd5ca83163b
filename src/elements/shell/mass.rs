//! Mass of an element: the tensor product of the corrected matrices of two lines (docs/decisions/0012-mass-against-dispersion.md).
//!
//! Source: docs/decisions/0076-plates-and-shells.md; A. A. Shabana, report MBS97-2-UIC (1997), Eq. 12, in both directions.

use nalgebra::SMatrix;

use super::{Corner, VECTORS};
use crate::elements::cable::{Inertia, line_mass};
use crate::elements::shape;
use crate::math::quadrature::GAUSS_5;

/// Mass over the functions of an element: corner by corner, the vectors `r`, `r1`, `r2`, `r12` of each.
pub type Mass = SMatrix<f64, 16, 16>;

/// Function of each direction of number `k` of an element.
pub(super) fn functions(k: usize) -> (usize, usize) {
    let (corner, vector) = (k / VECTORS, k % VECTORS);
    (2 * (corner / 2) + vector % 2, 2 * (corner % 2) + vector / 2)
}

/// Factor of number `k` of an element that makes it a derivative by lengths.
fn factor(k: usize, unit: f64) -> f64 {
    if k % VECTORS == 3 { 1.0 / unit } else { 1.0 }
}

/// Mass per area times the area by both lengths, at `xi` and `eta`.
fn density(
    corners: &[Corner; 4],
    (sizes, unit): ([f64; 2], f64),
    area_density: f64,
    at: [f64; 2],
) -> f64 {
    let mut derivatives = [[0.0; 3]; 2];
    let [values, slopes] = [shape::values::<f64>, shape::slopes::<f64>]
        .map(|of| [of(at[0], sizes[0]), of(at[1], sizes[1])]);
    for k in 0..16 {
        let ((alpha, beta), vector) = (functions(k), corners[k / VECTORS][k % VECTORS]);
        let vector = vector.map(|component| component * factor(k, unit));
        for d in 0..3 {
            derivatives[0][d] += slopes[0][alpha] * values[1][beta] * vector[d];
            derivatives[1][d] += values[0][alpha] * slopes[1][beta] * vector[d];
        }
    }
    let [first, second] = derivatives.map(nalgebra::Vector3::from);
    area_density * first.cross(&second).norm()
}

/// Mass of an element with these lengths and unit of mixed derivatives (m), coordinates of the unstressed surface and mass per area at
/// `xi` and `eta` (kg/m^2).
pub(super) fn mass(
    corners: &[Corner; 4],
    (sizes, unit): ([f64; 2], f64),
    area_density: impl Fn([f64; 2]) -> f64,
) -> Mass {
    let lines = |inertia: Inertia| sizes.map(|size| line_mass(size, inertia));
    let tensor = |lines: [SMatrix<f64, 4, 4>; 2]| {
        Mass::from_fn(|row, column| {
            let ((a, b), (c, d)) = (functions(row), functions(column));
            lines[0][(a, c)] * lines[1][(b, d)]
        })
    };
    let (mut consistent, mut mean) = (Mass::zeros(), 0.0);
    for first in &GAUSS_5 {
        for second in &GAUSS_5 {
            let at = [first.at, second.at];
            let weight = first.weight * second.weight;
            let density = density(corners, (sizes, unit), area_density(at), at);
            let values = [0, 1].map(|of| shape::values(at[of], sizes[of]));
            let functions = nalgebra::SVector::<f64, 16>::from_fn(|k, _| {
                let (alpha, beta) = functions(k);
                values[0][alpha] * values[1][beta]
            });
            let part = weight * sizes[0] * sizes[1] * density;
            consistent += functions * functions.transpose() * part;
            mean += weight * density;
        }
    }
    let correction = tensor(lines(Inertia::Corrected)) - tensor(lines(Inertia::Consistent));
    let mass = consistent + correction * mean;
    Mass::from_fn(|r, c| mass[(r, c)] * factor(r, unit) * factor(c, unit))
}
