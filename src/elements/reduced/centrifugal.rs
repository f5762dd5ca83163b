//! Centrifugal forces on a reduced body in a frame that rotates: derivatives of their potential `V = -W^T J W / 2`, where `W` is the rotation
//! of the frame along the axes of the body.
//!
//! Small rotations `p` of the body about its axes change `W` by `W x p + (W x p) x p / 2`.
//!
//! Source: R. Schwertassek, O. Wallrapp, Dynamik flexibler Mehrkörpersysteme (1999), chapter 6 (inertia in modes); A. A. Shabana, Dynamics of
//! Multibody Systems, 5th ed. (2020), section 3.6 (inertia in frames that move).

use nalgebra::{Matrix3, Vector3};

use super::inertia::times;
use super::{ModalTerms, ReducedModel};

/// Second derivatives of the potential of centrifugal forces by small rotations and amplitudes.
pub struct CentrifugalStiffness<'a> {
    /// The model.
    pub model: &'a ReducedModel,
    /// Amplitudes of the modes.
    pub eta: &'a [f64],
    /// Terms at these.
    pub terms: ModalTerms<'a>,
    /// Rotation of the frame along the axes of the body, rad/s.
    pub rotation: Vector3<f64>,
}

impl CentrifugalStiffness<'_> {
    /// By rotations, N m: `-A^T J A - (W L^T + L W^T) / 2 + L.W I` with `A p = W x p` and `L = J W`.
    pub fn of_rotations(&self) -> Matrix3<f64> {
        let (spin, inertia) = (self.rotation, self.model.inertia(self.eta, self.terms));
        let momentum = times(inertia, &spin);
        let moved = Matrix3::from_columns(&[0, 1, 2].map(|k| {
            let across = spin.cross(&Vector3::ith(k, 1.0));
            spin.cross(&times(inertia, &across))
        }));
        let outer = spin * momentum.transpose();
        moved - (outer + outer.transpose()) * 0.5
            + Matrix3::from_diagonal_element(momentum.dot(&spin))
    }

    /// By rotations and the amplitude of a mode: `W x J_k W`.
    pub fn of_rotation_and_mode(&self, k: usize) -> Vector3<f64> {
        let by_mode = self.terms.inertia()[k];
        self.rotation.cross(&times(by_mode, &self.rotation))
    }

    /// By the amplitudes of two modes, 1/s^2: `-W^T J2_kl W`.
    pub fn of_modes(&self, k: usize, l: usize) -> f64 {
        let second = self.model.inertia_2[self.model.modes() * k + l];
        -self.rotation.dot(&times(second, &self.rotation))
    }
}
