//! Dense output of collocation methods: a step that leads beyond a communication point is read in between, and goes on
//! after it, where nothing has changed.
//!
//! Positions and velocities are the polynomials through the start of the step and its stages; what drives the system is the
//! same all the way. Between stages the polynomial leaves the equilibrium of stiff directions, so that they are let come
//! to rest there ([`OneStepMethod::polish_within`]), as at the end of a step that is read.
//!
//! Source: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., section IV.8 (the collocation
//! polynomial of Radau IIA as dense output).

use super::controller::Trial;
use super::{
    AlternativeMethod, Goal, OneStepMethod, RELAXATIONS, StateViewMut, StepError, Tolerance,
    outcome, shortest,
};
use crate::math::radau::{A_INVERSE, C};
use crate::math::sums::{Term, sum};
use crate::system::{DenseStep, Dynamics, State};

/// Stages of a step.
const STAGES: usize = DenseStep::STAGES;
/// A step leads beyond a communication point if it is as many times longer than the way there.
const LONGER: f64 = 4.0;
/// Communication points in a row at which inputs stayed as they were, before steps lead beyond the next.
const HELD: f64 = 2.0;
/// Rate at which what is left unsolved shrinks where it is worth another correction.
const CONVERGING: f64 = 0.5;
/// Communication points without a step that leads beyond one, after one that had to be taken back.
const WITHOUT: f64 = 8.0;
/// Operations at a communication point within a step, about: accelerations, a solve, a projection.
const POINT: f64 = 3.0;

/// The step to try from a state that is to be known at `until` where one of `wanted` (s) would lead well beyond it;
/// nothing where it is to end there, or before.
pub(super) fn trial(
    method: &dyn OneStepMethod,
    dynamics: &dyn Dynamics,
    state: &State,
    until: f64,
    wanted: f64,
) -> Option<Trial> {
    let longer = LONGER * (until - state.time);
    if !method.is_dense() || state.dense.held < HELD || wanted.is_nan() || wanted <= longer {
        return None;
    }
    let end = dynamics.unchanged_until(state.time, state.time + wanted);
    let h = wanted.min(end - state.time);
    (h > longer).then_some(Trial::whole(h))
}

/// The step that a method has attempted last is under way: its length `h` (s), the operations that it took, and the
/// steps for which stage equations could be solved (s).
pub(super) fn begin(
    method: &mut dyn OneStepMethod,
    state: &mut State,
    h: f64,
    operations: f64,
    ceiling: f64,
) {
    let step = &mut state.dense;
    (step.start, step.length, step.operations) = (state.time, h, operations);
    (step.under_way, step.ceiling) = (1.0, ceiling);
    step.work = state.work;
    step.part_mut(0).copy_from_slice(&state.coordinates);
    step.part_mut(1).copy_from_slice(&state.rates);
    method.keep(step);
}

/// Advances within the step under way, to the goal or to the end of the step, whichever comes first. A state that cannot
/// keep constraints, or with an element of a rod that is bent or twisted too far, is taken back to the start of the
/// step. Shorter steps follow then.
///
/// # Errors
/// Any other end of the step: a slider that leaves its cable, an empty winch, or a driven coordinate that jumps or has
/// no value.
pub(super) fn follow(
    method: &mut dyn OneStepMethod,
    dynamics: &mut dyn Dynamics,
    state: &mut State,
    goal: Goal<'_>,
) -> Result<(), StepError> {
    let until = goal.until;
    let (end, before) = (state.dense.end(), state.time);
    let near = shortest(until, end);
    let is_over = until >= end - near;
    state.time = if until > end + near { end } else { until };
    place(state);
    state.dense.operations += POINT * goal.pitch.points(state.time - before);
    let is_read = state.time >= until;
    match come_to_rest(method, dynamics, state, is_read, goal.tolerance) {
        Ok(true) => (),
        Ok(false) | Err(StepError::ConstraintsViolated | StepError::ElementOverDeformed(..)) => {
            take_back(state);
            return Ok(());
        }
        Err(stop) => return Err(stop),
    }
    if is_over {
        state.dense.under_way = 0.0;
        let trial = Trial::whole(state.dense.length);
        let operations = state.dense.operations;
        let goes_on = |other: AlternativeMethod| other.takes_over(state, trial, operations, true);
        if goal.alternative.is_some_and(goes_on) {
            state.dense.length = 0.0;
        }
    }
    Ok(())
}

