//! What a master sets while a simulation runs.

use crate::system::moved;

/// Inputs in the order of the system ([`crate::scene::Resolved::numbers`]).
pub(super) struct Inputs {
    pub values: Vec<f64>,
    /// First and second derivatives.
    pub slopes: Vec<[f64; 2]>,
    /// Whether the derivatives are of the next step; else they are of the one before.
    pub moving: bool,
    /// Values at the beginning of the last step.
    pub held: Vec<f64>,
}

impl Inputs {
    /// At rest at these values.
    pub(super) fn at_rest(values: Vec<f64>) -> Self {
        Self {
            slopes: vec![[0.0; 2]; values.len()],
            held: values.clone(),
            values,
            moving: false,
        }
    }

    /// Moves on by a time, s.
    pub(super) fn advance(&mut self, t: f64) {
        for (value, [first, second]) in self.values.iter_mut().zip(&mut self.slopes) {
            [*value, *first] = moved([*value, *first, *second], t);
        }
    }

    /// Forgets derivatives of the step before, which has passed.
    pub(super) fn drop_slopes(&mut self) {
        if !self.moving {
            self.slopes.fill([0.0; 2]);
        }
    }

    /// A step begins; whether inputs move in it, and whether they are held as in the one before.
    pub(super) fn begin_step(&mut self) -> (bool, bool) {
        self.drop_slopes();
        let moves = std::mem::take(&mut self.moving);
        let is_held = !moves && self.held == self.values;
        self.held.copy_from_slice(&self.values);
        (moves, is_held)
    }
}
