//! Sections of plates and shells: from a material, plies or matrices.

use crate::bodies::SectionFaces;
use crate::elements::shell::{Ply, ShellSection};
use crate::math::expression::Expression;
use crate::scene::description::{LaminatePly, PatchBody, PatchStiffness, PatchThickness};

/// A layer of a section with the heights of its bottom and top from the middle surface, m.
#[derive(Clone, Copy, Debug)]
pub struct SectionPly {
    /// Material, thickness and angle.
    pub ply: Ply,
    /// Heights of bottom and top along the normal, m.
    pub heights: [f64; 2],
}

impl PatchThickness {
    /// Thickness at a place, `s1` and `s2` in [0, 1], m.
    ///
    /// # Errors
    /// An expression that is not valid, or that depends on more than the place.
    pub fn at(&self, [first, second]: [f64; 2]) -> Result<f64, String> {
        match self {
            Self::Number(number) => Ok(*number),
            Self::Expression(text) => {
                let read = Expression::at(text, &[("s1", first), ("s2", second)])?;
                let constant = read.constant();
                constant.ok_or_else(|| "expected an expression in `s1` and `s2` alone".into())
            }
        }
    }
}

impl PatchBody {
    /// Whether its section is the same all over.
    pub fn is_uniform(&self) -> bool {
        !matches!(self.thickness, Some(PatchThickness::Expression(_)))
    }

    /// Stiffness and mass of its section at a place, `s1` and `s2` in [0, 1].
    pub fn section(&self, at: [f64; 2]) -> ShellSection {
        let section = match self.stiffness {
            Some(PatchStiffness { A, B, D }) => ShellSection {
                membrane: A,
                coupling: B,
                bending: D,
                area_density: self.area_density.unwrap_or_default(),
                damping_time: 0.0,
                angle: 0.0,
            },
            None => ShellSection::laminate(&self.plies(at)),
        };
        let of_material = self.material.as_ref().map(|material| material.damping_time);
        ShellSection {
            damping_time: of_material.or(self.damping_time).unwrap_or_default(),
            angle: self.axis_angle,
            ..section
        }
    }

    /// Plies at a place, or the one of a material; none of matrices.
    fn plies(&self, at: [f64; 2]) -> Vec<Ply> {
        let thickness = self.thickness.as_ref();
        match (&self.material, thickness.and_then(|of| of.at(at).ok())) {
            (Some(material), Some(thickness)) => vec![Ply::isotropic(
                material.youngs_modulus,
                material.poisson_ratio,
                material.density,
                thickness,
            )],
            _ => self.laminate.iter().map(LaminatePly::layer).collect(),
        }
    }

    /// Layers of its section at a place from the bottom to the top; none of matrices.
    pub fn layers(&self, at: [f64; 2]) -> Vec<SectionPly> {
        let plies = self.plies(at);
        let whole: f64 = plies.iter().map(|ply| ply.thickness).sum();
        let mut bottom = -0.5 * whole;
        let layer = |ply: Ply| {
            let heights = [bottom, bottom + ply.thickness];
            bottom = heights[1];
            SectionPly { ply, heights }
        };
        plies.into_iter().map(layer).collect()
    }

    /// Thickness of its section at a place, m; zero of matrices, which do not say it.
    pub fn whole_thickness(&self, at: [f64; 2]) -> f64 {
        self.plies(at).iter().map(|ply| ply.thickness).sum()
    }

    /// Bottom and top of its section at a place; none of matrices.
    pub fn faces(&self, at: [f64; 2]) -> Option<SectionFaces> {
        let layers = self.layers(at);
        let (bottom, top) = (layers.first()?, layers.last()?);
        let of = |layer: &SectionPly, height: f64| (height, layer.ply.stiffness());
        Some(SectionFaces {
            section: self.section(at),
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
