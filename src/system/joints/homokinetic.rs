//! A homokinetic joint between two shafts in space: what it transmits rotates both at the same rate, whatever the angle between their axes.
//! With unit vectors `n` and `m = a x n` across the axis `a` of the first shaft and `n'`, `m'` likewise of the second,
//! `g = m . n' - n . m' = 0` says that one shaft stands to the other by a rotation about an axis in the plane that halves the angle
//! between both. The rate of `g` is `(a + a') . (w' - w)`, so that the moment is along `a + a'`. It vanishes where both axes are opposite.
//!
//! Source: K. H. Hunt, Constant-velocity shaft couplings: a general theory, Journal of Engineering for Industry 95 (1973) 455-464 (the
//! plane that halves the angle).

use nalgebra::SMatrix;

use super::{Equation, Gradient, View};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::direction::Direction;
use crate::system::end::{Add, Attachment, bilinear};

/// Two shafts that rotate alike.
#[derive(Clone, Debug)]
pub struct Homokinetic<const D: usize> {
    /// Unit vectors `n` and `m` across the axis of the first shaft.
    pub first: [Direction<D>; 2],
    /// Unit vectors across the axis of the second shaft, which are those of the first after a rotation about the normal of both axes.
    pub second: [Direction<D>; 2],
}

impl<const D: usize> Homokinetic<D> {
    /// Pairs of directions, with the signs of their products in `g`.
    fn pairs(&self) -> [([Direction<D>; 2], f64); 2] {
        let ([n, m], [n_second, m_second]) = (self.first, self.second);
        [([m, n_second], 1.0), ([n, m_second], -1.0)]
    }

    /// Sum over both pairs.
    fn sum<N: Number>(&self, of: impl Fn(&Direction<D>, &Direction<D>) -> N) -> N {
        let [([m, n_second], _), ([n, m_second], _)] = &self.pairs();
        of(m, n_second) - of(n, m_second)
    }

    /// One pair of ends for each product; the second is on the second shaft.
    pub(super) fn gradients<N: Number>(
        &self,
        view: &View<'_, D, N>,
    ) -> impl Iterator<Item = Gradient<D, N>> {
        let none = Vector::zeros();
        let pairs = self.pairs().into_iter();
        pairs.map(move |([a, b], sign)| Gradient {
            ends: [
                (a.end().lift(), [none, b.value(view.x) * N::of(sign)]),
                (b.end().lift(), [none, a.value(view.x) * N::of(sign)]),
            ],
        })
    }
}

impl<const D: usize> Equation<D> for Homokinetic<D> {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        self.sum(|a, b| a.value(view.x).dot(&b.value(view.x)))
    }

    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        self.sum(|a, b| a.rate(view.v).dot(&b.rate(view.v))) * N::of(2.0)
    }

    fn stiffness(&self, lambda: f64, _view: &View<'_, D>, add: Add<'_, D>) {
        for (pair, sign) in self.pairs() {
            if let [Direction::Of(first), Direction::Of(second)] = &pair {
                let product = SMatrix::identity() * (lambda * sign);
                bilinear([(first, 1), (second, 1)], product, &mut *add);
            }
        }
    }

    fn is_stiff(&self) -> bool {
        true
    }

    fn is_angle(&self) -> bool {
        true
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        vec![self.first[0].end(), self.second[0].end()]
    }
}
