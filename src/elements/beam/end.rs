//! An end of a beam: the tangent's frame, the section's shear rotation in it, and what both do when slope and section move.
//!
//! Source: (1) of `beam/mod.rs`. With the spin `w` of the section along the axes of the tangent's frame, `x = t x t'` and
//! `v = w - x` across the tangent, the shear rotation changes by `c' = (1 + |c|^2 / 4) v` and the tangent's frame rotates about the tangent by
//! `w . t - t . (c x v) / 2`: the relative rotation has the rational vector `c`.

use super::shear_rotation::turned_by_shear;
use crate::elements::line::{dot, times};
use crate::elements::rod::vectors::{Vector, cross, plus, unit};
use crate::math::lanes::Real;

/// An end of a beam.
#[derive(Clone, Copy)]
pub(super) struct End<N> {
    pub tangent: Vector<N>,
    /// One over the length of the slope.
    pub inverse_size: N,
    pub size: N,
    /// The axes of the tangent's frame across it.
    pub across: [Vector<N>; 2],
    /// shear rotation about these axes, twice the tangent of half the angle.
    pub shear_rotation: [N; 2],
    /// `1 + |c|^2 / 4`: rate of the shear rotation by angular velocity.
    pub gain: N,
}

impl<N: Real> End<N> {
    #[inline(always)]
    pub fn new(u: &Vector<N>, [normal, second, third]: &[Vector<N>; 3]) -> Self {
        let (tangent, inverse_size) = unit(u);
        let one = inverse_size.constant(1.0);
        let half = one / (one + dot(&tangent, normal));
        let double = half + half;
        let shear_rotation = [
            double * dot(&tangent, third),
            -(double * dot(&tangent, second)),
        ];
        let both = plus(normal, one, &tangent);
        let first = plus(&both, shear_rotation[1] * one.constant(0.5), second);
        Self {
            size: dot(u, &tangent),
            across: [first, cross(&tangent, &first)],
            gain: dot(&shear_rotation, &shear_rotation).times_plus(one.constant(0.25), one),
            tangent,
            inverse_size,
            shear_rotation,
        }
    }

    /// Rates of the rotation of the tangent's frame and of the shear rotation, from those of the slope and from the angular velocity along the
    /// section's own axes.
    #[inline(always)]
    pub fn rates(&self, du: &Vector<N>, spin: &[N; 3]) -> (N, [N; 2]) {
        let [p, q] = self.shear_rotation;
        let [turn, second, third] = turned_by_shear([-p, -q], spin);
        let [first, other] = &self.across;
        let v = [
            dot(other, du).times_plus(self.inverse_size, second),
            third - dot(first, du) * self.inverse_size,
        ];
        let back = (p * v[1] - q * v[0]) * turn.constant(0.5);
        (turn - back, times(&v, self.gain))
    }

    /// Force on the slope and moment along the section's own axes from the torque about the tangent of its frame and what the shear rotation
    /// is taken with.
    #[inline(always)]
    pub fn load(&self, torque: N, shear_rotation: &[N; 2]) -> (Vector<N>, [N; 3]) {
        let [p, q] = self.shear_rotation;
        let half = torque * torque.constant(0.5);
        let second = shear_rotation[0].times_plus(self.gain, half * q);
        let third = shear_rotation[1] * self.gain - half * p;
        let [first, other] = &self.across;
        let force = plus(other, second, &times(first, -third));
        (
            times(&force, self.inverse_size),
            turned_by_shear(self.shear_rotation, &[torque, second, third]),
        )
    }
}

/// A symmetric matrix over the rate of the slope and the angular velocity along the section's own axes.
pub(super) type Six<N> = [[N; 6]; 6];

impl<N: Real> End<N> {
    /// Second derivatives of the rotation of the tangent's frame and of the shear rotation while slope and angular velocity change evenly, taken
    /// with the torque about the tangent and what the shear rotation is taken with.
    ///
    /// With `f` this torque, `m` the moment of both along the tangent's frame, `s = t . u' / |u|`, and what is across the tangent as
    /// complex numbers, they are
    ///
    /// ```text
    /// f t . (w x x) + (w . t) t . (m x (w - 2 x)) + 2 s m . x + Re(conj(c m) v^2) / 2 + f Im(conj(c^2) v^2) / 8
    /// ```
    ///
    /// as components of a vector that stands still rotate against the frame, and `x' = -2 s x` in space.
    #[inline(always)]
    pub fn second(&self, torque: N, shear_rotation: &[N; 2]) -> Six<N> {
        let ([p, q], half) = (self.shear_rotation, torque.constant(0.5));
        let (twist, zero) = (torque * half, torque.constant(0.0));
        let m = shear_rotation[0].times_plus(self.gain, twist * q);
        let n = shear_rotation[1] * self.gain - twist * p;
        let quarter = half * twist * half;
        let a = half * (p * m - q * n) - quarter * (p * q + p * q);
        let b = half * (p * n + q * m) + quarter * (p * p - q * q);
        let (mh, nh) = (half * m, half * n);
        // Over u' / |u| and the angular velocity along the axes of the tangent's frame.
        let local = [
            [zero, n, -m, zero, zero, zero],
            [n, -a, -b, -m, twist - b, a],
            [-m, -b, a, -n, a, twist + b],
            [zero, -m, -n, zero, -nh, mh],
            [zero, twist - b, a, -nh, a, b],
            [zero, a, twist + b, mh, b, -a],
        ];
        let mut rows = local;
        for r in 0..6 {
            rows[r] = self.outward(&local[r]);
        }
        let mut second = rows;
        for c in 0..6 {
            let mut column = rows[0];
            for r in 0..6 {
                column[r] = rows[r][c];
            }
            let column = self.outward(&column);
            for r in 0..6 {
                second[r][c] = column[r];
            }
        }
        second
    }

    /// Factors of rates of the slope and of the angular velocity along the section's own axes from those along the tangent's frame.
    #[inline(always)]
    fn outward(&self, [s, y, z, t, v, w]: &[N; 6]) -> [N; 6] {
        let [first, other] = &self.across;
        let by_u = plus(other, *z, &plus(first, *y, &times(&self.tangent, *s)));
        let [a, b, c] = times(&by_u, self.inverse_size);
        let [d, e, f] = turned_by_shear(self.shear_rotation, &[*t, *v, *w]);
        [a, b, c, d, e, f]
    }
}
