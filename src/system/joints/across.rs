//! A point on a line of a body: `(A u1) x (r2 - r1) = 0`, `A` the fixed turn from the direction `u1` of the first
//! end to the line. On the ground the line stands still and the row is linear.

use nalgebra::{Matrix2, Vector2};

use super::{ConstraintKind, Gradient, Rows, View, slider};
use crate::body::{NodeBlock, left};
use crate::math::jet::Number;
use crate::system::end::{End, bilinear};

/// The second end on a line through the first, which turns with it.
#[derive(Clone, Debug)]
pub struct Across {
    /// The ends.
    pub ends: [End; 2],
    /// Unit direction of the line in the axes of the first end.
    pub along: Vector2<f64>,
    /// What residuals are relative to, m.
    pub size: f64,
}

/// Holds the position of the second end across a line through the first; `size` is their distance, m.
pub(super) fn hold(rows: &mut Rows<'_>, along: Vector2<f64>, size: f64) -> Option<ConstraintKind> {
    if let End::Ground(_) = rows.ends[0] {
        slider::hold(rows, along);
        return None;
    }
    let size = if size > 0.0 { size } else { 1.0 };
    let ends = *rows.ends;
    Some(ConstraintKind::Across(Across { ends, along, size }))
}

impl Across {
    /// What belongs to the direction of the first end, turned to the line.
    fn turned<N: Number>(&self, direction: Vector2<N>) -> Vector2<N> {
        direction * N::of(self.along.x) + left(direction) * N::of(self.along.y)
    }

    /// Direction of the line, and the way between the ends.
    fn line<N: Number>(&self, view: &View<'_, N>) -> [Vector2<N>; 2] {
        let [first, second] = self.ends.map(|end| end.lift());
        let way = second.position(view.x) - first.position(view.x);
        [self.turned(first.direction(view.x)), way]
    }

    pub(super) fn value<N: Number>(&self, view: &View<'_, N>) -> N {
        let [line, way] = self.line(view);
        line.perp(&way)
    }

    pub(super) fn gradient<N: Number>(&self, view: &View<'_, N>) -> Gradient<N> {
        let [first, second] = self.ends.map(|end| end.lift());
        let [line, way] = self.line(view);
        // (A u) x d = u . A^T (-left d)
        let back = left(way) * N::of(self.along.x) + way * N::of(self.along.y);
        let none = Vector2::zeros();
        Gradient {
            ends: [(first, [-left(line), -back]), (second, [left(line), none])],
        }
    }

    pub(super) fn bias<N: Number>(&self, view: &View<'_, N>) -> N {
        let [first, second] = self.ends.map(|end| end.lift());
        let speed = second.velocity(view.v) - first.velocity(view.v);
        let turning = self.turned(first.direction_rate(view.v));
        N::of(2.0) * turning.perp(&speed)
    }

    pub(super) fn stiffness(&self, lambda: f64, add: &mut dyn FnMut(usize, usize, &NodeBlock<4>)) {
        let [End::Body(first), End::Body(second)] = &self.ends else {
            return;
        };
        // d^2 g = (A du1) x (dr2 - dr1)
        let (x, y) = (self.along.x, self.along.y);
        let cross = Matrix2::new(-y, x, -x, -y) * lambda;
        bilinear([(first, 1), (second, 0)], cross, add);
        bilinear([(first, 1), (first, 0)], -cross, add);
    }
}
