//! Explicit Runge-Kutta methods for accelerations that read rates. The last stage is the end of the step and the first of the
//! next, so that a step costs one evaluation less than it has stages.
//!
//! Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed.,
//! section II.1 (the classical method); the embedded weights 1/6, 1/3, 1/3, 0, 1/6 meet the conditions of order
//! 3 (their Table II.2.1).

use super::selection::cheaper_of_pair;
use super::{Attempt, ErrorEstimate, OneStepMethod, StateView, Tolerance, rescaled};
use crate::math::sums::combine;
use crate::system::{DenseStep, Dynamics};

/// Part of the stability limit that is used: the bound on the frequency is that of the reference
/// configuration.
const MARGIN: f64 = 0.9;

/// Stages and their weights.
pub type Weights = &'static [(usize, f64)];

/// Coefficients of a method.
#[derive(Debug, PartialEq)]
pub struct Coefficients {
    /// Name of the method.
    pub name: &'static str,
    /// Stability limits: longest step times frequency of an undamped oscillation, and times rate of a decay.
    pub limits: [f64; 2],
    /// Times of the stages.
    pub c: &'static [f64],
    /// Weights in the stages; the last is the end of the step.
    pub a: &'static [Weights],
    /// Weights in the error estimate: method less embedded method.
    pub error: Weights,
    /// Weights in a second estimate, of lower order, that corrects the first; none for methods of one embedded method.
    pub lower: Weights,
    /// Power of the step in the error estimate.
    pub power: f64,
}

/// The classical method of order 4 with an embedded order 3.
pub static RK4: Coefficients = Coefficients {
    name: "rk4",
    // 2 sqrt(2).
    limits: [2.0 * std::f64::consts::SQRT_2, 2.785],
    c: &[0.0, 0.5, 0.5, 1.0, 1.0],
    a: &[
        &[],
        &[(0, 0.5)],
        &[(1, 0.5)],
        &[(2, 1.0)],
        &[
            (0, 1.0 / 6.0),
            (1, 1.0 / 3.0),
            (2, 1.0 / 3.0),
            (3, 1.0 / 6.0),
        ],
    ],
    error: &[(3, 1.0 / 6.0), (4, -1.0 / 6.0)],
    lower: &[],
    power: 4.0,
};

/// How many times longer the second of two methods steps than the first where errors set their steps, at a relative tolerance
/// of 1; it grows as the tolerance shrinks by what their powers differ by: 2.2 times at 1e-4, 3.9 at 1e-6 and 7 at 1e-8 with
/// [`RK4`] and `DOPRI853`.
const LONGER: f64 = 0.7;

/// Stability bounds of steps, and the cost of the projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Fastest oscillation, rad/s.
    pub frequency: f64,
    /// Fastest decay, 1/s.
    pub decay: f64,
    /// Cost of the projection at the end of a step, in accelerations.
    pub projection: f64,
}

/// An explicit Runge-Kutta method, or two of which the cheaper goes on, with their scratch.
#[derive(Clone, Debug)]
pub struct RungeKutta {
    methods: [&'static Coefficients; 2],
    /// Index of the one in use.
    variant: usize,
    bounds: Bounds,
    /// How many times longer the second steps than the first.
    longer: f64,
    /// Rates and accelerations of the stages.
    v: Vec<Vec<f64>>,
    a: Vec<Vec<f64>>,
    /// Power at the stages, W; work over the step, J.
    power: Vec<[f64; 2]>,
    work: [f64; 2],
    q: Vec<f64>,
    /// Errors of position and velocity, of both estimates.
    error: [Vec<f64>; 2],
    lower: [Vec<f64>; 2],
}

impl RungeKutta {
    /// For `n` coordinates whose fastest oscillation is `frequency` (rad/s) and fastest decay `decay` (1/s).
    pub fn new(method: &'static Coefficients, n: usize, frequency: f64, decay: f64) -> Self {
        let bounds = Bounds {
            frequency,
            decay,
            projection: 0.0,
        };
        Self::pair([method; 2], n, bounds, 1.0)
    }

    /// Builds a pair of methods of which the cheaper one at a relative tolerance is used. It begins with the first,
    /// whose order is lower.
    pub fn pair(
        methods: [&'static Coefficients; 2],
        n: usize,
        bounds: Bounds,
        relative: f64,
    ) -> Self {
        let zero = vec![0.0; n];
        let stages = methods.map(|method| method.c.len());
        let most = stages[0].max(stages[1]);
        let [low, high] = methods.map(|method| method.power);
        Self {
            methods,
            variant: 0,
            bounds,
            longer: LONGER * relative.powf(1.0 / high - 1.0 / low),
            v: vec![zero.clone(); most],
            a: vec![zero.clone(); most],
            power: vec![[0.0; 2]; most],
            work: [0.0; 2],
            q: zero.clone(),
            error: [zero.clone(), zero.clone()],
            lower: [zero.clone(), zero],
        }
    }

    fn method(&self) -> &'static Coefficients {
        self.methods[self.variant]
    }

