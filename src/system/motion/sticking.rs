//! Contacts of a step whose markers stick: when they begin to stick or to slide within it, and at its ends (decision 90).

use super::dynamics::DrivenSystem;
use crate::system::System;
use crate::system::joints::latch::Event;
use crate::system::loads::{AppliedLoad, Grip, StickMotion};
use crate::system::signal::Trajectory;
use crate::system::workspace::StickWatch;

/// Force beyond the largest one at which a point slides, relative: friction falls by as much there.
const BEYOND: f64 = 1e-6;
/// Cosine of the angle between the velocity and the direction of sliding that a state keeps from which on the state keeps another one.
const ASIDE: f64 = 0.9;
/// Least part of a step to go on with.
const LEAST: f64 = 1e-3;

/// A point of a contact that may stick.
#[derive(Clone, Copy, Debug)]
pub struct StickPlace {
    /// Index of the load.
    pub load: usize,
    /// Index of the first driven coordinate in which the state keeps its friction.
    pub kept: usize,
    /// Place of that one among the trajectories.
    pub course: usize,
    /// Speed at which it sticks, m/s.
    pub slow: f64,
}

impl<const D: usize> System<D> {
    /// Lists the points of contacts that may stick.
    pub(in crate::system) fn find_sticking(&self) -> Vec<StickPlace> {
        let loads = self.loads.iter().enumerate();
        let points = loads.filter_map(|(load, of)| {
            let AppliedLoad::Contact(contact) = of else {
                return None;
            };
            let kept = contact.kept?;
            Some(StickPlace {
                load,
                kept,
                course: self.trajectories_before(kept),
                slow: contact.law.slip_velocity,
            })
        });
        points.collect()
    }
}

impl<const D: usize> DrivenSystem<'_, D> {
    /// Tells which points slide where a step begins, since friction cannot hold them any more. Whether any does.
    pub(super) fn slide_at_start(&mut self) -> bool {
        self.change_points(|grip, now, _| slides_now(grip, now).then_some(Grip::Slides))
    }

    /// Tells which points stick or slide where a motion begins: all that touch. Whether any does.
    pub(super) fn grip_at_start(&mut self) -> bool {
        self.change_points(|grip, now, slow| {
            if slides_now(grip, now) {
                return Some(Grip::Slides);
            }
            (grip == Grip::Free && now.touches).then_some(gripped(now, slow))
        })
    }

    /// Tells what points change to where a step begins. Whether any does.
    fn change_points(
        &mut self,
        change: impl Fn(Grip, &StickMotion<D>, f64) -> Option<Grip>,
    ) -> bool {
        let mut is_due = false;
        for i in 0..self.system.sticking.len() {
            let place = &self.system.sticking[i];
            let now = &self.work.sticking[i].motions[0];
            let change = change(self.grip(place), now, place.slow);
            is_due |= change.is_some();
            self.work.sticking[i].change = change;
        }
        is_due
    }

    /// Where in a step a point begins to stick or to slide, and what it changes to.
    pub(super) fn stick_event(&self, place: &StickPlace, watch: &StickWatch<D>) -> (Event, Grip) {
        let [before, after] = &watch.motions;
        match self.grip(place) {
            Grip::Free if !after.touches => (Event::None, Grip::Free),
            Grip::Free => (Event::AtEnd, gripped(after, place.slow)),
            Grip::Sticks => (overcome([before, after]), Grip::Slides),
            Grip::Slides if !after.touches => (Event::AtEnd, Grip::Free),
            Grip::Slides => stopping([before, after], place.slow),
        }
    }

    /// Lets the points that are due at a time (s) stick or slide. Returns the energy that their springs lose, J.
    pub(super) fn switch_sticking(&mut self, time: f64) -> f64 {
        let mut lost = 0.0;
        for i in 0..self.system.sticking.len() {
            let Some(change) = self.work.sticking[i].change.take() else {
                continue;
            };
            let place = &self.system.sticking[i];
            let now = self.work.sticking[i].now;
            let before = self.grip(place);
            let stored = |grip| {
                if grip == Grip::Sticks {
                    now.energy
                } else {
                    0.0
                }
            };
            lost += stored(before) - stored(change);
            let vector = match (before, change) {
                (_, Grip::Sticks) => now.end,
                // What held the point goes on against its motion.
                (Grip::Sticks, _) => now.against,
                _ => now.slip.try_normalize(0.0).unwrap_or(now.slip),
            };
            let kept = vector.iter().copied().chain([change.number()]);
            let courses = &mut self.work.kinematics.trajectories[place.course..];
            for (course, value) in courses.iter_mut().zip(kept) {
                *course = Trajectory::hold(time, [value, 0.0, 0.0]);
            }
        }
        lost
    }

    /// Measures the points at the state that the workspace holds: that before a step (0) or after it (1).
    pub(super) fn measure_sticking(&mut self, side: usize, time: f64) {
        let (system, kinematics) = (self.system, &self.work.kinematics);
        let at = system.instant(system.clock(time, kinematics), kinematics);
        for (place, watch) in system.sticking.iter().zip(&mut self.work.sticking) {
            let AppliedLoad::Contact(contact) = &system.loads[place.load] else {
                continue;
            };
            watch.now = contact.stick_motion(at).unwrap_or_default();
            watch.motions[side] = watch.now;
        }
    }

    fn grip(&self, place: &StickPlace) -> Grip {
        Grip::of(self.work.kinematics.drives[place.kept + D][0])
    }
}

/// Whether a point sticks that friction cannot hold. What is hardly beyond has its moment in the step.
fn slides_now<const D: usize>(grip: Grip, now: &StickMotion<D>) -> bool {
    grip == Grip::Sticks && matches!(overcome([now; 2]), Event::Within(_))
}

/// State of friction of a point that has begun to touch.
fn gripped<const D: usize>(now: &StickMotion<D>, slow: f64) -> Grip {
    if now.slip.norm() <= slow {
        Grip::Sticks
    } else {
        Grip::Slides
    }
}

/// Where in a step the force on a point that sticks exceeds the largest friction: where the straight line between what is beyond at both
/// ends does.
fn overcome<const D: usize>([before, after]: [&StickMotion<D>; 2]) -> Event {
    let forces = [
        before.friction,
        before.largest,
        after.friction,
        after.largest,
    ];
    let size = forces.into_iter().fold(0.0, f64::max);
    let [from, to] = [before, after].map(|of| (of.friction - of.largest) / size);
    // Nothing is beyond without any force.
    if to > BEYOND {
        let part = (0.5 * BEYOND - from) / (to - from);
        Event::Within(if part.is_finite() {
            part.clamp(LEAST, 1.0)
        } else {
            0.5
        })
    } else if to > 0.0 {
        Event::AtEnd
    } else {
        Event::None
    }
}

/// Where in a step a point that slides stops, or turns aside, and what it does after that.
fn stopping<const D: usize>([before, after]: [&StickMotion<D>; 2], slow: f64) -> (Event, Grip) {
    let [first, last] = [before, after].map(|of| of.slip.dot(&before.against));
    let speed = after.slip.norm();
    if last <= 0.0 && speed <= slow {
        (Event::AtEnd, Grip::Sticks)
    } else if last < 0.0 && first > 0.0 {
        // Aims at a little beyond the stop.
        let part = (first + 0.5 * slow) / (first - last);
        (Event::Within(part.clamp(LEAST, 1.0)), Grip::Sticks)
    } else if speed > slow && last < ASIDE * speed {
        (Event::AtEnd, Grip::Slides)
    } else {
        (Event::None, Grip::Slides)
    }
}
