//! The constitutive law of sections at the Gauss points of an element: stress by strain and by its rate, each by one matrix. Rods have three
//! components, beams six and planar beams three.
//!
//! Source: `stress = C (s - s0) + T^1/2 C T^1/2 s'` with Kelvin-Voigt damping times `T` (W. Fluegge, Viscoelasticity, 2nd ed. (1975), chapter
//! 1, of every component).

use super::rod::ROUNDOFF;
use crate::math::lanes::{Lanes, PACK, Real, Simd};

/// Builds an array of laws `[points][K][K]` from an expression for each entry.
macro_rules! entries {
    ($k:ident, $i:ident, $j:ident => $entry:expr) => {
        std::array::from_fn(|$k| std::array::from_fn(|$i| std::array::from_fn(|$j| $entry)))
    };
}

/// Material law of one element or, in lanes, of several. `K` is the number of strains.
#[derive(Clone, Debug)]
pub(super) struct Law<N, const K: usize> {
    /// Stress by strain at the points.
    pub stiffness: [[[N; K]; K]; 3],
    /// Stress by rate of strain.
    pub damping: [[[N; K]; K]; 3],
    /// Offset added to the strains before they are multiplied by the stiffness, `[points][K]`. It is minus the strain
    /// of the unstressed shape.
    pub offset: [[N; K]; 3],
    pub is_damped: bool,
}

impl<const K: usize> Law<f64, K> {
    /// Without stress where there is no strain.
    pub fn new(stiffness: [[[f64; K]; K]; 3], times: [f64; K]) -> Self {
        Self {
            stiffness,
            damping: entries!(k, i, j => stiffness[k][i][j] * (times[i] * times[j]).sqrt()),
            offset: [[0.0; K]; 3],
            is_damped: times.iter().any(|time| *time > 0.0),
        }
    }

    /// Without stress at these strains at the points, `per` of which (powers of the length) a number of the size `far` is; strains that are
    /// roundoff are none.
    pub fn unstressed_at(&mut self, strains: [[f64; K]; 3], per: [f64; K], far: f64) {
        for (offset, strains) in self.offset.iter_mut().zip(strains) {
            for k in 0..K {
                if strains[k].abs() * per[k] > ROUNDOFF * far {
                    offset[k] = -strains[k];
                }
            }
        }
    }

    /// Packs the laws of up to [`PACK`] elements into lanes. Spare lanes repeat the last element.
    pub fn pack(laws: &[&Self]) -> Law<[f64; PACK], K> {
        let last = laws.len() - 1;
        let lanes = |of: &dyn Fn(&Self) -> f64| -> [f64; PACK] {
            std::array::from_fn(|lane| of(laws[lane.min(last)]))
        };
        Law {
            stiffness: entries!(k, i, j => lanes(&|law| law.stiffness[k][i][j])),
            damping: entries!(k, i, j => lanes(&|law| law.damping[k][i][j])),
            offset: std::array::from_fn(|k| {
                std::array::from_fn(|i| lanes(&|law| law.offset[k][i]))
            }),
            is_damped: laws[0].is_damped,
        }
    }

    /// Converts the law to constants of the number type of `like`.
    #[inline(always)]
    pub fn lift<N: Real>(&self, like: N) -> Law<N, K> {
        let row = |row: [f64; K]| row.map(|value| like.constant(value));
        Law {
            stiffness: self.stiffness.map(|square| square.map(row)),
            damping: self.damping.map(|square| square.map(row)),
            offset: self.offset.map(row),
            is_damped: self.is_damped,
        }
    }
}

impl<const K: usize> Law<[f64; PACK], K> {
    /// A group of the elements of a pack; damping where there is any.
    #[inline(always)]
    pub fn group<S: Simd>(&self, simd: S, group: usize) -> Law<Lanes<S>, K> {
        let any = Lanes::read(simd, &self.offset[0][0], group);
        let mut law = Law {
            stiffness: [[[any; K]; K]; 3],
            damping: [[[any; K]; K]; 3],
            offset: [[any; K]; 3],
            is_damped: self.is_damped,
        };
        for k in 0..3 {
            for i in 0..K {
                for j in 0..K {
                    law.stiffness[k][i][j] = Lanes::read(simd, &self.stiffness[k][i][j], group);
                    if self.is_damped {
                        law.damping[k][i][j] = Lanes::read(simd, &self.damping[k][i][j], group);
                    }
                }
                law.offset[k][i] = Lanes::read(simd, &self.offset[k][i], group);
            }
        }
        law
    }
}
