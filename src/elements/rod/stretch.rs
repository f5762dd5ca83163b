//! Stretching of sections along the line of an element: the parabola through the lengths of the slope at both ends and in the middle.
//! Beams stretch so, and rods whose stretching is coupled with twist or bending.
//!
//! Source: the equations of `rod/mod.rs` and `beam/mod.rs`; second derivatives of a length, `|u|'' = (u'.u' - (t.u')^2) / |u|`.

use super::geometry::{Frame, Geometry, MIDDLE, Motion, PlacedSection, Sum};
use super::vectors::{Vector, plus};
use super::{At, Matrix, Stretch, VELOCITIES};
use crate::elements::line::{Sample, combine, dot, times};
use crate::math::lanes::{Lanes, PACK, Real, Simd};

/// Evaluates the quadratic shape functions of the length of the slope, in the order first end, middle, last end.
#[inline(always)]
pub(in crate::elements) const fn parabola(at: f64) -> [f64; 3] {
    [
        (1.0 - at) * (1.0 - 2.0 * at),
        4.0 * at * (1.0 - at),
        at * (2.0 * at - 1.0),
    ]
}

/// Stiffness or damping of stretching that is coupled with twist and bending, at the three Gauss points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Coupled<N> {
    /// Axial force by stretch, N.
    pub own: [N; 3],
    /// Axial force by twist and curvatures, and torque and moments by stretch, N m.
    pub with: [[N; 3]; 3],
}

impl<N: Real> Coupled<N> {
    /// Axial force that stretch and strains make at a point, N.
    #[inline(always)]
    pub fn force(&self, index: usize, stretch: N, strains: &[N; 3]) -> N {
        stretch.times_plus(self.own[index], dot(&self.with[index], strains))
    }

    /// Adds the torque and moments that stretch makes at a point, N m.
    #[inline(always)]
    pub fn add_moments(&self, index: usize, stretch: N, stress: &mut [N; 3]) {
        *stress = plus(&self.with[index], stretch, stress);
    }
}

/// Stretching of an element of a rod that is coupled with its twist and bending.
#[derive(Clone, Debug)]
pub(super) struct Axial<N> {
    pub stiffness: Coupled<N>,
    pub damping: Coupled<N>,
    /// Less the length of the slope of the unstressed shape at the points.
    pub offset: [N; 3],
}

impl Stretch {
    /// With damping of the times of twist and bending, and straight without stress.
    pub(super) fn damped_with(&self, times: [f64; 3]) -> Axial<f64> {
        let share = times.map(|time| (time * self.damping_time).sqrt());
        Axial {
            stiffness: Coupled {
                own: self.stiffness,
                with: self.coupling,
            },
            damping: Coupled {
                own: self
                    .stiffness
                    .map(|stiffness| stiffness * self.damping_time),
                with: self
                    .coupling
                    .map(|with| std::array::from_fn(|k| with[k] * share[k])),
            },
            offset: [-1.0; 3],
        }
    }
}

impl Geometry<f64> {
    /// Length of the slope at a point, as the parabola has it.
    pub(super) fn stretch(&self, at: &At<f64>, point: &Sample) -> f64 {
        let v = self.vectors(&at.e);
        let lengths = self.lengths(&v, &self.frame(&v, &at.d));
        self.at_point(point.at, &lengths)
    }
}

impl Axial<f64> {
    /// In lanes, where all have it.
    pub fn pack<'a>(
        elements: impl Iterator<Item = &'a Option<Self>>,
    ) -> Option<Axial<[f64; PACK]>> {
        let all: Option<Vec<&Self>> = elements.map(Option::as_ref).collect();
        let all = all?;
        let lanes = |of: &dyn Fn(&Self) -> f64| -> [f64; PACK] {
            std::array::from_fn(|lane| of(all[lane.min(all.len() - 1)]))
        };
        let coupled = |of: &dyn Fn(&Self) -> &Coupled<f64>| Coupled {
            own: std::array::from_fn(|i| lanes(&|axial| of(axial).own[i])),
            with: std::array::from_fn(|i| {
                std::array::from_fn(|j| lanes(&|axial| of(axial).with[i][j]))
            }),
        };
        Some(Axial {
            stiffness: coupled(&|axial| &axial.stiffness),
            damping: coupled(&|axial| &axial.damping),
            offset: std::array::from_fn(|i| lanes(&|axial| axial.offset[i])),
        })
    }

    /// Converts the law to constants of the number type of `like`.
    #[inline(always)]
    pub fn lift<N: Real>(&self, like: N) -> Axial<N> {
        let lifted = |row: [f64; 3]| row.map(|value| like.constant(value));
        let coupled = |of: &Coupled<f64>| Coupled {
            own: lifted(of.own),
            with: of.with.map(lifted),
        };
        Axial {
            stiffness: coupled(&self.stiffness),
            damping: coupled(&self.damping),
            offset: lifted(self.offset),
        }
    }
}

