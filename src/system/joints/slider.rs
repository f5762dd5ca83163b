//! Slider on a fixed line: the second end stays on the line through the first one (ground). Linear.

use nalgebra::Vector2;

use super::{Rows, Target};
use crate::body::left;

/// Holds the position across this unit direction.
pub(super) fn hold(rows: &mut Rows<'_>, along: Vector2<f64>) {
    rows.hold_position(left(along), Target::Fixed);
}
