//! Rods in space as they are in the product, less one term each, and by interpolated directors: where leaving it out shows
//! (`studies failures`). Everything is an energy of complex numbers; forces are its exact derivatives.
//!
//! Source: W. Squire, G. Trapp, Using complex variables to estimate derivatives of real functions, SIAM Rev. 40 (1998).

mod directors;
mod hermite;
mod spin;
mod statics;
#[cfg(test)]
mod tests;

use nalgebra::{Complex, Vector3};

pub use directors::Directors;
pub use hermite::{ALL, Kept, Rod, Section, torque_at};
pub use spin::Thrown;
pub use statics::equilibrium;

/// A vector of space.
pub type Real3 = Vector3<f64>;

/// A number with its derivative.
type Number = Complex<f64>;

/// A vector of space with its derivative.
type Vector = Vector3<Number>;

/// What derivatives are carried at: squares of it vanish.
const STEP: f64 = 1e-40;

fn number(value: f64) -> Number {
    Number::new(value, 0.0)
}

fn lift(v: Real3) -> Vector {
    v.map(number)
}

fn real(v: &Vector) -> Real3 {
    v.map(|part| part.re)
}

/// Of every row of three.
fn vector(step: &[Number], first: usize) -> Vector {
    Vector::new(step[first], step[first + 1], step[first + 2])
}

fn unit(v: &Vector) -> Vector {
    v / v.dot(v).sqrt()
}

/// What the smallest rotation from the unit vector `a` to `b` makes of `v`, which is across `a`.
fn carry(a: &Vector, b: &Vector, v: &Vector) -> Vector {
    v - (a + b) * (b.dot(v) / (number(1.0) + a.dot(b)))
}

/// Angle of a plane vector from the first axis.
fn angle([x, y]: [Number; 2]) -> Number {
    let square = x.re * x.re + y.re * y.re;
    Number::new(y.re.atan2(x.re), (x.re * y.im - y.re * x.im) / square)
}

/// Derivatives of an energy at a step.
fn gradient<const N: usize>(at: &[f64; N], energy: impl Fn(&[Number; N]) -> Number) -> [f64; N] {
    let mut step = at.map(number);
    std::array::from_fn(|k| {
        step[k].im = STEP;
        let value = energy(&step);
        step[k].im = 0.0;
        value.im / STEP
    })
}
