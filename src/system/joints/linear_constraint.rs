//! Rows that are linear in what joints see and yet keep multipliers: those of rigid bodies in space, whose axes are no
//! coordinates, and pins of so many rigid bodies that eliminating them would tie all of them together.

use super::{ConstraintKind, Equation, Gradient, Linear, Rows, Target, View};
use crate::bodies::Bodies;
use crate::math::jet::Number;
use crate::math::space::{Vector, axis};
use crate::system::end::{Attachment, reach};

/// `sum over both ends of (coefficients . position + coefficients . direction) = target`.
#[derive(Clone, Debug)]
pub struct LinearConstraint<const D: usize> {
    /// The ends.
    pub ends: [Attachment<D>; 2],
    /// Coefficients on position and direction of both.
    pub on_ends: [[Vector<D>; 2]; 2],
    /// Right-hand side of the row.
    pub target: Target,
    /// Reference size of residuals: m, or 1 for directions.
    pub size: f64,
    /// Whether it is the same in every configuration over the coordinates.
    pub is_constant: bool,
}

/// Both ends are at one place.
pub(super) fn coincide<const D: usize>(rows: &mut Rows<'_, D>) -> Option<ConstraintKind<D>> {
    for k in 0..D {
        rows.hold_position(axis(k), Target::Fixed);
    }
    None
}

impl<const D: usize> LinearConstraint<D> {
    /// The row of a joint with these ends.
    pub fn new(linear: &Linear<D>, ends: [Attachment<D>; 2]) -> Self {
        let size = reach(&ends);
        let holds_position = linear.on_ends[1][0].norm() > 0.0;
        Self {
            on_ends: linear.on_ends,
            target: linear.target,
            size: if holds_position && size > 0.0 {
                size
            } else {
                1.0
            },
            is_constant: !ends.iter().any(Attachment::is_framed),
            ends,
        }
    }

    /// Whether it holds directions alone.
    pub fn holds_direction(&self) -> bool {
        (self.on_ends.iter()).all(|[position, _]| position.norm() == 0.0)
    }

    pub(super) fn gradient<N: Number>(&self, _: &View<'_, D, N>) -> Gradient<D, N> {
        let of = |i: usize| {
            let on = self.on_ends[i].map(|on| on.map(N::of));
            (self.ends[i].lift(), on)
        };
        Gradient {
            ends: [of(0), of(1)],
        }
    }
}

impl<const D: usize> Equation<D> for LinearConstraint<D> {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let of = |(end, [position, direction]): (&Attachment<D>, &[Vector<D>; 2])| {
            let Attachment::Body(marker) = end.lift() else {
                return N::of(0.0);
            };
            let at: Vector<D, N> = marker.position(view.x);
            let along: Vector<D, N> = marker.direction(view.x);
            at.dot(&position.map(N::of)) + along.dot(&direction.map(N::of))
        };
        let [a, b] = [0, 1].map(|i| of((&self.ends[i], &self.on_ends[i])));
        a + b - self.target.derivatives(view.drives)[0]
    }

    fn rate<N: Number>(&self, view: &View<'_, D, N>) -> N {
        -self.target.derivatives(view.drives)[1]
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        -self.target.derivatives(view.drives)[2]
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.ends.to_vec()
    }

    fn size(&self, _bodies: &Bodies<D>) -> f64 {
        self.size
    }

    fn is_angle(&self) -> bool {
        self.holds_direction()
    }
}
