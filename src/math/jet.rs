//! Numbers with their first two derivatives along a way, and what formulas need to be written once for
//! them and for plain numbers.

use nalgebra::{ComplexField, RealField, convert};
use num_dual::Dual2_64;

use super::lanes::{AlignedPack, PACK, Real};
use super::state_expression::StateExpression;
use super::sums;

/// A number with its first and second derivative by one variable.
pub type Jet = Dual2_64;

/// Numbers that formulas of markers, loads and joints are written for: `f64` and [`Jet`].
pub trait Number: RealField + Real {
    /// A constant.
    #[inline(always)]
    fn of(value: f64) -> Self {
        convert(value)
    }

    /// Returns the value without derivatives.
    fn plain(self) -> f64;

    /// The largest size of value and derivatives.
    fn largest(self) -> f64;

    /// A function of it: `value`, or from `derivatives`, value and first two derivatives.
    fn map(self, value: impl Fn(f64) -> f64, derivatives: impl Fn(f64) -> [f64; 3]) -> Self;

    /// The value of an expression at a time, for `[x, v, u]`.
    fn of_state(expression: &StateExpression, t: Self, others: [Self; 3]) -> Self;

    /// `out += sum of factors times columns`, which stand one after the other. All are whole packs.
    fn add_columns(columns: &[AlignedPack], factors: &[Self], out: &mut [Self]) {
        let out = out.as_chunks_mut::<PACK>().0;
        for (column, factor) in columns.chunks_exact(out.len().max(1)).zip(factors) {
            let entries = column.iter().flat_map(|pack| pack.0);
            let sums = out.as_flattened_mut().iter_mut().zip(entries);
            sums.for_each(|(sum, entry)| *sum += *factor * Self::of(entry));
        }
    }
}

impl Number for f64 {
    #[inline(always)]
    fn plain(self) -> f64 {
        self
    }

    #[inline(always)]
    fn largest(self) -> f64 {
        self.abs()
    }

    #[inline(always)]
    fn map(self, value: impl Fn(f64) -> f64, _: impl Fn(f64) -> [f64; 3]) -> Self {
        value(self)
    }

    fn of_state(expression: &StateExpression, t: Self, others: [Self; 3]) -> Self {
        expression.run(t, others)
    }

    fn add_columns(columns: &[AlignedPack], factors: &[Self], out: &mut [Self]) {
        sums::add_columns(columns, factors, out);
    }
}

impl Number for Jet {
    fn plain(self) -> f64 {
        self.re
    }

    fn largest(self) -> f64 {
        self.re.abs().max(self.v1.abs()).max(self.v2.abs())
    }

    fn map(self, _: impl Fn(f64) -> f64, derivatives: impl Fn(f64) -> [f64; 3]) -> Self {
        let [value, first, second] = derivatives(self.re);
        let curved = first * self.v2 + second * self.v1 * self.v1;
        Self::new(value, first * self.v1, curved)
    }

    fn of_state(expression: &StateExpression, t: Self, others: [Self; 3]) -> Self {
        expression.run(t, others)
    }
}

impl Real for Jet {
    fn constant(self, value: f64) -> Self {
        Self::from_re(value)
    }

    fn root(self) -> Self {
        self.sqrt()
    }

    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    fn sine_cosine(self) -> (Self, Self) {
        self.sin_cos()
    }

    fn angle(self, cosine: Self) -> Self {
        // Its own arc tangent takes one of a quotient: not where the cosine is zero.
        let value = self.re.atan2(cosine.re);
        let square = self.re * self.re + cosine.re * cosine.re;
        let first = (cosine.re * self.v1 - self.re * cosine.v1) / square;
        let turned = (cosine.re * self.v2 - self.re * cosine.v2) / square;
        let grown = (cosine.re * cosine.v1 + self.re * self.v1) / square;
        Self::new(value, first, turned - 2.0 * first * grown)
    }
}

/// Numbers that change at these rates.
pub fn moving<const D: usize>(x: &[[f64; D]; 2], rate: &[[f64; D]; 2]) -> [[Jet; D]; 2] {
    let at = |p: usize, d: usize| Jet::new(x[p][d], rate[p][d], 0.0);
    [0, 1].map(|p| std::array::from_fn(|d| at(p, d)))
}

/// The value (`order` 0) or a derivative of a number.
pub fn part(of: Jet, order: usize) -> f64 {
    [of.re, of.v1, of.v2][order]
}

/// Sets the value or a derivative.
pub fn set_part(of: &mut Jet, order: usize, to: f64) {
    match order {
        0 => of.re = to,
        1 => of.v1 = to,
        _ => of.v2 = to,
    }
}
