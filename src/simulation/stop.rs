//! What ends a step, and why it was not finished in words: what was reached, what was expected, what to do.

use std::ops::Range;

use super::engine::Engine;
use super::{Report, Simulation, StepFailure};
use crate::integrators::{Counts, StepError};
use crate::scene::finite_near;
use crate::system::State;

/// Part of a communication step below which a sub-step comes to nothing.
const CRAWL: f64 = 1e-5;

impl Simulation {
    /// Bounds the work of each step (evaluations times parts) where that is less than the scene allows.
    pub(super) fn limit_work(&mut self, most: f64) {
        if let Some(engine) = &mut self.engine {
            engine.limit_work(most);
        }
    }
}

impl<const D: usize> Engine<D> {
    /// Bounds the work of each step (evaluations times parts) where that is less than it may be by now.
    pub(super) fn limit_work(&mut self, most: f64) {
        self.most_work = self.most_work.min(most);
    }

    /// Describes a rod or beam with an element that is bent or twisted too far. `place` ends the text that names the
    /// element.
    pub(super) fn overbent(&self, body: usize, element: usize, place: &str) -> String {
        format!(
            "expected elements of `{}` that bend by less than a right angle from the middle to an end and twist by less \
             than half a turn, found more in element {}{place}: take more elements",
            self.bodies[body],
            element + 1
        )
    }

    /// Describes a step that cannot begin because the energy of springs that inputs set is not finite.
    ///
    /// # Errors
    /// Always: the description.
    pub(super) fn unbounded(
        &mut self,
        state: &State,
        found: f64,
    ) -> (Report, Result<(), StepFailure>) {
        self.forget();
        let report = Report {
            method: self.methods.name(&state.pace),
            steps: 0,
            rejected: 0,
            newton_iterations: 0,
            work: 0.0,
        };
        let failure = StepFailure {
            time: state.time,
            reason: format!(
                "expected a finite energy of springs that inputs set, found {found} J: an input is too large"
            ),
        };
        (report, Err(failure))
    }

    /// Describes a law of force that has no finite value near a state: within a time, s, at its rates.
    fn law_without_value(&mut self, state: &State, within: f64) -> Option<String> {
        let system = &self.assembled.system;
        self.evaluation.kinematics(system, state, &mut self.work);
        let found = self.evaluation.without_value(system, within);
        self.forget();
        let (load, [value, rate]) = found?;
        let name = self
            .assembled
            .load_number(load)
            .and_then(|k| self.loads.get(k))?;
        Some(format!(
            "expected the force of `{name}` to be a number, found none near x = {value:e}, v = {rate:e}: bound what its expression \
             divides by, or takes the root or logarithm of"
        ))
    }

    /// Explains in words why a step over an interval of time (s) ended at a state.
    pub(super) fn explain(
        &mut self,
        stop: StepError,
        state: &State,
        interval: Range<f64>,
        counts: &Counts,
    ) -> String {
        let Range { start, end: until } = interval;
        let (method, tolerance) = (self.methods.name(&state.pace), self.tolerance.relative);
        // Steps that shrink and shrink spend any work.
        let crawls = stop == StepError::TooMuchWork && state.step < CRAWL * (until - start);
        if crawls
            || matches!(
                stop,
                StepError::StepTooSmall | StepError::NotFinite | StepError::ConstraintsViolated
            )
        {
            if let Err(error) = finite_near(&self.timed, state.time) {
                return error.to_string();
            }
            if let Some(law) = self.law_without_value(state, until - start) {
                return format!("{method}: {law}");
            }
            if let Some(names) = self.newly_redundant(state) {
                return format!(
                    "{method}: expected joints and motions that leave one way to go on, found a dead point, \
                     where {names} hold (nearly) what others hold already"
                );
            }
        }
        match stop {
            StepError::StepTooSmall => format!(
                "{method}: no step however short meets the relative tolerance {tolerance:e}"
            ),
            StepError::TooMuchWork => {
                let (parts, limit) = (self.assembled.system.parts(), self.most_work);
                let (taken, way) = (counts.steps, state.time - start);
                format!(
                    "{method}: expected a step to {until} s within work_limit = {limit:e} (evaluations times \
                     {parts} parts), found it spent after {taken} sub-steps over {way:e} s, {} rejected; take \
                     shorter communication steps, a looser relative_tolerance than {tolerance:e}, fewer elements \
                     or a higher work_limit",
                    counts.rejected
                )
            }
            StepError::NotFinite => {
                format!("{method}: velocities or accelerations are no longer finite")
            }
            StepError::ElementOverDeformed(body, element) => self.overbent(body, element, ""),
            StepError::SliderLeftCable(joint) => {
                format!("`{}` has left its cable", self.name(joint))
            }
            StepError::WinchEmpty(drive) => {
                let name = self.driven_name(drive);
                format!("expected cable left to take in, found winch `{name}` at its end")
            }
            StepError::ConstraintsViolated => format!(
                "{method}: constraints cannot be kept: expected joints and motions that can hold together from \
                 here on, found a linkage at the end of its reach or motions that contradict each other"
            ),
            StepError::Jumped(drive) => {
                let name = self.driven_name(drive);
                format!("expected a motion without jumps, found one of `{name}`")
            }
        }
    }
}
