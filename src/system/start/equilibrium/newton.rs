//! Newton's method for an equilibrium, with a tangent that is shifted by a multiple of the mass
//! (Levenberg-Marquardt in the mass norm), so that it looks for a minimum of the potential.

use super::unsymmetric;
use super::{Failure, FoundEquilibrium};
use crate::math::space::Vector;
use crate::math::vector::{dot, norm};
use crate::system::{DrivenSystem, Dynamics, State, StepOutcome};

/// Iterations for one system, and where time is what regularizes.
const ITERATIONS: usize = 100;
const TRANSIENT: usize = 500;
/// Iterations for loads that are not conservative, on the path between equilibria while smaller steps are left to try.
/// For a beam wound to ten turns by an end moment, steps that succeed take 11 to 22. Longer ones succeed seldom, and
/// half of such a step takes 11.
const HASTY: usize = 30;
const HASTY_TRANSIENT: usize = 60;
/// Shifts that are tried in one iteration, each three times the one before.
pub(super) const SHIFTS: usize = 60;
/// Unstable equilibria that are left before the last one is answered.
pub(super) const ESCAPES: usize = 8;
/// Largest rotation of a slope in one iteration, rad.
pub(super) const LARGEST_ROTATION: f64 = 0.5;
/// Rotation, or displacement relative to the size, with which an unstable equilibrium is left.
const AWAY: f64 = 0.05;
/// Way along the lowest mode, relative to the size, that forces have to ask for to show a side.
const EVEN: f64 = 1e-6;
/// Eigenvalue, relative to the largest, that roundoff hides.
const HIDDEN: f64 = 1e-15;
/// Smallest shift, relative to the root of the largest eigenvalue: its square is at the edge of roundoff.
pub(super) const EDGE: f64 = 1e-8;
/// Stiffness against what constraints do not allow, relative to the largest eigenvalue: roundoff of either does not reach the lowest ones.
const HELD: f64 = 1e-6;
/// Steps of the power iteration for the largest and of the inverse iteration for the lowest mode.
const POWERS: usize = 20;
/// Correction, relative to the size of the system, below which Newton converges quadratically.
const CLOSE: f64 = 1e-7;
/// Correction at which it cannot get better.
const EXACT: f64 = 1e-14;
/// Change of the potential, relative to its terms, that roundoff hides.
pub(super) const NOISE: f64 = 1e-10;

/// Acceptance test of the steps of a Newton iteration.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum AcceptanceTest {
    /// No slope rotates too far: fast, and right for most loads.
    Turns,
    /// The potential decreases as well: slow in the narrow valleys of stiff bodies, but it gets there
    /// from configurations without stiffness, such as a slack cable.
    Potential,
    /// For loads without a potential: steps of an implicit Euler method for a motion without inertia, which
    /// become longer as the forces fall (pseudo-transient continuation; C. T. Kelley, D. E. Keyes, SIAM J. Numer.
    /// Anal. 35 (1998)).
    Transient,
}

/// An iteration on one system.
pub(super) struct Newton<'a, 'b, const D: usize> {
    pub(super) model: &'a mut DrivenSystem<'b, D>,
    /// Smallest shift.
    pub(super) least: f64,
    /// Stiffness against what constraints do not allow, 1/s^2.
    held: f64,
    /// Shift that is kept to the end, where a direction in which nothing acts is free; else 0.
    kept: f64,
    pub(super) is_conservative: bool,
    pub(super) rest: Vec<f64>,
    pub(super) force: Vec<f64>,
    pub(super) x: Vec<f64>,
    pub(super) trial: Vec<f64>,
    /// The lowest mode.
    mode: Vec<f64>,
    /// Rod and element that a correction would deform too far.
    overbent: Option<(usize, usize)>,
    /// Whether it gives up early, as something else is left to try.
    pub(super) is_hasty: bool,
}

impl<'a, 'b, const D: usize> Newton<'a, 'b, D> {
    pub(super) fn new(model: &'a mut DrivenSystem<'b, D>, least: f64, kept: f64) -> Self {
        let rest = vec![0.0; model.system.coordinates()];
        Self {
            is_conservative: model.system.is_conservative(),
            least: least.max(kept),
            held: HELD * (least / EDGE).powi(2),
            kept,
            force: rest.clone(),
            x: rest.clone(),
            trial: rest.clone(),
            mode: rest.clone(),
            rest,
            model,
            overbent: None,
            is_hasty: false,
        }
    }

