//! The direction of the second end keeps its angle from that of the first.
//!
//! Where both ends keep the length of their directions (rigid bodies, the ground), the second is the
//! first one rotated: linear. A cable's slope may stretch, and directions of reduced bodies are no coordinates: against the ground only the
//! component across is held, which is linear in directions too; otherwise the cross product vanishes, which is not.

use nalgebra::SMatrix;

use super::{ConstraintKind, Equation, Gradient, Rows, Target, View};
use crate::math::jet::Number;
use crate::math::space::{Vector, axis, cross, normals, perpendicular, turned};
use crate::system::end::{Add, Attachment, bilinear};

/// A direction at an angle from another: `(R(angle) u1) x u2 = 0`.
#[derive(Clone, Debug)]
pub struct AngleBetween<const D: usize> {
    /// The two directions.
    pub ends: [Attachment<D>; 2],
    /// Fixed angle, rad.
    pub angle: f64,
    /// Driven coordinate to add to it.
    pub drive: Option<usize>,
}

/// Holds the direction of the second end at a fixed angle from that of the first.
pub(super) fn hold<const D: usize>(
    rows: &mut Rows<'_, D>,
    angle: f64,
) -> Option<ConstraintKind<D>> {
    let none = Vector::zeros();
    let direction: Vector<D> = turned(axis(0), angle.sin_cos());
    let [first, second] = rows.ends;
    match (first, second.has_linear_direction()) {
        (Attachment::Ground(_), true) => {
            for (k, value) in direction.iter().enumerate() {
                rows.push([none; 2], [none, axis(k)], Target::Fixed(*value));
            }
        }
        (Attachment::Ground(_), false) => return clamp(rows, &direction),
        (Attachment::Body(_), true) if first.has_linear_direction() => {
            for k in 0..D {
                let back = turned(axis(k), (-angle).sin_cos());
                rows.push([none, back], [none, axis(k)], Target::Fixed(0.0));
            }
        }
        _ => {
            return Some(ConstraintKind::AngleBetween(AngleBetween {
                ends: [*first, *second],
                angle,
                drive: None,
            }));
        }
    }
    None
}

/// Holds the direction of a cable at the second end along a unit vector: its slope keeps its direction, not its size,
/// so that it stretches freely up to a clamp.
pub(super) fn clamp<const D: usize>(
    rows: &mut Rows<'_, D>,
    direction: &Vector<D>,
) -> Option<ConstraintKind<D>> {
    let none = Vector::zeros();
    for normal in normals(direction) {
        rows.push([none; 2], [none, normal], Target::Fixed(0.0));
    }
    None
}

impl<const D: usize> AngleBetween<D> {
    /// Sine and cosine of the angle.
    #[inline(always)]
    fn turn<N: Number>(&self, view: &View<'_, D, N>) -> (N, N) {
        let theta = self.drive.map_or(N::of(0.0), |i| view.drives[i][0]);
        (theta + N::of(self.angle)).sin_cos()
    }

    /// The first direction, rotated by the angle with this sine and cosine.
    #[inline(always)]
    fn turned<N: Number>(&self, view: &View<'_, D, N>, turn: (N, N)) -> Vector<D, N> {
        turned(self.ends[0].lift().direction(view.x), turn)
    }

    /// The rotated first direction, and its first two derivatives in time but for the part of
    /// accelerations.
    fn turned_with_rates<N: Number>(&self, view: &View<'_, D, N>) -> [Vector<D, N>; 3] {
        let [_, rate, second] = self.drive.map_or([N::of(0.0); 3], |i| view.drives[i]);
        let (turn, first) = (self.turn(view), self.ends[0].lift());
        let w = self.turned(view, turn);
        let moved = turned(first.direction_rate(view.v), turn);
        let bias = perpendicular(moved) * (N::of(2.0) * rate) + perpendicular(w) * second
            - w * (rate * rate);
        [w, moved + perpendicular(w) * rate, bias]
    }

    pub(super) fn gradient<N: Number>(&self, view: &View<'_, D, N>) -> Gradient<D, N> {
        let none = Vector::zeros();
        let (sin, cos) = self.turn(view);
        let [first, second] = self.ends.map(|end| end.lift());
        let (w, u) = (self.turned(view, (sin, cos)), second.direction(view.x));
        // w x u = w . (-perpendicular u) = u . perpendicular w
        Gradient {
            ends: [
                (first, [none, -turned(perpendicular(u), (-sin, cos))]),
                (second, [none, perpendicular(w)]),
            ],
        }
    }
}

impl<const D: usize> Equation<D> for AngleBetween<D> {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let w = self.turned(view, self.turn(view));
        cross(&w, &self.ends[1].lift().direction(view.x))
    }

    fn rate<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let rate = self.drive.map_or(N::of(0.0), |i| view.drives[i][1]);
        let w = self.turned(view, self.turn(view));
        cross(
            &(perpendicular(w) * rate),
            &self.ends[1].lift().direction(view.x),
        )
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let [_, w_rate, w_bias] = self.turned_with_rates(view);
        let second = self.ends[1].lift();
        let (u, rate) = (second.direction(view.x), second.direction_rate(view.v));
        cross(&w_bias, &u) + N::of(2.0) * cross(&w_rate, &rate)
    }

    fn stiffness(&self, lambda: f64, view: &View<'_, D>, add: Add<'_, D>) {
        let [Attachment::Body(first), Attachment::Body(second)] = &self.ends else {
            return;
        };
        let theta = self.drive.map_or(0.0, |i| view.drives[i][0]);
        // d^2 g = (R du1) x du2 = du1 . (-R^T perpendicular) du2
        let back = (-self.angle - theta).sin_cos();
        let cross =
            SMatrix::from_fn(|r, c| -turned(perpendicular(axis::<D, f64>(c)), back)[r]) * lambda;
        bilinear([(first, 1), (second, 1)], cross, add);
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.ends.to_vec()
    }

    fn is_angle(&self) -> bool {
        true
    }

    fn is_stiff(&self) -> bool {
        true
    }
}
