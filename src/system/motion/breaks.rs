//! Kinks and jumps of functions of time: no step leads across one, and none is taken from both sides at once.
//!
//! Between two of them motion is smooth: functions of time are taken inside that interval also at its ends,
//! [`grain`] away, so that a method which evaluates the end of its step sees the branch that the step was on.
//! Where the velocity of a driven coordinate jumps, an impulse of its drive sets the bodies moving: of all
//! velocities that joints and motions allow, those that change least in the mass norm (E. J. Routh, Dynamics
//! of a System of Rigid Bodies, part I, chapter VIII, after Gauss's principle).

use super::dynamics::DrivenSystem;
use crate::bodies::{add_node, no_node};
use crate::math::function::Function;
use crate::math::switches::grain;
use crate::system::joints::JointEquations;
use crate::system::loads::ForceElement as _;
use crate::system::signal::{Drive, Signal};
use crate::system::{Kinematics, State, StepOutcome, System, Workspace};

/// Jump of a driven coordinate, relative, that counts as one.
const JUMP: f64 = 1e-9;
/// Jump of its velocity, relative, below which it is roundoff.
const ROUNDOFF: f64 = 1e-12;

impl<const D: usize> System<D> {
    /// Calls with every function of time that a driven coordinate or a load follows.
    pub fn each_function<'a>(&'a self, mut call: impl FnMut(&'a Function)) {
        for drive in &self.drives {
            if let Drive::Function(function) = drive {
                call(function);
            }
        }
        for load in &self.loads {
            load.each_signal(&mut |signal| {
                if let Signal::Function(function) = signal {
                    call(function);
                }
            });
        }
    }

    /// The first joint or motion that follows a driven coordinate.
    pub fn driven_joint(&self, drive: usize) -> Option<usize> {
        let follows = |joint: &JointEquations<D>| joint.drives().any(|of| of == drive);
        self.joints.iter().position(follows)
    }

    /// The time at which functions of time are taken at `time`.
    pub(in crate::system) fn clock(&self, time: f64, kinematics: &Kinematics<D>) -> f64 {
        match kinematics.smooth_interval {
            Some([first, last]) => time.max(first).min(last),
            None => self.now(time),
        }
    }

    /// The time at which functions of time are taken between steps: after a kink or a jump at it.
    pub(in crate::system) fn now(&self, time: f64) -> f64 {
        if self.has_breaks {
            time + grain(time)
        } else {
            time
        }
    }

    /// The first kink or jump after `from`, `until` at the latest.
    fn next_break(&self, from: f64, until: f64) -> Option<f64> {
        if !self.has_breaks {
            return None;
        }
        let due = self.releases.iter().filter_map(|release| release.time);
        let due = due.filter(|time| from < *time && *time <= until);
        let mut first = due.min_by(f64::total_cmp);
        self.each_function(|function| {
            let earlier = function.next_break(from, first.unwrap_or(until));
            first = earlier.or(first);
        });
        first
    }

    /// Driven coordinates as functions of time have them at `clock`, with one derivative.
    fn driven_at(&self, clock: f64) -> impl Iterator<Item = (usize, [f64; 3])> {
        let drives = self.drives.iter().enumerate();
        drives.filter_map(move |(index, drive)| match drive {
            Drive::Function(function) => Some((index, function.derivatives(clock))),
            Drive::Input { .. } | Drive::Turned { .. } | Drive::Kept => None,
        })
    }
}

