//! A point on a line of a body: `(A u1) x (r2 - r1) = 0`, `A` the fixed rotation from the direction `u1` of the first
//! end to the line. On the ground the line stands still and the row is linear.

use nalgebra::SMatrix;

use super::{ConstraintKind, Equation, Gradient, Rows, Target, View};
use crate::bodies::Bodies;
use crate::math::jet::Number;
use crate::math::space::{Vector, axis, cross, normals, perpendicular};
use crate::system::end::{Add, Attachment, bilinear};

/// The second end on a line through the first, which rotates with it.
#[derive(Clone, Debug)]
pub struct PointOnLine<const D: usize> {
    /// The ends.
    pub ends: [Attachment<D>; 2],
    /// UnitLength direction of the line in the axes of the first end.
    pub along: Vector<D>,
    /// Reference size of residuals, m.
    pub size: f64,
}

/// Holds the position of the second end across a line through the first.
pub(super) fn hold<const D: usize>(
    rows: &mut Rows<'_, D>,
    along: Vector<D>,
) -> Option<ConstraintKind<D>> {
    if let Attachment::Ground(_) = rows.ends[0] {
        for normal in normals(&along) {
            rows.hold_position(normal, Target::Fixed);
        }
        return None;
    }
    let ends = *rows.ends;
    let distance = (ends[1].position(rows.nodes) - ends[0].position(rows.nodes)).norm();
    let size = if distance > 0.0 { distance } else { 1.0 };
    Some(ConstraintKind::PointOnLine(PointOnLine {
        ends,
        along,
        size,
    }))
}

impl<const D: usize> PointOnLine<D> {
    /// Rotates a direction of the first end to that of the line.
    fn turned<N: Number>(&self, direction: Vector<D, N>) -> Vector<D, N> {
        direction * N::of(self.along[0]) + perpendicular(direction) * N::of(self.along[1])
    }

    /// Direction of the line, and the way between the ends.
    fn line<N: Number>(&self, view: &View<'_, D, N>) -> [Vector<D, N>; 2] {
        let [first, second] = self.ends.map(|end| end.lift());
        let way = second.position(view.x) - first.position(view.x);
        [self.turned(first.direction(view.x)), way]
    }

    pub(super) fn gradient<N: Number>(&self, view: &View<'_, D, N>) -> Gradient<D, N> {
        let [first, second] = self.ends.map(|end| end.lift());
        let [line, way] = self.line(view);
        // (A u) x d = u . A^T (-perpendicular d)
        let back = perpendicular(way) * N::of(self.along[0]) + way * N::of(self.along[1]);
        let none = Vector::zeros();
        Gradient {
            ends: [
                (first, [-perpendicular(line), -back]),
                (second, [perpendicular(line), none]),
            ],
        }
    }
}

impl<const D: usize> Equation<D> for PointOnLine<D> {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let [line, way] = self.line(view);
        cross(&line, &way)
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let [first, second] = self.ends.map(|end| end.lift());
        let speed = second.velocity(view.v) - first.velocity(view.v);
        let turning = self.turned(first.direction_rate(view.v));
        N::of(2.0) * cross(&turning, &speed)
    }

    fn stiffness(&self, lambda: f64, _view: &View<'_, D>, add: Add<'_, D>) {
        let [Attachment::Body(first), Attachment::Body(second)] = &self.ends else {
            return;
        };
        // d^2 g = (A du1) x (dr2 - dr1)
        let by = |axis: Vector<D>| perpendicular(self.turned(axis));
        let cross = SMatrix::from_fn(|r, c| by(axis(r))[c]) * lambda;
        bilinear([(first, 1), (second, 0)], cross, add);
        bilinear([(first, 1), (first, 0)], -cross, add);
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.ends.to_vec()
    }

    fn size(&self, _bodies: &Bodies<D>) -> f64 {
        self.size
    }

    fn is_stiff(&self) -> bool {
        true
    }
}
