//! The direction of a rigid body keeps its length: `(u.u - 1) / 2 = 0`. Natural coordinates: J. Garcia
//! de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), section 2.2.

use super::{Equation, Gradient, View};
use crate::bodies::{Bodies, Marker, no_block};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::end::{Add, Attachment};

/// The unit vector of a rigid body.
#[derive(Clone, Debug)]
pub struct UnitLength {
    /// Node of the body.
    pub node: usize,
}

impl UnitLength {
    pub(super) fn gradient<const D: usize, N: Number>(
        &self,
        view: &View<'_, D, N>,
    ) -> Gradient<D, N> {
        let none = Vector::zeros();
        let [_, direction] = view.x[self.node].map(Vector::from);
        let end = Attachment::Body(Marker::rigid(0, self.node, [0.0; 2]).lift());
        Gradient {
            ends: [
                (end, [none, direction]),
                (Attachment::Ground(none), [none; 2]),
            ],
        }
    }
}

impl<const D: usize> Equation<D> for UnitLength {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let [_, direction] = view.x[self.node].map(Vector::from);
        N::of(0.5) * (direction.norm_squared() - N::of(1.0))
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let [_, rate] = view.v[self.node].map(Vector::from);
        rate.norm_squared()
    }

    fn stiffness(&self, lambda: f64, _view: &View<'_, D>, add: Add<'_, D>) {
        let mut block = no_block();
        for k in 0..D {
            block[1][k][1][k] = lambda;
        }
        add(self.node, self.node, &block);
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        Vec::new()
    }

    fn nodes(&self, _bodies: &Bodies<D>) -> Vec<usize> {
        vec![self.node]
    }

    fn is_angle(&self) -> bool {
        true
    }

    fn is_stiff(&self) -> bool {
        true
    }
}
