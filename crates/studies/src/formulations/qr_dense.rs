//! The report's elimination weighted by the root of the mass, `T = L^-T Q2` as one dense matrix.

use super::dense::Dense;
use super::rod::{Node, Rod};
use super::{Transformation, qr_applied};

/// `T`.
pub struct QrDense(Dense);

/// `None` where a mass is not positive.
pub fn new(rod: &Rod) -> Option<QrDense> {
    let fronts = qr_applied::weighted(rod)?;
    Some(QrDense(Dense::new(&fronts, rod.count())))
}

impl Transformation for QrDense {
    fn coordinates(&self) -> usize {
        self.0.coordinates()
    }

    fn prolong(&mut self, q: &[f64], u: &mut [Node]) {
        self.0.prolong(q, u);
    }

    fn restrict(&mut self, f: &mut [Node], a: &mut [f64]) {
        self.0.restrict(f, a);
    }

    fn memory(&self) -> usize {
        self.0.memory()
    }
}
