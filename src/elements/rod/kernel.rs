//! The formulas of bending and torsion of a rod, for one element or for several in lanes, or for numbers with derivatives.
//!
//! Source: the equations of `rod/mod.rs`; the gradient is theirs by the variation of a carried frame (1).

use super::geometry::{Geometry, POINTS, Sum};
use super::stretch::{Axial, Coupled};
use super::vectors::add;
use super::{At, Force, Rates};
use crate::elements::line::{Sample, dot, times};
use crate::math::lanes::{Lanes, PACK, Real, Simd};

pub(in crate::elements) type Square<N> = [[N; 3]; 3];

/// Parameters of one element or, in lanes, of several.
#[derive(Clone, Debug)]
pub(super) struct Kernel<N> {
    pub geometry: Geometry<N>,
    /// Stress by strain at the points: torque and moments by twist and curvatures.
    pub stiffness: [Square<N>; 3],
    /// Stress by rate of strain.
    pub damping: [Square<N>; 3],
    /// What is added to the strains at the points before they are multiplied by the stiffness: less those of the
    /// unstressed shape.
    pub offset: Square<N>,
    pub is_damped: bool,
    /// Stretching, where twist or bending are coupled with it; else it is the line's own.
    pub axial: Option<Axial<N>>,
}

impl Kernel<f64> {
    /// The same parameters, as constants of the kind of another number.
    #[inline(always)]
    pub fn lift<N: Real>(&self, like: N) -> Kernel<N> {
        let lifted = |square: &Square<f64>| square.map(|row| row.map(|value| like.constant(value)));
        Kernel {
            geometry: self.geometry.lift(like),
            stiffness: self.stiffness.each_ref().map(lifted),
            damping: self.damping.each_ref().map(lifted),
            offset: lifted(&self.offset),
            is_damped: self.is_damped,
            axial: of_rate!(&self.axial, axial => axial.lift(like)),
        }
    }
}

impl Kernel<[f64; PACK]> {
    /// A group of the elements of a pack.
    #[inline(always)]
    pub fn group<S: Simd>(&self, simd: S, group: usize) -> Kernel<Lanes<S>> {
        let geometry = self.geometry.group(simd, group);
        let mut squares = [[[geometry.length; 3]; 3]; 7];
        let ([a, b, c], [d, e, f]) = (&self.stiffness, &self.damping);
        let all = [a, b, c, d, e, f, &self.offset];
        for (square, from) in all.iter().enumerate() {
            for i in 0..3 {
                for j in 0..3 {
                    squares[square][i][j] = Lanes::read(simd, &from[i][j], group);
                }
            }
        }
        let [a, b, c, d, e, f, offset] = squares;
        Kernel {
            geometry,
            stiffness: [a, b, c],
            damping: [d, e, f],
            offset,
            is_damped: self.is_damped,
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
            let strains = add(&section.strains, &self.offset[index]);
            let mut twice = dot(&strains, &product(&self.stiffness[index], &strains));
            if let Some(axial) = &self.axial {
                let stretch = geometry.at_point(point.at, &geometry.lengths(&v, &frame));
                let stretch = stretch + axial.offset[index];
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
            let strains = add(&section.strains, &self.offset[index]);
            let mut stress = product(&self.stiffness[index], &strains);
            let mut pull = power.constant(0.0);
            if let Some(axial) = &self.axial {
                let stretch = geometry.at_point(point.at, &geometry.lengths(&v, &frame));
                let stretch = stretch + axial.offset[index];
                axial
                    .stiffness
                    .add(index, (stretch, &strains), (&mut pull, &mut stress));
            }
            if let Some(motion) = &motion {
                let rate = geometry.strain_rates(point, &section, &frame, motion);
                let mut damped = product(&self.damping[index], &rate);
                if let Some(axial) = &self.axial {
                    let stretching = geometry.length_rates(motion, &frame);
                    let stretching = geometry.at_point(point.at, &stretching);
                    let mut own = power.constant(0.0);
                    axial
                        .damping
                        .add(index, (stretching, &rate), (&mut own, &mut damped));
                    power += geometry.number(point.weight) * own * stretching;
                    pull += own;
                }
                power += geometry.number(point.weight) * dot(&damped, &rate);
                stress = add(&stress, &damped);
            }
            let stress = times(&stress, geometry.number(point.weight));
            geometry.add_section(point, &section, &frame, &stress, &mut sum);
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
