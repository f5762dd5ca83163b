//! Points of a cable element at which strains are sampled, with the weights of the three vectors there.
//!
//! Source: J. Gerstmayr, H. Irschik, J. Sound Vib. 318 (2008), section 3 (separate rules for stretching and bending);
//! docs/decisions/0003-quadrature.md, 0021-stable-equilibria.md.

use crate::math::quadrature::{BETWEEN_3, GAUSS_3, LOBATTO_3, Point, RADAU_3, RADAU_3_LAST};

/// Weights of the three vectors in `r'` and `l r''`.
pub(super) type Combination = [f64; 3];

/// A quadrature point with the weights of the vectors there.
#[derive(Debug, PartialEq)]
pub(in crate::elements::cable) struct Sample {
    pub weight: f64,
    pub slope: Combination,
    pub curvature: Combination,
}

const fn sample(point: Point) -> Sample {
    let at = point.at;
    let square = at * at;
    Sample {
        weight: point.weight,
        slope: [
            6.0 * (at - square),
            1.0 - 4.0 * at + 3.0 * square,
            3.0 * square - 2.0 * at,
        ],
        curvature: [6.0 - 12.0 * at, 6.0 * at - 4.0, 6.0 * at - 2.0],
    }
}

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
    pub(super) fn points(self) -> &'static [Sample; 3] {
        match self {
            Self::Between => &BETWEEN,
            Self::Lobatto => &LOBATTO,
            Self::FreeLast => &RADAU,
            Self::FreeFirst => &RADAU_LAST,
        }
    }
}
