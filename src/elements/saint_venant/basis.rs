//! Lagrange polynomials over a triangle.
//!
//! Source: P. Silvester, High-order polynomial triangular finite elements for potential problems, Int. J. Eng. Sci. 7 (1969) 849-861
//! (polynomials and constant matrices); A. H. Stroud, Approximate Calculation of Multiple Integrals (1971), section 3.6 (Gauss rules over a
//! triangle).

use crate::math::quadrature::GAUSS_5;

/// Degree of the polynomials.
pub const DEGREE: usize = 4;
/// Polynomials, one for each node.
pub const NODES: usize = (DEGREE + 1) * (DEGREE + 2) / 2;
/// Nodes inside an edge.
pub const IN_EDGE: usize = DEGREE - 1;
/// Nodes inside a triangle.
pub const INSIDE: usize = NODES - 3 - 3 * IN_EDGE;

/// A number for each polynomial.
pub type Nodal = [f64; NODES];
/// A number for each pair of polynomials.
pub type Pairs = [Nodal; NODES];

/// Values of the polynomials at a point, and their derivatives with the second and the third barycentric coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Shapes {
    /// Values.
    pub values: Nodal,
    /// Derivatives with each of both coordinates.
    pub slopes: [Nodal; 2],
}

/// Matrices of the triangle with corners at (0, 0), (1, 0) and (0, 1).
#[derive(Clone, Debug)]
pub struct Reference {
    /// Points of a rule exact to degree 8, with their weights, which sum to 1/2.
    pub points: Vec<(Shapes, [f64; 2], f64)>,
    /// Integrals of products of two polynomials.
    pub mass: Pairs,
    /// Integrals of products of a polynomial and the derivative of the second one of the pair.
    pub mixed: [Pairs; 2],
    /// Integrals of products of derivatives: both with the first coordinate, both orders of different ones added, both with the second.
    pub stiffness: [Pairs; 3],
}

/// Barycentric coordinates of the nodes in parts of the degree: corners, edges from corner to corner, then inside.
pub fn lattice() -> [[usize; 3]; NODES] {
    let mut all = Vec::with_capacity(NODES);
    let corner = |k: usize| std::array::from_fn(|j| if j == k { DEGREE } else { 0 });
    all.extend((0..3).map(corner));
    for k in 0..3 {
        for step in 1..DEGREE {
            let mut parts = [0; 3];
            (parts[k], parts[(k + 1) % 3]) = (DEGREE - step, step);
            all.push(parts);
        }
    }
    for first in 1..DEGREE {
        for second in 1..DEGREE - first {
            all.push([DEGREE - first - second, first, second]);
        }
    }
    std::array::from_fn(|k| all[k])
}

/// Computes the polynomials at a point given by its second and third barycentric coordinate.
pub fn shapes([y, z]: [f64; 2]) -> Shapes {
    // Products of linear factors that are 1 at `count` and 0 at all whole numbers below, with their derivatives.
    let factor = |at: f64, count: usize| {
        let (mut value, mut slope) = (1.0, 0.0);
        for s in 0..count {
            let (rise, over) = (DEGREE as f64, (s + 1) as f64);
            let of = (rise * at - s as f64) / over;
            slope = slope * of + value * rise / over;
            value *= of;
        }
        (value, slope)
    };
    let mut shapes = Shapes {
        values: [0.0; NODES],
        slopes: [[0.0; NODES]; 2],
    };
    for (k, parts) in lattice().into_iter().enumerate() {
        let [(a, da), (b, db), (c, dc)] =
            [(1.0 - y - z, parts[0]), (y, parts[1]), (z, parts[2])].map(|(at, n)| factor(at, n));
        shapes.values[k] = a * b * c;
        shapes.slopes[0][k] = a * db * c - da * b * c;
        shapes.slopes[1][k] = a * b * dc - da * b * c;
    }
    shapes
}

impl Reference {
    /// Integrates over the triangle.
    pub fn new() -> Self {
        let mut reference = Self {
            points: Vec::new(),
            mass: [[0.0; NODES]; NODES],
            mixed: [[[0.0; NODES]; NODES]; 2],
            stiffness: [[[0.0; NODES]; NODES]; 3],
        };
        for p in GAUSS_5 {
            for q in GAUSS_5 {
                // A square whose one edge is drawn together to a corner.
                let at = [p.at, q.at * (1.0 - p.at)];
                let weight = p.weight * q.weight * (1.0 - p.at);
                reference.points.push((shapes(at), at, weight));
            }
        }
        for (of, _, weight) in reference.points.clone() {
            let [y, z] = of.slopes;
            for i in 0..NODES {
                for j in 0..NODES {
                    reference.mass[i][j] += weight * of.values[i] * of.values[j];
                    reference.mixed[0][i][j] += weight * of.values[i] * y[j];
                    reference.mixed[1][i][j] += weight * of.values[i] * z[j];
                    reference.stiffness[0][i][j] += weight * y[i] * y[j];
                    reference.stiffness[1][i][j] += weight * (y[i] * z[j] + z[i] * y[j]);
                    reference.stiffness[2][i][j] += weight * z[i] * z[j];
                }
            }
        }
        reference
    }
}
