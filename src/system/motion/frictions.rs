//! Frictions of a step: when they stick or slide within it, and at its ends (`joints/friction.rs`).

use super::dynamics::DrivenSystem;
use crate::system::joints::Equation as _;
use crate::system::joints::friction::{FrictionChange, FrictionPlace, stopping};
use crate::system::joints::latch::{Event, opening};
use crate::system::loads::AppliedLoad;
use crate::system::signal::{InputSignal, Trajectory};
use crate::system::workspace::FrictionWatch;
use crate::system::{State, System};

/// Force beyond its limit at which friction slides, relative: it moves the instant by as much.
const BEYOND: f64 = 1e-9;
/// Speed that is none, in sizes of the coordinate a second.
const AT_REST: f64 = 1e-9;

impl<const D: usize> System<D> {
    /// Lists frictions with their constraints, without those whose coordinates cannot move.
    pub(in crate::system) fn find_frictions(&self) -> Vec<FrictionPlace> {
        let loads = self.loads.iter().enumerate();
        let frictions = loads.filter_map(|(load, of)| {
            let AppliedLoad::JointFriction(friction) = of else {
                return None;
            };
            let state = friction.state;
            let is_own = |release: Option<usize>| {
                release.is_some_and(|release| self.releases[release].friction == Some(state))
            };
            let constraint = (self.constraints.iter()).position(|of| is_own(of.release))?;
            let course = |drive: usize| self.trajectories_before(drive);
            Some(FrictionPlace {
                state,
                courses: [course(state.place), course(state.direction)],
                release: self.constraints[constraint].release?,
                constraint,
                load,
            })
        });
        frictions.collect()
    }

    /// Number of driven coordinates before one that follow no function of time.
    pub(super) fn trajectories_before(&self, drive: usize) -> usize {
        let before = &self.drives[..drive];
        before.iter().filter_map(InputSignal::of).count()
    }
}

impl<const D: usize> DrivenSystem<'_, D> {
    /// Tells which frictions change where a step begins. Whether any does.
    pub(super) fn change_at_start(&mut self) -> bool {
        let mut is_due = false;
        for i in 0..self.system.frictions.len() {
            let place = &self.system.frictions[i];
            let change = self.change_now(place, &self.work.frictions[i]);
            self.work.frictions[i].change = change;
            is_due |= change.is_some();
        }
        is_due
    }

    /// What friction changes to where it stands: it slides where it cannot hold, and in the direction in which the coordinate moves.
    fn change_now(&self, place: &FrictionPlace, watch: &FrictionWatch) -> Option<FrictionChange> {
        let (now, direction) = (watch.motions[0], self.direction(place));
        if direction == 0.0 && !self.work.kinematics.released[place.release] {
            // What is hardly beyond has its moment in the step.
            let of = now.over(watch.limits[0]);
            let event = opening([of; 2], [-1.0, 1.0], BEYOND);
            return matches!(event, Event::Within(_)).then(|| sliding(now.force));
        }
        let is_moving = now.rate.abs() > AT_REST * self.size(place);
        if is_moving && direction * now.rate <= 0.0 {
            return Some(FrictionChange::Slides(now.rate.signum()));
        }
        (direction == 0.0).then_some(FrictionChange::Sticks)
    }

    /// Where friction begins or ceases to slide in a step of length `h` (s), and what it changes to.
    pub(super) fn friction_event(
        &self,
        place: &FrictionPlace,
        watch: &FrictionWatch,
        h: f64,
    ) -> (Event, FrictionChange) {
        let (direction, [before, after]) = (self.direction(place), watch.motions);
        if direction == 0.0 {
            let [first, last] = watch.limits;
            let forces = [before.over(first), after.over(last)];
            let event = opening(forces, [-1.0, 1.0], BEYOND);
            return (event, sliding(after.force));
        }
        let event = stopping(watch.motions, direction, h, self.size(place));
        (event, FrictionChange::Sticks)
    }

    /// Changes the frictions that are due at a time (s). Whether any begins to stick.
    pub(super) fn switch_frictions(&mut self, time: f64) -> bool {
        let mut sticks = false;
        let kinematics = &mut self.work.kinematics;
        for (place, watch) in self.system.frictions.iter().zip(&mut self.work.frictions) {
            let Some(change) = watch.change.take() else {
                continue;
            };
            let direction = match change {
                FrictionChange::Sticks => 0.0,
                FrictionChange::Slides(direction) => direction,
            };
            let [at, way] = place.courses;
            for (course, value) in [(at, watch.value), (way, direction)] {
                kinematics.trajectories[course] = Trajectory::hold(time, [value, 0.0, 0.0]);
            }
            kinematics.released[place.release] = change != FrictionChange::Sticks;
            sticks |= change == FrictionChange::Sticks;
        }
        sticks
    }

    /// Lets frictions and points of contacts stick or slide at a state where a motion begins.
    pub(in crate::system) fn start_frictions(&mut self, state: &mut State) {
        if self.system.frictions.is_empty() && self.system.sticking.is_empty() {
            return;
        }
        // First all stick that are at rest, then some may slide.
        for _ in 0..2 {
            let changes = self.remember_start(state);
            if !(self.grip_at_start() | changes) {
                return;
            }
            self.switch_all(state);
        }
    }

    fn direction(&self, place: &FrictionPlace) -> f64 {
        self.work.kinematics.drives[place.state.direction][0]
    }

    fn size(&self, place: &FrictionPlace) -> f64 {
        let constraint = &self.system.constraints[place.constraint];
        constraint.kind.size(&self.system.bodies)
    }
}

/// What friction changes to beyond this force, N or N m: it moves against the force that held it.
fn sliding(force: f64) -> FrictionChange {
    FrictionChange::Slides(if force > 0.0 { -1.0 } else { 1.0 })
}