    /// Finds an equilibrium where forces balance, and a stable one if possible.
    ///
    /// # Errors
    /// [`Failure`] if the iteration does not converge, forces do not balance, or the work limit is reached.
    pub(super) fn settle(
        &mut self,
        state: &mut State,
        guard: AcceptanceTest,
    ) -> Result<FoundEquilibrium, Failure> {
        let failure = |this: &Self, correction: f64| match (this.exhausted(), this.overbent) {
            (Some(failure), _) => failure,
            (None, Some((body, element))) => Failure::ElementOverDeformed(body, element),
            (None, None) => Failure::Correction(correction),
        };
        let mut is_stable = false;
        for _ in 0..ESCAPES {
            if let Err(correction) = self.relax(state, guard) {
                return Err(failure(self, correction));
            }
            // What rotates freely is held by its rotation as well, which the potential does not see.
            is_stable = !self.is_conservative || self.kept > 0.0 || !self.leave(state);
            if is_stable {
                break;
            }
        }
        if !is_stable && let Err(correction) = self.relax(state, guard) {
            return Err(failure(self, correction));
        }
        match self.rest(state) {
            Some(rest) => Err(Failure::Rest(rest)),
            None => Ok(FoundEquilibrium { is_stable }),
        }
    }

    /// Returns [`Failure::Work`] if the work limit is reached.
    pub(super) fn exhausted(&self) -> Option<Failure> {
        (self.model.is_exhausted()).then_some(Failure::Work)
    }

    /// Iterates to an equilibrium.
    ///
    /// # Errors
    /// The last correction if the iteration does not converge.
    pub(super) fn relax(&mut self, state: &mut State, guard: AcceptanceTest) -> Result<(), f64> {
        let (time, size) = (state.time, self.model.system.scale());
        let is_transient = guard == AcceptanceTest::Transient;
        let (mut shift, mut before, mut correction) = (self.kept, f64::INFINITY, f64::INFINITY);
        let (mut strength, mut is_nudged, mut is_refused) = (0.0, false, false);
        for iteration in 0..self.most_iterations(guard) {
            self.model.renew_beyond(state, 0.0);
            (self.model).acceleration(time, &state.coordinates, &self.rest, &mut self.force);
            if self.force.iter().all(|f| *f == 0.0) {
                return Ok(());
            }
            if is_transient {
                let now = norm(&self.force);
                shift *= match iteration {
                    0 => 0.0,
                    _ => (now / strength).sqrt().clamp(0.1, 2.0),
                };
                if iteration == 0 {
                    shift = (now / (0.1 * size)).sqrt().max(self.least);
                }
                strength = now;
            }
            self.model.predict_stress(iteration > 0);
            self.linearize(state);
            self.model.predict_stress(false);
            self.model.remember_configuration();
            if !self.correct(&mut shift) {
                return Err(correction);
            }
            if shift > 0.0 && self.kept == 0.0 && self.is_conservative && !is_nudged {
                is_nudged = true;
                if self.leave_saddle(state) {
                    continue;
                }
            }
            correction = norm(&self.x) / size;
            if !correction.is_finite() {
                return Err(correction);
            }
            // A shift that is kept makes the end linear.
            let (is_last, part) = if self.kept > 0.0 {
                (true, 0.9)
            } else {
                (shift == 0.0, 0.1)
            };
            if is_last && correction < CLOSE {
                if !self.correct_whole(state) {
                    return Err(correction);
                }
                if correction < EXACT || correction > part * before {
                    return Ok(());
                }
                before = correction;
                continue;
            }
            before = f64::INFINITY;
            if correction < EXACT {
                // A shift that grows where no way is open makes any correction small.
                return if is_refused { Err(correction) } else { Ok(()) };
            }
            let is_better = self.is_better(state, guard);
            let accepted = is_better && self.accept(state);
            is_refused = is_better && !accepted;
            shift = match (accepted, is_transient) {
                (true, true) if correction < CLOSE => 0.0,
                (true, true) => shift,
                (true, false) if shift > self.least => shift / 5.0,
                (true, false) => self.kept,
                (false, _) => (5.0 * shift).max(self.least),
            };
        }
        Err(correction)
    }

