//! Stiffness and mass of the section of a plate or shell: membrane forces and moments of strains and curvatures.
//!
//! Source: R. M. Jones, Mechanics of Composite Materials (1999), Eqs. 4.15-4.24 (laminates), 2.61 and 2.80 (plane stress along rotated axes).

use nalgebra::{Matrix3, Matrix6, Vector3};

use super::axis_components;

/// A symmetric matrix over components 11, 22 and 12.
pub type Stiffness = [[f64; 3]; 3];

/// Stiffness and mass of a section along its axes `f1`, `f2`: `N = A eps - B kappa`, `M = -B eps + D kappa` with the engineering shear
/// `2 eps12` and twist `2 kappa12`. The strain at height `z` along the normal is `eps - z kappa`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShellSection {
    /// Membrane stiffness `A`, N/m.
    pub membrane: Stiffness,
    /// Coupling `B`, N.
    pub coupling: Stiffness,
    /// Bending stiffness `D`, N m.
    pub bending: Stiffness,
    /// Mass per area, kg/m^2.
    pub area_density: f64,
    /// Kelvin-Voigt damping time: stress is stiffness times (strain + time x strain rate), s.
    pub damping_time: f64,
    /// Angle of `f1` from the first lines of the surface about the normal, rad.
    pub angle: f64,
}

/// A layer of an orthotropic material in plane stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ply {
    /// Young's moduli along and across the fibres, Pa.
    pub youngs_moduli: [f64; 2],
    /// Poisson's ratio: contraction across the fibres under tension along them.
    pub poisson_ratio: f64,
    /// Shear modulus, Pa.
    pub shear_modulus: f64,
    /// Density, kg/m^3.
    pub density: f64,
    /// Thickness, m.
    pub thickness: f64,
    /// Angle of the fibres from the axis `f1`, rad.
    pub angle: f64,
}

impl Ply {
    /// A layer of one isotropic material: Young's modulus (Pa), Poisson's ratio, density (kg/m^3), thickness (m).
    pub fn isotropic(
        youngs_modulus: f64,
        poisson_ratio: f64,
        density: f64,
        thickness: f64,
    ) -> Self {
        Self {
            youngs_moduli: [youngs_modulus; 2],
            poisson_ratio,
            shear_modulus: 0.5 * youngs_modulus / (1.0 + poisson_ratio),
            density,
            thickness,
            angle: 0.0,
        }
    }

    /// Stiffness of plane stress along the axes of the section, Pa.
    pub fn stiffness(&self) -> Stiffness {
        rotated(&self.along_fibres(), &self.fibre_strains())
    }

    /// Stress along and across the fibres and shear stress, of strains along the axes of the section, Pa.
    pub fn fibre_stress(&self) -> Stiffness {
        let along = Matrix3::from(self.along_fibres()).transpose();
        rows(&(along * self.fibre_strains()))
    }

    /// Stiffness of plane stress along the axes of the material, Pa.
    fn along_fibres(&self) -> Stiffness {
        let ([e1, e2], nu) = (self.youngs_moduli, self.poisson_ratio);
        let over = 1.0 / (1.0 - nu * nu * e2 / e1);
        [
            [e1 * over, nu * e2 * over, 0.0],
            [nu * e2 * over, e2 * over, 0.0],
            [0.0, 0.0, self.shear_modulus],
        ]
    }

    /// Takes strains along the axes of the section to those along the axes of the material.
    fn fibre_strains(&self) -> Matrix3<f64> {
        let (sin, cos) = self.angle.sin_cos();
        strain_transformation([[cos, sin], [-sin, cos]])
    }
}

/// Takes strains `(eps_11, eps_22, 2 eps_12)` in one pair of vectors to those in another, whose `k`-th vector has the components `c[k]`.
pub(super) fn strain_transformation(c: [[f64; 2]; 2]) -> Matrix3<f64> {
    let [[c11, c12], [c21, c22]] = c;
    Matrix3::new(
        c11 * c11,
        c12 * c12,
        c11 * c12,
        c21 * c21,
        c22 * c22,
        c21 * c22,
        2.0 * c11 * c21,
        2.0 * c12 * c22,
        c11 * c22 + c12 * c21,
    )
}

