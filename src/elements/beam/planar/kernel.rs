//! The formulas of a planar beam, for one element or for several in lanes, or for numbers with derivatives.
//!
//! Source: the equations of `planar/mod.rs`.

use crate::elements::beam::kernel::Shapes;
use crate::elements::beam::{At, Force, Rates};
use crate::elements::constitutive::Law;
use crate::elements::line::{Sample, combine, dot, times};
use crate::elements::rod::geometry::{LOADED, MIDDLE, POINTS};
use crate::elements::rod::vectors::{add, plus};
use crate::math::lanes::Real;

/// A vector of the plane.
pub(super) type Two<N> = [N; 2];
/// Strains or stresses: axial, shear, bending; or one number a place.
pub type Three<N> = [N; 3];

/// Parameters of one element or, in lanes, of several.
#[derive(Clone, Debug)]
pub(super) struct Kernel<N> {
    pub length: N,
    pub inverse_length: N,
    pub law: Law<N, 3>,
}

/// Slope and section at one of the three places.
#[derive(Clone, Copy)]
pub(super) struct Place<N> {
    /// Unit tangent, and length of the slope.
    pub tangent: Two<N>,
    pub size: N,
    pub inverse_size: N,
    /// `c`, and its change by the angle of the section: `1 + c^2 / 4`.
    pub shear_rotation: N,
    pub gain: N,
}

/// The line at a point, and what strains are made of there.
pub(super) struct Local<N> {
    pub slope: Two<N>,
    /// `l r''`.
    pub second: Two<N>,
    /// One over the square of the slope.
    pub inverse: N,
    pub curvature: N,
    pub stretch: N,
    pub shear_rotation: N,
    /// `c'`, 1/m.
    pub change: N,
    /// `D`, `cos(theta)`, `sin(theta)`.
    pub shrink: N,
    pub cosine: N,
    pub sine: N,
}

/// Velocities as far as they lie in the plane.
pub(super) struct Motion<N> {
    e: [Two<N>; 4],
    /// Angular velocities of the three sections, rad/s.
    spin: Three<N>,
}

/// Factors of the stretches and shear rotations of the places and of the vectors of the line in a power.
struct Sum<N> {
    vectors: [Two<N>; 3],
    stretches: Three<N>,
    shear_rotations: Three<N>,
}

impl<N: Real> Motion<N> {
    #[inline(always)]
    pub fn of(rates: &Rates<N>) -> Self {
        let [first, last] = [rates.spin[0][1], rates.spin[1][1]];
        Self {
            e: [
                flat(&rates.e[0]),
                flat(&rates.e[1]),
                flat(&rates.e[2]),
                flat(&rates.e[3]),
            ],
            spin: [first, rates.inner[1], last],
        }
    }
}

#[inline(always)]
fn flat<N: Real>(v: &[N; 3]) -> Two<N> {
    [v[0], v[1]]
}

/// Rotated left by a right angle.
#[inline(always)]
pub(super) fn left<N: Real>(v: &Two<N>) -> Two<N> {
    [-v[1], v[0]]
}

#[inline(always)]
fn cross<N: Real>(a: &Two<N>, b: &Two<N>) -> N {
    a[0] * b[1] - a[1] * b[0]
}

impl Kernel<f64> {
    /// Converts the kernel to constants of the number type of `like`.
    #[inline(always)]
    pub fn lift<N: Real>(&self, like: N) -> Kernel<N> {
        Kernel {
            length: like.constant(self.length),
            inverse_length: like.constant(self.inverse_length),
            law: self.law.lift(like),
        }
    }
}

impl<N: Real> Place<N> {
    #[inline(always)]
    fn new(slope: &Two<N>, normal: &Two<N>) -> Self {
        let one = slope[0].constant(1.0);
        let inverse_size = one / dot(slope, slope).root();
        let tangent = times(slope, inverse_size);
        let shear_rotation = (one + one) * cross(&tangent, normal) / (one + dot(&tangent, normal));
        Self {
            size: dot(slope, &tangent),
            gain: (shear_rotation * shear_rotation).times_plus(one.constant(0.25), one),
            tangent,
            inverse_size,
            shear_rotation,
        }
    }

    /// Change of the angle of the tangent by the slope.
    #[inline(always)]
    pub fn turning(&self) -> Two<N> {
        times(&left(&self.tangent), self.inverse_size)
    }
}

