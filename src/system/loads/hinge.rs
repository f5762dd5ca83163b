//! The rotational spring with a damper of a hinge: between two directions.

use super::{Add, Instant};
use crate::body::{Node, left};
use crate::system::end::End;

/// A rotational spring and a damper in parallel between two directions.
#[derive(Clone, Debug)]
pub struct Rotational {
    /// Its ends.
    pub ends: [End; 2],
    /// Index of the angle from the first to the second among those that the system counts.
    pub angle: usize,
    /// Stiffness, N m/rad.
    pub stiffness: f64,
    /// Damping, N m s/rad.
    pub damping: f64,
    /// Angle without moment, rad.
    pub rest: f64,
}

impl Rotational {
    fn turn(&self, at: Instant<'_>) -> f64 {
        at.angles.0[self.angle].value(at.x, at.angles.1[self.angle]) - self.rest
    }

    fn rate(&self, at: Instant<'_>) -> f64 {
        self.ends[1].spin(at.x, at.v) - self.ends[0].spin(at.x, at.v)
    }

    /// Moment on the second end, N m.
    pub fn moment(&self, at: Instant<'_>) -> f64 {
        -self.stiffness * self.turn(at) - self.damping * self.rate(at)
    }

    pub(super) fn add_force(&self, at: Instant<'_>, f: &mut [Node<4>]) {
        let moment = self.moment(at);
        self.ends[1].add_moment(moment, at.x, f);
        self.ends[0].add_moment(-moment, at.x, f);
    }

    pub(super) fn add_tangent(&self, at: Instant<'_>, stiffness: Add<'_>, damping: Add<'_>) {
        let moment = self.moment(at);
        // Derivatives of the angle by both directions.
        let [a, b] = self.ends.map(|end| {
            let u = end.direction(at.x);
            left(u) / u.norm_squared()
        });
        let outer = |k: f64| {
            let [aa, ab, bb] = [a * a.transpose(), a * b.transpose(), b * b.transpose()];
            [[aa * k, -ab * k], [-ab.transpose() * k, bb * k]]
        };
        let mut k = outer(self.stiffness);
        k[0][0] -= super::moment::curl(&self.ends[0], at.x) * moment;
        k[1][1] += super::moment::curl(&self.ends[1], at.x) * moment;
        super::coupling(&self.ends, k, 1, stiffness);
        if self.damping > 0.0 {
            super::coupling(&self.ends, outer(self.damping), 1, damping);
        }
    }

    pub(super) fn dissipation(&self, at: Instant<'_>) -> f64 {
        let rate = self.rate(at);
        self.damping * rate * rate
    }

    pub(super) fn energy(&self, at: Instant<'_>) -> f64 {
        let turn = self.turn(at);
        0.5 * self.stiffness * turn * turn
    }
}
