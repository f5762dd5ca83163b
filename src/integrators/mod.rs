//! Floor 4. Time integration of `q'' = a(q, q')` with identity inertia: one file a method, one trait,
//! one error-controlled driver. An integrator knows no joints, loads or elements.
//!
//! Methods are one-step: nothing of the past survives a communication point but the proposed step and, where nothing
//! jumps, a step that leads beyond it, both in the state; so inputs may jump there and a restored state
//! continues bit for bit.

mod controller;
mod dense;
mod dopri853;
mod events;
mod nystrom;
mod radau;
mod runge_kutta;
mod selection;

pub use controller::rescaled;
pub use dopri853::DOPRI853;
pub use nystrom::{Nystrom, RKN43, RKN64, Tableau, VERLET};
pub use radau::Radau;
pub use runge_kutta::{Bounds, Coefficients, RK4, RungeKutta};
pub use selection::Methods;

use crate::math::vector::norm as size;
use crate::system::{DenseStep, Dynamics, Event, State, StepOutcome};
use controller::{Controller, Pitch, Trial};
use events::EventSearch;
use selection::AlternativeMethod;

/// Error that a step may make, and the norm in which every method measures it (decision 38).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Relative tolerance.
    pub relative: f64,
    /// Size of positions, m sqrt(kg): size of the system times the root of its mass.
    pub position: f64,
    /// Time in which an error of velocity grows into one of position, s.
    pub time: f64,
}

impl Tolerance {
    /// Size of an error: `max(|e_q|, |e_v| time) / (position relative)`, where 1 is just tolerated. With identity inertia the Euclidean
    /// norm of `q` is the mass norm of the displacement field.
    ///
    /// Every method measures its estimate of the error of a step in this norm. `runge_kutta.rs` multiplies it by a factor from a second
    /// estimate of lower order, where a method has one. `runge_kutta.rs` and `nystrom.rs` multiply it by [`Dynamics::steps_in`].
    ///
    /// Three other sizes have formulas of their own: corrections of Newton's iteration (`iterate` in `radau.rs`), accelerations that are not
    /// solved (`unsolved` in `radau/rest.rs`), and the change over the first step (`first_step`).
    pub fn error_norm(&self, position: &[f64], velocity: &[f64]) -> f64 {
        let p = size(position);
        let v = size(velocity) * self.time;
        // Not f64::max, which would hide a NaN.
        (if p > v { p } else { v + 0.0 * p }) / (self.position * self.relative)
    }
}

/// Outcome of one attempted step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attempt {
    /// Finished with this error in units of the tolerance.
    Done(f64),
    /// The stage equations were not solved; try this fraction of the step.
    Failed(f64),
}

/// State that a method reads, with `n` coordinates.
#[derive(Clone, Copy, Debug)]
pub struct StateView<'a> {
    /// Time, s.
    pub time: f64,
    /// Coordinates `q`, m sqrt(kg), `n` of them.
    pub coordinates: &'a [f64],
    /// Rates `q'` of the coordinates, m sqrt(kg)/s, `n` of them.
    pub rates: &'a [f64],
}

impl<'a> StateView<'a> {
    /// Borrows time, coordinates and rates of a state.
    pub fn of(state: &'a State) -> Self {
        Self {
            time: state.time,
            coordinates: &state.coordinates,
            rates: &state.rates,
        }
    }
}

/// State that a method corrects, with `n` coordinates.
#[derive(Debug)]
pub struct StateViewMut<'a> {
    /// Time, s.
    pub time: f64,
    /// Coordinates `q`, m sqrt(kg), `n` of them.
    pub coordinates: &'a mut [f64],
    /// Rates `q'` of the coordinates, m sqrt(kg)/s, `n` of them.
    pub rates: &'a mut [f64],
}

impl<'a> StateViewMut<'a> {
    /// Borrows time, coordinates and rates of a state.
    pub fn of(state: &'a mut State) -> Self {
        Self {
            time: state.time,
            coordinates: &mut state.coordinates,
            rates: &mut state.rates,
        }
    }
}

