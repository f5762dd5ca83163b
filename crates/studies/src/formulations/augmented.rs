//! Coordinates of all elements; connectivity and pin are kept with multipliers:
//! `[M Phi^T; Phi 0] [e''; lambda] = [F; 0]`, by the Schur complement `Phi M^-1 Phi^T`, which couples
//! neighbouring interfaces. Nothing is projected: `Phi e` drifts with roundoff alone, since it is linear.

use flexbody::bodies::{add_node, no_node};

use super::Transformation;
use super::band::{Band, Factors};
use super::rod::{Mass, Node, Rod, entries, matrix, times};

/// Inverse masses of the elements and the Schur complement.
pub struct Augmented {
    inverse: Vec<Mass>,
    schur: Factors,
    lambda: Vec<Node>,
}

/// `None` where a mass is not positive.
pub fn new(rod: &Rod) -> Option<Augmented> {
    let inverse = |mass: &Mass| matrix(mass).try_inverse().map(|m| entries(&m));
    let inverse: Vec<Mass> = rod.masses().iter().map(inverse).collect::<Option<_>>()?;
    let zero = [[0.0; 2]; 2];
    let mut band = Band {
        diagonal: vec![zero; inverse.len()],
        below: vec![zero; inverse.len()],
    };
    for (j, m) in inverse.iter().enumerate() {
        for r in 0..2 {
            for c in 0..2 {
                band.diagonal[j][r][c] += m[r][c];
                if j + 1 < inverse.len() {
                    band.diagonal[j + 1][r][c] += m[2 + r][2 + c];
                    band.below[j + 1][r][c] = -m[2 + r][c];
                }
            }
        }
    }
    // The pin is one row, not two.
    band.diagonal[0] = [[band.diagonal[0][0][0], 0.0], [0.0, 1.0]];
    if let Some(below) = band.below.get_mut(1) {
        below[0][1] = 0.0;
        below[1][1] = 0.0;
    }
    Some(Augmented {
        lambda: vec![no_node(); inverse.len()],
        schur: band.factors()?,
        inverse,
    })
}

impl Transformation for Augmented {
    fn coordinates(&self) -> usize {
        8 * self.inverse.len()
    }

    fn prolong(&mut self, q: &[f64], u: &mut [Node]) {
        u.as_flattened_mut().as_flattened_mut().copy_from_slice(q);
    }

    fn restrict(&mut self, f: &mut [Node], a: &mut [f64]) {
        let f = f.as_chunks_mut::<2>().0;
        let mut end = no_node();
        for ((inverse, f), lambda) in self.inverse.iter().zip(f.iter()).zip(&mut self.lambda) {
            let free = times(inverse, f);
            *lambda = free[0];
            add_node(lambda, -1.0, &end);
            end = free[1];
        }
        self.lambda[0][1] = [0.0; 2];
        self.schur.solve(&mut self.lambda);
        let (a, _) = a.as_chunks_mut::<8>();
        let next = self.lambda[1..].iter().copied().chain([no_node()]);
        for ((((inverse, f), own), next), a) in self
            .inverse
            .iter()
            .zip(f)
            .zip(&self.lambda)
            .zip(next)
            .zip(a)
        {
            add_node(&mut f[0], -1.0, own);
            add_node(&mut f[1], 1.0, &next);
            a.copy_from_slice(times(inverse, f).as_flattened().as_flattened());
        }
    }

    fn memory(&self) -> usize {
        size_of_val(&self.inverse[..]) + self.schur.memory()
    }
}
