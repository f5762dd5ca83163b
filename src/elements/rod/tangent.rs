//! The tangent: second derivatives of the energy of a whole element along a motion with constant rates of the line, spins about the
//! tangents and internal twist.
//!
//! Source: twice the derivative by time of the equations of `rod/mod.rs`, section by section (`rod/second.rs`).

use super::geometry::{Frame, Geometry, MIDDLE, POINTS, PlacedSection};
use super::kernel::{Kernel, Square, product};
use super::quadratic::Quadratic;
use super::second::{Seen, Z};
use super::stretch::Stretching;
use super::vectors::{Vector, across, add, plus};
use super::{At, Matrix, Rates, Tangent, VELOCITIES};
use crate::elements::line::{Sample, dot, times};
use crate::math::lanes::Real;

/// `z'` among the vectors of an element.
const LAST: usize = 3;

/// Summed factors of what has second derivatives of its own: of `z'`, of the rotation at the middle, of the twist.
struct Factors<N> {
    middle: Vector<N>,
    turn: N,
    twist: N,
}

/// Second derivatives of the energy, summed over sections.
pub(in crate::elements) struct Curved<N> {
    squares: Quadratic<N, 4>,
    factors: Factors<N>,
}

impl<N: Real> Curved<N> {
    #[inline(always)]
    pub fn nothing(zero: N) -> Self {
        Self {
            squares: Quadratic::nothing(zero),
            factors: Factors {
                middle: [zero; 3],
                turn: zero,
                twist: zero,
            },
        }
    }
}

impl<N: Real> Kernel<N> {
    /// The tangent: stiffness with the stresses that damping adds where there are rates, or damping matrix. All in one:
    /// it is long, and compiled for every kind of processor.
    #[inline(always)]
    pub fn tangent(&self, at: &At<N>, rates: Option<&Rates<N>>, kind: Tangent) -> Matrix<N> {
        let geometry = &self.geometry;
        let v = geometry.vectors(&at.e);
        let frame = geometry.frame(&v, &at.d);
        let motion = of_rate!(rates, rates => geometry.motion(&frame, rates));
        let zero = geometry.number(0.0);
        let mut sum = Curved::nothing(zero);
        let mut stretching = of_rate!(&self.axial, _axial => Stretching::nothing(zero));
        for (index, point) in POINTS.iter().enumerate() {
            let section = geometry.section(point, &v, &frame, at.bubble);
            let by = match kind {
                Tangent::Stiffness => &self.law.stiffness[index],
                Tangent::Damping => &self.law.damping[index],
            };
            let strains = add(&section.strains, &self.law.offset[index]);
            let mut stress = product(&self.law.stiffness[index], &strains);
            let mut pull = zero;
            if let Some(axial) = &self.axial {
                let lengths = geometry.lengths(&v, &frame);
                let stretch = axial.stretch(geometry, index, point, &lengths);
                let coupled = &axial.stiffness;
                pull += coupled.force(index, stretch, &strains);
                coupled.add_moments(index, stretch, &mut stress);
            }
            if let Some(motion) = &motion {
                let rate = geometry.strain_rates(point, &section, &frame, motion);
                stress = add(&stress, &product(&self.law.damping[index], &rate));
                if let Some(axial) = &self.axial {
                    let lengths = geometry.length_rates(motion, &frame);
                    let stretch = geometry.at_point(point.at, &lengths);
                    let coupled = &axial.damping;
                    pull += coupled.force(index, stretch, &rate);
                    coupled.add_moments(index, stretch, &mut stress);
                }
            }
            let stress = match kind {
                Tangent::Stiffness => Some(times(&stress, geometry.number(point.weight))),
                Tangent::Damping => None,
            };
            let place = PlacedSection {
                point,
                section: &section,
                frame: &frame,
            };
            geometry.add_curved(place, by, stress.as_ref(), &mut sum);
            if let (Some(axial), Some(stretching)) = (&self.axial, &mut stretching) {
                let (by, pull) = match kind {
                    Tangent::Stiffness => (&axial.stiffness, pull),
                    Tangent::Damping => (&axial.damping, zero),
                };
                stretching.add(geometry, place, by.own[index], &by.with[index]);
                stretching.add_pull(geometry, point, pull);
            }
        }
        let mut matrix = geometry.whole(&frame, &mut sum);
        if let Some(stretching) = &stretching {
            stretching.add_to(geometry, &frame, &mut matrix);
        }
        matrix
    }
}

impl<N: Real> Geometry<N> {
    /// Adds what a section's part of the energy has of second derivatives: those by the strains, and, with stresses, those of the
    /// strains.
    #[inline(always)]
    pub fn add_curved(
        &self,
        place: PlacedSection<'_, N>,
        by: &Square<N>,
        stress: Option<&[N; 3]>,
        sum: &mut Curved<N>,
    ) {
        let point = place.point;
        let seen = self.seen(place.section, place.frame);
        let mut local = self.squares(point, &seen, by);
        if let Some(stress) = stress {
            self.add_stresses(point, &seen, stress, &mut local);
            self.add_twisting(&seen, stress, &mut local);
            self.add_factors(point, &seen, stress, &mut sum.factors);
        }
        self.gather(point, &local, &mut sum.squares);
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

    /// Torques about the tangents at the ends: derivatives of the energy by the rotations there.
    #[inline(always)]
    pub fn torques(&self, sum: &Curved<N>) -> [N; 2] {
        let Factors { turn, twist, .. } = sum.factors;
        [(turn - twist) * self.length, twist * self.length]
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
            sum.add_cross(place, LAST, &add(t, z), shared * i);
            sum.add_block(place, LAST, t, &times(h, -(half * i)));
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

    /// From the rotation at the middle and the twist to both spins, from `z'` to the line.
    #[inline(always)]
    pub fn whole(&self, frame: &Frame<N>, sum: &mut Curved<N>) -> Matrix<N> {
        let (sum, factors) = (&mut sum.squares, &mut sum.factors);
        self.add_ends(frame, factors, sum);
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
        self.add_middle(frame, factors, sum);
        self.spread_out(sum)
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
                        let value = if i <= j {
                            sum.blocks[i][j][r][c]
                        } else {
                            sum.blocks[j][i][c][r]
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
