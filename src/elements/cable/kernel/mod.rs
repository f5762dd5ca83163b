//! The formulas of a cable, for one element or for several in lanes.
//!
//! A point of quadrature sees `u = r'` and `w = r''`. Energy densities are functions of
//! `a = u.u` (axial strain) and of `c = u ^ w` and `a` (curvature); forces and tangents are their
//! derivatives by the vectors `(r_B - r_A) / l`, slope at A, slope at B. Rigid translation drops out,
//! which is why sums run over three vectors, not four.

use crate::elements::StrainMeasure;
use crate::elements::line::{Components, Sample, combine, dot, times};
use crate::math::jet::Number;
use crate::math::lanes::{Lanes, PACK, Real, Simd};
use crate::math::quadrature::{BETWEEN_3, GAUSS_3, QuadraturePoint, RADAU_3, RADAU_3_LAST};

type Square<N, const D: usize> = [[N; D]; D];

/// The three vectors and, where damping reads them, their rates.
#[derive(Clone, Copy)]
struct Motion<'a, N, const D: usize> {
    v: &'a [Components<N, D>; 3],
    dv: &'a Option<[Components<N, D>; 3]>,
}

/// Forces on the three vectors, summed over points, and the powers of axial and of bending damping.
struct ForceSum<N, const D: usize> {
    vectors: [Components<N, D>; 3],
    power: [N; 2],
}

/// Calls a method once for each axial point. Written out: with points known when compiling.
macro_rules! at_axial_points {
    ($self:ident, $method:ident($($argument:expr),*)) => {
        match $self.sampling {
            sampling if !N::WRITTEN_OUT => {
                for (index, point) in sampling.points().iter().enumerate() {
                    $self.$method(index, point, $($argument),*);
                }
            }
            Sampling::Between => at_axial_points!($self, $method($($argument),*), BETWEEN),
            Sampling::Lobatto => at_axial_points!($self, $method($($argument),*), LOBATTO),
            Sampling::FreeLast => at_axial_points!($self, $method($($argument),*), RADAU),
            Sampling::FreeFirst => at_axial_points!($self, $method($($argument),*), RADAU_LAST),
        }
    };
    ($self:ident, $method:ident($($argument:expr),*), $points:ident) => {{
        let [p, q, r] = &$points;
        $self.$method(0, p, $($argument),*);
        $self.$method(1, q, $($argument),*);
        $self.$method(2, r, $($argument),*);
    }};
}

/// Calls a method once for each bending point: written out in the plane; in space once in a loop, which is as fast
/// and takes a third of the time to compile.
macro_rules! at_bending_points {
    ($self:ident, $method:ident($($argument:expr),*)) => {
        if D == 2 && N::WRITTEN_OUT {
            let [p, q, r] = &BENDING;
            $self.$method(0, p, $($argument),*);
            $self.$method(1, q, $($argument),*);
            $self.$method(2, r, $($argument),*);
        } else {
            for (index, point) in BENDING.iter().enumerate() {
                $self.$method(index, point, $($argument),*);
            }
        }
    };
}

mod sampling;
mod tangent;
mod vectors;

pub(super) use sampling::Sampling;
use sampling::{BENDING, BETWEEN, LOBATTO, RADAU, RADAU_LAST};
pub(super) use tangent::{Factors, transposed};
pub(super) use vectors::TURNS;
use vectors::{contract, inner, turns, wedge};

/// Curvature times length of an element below which it counts as straight. Roundoff across the plane that it is bent in
/// is magnified by one over this where a damped cable swings through its straight shape.
const FLAT: f64 = 1e-5;

/// `u = r'` and `w = r''`, or their rates.
#[derive(Clone, Copy)]
pub(super) struct Line<N, const D: usize> {
    pub u: Components<N, D>,
    pub w: Components<N, D>,
}

/// Curvature `c a^-p` with `c = u ^ w`; `a^-p`, and `2 p / a`. `p` is 1 for the rotation per reference
/// length and 3/2 for the curvature of the deformed line.
pub(super) struct Curvature<N> {
    pub value: [N; TURNS],
    scale: N,
    decay: N,
    /// 1 / a.
    inverse: N,
}