impl Axial<[f64; PACK]> {
    /// A group of the elements of a pack.
    #[inline(always)]
    pub fn group<S: Simd>(&self, simd: S, group: usize) -> Axial<Lanes<S>> {
        let zero = Lanes::read(simd, &self.offset[0], group);
        let none = Coupled {
            own: [zero; 3],
            with: [[zero; 3]; 3],
        };
        let (mut all, mut offset) = ([none; 2], [zero; 3]);
        for (to, from) in all.iter_mut().zip([&self.stiffness, &self.damping]) {
            for i in 0..3 {
                to.own[i] = Lanes::read(simd, &from.own[i], group);
                for j in 0..3 {
                    to.with[i][j] = Lanes::read(simd, &from.with[i][j], group);
                }
            }
        }
        for i in 0..3 {
            offset[i] = Lanes::read(simd, &self.offset[i], group);
        }
        let [stiffness, damping] = all;
        Axial {
            stiffness,
            damping,
            offset,
        }
    }
}

impl<N: Real> Axial<N> {
    /// Stretch at a point, with what lengths of the slope are at the first end, in the middle and at the last end.
    #[inline(always)]
    pub fn stretch(
        &self,
        geometry: &Geometry<N>,
        index: usize,
        point: &Sample,
        lengths: &[N; 3],
    ) -> N {
        geometry.at_point(point.at, lengths) + self.offset[index]
    }
}

impl<N: Real> Geometry<N> {
    /// Lengths of the slope at the first end, in the middle and at the last end; of rates of the three vectors, their rates.
    #[inline(always)]
    pub fn lengths(&self, v: &[Vector<N>; 3], frame: &Frame<N>) -> [N; 3] {
        let [first, last] = &frame.ends;
        [
            dot(&first.tangent, &v[1]),
            dot(&frame.middle, &combine(&MIDDLE, v)),
            dot(&last.tangent, &v[2]),
        ]
    }

    /// Computes rates of the lengths of the slope at the first end, in the middle and at the last end.
    #[inline(always)]
    pub fn length_rates(&self, motion: &Motion<N>, frame: &Frame<N>) -> [N; 3] {
        self.lengths(&motion.dv, frame)
    }

    /// Adds what factors of the changes of lengths of the slope are of the three vectors.
    #[inline(always)]
    pub fn add_lengths(&self, frame: &Frame<N>, factors: &[N; 3], sum: &mut Sum<N>) {
        let [first, last] = &frame.ends;
        for k in 0..3 {
            let factor = factors[1] * self.number(MIDDLE[k]);
            sum.vectors[k] = plus(&frame.middle, factor, &sum.vectors[k]);
        }
        sum.vectors[1] = plus(&first.tangent, factors[0], &sum.vectors[1]);
        sum.vectors[2] = plus(&last.tangent, factors[2], &sum.vectors[2]);
    }

    /// Interpolates lengths at the first end, in the middle and at the last end to a point.
    #[inline(always)]
    pub fn at_point(&self, at: f64, lengths: &[N; 3]) -> N {
        let shapes = parabola(at);
        let mut sum = lengths[0] * self.number(shapes[0]);
        for k in 1..3 {
            sum = lengths[k].times_plus(self.number(shapes[k]), sum);
        }
        sum
    }

    /// Adds a multiple of what lengths count at a point.
    #[inline(always)]
    pub fn add_at_point(&self, at: f64, factor: N, to: &mut [N; 3]) {
        let shapes = parabola(at);
        for k in 0..3 {
            to[k] = factor.times_plus(self.number(shapes[k]), to[k]);
        }
    }

