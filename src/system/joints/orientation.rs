//! Orientation joint: the direction of the second end keeps its angle from that of the first. With a
//! slider it makes a prismatic joint.
//!
//! Where both ends keep the length of their directions (rigid bodies, the ground), the second is the
//! first one turned: linear. A cable's slope may stretch: against the ground only the component across
//! is held, which is linear too; otherwise the cross product vanishes, which is not.

use nalgebra::{Rotation2, Vector2};

use super::{ConstraintKind, Gradient, Rows, Target, View};
use crate::body::{NodeBlock, left};
use crate::math::jet::Number;
use crate::system::end::{End, bilinear};

/// A direction at an angle from another: `(R(angle) u1) x u2 = 0`.
#[derive(Clone, Debug)]
pub struct Parallel {
    /// The two directions.
    pub ends: [End; 2],
    /// Fixed angle, rad.
    pub angle: f64,
    /// Driven coordinate to add to it.
    pub drive: Option<usize>,
}

/// Holds the direction of the second end at a fixed angle from that of the first.
pub(super) fn hold(rows: &mut Rows<'_>, angle: f64) -> Option<ConstraintKind> {
    let none = Vector2::zeros();
    let turned = Rotation2::new(angle) * Vector2::x();
    let [first, second] = rows.ends;
    match (first, second.is_rigid()) {
        (End::Ground(_), true) => {
            for (axis, value) in [(Vector2::x(), turned.x), (Vector2::y(), turned.y)] {
                rows.push([none; 2], [none, axis], Target::Fixed(value));
            }
        }
        (End::Ground(_), false) => {
            rows.push([none; 2], [none, left(turned)], Target::Fixed(0.0));
        }
        (End::Body(_), true) if first.is_rigid() => {
            for axis in [Vector2::x(), Vector2::y()] {
                let back = Rotation2::new(-angle) * axis;
                rows.push([none, back], [none, axis], Target::Fixed(0.0));
            }
        }
        _ => {
            return Some(ConstraintKind::Parallel(Parallel {
                ends: [*first, *second],
                angle,
                drive: None,
            }));
        }
    }
    None
}

impl Parallel {
    /// The turned first direction, and its first two derivatives in time but for the part of
    /// accelerations.
    fn turned<N: Number>(&self, view: &View<'_, N>) -> [Vector2<N>; 3] {
        let [theta, rate, second] = self.drive.map_or([N::of(0.0); 3], |i| view.drives[i]);
        let (turn, first) = (
            Rotation2::new(theta + N::of(self.angle)),
            self.ends[0].lift(),
        );
        let w = turn * first.direction(view.x);
        let moved = turn * first.direction_rate(view.v);
        let bias = left(moved) * (N::of(2.0) * rate) + left(w) * second - w * (rate * rate);
        [w, moved + left(w) * rate, bias]
    }

    pub(super) fn value<N: Number>(&self, view: &View<'_, N>) -> N {
        self.turned(view)[0].perp(&self.ends[1].lift().direction(view.x))
    }

    pub(super) fn gradient<N: Number>(&self, view: &View<'_, N>) -> Gradient<N> {
        let none = Vector2::zeros();
        let theta = self.drive.map_or(N::of(0.0), |i| view.drives[i][0]);
        let back = Rotation2::new(-theta - N::of(self.angle));
        let [first, second] = self.ends.map(|end| end.lift());
        let (w, u) = (self.turned(view)[0], second.direction(view.x));
        // w x u = w . (-left u) = u . left w
        Gradient {
            ends: [
                (first, [none, -(back * left(u))]),
                (second, [none, left(w)]),
            ],
        }
    }

    pub(super) fn rate<N: Number>(&self, view: &View<'_, N>) -> N {
        let rate = self.drive.map_or(N::of(0.0), |i| view.drives[i][1]);
        let w = self.turned(view)[0];
        (left(w) * rate).perp(&self.ends[1].lift().direction(view.x))
    }

    pub(super) fn bias<N: Number>(&self, view: &View<'_, N>) -> N {
        let [_, w_rate, w_bias] = self.turned(view);
        let second = self.ends[1].lift();
        let (u, rate) = (second.direction(view.x), second.direction_rate(view.v));
        w_bias.perp(&u) + N::of(2.0) * w_rate.perp(&rate)
    }

    pub(super) fn stiffness(
        &self,
        lambda: f64,
        view: &View<'_>,
        add: &mut dyn FnMut(usize, usize, &NodeBlock<4>),
    ) {
        let [End::Body(first), End::Body(second)] = &self.ends else {
            return;
        };
        let theta = self.drive.map_or(0.0, |i| view.drives[i][0]);
        // d^2 g = (R du1) x du2 = du1 . (-R^T left) du2
        let turn = Rotation2::new(-self.angle - theta).into_inner();
        let cross = -turn * nalgebra::Matrix2::new(0.0, -1.0, 1.0, 0.0) * lambda;
        bilinear([(first, 1), (second, 1)], cross, add);
    }
}
