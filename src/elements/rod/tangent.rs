//! The tangent: second derivatives of the energy along a motion with constant rates of the line, spins about the tangents and
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
//! with `g_z`, `g_t` the factors of `z'` and `t'` in the gradient, and `alpha` the turn of the first end's frame at the middle.

use super::kernel::{Frame, Kernel, MIDDLE, POINTS, Section, Square, product};
use super::quadratic::{Form, Quadratic};
use super::vectors::{Vector, across, add, carry, cross, plus};
use super::{At, Matrix, Rates, Tangent, VELOCITIES};
use crate::elements::line::{Sample, dot, times};
use crate::math::lanes::Real;

const U: usize = 0;
const W: usize = 1;
const Z: usize = 2;
/// `z'` among the vectors of an element.
const LAST: usize = 3;

/// Summed factors of what has second derivatives of its own: of `z'`, of the turn at the middle, of the twist.
struct Factors<N> {
    middle: Vector<N>,
    turn: N,
    twist: N,
}

/// A section with its axes.
struct Seen<'a, N> {
    at: &'a Section<N>,
    z: &'a Vector<N>,
    axes: [Vector<N>; 2],
    /// `h(z, t)`.
    half: Vector<N>,
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

impl<N: Real> Kernel<N> {
    /// The tangent: stiffness with the stresses that damping adds where there are rates, or damping matrix. All in one:
    /// it is long, and compiled for every kind of processor.
    #[inline(always)]
    pub fn tangent(&self, at: &At<N>, rates: Option<&Rates<N>>, kind: Tangent) -> Matrix<N> {
        let v = self.vectors(&at.e);
        let frame = self.frame(&v, &at.d);
        let motion = of_rate!(rates, rates => self.motion(&frame, rates));
        let zero = self.number(0.0);
        let mut sum = Quadratic::nothing(zero);
        let mut factors = Factors {
            middle: [zero; 3],
            turn: zero,
            twist: zero,
        };
        for (index, point) in POINTS.iter().enumerate() {
            let section = self.section(point, &v, &frame, at.bubble);
            let seen = self.seen(&section, &frame);
            let by = match kind {
                Tangent::Stiffness => &self.stiffness[index],
                Tangent::Damping => &self.damping[index],
            };
            let mut local = self.squares(point, &seen, by);
            let strains = add(&section.strains, &self.offset[index]);
            let mut stress = product(&self.stiffness[index], &strains);
            if let Some(motion) = &motion {
                let rate = self.strain_rates(point, &section, &frame, motion);
                stress = add(&stress, &product(&self.damping[index], &rate));
            }
            let stress = times(&stress, self.number(point.weight));
            if kind == Tangent::Stiffness {
                self.add_stresses(point, &seen, &stress, &mut local);
                self.add_twisting(&seen, &stress, &mut local);
                self.add_factors(point, &seen, &stress, &mut factors);
            }
            self.gather(point, &local, &mut sum);
        }
        self.add_ends(&frame, &mut factors, &mut sum);
        self.whole(&frame, &factors, sum)
    }

