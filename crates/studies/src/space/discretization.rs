//! The discretizations that are compared: shape functions, mesh, quadrature and mass, by name.

use clap::ValueEnum;

use crate::elements::basis::{Basis, MOST, graded};
use crate::elements::rod::{Material, Mesh, Rules};
use crate::elements::rule::Rule;

/// Slenderness EA l^2 / EI of an element up to which the cubic element samples axial strain inside it;
/// beyond it, at Lobatto points, which do not lock (docs/decisions/0003-quadrature.md).
const SLENDER: f64 = 200.0;
/// Cubic shape functions: extra mass of the quadratic and the cubic part of the velocity in an element,
/// with which bending waves are exact to the order 8 instead of 4 (see the tests). Extra masses of this
/// kind are those of C. A. Felippa, Q. Guo, K. C. Park, Mass matrix templates: general description and
/// 1D examples, Arch. Comput. Methods Eng. 22 (2015).
const CUBIC_MASS: [f64; 2] = [1.0, 23.0 / 3.0];
/// The same for cables without bending stiffness: axial waves of Lobatto points exact to the order 6.
const STRING_MASS: [f64; 2] = [0.6, 23.0 / 3.0];
/// Quadratic, cubic, quartic and quintic part: found by trial.
const QUINTIC_MASS: [f64; 4] = [0.0, 0.0, 1.0, 8.0];
const QUARTIC_MASS: [f64; 3] = [0.0, 1.0, 8.0];
/// Length of the first element over that of the last on a graded mesh.
const GRADING: f64 = 2.0;

/// A discretization.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Discretization {
    /// Cubic Hermite, consistent mass, axial strain at 3 points, bending at 2 Gauss points.
    Cubic,
    /// Cubic Hermite with elements that shrink towards the end.
    CubicGraded,
    /// Cubic Hermite with the mass of high order.
    CubicMass,
    /// Cubic Hermite with the mass of high order and bending at 3 Gauss points.
    CubicMassBending,
    /// Quintic Hermite: position, slope, rate of slope at the nodes.
    Quintic,
    /// Quintic Hermite with extra mass.
    QuinticMass,
    /// Cubic B-spline with continuous curvature.
    Spline3,
    /// Quartic B-spline with continuous curvature and extra mass.
    Spline4,
}

impl Discretization {
    /// Shape functions.
    pub fn basis(self) -> Basis {
        let spline = |degree| Basis::Spline {
            degree,
            continuity: 2,
        };
        match self {
            Self::Quintic | Self::QuinticMass => Basis::Hermite(3),
            Self::Spline3 => spline(3),
            Self::Spline4 => spline(4),
            _ => Basis::Hermite(2),
        }
    }

    /// A mesh of a rod of some length (m) with a number of elements.
    pub fn mesh(self, material: &Material, length: f64, elements: usize) -> Mesh {
        let ratio = match self {
            Self::CubicGraded => GRADING.powf(-1.0 / (elements.max(2) - 1) as f64),
            _ => 1.0,
        };
        let mean = length / elements as f64;
        let slender = material.axial * mean * mean > SLENDER * material.bending;
        Mesh {
            basis: self.basis(),
            breaks: graded(length, elements, ratio),
            rules: self.rules(slender, material.bending > 0.0),
        }
    }

    fn rules(self, slender: bool, bends: bool) -> Rules {
        let inside = |rule| if slender { Rule::Lobatto(3) } else { rule };
        // With these points axial waves are as much too fast as the extra mass makes them slow.
        let wide = inside(Rule::Three((13.0_f64 / 15.0).sqrt()));
        let mass: &[f64] = if bends { &CUBIC_MASS } else { &STRING_MASS };
        let (axial, bending, extra) = match self {
            Self::Cubic | Self::CubicGraded => (inside(Rule::Gauss(3)), Rule::Gauss(2), &[][..]),
            Self::CubicMass => (wide, Rule::Gauss(2), mass),
            Self::CubicMassBending => (wide, Rule::Gauss(3), mass),
            Self::Quintic => (Rule::Gauss(4), Rule::Gauss(4), &[][..]),
            Self::QuinticMass => (Rule::Gauss(4), Rule::Gauss(4), &QUINTIC_MASS[..]),
            Self::Spline3 => (Rule::Gauss(2), Rule::Gauss(2), &[][..]),
            Self::Spline4 => (Rule::Gauss(3), Rule::Gauss(3), &QUARTIC_MASS[..]),
        };
        let mut all = [0.0; MOST];
        all[2..2 + extra.len()].copy_from_slice(extra);
        Rules {
            axial,
            bending,
            extra: all,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::band::Band;
    use crate::elements::rod::Rod;

    /// Lowest bending frequency of a pinned rod over the exact one, squared, less 1.
    fn frequency_error(discretization: Discretization, elements: usize) -> f64 {
        let material = Material {
            axial: 1e4,
            bending: 1.0,
            density: 1.0,
        };
        let rod = Rod::<4>::new(material, discretization.mesh(&material, 1.0, elements));
        let mut c = rod.fit(|s| [s, 0.0]);
        let n = c.len();
        let (mut stiffness, mass) = (Band::zeros(2 * n, 7), rod.mass());
        rod.add_stiffness(&c, &mut stiffness);
        let held = [0, 1, 2 * rod.end() + 1];
        held.iter().for_each(|&row| stiffness.hold(row));
        assert!(stiffness.factor());
        let mut x = vec![[0.0, 1.0]; n];
        let mut square = 0.0;
        for _ in 0..60 {
            mass.multiply(&x, &mut c);
            let mut flat: Vec<f64> = c.iter().flatten().copied().collect();
            held.iter().for_each(|&row| flat[row] = 0.0);
            let weights = flat.clone();
            stiffness.solve_any(&mut flat);
            let work: f64 = weights.iter().zip(&flat).map(|(a, b)| a * b).sum();
            x = flat.chunks(2).map(|v| [v[0], v[1]]).collect();
            mass.multiply(&x, &mut c);
            let inertia: f64 = c.iter().flatten().zip(&flat).map(|(a, b)| a * b).sum();
            square = work / inertia;
            let size = inertia.sqrt();
            x.iter_mut().flatten().for_each(|v| *v /= size);
        }
        square / std::f64::consts::PI.powi(4) - 1.0
    }

    #[test]
    fn mass_of_high_order_makes_bending_waves_exact_to_order_8() {
        let order = |discretization, meshes: [usize; 2]| {
            let [a, b] = meshes.map(|mesh| frequency_error(discretization, mesh));
            (a / b).abs().log2() / (meshes[1] as f64 / meshes[0] as f64).log2()
        };
        let consistent = order(Discretization::Cubic, [4, 8]);
        assert!((consistent - 4.0).abs() < 0.2, "{consistent}");
        let extra = order(Discretization::CubicMass, [2, 4]);
        assert!((extra - 8.0).abs() < 0.5, "{extra}");
    }
}
