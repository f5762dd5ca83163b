//! The rectangle with deflection and both slopes at its corners, without the mixed derivative: slopes across edges jump between elements.
//!
//! Source: A. Adini, R. W. Clough, Analysis of plate bending by the finite element method (1960); what Exudyn's `ObjectANCFThinPlate` is where
//! deflections are small.

use flexbody::math::quadrature::GAUSS_3;
use nalgebra::{SMatrix, SVector};

use super::Equations;

/// Numbers at a corner, and of an element.
const CORNER: usize = 3;
const NUMBERS: usize = 4 * CORNER;

type Row = SVector<f64, NUMBERS>;
type Matrix = SMatrix<f64, NUMBERS, NUMBERS>;

/// Powers of both coordinates.
const TERMS: [[i32; 2]; NUMBERS] = [
    [0, 0],
    [1, 0],
    [0, 1],
    [2, 0],
    [1, 1],
    [0, 2],
    [3, 0],
    [2, 1],
    [1, 2],
    [0, 3],
    [3, 1],
    [1, 3],
];

/// A power, differentiated so often.
fn power(x: f64, exponent: i32, order: i32) -> f64 {
    if order > exponent {
        return 0.0;
    }
    let factors = (0..order).map(|k| f64::from(exponent - k));
    factors.product::<f64>() * x.powi(exponent - order)
}

/// All terms at a place, differentiated so often by both coordinates.
fn terms([x, y]: [f64; 2], [by_x, by_y]: [i32; 2]) -> Row {
    Row::from_fn(|k, _| power(x, TERMS[k][0], by_x) * power(y, TERMS[k][1], by_y))
}

/// Stiffness (bending stiffness 1) and the forces of a unit load per area on a square of this size, m.
fn element(size: f64, poisson: f64) -> Option<(Matrix, Row)> {
    let mut at_corners = Matrix::zeros();
    for corner in 0..4 {
        let place = [size * f64::from(corner / 2), size * f64::from(corner % 2)];
        for (k, orders) in [[0, 0], [1, 0], [0, 1]].into_iter().enumerate() {
            let row = terms(place, orders).transpose();
            at_corners.set_row(CORNER * corner as usize + k, &row);
        }
    }
    let by_numbers = at_corners.try_inverse()?.transpose();
    let (mut stiffness, mut force) = (Matrix::zeros(), Row::zeros());
    for a in GAUSS_3 {
        for b in GAUSS_3 {
            let place = [size * a.at, size * b.at];
            let weight = a.weight * b.weight * size * size;
            let [xx, yy, xy] =
                [[2, 0], [0, 2], [1, 1]].map(|orders| by_numbers * terms(place, orders));
            let both = xx * yy.transpose();
            stiffness += weight * (xx * xx.transpose() + yy * yy.transpose());
            stiffness += weight * poisson * (both + both.transpose());
            stiffness += weight * 2.0 * (1.0 - poisson) * xy * xy.transpose();
            force += weight * (by_numbers * terms(place, [0, 0]));
        }
    }
    Some((stiffness, force))
}

/// Deflection in the middle of a square under a uniform load, over `q a^4 / D`, pinned at all edges, on so many elements a side, an even number.
pub fn pinned_square(count: usize, poisson: f64) -> Option<f64> {
    let (stiffness, force) = element(1.0 / count as f64, poisson)?;
    let number = |i: usize, j: usize| CORNER * (i * (count + 1) + j);
    let mut equations = Equations::new(number(count, count) + CORNER);
    for i in 0..count {
        for j in 0..count {
            let corners = [
                number(i, j),
                number(i, j + 1),
                number(i + 1, j),
                number(i + 1, j + 1),
            ];
            let numbers = std::array::from_fn(|k| corners[k / CORNER] + k % CORNER);
            equations.add(&numbers, &stiffness, &force);
        }
    }
    for k in 0..=count {
        for (node, slope) in [
            (number(0, k), 2),
            (number(count, k), 2),
            (number(k, 0), 1),
            (number(k, count), 1),
        ] {
            equations.hold(node);
            equations.hold(node + slope);
        }
    }
    let found = equations.solve()?;
    Some(found[number(count / 2, count / 2)])
}

/// A square that is bent to `x y` and `x^2` has the moments of that, whatever its size: the patch test.
#[test]
fn constant_curvatures_are_exact() {
    let (size, poisson) = (0.3, 0.25);
    let (stiffness, _) = element(size, poisson).expect("an element");
    for (orders, energy) in [([1, 1], 2.0 * (1.0 - poisson)), ([2, 0], 4.0)] {
        let bent = Row::from_fn(|k, _| {
            let corner = (k / CORNER) as i32;
            let place = [size * f64::from(corner / 2), size * f64::from(corner % 2)];
            let by = [[0, 0], [1, 0], [0, 1]][k % CORNER];
            power(place[0], orders[0], by[0]) * power(place[1], orders[1], by[1])
        });
        let found = bent.dot(&(stiffness * bent)) / (size * size);
        assert!((found - energy).abs() < 1e-10, "{found} {energy}");
    }
}
