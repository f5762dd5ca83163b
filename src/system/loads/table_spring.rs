//! A spring with a damper between two points whose forces are curves over length and over its rate.

use nalgebra::SMatrix;

use super::spring::Span;
use super::{Add, ForceElement, Instant};
use crate::math::curve::Curve;
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::end::{Attachment, between};

/// A spring and a damper in parallel between two points.
#[derive(Clone, Debug)]
pub struct TableSpring<const D: usize = 2> {
    /// Ends of the spring.
    pub ends: [Attachment<D>; 2],
    /// Force with which the spring pulls, N, over the length, m.
    pub spring: Curve,
    /// Force with which the damper pulls, N, over the rate of the length, m/s; zero at rest.
    pub damper: Option<Curve>,
}

impl<const D: usize> TableSpring<D> {
    /// Force of the damper, N.
    fn damping<N: Number>(&self, span: &Span<D, N>) -> N {
        let damper = self.damper.as_ref();
        damper.map_or(N::of(0.0), |damper| damper.value(span.speed))
    }

    /// Force with which it pulls, N.
    fn tension<N: Number>(&self, span: &Span<D, N>) -> N {
        self.spring.value(span.length) + self.damping(span)
    }
}

impl<const D: usize> ForceElement<D> for TableSpring<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let (span, none) = (Span::new(&self.ends, at), Vector::zeros());
        let pull = span.unit * self.tension(&span);
        let [first, second] = self.ends.map(|end| end.lift());
        call(&first, [pull, none]);
        call(&second, [-pull, none]);
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let span = Span::new(&self.ends, at);
        let along: SMatrix<f64, D, D> = span.unit * span.unit.transpose();
        // The part that turns stays out where it has no direction.
        let turn = if span.length > 0.0 {
            self.tension(&span) / span.length
        } else {
            0.0
        };
        let across = SMatrix::identity() - along;
        let k = along * self.spring.slope(span.length) + across * turn;
        between(&self.ends, k, 0, stiffness);
        if let Some(damper) = &self.damper {
            between(&self.ends, along * damper.slope(span.speed), 0, damping);
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let span = Span::new(&self.ends, at);
        [N::of(0.0), self.damping(&span) * span.speed]
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.spring.integral(Span::new(&self.ends, at).length)
    }

    fn is_damped(&self) -> bool {
        self.damper.is_some()
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.ends.to_vec()
    }

    fn is_grounded(&self) -> bool {
        self.ends.iter().any(|end| end.marker().is_none())
    }
}
