//! Forces and moments in a section of a rod, from the balance of a part of it: what acts there less its inertia
//! (d'Alembert), exact for a rigid body. What is spread along it and its inertia are linear in the place.
//!
//! Source: S. S. Antman, Nonlinear Problems of Elasticity, 2nd ed. (2005), section 4.1 (balance of a rod).

use nalgebra::Vector3;

use super::evaluation::Evaluation;
use super::section::integral;
use crate::bodies::{Marker, PANELS, RigidRod};
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::{Vector, frame_acceleration, moment};
use crate::system::System;
use crate::system::end::Attachment;
use crate::system::loads::ForceElement as _;

/// Part of the length of a rod within which what acts is at one place.
const ROUNDOFF: f64 = 1e-9;

/// A part of a rod; places are counted from its middle, m.
#[derive(Clone, Copy)]
struct RodPart {
    /// Where it begins and ends.
    ends: [f64; 2],
    /// Between which places what acts at a point acts on it.
    acts: [f64; 2],
}

/// A marker of a rod.
struct RodSection {
    /// Position along the rod, m from the middle.
    at: f64,
    /// Half the length, m.
    half: f64,
    /// Distance that counts as roundoff, m.
    near: f64,
}

impl RodSection {
    fn new(rod: &RigidRod, marker: &Marker) -> Self {
        Self {
            at: marker.offset(),
            half: 0.5 * rod.length,
            near: ROUNDOFF * rod.length,
        }
    }
}

