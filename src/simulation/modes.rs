//! Natural modes of a scene, and what damping takes from them.

use super::engine::Engine;
use crate::system::{Mode, SpectrumError, State, damping_along, modes};

impl<const D: usize> Engine<D> {
    /// Computes at least `count` lowest modes at rest, or all if there are fewer.
    ///
    /// # Errors
    /// Reason in words why they are not found.
    pub(super) fn modes(
        &mut self,
        state: &State,
        inputs: &[f64],
        count: usize,
    ) -> Result<Vec<Mode>, String> {
        let system = &self.assembled.system;
        let found = modes(system, inputs, &mut self.work, state, count);
        found.map_err(|error| in_words(&self.bodies, error))
    }

    /// Computes the damping at rest along displacements in coordinates, 1/s.
    pub(super) fn damping_along(
        &mut self,
        state: &State,
        inputs: &[f64],
        ways: &[Vec<f64>],
    ) -> Vec<f64> {
        damping_along(&self.assembled.system, inputs, &mut self.work, state, ways)
    }
}

/// Why there is no spectrum.
pub(super) fn in_words(bodies: &[String], error: SpectrumError) -> String {
    match error {
        SpectrumError::NotConservative(body) => format!(
            "expected forces with a potential, found one that follows {:?}; \"eigenvalue\" takes it",
            bodies[body]
        ),
        other => other.to_string(),
    }
}
