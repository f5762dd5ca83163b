//! A system at an instant, as loads see it.

use super::end::Angle;
use crate::bodies::winch::PaidOut;
use crate::bodies::{Bodies, Node};
use crate::math::jet::Number;

/// Time, inputs and state as loads see them.
#[derive(Clone, Copy)]
pub struct Instant<'a, const D: usize, N = f64> {
    /// Time, s.
    pub time: N,
    /// Inputs at this time.
    pub inputs: &'a [N],
    /// Rates of the inputs, in their units per second.
    pub input_rates: &'a [N],
    /// Driven coordinates with two derivatives.
    pub drives: &'a [[N; 3]],
    /// Nodal coordinates.
    pub x: &'a [Node<D, N>],
    /// Rates of the nodal coordinates.
    pub v: &'a [Node<D, N>],
    /// Bodies.
    pub bodies: &'a Bodies<D>,
    /// Counted angles of the system and their current values, rad.
    pub angles: (&'a [Angle<D>], &'a [N]),
}

impl<'a, const D: usize, N: Number> Instant<'a, D, N> {
    /// The body with this first node, if a winch pays it out.
    pub fn paid_out(&self, first: usize) -> Option<PaidOut<'a, D, N>> {
        self.bodies.paid_out(first, self.drives)
    }
}
