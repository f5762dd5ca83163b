//! A linear spring with a damper on a coordinate of a joint: along a line, about the axis of a revolute joint.

use super::{Add, ForceElement, Instant};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::coordinate::Coordinate;
use crate::system::end::Attachment;

/// A spring and a damper in parallel.
#[derive(Clone, Debug)]
pub struct JointSpring<const D: usize = 2> {
    /// Coordinate that spring and damper act on.
    pub coordinate: Box<Coordinate<D>>,
    /// Stiffness, N/m or N m/rad.
    pub stiffness: f64,
    /// Damping, N s/m or N m s/rad.
    pub damping: f64,
    /// Coordinate without force, m or rad.
    pub rest: f64,
}

impl<const D: usize> JointSpring<D> {
    /// How far it is from rest; a damper alone has none, and is not asked how far it has rotated.
    fn stretch<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        if self.stiffness == 0.0 {
            return N::of(0.0);
        }
        self.coordinate.value(at.x, at.angles.1) - N::of(self.rest)
    }

    /// Force on the coordinate, N or N m.
    #[inline(always)]
    pub fn force<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let rate = self.coordinate.rate(at.x, at.v);
        -N::of(self.stiffness) * self.stretch(at) - N::of(self.damping) * rate
    }

    pub(super) fn dissipation<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let rate = self.coordinate.rate(at.x, at.v);
        N::of(self.damping) * rate * rate
    }
}

impl<const D: usize> ForceElement<D> for JointSpring<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        self.coordinate.act(self.force(at), at.x, call);
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let of = &self.coordinate;
        if self.stiffness != 0.0 {
            of.add_square(self.stiffness, at.x, &mut *stiffness);
        }
        of.add_hessian(-self.force(at), at.x, stiffness);
        if self.damping > 0.0 {
            of.add_square(self.damping, at.x, damping);
        }
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let stretch = self.stretch(at);
        N::of(0.5 * self.stiffness) * stretch * stretch
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        [N::of(0.0), self.dissipation(at)]
    }

    fn is_moment(&self) -> bool {
        self.coordinate.is_angle()
    }

    fn is_damped(&self) -> bool {
        self.damping > 0.0
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.coordinate.ends().to_vec()
    }
}
