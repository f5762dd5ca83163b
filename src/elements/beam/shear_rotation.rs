//! Strains of a section that shear rotations away from the normal of the line, with their derivatives.
//!
//! Source: (1) and (2) of `beam/mod.rs`. With the shear rotation `c = (0, p, q)`, `D = 1 / (1 + |c|^2 / 4)`, the stretch `n`, rotating
//! `k = (a, b, b')` of the tangent's frame, `g = q b - p b'`, `m = a + g / 2` they are
//!
//! ```text
//! n (2 D - 1) - 1,   -n q D,   n p D
//! a (2 D - 1) + D (g + (q p' - p q') / 2),   b + D (p' - q m),   b' + D (q' + p m)
//! ```
//!
//! linear in all but the shear rotation: their product with stresses is a constant and `D` times a polynomial of degree 2 in `p`, `q`.

use crate::elements::line::{dot, times};
use crate::elements::rod::vectors::plus;
use crate::math::lanes::Real;

/// Strains or stresses of a section: axial, shear along both axes across, twist, bending about both.
pub(super) type Six<N> = [N; 6];

/// Quantities that the strains of a section are computed from, their rates, or their conjugate factors in a power.
#[derive(Clone, Copy)]
pub(super) struct Local<N> {
    /// Length of the slope of the line.
    pub stretch: N,
    /// Twist and curvatures of the tangent's frame, 1/m.
    pub turning: [N; 3],
    /// shear rotation about both axes of the tangent's frame across it.
    pub shear_rotation: [N; 2],
    /// Derivative of `shear_rotation` with respect to the reference length, 1/m.
    pub change: [N; 2],
}

/// Derivatives of the strains by what they are made of: of the first three by stretch and shear rotation, of the last by rotating, shear rotation and its
/// change.
pub(super) struct Rows<N> {
    forces: [[N; 3]; 3],
    moments: [[N; 7]; 3],
}

