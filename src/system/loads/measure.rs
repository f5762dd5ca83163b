//! What a spring or a law of force is over: the length between two ends, or a coordinate of a joint.

use nalgebra::SMatrix;

use super::spring::Span;
use super::{Add, Instant};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::coordinate::Coordinate;
use crate::system::end::{Attachment, between};

/// A length between two ends, or a coordinate of a joint.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there are few")]
pub enum Measure<const D: usize = 2> {
    /// Length between two ends, m.
    Length([Attachment<D>; 2]),
    /// Coordinate of a joint, m or rad.
    Coordinate(Box<Coordinate<D>>),
}

impl<const D: usize> Measure<D> {
    /// Value, m or rad; not of an angle that `is_wanted` does not ask for, since no turns are counted then. Rate, m/s or rad/s.
    pub fn read<N: Number>(&self, at: Instant<'_, D, N>, is_wanted: bool) -> [N; 2] {
        match self {
            Self::Length(ends) => {
                let span = Span::new(ends, at);
                [span.length, span.speed]
            }
            Self::Coordinate(of) => {
                let rate = of.rate(at.x, at.v);
                if is_wanted {
                    [of.value(at.x, at.angles.1), rate]
                } else {
                    [N::of(0.0), rate]
                }
            }
        }
    }

    /// Calls with both ends and the forces there of a force against growth, N or N m.
    pub fn act<N: Number>(
        &self,
        force: N,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        match self {
            Self::Length(ends) => {
                let (pull, none) = (Span::new(ends, at).unit * force, Vector::zeros());
                let [first, second] = ends.map(|end| end.lift());
                call(&first, [pull, none]);
                call(&second, [-pull, none]);
            }
            Self::Coordinate(of) => of.act(-force, at.x, call),
        }
    }

    /// Adds the tangent of a force against growth whose derivatives by value and by rate are given.
    pub fn add_tangent(
        &self,
        at: Instant<'_, D>,
        force: f64,
        [by_value, by_rate]: [f64; 2],
        (stiffness, damping): (Add<'_, D>, Add<'_, D>),
    ) {
        match self {
            Self::Length(ends) => {
                let span = Span::new(ends, at);
                let along: SMatrix<f64, D, D> = span.unit * span.unit.transpose();
                // The part that turns stays out where it has no direction.
                let turn = if span.length > 0.0 {
                    force / span.length
                } else {
                    0.0
                };
                let across = SMatrix::identity() - along;
                between(ends, along * by_value + across * turn, 0, stiffness);
                if by_rate != 0.0 {
                    between(ends, along * by_rate, 0, damping);
                }
            }
            Self::Coordinate(of) => {
                if by_value != 0.0 {
                    of.add_square(by_value, at.x, &mut *stiffness);
                }
                of.add_hessian(force, at.x, stiffness);
                if by_rate != 0.0 {
                    of.add_square(by_rate, at.x, damping);
                }
            }
        }
    }

    /// Returns the ends that a force along it acts on.
    pub fn ends(&self) -> Vec<Attachment<D>> {
        match self {
            Self::Length(ends) => ends.to_vec(),
            Self::Coordinate(of) => of.ends().to_vec(),
        }
    }

    /// Whether a force along it ties an end to a point of the ground.
    pub fn is_grounded(&self) -> bool {
        match self {
            Self::Length(ends) => ends.iter().any(|end| end.marker().is_none()),
            Self::Coordinate(_) => false,
        }
    }

    /// Whether it is an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Coordinate(of) if of.is_angle())
    }
}
