//! The state of a system: plain numbers. A clone of it is all that a rollback needs.

use crate::math::rotation::Quaternion;

/// Statistics of the integrators in use: time advanced and operations spent. These are plain numbers, so a restored
/// state continues with the same methods (`integrators/selection.rs`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MethodStatistics {
    /// Index of the method in use, 0 or 1; 2 more where the explicit one goes on with its second tableau.
    pub method: f64,
    /// Steps of a trial that are still to be measured; 0 outside a trial.
    pub trial: f64,
    /// Operations since the last trial, or of the one under way.
    pub cost: f64,
    /// Time that the method in use has advanced since it is measured, s, and operations that it took.
    pub time: f64,
    /// See `time`.
    pub operations: f64,
    /// Time that the other method advanced with an operation when it was last in use, s; 0 before that.
    pub other: f64,
    /// Step that the other method proposes next, s; 0 before its first.
    pub step: f64,
    /// Operations from the last trial to the next.
    pub pause: f64,
}

impl MethodStatistics {
    /// How many numbers it is.
    pub const NUMBERS: usize = 8;

    /// Returns the fields as numbers, in the order of a saved state.
    pub fn numbers(&self) -> [f64; Self::NUMBERS] {
        [
            self.method,
            self.trial,
            self.cost,
            self.time,
            self.operations,
            self.other,
            self.step,
            self.pause,
        ]
    }

    /// From its numbers.
    pub fn from_numbers(numbers: [f64; Self::NUMBERS]) -> Self {
        let [method, trial, cost, time, operations, other, step, pause] = numbers;
        Self {
            method,
            trial,
            cost,
            time,
            operations,
            other,
            step,
            pause,
        }
    }

    /// Index of the method in use among `count`.
    pub fn index(&self, count: usize) -> usize {
        (self.method.max(0.0) as usize % 2).min(count - 1)
    }

    /// Index of the tableau that the explicit method goes on with: 0 or 1.
    pub fn variant(&self) -> usize {
        usize::from(self.method >= 2.0)
    }

    /// The explicit method goes on with this tableau.
    pub fn set_variant(&mut self, variant: usize) {
        self.method = (self.index(2) + 2 * variant) as f64;
    }

    /// The other method goes on.
    pub fn change(&mut self) {
        self.method = (1 - self.index(2) + 2 * self.variant()) as f64;
    }
}

/// A step that leads beyond the time at which the state stands, to be read in between: where it began, and the stages
/// of its collocation polynomial. Plain numbers: inputs that change take it back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DenseStep {
    /// Start of the step, s.
    pub start: f64,
    /// Length of the step, s. It is 0 if there is no step.
    pub length: f64,
    /// Whether it is under way (1) or over (0): then it is what the next one begins with.
    pub under_way: f64,
    /// Operations that it has taken.
    pub operations: f64,
    /// The longest step for which equations could be solved when it was taken, s.
    pub ceiling: f64,
    /// Communication points in a row at which inputs stayed as they were.
    pub held: f64,
    /// Work at its start that came in from outside and that was dissipated, J.
    pub work: [f64; 2],
    /// Power of both kinds at its stages, W.
    pub powers: [[f64; 2]; Self::STAGES],
    /// Coordinates and rates at its start, and what coordinates change by to each of its stages, one after another.
    pub vectors: Vec<f64>,
}

impl DenseStep {
    /// How many stages it has.
    pub const STAGES: usize = 3;
    /// How many vectors of coordinates it holds.
    const VECTORS: usize = 2 + Self::STAGES;
    /// How many numbers it is beside the vectors.
    pub const NUMBERS: usize = 14;

    /// None under way, for so many coordinates.
    pub fn blank(coordinates: usize) -> Self {
        Self {
            vectors: vec![0.0; Self::VECTORS * coordinates],
            ..Self::default()
        }
    }

    /// Returns the scalar fields as numbers, in the order of a saved state.
    pub fn numbers(&self) -> [f64; Self::NUMBERS] {
        let [[a, b], [c, d], [e, f]] = self.powers;
        let [input, lost] = self.work;
        [
            self.start,
            self.length,
            self.under_way,
            self.operations,
            self.ceiling,
            self.held,
            input,
            lost,
            a,
            b,
            c,
            d,
            e,
            f,
        ]
    }

    /// From its numbers.
    pub fn from_numbers(numbers: [f64; Self::NUMBERS], vectors: Vec<f64>) -> Self {
        let [
            start,
            length,
            under_way,
            operations,
            ceiling,
            held,
            input,
            lost,
            powers @ ..,
        ] = numbers;
        let [a, b, c, d, e, f] = powers;
        Self {
            start,
            length,
            under_way,
            operations,
            ceiling,
            held,
            work: [input, lost],
            powers: [[a, b], [c, d], [e, f]],
            vectors,
        }
    }

