//! Limits (stops) of a joint coordinate, without friction: the only coordinate known here is that along which they push. Beyond a limit by
//! `d`, the force `k d (1 + a d')` pushes back. It is continuous, damping with it, since a damper beside the spring would push all at once
//! where contact begins; its derivatives have a kink there, which the control of errors steps up to. Where the coordinate leaves so fast
//! that the bracket is negative, it pushes no more: nothing sticks.
//!
//! Source: K. H. Hunt, F. R. E. Crossley, Coefficient of restitution interpreted as damping in vibroimpact, Journal of Applied
//! Mechanics 42 (1975) 440-445, with a force that is linear in `d`.

use super::{Add, ForceElement, Instant};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::coordinate::Coordinate;
use crate::system::end::Attachment;

/// Stops at the ends of the range of a coordinate.
#[derive(Clone, Debug)]
pub struct JointLimit<const D: usize = 2> {
    /// Coordinate that the stops limit.
    pub coordinate: Box<Coordinate<D>>,
    /// Limits below and above, m or rad; infinite where there is none.
    pub limits: [f64; 2],
    /// Stiffness, N/m or N m/rad.
    pub stiffness: f64,
    /// Damping relative to the stiffness, s/m or s/rad.
    pub damping: f64,
}

/// How a coordinate is beyond a limit.
struct LimitContact<N> {
    /// By how much, m or rad.
    depth: N,
    /// How fast it goes deeper.
    rate: N,
    /// 1 above, -1 below.
    side: f64,
}

impl<const D: usize> JointLimit<D> {
    /// None within the limits.
    fn contact<N: Number>(&self, at: Instant<'_, D, N>) -> Option<LimitContact<N>> {
        let value = self.coordinate.value(at.x, at.angles.1);
        let [lower, upper] = self.limits;
        let (side, limit) = match value.plain() {
            below if below < lower => (-1.0, lower),
            above if above > upper => (1.0, upper),
            _ => return None,
        };
        let rate = self.coordinate.rate(at.x, at.v);
        Some(LimitContact {
            depth: (value - N::of(limit)) * N::of(side),
            rate: rate * N::of(side),
            side,
        })
    }

    /// The bracket of the force: 0 where the coordinate leaves too fast.
    fn damped<N: Number>(&self, contact: &LimitContact<N>) -> N {
        let factor = N::of(1.0) + N::of(self.damping) * contact.rate;
        if factor.plain() > 0.0 {
            factor
        } else {
            N::of(0.0)
        }
    }

    /// Force on the coordinate, N or N m.
    pub fn force<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.contact(at).map_or(N::of(0.0), |contact| {
            let push = N::of(self.stiffness) * contact.depth * self.damped(&contact);
            push * N::of(-contact.side)
        })
    }

    /// Where it no longer pushes, what it has stored is lost.
    pub(super) fn dissipation<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.contact(at).map_or(N::of(0.0), |contact| {
            let beyond = self.damped(&contact) - N::of(1.0);
            N::of(self.stiffness) * contact.depth * beyond * contact.rate
        })
    }
}

impl<const D: usize> ForceElement<D> for JointLimit<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        if self.contact(at).is_some() {
            self.coordinate.act(self.force(at), at.x, call);
        }
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let Some(contact) = self.contact(at) else {
            return;
        };
        let (of, factor) = (&self.coordinate, self.damped(&contact));
        of.add_square(self.stiffness * factor, at.x, &mut *stiffness);
        of.add_hessian(-self.force(at), at.x, stiffness);
        if factor > 0.0 {
            of.add_square(self.stiffness * self.damping * contact.depth, at.x, damping);
        }
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.contact(at).map_or(N::of(0.0), |contact| {
            N::of(0.5 * self.stiffness) * contact.depth * contact.depth
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
        self.damping > 0.0
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.coordinate.ends().to_vec()
    }
}
