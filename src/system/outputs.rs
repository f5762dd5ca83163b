//! Quantities that follow from a state.

use nalgebra::Vector2;

use super::{Dynamics, Model, State, System, Work};
use crate::body::Marker;
use crate::elements::{Element, Nodal};

/// Coordinates, rates, accelerations and what constraints must supply, of all elements at one state.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// Coordinates, m.
    pub e: Vec<Nodal<2>>,
    /// Rates, m/s.
    pub rate: Vec<Nodal<2>>,
    /// Accelerations, m/s^2.
    pub acceleration: Vec<Nodal<2>>,
    /// `F - M e''`: minus the forces of connectivity and joints, N.
    pub lack: Vec<Nodal<2>>,
}

impl Evaluation {
    /// Storage for a system.
    pub fn new(system: &System) -> Self {
        let zero = vec![Nodal::zeros(); system.body.elements().len()];
        Self {
            e: zero.clone(),
            rate: zero.clone(),
            acceleration: zero.clone(),
            lack: zero,
        }
    }

    /// Computes coordinates and rates.
    pub fn kinematics(&mut self, system: &System, state: &State, work: &mut Work) {
        let border = &mut work.scratch.border;
        system
            .body
            .positions(&state.coordinates, border, &mut self.e);
        system.body.rates(&state.rates, border, &mut self.rate);
    }

    /// Computes accelerations and what constraints supply.
    pub fn dynamics(&mut self, system: &System, state: &State, inputs: &[f64], work: &mut Work) {
        let mut a = std::mem::take(&mut work.q);
        let mut model = Model::new(system, inputs, work);
        model.acceleration(&state.coordinates, &state.rates, &mut a);
        system
            .body
            .rates(&a, &mut work.scratch.border, &mut self.acceleration);
        work.q = a;
        self.lack.copy_from_slice(&work.scratch.force);
        system
            .body
            .subtract_inertia(&self.acceleration, &mut self.lack);
    }

    /// Rate of the direction of the slope at a marker, rad/s.
    pub fn angular_velocity(&self, marker: &Marker) -> f64 {
        let (u, du) = (marker.slope(&self.e), marker.slope(&self.rate));
        u.perp(&du) / u.norm_squared()
    }

    /// Axial strain and curvature (1/m) at a marker.
    pub fn strain(&self, system: &System, marker: &Marker) -> (f64, f64) {
        let element = marker.element;
        system.body.elements()[element].strain(&self.e[element], marker.xi)
    }

    /// Force of a joint on the body, N.
    pub fn reaction(&self, system: &System, joint: usize) -> Vector2<f64> {
        system.body.reaction(joint, &self.lack).force
    }

    /// Moment of a joint on the body, N m: `M` with slope force `M J r' / r'.r'`.
    pub fn reaction_moment(&self, system: &System, joint: usize) -> f64 {
        let node = system.joints[joint].node;
        let element = node.min(self.e.len() - 1);
        let u = self.e[element]
            .fixed_columns::<1>(2 * (node - element) + 1)
            .into_owned();
        u.perp(&system.body.reaction(joint, &self.lack).slope_force)
    }

    /// Kinetic energy, J.
    pub fn kinetic_energy(state: &State) -> f64 {
        0.5 * state.rates.iter().map(|v| v * v).sum::<f64>()
    }

    /// Strain energy, J.
    pub fn strain_energy(&self, system: &System) -> f64 {
        system.body.strain_energy(&self.e)
    }

    /// Potential energy of gravity, J; zero at the origin.
    pub fn gravity_energy(&self, system: &System) -> f64 {
        -system
            .weight
            .iter()
            .zip(&self.e)
            .map(|(w, e)| w.dot(e))
            .sum::<f64>()
    }
}
