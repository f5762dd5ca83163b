//! A spring with a damper whose forces are curves over a length or a coordinate of a joint, and over its rate.

use super::measure::Measure;
use super::{Add, ForceElement, Instant};
use crate::math::curve::Curve;
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::end::Attachment;

/// A spring and a damper in parallel.
#[derive(Clone, Debug)]
pub struct TableSpring<const D: usize = 2> {
    /// Length or coordinate that they act against.
    pub measure: Measure<D>,
    /// Force of the spring against growth, N or N m, over the length or coordinate, m or rad.
    pub spring: Curve,
    /// Force of the damper against growth, N or N m, over the rate, m/s or rad/s; zero at rest.
    pub damper: Option<Curve>,
}

impl<const D: usize> TableSpring<D> {
    /// Force of the damper, N or N m.
    fn damping<N: Number>(&self, rate: N) -> N {
        let damper = self.damper.as_ref();
        damper.map_or(N::of(0.0), |damper| damper.value(rate))
    }

    /// Force against growth, N or N m.
    fn force<N: Number>(&self, [value, rate]: [N; 2]) -> N {
        self.spring.value(value) + self.damping(rate)
    }
}

impl<const D: usize> ForceElement<D> for TableSpring<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let force = self.force(self.measure.read(at, true));
        self.measure.act(force, at, call);
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let read = self.measure.read(at, true);
        let by_value = self.spring.slope(read[0]);
        let by_rate = (self.damper.as_ref()).map_or(0.0, |damper| damper.slope(read[1]));
        let slopes = [by_value, by_rate];
        (self.measure).add_tangent(at, self.force(read), slopes, (stiffness, damping));
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let [_, rate] = self.measure.read(at, true);
        [N::of(0.0), self.damping(rate) * rate]
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.spring.integral(self.measure.read(at, true)[0])
    }

    fn is_moment(&self) -> bool {
        self.measure.is_angle()
    }

    fn is_damped(&self) -> bool {
        self.damper.is_some()
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.measure.ends()
    }

    fn is_grounded(&self) -> bool {
        self.measure.is_grounded()
    }
}