/// Estimated errors of a state, which a method writes.
#[derive(Debug)]
pub struct ErrorEstimate<'a> {
    /// Errors of the `n` coordinates, m sqrt(kg).
    pub position: &'a mut [f64],
    /// Errors of the `n` rates, m sqrt(kg)/s.
    pub velocity: &'a mut [f64],
}

/// A one-step method of second-order systems.
pub trait OneStepMethod: Send {
    /// Name in logs and charts.
    fn name(&self) -> &'static str;
    /// Longest step that stability allows, s.
    fn longest_step(&self) -> f64;
    /// Operations ([`Dynamics::operations`]) of a step at least.
    fn fewest_operations(&self) -> f64 {
        1.0
    }
    /// Goes on with the first (0) or the second (1) of its tableaux, where it has two.
    fn use_variant(&mut self, _variant: usize) {}
    /// The tableau that would get over the time that remains (s) with fewer operations than the one in use, and the step (s) to
    /// propose to it, where errors allow that in use steps of `h` (s).
    fn cheaper(&self, _h: f64, _remaining: f64) -> Option<(usize, f64)> {
        None
    }
    /// Forgets history: inputs may have jumped.
    fn begin(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]) {
        self.refresh(dynamics, time, q, v);
    }
    /// Tries a step of length `h` from the state last begun with or accepted.
    fn attempt(
        &mut self,
        dynamics: &mut dyn Dynamics,
        state: StateView<'_>,
        h: f64,
        tolerance: &Tolerance,
    ) -> Attempt;
    /// Takes over the result of the last attempt.
    fn accept(&mut self, q: &mut [f64], v: &mut [f64]);
    /// The state accepted last was brought back to constraints: computes its acceleration again.
    fn refresh(&mut self, dynamics: &mut dyn Dynamics, time: f64, q: &[f64], v: &[f64]);
    /// The state accepted last is read: lets accelerations that were not solved to the tolerance come to rest,
    /// since forces are read from them. Whether the state has moved.
    fn polish_accelerations(
        &mut self,
        _dynamics: &mut dyn Dynamics,
        _state: StateViewMut<'_>,
        _tolerance: &Tolerance,
    ) -> bool {
        false
    }
    /// Whether its steps can be read in between ([`OneStepMethod::keep`]).
    fn is_dense(&self) -> bool {
        false
    }
    /// Keeps stages and powers of the last attempt, which has succeeded, so that it is read in between.
    fn keep(&mut self, _step: &mut DenseStep) {}
    /// As [`OneStepMethod::polish_accelerations`] for a state within a step that is kept, whoever took it. What was left unsolved, in units of
    /// what may be; beyond 1 the state has been corrected.
    fn polish_within(
        &mut self,
        _dynamics: &mut dyn Dynamics,
        _step: &DenseStep,
        _state: StateViewMut<'_>,
        _tolerance: &Tolerance,
    ) -> f64 {
        0.0
    }
    /// Begins a step with the polynomial of the one before, which was kept.
    fn start_from_dense(&mut self, _before: &DenseStep) {}
    /// Errors of position and velocity that the last step to a state is estimated to have left in it, as far
    /// as the method can tell; it is the end of the step, or stands within one that is kept.
    fn error(
        &mut self,
        _dynamics: &mut dyn Dynamics,
        _state: StateView<'_>,
        _within: Option<&DenseStep>,
        error: ErrorEstimate<'_>,
    ) {
        error.position.fill(0.0);
        error.velocity.fill(0.0);
    }
    /// Lets the stiff directions of a state follow that was moved from the one of [`OneStepMethod::error`] by a small part of its error: where a
    /// body rotates, its velocities are to rotate with it, or damping and constraints answer to a deformation that is not there.
    fn follow(&mut self, _dynamics: &mut dyn Dynamics, _state: StateViewMut<'_>) {}
    /// Work that came in and that was dissipated over the last attempt, J; zero where the method cannot tell.
    fn work(&self) -> [f64; 2] {
        [0.0; 2]
    }
    /// Acceleration at the state last begun with or accepted, for the first step's length.
    fn acceleration(&self) -> &[f64];
    /// Newton iterations since [`OneStepMethod::begin`].
    fn newton_iterations(&self) -> u64 {
        0
    }
}

/// Step counts of a call of [`advance`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Newton iterations.
    pub newton_iterations: u64,
}

