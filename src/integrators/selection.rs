//! Choice between two methods by what they cost: operations counted, never clocks, so that the same scene
//! takes the same steps on every run.
//!
//! One method is in use; now and then the other takes a few steps of the same motion (both keep the tolerance, so
//! nothing is lost but what they cost more), and the one that gets further with an operation goes on. What trials
//! cost is bounded: after each that has failed, twice as many operations go by before the next.
//!
//! Source: for the change between explicit and implicit methods by what their steps are worth, L. Petzold, Automatic
//! selection of methods for solving stiff and nonstiff systems, SIAM J. Sci. Stat. Comput. 4 (1983) 136-148; that the
//! price of steps is counted while they are taken is ours (docs/decisions/0034-integrator-by-counted-cost.md).

use super::controller::{Pitch, Trial};
use super::{Counts, Goal, OneStepMethod, StepError, Tolerance, advance_choosing};
use crate::system::{Dynamics, MethodStatistics, State};

/// Operations before the first trial.
const FIRST: f64 = 300.0;
/// Operations from a trial that won to the next, and twice from one that failed.
const PAUSE: f64 = 1e3;
/// Operations over which the method in use is measured: what is older counts half, a quarter and so on.
const WINDOW: f64 = 1e3;
/// Steps of a trial that are measured, once they have stopped growing.
const MEASURED: f64 = 4.0;
/// Steps of a trial that roundoff leaves when all are measured.
const LEFT: f64 = 1e-6;
/// Operations that a trial takes at most.
const TRIAL: f64 = 600.0;
/// How many times further with an operation a method must get to be preferred to the one in use.
const GAIN: f64 = 1.1;
/// How many times further the other must have got when it was last in use to be tried at once.
const FALLEN: f64 = 2.0;
/// Part of what the method before got for an operation below which a trial ends with its first step.
const HOPELESS: f64 = 0.5;

/// How many times fewer accelerations one of a pair of explicit methods must take to be preferred to the one in use.
const FEWER: f64 = 1.1;

/// Selects the other method of an explicit pair if it needs fewer accelerations, with the step to propose to it, s. The
/// second method takes steps `longer` times as long where errors limit them. `price` returns the accelerations that a
/// method needs at an error-limited step, s.
pub(super) fn cheaper_of_pair(
    used: usize,
    h: f64,
    longer: f64,
    price: impl Fn(usize, f64) -> f64,
) -> Option<(usize, f64)> {
    let other = 1 - used;
    let proposed = match other {
        0 => h / longer,
        _ => h * longer,
    };
    (FEWER * price(other, proposed) < price(used, h)).then_some((other, proposed))
}

/// One method, or two to choose from.
pub struct Methods {
    methods: Vec<Box<dyn OneStepMethod>>,
    pitch: Pitch,
}

impl Methods {
    /// No choice.
    pub fn one(method: Box<dyn OneStepMethod>) -> Self {
        Self::of(vec![method])
    }

    /// Begins with the first.
    pub fn two(first: Box<dyn OneStepMethod>, second: Box<dyn OneStepMethod>) -> Self {
        Self::of(vec![first, second])
    }

    fn of(methods: Vec<Box<dyn OneStepMethod>>) -> Self {
        let pitch = Pitch::default();
        Self { methods, pitch }
    }

    /// Prepares for a tolerance that was found with communication points at this distance, s. Steps are no longer than
    /// at planning, and the choice of methods does not depend on the points.
    pub fn found_with(self, apart: Option<f64>) -> Self {
        let pitch = Pitch::new(apart);
        Self { pitch, ..self }
    }

    /// The method that is in use.
    pub fn at(&mut self, pace: &MethodStatistics) -> &mut dyn OneStepMethod {
        let index = pace.index(self.methods.len());
        &mut *self.methods[index]
    }

    /// Returns the name of the integrator in use.
    pub fn name(&self, pace: &MethodStatistics) -> &'static str {
        self.methods[pace.index(self.methods.len())].name()
    }

    /// As [`advance`](super::advance), with the cheaper method.
    ///
    /// # Errors
    /// As there.
    pub fn advance(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: &mut State,
        until: f64,
        tolerance: &Tolerance,
    ) -> (Counts, Result<(), StepError>) {
        let methods: &mut [&mut dyn OneStepMethod] = match &mut self.methods[..] {
            [one, two] => &mut [&mut **one, &mut **two],
            methods => &mut [&mut *methods[0]],
        };
        let goal = Goal {
            until,
            tolerance,
            pitch: self.pitch,
            alternative: None,
        };
        advance_choosing(methods, dynamics, state, goal)
    }
}

/// The method that is not in use.
#[derive(Clone, Copy, Debug)]
pub(super) struct AlternativeMethod {
    /// Time that it advances with an operation at most, s.
    at_most: f64,
}