/// Parameters of one element or, in lanes, of several.
#[derive(Clone, Debug)]
pub(super) struct Kernel<N> {
    pub length: N,
    pub inverse_length: N,
    /// Axial stiffness at the axial points, N.
    pub axial_stiffness: [N; 3],
    /// Bending stiffness at the bending points, N m^2.
    pub bending_stiffness: [N; 3],
    pub axial_damping_time: N,
    pub bending_damping_time: N,
    /// Axial strain of the unstressed shape at the axial points.
    pub natural_strain: [N; 3],
    /// Curvature of the unstressed shape at the bending points, 1/m.
    pub natural_curvature: [[N; TURNS]; 3],
    pub sampling: Sampling,
    pub strain: StrainMeasure,
    pub is_damped: bool,
    pub bends: bool,
}

impl Kernel<f64> {
    /// Converts the kernel to constants of another number type.
    #[inline(always)]
    pub fn lift<N: Number>(&self) -> Kernel<N> {
        Kernel {
            length: N::of(self.length),
            inverse_length: N::of(self.inverse_length),
            axial_stiffness: self.axial_stiffness.map(N::of),
            bending_stiffness: self.bending_stiffness.map(N::of),
            axial_damping_time: N::of(self.axial_damping_time),
            bending_damping_time: N::of(self.bending_damping_time),
            natural_strain: self.natural_strain.map(N::of),
            natural_curvature: self.natural_curvature.map(|c| c.map(N::of)),
            sampling: self.sampling,
            strain: self.strain,
            is_damped: self.is_damped,
            bends: self.bends,
        }
    }
}

impl Kernel<[f64; PACK]> {
    /// A group of the elements of a pack, [shortened](Kernel::shortened).
    #[inline(always)]
    pub fn group<S: Simd>(&self, simd: S, group: usize, by: f64) -> Kernel<Lanes<S>> {
        let read = |numbers: &[f64; PACK]| Lanes::read(simd, numbers, group);
        let length = read(&self.length);
        let (mut axial_stiffness, mut bending_stiffness) = ([length; 3], [length; 3]);
        let (mut natural_strain, mut natural_curvature) = ([length; 3], [[length; TURNS]; 3]);
        for i in 0..3 {
            axial_stiffness[i] = read(&self.axial_stiffness[i]);
            bending_stiffness[i] = read(&self.bending_stiffness[i]);
            natural_strain[i] = read(&self.natural_strain[i]);
        }
        for i in 0..3 {
            for k in 0..TURNS {
                natural_curvature[i][k] = read(&self.natural_curvature[i][k]);
            }
        }
        Kernel {
            length,
            inverse_length: read(&self.inverse_length),
            axial_stiffness,
            bending_stiffness,
            axial_damping_time: read(&self.axial_damping_time),
            bending_damping_time: read(&self.bending_damping_time),
            natural_strain,
            natural_curvature,
            sampling: self.sampling,
            strain: self.strain,
            is_damped: self.is_damped,
            bends: self.bends,
        }
        .shortened(length.constant(by))
    }
}

impl<N: Real> Kernel<N> {
    /// Parameters with which coordinates times `by` give the strain energy times `by` of an element as long as its reference length
    /// over `by`, and its forces: strain is that of the coordinates times `by`, curvature times `by`.
    #[inline(always)]
    pub fn shortened(mut self, by: N) -> Self {
        let square = by * by;
        for stiffness in &mut self.bending_stiffness {
            *stiffness = *stiffness * square;
        }
        self
    }

    /// Parameters whose tangents are over coordinates times the root of `by`: once for those that forces are derived by, once for the
    /// roots.
    #[inline(always)]
    pub fn by_roots(mut self, by: f64) -> Self {
        let factor = self.number(by * by);
        for i in 0..3 {
            self.axial_stiffness[i] = self.axial_stiffness[i] * factor;
            self.bending_stiffness[i] = self.bending_stiffness[i] * factor;
        }
        self
    }

    #[inline(always)]
    fn number(&self, value: f64) -> N {
        self.length.constant(value)
    }

    #[inline(always)]
    fn vectors<const D: usize>(&self, e: &[Components<N, D>; 4]) -> [Components<N, D>; 3] {
        let chord = each!(e[0], i => (e[2][i] - e[0][i]) * self.inverse_length);
        [chord, e[1], e[3]]
    }

