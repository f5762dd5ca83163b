//! Natural modes of a scene, and what damping takes from them.

use super::engine::{Engine, OperatingPoint};
use super::{Simulation, TrialConditions};
use crate::scene::Scene;
use crate::system::{Mode, SpectrumError, State, damping_along, modes, natural_frequencies};

/// Natural frequencies of a scene about its initial state, at rest and without dampers.
#[derive(Clone, Debug, PartialEq)]
pub struct FirstFrequencies {
    /// The lowest frequencies, rad/s, ascending; negative for a motion that grows, zero for one that nothing resists.
    pub frequencies: Vec<f64>,
    /// Distance of the initial state from equilibrium, in sizes of the scene: root mean square displacement within the length of
    /// the experiment. `None` where it is not known.
    pub from_rest: Option<f64>,
}

/// Computes the `count` lowest natural frequencies of a scene with plain numbers, or all if there are fewer.
///
/// # Errors
/// Reason in words why there are none: a scene without a start, or one that the output `natural_frequency` refuses.
pub fn first_frequencies(
    scene: &Scene,
    given: &TrialConditions,
    count: usize,
) -> Result<FirstFrequencies, String> {
    let rate = 1.0 / scene.experiment.stop_time;
    let mut simulation = Simulation::new(scene.clone().without_outputs());
    given
        .set(&mut simulation)
        .map_err(|error| error.to_string())?;
    let started = simulation.initialize(0.0);
    started.map_err(|error| error.to_string())?;
    let (state, inputs) = (&simulation.state, &simulation.inputs.values);
    let engine = simulation.engine.as_mut().expect(super::ENGINE);
    let frequencies = engine.lowest_frequencies(state, inputs, count)?;
    let at = OperatingPoint {
        state,
        inputs,
        rate,
    };
    let from_rest = engine.way_to_rest(at).filter(|way| way.is_finite());
    Ok(FirstFrequencies {
        frequencies,
        from_rest,
    })
}

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

    /// Computes the `count` lowest natural frequencies at rest (rad/s), or all if there are fewer.
    ///
    /// # Errors
    /// Reason in words why they are not found.
    pub(super) fn lowest_frequencies(
        &mut self,
        state: &State,
        inputs: &[f64],
        count: usize,
    ) -> Result<Vec<f64>, String> {
        let (system, work) = (&self.assembled.system, &mut self.work);
        let found = match natural_frequencies(system, inputs, work, state, count) {
            Err(SpectrumError::Count(_, present)) => {
                natural_frequencies(system, inputs, work, state, present)
            }
            found => found,
        };
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
