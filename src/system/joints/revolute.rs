//! Revolute joint, a pin: both ends are at the same place. Linear.

use crate::math::space::axis;

use super::{Rows, Target};

/// Holds the position.
pub(super) fn hold<const D: usize>(rows: &mut Rows<'_, D>) {
    for k in 0..D {
        rows.hold_position(axis(k), Target::Fixed);
    }
}