/// `T^T C T`.
pub(super) fn rotated(stiffness: &Stiffness, by: &Matrix3<f64>) -> Stiffness {
    let stiffness = Matrix3::from_fn(|r, c| stiffness[r][c]);
    rows(&(by.transpose() * stiffness * by))
}

fn rows(of: &Matrix3<f64>) -> Stiffness {
    std::array::from_fn(|r| std::array::from_fn(|c| of[(r, c)]))
}

impl ShellSection {
    /// A plate of one isotropic material: Young's modulus (Pa), Poisson's ratio, density (kg/m^3), thickness (m).
    pub fn isotropic(
        youngs_modulus: f64,
        poisson_ratio: f64,
        density: f64,
        thickness: f64,
    ) -> Self {
        Self::laminate(&[Ply::isotropic(
            youngs_modulus,
            poisson_ratio,
            density,
            thickness,
        )])
    }

    /// Layers from the bottom to the top, about the middle of their whole thickness.
    pub fn laminate(plies: &[Ply]) -> Self {
        let thickness: f64 = plies.iter().map(|ply| ply.thickness).sum();
        let [mut membrane, mut coupling, mut bending] = [[[0.0; 3]; 3]; 3];
        let (mut bottom, mut area_density) = (-0.5 * thickness, 0.0);
        for ply in plies {
            let (stiffness, top) = (ply.stiffness(), bottom + ply.thickness);
            let moment = |power: i32| (top.powi(power) - bottom.powi(power)) / f64::from(power);
            for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
                membrane[r][c] += stiffness[r][c] * moment(1);
                coupling[r][c] += stiffness[r][c] * moment(2);
                bending[r][c] += stiffness[r][c] * moment(3);
            }
            area_density += ply.density * ply.thickness;
            bottom = top;
        }
        // One layer, or layers that are the same about the middle, leave rounding alone.
        let size = thickness
            * membrane
                .as_flattened()
                .iter()
                .fold(0.0, |a: f64, b| a.max(b.abs()));
        let couples = |entry: &f64| entry.abs() > 1e-14 * size;
        if !coupling.as_flattened().iter().any(couples) {
            coupling = [[0.0; 3]; 3];
        }
        Self {
            membrane,
            coupling,
            bending,
            area_density,
            damping_time: 0.0,
            angle: 0.0,
        }
    }

    /// Takes covariant strains or curvatures, 11, 22 and twice 12, to those along the axes of the section, of the derivatives of the
    /// position of the unstressed surface.
    pub fn axes_transformation(&self, tangents: &[Vector3<f64>; 2]) -> [[f64; 3]; 3] {
        rows(&strain_transformation(axis_components(
            tangents, self.angle,
        )))
    }

    /// Curvature along each of the lines of a surface, with the opposite sign, that goes with one along the other where no moment acts along
    /// the first, of the derivatives of the position of the unstressed surface.
    pub fn contraction(&self, tangents: &[Vector3<f64>; 2]) -> [f64; 2] {
        let by = strain_transformation(axis_components(tangents, self.angle));
        let bending = rotated(&self.bending, &by);
        [0, 1].map(|k| bending[k][1 - k] / bending[k][k])
    }

    /// Whether every strain and curvature stores energy.
    pub fn is_positive(&self) -> bool {
        let whole = Matrix6::from_fn(|r, c| {
            let of = match (r < 3, c < 3) {
                (true, true) => &self.membrane,
                (false, false) => &self.bending,
                _ => &self.coupling,
            };
            let sign = if (r < 3) == (c < 3) { 1.0 } else { -1.0 };
            sign * of[r % 3][c % 3]
        });
        // Membrane and bending have different units: rows and columns are scaled to a diagonal of ones.
        let scale = whole.diagonal().map(|entry| 1.0 / entry.sqrt());
        if scale.iter().any(|entry| !entry.is_finite()) {
            return false;
        }
        let scaled = Matrix6::from_fn(|r, c| whole[(r, c)] * scale[r] * scale[c]);
        let lower = nalgebra::Cholesky::new(scaled);
        lower.is_some_and(|factor| factor.l_dirty().diagonal().min() > 1e-6)
    }
}
