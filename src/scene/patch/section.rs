//! Sections of plates and shells: from a material, plies or matrices.

use crate::elements::shell::{Ply, ShellSection};
use crate::scene::description::{LaminatePly, PatchBody, PatchStiffness};

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
                ..ShellSection::laminate(
                    &self
                        .laminate
                        .iter()
                        .map(LaminatePly::layer)
                        .collect::<Vec<_>>(),
                )
            }
        };
        ShellSection {
            angle: self.axis_angle,
            ..section
        }
    }
}

impl LaminatePly {
    /// The ply as a layer of a section.
    fn layer(&self) -> Ply {
        Ply {
            youngs_moduli: self.material.youngs_modulus,
            poisson_ratio: self.material.poisson_ratio,
            shear_modulus: self.material.shear_modulus,
            density: self.material.density,
            thickness: self.thickness,
            angle: self.angle,
        }
    }
}
