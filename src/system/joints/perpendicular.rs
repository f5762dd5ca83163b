//! Right angles in space: a direction of one body across a direction of another, `d1 . d2 = 0`, or across the way between
//! two points, `d1 . (r2 - r1) = 0`. Revolute, universal, cylindrical, prismatic and planar joints and welds are made of
//! these and of points that coincide, with as many conditions as they take freedoms.
//!
//! Source: E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems (1989), section 9.4 ("dot-1" and
//! "dot-2" constraints).

use nalgebra::SMatrix;

use super::{Equation, Gradient, View};
use crate::bodies::Bodies;
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::direction::Direction;
use crate::system::end::{Add, Attachment, bilinear};

/// Vector that a direction is perpendicular to.
#[derive(Clone, Debug)]
pub enum Across<const D: usize> {
    /// A direction.
    Direction(Direction<D>),
    /// The way from the first point to the second; residuals are relative to a size, m.
    Translation([Attachment<D>; 2], f64),
}

/// A right angle.
#[derive(Clone, Debug)]
pub struct Perpendicular<const D: usize> {
    /// The direction.
    pub direction: Direction<D>,
    /// Vector that the direction is perpendicular to.
    pub across: Across<D>,
}

impl<const D: usize> Perpendicular<D> {
    /// The second entry is on the second body.
    pub(super) fn gradient<N: Number>(&self, view: &View<'_, D, N>) -> Gradient<D, N> {
        let none = Vector::zeros();
        let first = self.direction.value(view.x);
        match &self.across {
            Across::Direction(second) => Gradient {
                ends: [
                    (self.direction.end().lift(), [none, second.value(view.x)]),
                    (second.end().lift(), [none, first]),
                ],
            },
            Across::Translation(points, _) => {
                let [_, b] = points.map(|end| end.lift());
                let way = way(points, view);
                // The direction belongs to the marker of the first point, if to any.
                let first_end = match self.direction {
                    Direction::Of(marker) => (Attachment::Body(marker.lift()), [-first, way]),
                    Direction::Fixed(_) => (points[0].lift(), [-first, none]),
                };
                Gradient {
                    ends: [first_end, (b, [first, none])],
                }
            }
        }
    }
}

impl<const D: usize> Equation<D> for Perpendicular<D> {
    /// The ends that it joins.
    fn ends(&self) -> Vec<Attachment<D>> {
        let mut ends = vec![self.direction.end()];
        match &self.across {
            Across::Direction(second) => ends.push(second.end()),
            Across::Translation(points, _) => ends.extend(points),
        }
        ends
    }

    /// Whether it is between two directions.
    fn is_angle(&self) -> bool {
        matches!(self.across, Across::Direction(_))
    }

    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let first = self.direction.value(view.x);
        match &self.across {
            Across::Direction(second) => first.dot(&second.value(view.x)),
            Across::Translation(points, _) => first.dot(&way(points, view)),
        }
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let first = self.direction.rate(view.v);
        let second = match &self.across {
            Across::Direction(second) => second.rate(view.v),
            Across::Translation(points, _) => {
                let [a, b] = points.map(|end| end.lift().velocity(view.v));
                b - a
            }
        };
        N::of(2.0) * first.dot(&second)
    }

    fn stiffness(&self, lambda: f64, _view: &View<'_, D>, add: Add<'_, D>) {
        let Direction::Of(first) = &self.direction else {
            return;
        };
        let product = SMatrix::identity() * lambda;
        match &self.across {
            Across::Direction(Direction::Of(second)) => {
                bilinear([(first, 1), (second, 1)], product, add);
            }
            Across::Direction(Direction::Fixed(_)) => {}
            Across::Translation([_, b], _) => {
                if let Attachment::Body(second) = b {
                    bilinear([(first, 1), (second, 0)], product, add);
                }
                bilinear([(first, 1), (first, 0)], -product, add);
            }
        }
    }

    fn size(&self, _bodies: &Bodies<D>) -> f64 {
        match self.across {
            Across::Direction(_) => 1.0,
            Across::Translation(_, size) => size,
        }
    }

    fn is_stiff(&self) -> bool {
        true
    }
}

/// The way from the first point to the second.
fn way<const D: usize, N: Number>(
    points: &[Attachment<D>; 2],
    view: &View<'_, D, N>,
) -> Vector<D, N> {
    let [a, b] = points.map(|end| end.lift().position(view.x));
    b - a
}
