//! The state of a system: plain numbers. A clone of it is all that a rollback needs.

/// State at a point in time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Time, s.
    pub time: f64,
    /// Step that the integrator proposes next, s; 0 before the first.
    pub step: f64,
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
