//! Forces and moments in a section of a cable, from the balance of its elements: exact where a joint reads
//! the same force, and of the order of the nodal forces (4) elsewhere, where the strain of the position field
//! gives order 2.
//!
//! What an element lacks for equilibrium (elastic and damping forces, loads, inertia) is what its neighbours
//! exert on its ends (report Eq. 14). From the first end on, section force `n` and moment `M` follow from
//! `n' = -p`, `M' = -r' x n - m`, `p` the load less the inertia and `m` the moment per reference length.
//!
//! Source: S. S. Antman, Nonlinear Problems of Elasticity, 2nd ed. (2005), section 4.1 (balance of a rod);
//! J. T. Oden, J. N. Reddy, An Introduction to the Mathematical Theory of Finite Elements (1976), on forces at nodes
//! from the balance of elements.

use nalgebra::Vector3;

use super::evaluation::Evaluation;
use crate::bodies::{LineChain, Marker};
use crate::elements::shape::{self, Values};
use crate::elements::{Element, Nodal};
use crate::math::jet::Number;
use crate::math::quadrature::{GAUSS_3, GAUSS_5, QuadraturePoint, integrals_to};
use crate::math::space::{Vector, components, frame_acceleration, moment, vector as vector_of};
use crate::system::System;
use crate::system::loads::{AppliedLoad, ForceElement as _};

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Force that the element before a node of a cable exerts on the one after it (report Eq. 14), N:
    /// what the one before lacks for equilibrium. Joints and point loads at the node count with what
    /// comes after. Zero at the first end.
    pub fn connectivity_force(&self, system: &System<D>, marker: &Marker) -> Vector<D, N> {
        if let Some(rod) = system.bodies.rod(marker.nodes[0]) {
            return self.rod_force(system, rod, marker);
        }
        let Some((chain, j, xi)) = system.bodies.element(marker) else {
            return Vector::zeros();
        };
        let element = if xi < 0.5 { j.wrapping_sub(1) } else { j };
        if element >= chain.elements().len() {
            return Vector::zeros();
        }
        self.lack(system, (chain, element)).0.column(2).into()
    }

    /// Axial force (N), the part of the section force along the tangent, and bending moment (N m, in the plane its third component) at a
    /// marker of a cable; zero elsewhere. At a node they are those just after what acts there, but at
    /// the last end.
    pub fn section(&self, system: &System<D>, marker: &Marker) -> (N, [N; 3]) {
        let (force, moment) = self.cut(system, marker);
        let tangent = marker.lift::<N>().direction(&self.x).normalize();
        (force.dot(&tangent), moment)
    }

    /// Force (N) and bending moment (N m) in a section, of the part after on the part before; the latter as of [`Self::section`].
    pub(super) fn cut(&self, system: &System<D>, marker: &Marker) -> (Vector<D, N>, [N; 3]) {
        if let Some(rod) = system.bodies.rod(marker.nodes[0]) {
            return self.rod_section(system, rod, marker);
        }
        let Some((chain, j, xi)) = system.bodies.element_after(marker) else {
            return (Vector::zeros(), [N::of(0.0); 3]);
        };
        let (part, e) = (&chain.elements()[j], chain.element(j, &self.x));
        let (lack, torques) = self.lack(system, (chain, j));
        let column = |k: usize| -> Vector<D, N> { lack.column(k).into() };
        let slope = |xi: f64| -> Vector<D, N> { e * shape::slopes(N::of(xi), part.length()) };
        let bends = part.bends();
        let bending = |m: Vector3<N>| if bends { m } else { Vector3::zeros() };
        // At the ends: what the neighbours exert.
        let first = Vector3::from(moment(&slope(0.0), &column(1))) + torques[0];
        let last = -Vector3::from(moment(&slope(1.0), &column(3))) - torques[1];
        if xi == 1.0 {
            return (-column(2), bending(last).into());
        }
        let (force, turned) = self.integrated(system, (chain, j), column(0), xi);
        // The mass matrix counts quadratic and cubic parts of the motion more than the integral of their
        // products: the balance of moments over the element misses that much, spread evenly.
        let (_, whole) = self.integrated(system, (chain, j), column(0), 1.0);
        let missing = last - first + whole;
        let moment = bending(first - turned + missing * N::of(xi));
        (force, moment.into())
    }

    /// Torque about the tangent at a marker of a rod, N m; zero elsewhere.
    pub fn torque(&self, system: &System<D>, marker: &Marker) -> N {
        let moment = Vector3::from(self.section(system, marker).1);
        let tangent = marker.lift::<N>().direction(&self.x);
        Vector3::from(components(&tangent)).dot(&moment)
    }

    /// Section force at `xi` inside an element from that at its first end, and the integral of `r' x n + m` up
    /// to there.
    fn integrated(
        &self,
        system: &System<D>,
        (chain, j): (&LineChain<D>, usize),
        first: Vector<D, N>,
        xi: f64,
    ) -> (Vector<D, N>, Vector3<N>) {
        let part = &chain.elements()[j];
        let l = part.length();
        let (e, inertia) = (chain.element(j, &self.x), self.inertia(system, (chain, j)));
        let load = self.distributed(system, chain.first_node());
        let changing = self.changing(system, (chain.first_node(), j));
        let longer = N::of(1.0) / chain.length_now(&self.drives).by;
        let force = |xi: f64| {
            let (weight, moved) = (part.weight_before(xi), part.moved_before(xi));
            let gravity = system.gravity * (weight[0] + weight[2]);
            let mut force = first - load * N::of(xi * l)
                + (inertia * moved.map(N::of) - gravity.map(N::of)) * longer;
            if let Some(values) = &changing {
                force -= integral(values, xi) * N::of(l);
            }
            force
        };
        // Gauss's rule is exact to degree 5; the part of degree 6 is of that order in the length. Loads that change along the
        // element ask for degree 7.
        let rule: &[QuadraturePoint] = match changing {
            Some(_) => &GAUSS_5,
            None => &GAUSS_3,
        };
        let mut turned = match self.moments(system, (chain, j)) {
            Some(moments) => integral(&moments, xi) * N::of(l),
            None => Vector3::zeros(),
        };
        for point in rule {
            let at = point.at * xi;
            let slope: Vector<D, N> = e * shape::slopes(N::of(at), l);
            turned += Vector3::from(moment(&slope, &force(at))) * N::of(point.weight * xi * l);
        }
        (force(xi), turned)
    }

    /// Returns the force residual of an element on its coordinates, N and N m: elastic forces, damping forces and loads
    /// minus inertia forces. The second part holds the moments on the sections at both ends of a rod or beam element, N
    /// m. The neighbours exert the opposite.
    pub(super) fn lack(
        &self,
        system: &System<D>,
        (chain, j): (&LineChain<D>, usize),
    ) -> (Nodal<D, N>, [Vector3<N>; 2]) {
        let part = &chain.elements()[j];
        let now = chain.length_now(&self.drives);
        let (mut lack, _) = chain.force_of(j, (&self.x, &self.v), now.scaling());
        let weight = (system.gravity * part.weight().transpose()).map(N::of);
        lack += (weight - self.inertia(system, (chain, j)) * part.mass().map(N::of)) / now.by;
        let weights = shape::integrals(N::of(1.0), part.length());
        lack += self.distributed(system, chain.first_node()) * weights.transpose();
        if let Some(values) = self.changing(system, (chain.first_node(), j)) {
            lack += shape::on_coordinates(&values, part.length());
        }
        let mut torques = [Vector3::zeros(); 2];
        if let Some(sections) = system.bodies.sections(chain) {
            let motion = [&self.x[..], &self.v[..], &self.acceleration[..]];
            let mut force = sections.lack(j, motion, system.rotation);
            if let Some(moments) = self.moments(system, (chain, j)) {
                force.add(&sections.loaded(j, &self.x, &moments.map(Into::into)));
            }
            torques = sections.global(j, force.moment, &self.x);
            for (k, vector) in force.e.into_iter().enumerate() {
                let sum: Vector<D, N> = vector_of(vector);
                lack.column_mut(k)
                    .iter_mut()
                    .zip(&sum)
                    .for_each(|(l, f)| *l += *f);
            }
        }
        (lack, torques)
    }

    /// Absolute accelerations of the coordinates of an element, in the axes of the frame, m/s^2.
    fn inertia(&self, system: &System<D>, (chain, j): (&LineChain<D>, usize)) -> Nodal<D, N> {
        let (e, v) = (chain.element(j, &self.x), chain.element(j, &self.v));
        let rate = system.rotation;
        let of = |k: usize| frame_acceleration(rate, e.column(k).into(), v.column(k).into());
        chain.element(j, &self.acceleration) + Nodal::from_columns(&[0, 1, 2, 3].map(of))
    }

    /// Sum of what distributed loads on the body with this first node are everywhere, N/m.
    pub(super) fn distributed(&self, system: &System<D>, first: usize) -> Vector<D, N> {
        let at = self.instant(system);
        let mut sum = Vector::zeros();
        for load in &system.loads {
            if let AppliedLoad::DistributedForce(load) = load
                && load.on.first_node(&system.bodies) == first
            {
                sum += load.uniform(at);
            }
        }
        sum
    }

    /// Sum of what of them changes along the body, and of what fluids do, at the Gauss points of a segment, N/m; none where nothing does.
    pub(super) fn changing(
        &self,
        system: &System<D>,
        (first, segment): (usize, usize),
    ) -> Option<Values<D, N>> {
        let at = self.instant(system);
        let mut sum: Option<Values<D, N>> = None;
        for load in &system.loads {
            let Some(values) = load.changing(at, first, segment) else {
                continue;
            };
            let sum = sum.get_or_insert([Vector::zeros(); GAUSS_5.len()]);
            sum.iter_mut()
                .zip(values)
                .for_each(|(sum, value)| *sum += value);
        }
        sum
    }

    /// Sum of the moments distributed along the rod or beam on a line, at the Gauss points of an element, N m/m; none where there are none.
    fn moments(
        &self,
        system: &System<D>,
        (chain, j): (&LineChain<D>, usize),
    ) -> Option<Values<3, N>> {
        let (at, first) = (self.instant(system), chain.first_node());
        let mut sum: Option<Values<3, N>> = None;
        for load in &system.loads {
            let Some(moments) = load.changing_moments(at, first, j) else {
                continue;
            };
            let sum = sum.get_or_insert([Vector3::zeros(); GAUSS_5.len()]);
            let moments = moments.map(Vector3::from);
            sum.iter_mut().zip(moments).for_each(|(sum, m)| *sum += m);
        }
        sum
    }
}

/// The integral up to a place in [0, 1] of what has these values at the Gauss points.
pub(super) fn integral<const K: usize, N: Number>(values: &Values<K, N>, xi: f64) -> Vector<K, N> {
    let terms = values.iter().zip(integrals_to(xi));
    terms.fold(Vector::zeros(), |sum, (value, weight)| {
        sum + value * N::of(weight)
    })
}
