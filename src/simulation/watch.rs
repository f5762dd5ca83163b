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
use crate::integrators::Tolerance;
use crate::math::vector::norm;
use crate::system::{Model, State, System};

/// Errors beyond this many tolerances of an output's largest size are told of: the estimate is within a factor
/// of three of the error on most scenes, and what is off by 30 tolerances must not stay unsaid.
const LIMIT: f64 = 10.0;
/// Communication points from one sample to the next; before, those whose number is a power of two are sampled.
const EVERY: u64 = 16;
/// Part of its natural size that an output must reach for its errors to be compared with it.
const SMALLEST: f64 = 1e-3;
/// Most components of an output: those of an orientation.
const MOST: usize = 9;

/// Whether a communication point, counted from 1, is sampled.
pub(super) fn is_sampled(point: u64) -> bool {
    point.is_power_of_two() || point.is_multiple_of(EVERY)
}

/// An output, with all its components where it is a vector.
struct Group {
    name: String,
    members: Vec<Quantity>,
    /// What it is where the scene moves at its natural rate.
    natural: f64,
    /// Values at the sampled state.
    values: [f64; MOST],
    largest: f64,
    /// Sum of the squares of the changes that steps made.
    squares: f64,
    is_doubtful: bool,
    is_told: bool,
}

/// What has been seen of the outputs so far.
#[derive(Default)]
pub(super) struct Watch {
    groups: Vec<Group>,
    /// The state moved by its error.
    pub shifted: State,
    points: u64,
    /// Sub-steps since the last sample, and time since the start, s.
    steps: u64,
    elapsed: f64,
}

impl Watch {
    /// For these outputs.
    pub(super) fn new<'a, const D: usize>(
        outputs: impl Iterator<Item = (Quantity, &'a str)>,
        system: &System<D>,
        tolerance: &Tolerance,
    ) -> Self {
        let (mut groups, by) = (Vec::<Group>::new(), Scale::of(system, tolerance));
        for (quantity, name) in outputs {
            let Some(natural) = natural(quantity, by) else {
                continue;
            };
            let name = name.split('[').next().unwrap_or(name);
            match groups.iter_mut().find(|group| group.name == name) {
                Some(group) if group.members.len() < MOST => group.members.push(quantity),
                _ => groups.push(Group {
                    name: name.to_owned(),
                    members: vec![quantity],
                    natural,
                    values: [0.0; MOST],
                    largest: 0.0,
                    squares: 0.0,
                    is_doubtful: false,
                    is_told: false,
                }),
            }
        }
        Self {
            groups,
            shifted: system.blank_state(0.0),
            ..Self::default()
        }
    }

    /// Counts a communication step in; whether the state at its end is to be sampled.
    pub(super) fn is_due(&mut self, steps: u64, time: f64) -> bool {
        self.points += 1;
        self.steps += steps;
        self.elapsed += time;
        is_sampled(self.points) && self.groups.iter().any(|group| !group.is_doubtful)
    }

    /// Takes the outputs at the state.
    pub(super) fn take(&mut self, mut value: impl FnMut(Quantity) -> f64) {
        for group in &mut self.groups {
            for (value_of, quantity) in group.values.iter_mut().zip(&group.members) {
                *value_of = value(*quantity);
            }
            group.largest = group.largest.max(norm(&group.values));
        }
    }

    /// Compares them with the outputs at the shifted state.
    pub(super) fn compare(
        &mut self,
        tolerance: &Tolerance,
        mut value: impl FnMut(Quantity) -> f64,
    ) {
        let steps = std::mem::take(&mut self.steps) as f64;
        for group in &mut self.groups {
            for (now, quantity) in group.values.iter().zip(&group.members) {
                group.squares += steps * (value(*quantity) - now).powi(2);
            }
            let size = group.largest.max(SMALLEST * group.natural);
            let is_beyond = group.squares.sqrt() > LIMIT * tolerance.relative * size;
            // What starts from rest has no size yet.
            group.is_doubtful |= is_beyond && self.elapsed >= tolerance.time;
        }
    }

    /// The next output that has become doubtful and has not been told of.
    pub(super) fn next(&mut self) -> Option<&str> {
        let mut groups = self.groups.iter_mut();
        let group = groups.find(|group| group.is_doubtful && !group.is_told)?;
        group.is_told = true;
        Some(&group.name)
    }
}

impl<const D: usize> Engine<D> {
    /// Samples what the errors of the last step do to outputs that magnify them.
    pub(super) fn watch(&mut self, state: &State, inputs: &Inputs, steps: u64, time: f64) {
        let mut watch = std::mem::take(&mut self.watch);
        if watch.is_due(steps, time) {
            watch.take(|quantity| self.output(quantity, state, inputs));
            let shifted = &mut watch.shifted;
            shifted.copy_from(state);
            let system = &self.assembled.system;
            let model = Model::new(system, &inputs.values, &mut self.work, state);
            let mut model = model.moving(&inputs.slopes);
            let (q, v) = (&mut shifted.coordinates, &mut shifted.rates);
            let at = (state.time, &state.coordinates[..], &state.rates[..]);
            let within = state.dense.is_under_way().then_some(&state.dense);
            let method = self.methods.at(&state.pace);
            method.error(&mut model, at, within, [q, v]);
            let add = |(moved, now): (&mut f64, &f64)| *moved += now;
            q.iter_mut().zip(&state.coordinates).for_each(add);
            v.iter_mut().zip(&state.rates).for_each(add);
            if model.project(shifted) {
                let shifted = std::mem::take(&mut watch.shifted);
                self.forget();
                let tolerance = self.tolerance;
                watch.compare(&tolerance, |quantity| {
                    self.output(quantity, &shifted, inputs)
                });
                watch.shifted = shifted;
            }
            self.forget();
        }
        self.watch = watch;
    }

    /// The next output that the tolerance does not reach and that has not been told of.
    pub(super) fn next_doubtful(&mut self) -> Option<&str> {
        self.watch.next()
    }
}
