//! Revolute joint, a pin: both ends are at the same place. Linear.

use nalgebra::Vector2;

use super::{Rows, Target};

/// Holds the position.
pub(super) fn hold(rows: &mut Rows<'_>) {
    for axis in [Vector2::x(), Vector2::y()] {
        rows.hold_position(axis, Target::Fixed);
    }
}
