//! Dry friction on a coordinate of a joint. While it slides, the force is that of Coulomb with Stribeck's fall, against the direction of
//! sliding, which the state keeps. While it sticks, a constraint holds the coordinate (`motion/frictions.rs`), and the load has no force.
//!
//! Source: B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, A survey of models, analysis tools and compensation methods for the control
//! of machines with friction, Automatica 30 (1994) 1083-1138, equation 2.

use super::{Add, ForceElement, Instant};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::coordinate::Coordinate;
use crate::system::end::Attachment;
use crate::system::signal::{FrictionState, Signal};

/// Friction on a coordinate of a joint.
#[derive(Clone, Debug)]
pub struct JointFriction<const D: usize = 2> {
    /// Coordinate that it acts on.
    pub coordinate: Box<Coordinate<D>>,
    /// Force while it slides fast, N or N m. A negative one counts as none.
    pub force: Signal,
    /// Largest force while it sticks, in parts of `force`, at least 1.
    pub static_ratio: f64,
    /// Speed over which the force falls from the largest to `force`, m/s or rad/s; 0 for at once.
    pub stribeck_speed: f64,
    /// Where the state keeps direction and place.
    pub state: FrictionState,
}

impl<const D: usize> JointFriction<D> {
    /// Direction in which it slides: 1, -1, or 0 where it sticks.
    fn direction<N: Number>(&self, at: Instant<'_, D, N>) -> f64 {
        at.drives[self.state.direction][0].plain()
    }

    /// Force while it slides fast, N or N m.
    fn level<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let level = self.force.value(at);
        if level.plain() > 0.0 {
            level
        } else {
            N::of(0.0)
        }
    }

    /// Largest force while it sticks, N or N m.
    pub(in crate::system) fn limit(&self, at: Instant<'_, D>) -> f64 {
        self.static_ratio * self.level(at)
    }

    /// Force on the coordinate while it slides, N or N m.
    pub fn force<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let direction = self.direction(at);
        if direction == 0.0 {
            return N::of(0.0);
        }
        let mut ratio = N::of(1.0);
        let excess = self.static_ratio - 1.0;
        if excess > 0.0 && self.stribeck_speed > 0.0 {
            let rate = self.coordinate.rate(at.x, at.v) / N::of(self.stribeck_speed);
            ratio += N::of(excess) * (-(rate * rate)).exp();
        }
        N::of(-direction) * ratio * self.level(at)
    }
}

impl<const D: usize> ForceElement<D> for JointFriction<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        if self.direction(at) != 0.0 {
            self.coordinate.act(self.force(at), at.x, call);
        }
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, _damping: Add<'_, D>) {
        // The fall of the force by the rate is negative damping, which no factor of the tangent has.
        if self.direction(at) != 0.0 {
            (self.coordinate).add_hessian(-self.force(at), at.x, stiffness);
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        if self.direction(at) == 0.0 {
            return [N::of(0.0); 2];
        }
        let rate = self.coordinate.rate(at.x, at.v);
        [N::of(0.0), -self.force(at) * rate]
    }

    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let [from, to] = [before, after].map(|at| self.coordinate.value(at.x, at.angles.1));
        self.force(before) * (to - from)
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        self.force = self.force.held(at, fraction);
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        call(&self.force);
    }

    fn is_conservative(&self) -> bool {
        false
    }

    fn is_moment(&self) -> bool {
        self.coordinate.is_angle()
    }

    fn is_damped(&self) -> bool {
        true
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.coordinate.ends().to_vec()
    }
}
