//! Numbers that change in time: functions of time, and inputs that the master sets.

use crate::math::function::Function;

/// The size of a load.
#[derive(Clone, Debug)]
pub enum Signal {
    /// A function of time.
    Function(Function),
    /// Input, by its index.
    Input(usize),
}

impl Signal {
    /// Value at a time, s, under held inputs.
    pub fn value(&self, time: f64, inputs: &[f64]) -> f64 {
        match self {
            Self::Function(function) => function.value(time),
            Self::Input(index) => inputs[*index],
        }
    }

    /// Times at which it has a kink or jumps, s.
    pub fn breaks(&self) -> &[f64] {
        match self {
            Self::Function(function) => function.breaks(),
            Self::Input(_) => &[],
        }
    }
}

/// A prescribed coordinate: its value and first two derivatives are needed.
#[derive(Clone, Debug)]
pub enum Drive {
    /// A function of time.
    Function(Function),
    /// Inputs from this index on: the value, then as many derivatives.
    Input {
        /// Index of the input with the value.
        first: usize,
        /// Derivatives that are inputs too: 0, 1 or 2.
        derivatives: usize,
    },
}

/// The smooth way of a prescribed coordinate through one communication step: a polynomial.
///
/// An input is known at the beginning of a step only, and jumps from step to step. The coordinate
/// therefore goes from where it is to where the input says it will be at the end of the step: the
/// value itself, or with derivatives its Taylor polynomial. Velocity is continuous; with the second
/// derivative given, acceleration too.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Course {
    start: f64,
    coefficients: [f64; 6],
}

impl Course {
    /// The Taylor polynomial of value and derivatives at a time.
    pub fn hold(time: f64, [p, v, a]: [f64; 3]) -> Self {
        Self {
            start: time,
            coefficients: [p, v, 0.5 * a, 0.0, 0.0, 0.0],
        }
    }

    /// From value and derivatives at `time` to what `inputs` (value, first, second derivative as far
    /// as given) say about `time + h`.
    pub fn new(time: f64, h: f64, [p, v, a]: [f64; 3], inputs: &[f64]) -> Self {
        let [target, rate, second] = match *inputs {
            [value, first, second, ..] => [
                value + h * (first + 0.5 * h * second),
                first + h * second,
                second,
            ],
            [value, first] => [value + h * first, first, 0.0],
            [value] => [value, (value - p) / h, 0.0],
            [] => [p, 0.0, 0.0],
        };
        let mut c = [p, v, 0.0, 0.0, 0.0, 0.0];
        if inputs.len() < 3 {
            // Hermite cubic.
            let way = (target - p) / h;
            c[2] = (3.0 * way - 2.0 * v - rate) / h;
            c[3] = (v + rate - 2.0 * way) / (h * h);
        } else {
            // Hermite quintic.
            c[2] = 0.5 * a;
            let d0 = target - p - h * (v + 0.5 * h * a);
            let d1 = h * (rate - v - h * a);
            let d2 = h * h * (second - a);
            let h3 = h * h * h;
            c[3] = (10.0 * d0 - 4.0 * d1 + 0.5 * d2) / h3;
            c[4] = (-15.0 * d0 + 7.0 * d1 - d2) / (h3 * h);
            c[5] = (6.0 * d0 - 3.0 * d1 + 0.5 * d2) / (h3 * h * h);
        }
        Self {
            start: time,
            coefficients: c,
        }
    }

    /// Value, first and second derivative.
    pub fn derivatives(&self, time: f64) -> [f64; 3] {
        let t = time - self.start;
        let mut sums = [0.0; 3];
        for (k, c) in self.coefficients.iter().enumerate().rev() {
            let k = k as f64;
            sums[0] = sums[0] * t + c;
            if k >= 1.0 {
                sums[1] = sums[1] * t + k * c;
            }
            if k >= 2.0 {
                sums[2] = sums[2] * t + k * (k - 1.0) * c;
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_meets_both_ends() {
        let (from, h) = ([0.3, -1.0, 2.0], 0.25);
        for inputs in [&[1.5][..], &[1.5, 0.2], &[1.5, 0.2, -3.0]] {
            let course = Course::new(2.0, h, from, inputs);
            let start = course.derivatives(2.0);
            let end = course.derivatives(2.0 + h);
            let [v, a] = [1, 2].map(|i| inputs.get(i).copied().unwrap_or(0.0));
            let target = 1.5 + h * (v + 0.5 * h * a);
            assert!((start[0] - from[0]).abs() + (start[1] - from[1]).abs() < 1e-14);
            assert!((end[0] - target).abs() < 1e-13, "{inputs:?}");
            if inputs.len() > 1 {
                assert!((end[1] - (v + h * a)).abs() < 1e-12);
            }
            if inputs.len() == 3 {
                assert!((start[2] - from[2]).abs() < 1e-12 && (end[2] - a).abs() < 1e-10);
            }
        }
    }

    #[test]
    fn holding_keeps_the_derivatives() {
        let course = Course::hold(1.0, [0.1, 0.2, 0.3]);
        assert_eq!(course.derivatives(1.0), [0.1, 0.2, 0.3]);
    }
}
