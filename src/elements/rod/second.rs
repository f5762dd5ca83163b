//! Second derivatives of the energy of a section along a motion with constant rates of the line, spins about the tangents and
//! internal twist.
//!
//! Source: twice the derivative by time of the equations of `rod/mod.rs`. With a prime for the rate, `p = 1 / u.u`,
//! `q = 1 / (1 + z.t)`, `lambda = z.kappa`, `mu = z.t`, stresses `T, M1, M2`, `M = M1 d1 + M2 d2`, `m = M - T q z`,
//! `G = M1 K2 - M2 K1`, `h = h(z, t)` and `c = T q^2 lambda` the energy of a section changes by
//!
//! ```text
//! s'.C s' + m.kappa'' + p (kappa.u')(M.u') + 2 theta' (M1 d2 - M2 d1).kappa' - (M1 K1 + M2 K2) theta'^2
//!   - G q ((z + t).(t' x z') - mu' h.(z' + t')) - 2 T q z'.kappa' + 2 T q^2 mu' (lambda' - q lambda mu') + 2 c z'.t'
//!   + g_z.z'' + g_t.t'' + (T/l + G xi) Phi'' + G alpha''
//! m.kappa'' = 2 p m.(u' x w') - 4 p (u.u') m.kappa' - 2 p (m.kappa) u'.u'
//! x'' = -(x'.x') x - 2 (x.y') x' / |y|   of x = y / |y|, y steady
//! ```
//!
//! with `g_z`, `g_t` the factors of `z'` and `t'` in the gradient, and `alpha` the rotation of the first end's frame at the middle.

use super::geometry::{Frame, Geometry, Section};
use super::kernel::Square;
use super::quadratic::{Form, Quadratic};
use super::vectors::{Vector, add, carry, cross, plus};
use crate::elements::line::{Sample, dot, times};
use crate::math::lanes::Real;

pub(super) const U: usize = 0;
pub(super) const W: usize = 1;
pub(super) const Z: usize = 2;
/// A section with its axes.
pub(super) struct Seen<'a, N> {
    pub at: &'a Section<N>,
    z: &'a Vector<N>,
    axes: [Vector<N>; 2],
    /// `h(z, t)`.
    pub half: Vector<N>,
    /// `z . t`.
    cosine: N,
    /// 1 / u.u.
    square: N,
}

impl<N: Real> Seen<'_, N> {
    /// `x . kappa'` as a form of `u'` and `w'`.
    #[inline(always)]
    fn curvature(&self, x: &Vector<N>) -> [Vector<N>; 3] {
        let (at, p) = (self.at, self.square);
        let shrink = dot(x, &at.curvature) * at.inverse_size;
        let by_u = times(&cross(&at.w, x), p);
        let zero = shrink.constant(0.0);
        [
            plus(&at.tangent, -(shrink + shrink), &by_u),
            times(&cross(x, &at.u), p),
            [zero; 3],
        ]
    }

    /// `z . t'` and `z' . t`.
    #[inline(always)]
    fn lean(&self) -> [Vector<N>; 2] {
        let flat = plus(&self.at.tangent, -self.cosine, self.z);
        [times(&flat, self.at.inverse_size), self.at.tangent]
    }
}

impl<N: Real> Geometry<N> {
    #[inline(always)]
    pub(super) fn seen<'a>(&self, at: &'a Section<N>, frame: &'a Frame<N>) -> Seen<'a, N> {
        let (z, t) = (&frame.middle, &at.tangent);
        let flat = plus(&frame.axes[1], at.sine, &times(&frame.axes[0], at.cosine));
        let first = carry(z, t, at.inverse, &flat);
        Seen {
            at,
            z,
            axes: [first, cross(t, &first)],
            half: times(&cross(z, t), at.inverse),
            cosine: dot(z, t),
            square: at.inverse_size * at.inverse_size,
        }
    }

    /// Rotation of a section about its tangent.
    #[inline(always)]
    fn turning(&self, point: &Sample, seen: &Seen<'_, N>) -> Form<N, 3> {
        let zero = self.number(0.0);
        Form {
            vectors: [
                times(&seen.half, -seen.at.inverse_size),
                [zero; 3],
                times(&seen.half, self.number(-1.0)),
            ],
            scalars: [
                self.number(1.0),
                self.number(point.at),
                self.quadratic(point.at).0,
            ],
        }
    }