impl<const D: usize> DrivenSystem<'_, D> {
    /// Begins a smooth interval at `from`; its end, `until` at the latest.
    pub(in crate::system) fn enter(&mut self, from: f64, until: f64) -> f64 {
        let (first, last) = (from + grain(from), until + grain(until));
        self.work.kinematics.release_at(from, self.inputs);
        self.open_latches();
        let found = self.system.next_break(first, last);
        self.crossing = found;
        self.work.kinematics.smooth_interval = match (self.system.has_breaks, found) {
            (true, Some(time)) => Some([first, (time - grain(time)).max(first)]),
            (true, None) => Some([first, f64::INFINITY]),
            (false, _) => None,
        };
        found.map_or(until, |time| time.min(until))
    }

    /// Until when, `to` at the latest, functions of time have no kink or jump; `from` where inputs drive a motion, and where
    /// slides and latches are followed from one communication point to the next.
    pub(in crate::system) fn goes_on_until(&self, from: f64, to: f64) -> f64 {
        let system = self.system;
        let is_followed = !system.slides.is_empty() || system.awaits_events();
        if is_followed || system.trajectories().next().is_some() {
            return from;
        }
        let found = system.next_break(from + grain(from), to + grain(to));
        found.map_or(to, |time| (time - 2.0 * grain(time)).max(from))
    }

    /// Ends the smooth interval. A state at its end goes on after the kink or jump there.
    pub(in crate::system) fn leave(&mut self, state: &mut State) -> StepOutcome {
        let before = self
            .work
            .kinematics
            .smooth_interval
            .take()
            .map_or(state.time, |[_, last]| last);
        let crossed = self.crossing.take();
        let mut driven = self.system.driven_at(state.time.min(before));
        if driven.any(|(_, orders)| orders.iter().any(|x| !x.is_finite())) {
            return StepOutcome::NotFinite;
        }
        if crossed.is_none_or(|time| state.time < time - grain(time)) {
            return StepOutcome::AsIs;
        }
        let after = self.system.now(crossed.unwrap_or(state.time));
        let smallest = self.system.size().min(1.0);
        let mut jumps = false;
        let pairs = (self.system.driven_at(before)).zip(self.system.driven_at(after));
        for ((index, [p, v, a]), (_, [q, u, b])) in pairs {
            if (q - p).abs() > JUMP * p.abs().max(q.abs()).max(smallest) {
                return StepOutcome::Jumped(index);
            }
            let smooth = (after - before) * (a.abs() + b.abs());
            jumps |= (u - v).abs() > ROUNDOFF * (u.abs() + v.abs()) + 2.0 * smooth;
        }
        if !jumps {
            return StepOutcome::AsIs;
        }
        self.strike(state, [before, after])
    }

    /// Velocities after an impulse of what is driven, whose velocity jumps from one time to another.
    fn strike(&mut self, state: &mut State, [before, after]: [f64; 2]) -> StepOutcome {
        let (system, time) = (self.system, state.time);
        self.work.kinematics.smooth_interval = Some([before, before]);
        let energy = self.kinetic(state);
        // Material keeps its velocity, not the mesh that it passes through.
        let Workspace {
            kinematics,
            scratch,
            ..
        } = &mut *self.work;
        scratch.other.fill(no_node());
        system.bodies.add_convective_momentum(
            &kinematics.drives,
            1.0,
            &kinematics.x,
            &mut scratch.other,
        );
        self.work.kinematics.smooth_interval = Some([after, after]);
        system.forward_kinematics(time, &state.coordinates, None, self.work);
        let Workspace {
            kinematics, forces, ..
        } = &mut *self.work;
        let driven = &mut forces.linear_constraint_forces;
        driven.fill(no_node());
        system.add_driven(&kinematics.targets, 1, driven);
        for (rate, driven) in kinematics.v.iter_mut().zip(driven) {
            add_node(rate, -1.0, driven);
        }
        system.rates_of(self.work, &mut state.rates);
        let kept = self.project(state);
        let after_it = self.kinetic(state);
        if system.tracks_work {
            // Drives alone do work: the other impulses act where velocities have no part before or after.
            state.work[0] += after_it - energy;
        }
        self.work.kinematics.smooth_interval = None;
        if kept {
            StepOutcome::Moved
        } else {
            StepOutcome::ConstraintsViolated
        }
    }
}
