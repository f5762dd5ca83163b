//! Limits of a joint coordinate. Beyond a limit the force of a [`OneSidedSpring`] pushes back.
//!
//! They have no friction. The only coordinate known here is that along which they push, so a law of friction needs a direction of slip
//! besides.
//!
//! Source: as for the spring.

use super::one_sided_spring::Compression;
use super::{Add, ForceElement, Instant, OneSidedSpring};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::coordinate::Coordinate;
use crate::system::end::Attachment;

/// Limits of a coordinate of a joint.
#[derive(Clone, Debug)]
pub struct JointLimit<const D: usize = 2> {
    /// Coordinate that is limited.
    pub coordinate: Box<Coordinate<D>>,
    /// Limits below and above, m or rad; infinite where there is none.
    pub limits: [f64; 2],
    /// Spring that pushes back beyond either limit.
    pub spring: OneSidedSpring,
}

impl<const D: usize> JointLimit<D> {
    /// Spring beyond a limit, and the side: 1 above, -1 below. `None` within the limits.
    fn beyond<N: Number>(&self, at: Instant<'_, D, N>) -> Option<(Compression<N>, f64)> {
        let value = self.coordinate.value(at.x, at.angles.1);
        let [lower, upper] = self.limits;
        let (side, limit) = match value.plain() {
            below if below < lower => (-1.0, lower),
            above if above > upper => (1.0, upper),
            _ => return None,
        };
        let depth = (value - N::of(limit)) * N::of(side);
        let rate = self.coordinate.rate(at.x, at.v) * N::of(side);
        Some((self.spring.compressed(depth, rate), side))
    }

    /// Force on the coordinate, N or N m.
    pub fn force<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.beyond(at).map_or(N::of(0.0), |(compression, side)| {
            compression.force() * N::of(-side)
        })
    }

    pub(super) fn dissipation<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.beyond(at)
            .map_or(N::of(0.0), |(compression, _)| compression.dissipation())
    }
}

impl<const D: usize> ForceElement<D> for JointLimit<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        if self.beyond(at).is_some() {
            self.coordinate.act(self.force(at), at.x, call);
        }
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let Some((compression, _)) = self.beyond(at) else {
            return;
        };
        let (of, [by_depth, by_rate]) = (&self.coordinate, compression.slopes());
        of.add_square(by_depth, at.x, &mut *stiffness);
        of.add_hessian(-self.force(at), at.x, stiffness);
        if by_rate > 0.0 {
            of.add_square(by_rate, at.x, damping);
        }
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.beyond(at).map_or(N::of(0.0), |(compression, _)| {
            self.spring.energy(compression.depth)
        })
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        [N::of(0.0), self.dissipation(at)]
    }

    fn is_moment(&self) -> bool {
        self.coordinate.is_angle()
    }

    fn has_contact(&self) -> bool {
        true
    }

    fn is_damped(&self) -> bool {
        self.spring.damping > 0.0
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.coordinate.ends().to_vec()
    }
}
