//! Velocity Verlet: symplectic, order 2, one evaluation a step, stable for undamped oscillations up to
//! `h w = 2`. Forces that read rates take them from the start of the step.
//!
//! Source: L. Verlet, Phys. Rev. 159 (1967); W. C. Swope et al., J. Chem. Phys. 76 (1982) 637, Eqs. 2-3;
//! E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed., section I.1.4.

use flexbody::integrators::{Attempt, OneStepMethod, StateView, Tolerance, rescaled};
use flexbody::system::Dynamics;

/// Scratch of the method.
pub struct Verlet {
    a: Vec<f64>,
    end: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
}

impl Verlet {
    /// For `n` coordinates.
    pub fn new(n: usize) -> Self {
        let zero = vec![0.0; n];
        Self {
            a: zero.clone(),
            end: zero.clone(),
            q: zero.clone(),
            v: zero,
        }
    }
}

impl OneStepMethod for Verlet {
    fn name(&self) -> &'static str {
        "verlet"
    }

    fn longest_step(&self) -> f64 {
        f64::INFINITY
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
        for i in 0..q.len() {
            let half = v[i] + 0.5 * h * self.a[i];
            self.q[i] = q[i] + h * half;
            self.v[i] = half + 0.5 * h * self.a[i];
        }
        dynamics.acceleration(time + h, &self.q, &self.v, &mut self.end);
        let mut change = 0.0;
        for i in 0..q.len() {
            let d = self.end[i] - self.a[i];
            self.v[i] += 0.5 * h * d;
            change += d * d;
        }
        // Positions lack h^3 a' / 6.
        let error = h * h / 6.0 * change.sqrt() / (tolerance.position * tolerance.relative);
        Attempt::Done(rescaled(error, 3.0))
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v);
        std::mem::swap(&mut self.a, &mut self.end);
    }

    fn acceleration(&self) -> &[f64] {
        &self.a
    }
}