    /// Makes the tangent, with stiffness against what constraints do not allow. Bodies that constraints alone hold have none of their own: their
    /// pivots would be shifts at the edge of roundoff, and corrections off by 1e-9 of the size.
    fn linearize(&mut self, state: &State) {
        (self.model).linearize(state.time, &state.coordinates, &self.rest);
        self.model.hold(self.held);
    }

    fn most_iterations(&self, guard: AcceptanceTest) -> usize {
        let is_hasty = self.is_hasty && !self.is_conservative;
        match (guard == AcceptanceTest::Transient, is_hasty) {
            (false, false) => ITERATIONS,
            (true, false) => TRANSIENT,
            (false, true) => HASTY,
            (true, true) => HASTY_TRANSIENT,
        }
    }

    /// Solves for the correction, with the smallest shift from `shift` on that lets it descend; false where no
    /// shift does, or all work is done.
    fn correct(&mut self, shift: &mut f64) -> bool {
        self.x.copy_from_slice(&self.force);
        if self.model.is_exhausted() {
            return false;
        }
        if !self.is_conservative {
            return unsymmetric::solve(self.model, *shift, self.least, &mut self.x);
        }
        for _ in 0..SHIFTS {
            if self.model.factor([*shift * *shift, *shift]) {
                self.model.solve_small(&mut self.x);
                return true;
            }
            *shift = (3.0 * *shift).max(self.least);
        }
        false
    }

    /// Puts as much of the correction as rotates no slope too far into `trial`; whether that is a better place.
    fn is_better(&mut self, state: &State, guard: AcceptanceTest) -> bool {
        let q = &state.coordinates;
        let fraction = self.step_fraction(q);
        if guard != AcceptanceTest::Potential {
            return true;
        }
        let predicted = fraction * dot(&self.force, &self.x);
        let (change, size) = self.model.potential_difference(q, &self.trial);
        change <= -1e-4 * predicted || predicted <= NOISE * size
    }

    /// Goes the whole correction; false, and back where it was, where constraints cannot be kept there.
    fn correct_whole(&mut self, state: &mut State) -> bool {
        self.trial.clone_from(&state.coordinates);
        (self.trial.iter_mut().zip(&self.x)).for_each(|(q, x)| *q += x);
        self.accept(state)
    }

    /// Goes to `trial`; false, and back where it was, where constraints cannot be kept there.
    fn accept(&mut self, state: &mut State) -> bool {
        let before = state.clone();
        state.coordinates.copy_from_slice(&self.trial);
        let accepted = self.model.accepted(state);
        state.rates.fill(0.0);
        if let StepOutcome::ElementOverDeformed(body, element) = accepted {
            self.overbent = Some((body, element));
        }
        let holds = matches!(accepted, StepOutcome::AsIs | StepOutcome::Moved);
        if !holds {
            state.copy_from(&before);
        }
        holds
    }

    /// Fraction of the step that rotates no slope too far; leaves `q` plus that part in `trial`.
    fn step_fraction(&mut self, q: &[f64]) -> f64 {
        let mut fraction = 1.0;
        // Halved at most to where it moves nothing.
        for _ in 0..50 {
            let pairs = self.trial.iter_mut().zip(q.iter().zip(&self.x));
            pairs.for_each(|(trial, (q, x))| *trial = q + fraction * x);
            if self.model.largest_rotation(q, &self.trial) <= LARGEST_ROTATION {
                break;
            }
            fraction *= 0.5;
        }
        fraction
    }

    /// Leaves an equilibrium that is not stable along its lowest mode, towards where gravity pulls, else up or to
    /// the right; false, and nothing has changed, where it is stable.
    pub(super) fn leave(&mut self, state: &mut State) -> bool {
        // A body that touched nothing where it was drawn had no stiffness there.
        let stiffest = stiffest(self.model, state);
        let before = self.least;
        if stiffest > 0.0 {
            self.least = before.min(EDGE * stiffest.sqrt());
        }
        self.linearize(state);
        let leaves = self.lowest(state).is_some() && self.displace(state);
        self.least = before;
        leaves
    }

