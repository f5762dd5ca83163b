//! Elements assembled into nodes, whose coordinates are those of the motion: `x'' = M^-1 F`.

use super::Transformation;
use super::band::{Band, Factors};
use super::rod::{Node, Rod};

/// `M = L D L^T`; the first pair of `q` is held and stays zero.
pub struct Assembled {
    mass: Factors,
    coordinates: usize,
}

/// `None` where the mass is not positive.
pub fn new(rod: &Rod) -> Option<Assembled> {
    Some(Assembled {
        mass: Band::assembled(&rod.masses()).factors()?,
        coordinates: 4 * rod.reference.len(),
    })
}

impl Transformation for Assembled {
    fn coordinates(&self) -> usize {
        self.coordinates
    }

    fn prolong(&mut self, q: &[f64], u: &mut [Node]) {
        u.as_flattened_mut().as_flattened_mut().copy_from_slice(q);
    }

    fn restrict(&mut self, f: &mut [Node], a: &mut [f64]) {
        f[0][0] = [0.0; 2];
        self.mass.solve(f);
        a.copy_from_slice(f.as_flattened().as_flattened());
    }

    fn memory(&self) -> usize {
        self.mass.memory()
    }
}
