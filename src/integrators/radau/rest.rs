//! States that are read: what Newton's iteration, the way back to the constraints and the polynomial between stages leave
//! unsolved in stiff directions comes to rest, since forces are read from it.
//!
//! Source: as for the method; a correction is one of Newton's for the acceleration that the polynomial has there.

use super::{A_INVERSE, GAMMA, Kept, Radau, add, dense, mixed, size, sum};
use crate::integrators::{ErrorEstimate, StateView, StateViewMut, Tolerance};
use crate::system::{DenseStep, Dynamics};

/// Part of the acceleration, in tolerances, that may be left unsolved in a state that is read.
const UNSOLVED: f64 = 5.0;
/// Unsolved part of the acceleration, relative to the solved one, that spoils the starting values of the next step.
/// That step begins with nothing but the acceleration. Stiff directions are then thrown far off, and Newton's method
/// fails (a beam that buckles under a crank, 32 elements at 1e-5: 568 iterations, with this alone 390).
const NOISE: f64 = 0.1;
/// Unsolved acceleration, in tolerances, that is nothing: where a scene is at rest, it is roundoff.
const NOTHING: f64 = 1e-4;
/// The part that may be left unsolved in one within a step, between whose stages nothing was solved.
const UNSOLVED_WITHIN: f64 = 0.05;

impl Radau {
    /// As [`OneStepMethod::polish_accelerations`](crate::integrators::OneStepMethod::polish_accelerations).
    pub(super) fn relax_at_end(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateViewMut<'_>,
        tolerance: &Tolerance,
    ) -> bool {
        let StateViewMut {
            time,
            coordinates: q,
            rates: v,
        } = state;
        self.solved_at_end();
        self.leave(dynamics);
        let left = self.unsolved(&self.f[0], tolerance);
        let is_smooth = size(&self.f[0]) <= NOISE * size(&self.stage_v) || left <= NOTHING;
        if left.is_nan() || (left <= UNSOLVED && is_smooth) {
            return false;
        }
        let s = GAMMA / self.attempted;
        dynamics.linearize(time, q, v);
        self.tangent = false;
        self.kept.at = [0.0; 2];
        if !dynamics.factor([s * s, s]) {
            return false;
        }
        dynamics.solve(&mut self.f[0]);
        self.correct(s, q, v);
        dynamics.acceleration(time, q, v, &mut self.a);
        true
    }

    /// As [`OneStepMethod::polish_within`](crate::integrators::OneStepMethod::polish_within).
    pub(super) fn relax_in_between(
        &mut self,
        dynamics: &mut dyn Dynamics,
        step: &DenseStep,
        state: StateViewMut<'_>,
        tolerance: &Tolerance,
    ) -> f64 {
        let StateViewMut {
            time,
            coordinates: q,
            rates: v,
        } = state;
        if !self.factor_at_start(dynamics, step) {
            return f64::NAN;
        }
        dynamics.acceleration(time, q, v, &mut self.a);
        dynamics.set_stage(0);
        self.solved_within(step, time);
        self.leave(dynamics);
        let s = GAMMA / step.length;
        let [left, rest, _] = &mut self.f;
        rest.copy_from_slice(left);
        dynamics.solve_stages(&[1.0], &[1.0], std::slice::from_mut(&mut self.f[0]));
        // Between stages slow directions are not solved either, and are not to be: of an acceleration `f` that leaves
        // `K (s^2 I + K)^-1 f`.
        let [correction, rest, _] = &mut self.f;
        add(rest, &[(-s * s, correction)]);
        let left = self.unsolved(&self.f[1], tolerance) / UNSOLVED_WITHIN;
        if left > 1.0 {
            self.correct(s, q, v);
        }
        left
    }

