//! Numbers with first derivatives along several directions at once: the tangent by forward differentiation of the force.
//!
//! Source: A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed. (2008), section 3.1 (forward mode, vector form).

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use crate::math::lanes::Real;

/// A number and its derivatives along `K` directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual<N, const K: usize> {
    pub value: N,
    pub slopes: [N; K],
}

impl<N: Real, const K: usize> Dual<N, K> {
    /// A number that does not change.
    #[inline(always)]
    pub fn fixed(value: N) -> Self {
        let slopes = [value.constant(0.0); K];
        Self { value, slopes }
    }
}

impl<N: Real, const K: usize> Add for Dual<N, K> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            slopes: each!(self.slopes, k => self.slopes[k] + other.slopes[k]),
        }
    }
}

impl<N: Real, const K: usize> Sub for Dual<N, K> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            slopes: each!(self.slopes, k => self.slopes[k] - other.slopes[k]),
        }
    }
}

impl<N: Real, const K: usize> Mul for Dual<N, K> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let product = |k: usize| self.slopes[k] * other.value;
        Self {
            value: self.value * other.value,
            slopes: each!(self.slopes, k => self.value.times_plus(other.slopes[k], product(k))),
        }
    }
}

impl<N: Real, const K: usize> Div for Dual<N, K> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let inverse = self.value.constant(1.0) / other.value;
        let value = self.value * inverse;
        Self {
            value,
            slopes: each!(self.slopes, k => {
                (-value).times_plus(other.slopes[k], self.slopes[k]) * inverse
            }),
        }
    }
}

impl<N: Real, const K: usize> Neg for Dual<N, K> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            slopes: each!(self.slopes, k => -self.slopes[k]),
        }
    }
}

impl<N: Real, const K: usize> AddAssign for Dual<N, K> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<N: Real, const K: usize> Real for Dual<N, K> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::fixed(self.value.constant(value))
    }

    #[inline(always)]
    fn root(self) -> Self {
        let value = self.value.root();
        let factor = value.constant(0.5) / value;
        Self {
            value,
            slopes: each!(self.slopes, k => self.slopes[k] * factor),
        }
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    #[inline(always)]
    fn sine_cosine(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sine_cosine();
        let sine = Self {
            value: sine,
            slopes: each!(self.slopes, k => self.slopes[k] * cosine),
        };
        let cosine = Self {
            value: cosine,
            slopes: each!(self.slopes, k => -(self.slopes[k] * sine.value)),
        };
        (sine, cosine)
    }

    #[inline(always)]
    fn angle(self, cosine: Self) -> Self {
        let (s, c) = (self.value, cosine.value);
        let inverse = s.constant(1.0) / s.times_plus(s, c * c);
        let (by_sine, by_cosine) = (c * inverse, -(s * inverse));
        Self {
            value: s.angle(c),
            slopes: each!(self.slopes, k => {
                by_sine.times_plus(self.slopes[k], by_cosine * cosine.slopes[k])
            }),
        }
    }
}