/// Why a step could not be finished.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepError {
    /// The tolerance cannot be met: the step shrank to the roundoff of time.
    StepTooSmall,
    /// The state is no longer finite.
    NotFinite,
    /// The way to the communication point takes more work than the system allows.
    TooMuchWork,
    /// A slide has left its cable; the joint.
    SliderLeftCable(usize),
    /// A winch has taken in its whole cable; its driven coordinate.
    WinchEmpty(usize),
    /// A rod is bent or twisted beyond what its frames hold: which one, and where.
    ElementOverDeformed(usize, usize),
    /// Constraints cannot be kept.
    ConstraintsViolated,
    /// A driven coordinate jumps; its index.
    Jumped(usize),
}

/// Error of a step, in tolerances and without what adds up of drives, below which twice its length would be accurate
/// enough: it is not the fastest waves that set its length.
const QUIET: f64 = 1.0 / 16.0;
/// Steps to the end of a smooth interval from which on their number depends on their length alone.
const MANY: f64 = 4.0;
/// Most corrections of a state that is read.
const RELAXATIONS: usize = 3;

/// End of a way, and how steps lead to it.
#[derive(Clone, Copy, Debug)]
struct Goal<'a> {
    /// Time of the end, s.
    until: f64,
    /// Error that a step may make.
    tolerance: &'a Tolerance,
    /// Distance of the communication points that the tolerance was found with.
    pitch: Pitch,
    /// The method that is not in use, where there are two.
    alternative: Option<AlternativeMethod>,
}

/// Advances the state to `until` in steps that each keep the tolerance; lands exactly, and on every
/// time on the way at which something jumps. On failure the state is that of the last accepted step.
///
/// # Errors
/// The reason, when no step however short succeeds or the work is too much.
pub fn advance(
    method: &mut dyn OneStepMethod,
    dynamics: &mut dyn Dynamics,
    state: &mut State,
    until: f64,
    tolerance: &Tolerance,
) -> (Counts, Result<(), StepError>) {
    let goal = Goal {
        until,
        tolerance,
        pitch: Pitch::default(),
        alternative: None,
    };
    advance_choosing(&mut [method], dynamics, state, goal)
}

/// Advances as [`advance`] does, with the cheaper of two methods where there are two. Sets the alternative of the goal.
fn advance_choosing(
    methods: &mut [&mut dyn OneStepMethod],
    dynamics: &mut dyn Dynamics,
    state: &mut State,
    goal: Goal<'_>,
) -> (Counts, Result<(), StepError>) {
    let until = goal.until;
    let mut counts = Counts::default();
    let mut result = Ok(());
    // Where one of two methods gave up last, s.
    let mut given_up = f64::NEG_INFINITY;
    while result.is_ok() && state.time < until {
        let index = state.pace.index(methods.len());
        for method in methods.iter_mut() {
            // That of the alternative method as well, which is measured by what it would take.
            method.use_variant(state.pace.variant());
        }
        let alternative = methods
            .get(1 - index)
            .map(|method| AlternativeMethod::of(&**method));
        let goal = Goal {
            alternative,
            ..goal
        };
        let method = &mut *methods[index];
        if state.dense.is_under_way() {
            dynamics.begin_smooth_interval(state.dense.start, until);
            result = dense::follow(method, dynamics, state, goal);
        } else {
            let until = dynamics.begin_smooth_interval(state.time, until);
            let goal = Goal { until, ..goal };
            result = advance_smoothly(method, dynamics, state, goal, &mut counts);
            counts.newton_iterations += method.newton_iterations();
        }
        // What one method cannot do the other may.
        if result == Err(StepError::StepTooSmall) && alternative.is_some() && state.time > given_up
        {
            given_up = state.time;
            selection::give_up(state);
            result = Ok(());
        }
        let crossed = outcome(dynamics.end_smooth_interval(state));
        result = result.and(crossed.map(drop));
    }
    (counts, result)
}

