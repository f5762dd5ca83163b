//! Strains, forces and stress of plates and shells at their markers.
//!
//! Source: R. M. Jones, Mechanics of Composite Materials (1999), Eqs. 4.12-4.21 (strain through the thickness, stress of plies, forces and
//! moments per length).

use super::evaluation::Evaluation;
use crate::bodies::{Marker, Patch, stress_at};
use crate::math::jet::Number;
use crate::system::System;

/// A height in the section of a plate or shell where stress is read.
#[derive(Clone, Copy, Debug)]
pub struct StressLayer {
    /// Where on the surface.
    pub marker: Marker,
    /// Height along the normal from the middle surface, m.
    pub height: f64,
    /// Stress 11, 22 and 12 of strains along the axes of the section, Pa.
    pub law: [[f64; 3]; 3],
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Membrane strains and changes of curvature (1/m) at a marker of a plate or shell along the axes of its section: 11, 22 and twice 12.
    /// Zero elsewhere.
    pub fn surface_strain(&self, system: &System<D>, marker: &Marker) -> [[N; 3]; 2] {
        let at = system.bodies.patch_point(marker);
        at.map_or([[N::of(0.0); 3]; 2], |(patch, point)| {
            self.strain_at(patch, point, false)
        })
    }

    /// Membrane forces (N/m) and bending moments (N) per length at a marker of a plate or shell along the axes of its section: 11, 22 and
    /// 12, with those of damping. Zero elsewhere.
    pub fn surface_forces(&self, system: &System<D>, marker: &Marker) -> [[N; 3]; 2] {
        let at = system.bodies.patch_point(marker);
        at.map_or([[N::of(0.0); 3]; 2], |(patch, point)| {
            patch.section_force(point, self.strain_at(patch, point, true))
        })
    }

    /// Stress 11, 22 and 12 at a height of a plate or shell, with that of damping, Pa.
    pub fn layer_stress(&self, system: &System<D>, layer: &StressLayer) -> [N; 3] {
        let Some((patch, point)) = system.bodies.patch_point(&layer.marker) else {
            return [N::of(0.0); 3];
        };
        let strain = self.strain_at(patch, point, true);
        stress_at((layer.height, &layer.law), strain)
    }

    /// Strains at a point, with those that rates add where that is asked for: recovered once for all outputs.
    fn strain_at(&self, patch: &Patch, point: usize, is_damped: bool) -> [[N; 3]; 2] {
        let known = &self.strains[patch.point_of_all(point)][usize::from(is_damped)];
        known.get().unwrap_or_else(|| {
            let rates = is_damped.then_some(&self.v[..]);
            let found = patch.section_strain(point, &self.x, rates);
            known.set(Some(found));
            found
        })
    }
}
