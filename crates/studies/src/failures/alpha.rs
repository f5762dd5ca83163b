//! Generalized-alpha and the trapezoidal rule with Newton's method to the end, its tangent by differences:
//! what fails here is the method, not its iteration.
//!
//! Source: J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371-375, Eqs. 17 and 25; forces averaged over the
//! ends of the step: M. Arnold, O. Bruls, Multibody Syst. Dyn. 18 (2007) 185-202, Eq. 2.

use flexbody::integrators::{Attempt, OneStepMethod, StateView, Tolerance};
use flexbody::system::Dynamics;

use super::support::newton;

/// The method and its scratch.
pub struct Alpha {
    inertia: f64,
    force: f64,
    beta: f64,
    gamma: f64,
    size: f64,
    /// Acceleration that the recursion carries, and what forces give at the start of the step.
    a: Vec<f64>,
    given: Vec<f64>,
    next: [Vec<f64>; 4],
}

impl Alpha {
    /// By the spectral radius at infinite frequency, for a system of this size (m sqrt(kg)).
    pub fn new(radius: f64, size: f64) -> Self {
        let inertia = (2.0 * radius - 1.0) / (radius + 1.0);
        let force = radius / (radius + 1.0);
        Self {
            inertia,
            force,
            beta: 0.25 * (1.0 - inertia + force).powi(2),
            gamma: 0.5 - inertia + force,
            size,
            a: Vec::new(),
            given: Vec::new(),
            next: std::array::from_fn(|_| Vec::new()),
        }
    }

    /// Newmark's beta 1/4, gamma 1/2.
    pub fn trapezoidal(size: f64) -> Self {
        Self {
            inertia: 0.0,
            force: 0.0,
            beta: 0.25,
            gamma: 0.5,
            ..Self::new(1.0, size)
        }
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
        self.a.resize(q.len(), 0.0);
        dynamics.acceleration(time, q, v, &mut self.a);
        self.given.clone_from(&self.a);
    }

    fn refresh(&mut self, _: &mut dyn Dynamics, _: f64, _: &[f64], _: &[f64]) {}

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        _: &Tolerance,
    ) -> Attempt {
        let StateView {
            time,
            coordinates: q,
            rates: v,
        } = state;
        let n = q.len();
        let (beta, gamma, a) = (self.beta, self.gamma, &self.a);
        let (m, f) = (self.inertia, self.force);
        // End of the step from its position.
        let end = |i: usize, x: f64| {
            let new = (x - q[i] - h * v[i]) / (beta * h * h) - (0.5 - beta) / beta * a[i];
            (new, v[i] + h * ((1.0 - gamma) * a[i] + gamma * new))
        };
        let mut x: Vec<f64> = (0..n)
            .map(|i| q[i] + h * v[i] + 0.5 * h * h * a[i])
            .collect();
        let (given, mut rates) = (&self.given, vec![0.0; n]);
        let solved = newton(&mut x, self.size, 30, |x, r| {
            for i in 0..n {
                rates[i] = end(i, x[i]).1;
            }
            dynamics.acceleration(time + h, x, &rates, r);
            for i in 0..n {
                r[i] = (1.0 - f) * r[i] + f * given[i] - (1.0 - m) * end(i, x[i]).0 - m * a[i];
            }
        });
        if solved.is_err() {
            return Attempt::Failed(0.5);
        }
        let (new, rates): (Vec<f64>, Vec<f64>) = (0..n).map(|i| end(i, x[i])).unzip();
        let mut given = vec![0.0; n];
        dynamics.acceleration(time + h, &x, &rates, &mut given);
        self.next = [x, rates, new, given];
        Attempt::Done(1.0)
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(&self.next[0]);
        v.copy_from_slice(&self.next[1]);
        self.a.copy_from_slice(&self.next[2]);
        self.given.copy_from_slice(&self.next[3]);
    }

    fn acceleration(&self) -> &[f64] {
        &self.a
    }
}
