//! Intervals that hold every value of a formula over a stretch of its argument.
//!
//! Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009, chapters 2
//! and 5. Ends are rounded outward by relative [`ROUNDING`], which covers operations and library functions.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Relative error of one operation or library function, rounded up.
const ROUNDING: f64 = 1e-15;

/// All numbers from `lo` to `hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub lo: f64,
    pub hi: f64,
}

impl Interval {
    /// All numbers.
    pub const WHOLE: Self = Self {
        lo: f64::NEG_INFINITY,
        hi: f64::INFINITY,
    };

    /// One number.
    pub const fn point(value: f64) -> Self {
        Self {
            lo: value,
            hi: value,
        }
    }

    /// From `lo` to `hi` and what rounding adds; everything where that is not known.
    pub fn new(lo: f64, hi: f64) -> Self {
        let (lo, hi) = (lo - ROUNDING * lo.abs(), hi + ROUNDING * hi.abs());
        // Infinity less infinity.
        if lo.is_nan() || hi.is_nan() {
            return Self::WHOLE;
        }
        Self { lo, hi }
    }

    /// Values at both ends of a function that rises.
    pub fn rising(self, f: impl Fn(f64) -> f64) -> Self {
        Self::new(f(self.lo), f(self.hi))
    }

    pub fn negated(self) -> Self {
        Self {
            lo: -self.hi,
            hi: -self.lo,
        }
    }

    pub fn plus(self, other: Self) -> Self {
        Self::new(self.lo + other.lo, self.hi + other.hi)
    }

    pub fn minus(self, other: Self) -> Self {
        self.plus(other.negated())
    }

    pub fn times(self, other: Self) -> Self {
        // Zero times what is unbounded is zero: the bound itself is never taken.
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let corners = [
            product(self.lo, other.lo),
            product(self.lo, other.hi),
            product(self.hi, other.lo),
            product(self.hi, other.hi),
        ];
        let lo = corners.into_iter().fold(f64::INFINITY, f64::min);
        Self::new(lo, corners.into_iter().fold(f64::NEG_INFINITY, f64::max))
    }

    pub fn over(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::WHOLE;
        }
        self.times(Self::new(1.0 / other.hi, 1.0 / other.lo))
    }

    pub fn square(self) -> Self {
        self.power(2.0)
    }

    /// To a constant power; a power that is no integer has no value below zero.
    pub fn power(self, n: f64) -> Self {
        if n < 0.0 {
            return Self::point(1.0).over(self.power(-n));
        }
        let even = n % 2.0 == 0.0;
        let whole = n % 1.0 == 0.0;
        if even {
            let (near, far) = (self.nearest_zero(), self.lo.abs().max(self.hi.abs()));
            return Self::new(near.powf(n), far.powf(n));
        }
        let base = if whole { self } else { self.at_least(0.0) };
        base.rising(|x| x.powf(n))
    }

    pub fn contains(self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }

    /// The smallest size in it.
    fn nearest_zero(self) -> f64 {
        if self.contains(0.0) {
            return 0.0;
        }
        self.lo.abs().min(self.hi.abs())
    }

    /// Returns the part of the interval from `least` on.
    pub fn at_least(self, least: f64) -> Self {
        Self {
            lo: self.lo.max(least),
            hi: self.hi.max(least),
        }
    }

    /// Returns the part of the interval up to `most`.
    pub fn at_most(self, most: f64) -> Self {
        self.negated().at_least(-most).negated()
    }

    /// The larger of two numbers.
    pub fn larger(self, other: Self) -> Self {
        Self {
            lo: self.lo.max(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    /// Returns the intersection, or `self` where rounding leaves none.
    pub fn and(self, other: Self) -> Self {
        let (lo, hi) = (self.lo.max(other.lo), self.hi.min(other.hi));
        if lo <= hi { Self { lo, hi } } else { self }
    }

    pub fn cosh(self) -> Self {
        let (near, far) = (self.nearest_zero(), self.lo.abs().max(self.hi.abs()));
        Self::new(near.cosh(), far.cosh())
    }

    pub fn cos(self) -> Self {
        self.wave(f64::cos, 0.0)
    }

    pub fn sin(self) -> Self {
        self.wave(f64::sin, FRAC_PI_2)
    }

    /// A sine or cosine, which has one of its peaks here.
    fn wave(self, f: fn(f64) -> f64, peak: f64) -> Self {
        if (self.hi - self.lo).is_nan() || self.hi - self.lo >= TAU {
            return Self { lo: -1.0, hi: 1.0 };
        }
        let passes = |at: f64| {
            let turns = |x: f64| ((x - at) / TAU).floor();
            turns(self.lo) != turns(self.hi)
        };
        let (a, b) = (f(self.lo), f(self.hi));
        let found = Self::new(a.min(b), a.max(b));
        Self {
            lo: if passes(peak - PI) { -1.0 } else { found.lo },
            hi: if passes(peak) { 1.0 } else { found.hi },
        }
    }

    pub fn tan(self) -> Self {
        let branch = |x: f64| ((x - FRAC_PI_2) / PI).floor();
        if (self.hi - self.lo).is_nan()
            || self.hi - self.lo >= PI
            || branch(self.lo) != branch(self.hi)
        {
            return Self::WHOLE;
        }
        self.rising(f64::tan)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values inside an interval are inside what comes out.
    #[test]
    fn an_interval_holds_the_values_of_the_formula() {
        type Pair = (fn(Interval) -> Interval, fn(f64) -> f64);
        let formulas: [Pair; 9] = [
            (Interval::sin, f64::sin),
            (Interval::cos, f64::cos),
            (Interval::tan, f64::tan),
            (Interval::cosh, f64::cosh),
            (Interval::square, |x| x * x),
            (|x| x.power(3.0), |x| x.powi(3)),
            (|x| x.power(-2.0), |x| x.powi(-2)),
            (
                |x| x.times(x.minus(Interval::point(2.0))),
                |x| x * (x - 2.0),
            ),
            (|x| Interval::point(3.0).over(x), |x| 3.0 / x),
        ];
        for (number, (enclosed, plain)) in formulas.into_iter().enumerate() {
            for k in -40..40 {
                for width in [0.0, 0.01, 0.7, 3.0, 7.0] {
                    let lo = 0.31 * f64::from(k);
                    let range = enclosed(Interval { lo, hi: lo + width });
                    for part in 0..=20 {
                        let x = lo + width * f64::from(part) / 20.0;
                        let y = plain(x);
                        let inside = range.contains(y) || !y.is_finite();
                        assert!(inside, "{number} at {x}: {y} of {range:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn narrow_intervals_stay_narrow() {
        let x = Interval { lo: 1.0, hi: 1.001 };
        for range in [x.sin(), x.cos(), x.tan(), x.square(), x.over(x.cosh())] {
            assert!(range.hi - range.lo < 0.005, "{range:?}");
        }
    }
}
