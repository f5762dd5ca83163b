//! Natural modes at rest: how a system swings, and what damping takes from it on these ways.

use nalgebra::DMatrix;

use super::dense::ROUNDOFF;
use super::iteration::{self, NoEigenvalues, SLOW};
use super::linearization::Linearization;
use super::spectrum::{MIDDLE, SpectrumError, at_rest, is_small};
use crate::bodies::no_node;
use crate::system::{DrivenSystem, Dynamics, State, System, Workspace};

/// A natural mode without dampers.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Square of its angular frequency, rad^2/s^2; negative where the state is not stable, zero where nothing resists.
    pub square: f64,
    /// Displacements of the coordinates, of length 1: its kinetic energy at the unit rate is 1/2.
    pub way: Vec<f64>,
}

/// Modes of the symmetric part of `K` in a basis, ascending; what is roundoff of its terms is zero.
pub(super) fn in_basis<const D: usize>(
    linear: &Linearization<'_, D>,
    basis: &[Vec<f64>],
) -> Option<Vec<Mode>> {
    let [stiffness, _] = linear.project(basis);
    let symmetric: DMatrix<f64> = (&stiffness + stiffness.transpose()) * 0.5;
    let eigen = symmetric.try_symmetric_eigen(f64::EPSILON, 100 * basis.len().max(1))?;
    let largest = eigen.eigenvalues.amax();
    let mode = |i: usize| {
        let mut way = vec![0.0; basis[0].len()];
        for (column, factor) in basis.iter().zip(eigen.eigenvectors.column(i).iter()) {
            let parts = way.iter_mut().zip(column);
            parts.for_each(|(x, c)| *x += factor * c);
        }
        let value = eigen.eigenvalues[i];
        let is_certain =
            value.abs() > SLOW * largest || value.abs() > ROUNDOFF * (linear.size(&way) + largest);
        let square = if is_certain { value } else { 0.0 };
        Mode { square, way }
    };
    let mut modes: Vec<Mode> = (0..basis.len()).map(mode).collect();
    modes.sort_by(|a, b| a.square.total_cmp(&b.square));
    Some(modes)
}

/// Modes at rest, without dampers and without the gyroscopic forces of a rotating frame, ascending: so many at least, or all that there are.
///
/// # Errors
/// Loads that follow, and what the iteration does not find.
pub fn modes<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
    count: usize,
) -> Result<Vec<Mode>, SpectrumError> {
    let linear = at_rest(system, inputs, work, state)?;
    let count = count.min(linear.modes());
    if count == 0 {
        return Ok(Vec::new());
    }
    let all = |linear: &Linearization<'_, D>| {
        in_basis(linear, &linear.dense().0).ok_or(SpectrumError::NotFinite)
    };
    if is_small(&linear, count) {
        return all(&linear);
    }
    let found = if linear.terms.is_symmetric && !system.is_rotating() {
        iteration::lowest(system, work, &linear, count)
    } else {
        Err(NoEigenvalues::Missing(count))
    };
    match found {
        Err(NoEigenvalues::Missing(_)) if linear.elimination.coordinates() <= MIDDLE => {
            all(&linear)
        }
        found => Ok(found?),
    }
}

/// Computes the damping at rest along displacements `w` in coordinates: `w^T R w`, 1/s if these have length 1.
pub fn damping_along<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
    ways: &[Vec<f64>],
) -> Vec<f64> {
    let rest = vec![0.0; state.rates.len()];
    DrivenSystem::new(system, inputs, work, state).linearize(state.time, &state.coordinates, &rest);
    // What is driven stands still too.
    work.kinematics.v.fill(no_node());
    let linear = system.linearization(state.time, work, false);
    let [_, damping] = linear.project(ways);
    (0..ways.len()).map(|k| damping[(k, k)]).collect()
}
