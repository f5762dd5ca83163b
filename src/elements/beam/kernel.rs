//! The formulas of a beam, for one element or for several in lanes, or for numbers with derivatives.
//!
//! Source: the equations of `beam/mod.rs`.

use super::end::End;
use super::shear_rotation::{Local, ShearedSection, Six};
use super::{At, Force, Rates};
use crate::elements::constitutive::Law;
use crate::elements::line::{Sample, combine, dot, times};
use crate::elements::rod;
use crate::elements::rod::geometry::{
    Frame, Geometry, MIDDLE, Motion, POINTS, PlacedSection, Section, Sum,
};
use crate::elements::rod::kernel::product;
use crate::elements::rod::stretch::parabola;
use crate::elements::rod::vectors::{Vector, add, plus};
use crate::math::lanes::{Lanes, PACK, Real, Simd};

/// Parameters of one element or, in lanes, of several.
#[derive(Clone, Debug)]
pub(super) struct Kernel<N> {
    pub geometry: Geometry<N>,
    pub law: Law<N, 6>,
}

/// An element with the frames of its tangents.
pub(super) struct Placed<N> {
    pub v: [Vector<N>; 3],
    pub ends: [End<N>; 2],
    pub frame: Frame<N>,
    /// Length of the slope at the first end, in the middle and at the last end.
    pub stretches: [N; 3],
    /// shear rotation at the first end, at the last, and the internal one.
    pub shear_rotations: [[N; 2]; 3],
    pub bubble: N,
}

/// Rates of an element with the frames of its tangents.
pub(super) struct Moving<N> {
    motion: Motion<N>,
    stretches: [N; 3],
    shear_rotations: [[N; 2]; 3],
}

/// Shape functions at a point of the length of the slope and of the shear rotations.
pub(super) struct Shapes {
    /// Shape functions of the length of the slope, in the order first end, middle, last end.
    pub stretch: [f64; 3],
    /// Shape functions of the shear rotation, in the order first end, last end, internal.
    pub shear_rotation: [f64; 3],
    /// Derivatives of these by the reference length times the length.
    pub change: [f64; 3],
}

impl Shapes {
    #[inline(always)]
    pub fn new(at: f64) -> Self {
        let (rest, bubble) = (1.0 - at, 4.0 * at * (1.0 - at));
        Self {
            stretch: parabola(at),
            shear_rotation: [rest, at, bubble],
            change: [-1.0, 1.0, 4.0 - 8.0 * at],
        }
    }
}

impl Kernel<f64> {
    /// Converts the kernel to constants of the number type of `like`.
    #[inline(always)]
    pub fn lift<N: Real>(&self, like: N) -> Kernel<N> {
        Kernel {
            geometry: self.geometry.lift(like),
            law: self.law.lift(like),
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
        }
    }
}

impl<N: Real> Kernel<N> {
    #[inline(always)]
    pub fn placed(&self, at: &At<N>) -> Placed<N> {
        let v = self.geometry.vectors(&at.e);
        let ends = [
            End::new(&at.e[1], &at.axes[0]),
            End::new(&at.e[3], &at.axes[1]),
        ];
        let frame = self
            .geometry
            .frame(&v, &[ends[0].across[0], ends[1].across[0]]);
        let middle = dot(&combine(&MIDDLE, &v), &frame.middle);
        Placed {
            stretches: [ends[0].size, middle, ends[1].size],
            shear_rotations: [
                ends[0].shear_rotation,
                ends[1].shear_rotation,
                [at.inner[1], at.inner[2]],
            ],
            bubble: at.inner[0],
            v,
            ends,
            frame,
        }
    }

    /// Computes the rates of vectors, frames and inner coordinates, from which rates of strains follow.
    #[inline(always)]
    pub fn moving(&self, placed: &Placed<N>, rates: &Rates<N>) -> Moving<N> {
        let [first, last] = &placed.ends;
        let (turn, shear_rotation) = first.rates(&rates.e[1], &rates.spin[0]);
        let (other_turn, other_shear_rotation) = last.rates(&rates.e[3], &rates.spin[1]);
        let [bubble, p, q] = rates.inner;
        let dv = self.geometry.vectors(&rates.e);
        let rates = rod::Rates {
            e: rates.e,
            spin: [turn, other_turn],
            bubble,
        };
        Moving {
            motion: self.geometry.motion(&placed.frame, &rates),
            stretches: self.geometry.lengths(&dv, &placed.frame),
            shear_rotations: [shear_rotation, other_shear_rotation, [p, q]],
        }
    }

    /// Computes the quantities from which the strains at a point follow, or their rates.
    #[inline(always)]
    fn local(
        &self,
        point: &Sample,
        turning: [N; 3],
        stretches: &[N; 3],
        shear_rotations: &[[N; 2]; 3],
    ) -> Local<N> {
        let (geometry, shapes) = (&self.geometry, Shapes::new(point.at));
        let zero = geometry.number(0.0);
        let (mut stretch, mut shear_rotation, mut change) = (zero, [zero; 2], [zero; 2]);
        for k in 0..3 {
            stretch = stretches[k].times_plus(geometry.number(shapes.stretch[k]), stretch);
            shear_rotation = plus(
                &shear_rotations[k],
                geometry.number(shapes.shear_rotation[k]),
                &shear_rotation,
            );
            change = plus(
                &shear_rotations[k],
                geometry.number(shapes.change[k]),
                &change,
            );
        }
        Local {
            stretch,
            turning,
            shear_rotation,
            change: times(&change, geometry.inverse_length),
        }
    }

