//! A thin strip that bends far, Poisson's ratio zero, on the product's cubic elements, by Newton's method from the straight strip under all of the
//! load: with the stress of the present state in the tangent, or with that which the last linear step predicted.
//!
//! Source: D. Magisano, L. Leonetti, G. Garcea, How to improve efficiency and robustness of the Newton method in geometrically non-linear
//! structural problem discretized via displacement-based finite elements, Comput. Methods Appl. Mech. Eng. 313 (2017).

use flexbody::math::quadrature::{GAUSS_3, LOBATTO_3};
use nalgebra::{DVector, SMatrix, SVector, Vector2};

use super::{Equations, hermite};

/// Numbers at a node and of an element: position and derivative along the strip over the length of an element.
const NODE: usize = 4;
const NUMBERS: usize = 2 * NODE;

type Row = SVector<f64, NUMBERS>;
type Matrix = SMatrix<f64, NUMBERS, NUMBERS>;

/// Stress in the part of the tangent that stress makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stress {
    /// Stress of the present state, as usual.
    Present,
    /// Stress which the last linear step predicted.
    Predicted,
}

/// A strip of 1 m, bending stiffness 1 N m^2, clamped, under a force of 4 N across its end.
struct Strip {
    count: usize,
    axial: f64,
    /// Numbers of all nodes.
    x: DVector<f64>,
    /// Membrane forces (N) and moments (N m) at points of Gauss, element by element, that the tangent takes.
    stress: Vec<[[f64; 2]; 3]>,
}

/// Force across the end, N.
const FORCE: f64 = 4.0;
/// Correction at which the iteration ends, m.
const EXACT: f64 = 1e-8;

/// A row that multiplies the numbers of an element: functions times a vector.
fn row(values: &[f64; 4], vector: &Vector2<f64>) -> Row {
    Row::from_fn(|k, _| values[k / 2] * vector[k % 2])
}

/// A vector of the strip: functions times the numbers.
fn vector(values: &[f64; 4], x: &Row) -> Vector2<f64> {
    Vector2::from_fn(|axis, _| (0..4).map(|k| values[k] * x[2 * k + axis]).sum())
}

/// Weights of both ends and the middle at a place: the parabola through them.
fn parabola(x: f64) -> [f64; 3] {
    [
        (1.0 - x) * (1.0 - 2.0 * x),
        4.0 * x * (1.0 - x),
        x * (2.0 * x - 1.0),
    ]
}

/// Strain and curvature at a point, their changes, and their second derivatives times a membrane force and a moment.
struct Point {
    strains: [f64; 2],
    rows: [Row; 2],
    /// Functions and vectors that the curvature is made of.
    curved: Curved,
    /// Derivatives of functions at the samples with their weights here.
    samples: [([f64; 4], f64); 3],
}

/// The line at a point.
struct Curved {
    first: [f64; 4],
    /// Second derivatives of functions less the part that lengthens the first.
    bent: [f64; 4],
    normal: Vector2<f64>,
    dual: Vector2<f64>,
    curvature: f64,
}

impl Point {
    /// At a place of an element of this length.
    fn new(x: &Row, at: f64, length: f64) -> Self {
        let scaled =
            |at: f64, order: usize| hermite(at)[order].map(|h| h / length.powi(order as i32));
        let weights = parabola(at);
        let samples = [0, 1, 2].map(|k| (scaled(LOBATTO_3[k].at, 1), weights[k]));
        let (mut strain, mut change) = (0.0, Row::zeros());
        for (slopes, weight) in &samples {
            let along = vector(slopes, x);
            strain += weight * 0.5 * (along.norm_squared() - 1.0);
            change += *weight * row(slopes, &along);
        }
        let (first, second) = (scaled(at, 1), scaled(at, 2));
        let (along, bend) = (vector(&first, x), vector(&second, x));
        let dual = along / along.norm_squared();
        let normal = Vector2::new(-along.y, along.x) / along.norm();
        let part = bend.dot(&dual);
        let bent: [f64; 4] = std::array::from_fn(|k| second[k] - part * first[k]);
        let curvature = bend.dot(&normal);
        Self {
            strains: [strain, curvature],
            rows: [change, row(&bent, &normal)],
            curved: Curved {
                first,
                bent,
                normal,
                dual,
                curvature,
            },
            samples,
        }
    }

    /// Second derivatives of strain and curvature times a membrane force and a moment.
    fn geometric(&self, [force, moment]: [f64; 2]) -> Matrix {
        let mut sum = Matrix::zeros();
        for (slopes, weight) in &self.samples {
            for axis in [Vector2::x(), Vector2::y()] {
                let along = row(slopes, &axis);
                sum += force * *weight * along * along.transpose();
            }
        }
        let line = &self.curved;
        let turn = row(&line.first, &line.normal);
        let mixed = row(&line.bent, &line.dual) * turn.transpose();
        sum -= moment * (mixed + mixed.transpose());
        sum - moment * line.curvature * line.dual.norm_squared() * turn * turn.transpose()
    }
}

