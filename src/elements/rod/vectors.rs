//! Vectors of space as arrays, and the smallest rotation between two directions.
//!
//! Source: M. Bergou et al., Discrete elastic rods, ACM Trans. Graph. 27 (2008), section 4.2 (parallel transport).

use crate::elements::line::{dot, times};
use crate::math::lanes::Real;

pub(in crate::elements) type Vector<N> = [N; 3];

#[inline(always)]
pub(in crate::elements) fn cross<N: Real>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
pub(in crate::elements) fn add<N: Real, const K: usize>(a: &[N; K], b: &[N; K]) -> [N; K] {
    each!(*a, k => a[k] + b[k])
}

/// `a factor + b`.
#[inline(always)]
pub(in crate::elements) fn plus<N: Real, const K: usize>(
    a: &[N; K],
    factor: N,
    b: &[N; K],
) -> [N; K] {
    each!(*a, k => a[k].times_plus(factor, b[k]))
}

/// Returns the component of `v` perpendicular to the unit vector `t`.
#[inline(always)]
pub(in crate::elements) fn across<N: Real>(t: &Vector<N>, v: &Vector<N>) -> Vector<N> {
    plus(t, -dot(t, v), v)
}

/// Unit vector along `u`, and one over its length.
#[inline(always)]
pub(in crate::elements) fn unit<N: Real>(u: &Vector<N>) -> (Vector<N>, N) {
    let inverse = u[0].constant(1.0) / dot(u, u).root();
    (times(u, inverse), inverse)
}

/// Rotates `v`, which is perpendicular to `a`, by the smallest rotation from the unit vector `a` to the unit vector
/// `b`. `inverse` is `1 / (1 + a . b)`.
#[inline(always)]
pub(in crate::elements) fn carry<N: Real>(
    a: &Vector<N>,
    b: &Vector<N>,
    inverse: N,
    v: &Vector<N>,
) -> Vector<N> {
    plus(&add(a, b), -(dot(b, v) * inverse), v)
}