    fn longest(&self, variant: usize) -> f64 {
        let [oscillation, decay] = self.methods[variant].limits;
        MARGIN * (oscillation / self.bounds.frequency).min(decay / self.bounds.decay)
    }

    /// Accelerations that the steps to an end take that is `remaining` (s) away, where errors allow steps of `h` (s).
    fn price(&self, variant: usize, h: f64, remaining: f64) -> f64 {
        let each = (self.methods[variant].c.len() - 1) as f64 + self.bounds.projection;
        (remaining / h.min(self.longest(variant))).ceil() * each
    }

    /// The error of a step of `h` (s) in units of the tolerance; what is left in `error` is that of the state.
    fn estimate(&mut self, h: f64, tolerance: &Tolerance) -> f64 {
        let method = self.method();
        let stages = [&self.v, &self.a];
        for (out, stages) in self.error.iter_mut().zip(stages) {
            combine(out, scaled(h, method.error, stages));
        }
        let norm = tolerance.error_norm(&self.error[0], &self.error[1]);
        if method.lower.is_empty() || norm == 0.0 {
            return norm;
        }
        for (out, stages) in self.lower.iter_mut().zip(stages) {
            combine(out, scaled(h, method.lower, stages));
        }
        let lower = tolerance.error_norm(&self.lower[0], &self.lower[1]);
        let part = norm / norm.hypot(0.1 * lower);
        let errors = self.error.iter_mut().flatten();
        errors.for_each(|error| *error *= part);
        norm * part
    }
}

/// The vectors of stages with their weights times the step (s).
fn scaled(h: f64, weights: Weights, stages: &[Vec<f64>]) -> impl Iterator<Item = (f64, &[f64])> {
    weights
        .iter()
        .map(move |(stage, weight)| (h * weight, &stages[*stage][..]))
}

impl OneStepMethod for RungeKutta {
    fn name(&self) -> &'static str {
        self.method().name
    }

    fn longest_step(&self) -> f64 {
        self.longest(self.variant)
    }

    fn fewest_operations(&self) -> f64 {
        (self.method().c.len() - 1) as f64
    }

    fn use_variant(&mut self, variant: usize) {
        self.variant = variant;
    }

    fn cheaper(&self, h: f64, remaining: f64) -> Option<(usize, f64)> {
        cheaper_of_pair(self.variant, h, self.longer, |variant, h| {
            self.price(variant, h, remaining)
        })
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a[0]);
        self.power[0] = dynamics.power();
    }

    fn error(
        &mut self,
        _: &mut dyn Dynamics,
        _: StateView<'_>,
        _: Option<&DenseStep>,
        error: ErrorEstimate<'_>,
    ) {
        error.position.copy_from_slice(&self.error[0]);
        error.velocity.copy_from_slice(&self.error[1]);
    }

    fn work(&self) -> [f64; 2] {
        self.work
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
        let method = self.method();
        self.v[0].copy_from_slice(v);
        for (stage, weights) in method.a.iter().enumerate().skip(1) {
            let [start_q, start_v] = [q, v].map(|start| std::iter::once((1.0, start)));
            combine(&mut self.q, start_q.chain(scaled(h, weights, &self.v)));
            let rates = &mut self.v[stage];
            combine(rates, start_v.chain(scaled(h, weights, &self.a)));
            let at = time + method.c[stage] * h;
            dynamics.acceleration(at, &self.q, rates, &mut self.a[stage]);
            self.power[stage] = dynamics.power();
        }
        let end = method.a[method.a.len() - 1];
        self.work = [0, 1].map(|kind| {
            let parts = end
                .iter()
                .map(|(stage, weight)| weight * self.power[*stage][kind]);
            h * parts.sum::<f64>()
        });
        let error = self.estimate(h, tolerance) * dynamics.steps_in(tolerance.time, h);
        Attempt::Done(rescaled(error, method.power))
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        let last = self.method().c.len() - 1;
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v[last]);
        self.a.swap(0, last);
        self.power[0] = self.power[last];
    }

    fn acceleration(&self) -> &[f64] {
        &self.a[0]
    }
}
