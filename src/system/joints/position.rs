//! Joints that hold positions, all linear: pins, sliders on fixed lines, driven positions.

use nalgebra::Vector2;

use super::{Rows, Target};
use crate::body::left;
use crate::system::end::End;

/// Revolute joint: both ends are at the same place.
pub(super) fn pin(rows: &mut Rows<'_>) {
    for axis in [Vector2::x(), Vector2::y()] {
        hold(rows, axis, |way| Target::Fixed(way));
    }
}

/// Slider: the second end stays on the line through the first one (ground) along this unit direction.
pub(super) fn slider(rows: &mut Rows<'_>, along: Vector2<f64>) {
    hold(rows, left(along), |way| Target::Fixed(way));
}

/// The second end is where two driven coordinates say.
pub(super) fn drive(rows: &mut Rows<'_>, drives: [usize; 2]) {
    let none = Vector2::zeros();
    for (axis, drive) in [Vector2::x(), Vector2::y()].into_iter().zip(drives) {
        rows.push([none; 2], [axis, none], Target::Value(drive, 0.0));
    }
}

/// The second end is a driven way along a unit direction from the first one (ground).
pub(super) fn drive_along(rows: &mut Rows<'_>, along: Vector2<f64>, drive: usize) {
    hold(rows, along, |way| Target::Value(drive, way));
}

fn hold(rows: &mut Rows<'_>, axis: Vector2<f64>, target: impl Fn(f64) -> Target) {
    let none = Vector2::zeros();
    let way = match rows.ends[0] {
        End::Ground(point) => axis.dot(&point),
        End::Body(_) => 0.0,
    };
    rows.push([axis, none], [axis, none], target(way));
}
