//! A spring with a damper between two points.

use nalgebra::SMatrix;

use super::{Add, ForceElement, Instant};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::coordinate::line;
use crate::system::end::{Attachment, between};
use crate::system::signal::Signal;

/// A spring and a damper in parallel between two points.
#[derive(Clone, Debug)]
pub struct Spring<const D: usize = 2> {
    /// Ends of the spring.
    pub ends: [Attachment<D>; 2],
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Length without force, m.
    pub length: Signal,
}

/// Straight line between the ends of a spring.
struct Span<const D: usize, N> {
    /// Unit vector from the first end to the second, of [`line`].
    pub unit: Vector<D, N>,
    /// Length, m.
    pub length: N,
    /// Rate of the length, m/s.
    pub speed: N,
}

impl<const D: usize, N: Number> Span<D, N> {
    /// Reads the span between two ends.
    pub fn new(ends: &[Attachment<D>; 2], at: Instant<'_, D, N>) -> Self {
        let (unit, length) = line(ends, at.x);
        let [a, b] = ends.map(|end| end.lift().velocity(at.v));
        let speed = unit.dot(&(b - a));
        Self {
            unit,
            length,
            speed,
        }
    }
}

impl<const D: usize> Spring<D> {
    fn span<N: Number>(&self, at: Instant<'_, D, N>) -> Span<D, N> {
        Span::new(&self.ends, at)
    }

    fn rest<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.length.value(at)
    }

    /// Distance of its ends, m, and the rate of that, m/s.
    pub fn path<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let span = self.span(at);
        [span.length, span.speed]
    }

    /// Force with which it pulls, N.
    pub fn tension<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let span = self.span(at);
        N::of(self.stiffness) * (span.length - self.rest(at)) + N::of(self.damping) * span.speed
    }
}

impl<const D: usize> ForceElement<D> for Spring<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let (Span { unit, speed, .. }, none) = (self.span(at), Vector::zeros());
        // Without a rest length it pulls to the other end however near that is: the part has no kink there.
        let [first, second] = self.ends.map(|end| end.lift());
        let [a, b] = [&first, &second].map(|end| end.position(at.x));
        let stiffness = N::of(self.stiffness);
        let pull =
            (b - a) * stiffness + unit * (N::of(self.damping) * speed - stiffness * self.rest(at));
        call(&first, [pull, none]);
        call(&second, [-pull, none]);
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let Span { unit, length, .. } = self.span(at);
        let along: SMatrix<f64, D, D> = unit * unit.transpose();
        // A spring in compression pushes itself aside; that part stays out where it has no direction.
        let turn = if length > 0.0 {
            self.tension(at) / length
        } else if self.rest(at) == 0.0 {
            self.stiffness
        } else {
            0.0
        };
        let k = along * self.stiffness + (SMatrix::identity() - along) * turn;
        between(&self.ends, k, 0, stiffness);
        if self.damping > 0.0 {
            between(&self.ends, along * self.damping, 0, damping);
        }
    }

    /// A rest length that changes does work; the part of the spring itself comes from its energy.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let Span { length, speed, .. } = self.span(at);
        let stretch = length - self.rest(at);
        let supplied = -N::of(self.stiffness) * stretch * self.length.rate(at);
        [supplied, N::of(self.damping) * speed * speed]
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let stretch = self.span(at).length - self.rest(at);
        N::of(0.5 * self.stiffness) * stretch * stretch
    }

    fn hold(&mut self, at: Instant<'_, D>, _fraction: f64) {
        self.length = self.length.held(at, 1.0);
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        call(&self.length);
    }

    fn is_damped(&self) -> bool {
        self.damping > 0.0
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.ends.to_vec()
    }

    fn is_grounded(&self) -> bool {
        self.ends.iter().any(|end| end.marker().is_none())
    }
}