/// A section that shear rotations.
pub(super) struct ShearedSection<N> {
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

/// Components along the axes of a section of a vector with these along the tangent's frame; the other way with the opposite shear rotation.
#[inline(always)]
pub(super) fn turned_by_shear<N: Real>([p, q]: [N; 2], v: &[N; 3]) -> [N; 3] {
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
fn shrink<N: Real>(shear_rotation: &[N; 2]) -> N {
    let one = shear_rotation[0].constant(1.0);
    one / dot(shear_rotation, shear_rotation).times_plus(one.constant(0.25), one)
}

impl<N: Real> ShearedSection<N> {
    #[inline(always)]
    pub fn new(at: Local<N>) -> Self {
        let ([p, q], [dp, dq], [a, b, other]) = (at.shear_rotation, at.change, at.turning);
        let (one, half) = (p.constant(1.0), p.constant(0.5));
        let shrink = shrink(&at.shear_rotation);
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
        let ([p, q], [dp, dq], [a, b, other]) =
            (self.at.shear_rotation, self.at.change, self.at.turning);
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
        let force = [of.stretch, of.shear_rotation[0], of.shear_rotation[1]];
        let [a, b, c] = of.turning;
        let moment = [
            a,
            b,
            c,
            of.shear_rotation[0],
            of.shear_rotation[1],
            of.change[0],
            of.change[1],
        ];
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
            shear_rotation: [force[1] + moment[3], force[2] + moment[4]],
            change: [moment[5], moment[6]],
        }
    }
}

/// A symmetric matrix over stretch, rotating, shear rotation and its change.
pub(super) type Eight<N> = [[N; 8]; 8];

impl<N: Real> Rows<N> {
    /// The matrix of the square of the rates of strain by a matrix.
    #[inline(always)]
    pub fn squares(&self, by: &[Six<N>; 6]) -> Eight<N> {
        let zero = by[0][0].constant(0.0);
        let mut columns = [[zero; 8]; 6];
        for (column, by) in columns.iter_mut().zip(by) {
            let moment = plus(&self.moments[1], by[4], &times(&self.moments[0], by[3]));
            let moment = plus(&self.moments[2], by[5], &moment);
            let force = plus(&self.forces[1], by[1], &times(&self.forces[0], by[0]));
            let force = plus(&self.forces[2], by[2], &force);
            column[0] = force[0];
            column[1..].copy_from_slice(&moment);
            column[4] += force[1];
            column[5] += force[2];
        }
        let mut squares = [[zero; 8]; 8];
        for c in 0..8 {
            for k in 0..3 {
                let ([stretch, p, q], moment) = (self.forces[k], &self.moments[k]);
                let (by_force, by_moment) = (columns[k][c], columns[3 + k][c]);
                squares[0][c] = stretch.times_plus(by_force, squares[0][c]);
                squares[4][c] = p.times_plus(by_force, squares[4][c]);
                squares[5][c] = q.times_plus(by_force, squares[5][c]);
                for r in 0..7 {
                    squares[r + 1][c] = moment[r].times_plus(by_moment, squares[r + 1][c]);
                }
            }
        }
        squares
    }
}

impl<N: Real> ShearedSection<N> {
    /// Adds second derivatives of the strains, taken with stresses.
    #[inline(always)]
    pub fn add_second(&self, stress: &Six<N>, to: &mut Eight<N>) {
        let (d, half, [p, q]) = (
            self.shrink,
            self.shrink.constant(0.5),
            self.at.shear_rotation,
        );
        let [axial, second, third, torque, first, other] = *stress;
        let [x, y] = [self.half[0] * half, self.half[1] * half];
        // Derivatives of `D` by both shear rotations.
        let [dx, dy] = [-(d * x), -(d * y)];
        let shear = [d * third, -(d * second)];
        let moment = [d * other, -(d * first)];
        let sum = half.times_plus(p * other - q * first, torque);
        let rises = [dx * sum + half * moment[0], dy * sum + half * moment[1]];
        let inner = d * sum;
        let along = axial + axial + p * third - q * second;
        let bends = [
            q.times_plus(half * torque, first),
            other - p * half * torque,
        ];
        let twist = half * d * torque;
        let mixed = [
            (0, [dx * along + shear[0], dy * along + shear[1]]),
            (
                1,
                [dx * (sum + sum) + moment[0], dy * (sum + sum) + moment[1]],
            ),
            (2, [q * rises[0], q.times_plus(rises[1], inner)]),
            (3, [-(p.times_plus(rises[0], inner)), -(p * rises[1])]),
            (6, [dx * bends[0], dy.times_plus(bends[0], twist)]),
            (7, [dx.times_plus(bends[1], -twist), dy * bends[1]]),
        ];
        for (k, by_shear_rotation) in mixed {
            for (c, value) in by_shear_rotation.into_iter().enumerate() {
                to[k][4 + c] += value;
                to[4 + c][k] += value;
            }
        }
        self.add_second_by_lean(stress, to);
    }

    /// Adds the second derivatives with respect to the shear rotation alone: those of `D` times a polynomial.
    #[inline(always)]
    fn add_second_by_lean(
        &self,
        [axial, second, third, torque, first, other]: &Six<N>,
        to: &mut Eight<N>,
    ) {
        let (d, half, [p, q]) = (
            self.shrink,
            self.shrink.constant(0.5),
            self.at.shear_rotation,
        );
        let ([a, b, c], n, [dp, dq]) = (self.at.turning, self.at.stretch, self.at.change);
        let [first, other, torque] = [*first, *other, *torque];
        let squares = [-(c * other), half * (b * other + c * first), -(b * first)];
        let twist = half * torque;
        let by_p = n * *third + a * other - torque * c - twist * dq;
        let by_q = torque * b + twist * dp - n * *second - a * first;
        let straight = n * *axial + a * torque;
        let flat = straight + straight + dp * first + dq * other;
        let slope = [
            by_p + p * squares[0] + q * squares[1],
            by_q + p * squares[1] + q * squares[2],
        ];
        // The value: half the slopes are those of the squares.
        let value = flat + half * (p * (by_p + slope[0]) + q * (by_q + slope[1]));
        let [x, y] = self.half;
        let scaled = half * d;
        let [sx, sy] = [x * scaled, y * scaled];
        let less = scaled * d * value;
        let shear = sx * slope[1] + sy * slope[0];
        let own = [sx * slope[0], sy * slope[1]];
        to[4][4] += d * squares[0] - (own[0] + own[0]) + sx * x * value - less;
        to[5][5] += d * squares[2] - (own[1] + own[1]) + sy * y * value - less;
        let mixed = d * squares[1] - shear + sx * y * value;
        to[4][5] += mixed;
        to[5][4] += mixed;
    }
}