    /// Squares of the rates of strain by a matrix, weighted.
    #[inline(always)]
    pub(super) fn squares(
        &self,
        point: &Sample,
        seen: &Seen<'_, N>,
        by: &Square<N>,
    ) -> Quadratic<N, 3> {
        let (at, turning) = (seen.at, self.turning(point, seen));
        let q = at.inverse;
        let mut along = seen.curvature(seen.z);
        along[Z] = at.curvature;
        let [by_u, by_z] = seen.lean();
        let lean = [by_u, [self.number(0.0); 3], by_z];
        let mut rows = [turning; 3];
        let own = [-at.along, at.strains[2], -at.strains[1]];
        let bends = [
            along,
            seen.curvature(&seen.axes[0]),
            seen.curvature(&seen.axes[1]),
        ];
        for i in 0..3 {
            rows[0].vectors[i] = times(&plus(&lean[i], q * own[0], &along[i]), -q);
            for k in 1..3 {
                rows[k].vectors[i] = plus(&turning.vectors[i], own[k], &bends[k][i]);
                rows[k].scalars[i] = turning.scalars[i] * own[k];
            }
        }
        let slope = self.quadratic(point.at).1;
        rows[0].scalars = [
            self.number(0.0),
            self.inverse_length,
            slope * self.inverse_length,
        ];
        let mut local = Quadratic::nothing(self.number(0.0));
        for k in 0..3 {
            let by = times(&by[k], self.number(point.weight));
            let mut row = rows[0];
            for i in 0..3 {
                let two = plus(
                    &rows[1].vectors[i],
                    by[1],
                    &times(&rows[0].vectors[i], by[0]),
                );
                row.vectors[i] = plus(&rows[2].vectors[i], by[2], &two);
                let two = rows[1].scalars[i] * by[1] + rows[0].scalars[i] * by[0];
                row.scalars[i] = rows[2].scalars[i].times_plus(by[2], two);
            }
            local.add_product(&rows[k], &row);
        }
        local
    }

    /// Second derivatives of curvatures by `u`, `w` and the rotation.
    #[inline(always)]
    pub(super) fn add_stresses(
        &self,
        point: &Sample,
        seen: &Seen<'_, N>,
        [torque, first, second]: &[N; 3],
        local: &mut Quadratic<N, 3>,
    ) {
        let (at, i, p) = (seen.at, seen.at.inverse_size, seen.square);
        let [d1, d2] = &seen.axes;
        let moment = plus(d2, *second, &times(d1, *first));
        let m = plus(seen.z, -(*torque * at.inverse), &moment);
        let half = self.number(0.5);
        local.add_cross(U, W, &m, -p);
        let [by_u, by_w, _] = seen.curvature(&m);
        let turn = *first * at.strains[2] - *second * at.strains[1];
        let c = *torque * at.inverse * at.inverse * at.along;
        let [lean, _] = seen.lean();
        let by_tangent = plus(&seen.half, -(turn * i), &times(&lean, c));
        let along = plus(&by_u, self.number(2.0), &by_tangent);
        let straight = half * c * seen.cosine * p;
        let along = plus(&at.tangent, straight, &times(&along, -i));
        local.add_symmetric(
            U,
            &at.tangent,
            &[along, times(&by_w, -(i + i)), [self.number(0.0); 3]],
        );
        let shrink = dot(&m, &at.curvature).times_plus(p, straight);
        local.add_multiple(U, U, -(shrink + shrink));
        let zero = [self.number(0.0); 3];
        local.add_symmetric(U, &times(&moment, half * p), &[at.curvature, zero, zero]);
        // The rotation.
        let turning = self.turning(point, seen);
        let other = plus(d2, *first, &times(d1, -*second));
        let own = -(half * (*first * at.strains[1] + *second * at.strains[2]));
        let mut bends = seen.curvature(&other);
        for k in 0..3 {
            bends[k] = plus(&turning.vectors[k], own, &bends[k]);
        }
        for k in [U, Z] {
            local.add_symmetric(k, &turning.vectors[k], &bends);
        }
        for s in 0..3 {
            for k in 0..3 {
                let both = plus(&turning.vectors[k], own, &bends[k]);
                local.mixed[s][k] = plus(&both, turning.scalars[s], &local.mixed[s][k]);
                let pair = turning.scalars[s] * turning.scalars[k];
                local.scalars[s][k] = pair.times_plus(own + own, local.scalars[s][k]);
            }
        }
    }

    /// Second derivatives of what carries the frame from the middle to the section.
    #[inline(always)]
    pub(super) fn add_twisting(
        &self,
        seen: &Seen<'_, N>,
        [torque, first, second]: &[N; 3],
        local: &mut Quadratic<N, 3>,
    ) {
        let (at, i, p, q) = (seen.at, seen.at.inverse_size, seen.square, seen.at.inverse);
        let turn = *first * at.strains[2] - *second * at.strains[1];
        let (shared, half) = (*torque * q, self.number(0.5) * turn * i);
        let c = shared * q * at.along;
        local.add_cross(U, Z, &add(seen.z, &at.tangent), half * q);
        local.add_cross(U, Z, &at.w, -(shared * p));
        local.add_cross(W, Z, &at.u, shared * p);
        local.add_multiple(U, Z, c * i);
        let flat = plus(
            &seen.half,
            half,
            &times(&at.curvature, (shared + shared) * i),
        );
        let flat = plus(&at.tangent, -(c * i), &flat);
        local.add_block(U, Z, &at.tangent, &flat);
        let mut along = seen.curvature(seen.z);
        along[Z] = at.curvature;
        let [by_u, by_z] = seen.lean();
        for (k, lean) in [(U, &by_u), (Z, &by_z)] {
            along[k] = plus(lean, -(q * at.along), &along[k]);
        }
        for k in 0..3 {
            along[k] = times(&along[k], shared * q);
        }
        along[U] = plus(&seen.half, half * q, &along[U]);
        along[Z] = plus(&seen.half, self.number(0.5) * turn * q, &along[Z]);
        local.add_symmetric(U, &by_u, &along);
        local.add_symmetric(Z, &by_z, &along);
    }
}