/// Forces on position and direction of an end.
type Forces<const D: usize, N> = [Vector<D, N>; 2];

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Force that the part of a rod before a marker exerts on the part after it, N. What acts at the marker counts with
    /// what comes after.
    pub(super) fn rod_force(
        &self,
        system: &System<D>,
        rod: &RigidRod,
        marker: &Marker,
    ) -> Vector<D, N> {
        let RodSection { at, half, near } = RodSection::new(rod, marker);
        let before = RodPart {
            ends: [-half, at],
            acts: [f64::NEG_INFINITY, at - near],
        };
        self.on_part(system, rod, before).0
    }

    /// Force (N) and bending moment (N m) in the section at a marker of a rod, just after what acts there, but at the last end.
    pub(super) fn rod_section(
        &self,
        system: &System<D>,
        rod: &RigidRod,
        marker: &Marker,
    ) -> (Vector<D, N>, [N; 3]) {
        let RodSection { at, half, near } = RodSection::new(rod, marker);
        let is_last = at > half - near;
        let after = RodPart {
            ends: [at, half],
            acts: [if is_last { at - near } else { at + near }, f64::INFINITY],
        };
        let (force, moment) = self.on_part(system, rod, after);
        (force, moment.into())
    }

    /// Force, N, and moment about where it begins, N m, on a part of a rod, less its inertia.
    fn on_part(
        &self,
        system: &System<D>,
        rod: &RigidRod,
        part: RodPart,
    ) -> (Vector<D, N>, Vector3<N>) {
        let along = self.along(rod);
        let (mut force, mut turning) = self.spread(system, rod, part.ends);
        let [first, last] = part.acts;
        let is_on = |marker: &Marker| marker.nodes[0] == rod.node;
        let is_its_own = |mass: usize| mass == rod.mass;
        self.each_force(system, (is_on, is_its_own), |end, [position, direction]| {
            if let Attachment::Body(marker) = end
                && marker.nodes[0] == rod.node
                && (first..last).contains(&marker.offset().plain())
            {
                let arm = along * (marker.offset() - N::of(part.ends[0]));
                force += position;
                turning += Vector3::from(moment(&arm, &position));
                turning += Vector3::from(moment(&along, &direction));
            }
        });
        (force, turning)
    }

    /// Direction of a rod.
    fn along(&self, rod: &RigidRod) -> Vector<D, N> {
        self.x[rod.node][1].into()
    }

    /// Integrates weight and distributed loads minus inertia over a part of a rod. Returns the force and the moment
    /// about the first place.
    fn spread(
        &self,
        system: &System<D>,
        rod: &RigidRod,
        [from, to]: [f64; 2],
    ) -> (Vector<D, N>, Vector3<N>) {
        let own = &system.bodies.masses()[rod.mass];
        let [density, moved] = [own.mass, own.moved()].map(|mass| N::of(mass / rod.length));
        let at = Marker::rigid(0, rod.node, [from, 0.0]).lift();
        let [start, slope] = self.inertia_at(system, &at).map(|inertia| -inertia * moved);
        let load = system.gravity.map(N::of) * density + self.distributed(system, rod.node) + start;
        // Integrals of 1, s and s^2 over the part.
        let length = to - from;
        let [zero, first, second] = [1, 2, 3].map(|n| N::of(length.powi(n) / f64::from(n)));
        let [more, turning_more] = self.changing_spread(system, rod, [from, to]);
        let force = load * zero + slope * first + more;
        let turning = load * first + slope * second + turning_more;
        (force, moment(&self.along(rod), &turning).into())
    }

    /// Integrates the varying loads over a part of a rod. Returns the force, and the integral of force times distance
    /// from the first place.
    fn changing_spread(
        &self,
        system: &System<D>,
        rod: &RigidRod,
        [from, to]: [f64; 2],
    ) -> [Vector<D, N>; 2] {
        let [mut force, mut turning] = [Vector::zeros(); 2];
        let part = rod.length / PANELS as f64;
        for panel in 0..PANELS {
            let start = panel as f64 * part - 0.5 * rod.length;
            let [a, b] = [from, to].map(|place| ((place - start) / part).clamp(0.0, 1.0));
            if a == b {
                continue;
            }
            let Some(values) = self.changing(system, (rod.node, panel)) else {
                break;
            };
            let before = integral(&values, a);
            let up_to = |xi: f64| (integral(&values, xi) - before) * N::of(part);
            let whole = up_to(b);
            force += whole;
            // The way to the end of the panel less what is left of it after every place, by parts.
            turning += whole * N::of(start + b * part - from);
            for point in GAUSS_5 {
                let weight = point.weight * (b - a) * part;
                turning -= up_to(a + point.at * (b - a)) * N::of(weight);
            }
        }
        [force, turning]
    }

    /// Absolute accelerations of position and direction of a marker, in the axes of the frame.
    fn inertia_at(&self, system: &System<D>, marker: &Marker<N>) -> Forces<D, N> {
        let absolute = |[x, v, a]: [Vector<D, N>; 3]| a + frame_acceleration(system.rotation, x, v);
        let orders = [&self.x, &self.v, &self.acceleration];
        [
            absolute(orders.map(|order| marker.position(order))),
            absolute(orders.map(|order| marker.direction(order))),
        ]
    }

    /// Calls with everything that acts at points where markers are, among others: loads, joints, and masses, but one of a body's own, with
    /// their weight less their inertia.
    pub(super) fn each_force(
        &self,
        system: &System<D>,
        (is_on, is_own): (impl Fn(&Marker) -> bool, impl Fn(usize) -> bool),
        mut call: impl FnMut(&Attachment<D, N>, Forces<D, N>),
    ) {
        for (index, lump) in system.bodies.masses().iter().enumerate() {
            if !is_own(index) && is_on(&lump.marker) {
                let marker = lump.marker.lift();
                let [position, direction] = self.inertia_at(system, &marker);
                let weight = system.gravity.map(N::of) * N::of(lump.mass);
                let force = weight - position * N::of(lump.moved());
                call(
                    &Attachment::Body(marker),
                    [force, -direction * N::of(lump.inertia)],
                );
            }
        }
        let at = self.instant(system);
        for load in &system.loads {
            load.act(at, &mut call);
        }
        for (row, linear) in system.linear.iter().enumerate() {
            let Some(joint) = linear.joint.map(|joint| &system.joints[joint]) else {
                continue;
            };
            if !joint.ends.iter().filter_map(Attachment::marker).any(&is_on) {
                continue;
            }
            let lambda = system.row_multiplier(row, |node| self.linear_constraint_forces[node]);
            for (end, on) in joint.ends.iter().zip(&linear.on_ends) {
                call(&end.lift(), on.map(|on| on.map(N::of) * lambda));
            }
        }
        let view = self.view(system);
        for (constraint, lambda) in system.constraints.iter().zip(&self.lambda) {
            constraint.for_each_pair(&view, |pair| {
                for (end, on) in &pair.ends {
                    call(end, on.map(|on| -on * *lambda));
                }
            });
        }
    }
}
