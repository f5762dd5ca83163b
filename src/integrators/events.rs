//! Steps that end where something happens within them: they are cut shorter until they do (decision 82).
//!
//! Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., section II.6 (event location).

use super::controller::Trial;
use super::{Counts, OneStepMethod, StepError, outcome};
use crate::system::{Dynamics, Event, State};

/// Most attempts at a step that ends where something happens.
const CUTS: u32 = 40;
/// Part of what remains from which on a step leads to the end.
const WHOLE: f64 = 1.0 - 1e-12;

/// Search for events over a smooth interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct EventSearch {
    /// Whether anything may happen.
    is_on: bool,
    /// Length of the next step, which was cut, s.
    cut: Option<f64>,
    /// How often it was cut.
    cuts: u32,
}

impl EventSearch {
    /// Begins a way.
    pub fn new(dynamics: &dyn Dynamics) -> Self {
        Self {
            is_on: dynamics.awaits_events(),
            cut: None,
            cuts: 0,
        }
    }

    /// Remembers where a step begins. Whether something happens there.
    pub fn begin(&self, dynamics: &mut dyn Dynamics, state: &State) -> bool {
        self.is_on && dynamics.remember(state)
    }

    /// The step that was cut, if one was.
    pub fn trial(&mut self, remaining: f64) -> Option<Trial> {
        self.cut
            .take()
            .map(|h| Trial::cut(h, h >= WHOLE * remaining))
    }

    /// Looks for what happens in a step that leads to a state. A step that is to be cut counts as rejected.
    pub fn end(
        &mut self,
        method: &mut dyn OneStepMethod,
        dynamics: &mut dyn Dynamics,
        state: &mut State,
        (h, tolerance): (f64, f64),
        counts: &mut Counts,
    ) -> Event {
        if !self.is_on {
            return Event::None;
        }
        let event = dynamics.event(state, tolerance, self.cuts == CUTS);
        if let Event::Within(part) = event {
            self.cut = Some(part * h);
            self.cuts += 1;
            counts.steps -= 1;
            counts.rejected += 1;
            counts.newton_iterations += method.newton_iterations();
            method.begin(dynamics, state.time, &state.coordinates, &state.rates);
        } else {
            self.cuts = 0;
        }
        event
    }
}

/// Lets happen what was found at a state.
///
/// # Errors
/// The state after it cannot be brought onto the constraints.
pub(super) fn happen(dynamics: &mut dyn Dynamics, state: &mut State) -> Result<(), StepError> {
    outcome(dynamics.switch(state)).map(drop)
}
