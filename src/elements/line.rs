//! The cubic line that a cable and a rod share, at a point of quadrature: sums of products of the three vectors
//! `(r_B - r_A) / l`, slope at A, slope at B, as arrays, and the weights of these vectors in `r'` and `l r''`.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eqs. 5 and 9, by the reference length.

use crate::math::lanes::Real;
use crate::math::quadrature::QuadraturePoint;

/// Changes numbers one by one. No closures: they are not inlined everywhere, and then not compiled for
/// the processor at hand.
macro_rules! each {
    ($out:expr, $k:ident => $of:expr) => {{
        let mut out = $out;
        for $k in 0..out.len() {
            out[$k] = $of;
        }
        out
    }};
}

/// Something of rates where damping reads them. No closures here either.
macro_rules! of_rate {
    ($rate:expr, $some:ident => $of:expr) => {
        match $rate {
            Some($some) => Some($of),
            None => None,
        }
    };
}

pub(super) type Components<N, const D: usize> = [N; D];

/// Weights of the three vectors in `r'` and `l r''`.
pub(super) type Combination = [f64; 3];

/// A quadrature point with the weights of the vectors there.
#[derive(Debug, PartialEq)]
pub(super) struct Sample {
    pub at: f64,
    pub weight: f64,
    pub slope: Combination,
    pub curvature: Combination,
}

pub(super) const fn sample(point: QuadraturePoint) -> Sample {
    let at = point.at;
    let square = at * at;
    Sample {
        at,
        weight: point.weight,
        slope: [
            6.0 * (at - square),
            1.0 - 4.0 * at + 3.0 * square,
            3.0 * square - 2.0 * at,
        ],
        curvature: [6.0 - 12.0 * at, 6.0 * at - 4.0, 6.0 * at - 2.0],
    }
}

#[inline(always)]
pub(super) fn combine<N: Real, const D: usize>(
    weights: &Combination,
    v: &[Components<N, D>; 3],
) -> Components<N, D> {
    // Ends of an element see one vector alone; known when compiling.
    match weights {
        [0.0, 1.0, 0.0] => v[1],
        [0.0, 0.0, 1.0] => v[2],
        _ => {
            let [p, q, r] = weights;
            let [p, q, r] = [
                v[0][0].constant(*p),
                v[0][0].constant(*q),
                v[0][0].constant(*r),
            ];
            each!(v[0], i => {
                v[2][i].times_plus(r, v[1][i].times_plus(q, v[0][i] * p))
            })
        }
    }
}

#[inline(always)]
pub(super) fn dot<N: Real, const K: usize>(a: &[N; K], b: &[N; K]) -> N {
    let mut sum = a[0] * b[0];
    for k in 1..K {
        sum = a[k].times_plus(b[k], sum);
    }
    sum
}

#[inline(always)]
pub(super) fn times<N: Real, const K: usize>(a: &[N; K], factor: N) -> [N; K] {
    each!(*a, k => a[k] * factor)
}
