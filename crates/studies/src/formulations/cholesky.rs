//! Elements assembled into nodes and the Cholesky factor of their mass: `M = W W^T`, `T = W^-T`.

use super::Transformation;
use super::band::{Band, Root};
use super::rod::{Node, Rod};

/// `W`; the first pair of `q` is held and stays zero.
pub struct Cholesky {
    root: Root,
    coordinates: usize,
}

/// `None` where the mass is not positive.
pub fn new(rod: &Rod) -> Option<Cholesky> {
    Some(Cholesky {
        root: Band::assembled(&rod.masses()).root()?,
        coordinates: 4 * rod.reference.len(),
    })
}

impl Transformation for Cholesky {
    fn coordinates(&self) -> usize {
        self.coordinates
    }

    fn prolong(&mut self, q: &[f64], u: &mut [Node]) {
        self.root.backward(q, u);
    }

    fn restrict(&mut self, f: &mut [Node], a: &mut [f64]) {
        self.root.forward(f, a);
    }

    fn memory(&self) -> usize {
        self.root.memory()
    }
}
