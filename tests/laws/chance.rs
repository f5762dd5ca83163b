//! Numbers by chance that are the same in every run.

use nalgebra::Vector3;

/// How many sequences of numbers a law is tried with.
const SEVERAL: u64 = 5;

/// Numbers in (-1, 1), the same in every run.
pub struct Chance(pub u64);

impl Chance {
    /// One sequence after the other, beginning with that of `first`.
    pub fn several(first: u64) -> impl Iterator<Item = Self> {
        (0..SEVERAL).map(move |k| Self(first + 1000 * k))
    }

    pub fn number(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.number())
    }

    pub fn below(&mut self, count: usize) -> usize {
        ((0.5 + 0.5 * self.number()) * count as f64) as usize % count
    }
}
