//! The report's elimination weighted by the root of the mass, applied front by front: `M = L L^T`,
//! `L^-1 Phi^T = Q R`, `T = L^-T Q2`.

use super::fronts::Fronts;
use super::rod::{Mass, Node, Rod};
use super::{Transformation, rod};

/// `T` as fronts.
pub struct QrApplied(Fronts);

/// `None` where a mass is not positive.
pub fn new(rod: &Rod) -> Option<QrApplied> {
    weighted(rod).map(QrApplied)
}

/// `L^-T Q2`.
pub fn weighted(rod: &Rod) -> Option<Fronts> {
    let inverse = |mass: &Mass| {
        let l = rod::matrix(mass).cholesky()?.l().try_inverse()?;
        Some(rod::entries(&l))
    };
    let scalings: Vec<Mass> = rod.masses().iter().map(inverse).collect::<Option<_>>()?;
    Some(Fronts::new(&scalings, |j| {
        std::array::from_fn(|r| std::array::from_fn(|c| scalings[j][c][r]))
    }))
}

impl Transformation for QrApplied {
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
