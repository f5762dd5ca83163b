//! Distance link: a massless rigid rod, `(d.d - L^2) / (2 L) = 0`.

use super::{ConstraintKind, Equation, Gradient, Rows, View};
use crate::bodies::Bodies;
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::end::{Add, Attachment, isotropic};

/// Two ends at a fixed distance.
#[derive(Clone, Debug)]
pub struct Distance<const D: usize> {
    /// The ends.
    pub ends: [Attachment<D>; 2],
    /// Length, m.
    pub length: f64,
}

/// Holds the distance of the ends, m.
pub(super) fn hold<const D: usize>(rows: &Rows<'_, D>, length: f64) -> Option<ConstraintKind<D>> {
    let ends = *rows.ends;
    Some(ConstraintKind::Distance(Distance { ends, length }))
}

impl<const D: usize> Distance<D> {
    pub(super) fn gradient<N: Number>(&self, view: &View<'_, D, N>) -> Gradient<D, N> {
        let (none, [a, b]) = (Vector::zeros(), self.ends.map(|end| end.lift()));
        let unit = (b.position(view.x) - a.position(view.x)) / N::of(self.length);
        Gradient {
            ends: [(a, [-unit, none]), (b, [unit, none])],
        }
    }
}

impl<const D: usize> Equation<D> for Distance<D> {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let [a, b] = self.ends.map(|end| end.lift().position(view.x));
        let length = N::of(self.length);
        ((b - a).norm_squared() - length * length) / (length + length)
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let [a, b] = self.ends.map(|end| end.lift().velocity(view.v));
        (b - a).norm_squared() / N::of(self.length)
    }

    fn stiffness(&self, lambda: f64, _view: &View<'_, D>, add: Add<'_, D>) {
        isotropic(&self.ends, lambda / self.length, add);
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.ends.to_vec()
    }

    fn size(&self, _bodies: &Bodies<D>) -> f64 {
        self.length
    }

    fn is_stiff(&self) -> bool {
        true
    }
}