/// Advances over a smooth interval, until the alternative method is to go on, or until a step is to lead beyond the interval.
fn advance_smoothly(
    method: &mut dyn OneStepMethod,
    dynamics: &mut dyn Dynamics,
    state: &mut State,
    goal: Goal<'_>,
    counts: &mut Counts,
) -> Result<(), StepError> {
    let Goal {
        until,
        tolerance,
        pitch,
        alternative,
    } = goal;
    let follows = state.dense.has_ended_at(state.time);
    let mut controller = Controller::new(follows.then_some(state.dense.ceiling));
    let mut counted = dynamics.operations();
    let mut is_settled = begin(method, dynamics, state, tolerance);
    let shortest = shortest(until, state.time);
    let mut is_fresh = true;
    let mut search = EventSearch::new(dynamics);
    loop {
        let remaining = until - state.time;
        if remaining <= 0.0 {
            return Ok(());
        }
        if is_fresh || remaining > MANY * state.step {
            use_cheaper_variant(method, state, pitch.way(remaining), is_settled);
        }
        if dynamics.is_exhausted() {
            return Err(StepError::TooMuchWork);
        }
        if dynamics.renew(state) {
            method.refresh(dynamics, state.time, &state.coordinates, &state.rates);
        }
        if search.begin(dynamics, state) {
            return events::happen(dynamics, state);
        }
        let (trial, is_beyond) = match search.trial(remaining) {
            Some(trial) => (trial, false),
            None => next_trial(method, dynamics, state, goal),
        };
        if is_beyond && !is_fresh {
            // A step that is kept follows from nothing but its start.
            return Ok(());
        }
        let from = StateView::of(state);
        match bounded(method.attempt(dynamics, from, trial.h, tolerance), method) {
            Attempt::Done(error) if error <= 1.0 => {
                let judged = trial.among_settled(is_settled);
                state.step = controller.accept(judged, error, state.step);
                is_settled = !trial.has_grown(state.step);
                counts.steps += 1;
                if is_beyond {
                    let operations = dynamics.operations() - counted;
                    dense::begin(method, state, trial.h, operations, controller.ceiling());
                    return dense::follow(method, dynamics, state, goal);
                }
                is_fresh = false;
                take(method, state, trial, until);
                let tried = (trial.h, tolerance.relative);
                let event = search.end(method, dynamics, state, tried, counts);
                if matches!(event, Event::Within(_)) {
                    continue;
                }
                project(method, dynamics, state)?;
                polish_accelerations(method, dynamics, state, goal)?;
                if event == Event::AtEnd {
                    return events::happen(dynamics, state);
                }
                let since = since(dynamics, &mut counted);
                let alike = dynamics.steps_in(tolerance.time, trial.h);
                // The whole of a step that is cut short would have another error.
                let is_quiet = error / alike < QUIET * trial.part.powi(4);
                let goes_on =
                    |other: AlternativeMethod| other.takes_over(state, trial, since, is_quiet);
                if alternative.is_some_and(goes_on) {
                    return Ok(());
                }
            }
            failed => {
                counts.rejected += 1;
                state.step = controller.reject(trial, failed);
                if state.step <= shortest {
                    return Err(reason(&state.rates, method.acceleration()));
                }
            }
        }
    }
}

/// The step to try next on the way to a goal, and whether it is to lead beyond.
fn next_trial(
    method: &dyn OneStepMethod,
    dynamics: &dyn Dynamics,
    state: &State,
    goal: Goal<'_>,
) -> (Trial, bool) {
    let Goal { until, pitch, .. } = goal;
    let wanted = state.step.min(method.longest_step());
    let allowed = pitch.allowed(wanted, method.is_dense());
    match dense::trial(method, dynamics, state, until, allowed) {
        Some(trial) => (trial.among(pitch, wanted, allowed), true),
        None => (pitch.trial(wanted, allowed, until - state.time), false),
    }
}

/// Begins at a state; whether errors have set the step that it proposes.
fn begin(
    method: &mut dyn OneStepMethod,
    dynamics: &mut dyn Dynamics,
    state: &mut State,
    tolerance: &Tolerance,
) -> bool {
    dynamics.renew(state);
    method.begin(dynamics, state.time, &state.coordinates, &state.rates);
    if state.dense.has_ended_at(state.time) {
        method.start_from_dense(&state.dense);
    }
    let is_settled = state.step > 0.0;
    if !is_settled {
        state.step = first_step(method.acceleration(), &state.rates, tolerance);
    }
    is_settled
}

