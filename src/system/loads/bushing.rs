//! A spring with a damper from a marker to a point that moves, without length at rest, and the same from
//! the direction of a marker to an angle. Unlike those of other springs, its force is linear.

use nalgebra::SMatrix;

use super::{Add, Instant};
use crate::bodies::Marker;
use crate::math::jet::Number;
use crate::math::space::{Vector, perpendicular};
use crate::system::end::{Attachment, coupling, isotropic};
use crate::system::signal::Signal;

/// A spring and a damper in parallel between a marker and a point.
#[derive(Clone, Debug)]
pub struct Bushing<const D: usize = 2> {
    /// The marker.
    pub marker: Marker,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Position of the point, m.
    pub position: [Signal; D],
    /// Velocity of the point, m/s.
    pub velocity: [Signal; D],
}

impl<const D: usize> Bushing<D> {
    fn velocity<N: Number>(&self, at: Instant<'_, D, N>) -> Vector<D, N> {
        self.velocity.each_ref().map(|c| c.value(at)).into()
    }

    /// From the point to the marker, and its rate.
    fn stretch<N: Number>(&self, at: Instant<'_, D, N>) -> [Vector<D, N>; 2] {
        let position = Vector::from(self.position.each_ref().map(|c| c.value(at)));
        let marker = self.marker.lift();
        [
            marker.position(at.x) - position,
            marker.position(at.v) - self.velocity(at),
        ]
    }

    /// Force on the point, N; its opposite acts on the marker.
    pub fn force<N: Number>(&self, at: Instant<'_, D, N>) -> Vector<D, N> {
        let [stretch, rate] = self.stretch(at);
        stretch * N::of(self.stiffness) + rate * N::of(self.damping)
    }

    pub(super) fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let end = Attachment::Body(self.marker.lift());
        call(&end, [-self.force(at), Vector::zeros()]);
    }

    pub(super) fn add_tangent(&self, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let ends: [Attachment<D>; 2] = [
            Attachment::Ground(Vector::zeros()),
            Attachment::Body(self.marker),
        ];
        isotropic(&ends, self.stiffness, stiffness);
        if self.damping > 0.0 {
            isotropic(&ends, self.damping, damping);
        }
    }

    /// Returns the power supplied by the moving point and the power dissipated, W. The spring force works on the rate
    /// of the position input, the damper force on the velocity input. The two inputs need not be consistent.
    pub(super) fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let [stretch, rate] = self.stretch(at);
        let speed: Vector<D, N> = self.position.each_ref().map(|c| c.rate(at)).into();
        let (stiffness, damping) = (N::of(self.stiffness), N::of(self.damping));
        let pull = stiffness * stretch.dot(&speed) + damping * rate.dot(&self.velocity(at));
        [-pull, damping * rate.norm_squared()]
    }

    pub(super) fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        N::of(0.5 * self.stiffness) * self.stretch(at)[0].norm_squared()
    }

    /// The part of the damper that the velocity of the point makes is a dead force.
    pub(super) fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let way = self.stretch(after)[0] - self.stretch(before)[0];
        let dead = self.damping * self.velocity(before).dot(&way);
        self.energy(before) - self.energy(after) + dead
    }
}

/// A rotational spring and a damper in parallel between the direction of a marker and an angle.
#[derive(Clone, Debug)]
pub struct RotationalBushing {
    /// The marker.
    pub marker: Marker,
    /// Index of its angle among those that the system counts.
    pub counted: usize,
    /// Stiffness, N m/rad.
    pub stiffness: f64,
    /// Damping, N m s/rad.
    pub damping: f64,
    /// The angle, rad.
    pub angle: Signal,
    /// Rate of the angle, rad/s.
    pub velocity: Signal,
}

impl RotationalBushing {
    fn end<const D: usize, N: Number>(&self) -> Attachment<D, N> {
        Attachment::Body(self.marker.lift())
    }

    /// From the angle to the direction of the marker, and its rate.
    fn stretch<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let counted = at.angles.0[self.counted].value(at.x, at.angles.1[self.counted]);
        let spin = self.end::<D, N>().spin(at.x, at.v);
        [
            counted - self.angle.value(at),
            spin - self.velocity.value(at),
        ]
    }

    /// Moment on what turns by the angle, N m; its opposite acts on the marker.
    pub fn moment<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let [turn, rate] = self.stretch(at);
        N::of(self.stiffness) * turn + N::of(self.damping) * rate
    }

    pub(super) fn act<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let end = self.end();
        call(&end, end.turn(-self.moment(at), at.x));
    }

    pub(super) fn add_tangent<const D: usize>(
        &self,
        at: Instant<'_, D>,
        stiffness: Add<'_, D>,
        damping: Add<'_, D>,
    ) {
        let end: Attachment<D> = self.end();
        let u = end.direction(at.x);
        let turn = perpendicular(u) / u.norm_squared();
        let outer: SMatrix<f64, D, D> = turn * turn.transpose();
        let ends = [end, Attachment::Ground(Vector::zeros())];
        let alone = |k: SMatrix<f64, D, D>| [[k, SMatrix::zeros()], [SMatrix::zeros(); 2]];
        let k = outer * self.stiffness - end.curl(at.x) * self.moment(at);
        coupling(&ends, alone(k), 1, stiffness);
        if self.damping > 0.0 {
            coupling(&ends, alone(outer * self.damping), 1, damping);
        }
    }

    /// As [`Bushing::power`].
    pub(super) fn power<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let [turn, rate] = self.stretch(at);
        let (stiffness, damping) = (N::of(self.stiffness), N::of(self.damping));
        let speed = self.angle.rate(at);
        let pull = stiffness * turn * speed + damping * rate * self.velocity.value(at);
        [-pull, damping * rate * rate]
    }

    pub(super) fn energy<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let [turn, _] = self.stretch(at);
        N::of(0.5 * self.stiffness) * turn * turn
    }

    /// As [`Bushing::work`].
    pub(super) fn work<const D: usize>(
        &self,
        before: Instant<'_, D>,
        after: Instant<'_, D>,
    ) -> f64 {
        let way = self.stretch(after)[0] - self.stretch(before)[0];
        let dead = self.damping * self.velocity.value(before) * way;
        self.energy(before) - self.energy(after) + dead
    }
}
