//! Plates and shells less what makes the product's good: without the mixed derivative, with membrane strains at points of Gauss, with nodes
//! that carry a derivative through the thickness, by Newton's method as usual (`studies failures`). All but the last are linear.

mod adini;
mod hemisphere;
mod strip;
mod thick;

use flexbody::elements::shape::{curvatures, slopes, values};
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

pub use adini::pinned_square;
pub use hemisphere::{Sampling, hemisphere};
pub use strip::{Stress, iterations};
pub use thick::bending_stiffness;

/// Values, slopes and second derivatives at a place of the product's shape functions of an element of length 1.
fn hermite(x: f64) -> [[f64; 4]; 3] {
    [values(x, 1.0), slopes(x, 1.0), curvatures(x, 1.0)].map(Into::into)
}

/// Linear equations over numbers of nodes, dense.
struct Equations {
    matrix: DMatrix<f64>,
    force: DVector<f64>,
}

impl Equations {
    /// So many equations without anything in them.
    fn new(count: usize) -> Self {
        Self {
            matrix: DMatrix::zeros(count, count),
            force: DVector::zeros(count),
        }
    }

    /// Adds an element over these numbers.
    fn add<const N: usize>(
        &mut self,
        numbers: &[usize; N],
        matrix: &SMatrix<f64, N, N>,
        force: &SVector<f64, N>,
    ) {
        for (a, row) in numbers.iter().enumerate() {
            self.force[*row] += force[a];
            for (b, column) in numbers.iter().enumerate() {
                self.matrix[(*row, *column)] += matrix[(a, b)];
            }
        }
    }

    /// Holds a number where it is.
    fn hold(&mut self, number: usize) {
        self.matrix.row_mut(number).fill(0.0);
        self.matrix.column_mut(number).fill(0.0);
        self.matrix[(number, number)] = 1.0;
        self.force[number] = 0.0;
    }

    /// The solution; nothing of a matrix that is not positive.
    fn solve(self) -> Option<DVector<f64>> {
        Some(self.matrix.cholesky()?.solve(&self.force))
    }
}
