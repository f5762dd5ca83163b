//! Sections of plates and shells: from a material, plies or matrices.

use nalgebra::{Matrix3, Matrix6};

use crate::elements::shell::ShellSection;
use crate::scene::description::{PatchBody, PatchStiffness, Ply, PlyMaterial};

impl PatchBody {
    /// Stiffness and mass of its section.
    pub fn section(&self) -> ShellSection {
        let damping_time = self.damping_time.unwrap_or_default();
        let section = if let (Some(material), Some(thickness)) = (&self.material, self.thickness) {
            let isotropic = ShellSection::isotropic(
                material.youngs_modulus,
                material.poisson_ratio,
                material.density,
                thickness,
            );
            return ShellSection {
                damping_time: material.damping_time,
                ..isotropic
            };
        } else if let Some(PatchStiffness { A, B, D }) = self.stiffness {
            ShellSection {
                membrane: A,
                coupling: B,
                bending: D,
                area_density: self.area_density.unwrap_or_default(),
                damping_time,
                angle: 0.0,
            }
        } else {
            ShellSection {
                damping_time,
                ..laminate(&self.laminate)
            }
        };
        ShellSection {
            angle: self.axis_angle,
            ..section
        }
    }

    /// Stiffness of the section: forces and moments by strains and curvatures.
    pub fn stiffness_matrix(&self) -> Matrix6<f64> {
        let section = self.section();
        let part = |of: [[f64; 3]; 3]| Matrix3::from(of).transpose();
        let coupling = -part(section.coupling);
        let mut matrix = Matrix6::zeros();
        let places = [(0, 0), (0, 3), (3, 0), (3, 3)];
        let parts = [
            part(section.membrane),
            coupling,
            coupling,
            part(section.bending),
        ];
        for ((row, column), part) in places.into_iter().zip(parts) {
            matrix.fixed_view_mut::<3, 3>(row, column).copy_from(&part);
        }
        matrix
    }

    /// Thickness of the body as drawn and told, m; of matrices that of a homogeneous section with the same ratio of stiffnesses.
    pub fn whole_thickness(&self) -> f64 {
        let plies = || self.laminate.iter().map(|ply| ply.thickness).sum();
        match (self.thickness, &self.stiffness) {
            (Some(thickness), _) => thickness,
            (None, Some(PatchStiffness { A, D, .. })) => (12.0 * D[0][0] / A[0][0]).sqrt(),
            (None, None) => plies(),
        }
    }
}

/// Classical laminate theory: plies from the bottom to the top about the middle surface.
///
/// Source: R. M. Jones, Mechanics of Composite Materials, 2nd ed. (1999), sections 2.6 and 4.2.
fn laminate(plies: &[Ply]) -> ShellSection {
    let whole: f64 = plies.iter().map(|ply| ply.thickness).sum();
    let [mut membrane, mut coupling, mut bending] = [Matrix3::zeros(); 3];
    let (mut bottom, mut area_density) = (-0.5 * whole, 0.0);
    for ply in plies {
        let (top, stiffness) = (bottom + ply.thickness, ply.material.rotated(ply.angle));
        let integral = |power: i32| (top.powi(power) - bottom.powi(power)) / f64::from(power);
        membrane += stiffness * integral(1);
        coupling += stiffness * integral(2);
        bending += stiffness * integral(3);
        area_density += ply.material.density * ply.thickness;
        bottom = top;
    }
    ShellSection {
        membrane: membrane.into(),
        coupling: coupling.into(),
        bending: bending.into(),
        area_density,
        damping_time: 0.0,
        angle: 0.0,
    }
}

impl PlyMaterial {
    /// Stresses by strains along its axes, Pa, with engineering shear.
    pub fn stiffness(&self) -> Matrix3<f64> {
        let ([first, second], ratio) = (self.youngs_modulus, self.poisson_ratio);
        let factor = (1.0 - ratio * ratio * second / first).recip();
        let coupled = ratio * second * factor;
        Matrix3::new(
            first * factor,
            coupled,
            0.0,
            coupled,
            second * factor,
            0.0,
            0.0,
            0.0,
            self.shear_modulus,
        )
    }

    /// Stresses by strains along axes that this angle takes to its own, Pa.
    fn rotated(&self, angle: f64) -> Matrix3<f64> {
        let (s, c) = angle.sin_cos();
        let strains = Matrix3::new(
            c * c,
            s * s,
            s * c,
            s * s,
            c * c,
            -s * c,
            -2.0 * s * c,
            2.0 * s * c,
            c * c - s * s,
        );
        strains.transpose() * self.stiffness() * strains
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CARBON: PlyMaterial = PlyMaterial {
        youngs_modulus: [140e9, 10e9],
        poisson_ratio: 0.3,
        shear_modulus: 5e9,
        density: 1600.0,
    };

    fn ply(angle: f64) -> Ply {
        Ply {
            material: CARBON,
            thickness: 1e-3,
            angle,
        }
    }

    /// A ply at a right angle has its axes exchanged, one at an angle the modulus of Jones, Eq. 2.97.
    #[test]
    fn plies_are_rotated() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let (plain, turned) = (CARBON.stiffness(), CARBON.rotated(quarter));
        assert!((plain[(0, 0)] / turned[(1, 1)] - 1.0).abs() < 1e-12);
        assert!((plain[(1, 1)] / turned[(0, 0)] - 1.0).abs() < 1e-12);
        let angle: f64 = 0.4;
        let (s2, c2) = (angle.sin().powi(2), angle.cos().powi(2));
        let [first, second] = CARBON.youngs_modulus;
        let compliance = c2 * c2 / first
            + (1.0 / CARBON.shear_modulus - 2.0 * CARBON.poisson_ratio / first) * s2 * c2
            + s2 * s2 / second;
        let inverse = CARBON.rotated(angle).try_inverse().expect("a stiffness");
        assert!((inverse[(0, 0)] / compliance - 1.0).abs() < 1e-12);
    }

    /// Two plies across each other couple, symmetric ones do not; many plies alike are a homogeneous plate.
    #[test]
    fn laminates_are_as_in_classical_theory() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let (low, high) = (CARBON.stiffness()[(1, 1)], CARBON.stiffness()[(0, 0)]);
        let across = laminate(&[ply(0.0), ply(quarter)]);
        // B11 = integral of Q z, from the bottom to the top.
        assert!((across.coupling[0][0] / (0.5e-6 * (low - high)) - 1.0).abs() < 1e-12);
        assert!((across.area_density - 3.2).abs() < 1e-12);
        let symmetric = laminate(&[ply(0.5), ply(-0.5), ply(-0.5), ply(0.5)]);
        let size = symmetric.membrane[0][0] * 1e-3;
        let coupling = symmetric.coupling.as_flattened().iter();
        assert!(coupling.map(|of| of.abs()).fold(0.0, f64::max) < 1e-12 * size);
        let alike = laminate(&[ply(0.3); 4]);
        let ratio = alike.bending[0][1] / alike.membrane[0][1] / (16e-6 / 12.0);
        assert!((ratio - 1.0).abs() < 1e-12);
    }
}