impl<N: Real> Local<N> {
    /// Changes of the curvature by slope and `l r''`.
    #[inline(always)]
    pub fn bending(&self, inverse_length: N) -> [Two<N>; 2] {
        let by = inverse_length * self.inverse;
        let twice = self.curvature + self.curvature;
        let [x, y] = self.slope;
        [
            [
                self.second[1] * by - twice * x * self.inverse,
                -(self.second[0] * by) - twice * y * self.inverse,
            ],
            [-(y * by), x * by],
        ]
    }

    #[inline(always)]
    pub fn strains(&self) -> Three<N> {
        let one = self.stretch.constant(1.0);
        [
            self.stretch * self.cosine - one,
            self.stretch * self.sine,
            self.shrink.times_plus(self.change, self.curvature),
        ]
    }

    /// `dD / dc`.
    #[inline(always)]
    pub fn shrinking(&self) -> N {
        -(self.shrink * self.sine * self.shear_rotation.constant(0.5))
    }

    /// Factors of stretch, shear rotation, its change and curvature from stresses.
    #[inline(always)]
    pub fn factors(&self, [axial, shear, moment]: &Three<N>) -> [N; 4] {
        let (n, d) = (self.stretch, self.shrink);
        let across = *shear * self.cosine - *axial * self.sine;
        [
            *axial * self.cosine + *shear * self.sine,
            (n * d).times_plus(across, *moment * self.change * self.shrinking()),
            *moment * d,
            *moment,
        ]
    }

    /// Rates of the strains from those of stretch, shear rotation, its change and curvature.
    #[inline(always)]
    pub fn rates(&self, [stretch, shear_rotation, change, curvature]: &[N; 4]) -> Three<N> {
        let turn = self.shrink * *shear_rotation;
        let n = self.stretch;
        [
            *stretch * self.cosine - n * self.sine * turn,
            *stretch * self.sine + n * self.cosine * turn,
            *curvature + *change * self.shrink + self.change * self.shrinking() * *shear_rotation,
        ]
    }
}

impl<N: Real> Kernel<N> {
    #[inline(always)]
    pub fn number(&self, value: f64) -> N {
        self.length.constant(value)
    }

    /// `(r_B - r_A) / l`, and the slopes at the ends.
    #[inline(always)]
    pub fn vectors(&self, at: &At<N>) -> [Two<N>; 3] {
        self.vectors_of(&[
            flat(&at.e[0]),
            flat(&at.e[1]),
            flat(&at.e[2]),
            flat(&at.e[3]),
        ])
    }

    #[inline(always)]
    fn vectors_of(&self, e: &[Two<N>; 4]) -> [Two<N>; 3] {
        let chord = each!(e[0], i => (e[2][i] - e[0][i]) * self.inverse_length);
        [chord, e[1], e[3]]
    }

    /// Slopes at the three places.
    #[inline(always)]
    pub fn slopes(&self, v: &[Two<N>; 3]) -> [Two<N>; 3] {
        [v[1], combine(&MIDDLE, v), v[2]]
    }

    #[inline(always)]
    pub fn places(&self, v: &[Two<N>; 3], at: &At<N>) -> [Place<N>; 3] {
        let [first, middle, last] = self.slopes(v);
        [
            Place::new(&first, &flat(&at.axes[0][0])),
            Place::new(&middle, &[at.inner[0], at.inner[1]]),
            Place::new(&last, &flat(&at.axes[1][0])),
        ]
    }

    #[inline(always)]
    pub fn local(&self, point: &Sample, v: &[Two<N>; 3], places: &[Place<N>; 3]) -> Local<N> {
        let shapes = parabola(point.at);
        let zero = self.number(0.0);
        let (mut stretch, mut shear_rotation, mut change) = (zero, zero, zero);
        for k in 0..3 {
            let shape = self.number(shapes[0][k]);
            stretch = places[k].size.times_plus(shape, stretch);
            shear_rotation = places[k].shear_rotation.times_plus(shape, shear_rotation);
            change = places[k]
                .shear_rotation
                .times_plus(self.number(shapes[1][k]), change);
        }
        let slope = combine(&point.slope, v);
        let second = combine(&point.curvature, v);
        let one = self.number(1.0);
        let inverse = one / dot(&slope, &slope);
        let shrink = one / (shear_rotation * shear_rotation).times_plus(self.number(0.25), one);
        Local {
            curvature: cross(&slope, &second) * inverse * self.inverse_length,
            slope,
            second,
            inverse,
            stretch,
            change: change * self.inverse_length,
            cosine: shrink + shrink - one,
            sine: shrink * shear_rotation,
            shear_rotation,
            shrink,
        }
    }