    /// Leaves a place that symmetry keeps unstable before roundoff does, to a side that does not depend on it; false
    /// where something points away from it, or nothing is unstable.
    fn leave_saddle(&mut self, state: &mut State) -> bool {
        let (x, size) = (self.x.clone(), self.model.system.scale());
        let lowest = self.lowest(state);
        let is_even = |value: f64, mode: &[f64], force: &[f64]| {
            dot(mode, force).abs() < EVEN * value.abs() * size
        };
        if lowest.is_some_and(|value| is_even(value, &self.mode, &self.force)) {
            return self.displace(state);
        }
        self.x = x;
        false
    }

    /// The lowest mode where the model is linearized, and its eigenvalue if that is negative.
    fn lowest(&mut self, state: &State) -> Option<f64> {
        if self.model.factor([self.least * self.least, self.least]) {
            return None;
        }
        let mut shift = self.least;
        for _ in 0..SHIFTS {
            shift *= 2.0;
            if self.model.factor([shift * shift, shift]) {
                break;
            }
        }
        let largest = (self.least / EDGE).powi(2);
        let mut mode = seed(state.coordinates.len());
        for _ in 0..POWERS {
            self.model.solve_counted(&mut mode);
            let size = norm(&mode);
            if !(size.is_finite() && size > 0.0) {
                return None;
            }
            mode.iter_mut().for_each(|m| *m /= size);
        }
        let mut product = mode.clone();
        self.model.apply_stiffness(&mut product);
        let value = dot(&mode, &product);
        if value >= -HIDDEN * largest {
            return None;
        }
        self.model.from_counted(&mut mode);
        let sign = self.side(state, &mode);
        self.mode = mode;
        self.mode.iter_mut().for_each(|m| *m *= sign);
        Some(value)
    }

    /// 1 where a mode goes to where gravity pulls, else up, else to the right; else -1.
    fn side(&mut self, state: &State, mode: &[f64]) -> f64 {
        let (system, work) = (self.model.system, &mut *self.model.work);
        system.forward_kinematics(state.time, &state.coordinates, None, work);
        system
            .elimination
            .expand(mode, &mut work.scratch.y, &mut work.scratch.other);
        let nodes = || work.scratch.other.iter();
        let size = nodes().flatten().flatten();
        let size = size.map(|m| m.abs()).fold(0.0, f64::max);
        let way: Vector<D> = nodes().map(|m| Vector::from(m[0])).sum();
        let gravity = system.gravity / system.gravity.norm().max(f64::MIN_POSITIVE);
        // Up is the last axis.
        let ways = std::iter::once(gravity.dot(&way)).chain(way.iter().rev().copied());
        let way = ways.into_iter().find(|way| way.abs() > 1e-6 * size);
        way.unwrap_or(1.0).signum()
    }

    /// Moves along the lowest mode as far as rotates a slope, or takes the system, [`AWAY`].
    fn displace(&mut self, state: &mut State) -> bool {
        let (q, size) = (state.coordinates.clone(), self.model.system.scale());
        self.trial.clone_from(&q);
        let probe = 1e-3 * size;
        (self.trial.iter_mut().zip(&self.mode)).for_each(|(q, m)| *q += probe * m);
        let turn = self.model.largest_rotation(&q, &self.trial).max(1e-3);
        let way = probe * AWAY / turn;
        for (trial, (q, m)) in self.trial.iter_mut().zip(q.iter().zip(&self.mode)) {
            *trial = q + way * m;
        }
        self.accept(state)
    }
}

/// Largest eigenvalue of the stiffness by size, nearly, 1/s^2.
pub(super) fn stiffest<const D: usize>(model: &mut DrivenSystem<'_, D>, state: &State) -> f64 {
    let n = state.coordinates.len();
    model.linearize(state.time, &state.coordinates, &vec![0.0; n]);
    let (mut x, mut size) = (seed(n), 0.0);
    for _ in 0..POWERS {
        let before = norm(&x);
        if !(before.is_finite() && before > 0.0) {
            break;
        }
        x.iter_mut().for_each(|x| *x /= before);
        model.apply_stiffness(&mut x);
        size = norm(&x);
    }
    size
}

/// A vector with a part along every mode: always the same numbers.
pub(super) fn seed(n: usize) -> Vec<f64> {
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    };
    (0..n).map(|_| random()).collect()
}