impl Strip {
    /// Straight, without stress.
    fn new(count: usize, slenderness: f64) -> Self {
        let mut x = DVector::zeros(NODE * (count + 1));
        let length = 1.0 / count as f64;
        for node in 0..=count {
            x[NODE * node] = length * node as f64;
            x[NODE * node + 2] = length;
        }
        Self {
            count,
            axial: 12.0 / (slenderness * slenderness),
            x,
            stress: vec![[[0.0; 2]; 3]; count],
        }
    }

    /// Numbers of an element.
    fn element(of: &DVector<f64>, element: usize) -> Row {
        Row::from_fn(|k, _| of[NODE * element + k])
    }

    /// The next correction.
    fn correction(&self) -> Option<DVector<f64>> {
        let length = 1.0 / self.count as f64;
        let mut equations = Equations::new(self.x.len());
        for element in 0..self.count {
            let x = Self::element(&self.x, element);
            let (mut matrix, mut force) = (Matrix::zeros(), Row::zeros());
            for (k, gauss) in GAUSS_3.iter().enumerate() {
                let point = Point::new(&x, gauss.at, length);
                let weight = gauss.weight * length;
                for (j, stiffness) in [self.axial, 1.0].into_iter().enumerate() {
                    let own = point.rows[j];
                    force -= weight * stiffness * point.strains[j] * own;
                    matrix += weight * stiffness * own * own.transpose();
                }
                matrix += weight * point.geometric(self.stress[element][k]);
            }
            let numbers = std::array::from_fn(|k| NODE * element + k);
            equations.add(&numbers, &matrix, &force);
        }
        equations.force[NODE * self.count + 1] += FORCE;
        // The end and the direction there; the strip may stretch.
        for number in [0, 1, 3] {
            equations.hold(number);
        }
        // It need not be positive on the way.
        equations.matrix.lu().solve(&equations.force)
    }

    /// Takes a correction, with stress for the next tangent.
    fn take(&mut self, step: &DVector<f64>, stress: Stress) {
        let length = 1.0 / self.count as f64;
        for element in 0..self.count {
            let (x, dx) = (
                Self::element(&self.x, element),
                Self::element(step, element),
            );
            for (k, gauss) in GAUSS_3.iter().enumerate() {
                let strains = match stress {
                    Stress::Present => Point::new(&(x + dx), gauss.at, length).strains,
                    Stress::Predicted => {
                        let point = Point::new(&x, gauss.at, length);
                        [0, 1].map(|j| point.strains[j] + point.rows[j].dot(&dx))
                    }
                };
                self.stress[element][k] = [self.axial * strains[0], strains[1]];
            }
        }
        self.x += step;
    }
}

/// Iterations to equilibrium and the place of the tip (m), of a strip of this thickness over its length on so many elements; nothing where there
/// is none in so many iterations.
pub fn iterations(
    count: usize,
    slenderness: f64,
    stress: Stress,
    most: usize,
) -> Option<(usize, [f64; 2])> {
    let mut strip = Strip::new(count, slenderness);
    for iteration in 1..=most {
        let step = strip.correction()?;
        if !step.iter().all(|part| part.is_finite()) {
            return None;
        }
        strip.take(&step, stress);
        if step.amax() < EXACT {
            let tip = NODE * count;
            return Some((iteration, [strip.x[tip], strip.x[tip + 1]]));
        }
    }
    None
}

/// The tangent is the derivative of the forces.
#[test]
fn tangents_are_derivatives() {
    let x = Row::from_column_slice(&[0.0, 0.1, 0.5, 0.3, 0.4, 0.35, 0.45, -0.1]);
    let (length, stress, change) = (0.5, [0.7, -1.3], 1e-6);
    let point = |x: &Row| Point::new(x, 0.3, length);
    let force = |x: &Row| {
        let point = point(x);
        point.rows[0] * stress[0] + point.rows[1] * stress[1]
    };
    let exact = point(&x).geometric(stress);
    for k in 0..NUMBERS {
        let mut moved = [x, x];
        moved[0][k] += change;
        moved[1][k] -= change;
        let column = (force(&moved[0]) - force(&moved[1])) / (2.0 * change);
        assert!((column - exact.column(k)).amax() < 1e-6, "{k}: {column}");
        let strains = moved.map(|x| point(&x).strains);
        for j in 0..2 {
            let rate = (strains[0][j] - strains[1][j]) / (2.0 * change);
            assert!(
                (rate - point(&x).rows[j][k]).abs() < 1e-6,
                "{k} {j}: {rate}"
            );
        }
    }
}
