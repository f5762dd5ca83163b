//! Strains of a section that leans away from the normal of the line, with their derivatives.
//!
//! Source: (1) and (2) of `beam/mod.rs`. With the lean `c = (0, p, q)`, `D = 1 / (1 + |c|^2 / 4)`, the stretch `n`, turning
//! `k = (a, b, b')` of the tangent's frame, `g = q b - p b'`, `m = a + g / 2` they are
//!
//! ```text
//! n (2 D - 1) - 1,   -n q D,   n p D
//! a (2 D - 1) + D (g + (q p' - p q') / 2),   b + D (p' - q m),   b' + D (q' + p m)
//! ```
//!
//! linear in all but the lean: their product with stresses is a constant and `D` times a polynomial of degree 2 in `p`, `q`.

use crate::elements::line::{dot, times};
use crate::elements::rod::vectors::plus;
use crate::math::lanes::Real;

/// Strains or stresses of a section: axial, shear along both axes across, twist, bending about both.
pub(super) type Six<N> = [N; 6];

/// What the strains of a section are made of, its rates, or the factors of these in a power.
#[derive(Clone, Copy)]
pub(super) struct Local<N> {
    /// Length of the slope of the line.
    pub stretch: N,
    /// Twist and curvatures of the tangent's frame, 1/m.
    pub turning: [N; 3],
    /// Lean about both axes of the tangent's frame across it.
    pub lean: [N; 2],
    /// Its derivative by the reference length, 1/m.
    pub change: [N; 2],
}

/// Derivatives of the strains by what they are made of: of the first three by stretch and lean, of the last by turning, lean and its
/// change.
pub(super) struct Rows<N> {
    forces: [[N; 3]; 3],
    moments: [[N; 7]; 3],
}

/// A section that leans.
pub(super) struct Leaning<N> {
    at: Local<N>,
    /// `D`.
    shrink: N,
    /// `2 D - 1`, the cosine of the angle between section's normal and tangent.
    cosine: N,
    /// `D c`.
    half: [N; 2],
    /// `g` and `m`.
    inner: [N; 2],
    /// `g + (q p' - p q') / 2`, `p' - q m`, `q' + p m`.
    moved: [N; 3],
}

/// Components along the axes of a section of a vector with these along the tangent's frame; the other way with the opposite lean.
#[inline(always)]
pub(super) fn leaned<N: Real>([p, q]: [N; 2], v: &[N; 3]) -> [N; 3] {
    let one = p.constant(1.0);
    let half = p.constant(0.5);
    let shrink = shrink(&[p, q]);
    let across = q * v[1] - p * v[2];
    let inner = half.times_plus(across, v[0]);
    [
        (shrink + shrink - one).times_plus(v[0], shrink * across),
        v[1] - q * shrink * inner,
        v[2] + p * shrink * inner,
    ]
}

/// `1 / (1 + |c|^2 / 4)`.
#[inline(always)]
fn shrink<N: Real>(lean: &[N; 2]) -> N {
    let one = lean[0].constant(1.0);
    one / dot(lean, lean).times_plus(one.constant(0.25), one)
}

impl<N: Real> Leaning<N> {
    #[inline(always)]
    pub fn new(at: Local<N>) -> Self {
        let ([p, q], [dp, dq], [a, b, other]) = (at.lean, at.change, at.turning);
        let (one, half) = (p.constant(1.0), p.constant(0.5));
        let shrink = shrink(&at.lean);
        let g = q * b - p * other;
        let m = half.times_plus(g, a);
        Self {
            at,
            shrink,
            cosine: shrink + shrink - one,
            half: [p * shrink, q * shrink],
            inner: [g, m],
            moved: [
                half.times_plus(q * dp - p * dq, g),
                dp - q * m,
                p.times_plus(m, dq),
            ],
        }
    }

    #[inline(always)]
    pub fn strains(&self) -> Six<N> {
        let (d, n, [x, y]) = (self.shrink, self.at.stretch, self.half);
        let ([a, b, other], moved) = (&self.at.turning, &self.moved);
        [
            n * self.cosine - n.constant(1.0),
            -(n * y),
            n * x,
            d.times_plus(moved[0], *a * self.cosine),
            d.times_plus(moved[1], *b),
            d.times_plus(moved[2], *other),
        ]
    }

    #[inline(always)]
    pub fn rows(&self) -> Rows<N> {
        let (d, cosine, [x, y], n) = (self.shrink, self.cosine, self.half, self.at.stretch);
        let ([p, q], [dp, dq], [a, b, other]) = (self.at.lean, self.at.change, self.at.turning);
        let ([_, m], moved) = (self.inner, &self.moved);
        let (zero, one, half) = (d.constant(0.0), d.constant(1.0), d.constant(0.5));
        let [xh, yh, nh] = [x * half, y * half, n * half];
        let (mixed, nd) = (nh * x * y, n * d);
        // What changes by `D` alone.
        let [lost_x, lost_y] = [d * xh, d * yh];
        let twist_x = other + half * dq + x * (a + half * moved[0]);
        let twist_y = b + half * dp - y * (a + half * moved[0]);
        Rows {
            forces: [
                [cosine, -(nd * x), -(nd * y)],
                [-y, mixed, nh * y * y - nd],
                [x, nd - nh * x * x, -mixed],
            ],
            moments: [
                [cosine, y, -x, -(d * twist_x), d * twist_y, yh, -xh],
                [
                    -y,
                    one - yh * q,
                    yh * p,
                    yh * other - lost_x * moved[1],
                    -(d * m) - yh * b - lost_y * moved[1],
                    d,
                    zero,
                ],
                [
                    x,
                    yh * p,
                    one - xh * p,
                    d * m - xh * other - lost_x * moved[2],
                    xh * b - lost_y * moved[2],
                    zero,
                    d,
                ],
            ],
        }
    }
}

impl<N: Real> Rows<N> {
    /// Rates of the strains.
    #[inline(always)]
    pub fn rates(&self, of: &Local<N>) -> Six<N> {
        let force = [of.stretch, of.lean[0], of.lean[1]];
        let [a, b, c] = of.turning;
        let moment = [a, b, c, of.lean[0], of.lean[1], of.change[0], of.change[1]];
        let ([n, v, w], [t, x, y]) = (&self.forces, &self.moments);
        [
            dot(n, &force),
            dot(v, &force),
            dot(w, &force),
            dot(t, &moment),
            dot(x, &moment),
            dot(y, &moment),
        ]
    }

    /// Factors of what the strains are made of, from stresses.
    #[inline(always)]
    pub fn factors(&self, [n, v, w, t, x, y]: &Six<N>) -> Local<N> {
        let ([first, second, third], [twist, bend, other]) = (&self.forces, &self.moments);
        let force = plus(third, *w, &plus(second, *v, &times(first, *n)));
        let moment = plus(other, *y, &plus(bend, *x, &times(twist, *t)));
        Local {
            stretch: force[0],
            turning: [moment[0], moment[1], moment[2]],
            lean: [force[1] + moment[3], force[2] + moment[4]],
            change: [moment[5], moment[6]],
        }
    }
}
