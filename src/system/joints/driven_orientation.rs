//! What drives the orientation of a rigid body in space: with `G_i` the axes that it is to have and `e_i` those that it has,
//! `k . sum G_i x e_i / 2 = 0` for each axis `k` of space, a vector along the axis about which the body is rotated away, as
//! large as the sine of the angle. Where it holds its derivative by a small rotation is that rotation, so that multipliers are the moment.
//! A quaternion and its opposite have the same axes: nothing jumps over full turns.
//!
//! Source: M. D. Shuster, A survey of attitude representations, J. Astronautical Sciences 41 (1993) 439-517 (the skew part of
//! a rotation matrix).

use nalgebra::Vector3;

use super::{Equation, Gradient, View};
use crate::bodies::{Marker, Node};
use crate::math::jet::Number;
use crate::math::rotation::{
    Quaternion, carried, inverse, product, quaternion, rotation_vector, unit_with_rates,
};
use crate::math::space::{Vector, components, vector};
use crate::system::end::Attachment;

/// One of the three conditions of a driven orientation.
#[derive(Clone, Debug)]
pub struct DrivenOrientation {
    /// A marker of the body, in the directions of the axes of its frame.
    pub axes: [Marker; 3],
    /// Driven coordinates: the quaternion, scalar first, of any length and either sign.
    pub drives: [usize; 4],
    /// The axis of space that the condition is about.
    pub about: usize,
}

impl DrivenOrientation {
    /// The rotation, rad, that takes the body to where it is to be; at most half a turn.
    pub fn missing<const D: usize>(&self, x: &[Node<D>], drives: &[[f64; 3]]) -> Vector3<f64> {
        let [wanted, ..] = self.course(drives);
        rotation_vector(&product(&wanted, &inverse(self.standing(x))))
    }

    /// Driven coordinates become those of the body as it stands.
    pub fn stand<const D: usize>(&self, x: &[Node<D>], drives: &mut [[f64; 3]]) {
        for (drive, part) in self.drives.iter().zip(self.standing(x)) {
            drives[*drive] = [part, 0.0, 0.0];
        }
    }

    /// The quaternion of the body.
    fn standing<const D: usize>(&self, x: &[Node<D>]) -> Quaternion {
        quaternion(&self.axes.map(|axis| {
            let axis: Vector<D> = axis.direction(x);
            components(&axis).into()
        }))
    }

    /// The quaternion, of unit length, with two derivatives.
    fn course<N: Number>(&self, drives: &[[N; 3]]) -> [Quaternion<N>; 3] {
        let order = |k: usize| self.drives.map(|drive| drives[drive][k]);
        unit_with_rates([0, 1, 2].map(order))
    }

    /// Returns the factors of the three axes of the body, `k x G_i / 2`, or their first (1) or second (2) time
    /// derivative.
    fn weights<const D: usize, N: Number>(
        &self,
        view: &View<'_, D, N>,
        order: usize,
    ) -> [Vector<D, N>; 3] {
        let [q, rate, second] = self.course(view.drives);
        let (about, two) = (Vector3::ith(self.about, N::of(0.5)), N::of(2.0));
        std::array::from_fn(|i| {
            let axis = match order {
                0 => carried(&q, &q, i),
                1 => carried(&q, &rate, i) * two,
                _ => (carried(&q, &second, i) + carried(&rate, &rate, i)) * two,
            };
            vector::<D, N>(about.cross(&axis).into())
        })
    }

    /// The weights of an order times the axes, or their rates.
    fn along<const D: usize, N: Number>(
        &self,
        view: &View<'_, D, N>,
        order: usize,
        nodes: &[Node<D, N>],
    ) -> N {
        let pairs = self.weights(view, order).into_iter().zip(&self.axes);
        let terms = pairs.map(|(weight, axis)| {
            let axis: Vector<D, N> = axis.lift().direction(nodes);
            weight.dot(&axis)
        });
        terms.fold(N::of(0.0), |sum, term| sum + term)
    }

    /// One pair of ends an axis of the body; the second is on it.
    pub(super) fn gradients<const D: usize, N: Number>(
        &self,
        view: &View<'_, D, N>,
    ) -> impl Iterator<Item = Gradient<D, N>> {
        let none = Vector::zeros();
        let pairs = self.weights(view, 0).into_iter().zip(self.axes);
        pairs.map(move |(weight, axis)| Gradient {
            ends: [
                (Attachment::Ground(none), [none; 2]),
                (Attachment::Body(axis.lift()), [none, weight]),
            ],
        })
    }
}

impl<const D: usize> Equation<D> for DrivenOrientation {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        self.along(view, 0, view.x)
    }

    fn rate<N: Number>(&self, view: &View<'_, D, N>) -> N {
        self.along(view, 1, view.x)
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        self.along(view, 2, view.x) + self.along(view, 1, view.v) * N::of(2.0)
    }

    /// Returns the two ends: the ground and the body.
    fn ends(&self) -> Vec<Attachment<D>> {
        vec![
            Attachment::Ground(Vector::zeros()),
            Attachment::Body(self.axes[0]),
        ]
    }

    fn is_angle(&self) -> bool {
        true
    }
}
