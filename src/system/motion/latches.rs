//! Latches of a step: when they close or open within it, and what velocities are after it (`joints/latch.rs`).

use super::dynamics::{DrivenSystem, Dynamics as _, StepOutcome};
use crate::math::switches::grain;
use crate::system::joints::Equation as _;
use crate::system::joints::latch::{Happening, LatchMotion, LatchPlace, closing, opening};
use crate::system::{State, System};

/// Distance of a coordinate from the value that a latch holds at which it closes, in parts of the relative tolerance and the size.
const NEAR: f64 = 1e-3;
/// The least such distance, in parts of the size.
const ROUNDOFF: f64 = 1e-13;
/// Force beyond its range at which a latch opens, relative.
const BEYOND: f64 = 1e-6;

/// What an accepted step means for latches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// Nothing.
    None,
    /// A latch closes or opens after this part of the step: the state is that before it.
    Within(f64),
    /// Latches close or open at the end of the step.
    AtEnd,
}

impl<const D: usize> System<D> {
    /// What can be released and is so before a motion begins: latches that are open.
    pub(in crate::system) fn starts_released(&self) -> impl Iterator<Item = bool> {
        let latches = self.releases.iter().map(|release| release.latch);
        latches.map(|latch| latch.is_some_and(|latch| !latch.is_closed))
    }

    /// Latches with their constraints, without those whose coordinates cannot move.
    pub(in crate::system) fn find_latches(&self) -> Vec<LatchPlace> {
        let releases = self.releases.iter().enumerate();
        let latches = releases.filter_map(|(release, of)| {
            let mut constraints = self.constraints.iter();
            let constraint = constraints.position(|of| of.release == Some(release))?;
            Some(LatchPlace {
                latch: of.latch?,
                release,
                constraint,
            })
        });
        latches.collect()
    }
}

impl<const D: usize> DrivenSystem<'_, D> {
    /// Opens the latches that inputs open.
    pub(super) fn open_latches(&mut self) {
        for place in &self.system.latches {
            let is_opened = place.latch.is_opened(self.inputs);
            self.work.kinematics.released[place.release] |= is_opened;
        }
    }

    /// Remembers a state that a step begins at. Whether a latch opens there.
    pub(super) fn remember_latches(&mut self, state: &State) -> bool {
        self.work.before.copy_from(state);
        self.measure_latches(0, state);
        let system = self.system;
        let mut is_due = false;
        for (i, place) in system.latches.iter().enumerate() {
            let [least, most] = place.latch.range;
            let force = self.work.latches[i].motions[0].force;
            let is_closed = !self.work.kinematics.released[place.release];
            let is_beyond = force < least * (1.0 - least.signum() * BEYOND)
                || force > most * (1.0 + most.signum() * BEYOND);
            let opens = is_closed && place.latch.is_bounded() && is_beyond;
            self.work.latches[i].is_due = opens;
            is_due |= opens;
        }
        is_due
    }

    /// Finds the first latch that closes or opens in a step from the remembered state. A step may be cut short unless `is_last`.
    pub(super) fn find_event(&mut self, state: &mut State, relative: f64, is_last: bool) -> Event {
        self.measure_latches(1, state);
        let (mut cut, mut is_due) = (None, false);
        for (i, place) in self.system.latches.iter().enumerate() {
            let happens = self.happening(place, self.work.latches[i].motions, state, relative);
            let ends = happens == Happening::AtEnd || is_last && happens != Happening::Never;
            self.work.latches[i].is_due = ends;
            is_due |= ends;
            if let (Happening::Within(part), false) = (happens, is_last) {
                cut = Some(cut.map_or(part, |first: f64| first.min(part)));
            }
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

    /// Where a latch closes or opens in a step with these motions at both ends.
    fn happening(
        &self,
        place: &LatchPlace,
        motions: [LatchMotion; 2],
        state: &State,
        relative: f64,
    ) -> Happening {
        let (system, latch, time) = (self.system, &place.latch, state.time);
        let is_open = self.work.kinematics.released[place.release];
        if !is_open && latch.is_bounded() {
            return opening(motions, latch.range, BEYOND);
        }
        let is_over = (system.releases[place.release].time).is_some_and(|due| due <= time);
        if !is_open || is_over || !latch.is_armed(time + grain(time), self.inputs) {
            return Happening::Never;
        }
        let size = system.constraints[place.constraint]
            .kind
            .size(&system.bodies);
        let tolerance = size * (NEAR * relative).max(ROUNDOFF);
        closing(motions, time - self.work.before.time, tolerance)
    }

    /// Coordinates, rates and forces of all latches at a state: that before a step (0) or after it (1).
    fn measure_latches(&mut self, side: usize, state: &State) {
        let system = self.system;
        let released = &self.work.kinematics.released;
        let mut places = system.latches.iter();
        let is_forced = places.any(|of| of.latch.is_bounded() && !released[of.release]);
        if is_forced {
            self.accelerate(state.time, &state.coordinates, &state.rates);
        } else {
            let rates = Some(&state.rates[..]);
            system.forward_kinematics(state.time, &state.coordinates, rates, self.work);
        }
        let view = system.view(&self.work.kinematics);
        for (place, watch) in system.latches.iter().zip(&mut self.work.latches) {
            let is_held = is_forced && !view.released[place.release];
            let lambda = if is_held {
                self.work.constraints.lambda[place.constraint]
            } else {
                0.0
            };
            let constraint = &system.constraints[place.constraint];
            watch.motions[side] = LatchMotion::of(constraint, &view, lambda);
        }
    }

    /// Closes and opens the latches that are due at a state. Velocities after it are those of a plastic impact.
    pub(super) fn switch_latches(&mut self, state: &mut State) -> StepOutcome {
        let system = self.system;
        let energy = |of: &mut Self, state: &State| {
            let rates = Some(&state.rates[..]);
            system.forward_kinematics(state.time, &state.coordinates, rates, of.work);
            system.bodies.kinetic(of.work.kinematics.motion())
        };
        let before = energy(self, state);
        let mut closes = false;
        for (place, watch) in system.latches.iter().zip(&mut self.work.latches) {
            if std::mem::replace(&mut watch.is_due, false) {
                let released = &mut self.work.kinematics.released[place.release];
                *released = !*released;
                closes |= !*released;
            }
        }
        let outcome = self.accepted(state);
        if closes && system.tracks_work && outcome == StepOutcome::Moved {
            let after = energy(self, state);
            state.work[1] += before - after;
        }
        outcome
    }
}
