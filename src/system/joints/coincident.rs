//! Points of two bodies coincide: linear rows. Where a pin joins so many bodies that eliminating it would tie all of them
//! together, a constraint along every axis, `n . (r2 - r1) = 0`.

use super::{ConstraintKind, Gradient, Rows, Target, View};
use crate::math::jet::Number;
use crate::math::space::{Vector, axis};
use crate::system::end::End;

/// Two points that coincide along an axis.
#[derive(Clone, Debug)]
pub struct Coincident<const D: usize> {
    /// The points.
    pub ends: [End<D>; 2],
    /// Index of the axis.
    pub axis: usize,
    /// What residuals are relative to, m.
    pub size: f64,
}

/// Holds the position.
pub(super) fn hold<const D: usize>(rows: &mut Rows<'_, D>) -> Option<ConstraintKind<D>> {
    for k in 0..D {
        rows.hold_position(axis(k), Target::Fixed);
    }
    None
}

impl<const D: usize> Coincident<D> {
    /// The pin between two ends, axis by axis.
    pub fn pin(ends: [End<D>; 2]) -> impl Iterator<Item = Self> {
        let arm = |end: &End<D>| end.marker().map_or(0.0, |marker| marker.arm());
        let size = ends.iter().map(arm).fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        (0..D).map(move |axis| Self { ends, axis, size })
    }

    pub(super) fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let [a, b] = self.ends.map(|end| end.lift().position(view.x));
        b[self.axis] - a[self.axis]
    }

    pub(super) fn gradient<N: Number>(&self, _: &View<'_, D, N>) -> Gradient<D, N> {
        let (none, along) = (Vector::zeros(), axis(self.axis));
        let [a, b] = self.ends.map(|end| end.lift());
        Gradient {
            ends: [(a, [-along, none]), (b, [along, none])],
        }
    }

    pub(super) fn bias<N: Number>(&self, _: &View<'_, D, N>) -> N {
        N::of(0.0)
    }
}
