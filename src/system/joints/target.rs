//! What rows of `Phi` equal.

use crate::math::jet::Number;

/// Right-hand side of a linear row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A fixed number.
    Fixed(f64),
    /// A driven coordinate plus a number.
    Value(usize, f64),
    /// Cosine of a driven angle.
    Cosine(usize),
    /// Sine of a driven angle.
    Sine(usize),
}

impl Target {
    /// Whether it changes in time.
    pub fn is_driven(&self) -> bool {
        !matches!(self, Self::Fixed(_))
    }

    /// Value and first two derivatives from those of the driven coordinates.
    pub fn derivatives<N: Number>(&self, drives: &[[N; 3]]) -> [N; 3] {
        match *self {
            Self::Fixed(value) => [N::of(value), N::of(0.0), N::of(0.0)],
            Self::Value(index, offset) => {
                let [p, v, a] = drives[index];
                [p + N::of(offset), v, a]
            }
            Self::Cosine(index) => {
                let [p, v, a] = drives[index];
                let (sin, cos) = p.sin_cos();
                [cos, -sin * v, -cos * v * v - sin * a]
            }
            Self::Sine(index) => {
                let [p, v, a] = drives[index];
                let (sin, cos) = p.sin_cos();
                [sin, cos * v, cos * a - sin * v * v]
            }
        }
    }
}
