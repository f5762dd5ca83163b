//! The pinched hemisphere with a hole of 18 degrees, linear, on the product's bicubic elements, with membrane strains where the product has them
//! or at points of Gauss.
//!
//! Source: R. H. MacNeal, R. L. Harder, A proposed standard set of problems to test finite element accuracy, Finite Elem. Anal. Des. 1 (1985).

use std::f64::consts::FRAC_PI_2;

use flexbody::math::quadrature::{GAUSS_3, LOBATTO_3};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::{Equations, hermite};

/// Functions of an element, and numbers at a node and of an element.
const FUNCTIONS: usize = 16;
const NODE: usize = 12;
const NUMBERS: usize = 3 * FUNCTIONS;

type Row = SVector<f64, NUMBERS>;
type Matrix = SMatrix<f64, NUMBERS, NUMBERS>;

/// Radius (m), latitude of the hole (rad), Young's modulus (Pa), Poisson's ratio.
const RADIUS: f64 = 10.0;
const LATITUDE: f64 = 0.4 * std::f64::consts::PI;
const MODULUS: f64 = 6.825e7;
const POISSON: f64 = 0.3;

/// Places at which membrane strains are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// The points of Gauss of the stiffness.
    Gauss,
    /// Points of Lobatto along the strain, as in the product; tests alone ask for them.
    #[cfg_attr(not(test), expect(dead_code))]
    Lobatto,
}

/// Vectors of the unstressed surface, by the function of both directions (the second is faster).
type Surface = [Vector3<f64>; FUNCTIONS];

/// Position and derivatives by both parameters of an element, and the mixed one, at its corner `(i, j)` of a mesh of so many elements.
fn corner(i: usize, j: usize, count: usize) -> [Vector3<f64>; 4] {
    let steps = [FRAC_PI_2 / count as f64, LATITUDE / count as f64];
    let (sin, cos) = (steps[0] * i as f64).sin_cos();
    let (up, level) = (steps[1] * j as f64).sin_cos();
    [
        Vector3::new(level * cos, level * sin, up) * RADIUS,
        Vector3::new(-level * sin, level * cos, 0.0) * (RADIUS * steps[0]),
        Vector3::new(-up * cos, -up * sin, level) * (RADIUS * steps[1]),
        Vector3::new(up * sin, -up * cos, 0.0) * (RADIUS * steps[0] * steps[1]),
    ]
}

/// Values of all functions at a place, differentiated so often by both parameters.
fn functions([x, y]: [f64; 2], [by_x, by_y]: [usize; 2]) -> [f64; FUNCTIONS] {
    let (along, across) = (hermite(x)[by_x], hermite(y)[by_y]);
    std::array::from_fn(|k| along[k / 4] * across[k % 4])
}

/// The surface, differentiated.
fn surface(of: &Surface, at: [f64; 2], orders: [usize; 2]) -> Vector3<f64> {
    let values = functions(at, orders);
    of.iter()
        .zip(values)
        .map(|(vector, value)| vector * value)
        .sum()
}

/// A row that multiplies displacements: functions times a vector.
fn row(values: [f64; FUNCTIONS], vector: &Vector3<f64>) -> Row {
    Row::from_fn(|k, _| values[k / 3] * vector[k % 3])
}

/// Rows of covariant membrane strains at a place: 11, 22 and twice 12.
fn membrane(of: &Surface, at: [f64; 2]) -> [Row; 3] {
    let [first, second] = [[1, 0], [0, 1]].map(|orders| surface(of, at, orders));
    let [by_first, by_second] = [[1, 0], [0, 1]].map(|orders| functions(at, orders));
    [
        row(by_first, &first),
        row(by_second, &second),
        row(by_second, &first) + row(by_first, &second),
    ]
}

/// Weights of both ends and the middle at the points of Gauss: the parabola through them.
fn parabola(x: f64) -> [f64; 3] {
    [
        (1.0 - x) * (1.0 - 2.0 * x),
        4.0 * x * (1.0 - x),
        x * (2.0 * x - 1.0),
    ]
}

/// Rows of membrane strains at a point of Gauss, by those of the points of Lobatto: along the strain, of shear along both.
fn sampled(of: &Surface, at: [f64; 2]) -> [Row; 3] {
    let mut rows = [Row::zeros(); 3];
    let [along, across] = at.map(parabola);
    for (k, sample) in LOBATTO_3.iter().enumerate() {
        rows[0] += along[k] * membrane(of, [sample.at, at[1]])[0];
        rows[1] += across[k] * membrane(of, [at[0], sample.at])[1];
        for (l, other) in LOBATTO_3.iter().enumerate() {
            rows[2] += along[k] * across[l] * membrane(of, [sample.at, other.at])[2];
        }
    }
    rows
}

