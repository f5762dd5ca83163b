//! The state of a system: plain numbers. A clone of it is all that a rollback needs.

/// What the integrators in use got for their operations so far: plain numbers, so that a restored state goes on with
/// the same methods (`integrators/selection.rs`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pace {
    /// Index of the method in use: 0 or 1.
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

impl Pace {
    /// How many numbers it is.
    pub const NUMBERS: usize = 8;

    /// Its numbers.
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
        (self.method.max(0.0) as usize).min(count - 1)
    }
}

/// State at a point in time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Time, s.
    pub time: f64,
    /// Step that the integrator proposes next, s; 0 before the first.
    pub step: f64,
    /// What integrators got for their operations.
    pub pace: Pace,
    /// Generalized coordinates `q`, m sqrt(kg).
    pub coordinates: Vec<f64>,
    /// Their rates, m sqrt(kg) / s.
    pub rates: Vec<f64>,
    /// Angles that are counted on over full turns, rad.
    pub angles: Vec<f64>,
    /// Where slides are on their cables, m.
    pub travel: Vec<f64>,
    /// Motions that inputs drive: value and four derivatives.
    pub driven: Vec<[f64; 5]>,
    /// Work that came in from outside and that was dissipated since the start, J.
    pub work: [f64; 2],
}

impl State {
    /// Copies another state of the same system without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        self.time = other.time;
        self.step = other.step;
        self.pace = other.pace;
        self.coordinates.copy_from_slice(&other.coordinates);
        self.rates.copy_from_slice(&other.rates);
        self.angles.copy_from_slice(&other.angles);
        self.travel.copy_from_slice(&other.travel);
        self.driven.copy_from_slice(&other.driven);
        self.work = other.work;
    }

    /// Numbers of coordinates, rates, angles, slides and driven motions.
    pub fn sizes(&self) -> [usize; 5] {
        [
            self.coordinates.len(),
            self.rates.len(),
            self.angles.len(),
            self.travel.len(),
            self.driven.len(),
        ]
    }
}
