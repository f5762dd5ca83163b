//! Slider on a fixed line: the second end stays on the line through the first one (ground). Linear.

use crate::math::space::{Vector, normals};

use super::{Rows, Target};

/// Holds the position across this unit direction.
pub(super) fn hold<const D: usize>(rows: &mut Rows<'_, D>, along: Vector<D>) {
    for normal in normals(&along) {
        rows.hold_position(normal, Target::Fixed);
    }
}
