//! Implicit midpoint rule: symplectic, order 2, one solve an iteration.
//!
//! Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed., Eq. II.1.7.

use flexbody::integrators::{Attempt, OneStepMethod, StateView, Tolerance};
use flexbody::system::Dynamics;

use super::newton::{Equation, Newton, size};

/// Scratch of the method.
pub struct Midpoint {
    newton: Newton,
    /// Acceleration at the last midpoint, for the start of the iteration.
    a: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    per_time: f64,
}

impl Midpoint {
    /// For `n` coordinates.
    pub fn new(n: usize) -> Self {
        let zero = vec![0.0; n];
        Self {
            newton: Newton::new(n, false),
            a: zero.clone(),
            q: zero.clone(),
            v: zero,
            per_time: 0.0,
        }
    }
}

struct Step<'a> {
    time: f64,
    /// Rates at the start.
    start: &'a [f64],
    /// 2 / h.
    per_time: f64,
    q: &'a mut [f64],
    v: &'a mut [f64],
    tolerance: &'a Tolerance,
}

impl Equation for Step<'_> {
    fn residual(&mut self, dynamics: &mut dyn Dynamics, r: &mut [f64]) {
        dynamics.acceleration(self.time, self.q, self.v, r);
        for i in 0..r.len() {
            r[i] -= self.per_time * (self.v[i] - self.start[i]);
        }
    }

    fn correct(&mut self, _: &mut dyn Dynamics, correction: &[f64]) -> f64 {
        for i in 0..correction.len() {
            self.q[i] += correction[i];
            self.v[i] += self.per_time * correction[i];
        }
        2.0 * size(correction, self.per_time, self.tolerance)
    }

    fn linearize(&self, dynamics: &mut dyn Dynamics) {
        dynamics.linearize(self.time, self.q, self.v);
    }
}

impl OneStepMethod for Midpoint {
    fn name(&self) -> &'static str {
        "midpoint"
    }

    fn longest_step(&self) -> f64 {
        f64::INFINITY
    }

    fn begin(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a);
        self.newton.reset();
    }

    fn refresh(&mut self, _: &mut dyn Dynamics, _: f64, _: &[f64], _: &[f64]) {}

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> Attempt {
        let StateView {
            time,
            coordinates: q,
            rates: v,
        } = state;
        self.per_time = 2.0 / h;
        for i in 0..q.len() {
            self.v[i] = v[i] + 0.5 * h * self.a[i];
            self.q[i] = q[i] + 0.5 * h * self.v[i];
        }
        let mut step = Step {
            time: time + 0.5 * h,
            start: v,
            per_time: self.per_time,
            q: &mut self.q,
            v: &mut self.v,
            tolerance,
        };
        match self
            .newton
            .solve(dynamics, &mut step, [self.per_time.powi(2), self.per_time])
        {
            // There is no estimate: fixed steps only.
            Ok(()) => Attempt::Done(1.0),
            Err(factor) => Attempt::Failed(factor),
        }
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        for i in 0..q.len() {
            self.a[i] = self.per_time * (self.v[i] - v[i]);
            q[i] = 2.0 * self.q[i] - q[i];
            v[i] = 2.0 * self.v[i] - v[i];
        }
    }

    fn acceleration(&self) -> &[f64] {
        &self.a
    }

    fn newton_iterations(&self) -> u64 {
        self.newton.iterations
    }
}