    #[inline(always)]
    fn seen<'a>(&self, at: &'a Section<N>, frame: &'a Frame<N>) -> Seen<'a, N> {
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

    /// Turn of a section about its tangent.
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
    fn squares(&self, point: &Sample, seen: &Seen<'_, N>, by: &Square<N>) -> Quadratic<N, 3> {
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

    /// Second derivatives of curvatures by `u`, `w` and the turn.
    #[inline(always)]
    fn add_stresses(
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
        local.add_cross((U, W), &m, -p);
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
        local.add_multiple((U, U), -(shrink + shrink));
        let zero = [self.number(0.0); 3];
        local.add_symmetric(U, &times(&moment, half * p), &[at.curvature, zero, zero]);
        // The turn.
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
    fn add_twisting(
        &self,
        seen: &Seen<'_, N>,
        [torque, first, second]: &[N; 3],
        local: &mut Quadratic<N, 3>,
    ) {
        let (at, i, p, q) = (seen.at, seen.at.inverse_size, seen.square, seen.at.inverse);
        let turn = *first * at.strains[2] - *second * at.strains[1];
        let (shared, half) = (*torque * q, self.number(0.5) * turn * i);
        let c = shared * q * at.along;
        local.add_cross((U, Z), &add(seen.z, &at.tangent), half * q);
        local.add_cross((U, Z), &at.w, -(shared * p));
        local.add_cross((W, Z), &at.u, shared * p);
        local.add_multiple((U, Z), c * i);
        let flat = plus(
            &seen.half,
            half,
            &times(&at.curvature, (shared + shared) * i),
        );
        let flat = plus(&at.tangent, -(c * i), &flat);
        local.add_block((U, Z), &at.tangent, &flat);
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

    #[inline(always)]
    fn add_factors(
        &self,
        point: &Sample,
        seen: &Seen<'_, N>,
        [torque, first, second]: &[N; 3],
        factors: &mut Factors<N>,
    ) {
        let at = seen.at;
        let turn = *first * at.strains[2] - *second * at.strains[1];
        let shared = *torque * at.inverse;
        let middle = plus(&at.tangent, shared * at.inverse * at.along, &factors.middle);
        let middle = plus(&at.curvature, -shared, &middle);
        factors.middle = plus(&seen.half, -turn, &middle);
        factors.turn += turn;
        factors.twist += turn.times_plus(self.number(point.at), *torque * self.inverse_length);
    }

    /// From `u'` and `w'` of a section to the vectors of the line.
    #[inline(always)]
    fn gather(&self, point: &Sample, local: &Quadratic<N, 3>, sum: &mut Quadratic<N, 4>) {
        let [[uu, uw, uz], [_, ww, wz], [_, _, zz]] = &local.blocks;
        for i in 0..3 {
            let a = self.number(point.slope[i]);
            let b = self.number(point.curvature[i]) * self.inverse_length;
            for r in 0..3 {
                let (mut by_u, mut by_w) = (uu[r], uw[r]);
                for c in 0..3 {
                    by_u[c] = uu[r][c] * a + uw[c][r] * b;
                    by_w[c] = uw[r][c] * a + ww[r][c] * b;
                    let last = &mut sum.blocks[i][LAST][r][c];
                    *last = uz[r][c].times_plus(a, wz[r][c].times_plus(b, *last));
                }
                for j in i..3 {
                    let of_w = self.number(point.curvature[j]) * self.inverse_length;
                    let row = &mut sum.blocks[i][j][r];
                    *row = plus(&by_w, of_w, &plus(&by_u, self.number(point.slope[j]), row));
                }
            }
            for s in 0..3 {
                let [by_u, by_w, _] = &local.mixed[s];
                sum.mixed[s][i] = plus(by_w, b, &plus(by_u, a, &sum.mixed[s][i]));
            }
        }
        for k in 0..3 {
            sum.blocks[LAST][LAST][k] = add(&sum.blocks[LAST][LAST][k], &zz[k]);
            sum.mixed[k][LAST] = add(&sum.mixed[k][LAST], &local.mixed[k][Z]);
            sum.scalars[k] = add(&sum.scalars[k], &local.scalars[k]);
        }
    }

    /// Second derivatives of what carries the frames of the ends to the middle.
    #[inline(always)]
    fn add_ends(&self, frame: &Frame<N>, factors: &mut Factors<N>, sum: &mut Quadratic<N, 4>) {
        let weights = [factors.twist - factors.turn, -factors.twist];
        for (k, end) in frame.ends.iter().enumerate() {
            let (c, i, place) = (weights[k], end.inverse_size, k + 1);
            let (t, z, h) = (&end.tangent, &frame.middle, &end.half);
            let cosine = dot(t, z);
            let half = self.number(0.5) * c;
            let shared = half / (self.number(1.0) + cosine);
            sum.add_cross((place, LAST), &add(t, z), shared * i);
            sum.add_block((place, LAST), t, &times(h, -(half * i)));
            let zero = [self.number(0.0); 3];
            let mut halves = [zero, zero, zero, times(h, -shared)];
            halves[place] = times(h, -(shared * i));
            let lean = times(&plus(t, -cosine, z), i);
            sum.add_symmetric(place, &lean, &halves);
            sum.add_symmetric(LAST, t, &halves);
            let mut stretch = [zero; 4];
            stretch[place] = times(h, -(c * i * i));
            sum.add_symmetric(place, t, &stretch);
            factors.middle = plus(h, c, &factors.middle);
        }
    }

    /// From the turn at the middle and the twist to both spins, from `z'` to the line.
    #[inline(always)]
    fn whole(&self, frame: &Frame<N>, factors: &Factors<N>, mut sum: Quadratic<N, 4>) -> Matrix<N> {
        for i in 0..4 {
            let [turn, twist, _] = &mut sum.mixed;
            turn[i] = plus(&twist[i], self.number(-1.0), &turn[i]);
        }
        for k in 0..3 {
            sum.scalars[0][k] = sum.scalars[0][k] - sum.scalars[1][k];
        }
        for k in 0..3 {
            sum.scalars[k][0] = sum.scalars[k][0] - sum.scalars[k][1];
        }
        let (mut shifts, s) = (sum.mixed, sum.scalars);
        let half = self.number(0.5);
        for (k, end) in frame.ends.iter().enumerate() {
            let by_end = times(&end.half, end.inverse_size);
            for row in 0..3 {
                for (i, form) in [(k + 1, &by_end), (LAST, &end.half)] {
                    let mixed = &mut sum.mixed[row][i];
                    *mixed = plus(form, -s[row][k], mixed);
                    shifts[row][i] = plus(form, -(half * s[row][k]), &shifts[row][i]);
                }
            }
        }
        for (k, end) in frame.ends.iter().enumerate() {
            let by_end = times(&end.half, -end.inverse_size);
            sum.add_symmetric(k + 1, &by_end, &shifts[k]);
            sum.add_symmetric(LAST, &times(&end.half, self.number(-1.0)), &shifts[k]);
        }
        self.add_middle(frame, factors, &mut sum);
        self.spread_out(&sum)
    }

    /// From `z'` to the line.
    #[inline(always)]
    fn add_middle(&self, frame: &Frame<N>, factors: &Factors<N>, sum: &mut Quadratic<N, 4>) {
        let (z, i) = (&frame.middle, frame.inverse_size);
        for j in 0..3 {
            for r in 0..3 {
                sum.blocks[j][LAST][r] = times(&across(z, &sum.blocks[j][LAST][r]), i);
            }
            sum.mixed[j][LAST] = times(&across(z, &sum.mixed[j][LAST]), i);
        }
        // Columns, then rows.
        let mut own = sum.blocks[LAST][LAST];
        for _ in 0..2 {
            let from = own;
            for r in 0..3 {
                let row = times(&across(z, &from[r]), i);
                for c in 0..3 {
                    own[c][r] = row[c];
                }
            }
        }
        let flat = times(&across(z, &factors.middle), -(i * i));
        let shrink = dot(z, &factors.middle) * i * i;
        for r in 0..3 {
            own[r] = plus(&flat, z[r], &plus(z, flat[r], &own[r]));
            own[r] = plus(z, shrink * z[r], &own[r]);
            own[r][r] = own[r][r] - shrink;
        }
        for j in 0..3 {
            let weight = self.number(MIDDLE[j]);
            for k in j..3 {
                let other = self.number(MIDDLE[k]);
                for r in 0..3 {
                    for c in 0..3 {
                        let both = own[r][c].times_plus(other, sum.blocks[k][LAST][c][r]) * weight;
                        let both = sum.blocks[j][LAST][r][c].times_plus(other, both);
                        sum.blocks[j][k][r][c] += both;
                    }
                }
            }
            for s in 0..3 {
                sum.mixed[s][j] = plus(&sum.mixed[s][LAST], weight, &sum.mixed[s][j]);
            }
        }
    }

    /// From the three vectors and scalars to all velocities.
    #[inline(always)]
    fn spread_out(&self, sum: &Quadratic<N, 4>) -> Matrix<N> {
        let (l, one) = (self.length, self.number(1.0));
        let mut matrix = [[self.number(0.0); VELOCITIES]; VELOCITIES];
        // Places of the vectors, and what they count: the chord is that of both positions.
        let over = self.inverse_length;
        let places = [(0, 0, -over), (0, 7, over), (1, 3, one), (2, 10, one)];
        for (i, p, a) in places {
            for (j, q, b) in places {
                let factor = a * b * l;
                for r in 0..3 {
                    for c in 0..3 {
                        let value = match i <= j {
                            true => sum.blocks[i][j][r][c],
                            false => sum.blocks[j][i][c][r],
                        };
                        matrix[p + r][q + c] = value * factor;
                    }
                }
            }
        }
        for (s, q) in [6, 13, 14].into_iter().enumerate() {
            for (i, p, a) in places {
                for r in 0..3 {
                    let value = sum.mixed[s][i][r] * (a * l);
                    (matrix[p + r][q], matrix[q][p + r]) = (value, value);
                }
            }
            for (k, p) in [6, 13, 14].into_iter().enumerate() {
                matrix[q][p] = sum.scalars[s][k] * l;
            }
        }
        matrix
    }
}