    /// Whether a step is under way.
    pub fn is_under_way(&self) -> bool {
        self.under_way > 0.0
    }

    /// Whether it is over, and ended at a time (s).
    pub fn has_ended_at(&self, time: f64) -> bool {
        self.length > 0.0 && !self.is_under_way() && self.end() == time
    }

    /// A communication step begins, under the inputs of the one before or under others, which take the step back.
    pub fn begin_point(&mut self, is_held: bool) {
        if !is_held {
            self.forget(0.0);
        }
        self.held += 1.0;
    }

    /// Discards the step. The next step may be kept after `points` further communication points.
    pub fn forget(&mut self, points: f64) {
        (self.length, self.under_way, self.held) = (0.0, 0.0, 0.0 - points);
    }

    /// Where it ends, s.
    pub fn end(&self) -> f64 {
        self.start + self.length
    }

    /// Coordinates and rates at its start, then the stages.
    pub fn parts(&self) -> [&[f64]; Self::VECTORS] {
        let n = self.vectors.len() / Self::VECTORS;
        std::array::from_fn(|k| &self.vectors[k * n..(k + 1) * n])
    }

    /// One of [`Self::parts`], to be written.
    pub fn part_mut(&mut self, k: usize) -> &mut [f64] {
        let n = self.vectors.len() / Self::VECTORS;
        &mut self.vectors[k * n..(k + 1) * n]
    }

    fn copy_from(&mut self, other: &Self) {
        let mut vectors = std::mem::take(&mut self.vectors);
        vectors.copy_from_slice(&other.vectors);
        *self = Self::from_numbers(other.numbers(), vectors);
    }
}

/// State at a point in time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Time, s.
    pub time: f64,
    /// Step that the integrator proposes next, s; 0 before the first.
    pub step: f64,
    /// Cost statistics of the integrators.
    pub pace: MethodStatistics,
    /// Generalized coordinates `q`, m sqrt(kg).
    pub coordinates: Vec<f64>,
    /// Rates of the coordinates, m sqrt(kg) / s.
    pub rates: Vec<f64>,
    /// Frames of rigid bodies in space, from which their rotations among the coordinates are counted: unit quaternions of their
    /// principal axes, whose signs go on over full turns.
    pub frames: Vec<Quaternion>,
    /// Angles that are counted on over full turns, rad.
    pub angles: Vec<f64>,
    /// Where slides are on their cables, m.
    pub travel: Vec<f64>,
    /// Release state of every joint that can be released: 1 when released, 0 otherwise.
    pub released: Vec<f64>,
    /// Motions that inputs drive: value and four derivatives.
    pub driven: Vec<[f64; 5]>,
    /// Work that came in from outside and that was dissipated since the start, J.
    pub work: [f64; 2],
    /// The step within which it stands.
    pub dense: DenseStep,
}

impl State {
    /// Copies another state of the same system without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        self.time = other.time;
        self.step = other.step;
        self.pace = other.pace;
        self.coordinates.copy_from_slice(&other.coordinates);
        self.rates.copy_from_slice(&other.rates);
        self.frames.copy_from_slice(&other.frames);
        self.angles.copy_from_slice(&other.angles);
        self.travel.copy_from_slice(&other.travel);
        self.released.copy_from_slice(&other.released);
        self.driven.copy_from_slice(&other.driven);
        self.work = other.work;
        self.dense.copy_from(&other.dense);
    }

    /// Numbers of coordinates, rates, frames, angles, slides, releases and driven motions, and of the vectors
    /// of a dense step.
    pub fn sizes(&self) -> [usize; 8] {
        [
            self.coordinates.len(),
            self.rates.len(),
            self.frames.len(),
            self.angles.len(),
            self.travel.len(),
            self.released.len(),
            self.driven.len(),
            self.dense.vectors.len(),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tableau_outlasts_a_change_of_the_method() {
        let mut pace = MethodStatistics::default();
        pace.set_variant(1);
        assert_eq!((pace.index(2), pace.variant()), (0, 1));
        pace.change();
        assert_eq!((pace.index(2), pace.index(1), pace.variant()), (1, 0, 1));
        pace.set_variant(0);
        assert_eq!((pace.index(2), pace.variant()), (1, 0));
        pace.change();
        assert_eq!(pace, MethodStatistics::default());
    }
}
