//! A bushing: springs and dampers in parallel along and about three axes, linear in a translation and a rotation. These are measured
//! between the frames of two ends, or from a point, an angle or an orientation that moves to a marker: one file a measure.

mod angle;
mod frames;
mod orientation;
mod point;

pub use angle::FromAngle;
pub use frames::BetweenFrames;
pub use orientation::FromOrientation;
pub use point::FromPoint;

use nalgebra::Vector3;

use super::{Add, ForceElement, Instant};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::end::Attachment;
use crate::system::signal::Signal;

/// Springs and dampers in parallel.
#[derive(Clone, Debug)]
pub struct Bushing<const D: usize = 2> {
    /// Translation and rotation on which they act.
    pub measure: BushingMeasure<D>,
    /// Stiffness along (N/m) and about (N m/rad) three axes.
    pub stiffness: [[f64; 3]; 2],
    /// Damping along (N s/m) and about (N m s/rad) three axes.
    pub damping: [[f64; 3]; 2],
}

/// Origin of the translation and the rotation of a bushing.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "a bushing is boxed")]
pub enum BushingMeasure<const D: usize = 2> {
    /// From the frame of one end to that of another, in space.
    Frames(BetweenFrames<D>),
    /// From a point that moves to a marker.
    Point(FromPoint<D>),
    /// From an angle that moves to the direction of a marker, in the plane.
    Angle(FromAngle),
    /// From an orientation that moves to that of a body, in space.
    Orientation(FromOrientation),
}

/// A translation (m) and a rotation (rad), their rates, or the force (N) and the moment (N m) that are conjugate to them.
type SixComponents<N = f64> = [Vector3<N>; 2];

/// Translation and rotation of a bushing.
trait DeformationMeasure<const D: usize> {
    /// Returns translation and rotation, and their rates relative to the velocities that come in.
    fn deformation<N: Number>(&self, at: Instant<'_, D, N>) -> [SixComponents<N>; 2];

    /// Returns the rates of the position and angle that come in, and the velocities that come in. The two need not be consistent.
    fn driven<N: Number>(&self, _at: Instant<'_, D, N>) -> [SixComponents<N>; 2] {
        [[Vector3::zeros(); 2]; 2]
    }

    /// Returns the change of translation and rotation, that of a rotation exact where it is small.
    fn way(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> SixComponents {
        let [[before, _], [after, _]] = [before, after].map(|at| self.deformation(at));
        [after[0] - before[0], after[1] - before[1]]
    }

    /// Calls with ends and the forces there of a force and a moment that are conjugate to translation and rotation.
    fn act<N: Number>(
        &self,
        on: SixComponents<N>,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    );

    /// Adds the tangent of a bushing with this measure.
    fn add_tangent(
        &self,
        of: &Bushing<D>,
        at: Instant<'_, D>,
        stiffness: Add<'_, D>,
        damping: Add<'_, D>,
    );

    /// Calls with every time-dependent size.
    fn each_signal<'a>(&'a self, _call: &mut dyn FnMut(&'a Signal)) {}

    /// Freezes what comes in at an instant.
    fn hold(&mut self, _at: Instant<'_, D>) {}

    /// Returns the ends between which the tangent couples.
    fn ends(&self) -> Vec<Attachment<D>>;
}

/// Calls a function of the measure at hand.
macro_rules! measured {
    ($bushing:expr, $of:ident => $call:expr) => {
        match $bushing {
            BushingMeasure::Frames($of) => $call,
            BushingMeasure::Point($of) => $call,
            BushingMeasure::Angle($of) => $call,
            BushingMeasure::Orientation($of) => $call,
        }
    };
}

impl<const D: usize> Bushing<D> {
    /// Returns force (N) and moment (N m) on what it is measured from; their opposites act on the marker or the second end.
    pub fn reaction<N: Number>(&self, at: Instant<'_, D, N>) -> [Vector3<N>; 2] {
        self.force(at).map(|on| -on)
    }

    fn force<N: Number>(&self, at: Instant<'_, D, N>) -> SixComponents<N> {
        let [strain, rate] = measured!(&self.measure, of => of.deformation(at));
        [0, 1].map(|of| {
            let [k, c] = [self.stiffness[of], self.damping[of]].map(Vector3::from);
            -strain[of].component_mul(&k.map(N::of)) - rate[of].component_mul(&c.map(N::of))
        })
    }
}

impl<const D: usize> ForceElement<D> for Bushing<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let on = self.force(at);
        measured!(&self.measure, of => of.act(on, at, call));
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        measured!(&self.measure, of => of.add_tangent(self, at, stiffness, damping));
    }

    /// The springs work on the rates of the positions that come in, the dampers on the velocities that come in.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let [strain, rate] = measured!(&self.measure, of => of.deformation(at));
        let [speed, velocity] = measured!(&self.measure, of => of.driven(at));
        let pull =
            weighted(&self.stiffness, &strain, &speed) + weighted(&self.damping, &rate, &velocity);
        [-pull, weighted(&self.damping, &rate, &rate)]
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let [strain, _] = measured!(&self.measure, of => of.deformation(at));
        weighted(&self.stiffness, &strain, &strain) * N::of(0.5)
    }

    /// The part of the damping force that the velocities which come in make is dead.
    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let [_, velocity] = measured!(&self.measure, of => of.driven(before));
        let way = measured!(&self.measure, of => of.way(before, after));
        let dead = weighted(&self.damping, &velocity, &way);
        self.energy(before) - self.energy(after) + dead
    }

    fn hold(&mut self, at: Instant<'_, D>, _fraction: f64) {
        measured!(&mut self.measure, of => of.hold(at));
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        measured!(&self.measure, of => DeformationMeasure::<D>::each_signal(of, call));
    }

    fn is_moment(&self) -> bool {
        !matches!(self.measure, BushingMeasure::Point(_))
    }

    fn is_damped(&self) -> bool {
        self.damping.as_flattened().iter().any(|c| *c > 0.0)
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        measured!(&self.measure, of => of.ends())
    }

    fn is_grounded(&self) -> bool {
        matches!(self.measure, BushingMeasure::Point(_))
    }
}

/// Sum of products with weights.
fn weighted<N: Number>(weights: &[[f64; 3]; 2], a: &SixComponents<N>, b: &SixComponents<N>) -> N {
    let mut sum = N::of(0.0);
    for (part, weights) in weights.iter().enumerate() {
        for (k, weight) in weights.iter().enumerate() {
            sum += a[part][k] * b[part][k] * N::of(*weight);
        }
    }
    sum
}
