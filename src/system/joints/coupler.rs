//! Coordinates of joints in a linear relation: `sum of factor * coordinate = offset + drive`. One that is driven; the way and
//! the angle of a screw; the coordinates of two joints that a gear couples.
//!
//! Source: E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems (1989), sections 3.4 (gears), 9.4 (screws)
//! and 3.5 (drivers).

use super::{Equation, Gradient, View};
use crate::bodies::Bodies;
use crate::math::jet::Number;
use crate::system::coordinate::Coordinate;
use crate::system::end::{Add, Attachment};

/// A relation between coordinates.
#[derive(Clone, Debug)]
pub struct Coupler<const D: usize> {
    /// Coordinates and their factors: one or two.
    pub terms: Vec<(f64, Coordinate<D>)>,
    /// Constant part of the sum, m or rad.
    pub offset: f64,
    /// Driven coordinate to add to it.
    pub drive: Option<usize>,
    /// Reference size of residuals: m, or 1 for angles.
    pub size: f64,
}

impl<const D: usize> Coupler<D> {
    /// Value of the driven coordinate or one of its derivatives.
    fn driven<N: Number>(&self, view: &View<'_, D, N>, order: usize) -> N {
        let drive = self.drive.map(|drive| view.drives[drive][order]);
        drive.unwrap_or_else(|| N::of(0.0))
    }

    fn sum<N: Number>(&self, of: impl Fn(&Coordinate<D>) -> N) -> N {
        let terms = self.terms.iter();
        terms.fold(N::of(0.0), |sum, (factor, coordinate)| {
            sum + of(coordinate) * N::of(*factor)
        })
    }

    /// One pair of ends for every coordinate.
    pub(super) fn gradients<N: Number>(
        &self,
        view: &View<'_, D, N>,
    ) -> impl Iterator<Item = Gradient<D, N>> {
        let terms = self.terms.iter();
        terms.map(|(factor, of)| of.gradient(view.x).scaled(N::of(*factor)))
    }
}

impl<const D: usize> Equation<D> for Coupler<D> {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        self.sum(|of| of.value(view.x, view.angles)) - self.driven(view, 0) - N::of(self.offset)
    }

    fn rate<N: Number>(&self, view: &View<'_, D, N>) -> N {
        -self.driven(view, 1)
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        self.sum(|of| of.bend(view.x, view.v)) - self.driven(view, 2)
    }

    fn stiffness(&self, lambda: f64, view: &View<'_, D>, add: Add<'_, D>) {
        for (factor, of) in &self.terms {
            of.add_hessian(lambda * factor, view.x, &mut *add);
        }
    }

    /// The ends that it joins.
    fn ends(&self) -> Vec<Attachment<D>> {
        self.terms.iter().flat_map(|(_, of)| of.ends()).collect()
    }

    /// Whether it is one of angles.
    fn is_angle(&self) -> bool {
        self.terms.iter().all(|(_, of)| of.is_angle())
    }

    fn size(&self, _bodies: &Bodies<D>) -> f64 {
        self.size
    }

    fn is_stiff(&self) -> bool {
        true
    }
}
