//! The rotational spring with a damper of a hinge: between two directions, in space about an axis.

use nalgebra::Vector3;

use super::{Add, Instant, couple};
use crate::math::jet::Number;
use crate::math::space::{Vector, perpendicular};
use crate::system::direction::AxisTurn;
use crate::system::end::{End, coupling};

/// A rotational spring and a damper in parallel between two directions.
#[derive(Clone, Debug)]
pub struct RotationalSpring<const D: usize = 2> {
    /// Its ends.
    pub ends: [End<D>; 2],
    /// Index of the angle from the first to the second among those that the system counts.
    pub angle: usize,
    /// Stiffness, N m/rad.
    pub stiffness: f64,
    /// Damping, N m s/rad.
    pub damping: f64,
    /// Angle without moment, rad.
    pub rest: f64,
    /// In space, what turns about what.
    pub turn: Option<Box<AxisTurn<D>>>,
}

impl<const D: usize> RotationalSpring<D> {
    fn turn<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        at.angles.0[self.angle].value(at.x, at.angles.1[self.angle]) - N::of(self.rest)
    }

    fn rate<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        if let Some(turn) = &self.turn {
            return turn.rate(at.x, at.v);
        }
        let [a, b] = self.ends.map(|end| end.lift().spin(at.x, at.v));
        b - a
    }

    /// Moment on the second end, N m.
    pub fn moment<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        -N::of(self.stiffness) * self.turn(at) - N::of(self.damping) * self.rate(at)
    }

    pub(super) fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&End<D, N>, [Vector<D, N>; 2]),
    ) {
        let moment = self.moment(at);
        if let Some(turn) = &self.turn {
            let moment = Vector3::from(turn.axis(at.x)) * moment;
            return couple::act(&self.ends, &moment, at.x, call);
        }
        let [first, second] = self.ends.map(|end| end.lift());
        call(&second, second.turn(moment, at.x));
        call(&first, first.turn(-moment, at.x));
    }

    pub(super) fn add_tangent(
        &self,
        at: Instant<'_, D>,
        stiffness: Add<'_, D>,
        damping: Add<'_, D>,
    ) {
        if let Some(turn) = &self.turn {
            // What a moment about an axis that turns adds is small beside inertia.
            turn.add_square(self.stiffness, at.x, stiffness);
            return turn.add_square(self.damping, at.x, damping);
        }
        let moment = self.moment(at);
        // Derivatives of the angle by both directions.
        let [a, b] = self.ends.map(|end| {
            let u = end.direction(at.x);
            perpendicular(u) / u.norm_squared()
        });
        let outer = |k: f64| {
            let [aa, ab, bb] = [a * a.transpose(), a * b.transpose(), b * b.transpose()];
            [[aa * k, -ab * k], [-ab.transpose() * k, bb * k]]
        };
        let mut k = outer(self.stiffness);
        k[0][0] -= super::moment::curl(&self.ends[0], at.x) * moment;
        k[1][1] += super::moment::curl(&self.ends[1], at.x) * moment;
        coupling(&self.ends, k, 1, stiffness);
        if self.damping > 0.0 {
            coupling(&self.ends, outer(self.damping), 1, damping);
        }
    }

    pub(super) fn dissipation<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let rate = self.rate(at);
        N::of(self.damping) * rate * rate
    }

    pub(super) fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let turn = self.turn(at);
        N::of(0.5 * self.stiffness) * turn * turn
    }
}
