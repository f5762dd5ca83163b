//! Vectors of space as arrays, and the smallest rotation between two directions.
//!
//! Source: M. Bergou et al., Discrete elastic rods, ACM Trans. Graph. 27 (2008), section 4.2 (parallel transport).

use crate::elements::line::{dot, times};
use crate::math::lanes::Real;

pub(super) type Vector<N> = [N; 3];

#[inline(always)]
pub(super) fn cross<N: Real>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
pub(super) fn add<N: Real>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    each!(*a, k => a[k] + b[k])
}

/// `a factor + b`.
#[inline(always)]
pub(super) fn plus<N: Real>(a: &Vector<N>, factor: N, b: &Vector<N>) -> Vector<N> {
    each!(*a, k => a[k].times_plus(factor, b[k]))
}

/// What of `v` is across the unit vector `t`.
#[inline(always)]
pub(super) fn across<N: Real>(t: &Vector<N>, v: &Vector<N>) -> Vector<N> {
    plus(t, -dot(t, v), v)
}

/// Unit vector along `u`, and one over its length.
#[inline(always)]
pub(super) fn unit<N: Real>(u: &Vector<N>) -> (Vector<N>, N) {
    let inverse = u[0].constant(1.0) / dot(u, u).root();
    (times(u, inverse), inverse)
}

/// What the smallest rotation that takes the unit vector `a` to `b` makes of `v`, which is across `a`; `inverse` is
/// `1 / (1 + a . b)`.
#[inline(always)]
pub(super) fn carry<N: Real>(a: &Vector<N>, b: &Vector<N>, inverse: N, v: &Vector<N>) -> Vector<N> {
    plus(&add(a, b), -(dot(b, v) * inverse), v)
}
