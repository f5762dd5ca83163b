//! Events of a step: latches that close or open, frictions and points of contacts that stick or slide, within it or at its ends (decisions
//! 82, 83 and 90).

use super::dynamics::{DrivenSystem, Dynamics as _, StepOutcome};
use crate::system::joints::latch::{Event, HeldMotion};
use crate::system::loads::AppliedLoad;
use crate::system::{State, System};

impl<const D: usize> System<D> {
    /// Whether anything may happen within a step.
    pub(in crate::system) fn awaits_events(&self) -> bool {
        !self.latches.is_empty() || !self.frictions.is_empty() || !self.sticking.is_empty()
    }
}

impl<const D: usize> DrivenSystem<'_, D> {
    /// Remembers a state that a step begins at. Whether anything happens there.
    pub(super) fn remember_start(&mut self, state: &State) -> bool {
        self.work.before.copy_from(state);
        self.measure(0, state);
        self.open_at_start() | self.change_at_start() | self.slide_at_start()
    }

    /// Finds what happens first in a step from the remembered state. A step may be cut short unless `is_last`.
    pub(super) fn find_event(&mut self, state: &mut State, relative: f64, is_last: bool) -> Event {
        self.measure(1, state);
        let (mut cut, mut is_due) = (None, false);
        let mut takes_place = |event: Event| {
            if let (Event::Within(part), false) = (event, is_last) {
                cut = Some(cut.map_or(part, |first: f64| first.min(part)));
            }
            let ends = event == Event::AtEnd || is_last && event != Event::None;
            is_due |= ends;
            ends
        };
        for (i, place) in self.system.latches.iter().enumerate() {
            let event = self.latch_event(place, self.work.latches[i].motions, state, relative);
            self.work.latches[i].is_due = takes_place(event);
        }
        let h = state.time - self.work.before.time;
        for (i, place) in self.system.frictions.iter().enumerate() {
            let (event, change) = self.friction_event(place, &self.work.frictions[i], h);
            self.work.frictions[i].change = takes_place(event).then_some(change);
        }
        for (i, place) in self.system.sticking.iter().enumerate() {
            let (event, change) = self.stick_event(place, &self.work.sticking[i]);
            self.work.sticking[i].change = takes_place(event).then_some(change);
        }
        match cut {
            Some(part) => {
                state.copy_from(&self.work.before);
                Event::Within(part)
            }
            None if is_due => Event::AtEnd,
            None => Event::None,
        }
    }

    /// Coordinates, rates and forces of all that may stick, slide, close or open at a state: that before a step (0) or after it (1).
    pub(super) fn measure(&mut self, side: usize, state: &State) {
        let system = self.system;
        let released = &self.work.kinematics.released;
        let mut latches = system.latches.iter();
        let mut frictions = system.frictions.iter();
        let is_forced = latches.any(|of| of.latch.is_bounded() && !released[of.release])
            || frictions.any(|of| !released[of.release]);
        if is_forced {
            self.accelerate(state.time, &state.coordinates, &state.rates);
        } else {
            self.place_state(state);
        }
        let view = system.view(&self.work.kinematics);
        let motion = |release: usize, constraint: usize| {
            let is_held = is_forced && !view.released[release];
            let lambda = if is_held {
                self.work.constraints.lambda[constraint]
            } else {
                0.0
            };
            HeldMotion::of(&system.constraints[constraint], &view, lambda)
        };
        for (place, watch) in system.latches.iter().zip(&mut self.work.latches) {
            watch.motions[side] = motion(place.release, place.constraint);
        }
        let at = system.instant(
            system.clock(state.time, &self.work.kinematics),
            &self.work.kinematics,
        );
        for (place, watch) in system.frictions.iter().zip(&mut self.work.frictions) {
            let motion = motion(place.release, place.constraint);
            watch.motions[side] = motion;
            watch.value = motion.distance + self.work.kinematics.drives[place.state.place][0];
            if let AppliedLoad::JointFriction(friction) = &system.loads[place.load] {
                watch.limits[side] = friction.limit(at);
            }
        }
        self.measure_sticking(side, state.time);
    }

    /// Lets happen what is due at a state. Velocities after a latch has closed are those of a plastic impact.
    pub(super) fn switch_all(&mut self, state: &mut State) -> StepOutcome {
        let before = self.kinetic(state);
        let closes = self.switch_latches() | self.switch_frictions(state.time);
        let lost = self.switch_sticking(state.time);
        let outcome = self.accepted(state);
        if !self.system.tracks_work || outcome == StepOutcome::ConstraintsViolated {
            return outcome;
        }
        state.work[1] += lost;
        if closes && outcome == StepOutcome::Moved {
            state.work[1] += before - self.kinetic(state);
        }
        outcome
    }
}
