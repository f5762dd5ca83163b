//! Outputs that the tolerance does not reach.
//!
//! The error of a step is held in positions and velocities of the whole scene. Forces, accelerations and
//! velocities of a part magnify it: by stiffness over mass, by the frequency of a vibration. What the errors of
//! steps do to these outputs is sampled at communication points: the state is moved by the error that its last
//! step is estimated to have made, and outputs are read there as well. Errors of steps add up as independent
//! ones do, by their squares.

use super::engine::Engine;
use super::inputs::Inputs;
use super::quantities::{Quantity, Scale, natural};
use super::shapes::drawn;
use super::{Source, Variable};
use crate::integrators::{ErrorEstimate, StateView, StateViewMut, Tolerance};
use crate::math::vector::norm;
use crate::scene::Assembled;
use crate::system::{DrivenSystem, State};

/// Communication points from one sample to the next; before, those whose number is a power of two are sampled.
const EVERY: u64 = 16;
/// Part of what like outputs of its body do that an output is held to where it hardly changes.
const SMALLEST: f64 = 1e-3;
/// Part of its natural size that an output must reach: what is below is roundoff.
const NOTHING: f64 = 1e-10;
/// Part of the error that the state is moved by, so that outputs change in proportion to it: all of it would stretch what bends.
const PART: f64 = 1e-3;
/// Most components of an output: those of an orientation.
const MOST: usize = 9;

/// Whether a communication point, counted from 1, is sampled.
pub(super) fn is_sampled(point: u64) -> bool {
    point.is_power_of_two() || point.is_multiple_of(EVERY)
}

/// An output, with all its components where it is a vector.
struct WatchedOutput {
    name: String,
    members: Vec<Quantity>,
    /// Size of the output in a motion at the natural rate.
    natural: f64,
    /// Where the scene draws its bodies, of places, angles and directions; else 0.
    drawn: [f64; MOST],
    /// Values at the sampled state.
    values: [f64; MOST],
    /// The largest change so far.
    largest: f64,
    /// Outputs of the same kind of the same body, by their places; itself among them.
    like: Vec<usize>,
    /// Sum of the squares of the changes that steps made.
    squares: f64,
    /// Since when its error is beyond the one wanted, in time since the start, s.
    beyond: Option<f64>,
    is_doubtful: bool,
    is_told: bool,
}

/// An output that the tolerance does not reach.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubtful {
    /// Name of the output without an index.
    pub name: String,
    /// Estimate of the accumulated error of steps, relative to the largest change of the output.
    pub error: f64,
    /// The error wanted.
    pub wanted: f64,
}

impl std::fmt::Display for Doubtful {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            name,
            error,
            wanted,
        } = self;
        write!(
            f,
            "{name}: errors of the steps may be {error:.0e} of its largest change, {wanted:.0e} is wanted; tighten the tolerance where \
             this output counts"
        )
    }
}

/// Observations of the outputs so far.
#[derive(Default)]
pub(super) struct Watch {
    groups: Vec<WatchedOutput>,
    /// The error wanted, relative.
    wanted: f64,
    /// The state moved by its error.
    pub shifted: State,
    points: u64,
    /// Sub-steps since the last sample, and time since the start, s.
    steps: u64,
    elapsed: f64,
}

impl Watch {
    /// For the outputs among these variables.
    pub(super) fn new<const D: usize>(
        variables: &[Variable],
        assembled: &Assembled<D>,
        tolerance: &Tolerance,
        wanted: f64,
    ) -> Self {
        let system = &assembled.system;
        let outputs = variables
            .iter()
            .filter_map(|variable| match variable.source {
                Source::Output(quantity) => {
                    Some((quantity, &variable.name[..], drawn(quantity, assembled)))
                }
                _ => None,
            });
        let (mut groups, by) = (Vec::<WatchedOutput>::new(), Scale::of(system, tolerance));
        for (quantity, name, drawn) in outputs {
            let Some(natural) = natural(quantity, by) else {
                continue;
            };
            let name = name.split('[').next().unwrap_or(name);
            match groups.iter_mut().find(|group| group.name == name) {
                Some(group) if group.members.len() < MOST => {
                    group.drawn[group.members.len()] = drawn;
                    group.members.push(quantity);
                }
                _ => groups.push(WatchedOutput {
                    name: name.to_owned(),
                    members: vec![quantity],
                    natural,
                    drawn: std::array::from_fn(|k| if k == 0 { drawn } else { 0.0 }),
                    values: [0.0; MOST],
                    largest: 0.0,
                    like: Vec::new(),
                    squares: 0.0,
                    beyond: None,
                    is_doubtful: false,
                    is_told: false,
                }),
            }
        }
        let nature = |group: &WatchedOutput| {
            let body = group.name.split('.').next().map(str::to_owned);
            (body, std::mem::discriminant(&group.members[0]))
        };
        let natures: Vec<_> = groups.iter().map(nature).collect();
        for (group, nature) in groups.iter_mut().zip(&natures) {
            let all = natures.iter().enumerate();
            let like = all.filter(|(_, other)| *other == nature);
            group.like = like.map(|(index, _)| index).collect();
        }
        Self {
            groups,
            wanted,
            shifted: system.blank_state(0.0),
            ..Self::default()
        }
    }

