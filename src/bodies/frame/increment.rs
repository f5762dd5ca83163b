//! Rotations of rigid bodies from the frames that the state holds: vectors of Rodrigues, which begin at zero anew before they are large
//! (sources in `frame.rs`).

use nalgebra::Vector3;

use super::RigidBodyFrame;
use crate::math::jet::Number;
use crate::math::rotation::{Quaternion, product};

/// How a body has rotated from the frame that the state holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RotationIncrement {
    /// Rotation, rad.
    pub rotation: Vector3<f64>,
    /// Time derivative of `rotation`, rad/s.
    pub rate: Vector3<f64>,
    /// Angular velocity along the body's axes, rad/s.
    pub spin: Vector3<f64>,
}

/// The rotation by `p`: `v` in components along the rotated axes.
pub(in crate::bodies) fn turned_back<N: Number>(p: &Vector3<N>, v: &Vector3<N>) -> Vector3<N> {
    let across = p.cross(v);
    let scale = N::of(1.0) / (N::of(1.0) + N::of(0.25) * p.norm_squared());
    v - (across - p.cross(&across) * N::of(0.5)) * scale
}

/// Angular velocity along the rotated axes at a rate of a rotation `p`.
pub(in crate::bodies) fn spin_of<N: Number>(p: &Vector3<N>, rate: &Vector3<N>) -> Vector3<N> {
    (rate - p.cross(rate) * N::of(0.5)) / (N::of(1.0) + N::of(0.25) * p.norm_squared())
}

/// Rate of a rotation `p` at an angular velocity along the rotated axes.
pub(super) fn rate_of<N: Number>(p: &Vector3<N>, spin: &Vector3<N>) -> Vector3<N> {
    spin + p.cross(spin) * N::of(0.5) + p * (N::of(0.25) * p.dot(spin))
}

impl RotationIncrement {
    /// The quaternion, of any length, from that where the rotation is zero: on the same side of it, however far the body rotated.
    pub(in crate::bodies) fn quaternion(&self, from: &Quaternion) -> Quaternion {
        let half = self.rotation * 0.5;
        product(from, &[1.0, half.x, half.y, half.z])
    }

    /// Angular velocity along the body's axes at this rate.
    pub(super) fn spin_of(&self, rate: &Vector3<f64>) -> Vector3<f64> {
        spin_of(&self.rotation, rate)
    }

    /// Rate of the rotation, or its change, of a spin, or a small rotation about the body's axes.
    pub fn rate_of(&self, spin: &Vector3<f64>) -> Vector3<f64> {
        rate_of(&self.rotation, spin)
    }

    /// Second derivative of the rotation, of angular accelerations along the body's axes.
    pub(super) fn second_of(&self, spin_rate: &Vector3<f64>) -> Vector3<f64> {
        let (p, rate, spin) = (self.rotation, self.rate, self.spin);
        let by_rate = rate.cross(&spin) * 0.5 + rate * (0.25 * p.dot(&spin));
        self.rate_of(spin_rate) + by_rate + p * (0.25 * rate.dot(&spin))
    }
}

impl RigidBodyFrame {
    /// The spin, or rate of it, about axes without inertia, for which the rotation about them stays zero.
    pub(super) fn complete(
        &self,
        turn: &RotationIncrement,
        spin: &mut Vector3<f64>,
        by_rate: bool,
    ) {
        let (p, w) = (turn.rotation, turn.spin);
        for k in (0..3).filter(|k| self.places[*k].is_none()) {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            spin[k] = -0.5 * (p[i] * spin[j] - p[j] * spin[i]);
            if by_rate {
                let rate = turn.rate;
                spin[k] -= 0.5 * (rate[i] * w[j] - rate[j] * w[i]);
            }
        }
    }

    /// How it has rotated at these coordinates.
    pub(in crate::bodies) fn increment(&self, q: &[f64]) -> RotationIncrement {
        RotationIncrement {
            rotation: self.read(q),
            ..RotationIncrement::default()
        }
    }

    pub(in crate::bodies) fn write(&self, rotation: &Vector3<f64>, q: &mut [f64]) {
        for (place, value) in self.places.iter().zip(rotation) {
            if let Some((at, scale)) = place {
                q[*at] = value * scale;
            }
        }
    }
}
