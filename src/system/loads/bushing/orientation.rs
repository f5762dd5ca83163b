//! The rotation from an orientation that moves to that of a body, in space: the rotation vector from one to the other, whose moment is
//! along the axis about which they are rotated. It knows the angle up to half a turn, where the moment jumps to its opposite. About all
//! axes the stiffness is the same, so that the spring stores `k t^2 / 2`, where `t` is the angle.
//!
//! Source: M. D. Shuster, A survey of attitude representations, J. Astronautical Sciences 41 (1993) 439-517 (the angular velocity
//! is the rate of the rotation vector along it: the gradient of `t^2 / 2` is the rotation vector).

use nalgebra::{SMatrix, Vector3};

use super::{Bushing, DeformationMeasure, SixComponents};
use crate::bodies::Marker;
use crate::math::jet::Number;
use crate::math::rotation;
use crate::math::space::{Vector, components};
use crate::system::end::{Attachment, coupling};
use crate::system::loads::{Add, Instant, hold, spatial_moment};
use crate::system::signal::Signal;

/// Rotation from an orientation to the axes of a body's frame, along global axes.
#[derive(Clone, Debug)]
pub struct FromOrientation {
    /// A marker of the body, in the directions of the axes of its frame.
    pub axes: [Marker; 3],
    /// Quaternion of the orientation, scalar first, of any length and either sign.
    pub quaternion: [Signal; 4],
    /// Angular velocity of the orientation, rad/s.
    pub velocity: [Signal; 3],
}

impl FromOrientation {
    fn both<const D: usize>(&self) -> [Attachment<D>; 2] {
        [
            Attachment::Ground(Vector::zeros()),
            Attachment::Body(self.axes[0]),
        ]
    }

    fn velocity<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> Vector3<N> {
        self.velocity.each_ref().map(|part| part.value(at)).into()
    }

    /// Rotation vector from the orientation to the body, rad.
    fn turn<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> Vector3<N> {
        let from = rotation::axes(&self.quaternion.each_ref().map(|part| part.value(at)));
        let to = self.axes.each_ref().map(|axis| {
            let axis: Vector<D, N> = axis.lift().direction(at.x);
            Vector3::from(components(&axis))
        });
        // What takes the ones to the others, column by column.
        let column = |j: usize| to[0] * from[0][j] + to[1] * from[1][j] + to[2] * from[2][j];
        let between = rotation::quaternion(&[column(0), column(1), column(2)]);
        rotation::rotation_vector(&between)
    }
}

impl<const D: usize> DeformationMeasure<D> for FromOrientation {
    fn deformation<N: Number>(&self, at: Instant<'_, D, N>) -> [SixComponents<N>; 2] {
        let spin = spatial_moment::spin(&self.both::<D>()[1], at.x, at.v);
        let none = Vector3::zeros();
        [[none, self.turn(at)], [none, spin - self.velocity(at)]]
    }

    fn driven<N: Number>(&self, at: Instant<'_, D, N>) -> [SixComponents<N>; 2] {
        let now = self.quaternion.each_ref().map(|part| part.value(at));
        let moved = self.quaternion.each_ref().map(|part| part.rate(at));
        let square = now.iter().fold(N::of(0.0), |sum, part| sum + *part * *part);
        let [_, x, y, z] = rotation::product(&moved, &rotation::inverse(now));
        let speed = Vector3::new(x, y, z) * (N::of(2.0) / square);
        [speed, self.velocity(at)].map(|of| [Vector3::zeros(), of])
    }

    fn way(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> SixComponents {
        let way = spatial_moment::spin(&self.both::<D>()[1], before.x, after.x);
        [Vector3::zeros(), way]
    }

    fn act<N: Number>(
        &self,
        [_, moment]: SixComponents<N>,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        spatial_moment::act(&self.both(), &moment, at.x, call);
    }

    /// The symmetric part of the derivative of the rotation vector by a small rotation is `1 + c (t t^T - t.t)`, where
    /// `c t.t = 1 - (t/2) cot(t/2)`. Rotated by `w`, directions `e` fixed in the body change by `w x e`, whose squares make up
    /// `w.w` and what of it is across `t`.
    fn add_tangent(
        &self,
        of: &Bushing<D>,
        at: Instant<'_, D>,
        stiffness: Add<'_, D>,
        damping: Add<'_, D>,
    ) {
        let ([_, [k, ..]], [_, [c, ..]]) = (of.stiffness, of.damping);
        let turn = self.turn(at);
        let one = SMatrix::<f64, D, D>::identity();
        let ground = Attachment::Ground(Vector::zeros());
        let add = |marker: Marker, k: f64, to: Add<'_, D>| {
            let alone = [[one * k, one * 0.0], [one * 0.0; 2]];
            coupling(&[Attachment::Body(marker), ground], alone, 1, to);
        };
        for axis in self.axes {
            add(axis, 0.5 * k, stiffness);
            if c > 0.0 {
                add(axis, 0.5 * c, damping);
            }
        }
        let (size, half) = (turn.norm(), 0.5 * turn.norm());
        if size > 1e-6 {
            let along = self.axes.map(|axis| {
                let axis: Vector<D> = axis.direction(at.x);
                Vector3::from(components(&axis)).dot(&turn) / size
            });
            let [a, b, c] = self.axes;
            let about = a.blended(along[0], &b, along[1]).blended(1.0, &c, along[2]);
            let softer = k * (half / half.tan() - 1.0);
            add(about, softer, stiffness);
        }
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.quaternion.iter().chain(&self.velocity).for_each(call);
    }

    fn hold(&mut self, at: Instant<'_, D>) {
        hold(&mut self.quaternion, at, 1.0);
        hold(&mut self.velocity, at, 1.0);
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        vec![Attachment::Body(self.axes[0])]
    }
}
