//! The classical Runge-Kutta method of order 4 with an embedded order 3 that takes the derivative at
//! the end of the step for its last stage; that derivative is the first of the next step.
//!
//! Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed.,
//! section II.1 (the method); the embedded weights 1/6, 1/3, 1/3, 0, 1/6 meet the conditions of order
//! 3 (their Table II.2.1). Stable for undamped oscillations up to `h w = 2 sqrt(2)`, and for decay up
//! to `h x = 2.785`.

use super::{Attempt, Method, Tolerance};
use crate::math::sums;
use crate::system::{DenseStep, Dynamics};

/// Part of the stability limit that is used: the bound on the frequency is that of the reference
/// configuration.
const MARGIN: f64 = 0.9;

/// Scratch of the method.
#[derive(Clone, Debug)]
pub struct Rk4 {
    longest_step: f64,
    /// Acceleration at the start of the step and at its end.
    a: Vec<f64>,
    end: Vec<f64>,
    stage_q: Vec<f64>,
    stage_v: Vec<f64>,
    stage_a: Vec<f64>,
    sum_q: Vec<f64>,
    sum_v: Vec<f64>,
    /// Power at the start of the step and at its end, W; work over it, J.
    power: [f64; 2],
    end_power: [f64; 2],
    work: [f64; 2],
}

impl Rk4 {
    /// For `n` coordinates whose fastest oscillation is `frequency` (rad/s) and fastest decay `decay`
    /// (1/s).
    pub fn new(n: usize, frequency: f64, decay: f64) -> Self {
        let limit = (8.0_f64.sqrt() / frequency).min(2.785 / decay);
        let zero = vec![0.0; n];
        Self {
            longest_step: MARGIN * limit,
            a: zero.clone(),
            end: zero.clone(),
            stage_q: zero.clone(),
            stage_v: zero.clone(),
            stage_a: zero.clone(),
            sum_q: zero.clone(),
            sum_v: zero,
            power: [0.0; 2],
            end_power: [0.0; 2],
            work: [0.0; 2],
        }
    }

    /// Adds a stage to the sums and moves on to the next one at `step` from the start.
    fn stage(&mut self, q: &[f64], v: &[f64], weight: f64, step: f64) {
        sums::add(&mut self.sum_q, &[(weight, &self.stage_v)]);
        sums::add(&mut self.sum_v, &[(weight, &self.stage_a)]);
        sums::sum(&mut self.stage_q, &[(1.0, q), (step, &self.stage_v)]);
        sums::sum(&mut self.stage_v, &[(1.0, v), (step, &self.stage_a)]);
    }
}

impl Method for Rk4 {
    fn name(&self) -> &'static str {
        "rk4"
    }

    fn longest_step(&self) -> f64 {
        self.longest_step
    }

    fn fewest_operations(&self) -> f64 {
        4.0
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a);
        self.power = dynamics.power();
    }

    fn error(
        &mut self,
        _: &mut dyn Dynamics,
        _: (f64, &[f64], &[f64]),
        _: Option<&DenseStep>,
        [position, velocity]: [&mut [f64]; 2],
    ) {
        position.copy_from_slice(&self.stage_v);
        velocity.copy_from_slice(&self.stage_a);
    }

    fn work(&self) -> [f64; 2] {
        self.work
    }

    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        (time, q, v): (f64, &[f64], &[f64]),
        h: f64,
        tolerance: &Tolerance,
    ) -> Attempt {
        self.sum_q.copy_from_slice(q);
        self.sum_v.copy_from_slice(v);
        self.stage_v.copy_from_slice(v);
        self.stage_a.copy_from_slice(&self.a);
        self.work = [0.0; 2];
        let mut power = self.power;
        for (weight, step) in [(h / 6.0, h / 2.0), (h / 3.0, h / 2.0), (h / 3.0, h)] {
            self.stage(q, v, weight, step);
            let at = time + step;
            add(&mut self.work, weight, power);
            dynamics.acceleration(at, &self.stage_q, &self.stage_v, &mut self.stage_a);
            power = dynamics.power();
        }
        add(&mut self.work, h / 6.0, power);
        sums::add(&mut self.sum_q, &[(h / 6.0, &self.stage_v)]);
        sums::add(&mut self.sum_v, &[(h / 6.0, &self.stage_a)]);
        dynamics.acceleration(time + h, &self.sum_q, &self.sum_v, &mut self.end);
        self.end_power = dynamics.power();
        for (last, end) in [
            (&mut self.stage_v, &self.sum_v),
            (&mut self.stage_a, &self.end),
        ] {
            for (last, end) in last.iter_mut().zip(end) {
                *last = h / 6.0 * (*last - end);
            }
        }
        Attempt::Done(
            tolerance.norm(&self.stage_v, &self.stage_a) * dynamics.steps_in(tolerance.time, h),
        )
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(&self.sum_q);
        v.copy_from_slice(&self.sum_v);
        std::mem::swap(&mut self.a, &mut self.end);
        self.power = self.end_power;
    }

    fn acceleration(&self) -> &[f64] {
        &self.a
    }
}

fn add(sum: &mut [f64; 2], weight: f64, power: [f64; 2]) {
    for (sum, power) in sum.iter_mut().zip(power) {
        *sum += weight * power;
    }
}
