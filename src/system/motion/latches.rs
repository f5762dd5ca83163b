//! Latches of a step: when they close or open within it, and what velocities are after it (`joints/latch.rs`).

use super::dynamics::DrivenSystem;
use crate::math::switches::grain;
use crate::system::joints::Equation as _;
use crate::system::joints::latch::{Event, HeldMotion, LatchPlace, closing, opening};
use crate::system::{State, System};

/// Distance of a coordinate from the value that a latch holds at which it closes, in parts of the relative tolerance and the size.
const NEAR: f64 = 1e-3;
/// The least such distance, in parts of the size.
const ROUNDOFF: f64 = 1e-13;
/// Force beyond its range at which a latch opens, relative.
const BEYOND: f64 = 1e-6;

impl<const D: usize> System<D> {
    /// Tells of everything that can be released whether it is so before a motion begins: latches that are open, and frictions.
    pub(in crate::system) fn starts_released(&self) -> impl Iterator<Item = bool> {
        self.releases.iter().map(|release| {
            let is_open = release.latch.is_some_and(|latch| !latch.is_closed);
            is_open || release.friction.is_some()
        })
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

    /// Tells which latches open where a step begins. Whether any does.
    pub(super) fn open_at_start(&mut self) -> bool {
        let mut is_due = false;
        for (place, watch) in self.system.latches.iter().zip(&mut self.work.latches) {
            let now = watch.motions[0];
            let is_closed = !self.work.kinematics.released[place.release];
            // What is hardly beyond has its moment in the step.
            let is_beyond = matches!(
                opening([now; 2], place.latch.range, BEYOND),
                Event::Within(_)
            );
            watch.is_due = is_closed && is_beyond;
            is_due |= watch.is_due;
        }
        is_due
    }

    /// Where a latch closes or opens in a step with these motions at both ends.
    pub(super) fn latch_event(
        &self,
        place: &LatchPlace,
        motions: [HeldMotion; 2],
        state: &State,
        relative: f64,
    ) -> Event {
        let (system, latch, time) = (self.system, &place.latch, state.time);
        let is_open = self.work.kinematics.released[place.release];
        if !is_open && latch.is_bounded() {
            return opening(motions, latch.range, BEYOND);
        }
        let is_over = system.releases[place.release].is_due(time);
        if !is_open || is_over || !latch.is_armed(time + grain(time), self.inputs) {
            return Event::None;
        }
        let size = system.constraints[place.constraint]
            .kind
            .size(&system.bodies);
        let tolerance = size * (NEAR * relative).max(ROUNDOFF);
        closing(motions, time - self.work.before.time, tolerance)
    }

    /// Closes and opens the latches that are due. Whether any closes.
    pub(super) fn switch_latches(&mut self) -> bool {
        let mut closes = false;
        for (place, watch) in self.system.latches.iter().zip(&mut self.work.latches) {
            if std::mem::replace(&mut watch.is_due, false) {
                let released = &mut self.work.kinematics.released[place.release];
                *released = !*released;
                closes |= !*released;
            }
        }
        closes
    }
}
