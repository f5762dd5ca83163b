//! Radau IIA of order 5: implicit, L-stable, three stages, simplified Newton iteration with the stage
//! equations transformed into one real and one complex system.
//!
//! For `q'' = a(q, q')` the stage velocities follow linearly from the stage positions, so that only
//! positions are iterated and a solve is one with `s^2 I + s R + K`, `s` the eigenvalues of the
//! inverse Runge-Kutta matrix over the step.
//!
//! Source: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., section IV.8
//! (method, transformation, stopping, error estimate Eqs. 8.19-8.20).

mod rest;
mod start;

use nalgebra::Complex;

use super::{
    Attempt, ErrorEstimate, OneStepMethod, StateView, StateViewMut, Tolerance, dense, size,
};
use crate::math::radau::{A_INVERSE, ALPHA, B, BETA, C, ERROR, GAMMA, INVERSE, T};
use crate::math::sums::{MixStart, Term, add, mix, sum};
use crate::system::{DenseStep, Dynamics};

/// Size of the error that Newton's method leaves, in units of the tolerance.
const NEWTON: f64 = 0.03;
/// Part of it with belt friction, which amplifies what is left: a belt that slips at 1e-4 took 30 times the steps with all of it.
const NEWTON_ON_BELTS: f64 = 0.1;
/// Tolerance beyond which Newton's method leaves no more: what it leaves strains stiff directions, and
/// the steps that follow fail (spin-up beam at 1e-2: 1628 rejected steps for 1441, now 560 for 526).
const LOOSEST: f64 = 1e-4;
/// Growth of the first correction beyond which the iteration diverges.
const DIVERGING: f64 = 2.0;
/// The last stage is the end of the step.
const END: usize = 2;
/// Most Newton iterations.
const ITERATIONS: i32 = 10;
/// Largest rotation of a slope in one step, rad: beyond it Newton may land on a spurious root.
const LARGEST_ROTATION: f64 = 1.5;
/// Rate of convergence below which the tangent is kept for the next step.
const FAST: f64 = 1e-3;

/// Three stage vectors.
type StageVectors = [Vec<f64>; 3];

/// Scratch of the method.
#[derive(Clone, Debug)]
pub struct Radau {
    /// Size of the error that Newton's method leaves, in units of the tolerance.
    newton: f64,
    a: Vec<f64>,
    /// Stage increments of position and velocity.
    zq: StageVectors,
    zv: StageVectors,
    /// Stage accelerations, then Newton corrections.
    f: StageVectors,
    stage_q: Vec<f64>,
    stage_v: Vec<f64>,
    error_q: Vec<f64>,
    error_v: Vec<f64>,
    /// Length of the last accepted step of this communication step, for the starting values.
    last: Option<f64>,
    /// Whether the tangent belongs to the current state or is good enough for it.
    tangent: bool,
    /// Whether the last acceleration was at the current state.
    is_at_state: bool,
    /// Step for which the factors were made.
    factored: f64,
    attempted: f64,
    rate: f64,
    rejected: bool,
    /// Whether stage equations were not solved from a start by the acceleration: the next one leaves out stiff directions.
    is_slow: bool,
    iterations: u64,
    /// Power at the stages, W.
    powers: [[f64; 2]; 3],
    /// Acceleration at the start of the last attempt that succeeded.
    start_a: Vec<f64>,
    kept: Kept,
}

/// The start and the length of the step that the real factors are for, both in s, and the state there; a length of 0 where
/// they are for another.
#[derive(Clone, Debug)]
struct Kept {
    at: [f64; 2],
    q: Vec<f64>,
    v: Vec<f64>,
    /// Acceleration there.
    a: Vec<f64>,
}

impl Radau {
    /// For `n` coordinates.
    pub fn new(n: usize) -> Self {
        let zero = vec![0.0; n];
        let stages = || [zero.clone(), zero.clone(), zero.clone()];
        Self {
            newton: NEWTON,
            a: zero.clone(),
            zq: stages(),
            zv: stages(),
            f: stages(),
            stage_q: zero.clone(),
            stage_v: zero.clone(),
            error_q: zero.clone(),
            error_v: zero.clone(),
            last: None,
            tangent: false,
            is_at_state: false,
            factored: 0.0,
            attempted: 0.0,
            rate: 1.0,
            rejected: false,
            is_slow: false,
            iterations: 0,
            powers: [[0.0; 2]; 3],
            kept: Kept {
                at: [0.0; 2],
                q: zero.clone(),
                v: zero.clone(),
                a: zero.clone(),
            },
            start_a: zero,
        }
    }

