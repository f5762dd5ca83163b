//! The translation from a point that moves to a marker. The force of springs and dampers on it is linear.

use nalgebra::{SMatrix, Vector3};

use super::{Bushing, DeformationMeasure, SixComponents};
use crate::bodies::Marker;
use crate::math::jet::Number;
use crate::math::space::{Vector, components, vector};
use crate::system::end::{Attachment, between};
use crate::system::loads::{Add, Instant, hold};
use crate::system::signal::Signal;

/// Translation from a point to a marker, along global axes.
#[derive(Clone, Debug)]
pub struct FromPoint<const D: usize = 2> {
    /// The marker.
    pub marker: Marker,
    /// Position of the point, m.
    pub position: [Signal; D],
    /// Velocity of the point, m/s.
    pub velocity: [Signal; D],
}

/// A translation without a rotation.
fn along<const D: usize, N: Number>(translation: &Vector<D, N>) -> SixComponents<N> {
    [components(translation).into(), Vector3::zeros()]
}

impl<const D: usize> DeformationMeasure<D> for FromPoint<D> {
    fn deformation<N: Number>(&self, at: Instant<'_, D, N>) -> [SixComponents<N>; 2] {
        let position = Vector::from(self.position.each_ref().map(|c| c.value(at)));
        let velocity = Vector::from(self.velocity.each_ref().map(|c| c.value(at)));
        let marker = self.marker.lift();
        [
            along(&(marker.position(at.x) - position)),
            along(&(marker.position(at.v) - velocity)),
        ]
    }

    fn driven<N: Number>(&self, at: Instant<'_, D, N>) -> [SixComponents<N>; 2] {
        let speed = Vector::from(self.position.each_ref().map(|c| c.rate(at)));
        let velocity = Vector::from(self.velocity.each_ref().map(|c| c.value(at)));
        [along(&speed), along(&velocity)]
    }

    fn act<N: Number>(
        &self,
        [force, _]: SixComponents<N>,
        _at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let end = Attachment::Body(self.marker.lift());
        call(&end, [vector(force.into()), Vector::zeros()]);
    }

    fn add_tangent(
        &self,
        of: &Bushing<D>,
        _at: Instant<'_, D>,
        stiffness: Add<'_, D>,
        damping: Add<'_, D>,
    ) {
        let ends = [
            Attachment::Ground(Vector::zeros()),
            Attachment::Body(self.marker),
        ];
        let matrix = |of: [f64; 3]| SMatrix::from_diagonal(&vector(of));
        between(&ends, matrix(of.stiffness[0]), 0, stiffness);
        if of.damping[0] != [0.0; 3] {
            between(&ends, matrix(of.damping[0]), 0, damping);
        }
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.position.iter().chain(&self.velocity).for_each(call);
    }

    fn hold(&mut self, at: Instant<'_, D>) {
        hold(&mut self.position, at, 1.0);
        hold(&mut self.velocity, at, 1.0);
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        vec![Attachment::Body(self.marker)]
    }
}
