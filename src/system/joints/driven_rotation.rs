//! What drives the angle about the axis of a joint in space: `-sin(angle) n . u + cos(angle) m . u = 0` with directions `n`
//! and `m` across the axis of the first body and `u` of the second.

use nalgebra::SMatrix;

use super::{Equation, Gradient, View};
use crate::math::jet::Number;
use crate::system::direction::{AxisRotation, Direction};
use crate::system::end::{Add, Attachment, bilinear};

/// A driven rotation.
#[derive(Clone, Debug)]
pub struct DrivenRotation<const D: usize> {
    /// Driven rotation about an axis.
    pub turn: AxisRotation<D>,
    /// Driven coordinate: the angle, rad.
    pub drive: usize,
}

impl<const D: usize> DrivenRotation<D> {
    /// The driven angle with two derivatives, its sine and cosine.
    fn drive<N: Number>(&self, view: &View<'_, D, N>) -> ([N; 3], [N; 2]) {
        let drive = view.drives[self.drive];
        let (sin, cos) = drive[0].sin_cos();
        (drive, [sin, cos])
    }

    pub(super) fn gradient<N: Number>(&self, view: &View<'_, D, N>) -> Gradient<D, N> {
        let (_, turned) = self.drive(view);
        self.turn.gradient_at(turned, view.x)
    }
}

impl<const D: usize> Equation<D> for DrivenRotation<D> {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let (_, [sin, cos]) = self.drive(view);
        let [p, q] = self.turn.products(view.x);
        cos * q - sin * p
    }

    fn rate<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let ([_, rate, _], [sin, cos]) = self.drive(view);
        let [p, q] = self.turn.products(view.x);
        -rate * (sin * q + cos * p)
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let ([_, rate, second], [sin, cos]) = self.drive(view);
        let [p, q] = self.turn.products(view.x);
        let [p_rate, q_rate] = self.turn.rates(view.x, view.v);
        let [p_bend, q_bend] = self.turn.bends(view.v);
        let two = N::of(2.0);
        cos * q_bend - sin * p_bend - two * rate * (sin * q_rate + cos * p_rate)
            + rate * rate * (sin * p - cos * q)
            - second * (cos * p + sin * q)
    }

    fn stiffness(&self, lambda: f64, view: &View<'_, D>, add: Add<'_, D>) {
        let (_, turned) = self.drive(view);
        if let (Attachment::Body(first), Direction::Of(second)) =
            (self.turn.turned(turned), &self.turn.of)
        {
            bilinear(
                [(&first, 1), (second, 1)],
                SMatrix::identity() * lambda,
                add,
            );
        }
    }

    /// Returns the two ends of the constraint.
    fn ends(&self) -> Vec<Attachment<D>> {
        vec![self.turn.across[0].end(), self.turn.of.end()]
    }

    fn is_angle(&self) -> bool {
        true
    }

    fn is_stiff(&self) -> bool {
        true
    }
}
