//! A spring with a damper whose forces are curves over a length or a coordinate of a joint, and over its rate.

use super::{Add, ForceElement, Instant};
use crate::math::curve::Curve;
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::coordinate::Coordinate;
use crate::system::end::Attachment;

/// A spring and a damper in parallel.
#[derive(Clone, Debug)]
pub struct TableSpring<const D: usize = 2> {
    /// Length or coordinate that they act against.
    pub on: Box<Coordinate<D>>,
    /// Force of the spring against growth, N or N m, over the length or coordinate, m or rad.
    pub spring: Curve,
    /// Force of the damper against growth, N or N m, over the rate, m/s or rad/s; zero at rest.
    pub damper: Option<Curve>,
}

impl<const D: usize> TableSpring<D> {
    /// Rate of that coordinate, m/s or rad/s.
    pub fn rate<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.on.rate(at.x, at.v)
    }

    /// Coordinate that it acts along, m or rad.
    pub fn value<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.on.value(at.x, at.angles.1)
    }

    /// Force of the damper, N or N m.
    fn damping<N: Number>(&self, rate: N) -> N {
        let damper = self.damper.as_ref();
        damper.map_or(N::of(0.0), |damper| damper.value(rate))
    }

    /// Force against growth, N or N m.
    pub fn force<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.spring.value(self.value(at)) + self.damping(self.rate(at))
    }
}

impl<const D: usize> ForceElement<D> for TableSpring<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        self.on.act(-self.force(at), at.x, call);
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let slope = self.spring.slope(self.value(at));
        self.on.add_square(slope, at.x, &mut *stiffness);
        self.on.add_hessian(self.force(at), at.x, stiffness);
        if let Some(damper) = &self.damper {
            let slope = damper.slope(self.rate(at));
            self.on.add_square(slope, at.x, damping);
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let rate = self.rate(at);
        [N::of(0.0), self.damping(rate) * rate]
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.spring.integral(self.value(at))
    }

    fn is_moment(&self) -> bool {
        self.on.is_angle()
    }

    fn is_damped(&self) -> bool {
        self.damper.is_some()
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.on.ends().to_vec()
    }

    fn is_grounded(&self) -> bool {
        self.on.is_grounded_length()
    }
}
