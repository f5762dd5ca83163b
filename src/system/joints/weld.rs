//! Weld, a clamp: position and direction. A cable's slope keeps its direction, not its size: the cable
//! stretches freely up to the clamp.

use super::{ConstraintKind, Rows, orientation, revolute};
use crate::math::space::Vector;

/// Holds the position, and the direction at an angle from that of the first end.
pub(super) fn hold<const D: usize>(
    rows: &mut Rows<'_, D>,
    angle: f64,
) -> Option<ConstraintKind<D>> {
    revolute::hold(rows);
    orientation::hold(rows, angle)
}

/// Clamps a cable at the second end: its position, and its direction along a unit vector.
pub(super) fn clamp<const D: usize>(rows: &mut Rows<'_, D>, direction: &Vector<D>) {
    revolute::hold(rows);
    orientation::along(rows, direction);
}