    #[inline(always)]
    fn line<const D: usize>(&self, at: &Sample, v: &[Components<N, D>; 3]) -> Line<N, D> {
        Line {
            u: combine(&at.slope, v),
            w: times(&combine(&at.curvature, v), self.inverse_length),
        }
    }

    /// Axial strain and its derivatives as functions of `a = r'.r'`: strain, `f` and `g` in
    /// `d strain = f u.du`, `d^2 strain = f du.du + g (u.du)^2`.
    #[inline(always)]
    pub fn axial(&self, a: N) -> (N, N, N) {
        match self.strain {
            StrainMeasure::GreenLagrangeFrenetKappa => (
                self.number(0.5) * (a - self.number(1.0)),
                self.number(1.0),
                self.number(0.0),
            ),
            StrainMeasure::ThetaPrime | StrainMeasure::EngStrainFrenetKappa => {
                let stretch = a.root();
                let inverse = self.number(1.0) / stretch;
                let strain = stretch - self.number(1.0);
                (strain, inverse, -(inverse * inverse * inverse))
            }
        }
    }

    #[inline(always)]
    pub fn curvature<const D: usize>(&self, at: &Line<N, D>) -> Curvature<N> {
        let a = dot(&at.u, &at.u);
        let inverse = self.number(1.0) / a;
        let (scale, twice_power) = match self.strain {
            StrainMeasure::ThetaPrime => (inverse, 2.0),
            _ => (inverse / a.root(), 3.0),
        };
        Curvature {
            value: times(&wedge(&at.u, &at.w), scale),
            scale,
            decay: self.number(twice_power) * inverse,
            inverse,
        }
    }

    /// Rate of curvature.
    #[inline(always)]
    pub fn curvature_rate<const D: usize>(
        &self,
        at: &Line<N, D>,
        rate: &Line<N, D>,
        now: &Curvature<N>,
    ) -> [N; TURNS] {
        let (first, second): ([N; TURNS], [N; TURNS]) =
            (wedge(&rate.u, &at.w), wedge(&at.u, &rate.w));
        let shrink = now.decay * dot(&at.u, &rate.u);
        each!(now.value, k => {
            now.scale * (first[k] + second[k]) - shrink * now.value[k]
        })
    }

    /// Unit normal of the plane that a cable in space is bent in, nothing where it is straight; and whether it is: 1
    /// less the square of that normal.
    #[inline(always)]
    fn plane<const D: usize>(&self, now: &Curvature<N>) -> ([N; TURNS], N) {
        let flat = self.inverse_length * self.number(FLAT);
        let (square, flat) = (inner::<N, D>(&now.value, &now.value), flat * flat);
        let all = square * square + flat * flat;
        let normal = times(&now.value, (square / all).root());
        (normal, flat * flat / all)
    }

    /// Axial strains and curvatures at the quadrature points: those of an unstressed shape.
    #[inline(always)]
    pub fn strains<const D: usize>(&self, e: &[Components<N, D>; 4]) -> ([N; 3], [[N; TURNS]; 3]) {
        let v = self.vectors(e);
        let axial = self.axial_samples(e, None);
        let mut bending = self.natural_curvature;
        for (value, point) in bending.iter_mut().zip(&BENDING) {
            *value = self.curvature(&self.line(point, &v)).value;
        }
        (axial, bending)
    }

    /// A quantity at `xi` from its values at the axial points, as it balances loads: a parabola through
    /// them whose part of the second degree is weighted as the integral of its square is to what the
    /// points make of it (5/2 and 2): a load in proportion to that part is balanced by it.
    #[inline(always)]
    pub fn recover(&self, [a, b, c]: [N; 3], xi: f64) -> N {
        let x = 2.0 * xi - 1.0;
        let (far, weight) = match self.sampling {
            Sampling::Lobatto => (1.0, 2.5),
            Sampling::Between => (2.0 * BETWEEN_3[2].at - 1.0, 2.0),
            Sampling::FreeLast => return self.parabola([a, b, c], &RADAU_3, x),
            Sampling::FreeFirst => return self.parabola([a, b, c], &RADAU_3_LAST, x),
        };
        let second = self.number(1.0 / (1.5 * far * far)) * (self.number(0.5) * (a + c) - b);
        let mean = b + self.number(0.5) * second;
        mean + (c - a) * self.number(0.5 * x / far)
            + second * self.number(weight * (1.5 * x * x - 0.5))
    }

