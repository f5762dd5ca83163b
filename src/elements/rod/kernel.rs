//! The formulas of bending and torsion of a rod, for one element or for several in lanes, or for numbers with derivatives.
//!
//! Source: the equations of `rod/mod.rs`; the gradient is theirs by the variation of a transported frame (1).

use super::geometry::{Geometry, POINTS, PlacedSection, Sum};
use super::stretch::{Axial, Coupled};
use super::vectors::add;
use super::{At, Force, Rates};
use crate::elements::constitutive::Law;
use crate::elements::line::{Sample, dot, times};
use crate::math::lanes::{Lanes, PACK, Real, Simd};

pub(in crate::elements) type Square<N> = [[N; 3]; 3];

/// Parameters of one element or, in lanes, of several.
#[derive(Clone, Debug)]
pub(super) struct Kernel<N> {
    pub geometry: Geometry<N>,
    /// Torque and moments by twist and curvatures.
    pub law: Law<N, 3>,
    /// Stretching, where twist or bending are coupled with it; else it is the line's own.
    pub axial: Option<Axial<N>>,
}

impl Kernel<f64> {
    /// Converts the kernel to constants of the number type of `like`.
    #[inline(always)]
    pub fn lift<N: Real>(&self, like: N) -> Kernel<N> {
        Kernel {
            geometry: self.geometry.lift(like),
            law: self.law.lift(like),
            axial: of_rate!(&self.axial, axial => axial.lift(like)),
        }
    }
}

impl Kernel<[f64; PACK]> {
    /// A group of the elements of a pack.
    #[inline(always)]
    pub fn group<S: Simd>(&self, simd: S, group: usize) -> Kernel<Lanes<S>> {
        Kernel {
            geometry: self.geometry.group(simd, group),
            law: self.law.group(simd, group),
            axial: of_rate!(&self.axial, axial => axial.group(simd, group)),
        }
    }
}

#[inline(always)]
pub(in crate::elements) fn product<N: Real, const K: usize>(
    matrix: &[[N; K]; K],
    v: &[N; K],
) -> [N; K] {
    each!(*v, k => dot(&matrix[k], v))
}

impl<N: Real> Kernel<N> {
    /// Strains at a point: twist, curvature about `d`, curvature about `t x d`.
    #[inline(always)]
    pub fn strains(&self, at: &At<N>, point: &Sample) -> [N; 3] {
        let geometry = &self.geometry;
        let v = geometry.vectors(&at.e);
        let frame = geometry.frame(&v, &at.d);
        geometry.section(point, &v, &frame, at.bubble).strains
    }

    /// Strain energy, J.
    #[inline(always)]
    pub fn energy(&self, at: &At<N>) -> N {
        let geometry = &self.geometry;
        let v = geometry.vectors(&at.e);
        let frame = geometry.frame(&v, &at.d);
        let mut sum = geometry.number(0.0);
        for (index, point) in POINTS.iter().enumerate() {
            let section = geometry.section(point, &v, &frame, at.bubble);
            let strains = add(&section.strains, &self.law.offset[index]);
            let mut twice = dot(&strains, &product(&self.law.stiffness[index], &strains));
            if let Some(axial) = &self.axial {
                let lengths = geometry.lengths(&v, &frame);
                let stretch = axial.stretch(geometry, index, point, &lengths);
                let Coupled { own, with } = &axial.stiffness;
                let coupled = dot(&with[index], &strains);
                twice += stretch * (own[index] * stretch + coupled + coupled);
            }
            sum += geometry.number(0.5 * point.weight) * twice;
        }
        sum * geometry.length
    }

    /// Elastic force and, with rates, damping force; and the power that damping takes out, W.
    #[inline(always)]
    pub fn force(&self, at: &At<N>, rates: Option<&Rates<N>>) -> (Force<N>, N) {
        let geometry = &self.geometry;
        let v = geometry.vectors(&at.e);
        let frame = geometry.frame(&v, &at.d);
        let motion = of_rate!(rates, rates => geometry.motion(&frame, rates));
        let mut power = geometry.number(0.0);
        let (mut sum, mut by_lengths) = (Sum::nothing(power), [power; 3]);
        for (index, point) in POINTS.iter().enumerate() {
            let section = geometry.section(point, &v, &frame, at.bubble);
            let strains = add(&section.strains, &self.law.offset[index]);
            let mut stress = product(&self.law.stiffness[index], &strains);
            let mut pull = power.constant(0.0);
            if let Some(axial) = &self.axial {
                let lengths = geometry.lengths(&v, &frame);
                let stretch = axial.stretch(geometry, index, point, &lengths);
                let coupled = &axial.stiffness;
                pull += coupled.force(index, stretch, &strains);
                coupled.add_moments(index, stretch, &mut stress);
            }
            if let Some(motion) = &motion {
                let rate = geometry.strain_rates(point, &section, &frame, motion);
                let mut damped = product(&self.law.damping[index], &rate);
                if let Some(axial) = &self.axial {
                    let stretching = geometry.length_rates(motion, &frame);
                    let stretching = geometry.at_point(point.at, &stretching);
                    let mut own = power.constant(0.0);
                    let coupled = &axial.damping;
                    own += coupled.force(index, stretching, &rate);
                    coupled.add_moments(index, stretching, &mut damped);
                    power += geometry.number(point.weight) * own * stretching;
                    pull += own;
                }
                power += geometry.number(point.weight) * dot(&damped, &rate);
                stress = add(&stress, &damped);
            }
            let stress = times(&stress, geometry.number(point.weight));
            let place = PlacedSection {
                point,
                section: &section,
                frame: &frame,
            };
            geometry.add_section(place, &stress, &mut sum);
            if self.axial.is_some() {
                let pull = pull * geometry.number(point.weight);
                geometry.add_at_point(point.at, pull, &mut by_lengths);
            }
        }
        if self.axial.is_some() {
            geometry.add_lengths(&frame, &by_lengths, &mut sum);
        }
        (geometry.spread(&frame, &sum), power * geometry.length)
    }
}