/// Brings a state within its step back to the constraints and, where it is read, lets stiff directions come to rest. Whether
/// they have.
fn come_to_rest(
    method: &mut dyn OneStepMethod,
    dynamics: &mut dyn Dynamics,
    state: &mut State,
    is_read: bool,
    tolerance: &Tolerance,
) -> Result<bool, StepError> {
    outcome(dynamics.accepted(state))?;
    if !is_read {
        return Ok(true);
    }
    let (mut first, mut before) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..RELAXATIONS {
        let read = StateViewMut {
            time: state.time,
            coordinates: &mut state.coordinates,
            rates: &mut state.rates,
        };
        let left = method.polish_within(dynamics, &state.dense, read, tolerance);
        if left.is_nan() || left >= first {
            return Ok(false);
        }
        if left <= 1.0 {
            break;
        }
        outcome(dynamics.accepted(state))?;
        if left > CONVERGING * before {
            break;
        }
        before = left;
        if first.is_infinite() {
            first = left;
        }
    }
    Ok(true)
}

/// Coordinates, rates and work at the time of a state within its step.
fn place(state: &mut State) {
    let State {
        coordinates,
        rates,
        work,
        dense,
        ..
    } = state;
    let [q, v, stages @ ..] = dense.parts();
    let s = (state.time - dense.start) / dense.length;
    let weights = values(s);
    let [a, b, c] = std::array::from_fn(|i| (weights[i], stages[i]));
    sum(coordinates, &[(1.0, q), a, b, c]);
    let [a, b, c] = by_stages(&weights, dense);
    sum(rates, &[(1.0 - weights.iter().sum::<f64>(), v), a, b, c]);
    let weights = integrals(s);
    for (kind, work) in work.iter_mut().enumerate() {
        let powers = dense.powers.iter().zip(weights);
        let done: f64 = powers.map(|(power, weight)| weight * power[kind]).sum();
        *work = dense.work[kind] + dense.length * done;
    }
}

/// Acceleration of the polynomial of velocities at a time within a step.
pub(super) fn acceleration(step: &DenseStep, time: f64, a: &mut [f64]) {
    let weights = slopes((time - step.start) / step.length).map(|slope| slope / step.length);
    let [_, v, ..] = step.parts();
    let [x, y, z] = by_stages(&weights, step);
    sum(a, &[(-weights.iter().sum::<f64>(), v), x, y, z]);
}

/// Part of what the polynomial is off by at its start that it is off by at `s`, up to the first stage: that of the cubic through 1
/// at the start and zero at the stages.
pub(super) fn of_start(s: f64) -> f64 {
    if s < C[0] {
        C.iter().map(|c| 1.0 - s / c).product()
    } else {
        0.0
    }
}

/// A weighted sum of the velocities at the stages, `A^-1 z / h`, by what positions change by to each.
fn by_stages<'a>(weights: &[f64; STAGES], step: &'a DenseStep) -> [Term<'a>; STAGES] {
    let [_, _, stages @ ..] = step.parts();
    std::array::from_fn(|j| {
        let rows = weights.iter().zip(&A_INVERSE);
        let weight: f64 = rows.map(|(weight, row)| weight * row[j]).sum();
        (weight / step.length, stages[j])
    })
}

/// A step is forgotten: the state is that from which it began.
fn take_back(state: &mut State) {
    let [q, v, ..] = state.dense.parts();
    state.coordinates.copy_from_slice(q);
    state.rates.copy_from_slice(v);
    state.time = state.dense.start;
    state.work = state.dense.work;
    state.dense.forget(WITHOUT);
}

/// Weights of the stages in the value at `s` of the polynomial through zero at 0 and the stages at their nodes.
pub(super) fn values(s: f64) -> [f64; STAGES] {
    std::array::from_fn(|i| {
        let others = (0..STAGES).filter(|j| *j != i);
        others.fold(s / C[i], |value, j| value * (s - C[j]) / (C[i] - C[j]))
    })
}

/// Weights of the stages in the derivative at `s` of the polynomial through zero at 0 and the stages at their nodes.
fn slopes(s: f64) -> [f64; STAGES] {
    std::array::from_fn(|i| {
        let [j, k] = others(i);
        let scale = C[i] * (C[i] - C[j]) * (C[i] - C[k]);
        ((s - C[j]) * (s - C[k]) + s * (2.0 * s - C[j] - C[k])) / scale
    })
}

/// Weights of the stages in the integral from 0 to `s` of the polynomial through them.
fn integrals(s: f64) -> [f64; STAGES] {
    std::array::from_fn(|i| {
        let [j, k] = others(i);
        let scale = (C[i] - C[j]) * (C[i] - C[k]);
        s * (s * s / 3.0 - 0.5 * s * (C[j] + C[k]) + C[j] * C[k]) / scale
    })
}

/// The two stages beside one.
fn others(stage: usize) -> [usize; 2] {
    [(stage + 1) % STAGES, (stage + 2) % STAGES]
}
