//! Curvatures of a point of quadrature, as arrays: the exterior product and what goes with it.
//!
//! Source: D. Hestenes, G. Sobczyk, Clifford Algebra to Geometric Calculus (1984), section 1-1 (exterior product).

use crate::elements::line::Components;
use crate::math::lanes::Real;

/// Components of a curvature: all of them in space, the first alone in the plane.
pub(in crate::elements::cable) const TURNS: usize = 3;

/// Number of planes that vectors span: components of a curvature.
pub(super) const fn turns(dimension: usize) -> usize {
    dimension * (dimension - 1) / 2
}

/// Inner product of two curvatures.
#[inline(always)]
pub(super) fn inner<N: Real, const D: usize>(a: &[N; TURNS], b: &[N; TURNS]) -> N {
    let mut sum = a[0] * b[0];
    for k in 1..turns(D) {
        sum = a[k].times_plus(b[k], sum);
    }
    sum
}

/// Exterior product u ^ w: the signed area in the plane, the cross product (reordered) in space.
#[inline(always)]
pub(super) fn wedge<N: Real, const D: usize>(
    u: &Components<N, D>,
    w: &Components<N, D>,
) -> [N; TURNS] {
    let (mut c, mut k) = ([u[0].constant(0.0); TURNS], 0);
    for i in 0..D {
        for j in i + 1..D {
            c[k] = u[i] * w[j] - u[j] * w[i];
            k += 1;
        }
    }
    c
}

/// Contraction with the exterior product: `contract(m, u) . w = m . (u ^ w)`.
#[inline(always)]
pub(super) fn contract<N: Real, const D: usize>(
    m: &[N; TURNS],
    u: &Components<N, D>,
) -> Components<N, D> {
    let (mut out, mut k) = ([u[0].constant(0.0); D], 0);
    for i in 0..D {
        for j in i + 1..D {
            out[j] = m[k].times_plus(u[i], out[j]);
            out[i] = (-m[k]).times_plus(u[j], out[i]);
            k += 1;
        }
    }
    out
}
