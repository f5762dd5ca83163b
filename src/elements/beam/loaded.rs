//! Moments per reference length along an element of a beam: their power is the integral of `m . w`, with the angular velocity `w` of the
//! sections: that of the tangent's frame, as a rod's, and of the shear rotation against it.
//!
//! Source: the equations of `beam/mod.rs`. A frame that is rotated by the rational vector `c` rotates against the other by
//! `(c' + c x c' / 2) / (1 + |c|^2 / 4)` along the axes of that one (M. Borri, L. Trainelli, C. L. Bottasso, Multibody System Dynamics 4
//! (2000) 129-193).

use super::kernel::{Kernel, Placed, Shapes};
use super::shear_rotation::turned_by_shear;
use super::{At, Beam, Force};
use crate::elements::line::{Sample, dot, times};
use crate::elements::rod::geometry::{LOADED, PlacedSection, Section, Sum};
use crate::elements::rod::loaded::along;
use crate::elements::rod::vectors::plus;
use crate::math::lanes::Real;

impl<N: Real> Kernel<N> {
    /// The section of the tangent's frame at a point, and the shear rotation against it.
    #[inline(always)]
    fn sheared(&self, point: &Sample, placed: &Placed<N>) -> (Section<N>, [N; 2]) {
        let geometry = &self.geometry;
        let section = geometry.section(point, &placed.v, &placed.frame, placed.bubble);
        let mut shear_rotation = [geometry.number(0.0); 2];
        for (of, shape) in placed
            .shear_rotations
            .iter()
            .zip(Shapes::new(point.at).shear_rotation)
        {
            shear_rotation = plus(of, geometry.number(shape), &shear_rotation);
        }
        (section, shear_rotation)
    }

    fn outward(&self, at: &At<N>, vectors: &[[N; 3]; LOADED.len()]) -> [[N; 3]; LOADED.len()] {
        let placed = self.placed(at);
        std::array::from_fn(|k| {
            let (section, [p, q]) = self.sheared(&LOADED[k], &placed);
            let axes = self.geometry.axes(&section, &placed.frame);
            along(&axes, &turned_by_shear([-p, -q], &vectors[k]))
        })
    }

    fn loaded(&self, at: &At<N>, moments: &[[N; 3]; LOADED.len()]) -> Force<N> {
        let (geometry, placed) = (&self.geometry, self.placed(at));
        let (zero, one, half) = (
            geometry.number(0.0),
            geometry.number(1.0),
            geometry.number(0.5),
        );
        let (mut sum, mut shear_rotations) = (Sum::nothing(zero), [[zero; 2]; 3]);
        for (point, moment) in LOADED.iter().zip(moments) {
            let (section, [p, q]) = self.sheared(point, &placed);
            // What is summed is what resists.
            let against = times(moment, geometry.number(-point.weight));
            let place = PlacedSection {
                point,
                section: &section,
                frame: &placed.frame,
            };
            geometry.add_moment(place, &against, &mut sum);
            let axes = geometry.axes(&section, &placed.frame);
            let [twist, first, second] = axes.map(|axis| dot(&axis, &against));
            let shrink = one / (p * p + q * q).times_plus(geometry.number(0.25), one);
            let by_shear_rotation = [
                (first - half * twist * q) * shrink,
                (second + half * twist * p) * shrink,
            ];
            for (sum, shape) in shear_rotations
                .iter_mut()
                .zip(Shapes::new(point.at).shear_rotation)
            {
                *sum = plus(&by_shear_rotation, geometry.number(shape), sum);
            }
        }
        self.spread(&placed, sum, &[zero; 3], &shear_rotations)
    }
}

impl Beam {
    /// Vectors along the axes of the sections at the Gauss points [`LOADED`], in global components.
    pub fn outward<N: Real>(
        &self,
        at: &At<N>,
        vectors: &[[N; 3]; LOADED.len()],
    ) -> [[N; 3]; LOADED.len()] {
        self.kernel.lift(at.inner[0]).outward(at, vectors)
    }

    /// Returns the force of distributed moments on an element. `moments` holds global components per reference length
    /// at the Gauss points [`LOADED`], N m/m.
    pub fn loaded<N: Real>(&self, at: &At<N>, moments: &[[N; 3]; LOADED.len()]) -> Force<N> {
        self.kernel.lift(at.inner[0]).loaded(at, moments)
    }
}
