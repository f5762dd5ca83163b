//! The direction of a rigid body keeps its length: `(u.u - 1) / 2 = 0`. Natural coordinates: J. Garcia
//! de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), section 2.2.

use nalgebra::Vector2;

use super::{Gradient, View};
use crate::body::{Marker, NodeBlock};
use crate::math::jet::Number;
use crate::system::end::End;

/// The unit vector of a rigid body.
#[derive(Clone, Debug)]
pub struct Unit {
    /// Node of the body.
    pub node: usize,
}

impl Unit {
    pub(super) fn value<N: Number>(&self, view: &View<'_, N>) -> N {
        let [_, _, x, y] = view.x[self.node];
        N::of(0.5) * (x * x + y * y - N::of(1.0))
    }

    pub(super) fn gradient<N: Number>(&self, view: &View<'_, N>) -> Gradient<N> {
        let none = Vector2::zeros();
        let [_, _, x, y] = view.x[self.node];
        let end = End::Body(Marker::rigid(0, self.node, [0.0; 2]).lift());
        Gradient {
            ends: [
                (end, [none, Vector2::new(x, y)]),
                (End::Ground(none), [none; 2]),
            ],
        }
    }

    pub(super) fn bias<N: Number>(&self, view: &View<'_, N>) -> N {
        let [_, _, x, y] = view.v[self.node];
        x * x + y * y
    }

    pub(super) fn stiffness(&self, lambda: f64, add: &mut dyn FnMut(usize, usize, &NodeBlock<4>)) {
        let mut block = [[0.0; 4]; 4];
        block[2][2] = lambda;
        block[3][3] = lambda;
        add(self.node, self.node, &block);
    }
}