    #[inline(always)]
    pub fn section(&self, point: &Sample, placed: &Placed<N>) -> (Section<N>, ShearedSection<N>) {
        let section = self
            .geometry
            .section(point, &placed.v, &placed.frame, placed.bubble);
        let local = self.local(
            point,
            section.strains,
            &placed.stretches,
            &placed.shear_rotations,
        );
        (section, ShearedSection::new(local))
    }

    /// Strains at a point.
    #[inline(always)]
    pub fn strains(&self, at: &At<N>, point: &Sample) -> Six<N> {
        self.section(point, &self.placed(at)).1.strains()
    }

    /// Strain energy, J.
    #[inline(always)]
    pub fn energy(&self, at: &At<N>) -> N {
        let placed = self.placed(at);
        let mut sum = self.geometry.number(0.0);
        for (index, point) in POINTS.iter().enumerate() {
            let strains = self.section(point, &placed).1.strains();
            let strains = add(&strains, &self.law.offset[index]);
            sum += self.geometry.number(0.5 * point.weight)
                * dot(&strains, &product(&self.law.stiffness[index], &strains));
        }
        sum * self.geometry.length
    }

    /// Elastic force and, with rates, damping force; and the power that damping takes out, W.
    #[inline(always)]
    pub fn force(&self, at: &At<N>, rates: Option<&Rates<N>>) -> (Force<N>, N) {
        let (geometry, placed) = (&self.geometry, self.placed(at));
        let moving = of_rate!(rates, rates => self.moving(&placed, rates));
        let zero = geometry.number(0.0);
        let (mut power, mut sum) = (zero, Sum::nothing(zero));
        let (mut stretches, mut shear_rotations) = ([zero; 3], [[zero; 2]; 3]);
        for (index, point) in POINTS.iter().enumerate() {
            let (section, sheared) = self.section(point, &placed);
            let (rows, shapes) = (sheared.rows(), Shapes::new(point.at));
            let strains = add(&sheared.strains(), &self.law.offset[index]);
            let mut stress = product(&self.law.stiffness[index], &strains);
            if let Some(moving) = &moving {
                let rate = rows.rates(&self.local_rates(point, &section, &placed, moving));
                let damped = product(&self.law.damping[index], &rate);
                power += geometry.number(point.weight) * dot(&damped, &rate);
                stress = add(&stress, &damped);
            }
            let factors = rows.factors(&times(&stress, geometry.number(point.weight)));
            let at = PlacedSection {
                point,
                section: &section,
                frame: &placed.frame,
            };
            geometry.add_section(at, &factors.turning, &mut sum);
            let change = times(&factors.change, geometry.inverse_length);
            for k in 0..3 {
                stretches[k] = factors
                    .stretch
                    .times_plus(geometry.number(shapes.stretch[k]), stretches[k]);
                let of_shear_rotation = plus(
                    &factors.shear_rotation,
                    geometry.number(shapes.shear_rotation[k]),
                    &shear_rotations[k],
                );
                shear_rotations[k] = plus(
                    &change,
                    geometry.number(shapes.change[k]),
                    &of_shear_rotation,
                );
            }
        }
        let force = self.spread(&placed, sum, &stretches, &shear_rotations);
        (force, power * geometry.length)
    }

    #[inline(always)]
    pub fn local_rates(
        &self,
        point: &Sample,
        section: &Section<N>,
        placed: &Placed<N>,
        moving: &Moving<N>,
    ) -> Local<N> {
        let turning = self
            .geometry
            .strain_rates(point, section, &placed.frame, &moving.motion);
        self.local(point, turning, &moving.stretches, &moving.shear_rotations)
    }

    /// Force from the summed factors.
    #[inline(always)]
    pub fn spread(
        &self,
        placed: &Placed<N>,
        mut sum: Sum<N>,
        stretches: &[N; 3],
        shear_rotations: &[[N; 2]; 3],
    ) -> Force<N> {
        let (geometry, [first, last]) = (&self.geometry, &placed.ends);
        geometry.add_lengths(&placed.frame, stretches, &mut sum);
        let rod::Force { e, torque, bubble } = geometry.spread(&placed.frame, &sum);
        let shear_rotations = [
            times(&shear_rotations[0], -geometry.length),
            times(&shear_rotations[1], -geometry.length),
            times(&shear_rotations[2], -geometry.length),
        ];
        let (by_first, moment) = first.load(torque[0], &shear_rotations[0]);
        let (by_last, other) = last.load(torque[1], &shear_rotations[1]);
        Force {
            e: [e[0], add(&e[1], &by_first), e[2], add(&e[3], &by_last)],
            moment: [moment, other],
            inner: [bubble, shear_rotations[2][0], shear_rotations[2][1]],
        }
    }
}