/// Rows of covariant changes of curvature at a place, and what takes covariant strains to engineering ones there, with the area per parameters.
fn bending(of: &Surface, at: [f64; 2]) -> ([Row; 3], Matrix3<f64>, f64) {
    let [first, second] = [[1, 0], [0, 1]].map(|orders| surface(of, at, orders));
    let across = first.cross(&second);
    let area = across.norm();
    let normal = across / area;
    let dual = [second.cross(&normal) / area, normal.cross(&first) / area];
    let slopes = [[1, 0], [0, 1]].map(|orders| functions(at, orders));
    let rows = [([2, 0], 1.0), ([0, 2], 1.0), ([1, 1], 2.0)].map(|(orders, times)| {
        let second = surface(of, at, orders);
        let [g, h] = dual.map(|dual| second.dot(&dual));
        let own = functions(at, orders);
        let values =
            std::array::from_fn(|k| times * (own[k] - g * slopes[0][k] - h * slopes[1][k]));
        row(values, &normal)
    });
    let axis = first.normalize();
    let axes = [axis, normal.cross(&axis)];
    let [[a, b], [c, d]] = axes.map(|axis| dual.map(|dual| axis.dot(&dual)));
    let by = Matrix3::new(
        a * a,
        b * b,
        a * b,
        c * c,
        d * d,
        c * d,
        2.0 * a * c,
        2.0 * b * d,
        a * d + b * c,
    );
    (rows, by, area)
}

/// Stiffness of an element of this thickness, m.
fn stiffness(of: &Surface, thickness: f64, sampling: Sampling) -> Matrix {
    let shear = 0.5 * (1.0 - POISSON);
    let law = Matrix3::new(1.0, POISSON, 0.0, POISSON, 1.0, 0.0, 0.0, 0.0, shear);
    let law = law * (MODULUS * thickness / (1.0 - POISSON * POISSON));
    let mut sum = Matrix::zeros();
    for a in GAUSS_3 {
        for b in GAUSS_3 {
            let at = [a.at, b.at];
            let (curvatures, by, area) = bending(of, at);
            let strains = match sampling {
                Sampling::Gauss => membrane(of, at),
                Sampling::Lobatto => sampled(of, at),
            };
            let law = by.transpose() * law * by * (a.weight * b.weight * area);
            let bent = law * (thickness * thickness / 12.0);
            for (law, rows) in [(law, strains), (bent, curvatures)] {
                for r in 0..3 {
                    let mut stress = Row::zeros();
                    for c in 0..3 {
                        stress += law[(r, c)] * rows[c];
                    }
                    sum += rows[r] * stress.transpose();
                }
            }
        }
    }
    sum
}

/// Displacement of a pinched hemisphere under the force that pulls, m: a quarter on so many elements a side, under forces of 2 N times the cube
/// of the thickness over 0.04 m.
pub fn hemisphere(count: usize, thickness: f64, sampling: Sampling) -> Option<f64> {
    let node = |i: usize, j: usize| NODE * (i * (count + 1) + j);
    let mut equations = Equations::new(node(count, count) + NODE);
    for i in 0..count {
        for j in 0..count {
            let mut of = Surface::default();
            let mut numbers = [0; NUMBERS];
            for k in 0..FUNCTIONS {
                // Ends of both directions, and whether it is a value or a slope.
                let (along, across) = (k / 4, k % 4);
                let (a, b) = (i + along / 2, j + across / 2);
                let vector = along % 2 + 2 * (across % 2);
                of[k] = corner(a, b, count)[vector];
                for axis in 0..3 {
                    numbers[3 * k + axis] = node(a, b) + 3 * vector + axis;
                }
            }
            let matrix = stiffness(&of, thickness, sampling);
            equations.add(&numbers, &matrix, &Row::zeros());
        }
    }
    let half = (thickness / 0.04).powi(3);
    equations.force[node(0, 0)] += half;
    equations.force[node(count, 0) + 1] -= half;
    for j in 0..=count {
        // Along a plane of symmetry the line stays in it, and what leads across it stays normal to it.
        for (place, normal) in [(node(0, j), 1), (node(count, j), 0)] {
            for vector in 0..4 {
                let leads_across = vector % 2 == 1;
                for axis in (0..3).filter(|axis| (*axis == normal) != leads_across) {
                    equations.hold(place + 3 * vector + axis);
                }
            }
        }
    }
    equations.hold(node(count / 2, count) + 2);
    Some(equations.solve()?[node(0, 0)])
}