    /// Strains at a point.
    #[inline(always)]
    pub fn strains(&self, at: &At<N>, point: &Sample) -> Three<N> {
        let v = self.vectors(at);
        self.local(point, &v, &self.places(&v, at)).strains()
    }

    /// Strain energy, J.
    #[inline(always)]
    pub fn energy(&self, at: &At<N>) -> N {
        let v = self.vectors(at);
        let places = self.places(&v, at);
        let mut sum = self.number(0.0);
        for (index, point) in POINTS.iter().enumerate() {
            let strains = self.local(point, &v, &places).strains();
            let strains = add(&strains, &self.law.offset[index]);
            sum += self.number(0.5 * point.weight)
                * dot(&strains, &product(&self.law.stiffness[index], &strains));
        }
        sum * self.length
    }

    /// Rates of stretch and shear rotation of the places.
    #[inline(always)]
    pub fn moving(
        &self,
        places: &[Place<N>; 3],
        dv: &[Two<N>; 3],
        spin: &Three<N>,
    ) -> [Three<N>; 2] {
        let slopes = self.slopes(dv);
        let (mut stretch, mut shear_rotation) = (*spin, *spin);
        for k in 0..3 {
            stretch[k] = dot(&places[k].tangent, &slopes[k]);
            shear_rotation[k] = (spin[k] - dot(&places[k].turning(), &slopes[k])) * places[k].gain;
        }
        [stretch, shear_rotation]
    }

    /// Rates of the strains at a point.
    #[inline(always)]
    pub fn strain_rates(
        &self,
        point: &Sample,
        local: &Local<N>,
        dv: &[Two<N>; 3],
        [stretches, shear_rotations]: &[Three<N>; 2],
    ) -> Three<N> {
        let shapes = parabola(point.at);
        let zero = self.number(0.0);
        let (mut stretch, mut shear_rotation, mut change) = (zero, zero, zero);
        for k in 0..3 {
            let shape = self.number(shapes[0][k]);
            stretch = stretches[k].times_plus(shape, stretch);
            shear_rotation = shear_rotations[k].times_plus(shape, shear_rotation);
            change = shear_rotations[k].times_plus(self.number(shapes[1][k]), change);
        }
        let [by_slope, by_second] = local.bending(self.inverse_length);
        let curvature = dot(&by_slope, &combine(&point.slope, dv))
            + dot(&by_second, &combine(&point.curvature, dv));
        local.rates(&[
            stretch,
            shear_rotation,
            change * self.inverse_length,
            curvature,
        ])
    }

    /// Velocities as vectors of the line, and rates of stretch and shear rotation of the places.
    #[inline(always)]
    pub fn rates(
        &self,
        places: &[Place<N>; 3],
        motion: &Motion<N>,
    ) -> ([Two<N>; 3], [Three<N>; 2]) {
        let dv = self.vectors_of(&motion.e);
        (dv, self.moving(places, &dv, &motion.spin))
    }

    /// Elastic force and, with rates, damping force; and the power that damping takes out, W.
    #[inline(always)]
    pub fn force(&self, at: &At<N>, motion: Option<&Motion<N>>) -> (Force<N>, N) {
        let v = self.vectors(at);
        let places = self.places(&v, at);
        let moving = of_rate!(motion, motion => self.rates(&places, motion));
        let zero = self.number(0.0);
        let (mut power, mut sum) = (zero, Sum::nothing(zero));
        for (index, point) in POINTS.iter().enumerate() {
            let local = self.local(point, &v, &places);
            let strains = add(&local.strains(), &self.law.offset[index]);
            let mut stress = product(&self.law.stiffness[index], &strains);
            if let Some((dv, moving)) = &moving {
                let rate = self.strain_rates(point, &local, dv, moving);
                let damped = product(&self.law.damping[index], &rate);
                power += self.number(point.weight) * dot(&damped, &rate);
                stress = add(&stress, &damped);
            }
            let factors = local.factors(&times(&stress, self.number(point.weight)));
            self.add(point, &local, &factors, &mut sum);
        }
        (self.spread(&places, sum), power * self.length)
    }

