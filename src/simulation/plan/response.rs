//! What inputs that keep their start values would do: linear answers of outputs to each of them, and natural frequencies, which need
//! neither an amplitude nor a run. Meshes are compared by these where nothing is said of an input.

use std::f64::consts::PI;

use super::outputs::{OutputGroup, like};
use crate::math::vector::norm;
use crate::simulation::dimension::AnyEngine;
use crate::simulation::engine::{Engine, OperatingPoint};
use crate::simulation::inputs::Inputs;
use crate::simulation::{Quantity, Simulation, Source};
use crate::system::{DrivenSystem, State, slow_response};

/// Most natural frequencies that are compared.
const MODES: usize = 12;
/// Root mean square displacement from rest, in sizes of the scene, within which modes about the start are those of the motion.
const REST: f64 = 0.01;
/// Root mean square displacement of the answers, in sizes of the scene, and change of an input that is tried first.
const SMALL: f64 = 1e-5;
const FIRST: f64 = 1e-6;

/// Linear responses of a mesh to inputs that are held, about the initial state.
#[derive(Clone, Debug, Default)]
pub(super) struct Responses {
    /// For every input that is held, what every computed variable changes with it.
    pub inputs: Vec<Vec<f64>>,
    /// Squares of natural frequencies that the communication step resolves, 1/s^2, the lowest first; negative where motion grows. None
    /// where the scene starts far from rest: of what moves as a whole the runs tell more than modes about the start.
    pub squares: Vec<f64>,
    /// The square of one over the length of the experiment, 1/s^2: what is slower is not seen.
    slow: f64,
}

impl Responses {
    /// Computes the responses of an initialized simulation to the inputs `held`, by their indices. `stop` is the length
    /// of the experiment, `step` that of a communication step, s.
    pub fn new(simulation: &mut Simulation, held: &[usize], stop: f64, step: f64) -> Self {
        let computed = simulation.variables.iter().filter(|v| v.is_computed());
        let sources = computed.map(|variable| match variable.source {
            Source::Output(quantity) => Some(quantity),
            _ => None,
        });
        let quantities: Vec<Option<Quantity>> = sources.collect();
        let (state, inputs) = (&simulation.state, &simulation.inputs.values);
        let Some(engine) = &mut simulation.engine else {
            return Self::default();
        };
        let at = OperatingPoint {
            state,
            inputs,
            rate: 1.0 / stop,
        };
        let answers = held.iter().map(|place| {
            let found = engine.slow_response(at, *place, &quantities);
            found.unwrap_or_else(|| vec![0.0; quantities.len()])
        });
        let answers = answers.collect();
        let squares = match engine.way_to_rest(at) {
            Some(way) if way <= REST => squares(engine, state, inputs, PI / step),
            _ => Vec::new(),
        };
        engine.forget();
        Self {
            inputs: answers,
            squares,
            slow: stop.powi(-2),
        }
    }

    /// Returns the largest relative difference of the response to an input between this mesh and a finer one, over the
    /// outputs that count. Each output is relative to its largest response to a component of the same input vector. A
    /// thousandth of the response of like outputs of its body is the least reference.
    pub fn difference(
        &self,
        closer: &Self,
        input: usize,
        components: &[usize],
        groups: &[OutputGroup],
    ) -> f64 {
        let (Some(own), Some(fine)) = (self.inputs.get(input), closer.inputs.get(input)) else {
            return 0.0;
        };
        let values = |group: &OutputGroup, all: &[f64]| -> Vec<f64> {
            group.members.iter().map(|member| all[*member]).collect()
        };
        let largest = |group: &OutputGroup| {
            let answers = components.iter().filter_map(|k| closer.inputs.get(*k));
            let sizes = answers.map(|answer| norm(&values(group, answer)));
            sizes.fold(0.0, f64::max)
        };
        let sizes: Vec<f64> = groups.iter().map(largest).collect();
        let counting = groups.iter().enumerate().filter(|(_, group)| group.counts);
        let differences = counting.map(|(index, group)| {
            let size = like(groups, index, &sizes);
            let pairs = values(group, own).into_iter().zip(values(group, fine));
            let apart: Vec<f64> = pairs.map(|(a, b)| a - b).collect();
            if size > 0.0 { norm(&apart) / size } else { 0.0 }
        });
        differences.fold(0.0, f64::max)
    }

    /// The largest relative change of a natural frequency from one mesh to a finer one: 1 of one that is missing.
    pub fn detuned(&self, closer: &Self) -> f64 {
        let fine = closer.squares.iter().enumerate();
        let differences = fine.map(|(index, fine)| {
            let own = self.squares.get(index).copied().unwrap_or(0.0);
            // Of a frequency it is half of that of the square.
            (0.5 * (own - fine) / (fine.abs() + closer.slow))
                .abs()
                .min(1.0)
        });
        differences.fold(0.0, f64::max)
    }
}

