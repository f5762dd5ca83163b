//! The same formula for several numbers at once, one a lane, with the vector instructions that the
//! processor is found to have when running. Sums keep their order; where a processor can multiply and
//! add in one it does, so that processors of different generations differ in the last bit.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

pub use pulp::Simd;

/// Elements that are computed together; a multiple of the lanes of every processor.
pub const PACK: usize = 8;

/// Numbers of a pack at an address from which lanes are read fastest.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct AlignedPack(pub [f64; PACK]);

/// Arithmetic that formulas use on numbers: on `f64` and [`Lanes`].
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
{
    /// Whether loops over a few points are written out: of numbers in lanes, on which time is spent.
    const WRITTEN_OUT: bool = false;
    /// A constant, in as many lanes.
    fn constant(self, value: f64) -> Self;
    /// Square root.
    fn root(self) -> Self;
    /// `self factor + term`, rounded once where the processor can.
    fn times_plus(self, factor: Self, term: Self) -> Self;
    /// Sine and cosine of it in rad.
    fn sine_cosine(self) -> (Self, Self);
    /// The angle between -pi and pi, rad, whose sine is it and whose cosine is the other one, both times any positive number.
    fn angle(self, cosine: Self) -> Self;
}

impl Real for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    #[inline(always)]
    fn sine_cosine(self) -> (Self, Self) {
        self.sin_cos()
    }

    #[inline(always)]
    fn angle(self, cosine: Self) -> Self {
        self.atan2(cosine)
    }
}

/// As many numbers as the processor takes at once.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<S: Simd>(S, S::f64s);

impl<S: Simd> Lanes<S> {
    /// Group `group` of the numbers of a pack.
    #[inline(always)]
    pub fn read(simd: S, numbers: &[f64; PACK], group: usize) -> Self {
        Self(simd, S::as_simd_f64s(numbers).0[group])
    }

    /// Puts them back.
    #[inline(always)]
    pub fn write(self, numbers: &mut [f64; PACK], group: usize) {
        S::as_mut_simd_f64s(numbers).0[group] = self.1;
    }
}

macro_rules! by_lane {
    ($operator:ident, $call:ident, $lanes:ident) => {
        impl<S: Simd> $operator for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $call(self, other: Self) -> Self {
                Self(self.0, self.0.$lanes(self.1, other.1))
            }
        }
    };
}

by_lane!(Add, add, add_f64s);
by_lane!(Sub, sub, sub_f64s);
by_lane!(Mul, mul, mul_f64s);
by_lane!(Div, div, div_f64s);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0, self.0.neg_f64s(self.1))
    }
}

impl<S: Simd> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> Real for Lanes<S> {
    // One lane is what processors without vectors have.
    const WRITTEN_OUT: bool = S::F64_LANES > 1;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self(self.0, self.0.splat_f64s(value))
    }

    #[inline(always)]
    fn root(self) -> Self {
        Self(self.0, self.0.sqrt_f64s(self.1))
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        Self(self.0, self.0.mul_add_e_f64s(self.1, factor.1, term.1))
    }

    /// Reduces the angle by whole turns, evaluates at a quarter of the rest, and doubles twice.
    #[inline(always)]
    fn sine_cosine(self) -> (Self, Self) {
        let number = |value: f64| self.constant(value);
        let (turn, whole) = (number(TURN[0]), number(ROUND));
        let turns = self.times_plus(number(1.0 / TURN[0]), whole) - whole;
        let rest = turns.times_plus(-turn, self);
        let quarter = turns.times_plus(number(-TURN[1]), rest) * number(0.25);
        let square = quarter * quarter;
        let sine = quarter * self.polynomial(&SINE, square);
        let less = square * self.polynomial(&LESS_COSINE, square);
        let sine = (sine + sine) * (number(1.0) - less);
        let cosine = number(1.0) - (less + less) * (number(2.0) - less);
        let double = sine + sine;
        (double * cosine, number(1.0) - double * sine)
    }

    /// Evaluates the ratio of the smaller to the larger size, or its angle to an eighth of a turn.
    #[inline(always)]
    fn angle(self, cosine: Self) -> Self {
        let (simd, number) = (self.0, |value: f64| self.constant(value));
        let (y, x) = (self.max(-self), cosine.max(-cosine));
        let (low, high) = (Self(simd, simd.min_f64s(y.1, x.1)), y.max(x));
        let is_large = simd.less_than_f64s((high * number(EIGHTH)).1, low.1);
        let pick = |yes: Self, no: Self| Self(simd, simd.select_f64s(is_large, yes.1, no.1));
        let ratio = pick(low - high, low) / pick(low + high, high);
        let arc = ratio * self.polynomial(&ARC_TANGENT, ratio * ratio);
        let angle = arc + pick(number(TURN[0] / 8.0), number(0.0));
        let is_steep = simd.less_than_f64s(x.1, y.1);
        let rest = number(TURN[0] / 4.0) - angle;
        let angle = Self(simd, simd.select_f64s(is_steep, rest.1, angle.1));
        let is_behind = simd.less_than_f64s(cosine.1, number(0.0).1);
        let rest = number(TURN[0] / 2.0) - angle;
        let angle = Self(simd, simd.select_f64s(is_behind, rest.1, angle.1));
        let is_below = simd.less_than_f64s(self.1, number(0.0).1);
        Self(simd, simd.select_f64s(is_below, (-angle).1, angle.1))
    }
}

