//! A spring with a damper between two points.

use nalgebra::{Matrix2, Vector2};

use super::{Add, Instant};
use crate::body::Node;
use crate::system::end::End;
use crate::system::signal::Signal;

/// A spring and a damper in parallel between two points.
#[derive(Clone, Debug)]
pub struct Spring {
    /// Its ends.
    pub ends: [End; 2],
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Length without force, m.
    pub length: Signal,
}

impl Spring {
    /// Unit vector from the first end to the second, length, speed of stretching. At length zero no
    /// direction is better than another, and none is taken.
    fn stretch(&self, at: Instant<'_>) -> (Vector2<f64>, f64, f64) {
        let [a, b] = &self.ends;
        let d = b.position(at.x) - a.position(at.x);
        let length = d.norm();
        let unit = if length > 0.0 { d / length } else { d };
        (
            unit,
            length,
            unit.dot(&(b.velocity(at.v) - a.velocity(at.v))),
        )
    }

    fn rest(&self, at: Instant<'_>) -> f64 {
        self.length.value(at.time, at.inputs)
    }

    /// Force with which it pulls, N.
    pub fn tension(&self, at: Instant<'_>) -> f64 {
        let (_, length, speed) = self.stretch(at);
        self.stiffness * (length - self.rest(at)) + self.damping * speed
    }

    pub(super) fn add_force(&self, at: Instant<'_>, f: &mut [Node<4>]) {
        let (unit, none) = (self.stretch(at).0, Vector2::zeros());
        let pull = unit * self.tension(at);
        self.ends[0].add_force(pull, none, f);
        self.ends[1].add_force(-pull, none, f);
    }

    pub(super) fn add_tangent(&self, at: Instant<'_>, stiffness: Add<'_>, damping: Add<'_>) {
        let (unit, length, _) = self.stretch(at);
        let along: Matrix2<f64> = unit * unit.transpose();
        // A spring in compression pushes itself aside; that part stays out where it has no length.
        let turn = if length > 0.0 {
            self.tension(at) / length
        } else {
            0.0
        };
        let k = along * self.stiffness + (Matrix2::identity() - along) * turn;
        super::between(&self.ends, k, 0, stiffness);
        if self.damping > 0.0 {
            super::between(&self.ends, along * self.damping, 0, damping);
        }
    }

    /// A rest length that changes does work; the part of the spring itself comes from its energy.
    pub(super) fn power(&self, at: Instant<'_>) -> [f64; 2] {
        let speed = self.stretch(at).2;
        let dissipated = self.damping * speed * speed;
        let Signal::Function(function) = &self.length else {
            return [0.0, dissipated];
        };
        let [rest, rate, _] = function.derivatives(at.time);
        let stretch = self.stretch(at).1 - rest;
        [-self.stiffness * stretch * rate, dissipated]
    }

    pub(super) fn energy(&self, at: Instant<'_>) -> f64 {
        let stretch = self.stretch(at).1 - self.rest(at);
        0.5 * self.stiffness * stretch * stretch
    }
}
