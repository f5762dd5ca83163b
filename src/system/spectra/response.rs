//! Slow responses about a state: displacements that grow as `e^(s t)` under forces that do.

use crate::bodies::no_node;
use crate::system::{DrivenSystem, Dynamics, State, System, Workspace};

/// Solves `(s^2 I + K) d = a` for accelerations `a` that forces make at a state, without dampers and rates; `rate` is `s`, 1/s. Where
/// `s` is far below all natural frequencies `d` is the static answer; what nothing holds moves by its inertia.
/// False where that is singular.
pub fn slow_response<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
    rate: f64,
    accelerations: &mut [f64],
) -> bool {
    let rest = vec![0.0; state.rates.len()];
    DrivenSystem::new(system, inputs, work, state).linearize(state.time, &state.coordinates, &rest);
    // What is driven stands still too.
    work.kinematics.v.fill(no_node());
    let linear = system.linearization(state.time, work, true);
    let solved = linear
        .shifted(rate)
        .map(|mut factors| factors.solve(accelerations));
    solved == Some(true) && accelerations.iter().all(|d| d.is_finite())
}
