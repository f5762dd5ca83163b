//! Report Eqs. 23-34 as printed: `M^-1 Phi^T = Q R`, `e = e_0 + Q2 q`, `q'' = Q2^T M^-1 F`, with `Q2` dense.
//! `Phi Q2` does not vanish, so nothing holds the elements together.

use super::dense::Dense;
use super::fronts::Fronts;
use super::rod::{Mass, Node, Rod, entries, identity, matrix};
use super::{Transformation, rod};

/// `Q2`, and the inverse masses of the elements.
pub struct AsPrinted {
    q2: Dense,
    inverse: Vec<Mass>,
}

/// `None` where a mass is singular.
pub fn new(rod: &Rod) -> Option<AsPrinted> {
    let inverse = |mass: &Mass| matrix(mass).try_inverse().map(|m| entries(&m));
    let inverse: Vec<Mass> = rod.masses().iter().map(inverse).collect::<Option<_>>()?;
    let fronts = Fronts::new(&inverse, |_| identity());
    Some(AsPrinted {
        q2: Dense::new(&fronts, rod.count()),
        inverse,
    })
}

impl Transformation for AsPrinted {
    fn coordinates(&self) -> usize {
        self.q2.coordinates()
    }

    fn prolong(&mut self, q: &[f64], u: &mut [Node]) {
        self.q2.prolong(q, u);
    }

    fn restrict(&mut self, f: &mut [Node], a: &mut [f64]) {
        for (inverse, f) in self.inverse.iter().zip(f.as_chunks_mut::<2>().0) {
            *f = rod::times(inverse, f);
        }
        self.q2.restrict(f, a);
    }

    fn memory(&self) -> usize {
        self.q2.memory() + size_of_val(&self.inverse[..])
    }
}
