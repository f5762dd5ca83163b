//! Sections of thin plates and shells.

/// Stiffness and mass of a section along its axes `f1`, `f2`: `N = A eps - B kap`, `M = -B eps + D kap`, with engineering shear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShellSection {
    /// `A`, N/m.
    pub membrane: [[f64; 3]; 3],
    /// `B`, N.
    pub coupling: [[f64; 3]; 3],
    /// `D`, N m.
    pub bending: [[f64; 3]; 3],
    /// Mass per area, kg/m^2.
    pub area_density: f64,
    /// Kelvin-Voigt damping: ratio of viscosity to stiffness, s.
    pub damping_time: f64,
    /// Angle of `f1` from the first direction of the surface, rad.
    pub angle: f64,
}

impl ShellSection {
    /// Section of an isotropic material, by Young's modulus (Pa), Poisson's ratio, density (kg/m^3) and thickness (m).
    pub fn isotropic(
        youngs_modulus: f64,
        poisson_ratio: f64,
        density: f64,
        thickness: f64,
    ) -> Self {
        let (h, nu) = (thickness, poisson_ratio);
        let a = youngs_modulus * h / (1.0 - nu * nu);
        let membrane = [
            [a, nu * a, 0.0],
            [nu * a, a, 0.0],
            [0.0, 0.0, 0.5 * (1.0 - nu) * a],
        ];
        Self {
            membrane,
            coupling: [[0.0; 3]; 3],
            bending: membrane.map(|row| row.map(|entry| entry * h * h / 12.0)),
            area_density: density * h,
            damping_time: 0.0,
            angle: 0.0,
        }
    }
}

/// Position, its derivatives by both lengths, and the mixed one.
pub type Corner = [[f64; 3]; 4];
