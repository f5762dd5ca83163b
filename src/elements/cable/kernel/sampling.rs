//! Points of a cable element at which strains are sampled.
//!
//! Source: J. Gerstmayr, H. Irschik, J. Sound Vib. 318 (2008), section 3 (separate rules for stretching and bending);
//! docs/decisions/0003-quadrature.md, 0021-stable-equilibria.md.

use crate::elements::ElementPolynomial;
use crate::elements::line::{Sample, sample};
use crate::math::quadrature::{BETWEEN_3, GAUSS_3, LOBATTO_3, RADAU_3, RADAU_3_LAST};

pub(super) const BETWEEN: [Sample; 3] = [
    sample(BETWEEN_3[0]),
    sample(BETWEEN_3[1]),
    sample(BETWEEN_3[2]),
];
pub(super) const LOBATTO: [Sample; 3] = [
    sample(LOBATTO_3[0]),
    sample(LOBATTO_3[1]),
    sample(LOBATTO_3[2]),
];
pub(super) const RADAU: [Sample; 3] = [sample(RADAU_3[0]), sample(RADAU_3[1]), sample(RADAU_3[2])];
pub(super) const RADAU_LAST: [Sample; 3] = [
    sample(RADAU_3_LAST[0]),
    sample(RADAU_3_LAST[1]),
    sample(RADAU_3_LAST[2]),
];
pub(super) const BENDING: [Sample; 3] =
    [sample(GAUSS_3[0]), sample(GAUSS_3[1]), sample(GAUSS_3[2])];

/// Points that axial strain is sampled at (docs/decisions/0003-quadrature.md, 0021-stable-equilibria.md).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::elements::cable) enum Sampling {
    /// Between Gauss and Lobatto: short elements.
    Between,
    /// Lobatto: slender elements.
    Lobatto,
    /// Radau without the last end: slender elements without bending stiffness whose last end is free.
    FreeLast,
    /// Radau without the first end.
    FreeFirst,
}

impl Sampling {
    /// A quantity at the points that is this one, tapered.
    pub fn of(self, quantity: f64, taper: &ElementPolynomial) -> [f64; 3] {
        let points = self.points().each_ref();
        points.map(|point| quantity * taper.at(point.at))
    }

    pub(super) fn points(self) -> &'static [Sample; 3] {
        match self {
            Self::Between => &BETWEEN,
            Self::Lobatto => &LOBATTO,
            Self::FreeLast => &RADAU,
            Self::FreeFirst => &RADAU_LAST,
        }
    }
}
