//! Forces and moments in a section of a cable, from the balance of its elements: exact where a joint reads
//! the same force, and of the order of the nodal forces (4) elsewhere, where the strain of the position field
//! gives order 2.
//!
//! What an element lacks for equilibrium (elastic and damping forces, loads, inertia) is what its neighbours
//! exert on its ends (report Eq. 14). From the first end on, section force `n` and moment `M` follow from
//! `n' = -p`, `M' = -r' x n`, `p` the load less the inertia per reference length.
//!
//! Source: S. S. Antman, Nonlinear Problems of Elasticity, 2nd ed. (2005), section 4.1 (balance of a rod);
//! J. T. Oden, J. N. Reddy, An Introduction to the Mathematical Theory of Finite Elements (1976), on forces at nodes
//! from the balance of elements.

use nalgebra::Vector3;

use super::evaluation::Evaluation;
use crate::body::Marker;
use crate::elements::{Element, Nodal, shape};
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_3;
use crate::math::space::{Vector, carried, components, moment, vector as vector_of};
use crate::system::loads::Load;
use crate::system::{CableChain, System};

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Force that the element before a node of a cable exerts on the one after it (report Eq. 14), N:
    /// what the one before lacks for equilibrium. Joints and point loads at the node count with what
    /// comes after. Zero at the first end.
    pub fn connectivity_force(&self, system: &System<D>, marker: &Marker) -> Vector<D, N> {
        if let Some(rod) = system.rod(marker) {
            return self.rod_force(system, rod, marker);
        }
        let Some((chain, j, xi)) = system.element(marker) else {
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
        if let Some(rod) = system.rod(marker) {
            return self.rod_section(system, rod, marker);
        }
        let Some((chain, j, xi)) = system.element_after(marker) else {
            return (N::of(0.0), [N::of(0.0); 3]);
        };
        let (part, e) = (&chain.elements()[j], chain.element(j, &self.x));
        let (lack, torques) = self.lack(system, (chain, j));
        let column = |k: usize| -> Vector<D, N> { lack.column(k).into() };
        let slope = |xi: f64| -> Vector<D, N> { e * shape::slopes(N::of(xi), part.length()) };
        let tangent = slope(xi).normalize();
        let bends = part.bends();
        let bending = |m: Vector3<N>| if bends { m } else { Vector3::zeros() };
        // At the ends: what the neighbours exert.
        let first = Vector3::from(moment(&slope(0.0), &column(1))) + torques[0];
        let last = -Vector3::from(moment(&slope(1.0), &column(3))) - torques[1];
        if xi == 1.0 {
            return (-column(2).dot(&tangent), bending(last).into());
        }
        let (force, turned) = self.integrated(system, (chain, j), column(0), xi);
        // The mass matrix counts quadratic and cubic parts of the motion more than the integral of their
        // products: the balance of moments over the element misses that much, spread evenly.
        let (_, whole) = self.integrated(system, (chain, j), column(0), 1.0);
        let missing = last - first + whole;
        let moment = bending(first - turned + missing * N::of(xi));
        (force.dot(&tangent), moment.into())
    }

    /// Torque about the tangent at a marker of a rod, N m; zero elsewhere.
    pub fn torque(&self, system: &System<D>, marker: &Marker) -> N {
        let moment = Vector3::from(self.section(system, marker).1);
        let tangent = marker.lift::<N>().direction(&self.x);
        Vector3::from(components(&tangent)).dot(&moment)
    }

    /// Section force at `xi` inside an element from that at its first end, and the integral of `r' x n` up
    /// to there.
    fn integrated(
        &self,
        system: &System<D>,
        (chain, j): (&CableChain<D>, usize),
        first: Vector<D, N>,
        xi: f64,
    ) -> (Vector<D, N>, Vector3<N>) {
        let part = &chain.elements()[j];
        let l = part.length();
        let (e, inertia) = (chain.element(j, &self.x), self.inertia(system, (chain, j)));
        let load = self.distributed(system, chain.nodes(0)[0]);
        let force = |xi: f64| {
            let weight = part.weight_before(xi);
            let gravity = system.gravity * (weight[0] + weight[2]);
            first - load * N::of(xi * l) - gravity.map(N::of) + inertia * weight.map(N::of)
        };
        // Gauss's rule is exact to degree 5; the part of degree 6 is of that order in the length.
        let mut turned = Vector3::zeros();
        for point in GAUSS_3 {
            let at = point.at * xi;
            let slope: Vector<D, N> = e * shape::slopes(N::of(at), l);
            turned += Vector3::from(moment(&slope, &force(at))) * N::of(point.weight * xi * l);
        }
        (force(xi), turned)
    }

    /// What an element lacks for equilibrium, on its coordinates: elastic and damping forces and loads less
    /// inertia, N and N m; and the moments on the sections at the ends of an element of a rod or beam, N m. Its neighbours exert the opposite.
    fn lack(
        &self,
        system: &System<D>,
        (chain, j): (&CableChain<D>, usize),
    ) -> (Nodal<D, N>, [Vector3<N>; 2]) {
        let (e, v) = (chain.element(j, &self.x), chain.element(j, &self.v));
        let part = &chain.elements()[j];
        let mut lack: Nodal<D, N> = part.force(&e, &v);
        lack += (system.gravity * part.weight().transpose()).map(N::of);
        lack -= self.inertia(system, (chain, j)) * part.mass().map(N::of);
        let weights = shape::integrals(N::of(1.0), part.length());
        lack += self.distributed(system, chain.nodes(0)[0]) * weights.transpose();
        let mut torques = [Vector3::zeros(); 2];
        if let Some(sections) = system.sections(chain) {
            let motion = [&self.x[..], &self.v[..], &self.acceleration[..]];
            let force = sections.lack(j, motion, &system.frames);
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
    fn inertia(&self, system: &System<D>, (chain, j): (&CableChain<D>, usize)) -> Nodal<D, N> {
        let (e, v) = (chain.element(j, &self.x), chain.element(j, &self.v));
        let rate = system.rotation;
        let of = |k: usize| carried(rate, e.column(k).into(), v.column(k).into());
        chain.element(j, &self.acceleration) + Nodal::from_columns(&[0, 1, 2, 3].map(of))
    }

    /// Sum of the distributed loads on the body with this first node, N/m.
    pub(super) fn distributed(&self, system: &System<D>, first: usize) -> Vector<D, N> {
        let at = self.instant(system);
        let mut sum = Vector::zeros();
        for load in &system.loads {
            if let Load::Distributed(load) = load
                && load.first_node(&system.chains) == first
            {
                sum += load.value(at);
            }
        }
        sum
    }
}
