//! Releases of joints: from a time on, or from the first step that begins with an input above zero. Their constraints keep multipliers. Once
//! released, a constraint is identically zero and does not count. A release is not an impact: positions and velocities stay continuous.

use super::Constraint;
use super::latch::LatchConditions;
use crate::math::switches::grain;
use crate::system::{FrictionState, Kinematics, State};

/// Release of a constraint: at a time or by an input for good, by a latch that opens, or by friction that slides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Release {
    /// At this time, s.
    pub time: Option<f64>,
    /// In the first step that begins with this input above 0.
    pub input: Option<usize>,
    /// The latch that it belongs to: one that is open counts as released.
    pub latch: Option<LatchConditions>,
    /// The friction that it belongs to: one that slides counts as released.
    pub friction: Option<FrictionState>,
}

impl Release {
    /// Whether its time has come at a time, s.
    pub(in crate::system) fn is_due(&self, time: f64) -> bool {
        self.time.is_some_and(|due| due <= time + grain(time))
    }
}

impl<const D: usize> Constraint<D> {
    /// Whether the joint of the constraint is released.
    pub(in crate::system) fn is_released(&self, released: &[bool]) -> bool {
        self.release.is_some_and(|place| released[place])
    }
}

impl<const D: usize> Kinematics<D> {
    /// Copies the released joints of a state, and releases those that are due by its time.
    pub(in crate::system) fn release(&mut self, state: &State) {
        let told = state.released.iter().zip(&self.releases);
        for (is_released, (told, release)) in self.released.iter_mut().zip(told) {
            *is_released = *told > 0.0 || release.is_due(state.time);
        }
    }

    /// Releases the joints that are due at a time (s), or by inputs.
    pub(in crate::system) fn release_at(&mut self, time: f64, inputs: &[f64]) {
        for (is_released, release) in self.released.iter_mut().zip(&self.releases) {
            let is_told = release.input.is_some_and(|input| inputs[input] > 0.0);
            *is_released |= is_told || release.is_due(time);
        }
    }
}