    /// Curvature of the unstressed shape at `xi` in [0, 1]: the parabola through its values at the bending points, 1/m.
    #[inline(always)]
    pub fn natural_curvature_at(&self, xi: f64) -> [N; TURNS] {
        let [a, b, c] = &self.natural_curvature;
        each!(*a, k => self.parabola([a[k], b[k], c[k]], &GAUSS_3, 2.0 * xi - 1.0))
    }

    /// The parabola through three points of a rule that integrates its square, at `x` in [-1, 1], by its products
    /// with Legendre polynomials.
    #[inline(always)]
    fn parabola(&self, values: [N; 3], rule: &[QuadraturePoint; 3], x: f64) -> N {
        let mut sum = self.number(0.0);
        for (value, point) in values.into_iter().zip(rule) {
            let y = 2.0 * point.at - 1.0;
            let second = 5.0 * (1.5 * x * x - 0.5) * (1.5 * y * y - 0.5);
            sum += value * self.number(point.weight * (1.0 + 3.0 * x * y + second));
        }
        sum
    }

    /// Total axial strain, with what damping adds, at the axial points, not less its natural value.
    #[inline(always)]
    pub fn axial_samples<const D: usize>(
        &self,
        e: &[Components<N, D>; 4],
        rate: Option<&[Components<N, D>; 4]>,
    ) -> [N; 3] {
        let v = self.vectors(e);
        let dv = of_rate!(rate, rate => self.vectors(rate));
        let points = self.sampling.points();
        let mut samples = self.natural_strain;
        for (sample, point) in samples.iter_mut().zip(points) {
            let u = combine(&point.slope, &v);
            let (strain, f, _) = self.axial(dot(&u, &u));
            *sample = strain;
            if let Some(dv) = &dv {
                *sample += self.axial_damping_time * f * dot(&u, &combine(&point.slope, dv));
            }
        }
        samples
    }

    /// Axial force at a point, and `f` and `g` of [`Self::axial`]; then the rate of strain where damping reads it.
    #[inline(always)]
    fn axial_force<const D: usize>(
        &self,
        index: usize,
        u: &Components<N, D>,
        rate: Option<Components<N, D>>,
    ) -> ((N, N, N), Option<N>) {
        let (strain, f, g) = self.axial(dot(u, u));
        let mut total = strain - self.natural_strain[index];
        let change = of_rate!(rate, du => f * dot(u, &du));
        if let Some(change) = change {
            total += self.axial_damping_time * change;
        }
        ((self.axial_stiffness[index] * total, f, g), change)
    }

    /// Moment at a point; then, where damping reads it, the product of the rate of curvature with what damping acts
    /// against.
    #[inline(always)]
    fn moment<const D: usize>(
        &self,
        index: usize,
        at: &Line<N, D>,
        rate: Option<Line<N, D>>,
        now: &Curvature<N>,
    ) -> ([N; TURNS], Option<N>) {
        let natural = &self.natural_curvature[index];
        let mut m: [N; TURNS] = each!(now.value, k => now.value[k] - natural[k]);
        let change = of_rate!(&rate, rate => self.curvature_rate(at, rate, now));
        let square = of_rate!(&change, change => {
            let damped = self.damped::<D>(now, change);
            for k in 0..TURNS {
                m[k] += self.bending_damping_time * damped[k];
            }
            inner::<N, D>(&damped, change)
        });
        (times(&m, self.bending_stiffness[index]), square)
    }

    /// Returns the part of the curvature rate that damping acts on. In space a cable without torsion has no frame that
    /// rotates about its tangent. All such frames agree on the rate of the curvature's size. A straight cable is damped
    /// by the whole rate.
    #[inline(always)]
    fn damped<const D: usize>(&self, now: &Curvature<N>, change: &[N; TURNS]) -> [N; TURNS] {
        if D == 2 {
            return *change;
        }
        let (plane, straight) = self.plane::<D>(now);
        let along = inner::<N, D>(&plane, change);
        each!(*change, k => plane[k] * along + change[k] * straight)
    }