/// Operations since they were `counted`, which are counted anew.
fn since(dynamics: &dyn Dynamics, counted: &mut f64) -> f64 {
    let operations = dynamics.operations();
    operations - std::mem::replace(counted, operations)
}

/// Goes on with the tableau that takes fewer operations over the time that remains (s); with the second only where errors
/// have set the step.
fn use_cheaper_variant(
    method: &mut dyn OneStepMethod,
    state: &mut State,
    remaining: f64,
    is_settled: bool,
) {
    let cheaper = method.cheaper(state.step, remaining);
    if let Some((variant, step)) = cheaper.filter(|(variant, _)| *variant == 0 || is_settled) {
        method.use_variant(variant);
        state.pace.set_variant(variant);
        state.step = step;
    }
}

/// The outcome of an attempt; work that is not finite is none.
fn bounded(attempt: Attempt, method: &dyn OneStepMethod) -> Attempt {
    if method.work().iter().all(|work| work.is_finite()) {
        attempt
    } else {
        Attempt::Failed(0.25)
    }
}

/// The state is that at the end of the step attempted last.
fn take(method: &mut dyn OneStepMethod, state: &mut State, trial: Trial, until: f64) {
    method.accept(&mut state.coordinates, &mut state.rates);
    state.time = if trial.is_last {
        until
    } else {
        state.time + trial.h
    };
    for (sum, part) in state.work.iter_mut().zip(method.work()) {
        *sum += part;
    }
}

/// The shortest step between two times, s.
fn shortest(one: f64, other: f64) -> f64 {
    16.0 * f64::EPSILON * one.abs().max(other.abs())
}

/// Lets the system do with an accepted state what it must.
fn project(
    method: &mut dyn OneStepMethod,
    dynamics: &mut dyn Dynamics,
    state: &mut State,
) -> Result<(), StepError> {
    if outcome(dynamics.accepted(state))? {
        method.refresh(dynamics, state.time, &state.coordinates, &state.rates);
    }
    Ok(())
}

/// Lets forces come to rest in a state at the end of a call, which is read.
fn polish_accelerations(
    method: &mut dyn OneStepMethod,
    dynamics: &mut dyn Dynamics,
    state: &mut State,
    goal: Goal<'_>,
) -> Result<(), StepError> {
    if state.time < goal.until {
        return Ok(());
    }
    for _ in 0..RELAXATIONS {
        let read = StateViewMut::of(state);
        if !method.polish_accelerations(dynamics, read, goal.tolerance) {
            break;
        }
        project(method, dynamics, state)?;
    }
    Ok(())
}

/// Whether a state was moved, or why it cannot go on.
fn outcome(accepted: StepOutcome) -> Result<bool, StepError> {
    match accepted {
        StepOutcome::AsIs => Ok(false),
        StepOutcome::Moved => Ok(true),
        StepOutcome::SliderLeftCable(joint) => Err(StepError::SliderLeftCable(joint)),
        StepOutcome::WinchEmpty(drive) => Err(StepError::WinchEmpty(drive)),
        StepOutcome::ElementOverDeformed(rod, place) => {
            Err(StepError::ElementOverDeformed(rod, place))
        }
        StepOutcome::ConstraintsViolated => Err(StepError::ConstraintsViolated),
        StepOutcome::Jumped(drive) => Err(StepError::Jumped(drive)),
        StepOutcome::NotFinite => Err(StepError::NotFinite),
    }
}

fn reason(v: &[f64], a: &[f64]) -> StepError {
    if v.iter().chain(a).all(|x| x.is_finite()) {
        StepError::StepTooSmall
    } else {
        StepError::NotFinite
    }
}

/// A first step short enough to learn the right one from: the state changes by a hundredth of its
/// size.
fn first_step(a: &[f64], v: &[f64], tolerance: &Tolerance) -> f64 {
    let rate = (size(v) / tolerance.position).max((size(a) / tolerance.position).sqrt());
    if rate > 0.0 && rate.is_finite() {
        1e-2 / rate
    } else {
        1e-3
    }
}