/// Squares of natural frequencies below a limit, rad/s; none where there are none to be had.
fn squares(engine: &mut AnyEngine, state: &State, inputs: &[f64], limit: f64) -> Vec<f64> {
    let modes = engine.modes(state, inputs, MODES).unwrap_or_default();
    let squares = modes.into_iter().map(|mode| mode.square);
    let mut found: Vec<f64> = squares.filter(|square| *square < limit * limit).collect();
    found.truncate(MODES);
    found
}

/// A state that stands still where another is.
fn still(state: &State) -> State {
    let mut still = state.clone();
    still.rates.fill(0.0);
    still
}

impl<const D: usize> Engine<D> {
    /// How far a state at rest is from where forces would let it be, as far as it gets at the rate: root mean square displacement
    /// in sizes of the scene. Nothing where the linearized equations cannot be solved.
    pub(in crate::simulation) fn way_to_rest(&mut self, at: OperatingPoint<'_>) -> Option<f64> {
        let OperatingPoint {
            state,
            inputs,
            rate,
        } = at;
        let system = &self.assembled.system;
        let at = still(state);
        let mut model = DrivenSystem::new(system, inputs, &mut self.work, &at);
        let mut way = (model.accelerate(at.time, &at.coordinates, &at.rates)).to_vec();
        let solved = slow_response(system, inputs, &mut self.work, &at, rate, &mut way);
        solved.then(|| norm(&way) / (system.size() * system.mass().sqrt()))
    }

    /// Computes the response of quantities to an input that grows at the rate from a state at rest. `place` is the
    /// index of the input among `inputs`. Missing quantities are 0. `None` if the linearized equations cannot be
    /// solved.
    pub(in crate::simulation) fn slow_response(
        &mut self,
        at: OperatingPoint<'_>,
        place: usize,
        quantities: &[Option<Quantity>],
    ) -> Option<Vec<f64>> {
        let OperatingPoint { state, inputs, .. } = at;
        let system = &self.assembled.system;
        let full = SMALL * system.size() * system.mass().sqrt();
        let (mut change, mut way) = (FIRST, Vec::new());
        for _ in 0..2 {
            way = self.way(at, place, change)?;
            let size = norm(&way);
            if size <= 0.0 {
                return Some(vec![0.0; quantities.len()]);
            }
            change *= full / size;
        }
        let scale = full / norm(&way);
        // The change that belongs to the way as it is scaled.
        let mut sides = [1.0, -1.0].into_iter().map(|sign| {
            let mut at = still(state);
            let moved = at.coordinates.iter_mut().zip(&way);
            moved.for_each(|(q, way)| *q += sign * scale * way);
            let mut values = inputs.to_vec();
            values[place] += sign * change;
            let values = Inputs::at_rest(values);
            let system = &self.assembled.system;
            if !DrivenSystem::new(system, &values.values, &mut self.work, &at).project(&mut at) {
                return None;
            }
            self.forget();
            let read = quantities.iter().map(|quantity| {
                quantity.map_or(0.0, |quantity| self.output(quantity, &at, &values))
            });
            Some(read.collect::<Vec<f64>>())
        });
        let (up, down) = (sides.next()??, sides.next()??);
        let slope = up
            .iter()
            .zip(&down)
            .map(|(up, down)| (up - down) / (2.0 * change));
        let slope: Vec<f64> = slope.collect();
        slope.iter().all(|s| s.is_finite()).then_some(slope)
    }

    /// How coordinates move with a change of an input: as constraints carry them, and as forces bend them.
    fn way(&mut self, at: OperatingPoint<'_>, place: usize, change: f64) -> Option<Vec<f64>> {
        let OperatingPoint {
            state,
            inputs,
            rate,
        } = at;
        let system = &self.assembled.system;
        let mut sides = [1.0, -1.0].into_iter().map(|sign| {
            let mut values = inputs.to_vec();
            values[place] += sign * change;
            let mut at = still(state);
            let mut model = DrivenSystem::new(system, &values, &mut self.work, &at);
            if !model.project(&mut at) {
                return None;
            }
            let a = (model.accelerate(at.time, &at.coordinates, &at.rates)).to_vec();
            Some((at.coordinates, a))
        });
        let ((up, pushed), (down, pulled)) = (sides.next()??, sides.next()??);
        let half = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| 0.5 * (a - b)).collect()
        };
        let (carried, mut way) = (half(&up, &down), half(&pushed, &pulled));
        let at = still(state);
        let solved = slow_response(system, inputs, &mut self.work, &at, rate, &mut way);
        way.iter_mut().zip(carried).for_each(|(way, by)| *way += by);
        solved.then_some(way)
    }
}

/// Name of natural frequencies in error reports.
pub(super) const FREQUENCIES: &str = "natural frequencies";

/// Words for what inputs that are held would do, where errors are told.
pub(super) fn name(input: &str) -> String {
    format!("answer to {input}")
}
