//! Damped motion to an equilibrium, where Newton's method alone finds none: from far away a slack cable has hardly any stiffness, and
//! every correction leads elsewhere.
//!
//! Steps of the implicit Euler method, which dissipates, for the motion of the system without its own damping. A step becomes
//! longer where its equations are solved easily, and shorter where they are not. The bodies are stopped where the forces
//! begin to act against their motion, as the kinetic energy has a maximum there. Newton's method is tried again at such places.
//!
//! Source: A. S. Day, An introduction to dynamic relaxation, The Engineer 219 (1965); M. R. Barnes, Form finding and analysis
//! of tension structures by dynamic relaxation, Int. J. Space Structures 14 (1999) (kinetic damping); E. Hairer, C. Lubich,
//! Energy-diminishing integration of gradient systems, IMA J. Numer. Anal. 34 (2014) (implicit Euler).

use super::newton::{AcceptanceTest, ESCAPES, LARGEST_ROTATION, NOISE, Newton};
use super::{Failure, FoundEquilibrium, unsymmetric};
use crate::bodies::{Node, NodeKind};
use crate::math::space::Vector;
use crate::math::vector::{dot, norm};
use crate::system::{Dynamics, State, StepOutcome};

/// Most steps.
const STEPS: usize = 4000;
/// Most iterations of one step, and those up to which the next one is longer.
const ITERATIONS: usize = 12;
const EASY: usize = 4;
/// Last correction of a step, relative to its way.
const SOLVED: f64 = 1e-2;
/// Way of the first step, relative to the size of the system.
const FIRST: f64 = 0.01;
/// Way of a step, relative to the size, from which on Newton's method is tried.
const SHORT: f64 = 1e-4;
/// Steps after which Newton's method is tried at any rate.
const ATTEMPT: usize = 250;
/// Way of a body, relative to the size, from which on it does not come back.
const AWAY: f64 = 1e3;
/// Steps that fail one after the other before the motion is given up.
const FAILURES: usize = 40;

/// Result of Newton's method near a point of the path.
enum Beside {
    /// An equilibrium.
    Found(FoundEquilibrium),
    /// An equilibrium that was not stable and was left.
    Left,
    /// None.
    Nothing,
}

impl<const D: usize> Newton<'_, '_, D> {
    /// Moves the system with damping until Newton's method finds an equilibrium near its path.
    ///
    /// # Errors
    /// [`Failure`] if loads are not conservative, the motion does not come to rest, or the work limit is reached.
    pub(super) fn swing(&mut self, state: &mut State) -> Result<FoundEquilibrium, Failure> {
        // Forces that follow feed a motion: it would end far from where they were applied.
        if !self.is_conservative {
            return Err(Failure::Restless);
        }
        let (size, guard) = (self.model.system.scale(), AcceptanceTest::Turns);
        let (mut why, mut failures) = (Failure::Restless, 0);
        let start = self.model.system.nodes_of(state, self.model.work);
        let (mut stops, mut is_due, mut waits, mut escapes) = (0_usize, false, 0, 0);
        state.rates.fill(0.0);
        (self.model).acceleration(state.time, &state.coordinates, &self.rest, &mut self.force);
        let mut h = (FIRST * size / norm(&self.force).max(f64::MIN_POSITIVE)).sqrt();
        for step in 1..=STEPS {
            if failures > FAILURES || self.model.is_exhausted() {
                break;
            }
            if is_due || step % ATTEMPT == 0 {
                is_due = false;
                waits = 8;
                let before = state.clone();
                match self.rest_beside(state, guard, escapes < ESCAPES) {
                    Beside::Found(found) => return Ok(found),
                    Beside::Left => escapes += 1,
                    Beside::Nothing => state.copy_from(&before),
                }
            }
            self.model.renew_beyond(state, 0.0);
            let before = state.clone();
            let Some((iterations, way, power)) = self.step(state, h) else {
                state.copy_from(&before);
                h *= 0.25;
                failures += 1;
                continue;
            };
            if way > size
                && let Some(body) = self.away(&start, state)
            {
                why = Failure::Away(body);
                break;
            }
            failures = 0;
            waits = waits.max(1) - 1;
            if power < 0.0 {
                state.rates.fill(0.0);
                stops += 1;
                is_due = stops.is_power_of_two();
            }
            is_due |= waits == 0 && way < SHORT * size;
            if iterations <= EASY {
                h *= 2.0;
            } else if iterations > 2 * EASY {
                h *= 0.7;
            }
        }
        state.rates.fill(0.0);
        Err(self.exhausted().unwrap_or(why))
    }

