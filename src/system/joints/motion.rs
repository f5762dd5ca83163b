//! Motions: positions, ways along lines and angles that follow a driven coordinate.
//!
//! Positions are linear in nodal coordinates. So is the direction of a rigid body driven against the
//! ground; a driven slope, or an angle between two bodies, is not.

use nalgebra::Vector2;

use super::{ConstraintKind, Parallel, Rows, Target};
use crate::system::end::End;

/// The second end is where two driven coordinates say.
pub(super) fn position(rows: &mut Rows<'_>, drives: [usize; 2]) {
    let none = Vector2::zeros();
    for (axis, drive) in [Vector2::x(), Vector2::y()].into_iter().zip(drives) {
        rows.push([none; 2], [axis, none], Target::Value(drive, 0.0));
    }
}

/// The second end is a driven way along a unit direction from the first one (ground).
pub(super) fn way(rows: &mut Rows<'_>, along: Vector2<f64>, drive: usize) {
    rows.hold_position(along, |start| Target::Value(drive, start));
}

/// Drives the angle from the direction of the first end to that of the second.
pub(super) fn angle(rows: &mut Rows<'_>, drive: usize) -> Option<ConstraintKind> {
    let none = Vector2::zeros();
    let [first, second] = rows.ends;
    if matches!(first, End::Ground(_)) && second.is_rigid() {
        rows.push([none; 2], [none, Vector2::x()], Target::Cosine(drive));
        rows.push([none; 2], [none, Vector2::y()], Target::Sine(drive));
        return None;
    }
    Some(ConstraintKind::Parallel(Parallel {
        ends: [*first, *second],
        angle: 0.0,
        drive: Some(drive),
    }))
}
