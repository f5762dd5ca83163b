//! Weld, a clamp: position and direction. A cable's slope keeps its direction, not its size: the cable
//! stretches freely up to the clamp.

use super::{ConstraintKind, Rows, orientation, revolute};

/// Holds the position, and the direction at an angle from that of the first end.
pub(super) fn hold(rows: &mut Rows<'_>, angle: f64) -> Option<ConstraintKind> {
    revolute::hold(rows);
    orientation::hold(rows, angle)
}