    /// An equilibrium that Newton's method finds from a place on the way; one that is not stable is left if that may be.
    fn rest_beside(&mut self, state: &mut State, guard: AcceptanceTest, leaves: bool) -> Beside {
        state.rates.fill(0.0);
        if self.relax(state, guard).is_err() {
            return Beside::Nothing;
        }
        let is_stable = !self.is_conservative || !self.leave(state);
        match (is_stable, leaves) {
            (false, true) => Beside::Left,
            (false, false) if self.relax(state, guard).is_err() => Beside::Nothing,
            _ if self.rest(state).is_some() => Beside::Nothing,
            _ => Beside::Found(FoundEquilibrium { is_stable }),
        }
    }

    /// A body that has moved far away.
    fn away(&mut self, start: &[Node<D>], state: &State) -> Option<usize> {
        let (system, bound) = (self.model.system, AWAY * self.model.system.size());
        let now = system.nodes_of(state, self.model.work);
        let is_away = |node: usize| {
            let [now, start] = [&now, start].map(|x| Vector::from(x[node][0]));
            let way = (now - start).norm();
            system.bodies.kind(node) == NodeKind::Point && (way > bound || way.is_nan())
        };
        let mut bodies = system.bodies.ranges.iter();
        bodies.position(|nodes| nodes.clone().any(is_away))
    }

    /// One step of a length, s: how many iterations it took, its way and the power of the forces at its end; nothing where it
    /// could not be solved.
    fn step(&mut self, state: &mut State, h: f64) -> Option<(usize, f64, f64)> {
        let (time, size) = (state.time, self.model.system.scale());
        let from = state.coordinates.clone();
        let rates = std::mem::replace(&mut state.rates, self.rest.clone());
        let shift = 1.0 / h;
        let mut before = f64::INFINITY;
        for iteration in 1..=ITERATIONS {
            let q = &state.coordinates;
            (self.model).acceleration(time, q, &self.rest, &mut self.force);
            for (i, force) in self.force.iter_mut().enumerate() {
                *force -= shift * (shift * (q[i] - from[i]) - rates[i]);
            }
            self.model.linearize(time, q, &self.rest);
            self.x.copy_from_slice(&self.force);
            if self.is_conservative {
                if !self.model.factor([shift * shift, 0.0]) {
                    return None;
                }
                self.model.solve_small(&mut self.x);
            } else if !unsymmetric::solve(self.model, shift, self.least, &mut self.x) {
                return None;
            }
            self.trial.clone_from(&state.coordinates);
            (self.trial.iter_mut().zip(&self.x)).for_each(|(q, x)| *q += x);
            let correction = norm(&self.x);
            let is_far = self.model.largest_rotation(&from, &self.trial) > LARGEST_ROTATION;
            if !correction.is_finite() || is_far || (iteration > 2 && correction > 0.9 * before) {
                return None;
            }
            before = correction;
            state.coordinates.copy_from_slice(&self.trial);
            if !matches!(
                self.model.accepted(state),
                StepOutcome::AsIs | StepOutcome::Moved
            ) {
                return None;
            }
            let pairs = state.coordinates.iter().zip(&from);
            let moved: Vec<f64> = pairs.map(|(q, from)| q - from).collect();
            let way = norm(&moved);
            if correction <= SOLVED * way || correction <= f64::EPSILON * size {
                if self.is_conservative {
                    let (change, terms) =
                        self.model.potential_difference(&from, &state.coordinates);
                    let off: f64 = (moved.iter().zip(&rates))
                        .map(|(moved, v)| (moved * shift - v).powi(2) - v * v)
                        .sum();
                    if change + 0.5 * off > NOISE * terms {
                        return None;
                    }
                }
                (self.model).acceleration(time, &state.coordinates, &self.rest, &mut self.force);
                let pairs = state.rates.iter_mut().zip(&moved);
                pairs.for_each(|(rate, moved)| *rate = moved * shift);
                return Some((iteration, way, dot(&self.force, &moved)));
            }
        }
        None
    }
}