    /// Adds to the second derivatives over the velocities of an element, rows with columns up to the diagonal, those with lengths of the
    /// slope. `ra`, `ua`, `rb`, `ub` are the places of positions and slopes of both ends among the velocities.
    #[inline(always)]
    pub fn add_second_lengths<const V: usize>(
        &self,
        frame: &Frame<N>,
        [ra, ua, rb, ub]: [usize; 4],
        lengths: &mut LengthDerivatives<N, V>,
        matrix: &mut [[N; V]; V],
    ) {
        let LengthDerivatives {
            first: factors,
            second: more,
            mixed,
        } = lengths;
        let (l, one) = (self.length, self.number(1.0));
        let [first, last] = &frame.ends;
        let middle = each!([one; 3], k => self.number(MIDDLE[k]));
        let chord = middle[0] * self.inverse_length;
        // Vectors that a length is one of, with what these count in it.
        let places: [&[(usize, N)]; 3] = [
            &[(ua, one)],
            &[(ra, -chord), (ua, middle[1]), (rb, chord), (ub, middle[2])],
            &[(ub, one)],
        ];
        let along = [
            (&first.tangent, first.inverse_size),
            (&frame.middle, frame.inverse_size),
            (&last.tangent, last.inverse_size),
        ];
        for i in 0..3 {
            for j in 0..3 {
                let half = more[i][j] * l * self.number(0.5);
                for (place, count) in places[j] {
                    for d in 0..3 {
                        let form = along[j].0[d] * *count;
                        mixed[i][place + d] = form.times_plus(half, mixed[i][place + d]);
                    }
                }
            }
        }
        for i in 0..3 {
            let (t, inverse_size) = along[i];
            // What is across the tangent makes it longer in the second order.
            let rise = factors[i] * l * inverse_size;
            for (place, count) in places[i] {
                for d in 0..3 {
                    let form = t[d] * *count;
                    let row = place + d;
                    for k in 0..=row {
                        matrix[row][k] = form.times_plus(mixed[i][k], matrix[row][k]);
                    }
                    for k in row..V {
                        matrix[k][row] = form.times_plus(mixed[i][k], matrix[k][row]);
                    }
                    for (other, part) in places[i] {
                        let share = rise * *count * *part;
                        for c in 0..3 {
                            let entry = &mut matrix[row][other + c];
                            *entry = *entry - share * t[d] * t[c];
                        }
                        matrix[row][other + d] += share;
                    }
                }
            }
        }
    }
}

/// Derivatives of the energy by the lengths of the slope at the first end, in the middle and at the last end.
pub(in crate::elements) struct LengthDerivatives<N, const V: usize> {
    pub first: [N; 3],
    pub second: [[N; 3]; 3],
    /// Second derivatives by the lengths and by all velocities of the element.
    pub mixed: [[N; V]; 3],
}

/// Second derivatives of the energy of a rod with lengths of the slope, summed over sections.
pub(super) struct Stretching<N> {
    /// Second derivatives by the coordinates of a rod and by the lengths.
    mixed: [Sum<N>; 3],
    /// With each other.
    own: [[N; 3]; 3],
    /// First derivatives by them.
    factors: [N; 3],
}

impl<N: Real> Stretching<N> {
    #[inline(always)]
    pub fn nothing(zero: N) -> Self {
        Self {
            mixed: [Sum::nothing(zero); 3],
            own: [[zero; 3]; 3],
            factors: [zero; 3],
        }
    }

    /// Adds the second derivatives at a point: axial force by stretch (`own`) and by strains (`with`) there.
    #[inline(always)]
    pub fn add(
        &mut self,
        geometry: &Geometry<N>,
        place: PlacedSection<'_, N>,
        own: N,
        with: &[N; 3],
    ) {
        let point = place.point;
        let (weight, shapes) = (geometry.number(point.weight), parabola(point.at));
        for k in 0..3 {
            let count = weight * geometry.number(shapes[k]);
            let column = times(with, count);
            geometry.add_section(place, &column, &mut self.mixed[k]);
            geometry.add_at_point(point.at, own * count, &mut self.own[k]);
        }
    }

    /// Adds the axial force at a point, N.
    #[inline(always)]
    pub fn add_pull(&mut self, geometry: &Geometry<N>, point: &Sample, pull: N) {
        let weight = geometry.number(point.weight);
        geometry.add_at_point(point.at, pull * weight, &mut self.factors);
    }

    /// Adds all of it to the second derivatives over the velocities.
    #[inline(always)]
    pub fn add_to(&self, geometry: &Geometry<N>, frame: &Frame<N>, matrix: &mut Matrix<N>) {
        let zero = geometry.number(0.0);
        let mut mixed = [[zero; VELOCITIES]; 3];
        for k in 0..3 {
            let force = geometry.spread(frame, &self.mixed[k]).flat();
            mixed[k] = each!(force, i => -force[i]);
        }
        let mut lengths = LengthDerivatives {
            first: self.factors,
            second: self.own,
            mixed,
        };
        geometry.add_second_lengths(frame, [0, 3, 7, 10], &mut lengths, matrix);
        for row in 0..VELOCITIES {
            for column in 0..row {
                matrix[column][row] = matrix[row][column];
            }
        }
    }
}
