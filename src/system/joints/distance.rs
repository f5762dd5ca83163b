//! Distance link: a massless rigid rod, `(d.d - L^2) / (2 L) = 0`.

use nalgebra::Vector2;

use super::{Gradient, View};
use crate::body::NodeBlock;
use crate::system::end::End;
use crate::system::loads::isotropic;

/// Two ends at a fixed distance.
#[derive(Clone, Debug)]
pub struct Distance {
    /// The ends.
    pub ends: [End; 2],
    /// Length, m.
    pub length: f64,
}

impl Distance {
    pub(super) fn value(&self, view: &View<'_>) -> f64 {
        let d = self.ends[1].position(view.x) - self.ends[0].position(view.x);
        (d.norm_squared() - self.length * self.length) / (2.0 * self.length)
    }

    pub(super) fn gradient(&self, view: &View<'_>) -> Gradient {
        let none = Vector2::zeros();
        let d = self.ends[1].position(view.x) - self.ends[0].position(view.x);
        let unit = d / self.length;
        Gradient {
            ends: [(self.ends[0], [-unit, none]), (self.ends[1], [unit, none])],
        }
    }

    pub(super) fn bias(&self, view: &View<'_>) -> f64 {
        let d = self.ends[1].velocity(view.v) - self.ends[0].velocity(view.v);
        d.norm_squared() / self.length
    }

    pub(super) fn stiffness(&self, lambda: f64, add: &mut dyn FnMut(usize, usize, &NodeBlock<4>)) {
        isotropic(&self.ends, lambda / self.length, add);
    }
}
