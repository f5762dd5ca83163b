//! A rotational spring and a damper in parallel between a rigid body of space and an orientation that moves. The spring stores
//! `k t^2 / 2`, where `t` is the angle between both: its moment is `k` times the rotation vector from one to the other, along
//! the axis about which they are turned, in the plane that of a rotational spring. It knows `t` up to half a turn, where
//! the moment jumps to its opposite.
//!
//! Source: M. D. Shuster, A survey of attitude representations, J. Astronautical Sciences 41 (1993) 439-517 (the angular velocity
//! is the rate of the rotation vector along it: the gradient of `t^2 / 2` is the rotation vector).

use nalgebra::{SMatrix, Vector3};

use super::{Add, Instant, spatial_moment};
use crate::bodies::Marker;
use crate::math::jet::Number;
use crate::math::rotation;
use crate::math::space::{Vector, components};
use crate::system::end::{Attachment, coupling};
use crate::system::signal::Signal;

/// A rotational spring and a damper in parallel between the axes of a body's frame and those that come in.
#[derive(Clone, Debug)]
pub struct OrientationBushing {
    /// A marker of the body, in the directions of the axes of its frame.
    pub axes: [Marker; 3],
    /// Stiffness, N m/rad.
    pub stiffness: f64,
    /// Damping, N m s/rad.
    pub damping: f64,
    /// Quaternion of the orientation, scalar first, of any length and either sign.
    pub quaternion: [Signal; 4],
    /// Angular velocity of the orientation, rad/s.
    pub velocity: [Signal; 3],
}

impl OrientationBushing {
    fn ends<const D: usize>(&self) -> [Attachment<D>; 2] {
        [
            Attachment::Ground(Vector::zeros()),
            Attachment::Body(self.axes[0]),
        ]
    }

    fn velocity<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> Vector3<N> {
        self.velocity.each_ref().map(|part| part.value(at)).into()
    }

    /// Rotation vector from the orientation to the body, rad, and the angular velocity of the body less that of the orientation.
    fn turn<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> [Vector3<N>; 2] {
        let from = rotation::axes(&self.quaternion.each_ref().map(|part| part.value(at)));
        let to = self.axes.each_ref().map(|axis| {
            let axis: Vector<D, N> = axis.lift().direction(at.x);
            Vector3::from(components(&axis))
        });
        // What takes the ones to the others, column by column.
        let column = |j: usize| to[0] * from[0][j] + to[1] * from[1][j] + to[2] * from[2][j];
        let between = rotation::quaternion(&[column(0), column(1), column(2)]);
        let spin = spatial_moment::spin(&self.ends::<D>()[1], at.x, at.v);
        [
            rotation::rotation_vector(&between),
            spin - self.velocity(at),
        ]
    }

    /// Moment on what has the orientation, N m; its opposite acts on the body.
    pub fn moment<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> Vector3<N> {
        let [turn, rate] = self.turn(at);
        turn * N::of(self.stiffness) + rate * N::of(self.damping)
    }

    pub(super) fn act<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        spatial_moment::act(&self.ends(), &-self.moment(at), at.x, call);
    }

    /// The symmetric part of the derivative of the rotation vector by a small turn: `1 + c (t t^T - t.t)`, where
    /// `c t.t = 1 - (t/2) cot(t/2)`. Turned by `w`, directions `e` fixed in the body change by `w x e`, whose squares make up
    /// `w.w` and what of it is across `t`.
    pub(super) fn add_tangent<const D: usize>(
        &self,
        at: Instant<'_, D>,
        stiffness: Add<'_, D>,
        damping: Add<'_, D>,
    ) {
        let [turn, _] = self.turn(at);
        let one = SMatrix::<f64, D, D>::identity();
        let ground = Attachment::Ground(Vector::zeros());
        let add = |marker: Marker, k: f64, to: Add<'_, D>| {
            let alone = [[one * k, one * 0.0], [one * 0.0; 2]];
            coupling(&[Attachment::Body(marker), ground], alone, 1, to);
        };
        for axis in self.axes {
            add(axis, 0.5 * self.stiffness, stiffness);
            if self.damping > 0.0 {
                add(axis, 0.5 * self.damping, damping);
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
            let softer = self.stiffness * (half / half.tan() - 1.0);
            add(about, softer, stiffness);
        }
    }

    /// As [`super::Bushing::power`].
    pub(super) fn power<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let [turn, rate] = self.turn(at);
        let (stiffness, damping) = (N::of(self.stiffness), N::of(self.damping));
        let now = self.quaternion.each_ref().map(|part| part.value(at));
        let moved = self.quaternion.each_ref().map(|part| part.rate(at));
        let square = now.iter().fold(N::of(0.0), |sum, part| sum + *part * *part);
        let [_, x, y, z] = rotation::product(&moved, &rotation::inverse(now));
        let speed = Vector3::new(x, y, z) * (N::of(2.0) / square);
        let pull = stiffness * turn.dot(&speed) + damping * rate.dot(&self.velocity(at));
        [-pull, damping * rate.norm_squared()]
    }

    pub(super) fn energy<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> N {
        N::of(0.5 * self.stiffness) * self.turn(at)[0].norm_squared()
    }

    /// As [`super::Bushing::work`], exact for small turns.
    pub(super) fn work<const D: usize>(
        &self,
        before: Instant<'_, D>,
        after: Instant<'_, D>,
    ) -> f64 {
        let [_, body] = self.ends::<D>();
        let way = spatial_moment::spin(&body, before.x, after.x);
        let dead = self.damping * self.velocity(before).dot(&way);
        self.energy(before) - self.energy(after) + dead
    }
}
