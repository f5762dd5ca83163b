//! A strip in cylindrical bending whose nodes carry a derivative through the thickness, as an element of a solid: position and derivatives along
//! and through it, linear.
//!
//! Source: A. M. Mikkola, A. A. Shabana, A non-incremental finite element procedure for the analysis of large deformation of plates and shells
//! in mechanical system applications, Multibody System Dynamics 9 (2003).

use flexbody::math::quadrature::GAUSS_3;
use nalgebra::{SMatrix, SVector};

use super::{Equations, hermite};

/// Numbers at a node: both displacements, their derivatives along the strip over the length of an element, and the changes of both components of
/// the derivative through the thickness.
const NODE: usize = 6;
const NUMBERS: usize = 2 * NODE;

type Row = SVector<f64, NUMBERS>;
type Matrix = SMatrix<f64, NUMBERS, NUMBERS>;

/// Rows of the strains along and through the strip and of shear, at a place along an element of this length and at a height, m.
fn strains(length: f64, along: f64, height: f64) -> [Row; 3] {
    let [_, slopes, _] = hermite(along);
    let (mut line, mut shear, mut through) = (Row::zeros(), Row::zeros(), Row::zeros());
    for end in 0..2 {
        let at = NODE * end;
        let [value, slope] = [slopes[2 * end] / length, slopes[2 * end + 1] / length];
        let (own, change) = [(1.0 - along, -1.0 / length), (along, 1.0 / length)][end];
        (line[at], line[at + 2]) = (value, slope);
        line[at + 4] = height * change;
        (shear[at + 1], shear[at + 3]) = (value, slope);
        (shear[at + 4], shear[at + 5]) = (own, height * change);
        through[at + 5] = own;
    }
    [line, through, shear]
}

/// Stiffness of an element per width, of a solid that does not strain across the strip.
fn stiffness(length: f64, thickness: f64, [modulus, poisson]: [f64; 2]) -> Matrix {
    let scale = modulus / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let (direct, across) = (scale * (1.0 - poisson), scale * poisson);
    let shear_modulus = 0.5 * modulus / (1.0 + poisson);
    let mut sum = Matrix::zeros();
    for a in GAUSS_3 {
        for b in GAUSS_3 {
            let weight = a.weight * b.weight * length * thickness;
            let [line, through, shear] = strains(length, a.at, thickness * (b.at - 0.5));
            let both = line * through.transpose();
            sum += weight * direct * (line * line.transpose() + through * through.transpose());
            sum += weight * across * (both + both.transpose());
            sum += weight * shear_modulus * shear * shear.transpose();
        }
    }
    sum
}

/// Bending stiffness over that of a thin plate that the deflection of a strip of 1 m under a moment at its end shows.
pub fn bending_stiffness(count: usize, thickness: f64, poisson: f64) -> Option<f64> {
    // Bending stiffness of a thin plate 1 N m.
    let modulus = 12.0 * (1.0 - poisson * poisson) / thickness.powi(3);
    let matrix = stiffness(1.0 / count as f64, thickness, [modulus, poisson]);
    let mut equations = Equations::new(NODE * (count + 1));
    for element in 0..count {
        let numbers = std::array::from_fn(|k| NODE * element + k);
        equations.add(&numbers, &matrix, &Row::zeros());
    }
    // A moment of 1 N m per width on the direction through the thickness, against its first component.
    equations.force[NODE * count + 4] = -1.0;
    for number in [0, 1, 3, 4] {
        equations.hold(number);
    }
    let deflection = equations.solve()?[NODE * count + 1];
    Some(0.5 / deflection)
}
