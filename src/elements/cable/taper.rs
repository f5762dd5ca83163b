//! Mass of a cable, uniform or tapered.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eq. 12; docs/decisions/0012-mass-against-dispersion.md.

use nalgebra::{SMatrix, SVector};

use super::{Inertia, Parameters};
use crate::elements::{Along, shape};
use crate::math::quadrature::GAUSS_5;

/// What the stiffnesses and the mass of [`Parameters`] are multiplied by along an element; one everywhere by default.
#[derive(Clone, Copy, Debug)]
pub struct Taper {
    /// Of axial stiffness.
    pub axial: Along,
    /// Of bending stiffness.
    pub bending: Along,
    /// Of mass per reference length.
    pub density: Along,
}

impl Default for Taper {
    fn default() -> Self {
        let [axial, bending, density] = [Along::from(1.0); 3];
        Self {
            axial,
            bending,
            density,
        }
    }
}

/// Mass matrix of a cable with or without bending stiffness.
pub(super) fn mass(parameters: &Parameters, taper: &Along, bends: bool) -> SMatrix<f64, 4, 4> {
    let l = parameters.length;
    let (a, b) = (13.0 / 35.0, 9.0 / 70.0);
    let (c, d) = (11.0 * l / 210.0, 13.0 * l / 420.0);
    let (f, g) = (l * l / 105.0, l * l / 140.0);
    let density = parameters.line_density * taper.mean();
    let mut consistent =
        SMatrix::from([[a, c, b, -d], [c, f, d, -g], [b, d, a, -c], [-d, -g, -c, f]]);
    if !taper.is_uniform() {
        let terms = GAUSS_5.iter().map(|point| {
            let values = shape::values(point.at, l);
            let weight = point.weight * taper.at(point.at) / taper.mean();
            values * values.transpose() * weight
        });
        consistent = terms.sum();
    }
    let [quadratic, cubic] = match parameters.inertia {
        Inertia::Consistent => [0.0, 0.0],
        Inertia::Corrected if bends => [1.0, 23.0 / 3.0],
        Inertia::Corrected => [0.6, 23.0 / 3.0],
    };
    let second = SVector::from([0.0, -l / 12.0, 0.0, l / 12.0]);
    let third = SVector::from([0.1, 0.05 * l, -0.1, 0.05 * l]);
    let mass = consistent
        + second * second.transpose() * (quadratic / 5.0)
        + third * third.transpose() * (cubic / 7.0);
    mass * (density * l)
}
