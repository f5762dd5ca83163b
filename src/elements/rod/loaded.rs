//! Moments per reference length along an element of a rod: their power is the integral of `m . w`, with the angular velocity `w` of the
//! sections as they rotate with the line, the spins of the ends and the internal twist.
//!
//! Source: the equations of `rod/mod.rs`; the angular velocity is that of a transported frame (1).

use super::geometry::{LOADED, PlacedSection, Sum};
use super::vectors::plus;
use super::{At, Force, Rod};
use crate::elements::line::times;
use crate::math::lanes::Real;

/// A vector from its components along axes.
#[inline(always)]
pub(in crate::elements) fn along<N: Real>(axes: &[[N; 3]; 3], components: &[N; 3]) -> [N; 3] {
    let [first, second, third] = components;
    let sum = plus(&axes[1], *second, &times(&axes[0], *first));
    plus(&axes[2], *third, &sum)
}

impl Rod {
    /// Vectors along the axes of the sections at the Gauss points [`LOADED`], in global components.
    pub fn outward<N: Real>(
        &self,
        at: &At<N>,
        vectors: &[[N; 3]; LOADED.len()],
    ) -> [[N; 3]; LOADED.len()] {
        let geometry = self.material().lift(at.bubble).geometry;
        let v = geometry.vectors(&at.e);
        let frame = geometry.frame(&v, &at.d);
        std::array::from_fn(|k| {
            let section = geometry.section(&LOADED[k], &v, &frame, at.bubble);
            along(&geometry.axes(&section, &frame), &vectors[k])
        })
    }

    /// Returns the force of distributed moments on an element. `moments` holds global components per reference length
    /// at the Gauss points [`LOADED`], N m/m.
    pub fn loaded<N: Real>(&self, at: &At<N>, moments: &[[N; 3]; LOADED.len()]) -> Force<N> {
        let geometry = self.kernel.lift(at.bubble).geometry;
        let v = geometry.vectors(&at.e);
        let frame = geometry.frame(&v, &at.d);
        let mut sum = Sum::nothing(geometry.number(0.0));
        for (point, moment) in LOADED.iter().zip(moments) {
            let section = geometry.section(point, &v, &frame, at.bubble);
            // What is summed is what resists.
            let against = times(moment, geometry.number(-point.weight));
            let place = PlacedSection {
                point,
                section: &section,
                frame: &frame,
            };
            geometry.add_moment(place, &against, &mut sum);
        }
        geometry.spread(&frame, &sum)
    }
}
