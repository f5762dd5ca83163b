//! Sections of plates and shells: from a material, plies or matrices.

use crate::bodies::SectionFaces;
use crate::elements::shell::{Ply, ShellSection};
use crate::scene::description::{LaminatePly, PatchBody, PatchStiffness};

/// A layer of a section with the heights of its bottom and top from the middle surface, m.
#[derive(Clone, Copy, Debug)]
pub struct SectionPly {
    /// Material, thickness and angle.
    pub ply: Ply,
    /// Heights of bottom and top along the normal, m.
    pub heights: [f64; 2],
}

impl PatchBody {
    /// Stiffness and mass of its section.
    pub fn section(&self) -> ShellSection {
        let section = match self.stiffness {
            Some(PatchStiffness { A, B, D }) => ShellSection {
                membrane: A,
                coupling: B,
                bending: D,
                area_density: self.area_density.unwrap_or_default(),
                damping_time: 0.0,
                angle: 0.0,
            },
            None => ShellSection::laminate(&self.plies()),
        };
        let of_material = self.material.as_ref().map(|material| material.damping_time);
        ShellSection {
            damping_time: of_material.or(self.damping_time).unwrap_or_default(),
            angle: self.axis_angle,
            ..section
        }
    }

    /// Plies, or the one of a material; none of matrices.
    fn plies(&self) -> Vec<Ply> {
        match (&self.material, self.thickness) {
            (Some(material), Some(thickness)) => vec![Ply::isotropic(
                material.youngs_modulus,
                material.poisson_ratio,
                material.density,
                thickness,
            )],
            _ => self.laminate.iter().map(LaminatePly::layer).collect(),
        }
    }

    /// Layers of its section from the bottom to the top; none of matrices.
    pub fn layers(&self) -> Vec<SectionPly> {
        let plies = self.plies();
        let whole: f64 = plies.iter().map(|ply| ply.thickness).sum();
        let mut bottom = -0.5 * whole;
        let layer = |ply: Ply| {
            let heights = [bottom, bottom + ply.thickness];
            bottom = heights[1];
            SectionPly { ply, heights }
        };
        plies.into_iter().map(layer).collect()
    }

    /// Bottom and top of its section; none of matrices.
    pub fn faces(&self) -> Option<SectionFaces> {
        let layers = self.layers();
        let (bottom, top) = (layers.first()?, layers.last()?);
        let of = |layer: &SectionPly, height: f64| (height, layer.ply.stiffness());
        Some(SectionFaces {
            section: self.section(),
            faces: [of(bottom, bottom.heights[0]), of(top, top.heights[1])],
        })
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
