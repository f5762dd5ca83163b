//! A force at a marker: dead (global axes) or follower (along the marker's direction and across it, to
//! the left).

use nalgebra::{Matrix2, Vector2};

use super::{Add, Instant};
use crate::body::{Marker, Node, left};
use crate::math::jet::Number;
use crate::system::signal::Signal;

/// A force.
#[derive(Clone, Debug)]
pub struct Force {
    /// Where it acts.
    pub marker: Marker,
    /// Whether it turns with the marker.
    pub follower: bool,
    /// Components, N.
    pub components: [Signal; 2],
}

impl Force {
    fn value<N: Number>(&self, at: Instant<'_, N>) -> Vector2<N> {
        let [a, b] = self.components.each_ref().map(|c| c.value(at));
        if !self.follower {
            return Vector2::new(a, b);
        }
        let u = self.marker.lift().direction(at.x).normalize();
        u * a + left(u) * b
    }

    pub(super) fn add_force<N: Number>(&self, at: Instant<'_, N>, f: &mut [Node<4, N>]) {
        let force = self.value(at);
        self.marker.lift().add_force(force, Vector2::zeros(), f);
    }

    /// The force follows the direction: `d force = left(force) (u x du) / u.u`; the symmetric part.
    pub(super) fn add_stiffness(&self, at: Instant<'_>, add: Add<'_>) {
        if !self.follower {
            return;
        }
        let u = self.marker.direction(at.x);
        let turn = left(u) / u.norm_squared();
        let cross: Matrix2<f64> = left(self.value(at)) * turn.transpose() * -0.5;
        let (positions, directions) = (self.marker.jacobian(0), self.marker.jacobian(1));
        let ends = if self.marker.is_nodal() { 1 } else { 2 };
        for i in 0..ends {
            for j in i..ends {
                let mut block = [[0.0; 4]; 4];
                for p in 0..2 {
                    for q in 0..2 {
                        // S^T cross S' and its transpose.
                        let one = positions[i].1[p].transpose() * cross * directions[j].1[q];
                        let other =
                            directions[i].1[p].transpose() * cross.transpose() * positions[j].1[q];
                        for r in 0..2 {
                            for c in 0..2 {
                                block[2 * p + r][2 * q + c] = one[(r, c)] + other[(r, c)];
                            }
                        }
                    }
                }
                add(positions[i].0, positions[j].0, &block);
            }
        }
    }

    pub(super) fn power<N: Number>(&self, at: Instant<'_, N>) -> N {
        self.value(at).dot(&self.marker.lift().position(at.v))
    }

    pub(super) fn work(&self, before: Instant<'_>, after: Instant<'_>) -> f64 {
        let way = self.marker.position(after.x) - self.marker.position(before.x);
        self.value(before).dot(&way)
    }
}