impl AlternativeMethod {
    pub fn of(method: &dyn OneStepMethod) -> Self {
        Self {
            at_most: method.longest_step() / method.fewest_operations(),
        }
    }

    /// Told of an accepted step, of the operations since the one before and whether a longer one would be accurate
    /// enough: whether it goes on.
    pub fn takes_over(
        self,
        state: &mut State,
        step: Trial,
        operations: f64,
        is_quiet: bool,
    ) -> bool {
        let grows = step.has_grown(state.step);
        // What a communication point cuts short counts as a part of the step that it would have been.
        let operations = operations * step.part;
        let pace = &mut state.pace;
        pace.time += step.h;
        pace.operations += operations;
        pace.cost += operations;
        if pace.trial > 0.0 {
            return takes_back(state, grows, step.part);
        }
        if pace.operations > WINDOW {
            pace.time *= 0.5;
            pace.operations *= 0.5;
        }
        let reached = pace.time / pace.operations;
        let fallen = pace.other > FALLEN * reached && pace.cost > 0.25 * WINDOW;
        if pace.cost < pace.pause.max(FIRST) && !fallen || self.at_most < GAIN * reached {
            return false;
        }
        // An explicit method whose error sets its steps is not beaten by one that solves equations in each.
        if self.at_most.is_infinite() && !is_quiet {
            return false;
        }
        pace.trial = MEASURED;
        change(state, reached);
        true
    }
}

/// In a trial, after a step or a part of one: whether the method before goes on.
fn takes_back(state: &mut State, grows: bool, part: f64) -> bool {
    let pace = &mut state.pace;
    let reached = pace.time / pace.operations;
    let ends = pace.cost > TRIAL || !grows && reached < HOPELESS * pace.other;
    if grows && !ends {
        // What growing steps have cost says nothing.
        (pace.time, pace.operations) = (0.0, 0.0);
        return false;
    }
    pace.trial -= part;
    if pace.trial > LEFT && !ends {
        return false;
    }
    pace.trial = 0.0;
    if reached > GAIN * pace.other {
        (pace.pause, pace.cost) = (PAUSE, 0.0);
        return false;
    }
    pace.pause = 2.0 * pace.pause.max(PAUSE);
    change(state, reached);
    true
}

/// The method in use cannot go on: the other does, and it is a long time to the next trial.
pub(super) fn give_up(state: &mut State) {
    state.pace.trial = 0.0;
    state.pace.pause = 2.0 * state.pace.pause.max(PAUSE);
    state.step = 0.0;
    change(state, 0.0);
}

/// The other method goes on; the one in use advanced `reached` (s) with an operation.
fn change(state: &mut State, reached: f64) {
    let pace = &mut state.pace;
    pace.change();
    pace.other = reached;
    (pace.time, pace.operations, pace.cost) = (0.0, 0.0, 0.0);
    std::mem::swap(&mut state.step, &mut pace.step);
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: AlternativeMethod = AlternativeMethod {
        at_most: f64::INFINITY,
    };

    /// The method in use after the last step of a trial of the second one, which got so many times further with an operation than the
    /// first did.
    fn after_trial(further: f64) -> f64 {
        let pace = MethodStatistics {
            method: 1.0,
            trial: 1.0,
            other: 1.0,
            ..MethodStatistics::default()
        };
        let mut state = State {
            step: further,
            pace,
            ..State::default()
        };
        FREE.takes_over(&mut state, Trial::whole(further), 1.0, true);
        assert_eq!(state.pace.trial, 0.0, "the trial is over");
        state.pace.method
    }

    #[test]
    fn a_method_is_exchanged_for_one_that_gets_a_tenth_further() {
        assert_eq!([1.08, 1.12].map(after_trial), [0.0, 1.0]);
    }

    /// The method in use after one step that gets 1 s an operation, where the other got so much when it was in use, and may get at most
    /// so much; operations enough for that have gone by, not for a trial in turn.
    fn after_fall(other: f64, at_most: f64) -> f64 {
        let pace = MethodStatistics {
            other,
            cost: 0.5 * WINDOW,
            pause: 2.0 * WINDOW,
            ..MethodStatistics::default()
        };
        let mut state = State {
            step: 1.0,
            pace,
            ..State::default()
        };
        AlternativeMethod { at_most }.takes_over(&mut state, Trial::whole(1.0), 1.0, true);
        state.pace.method
    }

    #[test]
    fn the_other_method_is_tried_at_once_where_it_got_twice_as_far() {
        assert_eq!([1.9, 2.1].map(|other| after_fall(other, 10.0)), [0.0, 1.0]);
        assert_eq!(
            [1.08, 1.12].map(|at_most| after_fall(3.0, at_most)),
            [0.0, 1.0]
        );
    }
}
