//! The rotation from an angle that moves to the direction of a marker, in the plane.

use nalgebra::{SMatrix, Vector3};

use super::{Bushing, DeformationMeasure, SixComponents};
use crate::bodies::Marker;
use crate::math::jet::Number;
use crate::math::space::{Vector, perpendicular};
use crate::system::end::{Attachment, coupling};
use crate::system::loads::{Add, Instant};
use crate::system::signal::Signal;

/// Rotation from an angle to the direction of a marker, about the third axis.
#[derive(Clone, Debug)]
pub struct FromAngle {
    /// The marker.
    pub marker: Marker,
    /// Index of its angle among those that the system counts.
    pub counted: usize,
    /// The angle, rad.
    pub angle: Signal,
    /// Rate of the angle, rad/s.
    pub velocity: Signal,
}

/// A rotation about the third axis.
fn about<N: Number>(rotation: N) -> SixComponents<N> {
    let zero = N::of(0.0);
    [Vector3::zeros(), Vector3::new(zero, zero, rotation)]
}

impl FromAngle {
    fn end<const D: usize, N: Number>(&self) -> Attachment<D, N> {
        Attachment::Body(self.marker.lift())
    }
}

impl<const D: usize> DeformationMeasure<D> for FromAngle {
    fn deformation<N: Number>(&self, at: Instant<'_, D, N>) -> [SixComponents<N>; 2] {
        let counted = at.angles.0[self.counted].value(at.x, at.angles.1[self.counted]);
        let spin = self.end::<D, N>().spin(at.x, at.v);
        [
            about(counted - self.angle.value(at)),
            about(spin - self.velocity.value(at)),
        ]
    }

    fn driven<N: Number>(&self, at: Instant<'_, D, N>) -> [SixComponents<N>; 2] {
        [about(self.angle.rate(at)), about(self.velocity.value(at))]
    }

    fn act<N: Number>(
        &self,
        [_, moment]: SixComponents<N>,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let end = self.end();
        call(&end, end.turn(moment.z, at.x));
    }

    fn add_tangent(
        &self,
        of: &Bushing<D>,
        at: Instant<'_, D>,
        stiffness: Add<'_, D>,
        damping: Add<'_, D>,
    ) {
        let (end, [_, moment]): (Attachment<D>, _) = (self.end(), of.force(at));
        let u = end.direction(at.x);
        let turn = perpendicular(u) / u.norm_squared();
        let outer: SMatrix<f64, D, D> = turn * turn.transpose();
        let ends = [end, Attachment::Ground(Vector::zeros())];
        let alone = |k: SMatrix<f64, D, D>| [[k, SMatrix::zeros()], [SMatrix::zeros(); 2]];
        let k = outer * of.stiffness[1][2] + end.curl(at.x) * moment.z;
        coupling(&ends, alone(k), 1, stiffness);
        let c = of.damping[1][2];
        if c > 0.0 {
            coupling(&ends, alone(outer * c), 1, damping);
        }
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        [&self.angle, &self.velocity].into_iter().for_each(call);
    }

    fn hold(&mut self, at: Instant<'_, D>) {
        self.angle = self.angle.held(at, 1.0);
        self.velocity = self.velocity.held(at, 1.0);
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        vec![self.end()]
    }
}
