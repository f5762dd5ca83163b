//! The product's elimination: clusters by QR, the rest by its sparse Cholesky factor.

use flexbody::bodies::{Assembly, ConnectivityRow, Elimination, Links};
use flexbody::math::sparse::Matrix;

use nalgebra::SMatrix;

use super::Transformation;
use super::rod::{Node, Rod};

/// The elimination and its scratch.
pub struct Product {
    elimination: Elimination,
    y: Vec<f64>,
}

/// `None` where the mass is not positive.
pub fn new(rod: &Rod) -> Option<Product> {
    let held = |along: [f64; 2]| ConnectivityRow {
        terms: vec![(0, [along, [0.0; 2]])],
        is_driven: false,
    };
    let links = Links {
        mass: (0..rod.count())
            .map(|j| rod.chain.nodes(j).into())
            .collect(),
        ..Links::default()
    };
    let (assembly, _) = Assembly::new(
        rod.reference.len(),
        &[held([1.0, 0.0]), held([0.0, 1.0])],
        &links,
    );
    let mut mass = Matrix::zeros(assembly.pattern());
    rod.chain
        .add_mass(&SMatrix::identity(), &assembly, &mut mass);
    let elimination = Elimination::new(assembly, mass)?;
    let y = vec![0.0; elimination.scratch()];
    Some(Product { elimination, y })
}

impl Transformation for Product {
    fn coordinates(&self) -> usize {
        self.elimination.coordinates()
    }

    fn prolong(&mut self, q: &[f64], u: &mut [Node]) {
        self.elimination.expand(q, &mut self.y, u);
    }

    fn restrict(&mut self, f: &mut [Node], a: &mut [f64]) {
        self.elimination.reduce(f, &mut self.y, a);
    }

    fn memory(&self) -> usize {
        // Its factor has the structure of the mass.
        size_of_val(&self.elimination.mass.values[..])
    }
}