    /// Adds factors of stretch, shear rotation, its change and curvature at a point.
    #[inline(always)]
    fn add(&self, point: &Sample, local: &Local<N>, factors: &[N; 4], sum: &mut Sum<N>) {
        let ([stretch, shear_rotation, change, curvature], shapes) = (factors, parabola(point.at));
        let change = *change * self.inverse_length;
        let [by_slope, by_second] = local.bending(self.inverse_length);
        for k in 0..3 {
            let shape = self.number(shapes[0][k]);
            sum.stretches[k] = stretch.times_plus(shape, sum.stretches[k]);
            sum.shear_rotations[k] = shear_rotation.times_plus(shape, sum.shear_rotations[k]);
            sum.shear_rotations[k] =
                change.times_plus(self.number(shapes[1][k]), sum.shear_rotations[k]);
            let (slope, second) = (point.slope[k], point.curvature[k]);
            let (slope, second) = (self.number(slope), self.number(second));
            let vector = plus(&by_slope, *curvature * slope, &sum.vectors[k]);
            sum.vectors[k] = plus(&by_second, *curvature * second, &vector);
        }
    }

    /// Force from the summed factors.
    #[inline(always)]
    fn spread(&self, places: &[Place<N>; 3], sum: Sum<N>) -> Force<N> {
        let zero = self.number(0.0);
        let (mut vectors, mut moments) = (sum.vectors, [zero; 3]);
        let mut on = [[zero; 2]; 3];
        for k in 0..3 {
            let turn = sum.shear_rotations[k] * places[k].gain;
            moments[k] = -(turn * self.length);
            let along = times(&places[k].tangent, sum.stretches[k]);
            on[k] = plus(&places[k].turning(), -turn, &along);
        }
        for k in 0..3 {
            vectors[k] = plus(&on[1], self.number(MIDDLE[k]), &vectors[k]);
        }
        vectors[1] = add(&vectors[1], &on[0]);
        vectors[2] = add(&vectors[2], &on[2]);
        let [chord, a, b] = vectors;
        let [a, b] = [times(&a, -self.length), times(&b, -self.length)];
        Force {
            e: [
                [chord[0], chord[1], zero],
                [a[0], a[1], zero],
                [-chord[0], -chord[1], zero],
                [b[0], b[1], zero],
            ],
            moment: [[zero, moments[0], zero], [zero, moments[2], zero]],
            inner: [zero, moments[1], zero],
        }
    }

    /// See [`super::Planar::loaded`].
    pub fn loaded(&self, at: &At<N>, moments: &[[N; 3]; LOADED.len()]) -> Force<N> {
        let v = self.vectors(at);
        let places = self.places(&v, at);
        let zero = self.number(0.0);
        let mut sum = Sum::nothing(zero);
        for (point, moment) in LOADED.iter().zip(moments) {
            let local = self.local(point, &v, &places);
            // What is summed is what resists.
            let against = moment[2] * self.number(-point.weight);
            let turning = times(&left(&local.slope), against * local.inverse);
            let by_shear_rotation = against * local.shrink;
            for (k, shape) in parabola(point.at)[0].into_iter().enumerate() {
                sum.shear_rotations[k] =
                    by_shear_rotation.times_plus(self.number(shape), sum.shear_rotations[k]);
                sum.vectors[k] = plus(&turning, self.number(point.slope[k]), &sum.vectors[k]);
            }
        }
        self.spread(&places, sum)
    }
}

impl<N: Real> Sum<N> {
    #[inline(always)]
    fn nothing(zero: N) -> Self {
        Self {
            vectors: [[zero; 2]; 3],
            stretches: [zero; 3],
            shear_rotations: [zero; 3],
        }
    }
}

/// Evaluates the three quadratic shape functions at a point, and their derivatives by the reference length times the
/// length.
#[inline(always)]
pub(super) fn parabola(at: f64) -> [[f64; 3]; 2] {
    let shapes = Shapes::new(at).stretch;
    [shapes, [4.0 * at - 3.0, 4.0 - 8.0 * at, 4.0 * at - 1.0]]
}

#[inline(always)]
pub(super) fn product<N: Real>(by: &[Three<N>; 3], v: &Three<N>) -> Three<N> {
    [dot(&by[0], v), dot(&by[1], v), dot(&by[2], v)]
}