    /// Counts a communication step in; whether the state at its end is to be sampled.
    pub(super) fn is_due(&mut self, steps: u64, time: f64) -> bool {
        self.points += 1;
        self.steps += steps;
        self.elapsed += time;
        is_sampled(self.points) && !self.groups.is_empty()
    }

    /// Takes the outputs at the state.
    pub(super) fn take(&mut self, mut value: impl FnMut(Quantity) -> f64) {
        for group in &mut self.groups {
            for (value_of, quantity) in group.values.iter_mut().zip(&group.members) {
                *value_of = value(*quantity);
            }
            let mut change = group.values;
            change
                .iter_mut()
                .zip(&group.drawn)
                .for_each(|(now, drawn)| *now -= drawn);
            group.largest = group.largest.max(norm(&change[..group.members.len()]));
        }
    }

    /// Compares them with the outputs at the shifted state.
    fn compare(&mut self, mut value: impl FnMut(Quantity) -> f64) {
        let steps = std::mem::take(&mut self.steps) as f64;
        for group in &mut self.groups {
            for (now, quantity) in group.values.iter().zip(&group.members) {
                group.squares += steps * ((value(*quantity) - now) / PART).powi(2);
            }
        }
    }

    /// Judges outputs once the scene has had the time (s) to move: what starts from rest has no size yet. What is beyond the error
    /// wanted must be so until twice as much time has passed: changes grow.
    fn judge(&mut self, time: f64) {
        for index in 0..self.groups.len() {
            let is_beyond = self.elapsed >= time && self.error(index) > self.wanted;
            let group = &mut self.groups[index];
            group.beyond = if is_beyond {
                group.beyond.or(Some(self.elapsed))
            } else {
                None
            };
            let since = group.beyond.map(|since| self.elapsed >= 2.0 * since);
            group.is_doubtful |= since == Some(true);
        }
    }

    /// Returns the estimated error of steps in an output so far, relative to its largest change.
    fn error(&self, index: usize) -> f64 {
        let group = &self.groups[index];
        let others = group.like.iter().map(|other| self.groups[*other].largest);
        let size = others.fold(0.0, f64::max);
        if size > NOTHING * group.natural {
            group.squares.sqrt() / group.largest.max(SMALLEST * size)
        } else {
            0.0
        }
    }

    /// The next output that has become doubtful, still is, and has not been told of.
    pub(super) fn next(&mut self) -> Option<Doubtful> {
        let mut groups = self.groups.iter();
        let index = groups
            .position(|group| group.is_doubtful && group.beyond.is_some() && !group.is_told)?;
        self.groups[index].is_told = true;
        Some(self.doubtful(index))
    }

    /// All outputs whose errors are beyond the one wanted now.
    pub(super) fn all(&self) -> Vec<Doubtful> {
        let doubtful = (0..self.groups.len()).filter(|index| self.groups[*index].beyond.is_some());
        doubtful.map(|index| self.doubtful(index)).collect()
    }

    fn doubtful(&self, index: usize) -> Doubtful {
        Doubtful {
            name: self.groups[index].name.clone(),
            error: self.error(index),
            wanted: self.wanted,
        }
    }
}

impl<const D: usize> Engine<D> {
    /// Samples what the errors of the last step do to outputs that magnify them.
    pub(super) fn watch(&mut self, state: &State, inputs: &Inputs, steps: u64, time: f64) {
        let mut watch = std::mem::take(&mut self.watch);
        if watch.is_due(steps, time) {
            watch.take(|quantity| self.output(quantity, state, inputs));
            if watch.steps > 0 {
                self.sample(&mut watch, state, inputs);
            }
            watch.judge(self.tolerance.time);
            self.forget();
        }
        self.watch = watch;
    }

    /// Reads outputs at the state moved by a part of the error of the last step.
    fn sample(&mut self, watch: &mut Watch, state: &State, inputs: &Inputs) {
        let shifted = &mut watch.shifted;
        shifted.copy_from(state);
        let system = &self.assembled.system;
        let model = DrivenSystem::new(system, &inputs.values, &mut self.work, state);
        let mut model = model.moving(&inputs.slopes);
        let (q, v) = (&mut shifted.coordinates, &mut shifted.rates);
        let at = StateView::of(state);
        let error = ErrorEstimate {
            position: q,
            velocity: v,
        };
        let within = state.dense.is_under_way().then_some(&state.dense);
        let method = self.methods.at(&state.pace);
        method.error(&mut model, at, within, error);
        let add = |(moved, now): (&mut f64, &f64)| *moved = PART * *moved + now;
        q.iter_mut().zip(&state.coordinates).for_each(add);
        v.iter_mut().zip(&state.rates).for_each(add);
        let is_placed = model.project(shifted);
        let moved = StateViewMut {
            time: state.time,
            ..StateViewMut::of(shifted)
        };
        method.follow(&mut model, moved);
        if is_placed && model.project(shifted) {
            let shifted = std::mem::take(&mut watch.shifted);
            self.forget();
            watch.compare(|quantity| self.output(quantity, &shifted, inputs));
            watch.shifted = shifted;
        }
    }

    /// The next output that the tolerance does not reach and that has not been told of.
    pub(super) fn next_doubtful(&mut self) -> Option<Doubtful> {
        self.watch.next()
    }

    /// All outputs that the tolerance does not reach, with what is known of them now.
    pub(super) fn doubtful(&self) -> Vec<Doubtful> {
        self.watch.all()
    }
}
