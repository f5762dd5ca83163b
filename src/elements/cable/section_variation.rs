//! Mass of a cable, uniform or tapered.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eq. 12; docs/decisions/0012-mass-against-dispersion.md.

use nalgebra::{SMatrix, SVector};

use super::{Inertia, Parameters};
use crate::elements::{ElementPolynomial, shape};
use crate::math::quadrature::GAUSS_5;

/// Factors along an element of the stiffnesses and the mass of [`Parameters`], 1 by default, and the mass of the fluid
/// that moves along.
#[derive(Clone, Copy, Debug)]
pub struct SectionVariation {
    /// Factor of the axial stiffness.
    pub axial: ElementPolynomial,
    /// Factor of the bending stiffness.
    pub bending: ElementPolynomial,
    /// Factor of the mass per reference length.
    pub density: ElementPolynomial,
    /// Mass per reference length of the fluid that moves along, kg/m; none by default. It has inertia and no weight.
    pub added: ElementPolynomial,
}

impl Default for SectionVariation {
    fn default() -> Self {
        let [axial, bending, density] = [ElementPolynomial::from(1.0); 3];
        Self {
            axial,
            bending,
            density,
            added: ElementPolynomial::from(0.0),
        }
    }
}

impl SectionVariation {
    /// Mass per reference length that is moved at `xi` in [0, 1], kg/m: that of the cable and that of the fluid.
    pub(super) fn moved(&self, parameters: &Parameters, xi: f64) -> f64 {
        parameters.line_density * self.density.at(xi) + self.added.at(xi)
    }

    /// Returns the mean mass per reference length of the element with the fluid that moves along, kg/m.
    pub(super) fn mean_moved(&self, parameters: &Parameters) -> f64 {
        parameters.line_density * self.density.mean() + self.added.mean()
    }

    /// Whether what is moved is the same everywhere.
    pub(super) fn moves_evenly(&self) -> bool {
        self.density.is_uniform() && self.added.is_uniform()
    }
}

/// Consistent mass matrix of a line of length `l` (m), relative to its mass.
fn consistent(l: f64) -> SMatrix<f64, 4, 4> {
    let (a, b) = (13.0 / 35.0, 9.0 / 70.0);
    let (c, d) = (11.0 * l / 210.0, 13.0 * l / 420.0);
    let (f, g) = (l * l / 105.0, l * l / 140.0);
    SMatrix::from([[a, c, b, -d], [c, f, d, -g], [b, d, a, -c], [-d, -g, -c, f]])
}

/// A consistent mass matrix with what quadratic and cubic parts of the velocity count more often than once.
fn corrected(
    consistent: SMatrix<f64, 4, 4>,
    l: f64,
    inertia: Inertia,
    bends: bool,
) -> SMatrix<f64, 4, 4> {
    let [quadratic, cubic] = match inertia {
        Inertia::Consistent => [0.0, 0.0],
        Inertia::Corrected if bends => [1.0, 23.0 / 3.0],
        Inertia::Corrected => [0.6, 23.0 / 3.0],
    };
    let second = SVector::from([0.0, -l / 12.0, 0.0, l / 12.0]);
    let third = SVector::from([0.1, 0.05 * l, -0.1, 0.05 * l]);
    consistent
        + second * second.transpose() * (quadratic / 5.0)
        + third * third.transpose() * (cubic / 7.0)
}

/// Mass matrix of a line of this length (m) with a mass of 1 kg/m that bends.
pub(in crate::elements) fn line_mass(length: f64, inertia: Inertia) -> SMatrix<f64, 4, 4> {
    corrected(consistent(length), length, inertia, true) * length
}

/// Mass matrix of a cable with or without bending stiffness, that of the fluid which moves along with it.
pub(super) fn mass(
    parameters: &Parameters,
    taper: &SectionVariation,
    bends: bool,
) -> SMatrix<f64, 4, 4> {
    let (l, mean) = (parameters.length, taper.mean_moved(parameters));
    let consistent = if taper.moves_evenly() {
        consistent(l)
    } else {
        let terms = GAUSS_5.iter().map(|point| {
            let values = shape::values(point.at, l);
            let weight = point.weight * taper.moved(parameters, point.at) / mean;
            values * values.transpose() * weight
        });
        terms.sum()
    };
    corrected(consistent, l, parameters.inertia, bends) * (mean * l)
}