/// A whole turn, and what its rounding leaves.
const TURN: [f64; 2] = [std::f64::consts::TAU, 2.449_293_598_294_706_5e-16];

/// 1.5 2^52: a number added to it is rounded to a whole one.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// tan(pi / 8).
const EIGHTH: f64 = std::f64::consts::SQRT_2 - 1.0;

/// Eight terms of a series whose term `k` is the one before divided by `-(2 k + more) (2 k + more - 1)`.
const fn series(first: f64, more: f64) -> [f64; 8] {
    let (mut terms, mut k) = ([first; 8], 1);
    while k < 8 {
        let factor = 2.0 * k as f64 + more;
        terms[k] = -terms[k - 1] / (factor * (factor - 1.0));
        k += 1;
    }
    terms
}

/// `sin(x) / x` and `(1 - cos(x)) / x^2` by the square of `x`: 1e-16 of it off at an eighth of a turn.
const SINE: [f64; 8] = series(1.0, 1.0);
const LESS_COSINE: [f64; 8] = series(0.5, 2.0);

/// `atan(x) / x` by the square of `x`, through 12 Chebyshev points up to tan(pi / 8): 1.3e-18 off between them.
const ARC_TANGENT: [f64; 12] = [
    1.0,
    -0.333_333_333_333_331_2,
    0.199_999_999_999_408_93,
    -0.142_857_142_792_502_45,
    0.111_111_107_449_196_58,
    -0.090_908_968_090_640_27,
    0.076_920_453_309_022_25,
    -0.066_629_518_136_291_91,
    0.058_468_782_973_308_72,
    -0.050_351_024_566_015_52,
    0.037_965_257_453_865_94,
    -0.017_805_397_205_419_446,
];

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0, self.0.max_f64s(self.1, other.1))
    }

    /// The polynomial with these coefficients at `x`.
    #[inline(always)]
    fn polynomial<const K: usize>(self, coefficients: &[f64; K], x: Self) -> Self {
        let mut sum = self.constant(coefficients[K - 1]);
        for k in (0..K - 1).rev() {
            sum = sum.times_plus(x, self.constant(coefficients[k]));
        }
        sum
    }
}

/// Work in lanes. All that it spends its time in must be `#[inline(always)]`: what is called instead is
/// compiled for the oldest processor.
pub trait Vectorized {
    /// Does it.
    fn run<S: Simd>(self, simd: S);
}

/// Does work with the vector instructions of this processor where there is enough of it: less than a call costs goes
/// number by number.
#[inline]
pub fn vectorized_where(is_long: bool, work: impl Vectorized) {
    if is_long {
        vectorized(work);
    } else {
        work.run(pulp::Scalar::new());
    }
}

/// Does work with the vector instructions of this processor.
#[inline]
pub fn vectorized(work: impl Vectorized) {
    struct VectorizedCall<W>(W);
    impl<W: Vectorized> pulp::WithSimd for VectorizedCall<W> {
        type Output = ();
        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            self.0.run(simd);
        }
    }
    pulp::Arch::new().dispatch(VectorizedCall(work));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Angles of numbers, their sines and cosines.
    struct Turns<'a>(&'a [[f64; PACK]; 2], &'a mut [[f64; PACK]; 3]);

    impl Vectorized for Turns<'_> {
        fn run<S: Simd>(self, simd: S) {
            for group in 0..PACK / S::F64_LANES {
                let [x, size] = [0, 1].map(|k| Lanes::read(simd, &self.0[k], group));
                let (sine, cosine) = x.sine_cosine();
                let angle = (sine * size).angle(cosine * size);
                for (out, value) in self.1.iter_mut().zip([sine, cosine, angle]) {
                    value.write(out, group);
                }
            }
        }
    }

    #[test]
    fn turns_in_lanes_are_those_of_the_library() {
        let mut worst = [0.0_f64; 3];
        for k in 0..4000 {
            let x: [f64; PACK] =
                std::array::from_fn(|lane| 1.9e-4 * f64::from(8 * (k - 2000) + lane as i32));
            let size = std::array::from_fn(|lane| 0.2 + f64::from(lane as u32));
            for lanes in [false, true] {
                let mut out = [[0.0; PACK]; 3];
                vectorized_where(lanes, Turns(&[x, size], &mut out));
                for lane in 0..PACK {
                    let (sine, cosine) = x[lane].sin_cos();
                    let wanted = [sine, cosine, x[lane]];
                    for part in 0..3 {
                        let miss = (out[part][lane] - wanted[part]).abs();
                        worst[part] = worst[part].max(miss);
                    }
                }
            }
        }
        assert!(
            worst[0] < 1e-15 && worst[1] < 1.5e-15 && worst[2] < 1e-15,
            "{worst:?}"
        );
        let mut out = [[0.0; PACK]; 3];
        let far = std::array::from_fn(|lane| 7.0 * f64::from(lane as u32) - 20.0);
        vectorized(Turns(&[far, [1.0; PACK]], &mut out));
        for lane in 0..PACK {
            assert!((out[0][lane] - far[lane].sin()).abs() < 2e-15);
            assert!((out[1][lane] - far[lane].cos()).abs() < 2e-15);
        }
    }
}
