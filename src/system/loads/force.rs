//! A force at a marker: dead (global axes) or follower (in the plane along the marker's direction and across it, to the
//! left; in space along the axes of a body's frame).

use nalgebra::SMatrix;

use super::{Add, ForceElement, Instant, hold};
use crate::bodies::{Marker, no_block};
use crate::math::jet::Number;
use crate::math::space::{Vector, perpendicular};
use crate::system::end::Attachment;
use crate::system::signal::Signal;

/// A force.
#[derive(Clone, Debug)]
pub struct Force<const D: usize = 2> {
    /// Where it acts.
    pub marker: Marker,
    /// Whether it rotates with the marker.
    pub follower: bool,
    /// Components, N.
    pub components: [Signal; D],
    /// In space, what a follower's components are along.
    pub axes: [Marker; D],
}

impl<const D: usize> Force<D> {
    fn value<N: Number>(&self, at: Instant<'_, D, N>) -> Vector<D, N> {
        let components = self.components.each_ref().map(|c| c.value(at));
        if !self.follower {
            return Vector::from(components);
        }
        if D == 3 {
            let along = self.axes.each_ref().map(|axis| axis.lift().direction(at.x));
            let parts = along
                .iter()
                .zip(components)
                .map(|(along, size)| along * size);
            return parts.fold(Vector::zeros(), |sum, part| sum + part);
        }
        let u = self.marker.lift().direction(at.x).normalize();
        u * components[0] + perpendicular(u) * components[1]
    }
}

impl<const D: usize> ForceElement<D> for Force<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let end = Attachment::Body(self.marker.lift());
        call(&end, [self.value(at), Vector::zeros()]);
    }

    /// The force follows the direction: `d force = perpendicular(force) (u x du) / u.u`; the symmetric part.
    fn add_tangent(&self, at: Instant<'_, D>, add: Add<'_, D>, _damping: Add<'_, D>) {
        // In space what it adds is small beside inertia.
        if !self.follower || D == 3 {
            return;
        }
        let u: Vector<D> = self.marker.direction(at.x);
        let turn = perpendicular(u) / u.norm_squared();
        let cross: SMatrix<f64, D, D> = perpendicular(self.value(at)) * turn.transpose() * -0.5;
        let [positions, directions] = [0, 1].map(|part| self.marker.jacobian::<D>(part));
        let ends = if self.marker.is_nodal() { 1 } else { 2 };
        for i in 0..ends {
            for j in i..ends {
                let mut block = no_block();
                for p in 0..2 {
                    for q in 0..2 {
                        // S^T cross S' and its transpose.
                        let one = positions[i].1[p].transpose() * cross * directions[j].1[q];
                        let other =
                            directions[i].1[p].transpose() * cross.transpose() * positions[j].1[q];
                        for r in 0..D {
                            for c in 0..D {
                                block[p][r][q][c] = one[(r, c)] + other[(r, c)];
                            }
                        }
                    }
                }
                add(positions[i].0, positions[j].0, &block);
            }
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        [
            self.value(at).dot(&self.marker.lift().position(at.v)),
            N::of(0.0),
        ]
    }

    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let way: Vector<D> = self.marker.position(after.x) - self.marker.position(before.x);
        self.value(before).dot(&way)
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        hold(&mut self.components, at, fraction);
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.components.iter().for_each(call);
    }

    fn is_conservative(&self) -> bool {
        !self.follower
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        vec![Attachment::Body(self.marker)]
    }
}
