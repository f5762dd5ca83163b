//! Rotations of rigid bodies from the frames that the state holds: vectors of Rodrigues, which begin at zero anew before they are large
//! (sources in `frame.rs`).

use nalgebra::Vector3;

use super::{Derivative, RigidBodyFrame, RotationMaps};
use crate::math::jet::Number;
use crate::math::rotation::{Quaternion, normalized, product};

/// How a body has turned from the frame that the state holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RotationIncrement {
    /// Rotation, rad.
    pub rotation: Vector3<f64>,
    /// Time derivative of `rotation`, rad/s.
    pub rate: Vector3<f64>,
    /// Angular velocity along the body's axes, rad/s.
    pub spin: Vector3<f64>,
}

/// Angular velocity along the turned axes at a rate of a rotation `p`.
pub(super) fn spin_of<N: Number>(p: &Vector3<N>, rate: &Vector3<N>) -> Vector3<N> {
    (rate - p.cross(rate) * N::of(0.5)) / (N::of(1.0) + N::of(0.25) * p.norm_squared())
}

/// Rate of a rotation `p` at an angular velocity along the turned axes.
pub(super) fn rate_of<N: Number>(p: &Vector3<N>, spin: &Vector3<N>) -> Vector3<N> {
    spin + p.cross(spin) * N::of(0.5) + p * (N::of(0.25) * p.dot(spin))
}

impl RotationIncrement {
    /// The quaternion, of any length, from that where the rotation is zero: on the same side of it, however far the body turned.
    pub(super) fn quaternion(&self, from: &Quaternion) -> Quaternion {
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
    fn second_of(&self, spin_rate: &Vector3<f64>) -> Vector3<f64> {
        let (p, rate, spin) = (self.rotation, self.rate, self.spin);
        let by_rate = rate.cross(&spin) * 0.5 + rate * (0.25 * p.dot(&spin));
        self.rate_of(spin_rate) + by_rate + p * (0.25 * rate.dot(&spin))
    }
}

impl RigidBodyFrame {
    /// The spin, or rate of it, about axes without inertia, for which the rotation about them stays zero.
    fn complete(&self, turn: &RotationIncrement, spin: &mut Vector3<f64>, by_rate: bool) {
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

    /// How it has turned at these coordinates.
    pub(super) fn turn(&self, q: &[f64]) -> RotationIncrement {
        RotationIncrement {
            rotation: self.read(q),
            ..RotationIncrement::default()
        }
    }

    fn write(&self, rotation: &Vector3<f64>, q: &mut [f64]) {
        for (place, value) in self.places.iter().zip(rotation) {
            if let Some((at, scale)) = place {
                q[*at] = value * scale;
            }
        }
    }
}

impl RotationMaps {
    /// Converts changes of `q` between small rotations about axes, or angular velocities and their derivatives, and rotations from the frames
    /// that the state holds.
    pub fn convert(&self, order: Derivative, turns: &[RotationIncrement], q: &mut [f64]) {
        for (frame, turn) in self.list.iter().zip(turns) {
            let mut spin = frame.read(q);
            let converted = match order {
                Derivative::First => {
                    frame.complete(turn, &mut spin, false);
                    turn.rate_of(&spin)
                }
                Derivative::Second => {
                    frame.complete(turn, &mut spin, true);
                    turn.second_of(&spin)
                }
                Derivative::Back => turn.spin_of(&spin),
            };
            frame.write(&converted, q);
        }
    }

    /// The largest rotation in coordinates, rad.
    pub fn largest(&self, q: &[f64]) -> f64 {
        let sizes = self.list.iter().map(|frame| frame.read(q).norm());
        sizes.fold(0.0, f64::max)
    }

    /// Rotations begin at zero anew: the frames become what they are, of unit length, and rates spins.
    pub fn renew(&self, frames: &mut [Quaternion], q: &mut [f64], v: &mut [f64]) {
        for (frame, from) in self.list.iter().zip(frames) {
            let mut turn = frame.turn(q);
            turn.spin = turn.spin_of(&frame.read(v));
            *from = normalized(turn.quaternion(from));
            frame.write(&Vector3::zeros(), q);
            frame.write(&turn.spin, v);
        }
    }
}
