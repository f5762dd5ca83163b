//! What is driven: positions, distances along lines and angles that follow a driven coordinate.
//!
//! Positions are linear in nodal coordinates. So is the direction of a rigid body driven against the
//! ground; a driven slope, or an angle between two bodies, is not.

use crate::math::space::{Vector, axis};

use super::{AngleBetween, ConstraintKind, Rows, Target};
use crate::system::end::Attachment;

/// The second end is where driven coordinates say.
pub(super) fn position<const D: usize>(
    rows: &mut Rows<'_, D>,
    drives: [usize; D],
) -> Option<ConstraintKind<D>> {
    let none = Vector::zeros();
    for (k, drive) in drives.into_iter().enumerate() {
        rows.push([none; 2], [axis(k), none], Target::Value(drive, 0.0));
    }
    None
}

/// The second end is at a driven distance from the first one (ground) along a unit vector.
pub(super) fn distance<const D: usize>(
    rows: &mut Rows<'_, D>,
    along: Vector<D>,
    drive: usize,
) -> Option<ConstraintKind<D>> {
    rows.hold_position(along, |start| Target::Value(drive, start));
    None
}

/// Drives the angle from the direction of the first end to that of the second.
pub(super) fn direction<const D: usize>(
    rows: &mut Rows<'_, D>,
    drive: usize,
) -> Option<ConstraintKind<D>> {
    let none = Vector::zeros();
    let [first, second] = rows.ends;
    if matches!(first, Attachment::Ground(_)) && second.has_linear_direction() {
        rows.push([none; 2], [none, axis(0)], Target::Cosine(drive));
        rows.push([none; 2], [none, axis(1)], Target::Sine(drive));
        return None;
    }
    Some(ConstraintKind::AngleBetween(AngleBetween {
        ends: [*first, *second],
        angle: 0.0,
        drive: Some(drive),
    }))
}