    /// Strain energy, J.
    #[inline(always)]
    pub fn energy<const D: usize>(&self, e: &[Components<N, D>; 4]) -> N {
        let (axial, bending) = self.strains(e);
        let mut sum = self.number(0.0);
        for (k, point) in self.sampling.points().iter().enumerate() {
            let strain = axial[k] - self.natural_strain[k];
            sum += self.number(point.weight) * self.axial_stiffness[k] * strain * strain;
        }
        for (k, point) in BENDING.iter().enumerate() {
            let natural = &self.natural_curvature[k];
            let change: [N; TURNS] = each!(bending[k], i => bending[k][i] - natural[i]);
            sum += self.number(point.weight)
                * self.bending_stiffness[k]
                * inner::<N, D>(&change, &change);
        }
        self.number(0.5) * self.length * sum
    }

    /// Elastic force and, with rates, damping force on the coordinates; and the power that damping takes out, W.
    #[inline(always)]
    pub fn force<const D: usize>(
        &self,
        e: &[Components<N, D>; 4],
        rate: Option<&[Components<N, D>; 4]>,
    ) -> ([Components<N, D>; 4], N) {
        let v = self.vectors(e);
        let dv = of_rate!(rate, rate => self.vectors(rate));
        let motion = Motion { v: &v, dv: &dv };
        let mut sum = ForceSum {
            vectors: [[self.number(0.0); D]; 3],
            power: [self.number(0.0); 2],
        };
        at_axial_points!(self, add_axial_force(motion, &mut sum));
        if self.bends {
            at_bending_points!(self, add_bending_force(motion, &mut sum));
        }
        let ForceSum {
            vectors: sum,
            power,
        } = sum;
        let l = self.length;
        let force = [
            sum[0],
            times(&sum[1], -l),
            times(&sum[0], self.number(-1.0)),
            times(&sum[2], -l),
        ];
        let [axial, bending] = power;
        let power = self.axial_damping_time * axial + self.bending_damping_time * bending;
        (force, l * power)
    }

    #[inline(always)]
    fn add_axial_force<const D: usize>(
        &self,
        index: usize,
        point: &Sample,
        Motion { v, dv }: Motion<N, D>,
        ForceSum {
            vectors: sum,
            power,
        }: &mut ForceSum<N, D>,
    ) {
        let u = combine(&point.slope, v);
        let du = of_rate!(dv, dv => combine(&point.slope, dv));
        let ((force, f, _), change) = self.axial_force(index, &u, du);
        let weight = self.number(point.weight);
        if let Some(change) = change {
            power[0] += weight * self.axial_stiffness[index] * change * change;
        }
        let gradient = times(&u, weight * force * f);
        for i in 0..3 {
            if point.slope[i] != 0.0 {
                for d in 0..D {
                    sum[i][d] = gradient[d].times_plus(self.number(point.slope[i]), sum[i][d]);
                }
            }
        }
    }

    #[inline(always)]
    fn add_bending_force<const D: usize>(
        &self,
        index: usize,
        point: &Sample,
        Motion { v, dv }: Motion<N, D>,
        ForceSum {
            vectors: sum,
            power,
        }: &mut ForceSum<N, D>,
    ) {
        let at = self.line(point, v);
        let rate = of_rate!(dv, dv => self.line(point, dv));
        let now = self.curvature(&at);
        let (m, square) = self.moment(index, &at, rate, &now);
        let weight = self.number(point.weight);
        if let Some(square) = square {
            power[1] += weight * self.bending_stiffness[index] * square;
        }
        let along = now.decay * inner::<N, D>(&m, &now.value);
        let m = times(&m, now.scale);
        let (mu, mw) = (contract(&m, &at.u), contract(&m, &at.w));
        let curved = weight * self.inverse_length;
        for d in 0..D {
            let by_u = at.u[d].times_plus(along, mw[d]) * -weight;
            let by_w = mu[d] * curved;
            for i in 0..3 {
                let by_u = by_u.times_plus(self.number(point.slope[i]), sum[i][d]);
                sum[i][d] = by_w.times_plus(self.number(point.curvature[i]), by_u);
            }
        }
    }
}
