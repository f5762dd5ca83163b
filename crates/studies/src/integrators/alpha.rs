//! Generalized-alpha and the trapezoidal rule, order 2, one solve an iteration. What the weights of
//! generalized-alpha average are forces at both ends of the step (for identity inertia the same as the
//! published form), so accelerations belong to the ends and start consistent.
//!
//! Source: J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371-375, Eqs. 17, 18 and 25; the recursion of
//! M. Arnold, O. Bruls, Multibody Syst. Dyn. 18 (2007) 185-202, Eq. 2. The trapezoidal rule is that of
//! N. M. Newmark (1959) with beta 1/4, gamma 1/2.

use flexbody::integrators::{Attempt, OneStepMethod, StateView, Tolerance, rescaled};
use flexbody::system::Dynamics;

use super::newton::{Equation, Newton, size};

/// Weights of a method.
#[derive(Clone, Copy)]
pub struct Weights {
    inertia: f64,
    force: f64,
    beta: f64,
    gamma: f64,
}

/// Newmark's weights for the trapezoidal rule.
pub const TRAPEZOID: Weights = Weights {
    inertia: 0.0,
    force: 0.0,
    beta: 0.25,
    gamma: 0.5,
};

impl Weights {
    /// Generalized-alpha by its spectral radius at infinite frequency.
    pub fn of(radius: f64) -> Self {
        let inertia = (2.0 * radius - 1.0) / (radius + 1.0);
        let force = radius / (radius + 1.0);
        Self {
            inertia,
            force,
            beta: 0.25 * (1.0 - inertia + force).powi(2),
            gamma: 0.5 - inertia + force,
        }
    }

    /// Error of positions over `h^3 q'''`.
    fn error(self) -> f64 {
        (self.beta + 0.5 * (self.inertia - self.force) - 1.0 / 6.0).abs()
    }
}

/// Scratch of the method.
pub struct Alpha {
    weights: Weights,
    /// Whether nothing reads the error.
    fixed: bool,
    newton: Newton,
    /// Accelerations at the start, and those of the recursion at both ends.
    a: Vec<f64>,
    alpha: Vec<f64>,
    next: Vec<f64>,
    /// Terms of the residual that do not change.
    known: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    error: Vec<f64>,
}

impl Alpha {
    /// For `n` coordinates; `turned`: the tangent rotates along with directions.
    pub fn new(weights: Weights, n: usize, fixed: bool, turned: bool) -> Self {
        let zero = vec![0.0; n];
        Self {
            weights,
            fixed,
            newton: Newton::new(n, turned),
            a: zero.clone(),
            alpha: zero.clone(),
            next: zero.clone(),
            known: zero.clone(),
            q: zero.clone(),
            v: zero.clone(),
            error: zero,
        }
    }
}

struct Step<'a> {
    time: f64,
    /// Weight of the new acceleration of the recursion in the residual.
    inertia: f64,
    known: &'a [f64],
    /// Changes of acceleration and rate per change of position.
    acceleration: f64,
    rate: f64,
    q: &'a mut [f64],
    v: &'a mut [f64],
    next: &'a mut [f64],
    tolerance: &'a Tolerance,
}

impl Equation for Step<'_> {
    fn residual(&mut self, dynamics: &mut dyn Dynamics, r: &mut [f64]) {
        dynamics.acceleration(self.time, self.q, self.v, r);
        for i in 0..r.len() {
            r[i] += self.known[i] - self.inertia * self.next[i];
        }
    }

    fn correct(&mut self, _: &mut dyn Dynamics, correction: &[f64]) -> f64 {
        for i in 0..correction.len() {
            self.q[i] += correction[i];
            self.v[i] += self.rate * correction[i];
            self.next[i] += self.acceleration * correction[i];
        }
        size(correction, self.rate, self.tolerance)
    }

    fn linearize(&self, dynamics: &mut dyn Dynamics) {
        dynamics.linearize(self.time, self.q, self.v);
    }
}

impl OneStepMethod for Alpha {
    fn name(&self) -> &'static str {
        "alpha"
    }

    fn longest_step(&self) -> f64 {
        f64::INFINITY
    }

    fn begin(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        self.refresh(dynamics, time, q, v);
        self.alpha.copy_from_slice(&self.a);
        self.newton.reset();
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a);
    }

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
        let w = self.weights;
        let share = 1.0 / (1.0 - w.force);
        for i in 0..q.len() {
            let alpha = self.alpha[i];
            self.q[i] = q[i] + h * (v[i] + 0.5 * h * alpha);
            self.v[i] = v[i] + h * alpha;
            self.next[i] = alpha;
            self.known[i] = share * (w.force * self.a[i] - w.inertia * alpha);
        }
        let inertia = share * (1.0 - w.inertia);
        let mut step = Step {
            time: time + h,
            inertia,
            known: &self.known,
            acceleration: 1.0 / (w.beta * h * h),
            rate: w.gamma / (w.beta * h),
            q: &mut self.q,
            v: &mut self.v,
            next: &mut self.next,
            tolerance,
        };
        let weights = [inertia / (w.beta * h * h), w.gamma / (w.beta * h)];
        if let Err(factor) = self.newton.solve(dynamics, &mut step, weights) {
            return Attempt::Failed(factor);
        }
        if self.fixed {
            return Attempt::Done(1.0);
        }
        for i in 0..q.len() {
            self.error[i] = self.next[i] - self.alpha[i];
        }
        // Through the tangent, so that stiff modes do not spoil it.
        self.newton.solve_last(dynamics, &mut self.error);
        let scale = w.error() * h * h * weights[0];
        self.error.iter_mut().for_each(|e| *e *= scale);
        Attempt::Done(rescaled(tolerance.error_norm(&self.error, &[]), 3.0))
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v);
        let share = 1.0 / (1.0 - self.weights.force);
        let inertia = share * (1.0 - self.weights.inertia);
        for i in 0..q.len() {
            // What the converged residual says, at no cost.
            self.a[i] = inertia * self.next[i] - self.known[i];
        }
        std::mem::swap(&mut self.alpha, &mut self.next);
    }

    fn acceleration(&self) -> &[f64] {
        &self.a
    }

    fn newton_iterations(&self) -> u64 {
        self.newton.iterations
    }
}
