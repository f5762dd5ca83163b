//! A moment on a rigid body of space, and its opposite on another: about directions that stay where they are in space (a dead
//! moment), or that rotate with a body (a follower, or the axis of a joint). On the axes `e_k` of a body it is the
//! forces `M x e_k / 2`, whose moment is `M`. A dead moment about more than one axis does work that depends on the way and
//! has no potential.
//!
//! Source: H. Ziegler, Principles of Structural Stability, 2nd ed. (1977), section 5.2 (moments without a potential).

use nalgebra::Vector3;

use super::{ForceElement, Instant};
use crate::bodies::{Marker, Node};
use crate::math::jet::Number;
use crate::math::space::{Vector, components, vector};
use crate::system::direction::Direction;
use crate::system::end::Attachment;
use crate::system::signal::Signal;

/// A moment.
#[derive(Clone, Debug)]
pub struct SpatialMoment<const D: usize> {
    /// The second end takes the moment, the first one its opposite.
    pub ends: [Attachment<D>; 2],
    /// Whether it is the torque of a joint, about whose axis bodies rotate against each other alone: it has a potential.
    pub is_torque: bool,
    /// Sizes, N m, and what they are about.
    pub parts: Vec<(Signal, Direction<D>)>,
}

/// The three axes of the body that a marker belongs to, as directions of markers.
fn axes(marker: &Marker) -> [Marker; 3] {
    std::array::from_fn(|k| marker.directed(Vector3::ith(k, 1.0).into()))
}

/// Angular velocity of an end, rad/s.
pub(super) fn spin<const D: usize, N: Number>(
    end: &Attachment<D>,
    x: &[Node<D, N>],
    v: &[Node<D, N>],
) -> Vector3<N> {
    let Attachment::Body(marker) = end else {
        return Vector3::zeros();
    };
    let turned = axes(marker).map(|axis| {
        let axis = axis.lift();
        let [e, rate] =
            [axis.direction(x), axis.direction(v)].map(|of| Vector3::from(components(&of)));
        e.cross(&rate)
    });
    (turned[0] + turned[1] + turned[2]) * N::of(0.5)
}

/// Forces on directions at the ends of a moment on the second one and its opposite on the first.
pub(super) fn act<const D: usize, N: Number>(
    ends: &[Attachment<D>; 2],
    moment: &Vector3<N>,
    x: &[Node<D, N>],
    mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
) {
    for (end, sign) in ends.iter().zip([-0.5, 0.5]) {
        let Attachment::Body(marker) = end else {
            continue;
        };
        for axis in axes(marker) {
            let axis = axis.lift();
            let along = Vector3::from(components(&axis.direction(x)));
            let force = moment.cross(&along) * N::of(sign);
            call(
                &Attachment::Body(axis),
                [Vector::zeros(), vector(force.into())],
            );
        }
    }
}

impl<const D: usize> SpatialMoment<D> {
    fn moment<N: Number>(&self, at: Instant<'_, D, N>) -> Vector3<N> {
        let parts = self.parts.iter().map(|(size, about)| {
            let about = Vector3::from(components(&about.value(at.x)));
            about * size.value(at)
        });
        parts.fold(Vector3::zeros(), |sum, part| sum + part)
    }
}

impl<const D: usize> ForceElement<D> for SpatialMoment<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        act(&self.ends, &self.moment(at), at.x, call);
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let [first, second] = self.ends.each_ref().map(|end| spin(end, at.x, at.v));
        [self.moment(at).dot(&(second - first)), N::of(0.0)]
    }

    /// Exact for small rotations.
    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let [first, second] = self.ends.each_ref().map(|end| {
            let Attachment::Body(marker) = end else {
                return Vector3::zeros();
            };
            let turned = axes(marker).map(|axis| {
                let [a, b]: [Vector<D>; 2] = [axis.direction(before.x), axis.direction(after.x)];
                let [a, b] = [a, b].map(|of| Vector3::from(components(&of)));
                a.cross(&b)
            });
            (turned[0] + turned[1] + turned[2]) * 0.5
        });
        self.moment(before).dot(&(second - first))
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        for (size, _) in &mut self.parts {
            *size = size.held(at, fraction);
        }
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.parts.iter().for_each(|(size, _)| call(size));
    }

    fn is_conservative(&self) -> bool {
        self.is_torque
    }

    fn is_moment(&self) -> bool {
        true
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.ends.to_vec()
    }
}
