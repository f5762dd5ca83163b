//! Motions: positions, ways along lines and angles that follow a driven coordinate.
//!
//! Positions are linear in nodal coordinates. So is the direction of a rigid body driven against the
//! ground; a driven slope, or an angle between two bodies, is not.

use crate::math::space::{Vector, axis};

use super::{ConstraintKind, Parallel, Rows, Target};
use crate::system::end::End;

/// The second end is where two driven coordinates say.
pub(super) fn position<const D: usize>(rows: &mut Rows<'_, D>, drives: [usize; D]) {
    let none = Vector::zeros();
    for (k, drive) in drives.into_iter().enumerate() {
        rows.push([none; 2], [axis(k), none], Target::Value(drive, 0.0));
    }
}

/// The second end is a driven way along a unit direction from the first one (ground).
pub(super) fn way<const D: usize>(rows: &mut Rows<'_, D>, along: Vector<D>, drive: usize) {
    rows.hold_position(along, |start| Target::Value(drive, start));
}

/// Drives the angle from the direction of the first end to that of the second.
pub(super) fn angle<const D: usize>(
    rows: &mut Rows<'_, D>,
    drive: usize,
) -> Option<ConstraintKind<D>> {
    let none = Vector::zeros();
    let [first, second] = rows.ends;
    if matches!(first, End::Ground(_)) && second.is_rigid() {
        rows.push([none; 2], [none, axis(0)], Target::Cosine(drive));
        rows.push([none; 2], [none, axis(1)], Target::Sine(drive));
        return None;
    }
    Some(ConstraintKind::Parallel(Parallel {
        ends: [*first, *second],
        angle: 0.0,
        drive: Some(drive),
    }))
}