    /// The method for systems with belt friction.
    pub fn on_belts(self) -> Self {
        Self {
            newton: NEWTON_ON_BELTS * NEWTON,
            ..self
        }
    }

    /// Velocity increments of the stages from the position increments: `A^-1 z_q / h = v + z_v`.
    fn velocities(&mut self, v: &[f64], h: f64) {
        let (rows, zv) = (by_rate(1.0 / h), slices_mut(&mut self.zv));
        mix(MixStart::Less(v), &rows, slices(&self.zq), zv);
    }

    /// State of a stage.
    fn place(&mut self, stage: usize, q: &[f64], v: &[f64]) {
        sum(&mut self.stage_q, &[(1.0, q), (1.0, &self.zq[stage])]);
        sum(&mut self.stage_v, &[(1.0, v), (1.0, &self.zv[stage])]);
    }

    /// One Newton iteration; returns the size of the correction in units of the tolerance.
    fn iterate(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> f64 {
        let StateView {
            time,
            coordinates: q,
            rates: v,
        } = state;
        for stage in 0..3 {
            self.place(stage, q, v);
            let at = time + C[stage] * h;
            dynamics.acceleration(at, &self.stage_q, &self.stage_v, &mut self.f[stage]);
            dynamics.set_stage(stage);
            if stage != END {
                self.powers[stage] = dynamics.power();
            }
        }
        let (rows, f) = (by_rate(-1.0 / h), slices_mut(&mut self.f));
        mix(MixStart::Own, &rows, slices(&self.zv), f);
        let [forward, back] = [INVERSE.as_flattened(), T.as_flattened()];
        dynamics.solve_stages(forward, back, &mut self.f);
        for (z, x) in self.zq.iter_mut().zip(&self.f) {
            add(z, &[(1.0, x)]);
        }
        self.velocities(v, h);
        self.iterations += 1;
        let (mut positions, mut velocities) = (0.0, 0.0);
        let Self {
            f,
            stage_v: first,
            error_q: second,
            error_v: last,
            ..
        } = self;
        mix(
            MixStart::Zero,
            &by_rate(1.0 / h),
            slices(f),
            [first, second, last],
        );
        for (x, rate) in f.iter().zip([first, second, last]) {
            positions += size(x).powi(2);
            velocities += size(rate).powi(2);
        }
        let size = positions.sqrt() + velocities.sqrt() * tolerance.time;
        size / (tolerance.position * tolerance.relative)
    }

    /// Solves the stage equations. `Err` is the fraction of the step to try instead.
    fn newton(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> Result<(), f64> {
        let asked = self.newton * (LOOSEST / tolerance.relative).min(1.0);
        let goal = asked.max(10.0 * f64::EPSILON / tolerance.relative);
        let (mut before, mut ratio_before, mut theta) = (0.0, 0.0, 0.0_f64);
        for k in 0..ITERATIONS {
            let size = self.iterate(dynamics, state, h, tolerance);
            if !size.is_finite() {
                return Err(0.25);
            }
            let mut factor = 1.0;
            if k > 0 {
                let ratio: f64 = size / before;
                theta = if k == 1 {
                    ratio
                } else {
                    (ratio * ratio_before).sqrt()
                };
                ratio_before = ratio;
                // Stiff directions that rotate apart converge in pairs of iterations: the first ratio says
                // little.
                let early = k == 1;
                if theta >= if early { DIVERGING } else { 0.99 } {
                    return Err(0.5);
                }
                let theta = theta.min(0.99);
                factor = theta / (1.0 - theta);
                let left = f64::from(ITERATIONS - 1 - k);
                let predicted = factor * size * theta.powf(left) / goal;
                if predicted >= 1.0 && !early {
                    let wanted = predicted.clamp(1e-4, 20.0);
                    return Err(0.8 * wanted.powf(-1.0 / (4.0 + left)));
                }
            }
            if factor * size <= goal {
                self.rate = theta;
                return Ok(());
            }
            before = size;
        }
        Err(0.5)
    }

    /// Error estimate of order 3 through the real system, so that stiff modes do not spoil it.
    fn estimate(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> f64 {
        let StateView {
            time,
            coordinates: q,
            rates: v,
        } = state;
        self.stage_v.copy_from_slice(v);
        self.f[0].copy_from_slice(&self.a);
        self.filter(dynamics, h);
        let error = tolerance.error_norm(&self.error_q, &self.error_v);
        let is_doubted = self.rejected || self.last.is_none();
        if error < 1.0 || !error.is_finite() || !is_doubted {
            return error;
        }
        // After a rejection or at the start the estimate is filtered once more. Where nothing is damped, displacements of vibrations
        // count as they were before: the second filter hides what the step loses of them. Their velocities do not count, since those
        // of waves in light bodies are large where displacements are below the tolerance.
        let lost = if dynamics.is_damped() {
            0.0
        } else {
            tolerance.error_norm(&self.error_q, &[])
        };
        for i in 0..q.len() {
            self.stage_q[i] = q[i] + self.error_q[i];
            self.stage_v[i] = v[i] + self.error_v[i];
        }
        dynamics.acceleration(time, &self.stage_q, &self.stage_v, &mut self.f[0]);
        self.filter(dynamics, h);
        let filtered = tolerance.error_norm(&self.error_q, &self.error_v);
        if filtered < lost { lost } else { filtered }
    }

    /// `(g/h - J)^-1 (f + sum_i e_i z_i / h)` with `f` in `stage_v`, `f[0]`.
    fn filter(&mut self, dynamics: &mut dyn Dynamics, h: f64) {
        let gamma = GAMMA / h;
        let [a, b, c] = mixed(&ERROR, 1.0 / h, &self.zq);
        sum(&mut self.error_v, &[(1.0, &self.stage_v), a, b, c]);
        self.error_q.copy_from_slice(&self.error_v);
        dynamics.apply_damping(&mut self.error_q);
        let [a, b, c] = mixed(&ERROR, 1.0 / h, &self.zv);
        let rest = [(1.0, &self.f[0][..]), (gamma, &self.error_v)];
        add(&mut self.error_q, &[a, b, c, rest[0], rest[1]]);
        dynamics.solve(&mut self.error_q);
        for (v, q) in self.error_v.iter_mut().zip(&self.error_q) {
            *v = gamma * q - *v;
        }
    }

    fn factor(&mut self, dynamics: &mut dyn Dynamics, state: StateView<'_>, h: f64) -> bool {
        let StateView {
            time,
            coordinates: q,
            rates: v,
        } = state;
        let is_at_state = std::mem::take(&mut self.is_at_state);
        if !self.tangent {
            if is_at_state {
                dynamics.linearize_last(time, q, v);
            } else {
                dynamics.linearize(time, q, v);
            }
            self.tangent = true;
            self.factored = 0.0;
        }
        if self.factored != h {
            self.factored = 0.0;
            self.kept.at = [0.0; 2];
            let (real, complex) = (GAMMA / h, Complex::new(ALPHA / h, BETA / h));
            if !dynamics.factor([real * real, real])
                || !dynamics.factor_complex([complex * complex, complex])
            {
                return false;
            }
            self.factored = h;
        }
        true
    }
}

impl OneStepMethod for Radau {
    fn name(&self) -> &'static str {
        "radau"
    }

    fn longest_step(&self) -> f64 {
        f64::INFINITY
    }

    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        dynamics.acceleration(time, q, v, &mut self.a);
        self.is_at_state = true;
    }

    fn polish_accelerations(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateViewMut<'_>,
        tolerance: &Tolerance,
    ) -> bool {
        self.relax_at_end(dynamics, state, tolerance)
    }

    fn is_dense(&self) -> bool {
        true
    }

    fn keep(&mut self, step: &mut DenseStep) {
        step.powers = self.powers;
        for (k, stage) in self.zq.iter().enumerate() {
            step.part_mut(2 + k).copy_from_slice(stage);
        }
        // The factors are those of its start: it was the first step from there.
        let [q, v, ..] = step.parts();
        self.kept.q.copy_from_slice(q);
        self.kept.v.copy_from_slice(v);
        self.kept.a.copy_from_slice(&self.start_a);
        self.kept.at = [step.start, step.length];
    }

    fn polish_within(
        &mut self,
        dynamics: &mut dyn Dynamics,
        step: &DenseStep,
        state: StateViewMut<'_>,
        tolerance: &Tolerance,
    ) -> f64 {
        self.relax_in_between(dynamics, step, state, tolerance)
    }

    fn start_from_dense(&mut self, before: &DenseStep) {
        let [_, _, stages @ ..] = before.parts();
        for (z, stage) in self.zq.iter_mut().zip(stages) {
            z.copy_from_slice(stage);
        }
        self.last = Some(before.length);
    }

    fn error(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        within: Option<&DenseStep>,
        error: ErrorEstimate<'_>,
    ) {
        self.error_left(dynamics, state, within, error);
    }

    fn follow(&mut self, dynamics: &mut dyn Dynamics, state: StateViewMut<'_>) {
        self.follow_error(dynamics, state);
    }

    fn work(&self) -> [f64; 2] {
        let part = |k: usize| {
            let powers = self.powers.iter().zip(B);
            self.attempted * powers.map(|(power, weight)| weight * power[k]).sum::<f64>()
        };
        [part(0), part(1)]
    }

    fn begin(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        self.refresh(dynamics, time, q, v);
        self.last = None;
        self.tangent = false;
        self.factored = 0.0;
        self.rejected = false;
        self.is_slow = false;
        self.iterations = 0;
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
        self.attempted = h;
        self.powers = [[0.0; 2]; 3];
        // Of rotations a whole turn more is a solution too.
        let has_rotations = dynamics.has_rotations();
        let fail = |this: &mut Self, factor: f64| {
            // The stages no longer hold the last step's polynomial.
            this.is_slow = this.last.take().is_none() && has_rotations;
            this.rejected = true;
            Attempt::Failed(factor)
        };
        if !self.factor(dynamics, state, h) {
            return fail(self, 0.5);
        }
        self.start(dynamics, v, h);
        if let Err(factor) = self.newton(dynamics, state, h, tolerance) {
            self.tangent = false;
            return fail(self, factor);
        }
        // The last acceleration was that of the last stage.
        self.powers[END] = dynamics.power();
        self.place(END, q, v);
        if dynamics.largest_rotation(q, &self.stage_q) > LARGEST_ROTATION {
            return fail(self, 0.5);
        }
        let error = self.estimate(dynamics, state, h, tolerance);
        if error <= 1.0 {
            if dynamics.dissipates() {
                // Power is quadratic in rates of strain, which the last correction still changed.
                for stage in 0..END {
                    self.place(stage, q, v);
                    let at = time + C[stage] * h;
                    dynamics.acceleration(at, &self.stage_q, &self.stage_v, &mut self.f[stage]);
                    self.powers[stage] = dynamics.power();
                }
            }
            // The next error estimate starts from the acceleration at the end.
            self.start_a.copy_from_slice(&self.a);
            self.place(END, q, v);
            let (q, v) = (&self.stage_q, &self.stage_v);
            self.powers[END] = dynamics.acceleration_at_end(time + h, q, v, &mut self.a);
        } else {
            self.last = None;
            self.rejected = true;
        }
        Attempt::Done(error)
    }

    fn accept(&mut self, q: &mut [f64], v: &mut [f64]) {
        for i in 0..q.len() {
            q[i] += self.zq[2][i];
            v[i] += self.zv[2][i];
        }
        self.last = Some(self.attempted);
        self.tangent = self.rate < FAST;
        self.is_at_state = true;
        self.rejected = false;
        self.is_slow = false;
    }

    fn acceleration(&self) -> &[f64] {
        &self.a
    }

    fn newton_iterations(&self) -> u64 {
        self.iterations
    }
}

/// The inverse Runge-Kutta matrix times a factor.
fn by_rate(factor: f64) -> [[f64; 3]; 3] {
    A_INVERSE.map(|row| row.map(|weight| factor * weight))
}

fn slices(stages: &StageVectors) -> [&[f64]; 3] {
    stages.each_ref().map(|stage| &stage[..])
}

fn slices_mut(stages: &mut StageVectors) -> [&mut [f64]; 3] {
    stages.each_mut().map(|stage| &mut stage[..])
}

/// Vectors of the stages, with the weights of a row times a factor.
fn mixed<'a>(row: &[f64; 3], factor: f64, stages: &'a StageVectors) -> [Term<'a>; 3] {
    std::array::from_fn(|i| (factor * row[i], &stages[i][..]))
}

fn product(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
