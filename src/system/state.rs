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
    /// Angles of the markers that report one, counted on over full turns, rad.
    pub angles: Vec<f64>,
}

impl State {
    /// Copies another state of the same system without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        self.time = other.time;
        self.step = other.step;
        self.coordinates.copy_from_slice(&other.coordinates);
        self.rates.copy_from_slice(&other.rates);
        self.angles.copy_from_slice(&other.angles);
    }
}