    /// As [`OneStepMethod::error`](crate::integrators::OneStepMethod::error).
    pub(super) fn error_left(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        within: Option<&DenseStep>,
        error: ErrorEstimate<'_>,
    ) {
        let StateView {
            time,
            coordinates: q,
            rates: v,
        } = state;
        let ErrorEstimate { position, velocity } = error;
        let s = GAMMA / self.attempted;
        self.kept.at = [0.0; 2];
        dynamics.linearize(time, q, v);
        if !dynamics.factor([s * s, s]) {
            position.fill(0.0);
            velocity.fill(0.0);
            return;
        }
        dynamics.acceleration(time, q, v, &mut self.a);
        match within {
            Some(step) => self.solved_within(step, time),
            None => self.solved_at_end(),
        }
        self.leave(dynamics);
        dynamics.solve(&mut self.f[0]);
        // Filtered once more, and once by `follow`: stiff directions follow the others, whatever was started with.
        position.copy_from_slice(&self.error_q);
        velocity.copy_from_slice(&self.error_v);
        for error in [&mut *position, &mut *velocity] {
            dynamics.solve(error);
            error.iter_mut().for_each(|e| *e *= s * s);
        }
        self.correct(s, position, velocity);
    }

    /// As [`OneStepMethod::follow`](crate::integrators::OneStepMethod::follow).
    pub(super) fn follow_error(&mut self, dynamics: &mut dyn Dynamics, state: StateViewMut<'_>) {
        let StateViewMut {
            time,
            coordinates: q,
            rates: v,
        } = state;
        let [change, moved, _] = &mut self.f;
        dynamics.acceleration(time, q, v, moved);
        sum(change, &[(1.0, &moved[..]), (-1.0, &self.a[..])]);
        dynamics.take_out_normal(change);
        dynamics.solve(change);
        self.correct(GAMMA / self.attempted, q, v);
    }

    /// Acceleration of the stage equations' solution at the end of the step, into `stage_v`.
    fn solved_at_end(&mut self) {
        let [_, _, last] = A_INVERSE;
        sum(
            &mut self.stage_v,
            &mixed(&last, 1.0 / self.attempted, &self.zv),
        );
    }

    /// Computes the acceleration at a time within a kept step, into `stage_v`. The polynomial of velocities is not
    /// solved at the start of the step. From the start to the first stage its derivative is blended from the
    /// acceleration at the start. A state close to the start thus approaches the start.
    fn solved_within(&mut self, step: &DenseStep, time: f64) {
        dense::acceleration(step, time, &mut self.stage_v);
        let weight = dense::of_start((time - step.start) / step.length);
        if weight > 0.0 {
            dense::acceleration(step, step.start, &mut self.stage_q);
            let led = [(weight, &self.kept.a[..]), (-weight, &self.stage_q)];
            add(&mut self.stage_v, &led);
        }
    }

    /// Acceleration less that of the stage equations' solution (in `stage_v`), but for what constraints hold, into
    /// `f[0]`: what Newton's iteration, the way back to the constraints and the polynomial between stages left in
    /// stiff directions.
    fn leave(&mut self, dynamics: &mut dyn Dynamics) {
        sum(&mut self.f[0], &[(1.0, &self.a), (-1.0, &self.stage_v)]);
        dynamics.take_out_normal(&mut self.f[0]);
    }

    /// The size of an acceleration that is not solved, in tolerances.
    fn unsolved(&self, acceleration: &[f64], tolerance: &Tolerance) -> f64 {
        let natural = tolerance.position / (tolerance.time * tolerance.time);
        size(acceleration) / (tolerance.relative * (size(&self.stage_v) + natural))
    }

    /// Moves a state by the correction in `f[0]`.
    fn correct(&self, s: f64, q: &mut [f64], v: &mut [f64]) {
        for (i, d) in self.f[0].iter().enumerate() {
            q[i] += d;
            v[i] += s * d;
        }
    }

    /// Makes the real factors where a step began, unless they are.
    fn factor_at_start(&mut self, dynamics: &mut dyn Dynamics, step: &DenseStep) -> bool {
        let [q, v, ..] = step.parts();
        let Kept {
            at,
            q: kept_q,
            v: kept_v,
            a: kept_a,
        } = &mut self.kept;
        if *at == [step.start, step.length] && kept_q == q && kept_v == v {
            return true;
        }
        dynamics.acceleration(step.start, q, v, kept_a);
        let s = GAMMA / step.length;
        dynamics.linearize(step.start, q, v);
        let is_made = dynamics.factor([s * s, s]);
        kept_q.copy_from_slice(q);
        kept_v.copy_from_slice(v);
        *at = [step.start, if is_made { step.length } else { 0.0 }];
        is_made
    }
}
