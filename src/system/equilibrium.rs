//! Static equilibrium: a minimum of the potential by Newton's method with a shifted tangent
//! (Levenberg-Marquardt in the mass norm), in load steps where the whole load at once fails.
//!
//! The shift makes it look for a stable equilibrium. An unstable one is found only where symmetry lets
//! no force point away from it, as in a perfectly straight column beyond its buckling load.
//!
//! Source: J. Nocedal, S. J. Wright, Numerical Optimization, 2nd ed., sections 3.4 and 10.3.

use super::frequencies::fastest;
use super::loads::Load;
use super::{Dynamics, Model, Signal, State, System, Work};

/// Iterations for one load step.
const ITERATIONS: usize = 100;
/// Smallest load step.
const SMALLEST: f64 = 1.0 / 256.0;
/// Largest turn of a slope in one load step, where smaller ones are left to try, rad.
const BRANCH: f64 = 1.5;
/// Largest turn of a slope in one iteration, rad.
const LARGEST_TURN: f64 = 0.5;
/// Correction, relative to the size of the system, below which Newton converges quadratically.
const CLOSE: f64 = 1e-7;
/// Correction at which it cannot get better.
const EXACT: f64 = 1e-14;
/// Change of the potential, relative to its terms, that roundoff hides.
const NOISE: f64 = 1e-10;

/// Why no equilibrium was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "no stable static equilibrium found beyond {:.4} of the load: after {ITERATIONS} Newton \
     iterations the correction is {correction:.1e} of the system's size; expected bodies that are \
     held against their loads",
    reached
)]
pub struct NotFound {
    /// Fraction of the load that was reached.
    pub reached: f64,
    /// Last Newton correction relative to the size of the system.
    pub correction: f64,
}

/// Finds the equilibrium under gravity and the inputs, from the configuration of `state`, and counts
/// its angles on the way.
///
/// # Errors
/// When the smallest load step does not converge; `state` is then that of the last one that did.
pub fn find(
    system: &System,
    inputs: &[f64],
    work: &mut Work,
    state: &mut State,
) -> Result<(), NotFound> {
    let (mut reached, mut step) = (0.0, 1.0);
    let shift = 1e-8 * fastest(system, inputs, work, state).0;
    let mut from = state.clone();
    while reached < 1.0 {
        let target = f64::min(1.0, reached + step);
        let scaled = scaled(system, inputs, target);
        let mut model = Model::new(system, &scaled, work, &from);
        model.fraction = target;
        let mut outcome = relax(&mut model, state, shift, Guard::Turns);
        if outcome.is_err() {
            state.copy_from(&from);
            model = Model::new(system, &scaled, model.work, &from);
            model.fraction = target;
            outcome = relax(&mut model, state, shift, Guard::Potential);
        }
        // Far from the last equilibrium there may be another one, with a turn more.
        let turn = model.largest_turn(&from.coordinates, &state.coordinates);
        if turn > BRANCH && step > SMALLEST.sqrt() {
            outcome = Err(0.0);
        }
        match outcome {
            Ok(()) => {
                reached = target;
                step *= 2.0;
                from.copy_from(state);
            }
            Err(correction) => {
                state.copy_from(&from);
                step /= 2.0;
                if step < SMALLEST {
                    return Err(NotFound {
                        reached,
                        correction,
                    });
                }
            }
        }
    }
    Ok(())
}

/// Inputs at a fraction of the load; lengths of springs stay.
fn scaled(system: &System, inputs: &[f64], fraction: f64) -> Vec<f64> {
    let mut scaled: Vec<f64> = inputs.iter().map(|input| fraction * input).collect();
    for load in &system.loads {
        if let Load::Spring(spring) = load
            && let Signal::Input(index) = spring.length
        {
            scaled[index] = inputs[index];
        }
    }
    scaled
}

/// What a Newton iteration must respect.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Guard {
    /// No slope turns too far: fast, and right for most loads.
    Turns,
    /// The potential decreases as well: slow in the narrow valleys of stiff bodies, but it gets there
    /// from configurations without stiffness, such as a slack cable.
    Potential,
}

/// Equilibrium under fixed loads; on failure the last correction.
fn relax(
    model: &mut Model<'_>,
    state: &mut State,
    smallest_shift: f64,
    guard: Guard,
) -> Result<(), f64> {
    let n = state.coordinates.len();
    let rest = vec![0.0; n];
    let (mut force, mut x, mut trial) = (rest.clone(), rest.clone(), rest.clone());
    let (time, size) = (state.time, model.system.scale());
    let (mut shift, mut before) = (0.0_f64, f64::INFINITY);
    let mut correction = f64::INFINITY;
    for _ in 0..ITERATIONS {
        let q = &mut state.coordinates;
        model.acceleration(time, q, &rest, &mut force);
        if force.iter().all(|f| *f == 0.0) {
            return Ok(());
        }
        model.linearize(time, q, &rest);
        while !model.factor(shift) {
            shift = (3.0 * shift).max(smallest_shift);
            if !shift.is_finite() {
                return Err(correction);
            }
        }
        x.copy_from_slice(&force);
        model.solve(&mut x);
        correction = norm(&x) / size;
        if shift == 0.0 && correction < CLOSE {
            q.iter_mut().zip(&x).for_each(|(q, x)| *q += x);
            model.accepted(state);
            state.rates.fill(0.0);
            if correction < EXACT || correction > 0.1 * before {
                return Ok(());
            }
            before = correction;
            continue;
        }
        before = f64::INFINITY;
        if correction < EXACT {
            return Ok(());
        }
        let fraction = step_fraction(model, q, &x, &mut trial);
        let accepted = guard == Guard::Turns || {
            let predicted = fraction * force.iter().zip(&x).map(|(f, x)| f * x).sum::<f64>();
            let (change, size) = model.potential_difference(q, &trial);
            change <= -1e-4 * predicted || predicted <= NOISE * size
        };
        if accepted {
            q.copy_from_slice(&trial);
            model.accepted(state);
            state.rates.fill(0.0);
            shift = if shift > smallest_shift {
                shift / 5.0
            } else {
                0.0
            };
        } else {
            shift = (5.0 * shift).max(smallest_shift);
        }
    }
    Err(correction)
}

/// Fraction of the step that turns no slope too far; leaves `q` plus that part in `trial`.
fn step_fraction(model: &mut Model<'_>, q: &[f64], x: &[f64], trial: &mut [f64]) -> f64 {
    let mut fraction = 1.0;
    loop {
        for i in 0..q.len() {
            trial[i] = q[i] + fraction * x[i];
        }
        let turn = model.largest_turn(q, trial);
        if turn <= LARGEST_TURN || fraction < 1e-12 {
            return fraction;
        }
        fraction *= 0.5;
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}
