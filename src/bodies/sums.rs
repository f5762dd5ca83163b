//! Energies, momenta and centre of mass of all bodies.

use nalgebra::Vector3;

use super::connectivity::Node;
use super::frame::{RigidBodyFrame, combined};
use super::{Bodies, LineChain};
use crate::elements::{Element, Nodal};
use crate::math::jet::Number;
use crate::math::space::{Vector, moment, spun};

impl<const D: usize> Bodies<D> {
    /// Kinetic energy at coordinates `x` and rates `v`, J.
    pub fn kinetic<N: Number>(
        &self,
        drives: &[[N; 3]],
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
    ) -> N {
        let spins = self.rod_chains.iter();
        let spins = spins.map(|chain| chain.spin_energy((x, v), &self.frames));
        let paid_out = self.winches();
        let paid_out =
            paid_out.map(|(chain, winch)| winch.kinetic(chain, (x, v), &winch.now(drives)));
        let others = spins.chain(paid_out);
        others.fold(self.quadratic(v, |v| v), |sum, energy| sum + energy)
    }

    /// Energy of the centrifugal force in a frame that rotates (rad/s), with the other sign, J: that of the velocities `W x r` and of spins.
    pub fn centrifugal<N: Number>(&self, rotation: [f64; 3], x: &[Node<D, N>]) -> N {
        let spins = self.rod_chains.iter();
        let spins = spins.map(|chain| chain.turning_energy(x, rotation, &self.frames));
        spins.fold(self.quadratic(x, |v| spun(rotation, v)), |sum, energy| {
            sum + energy
        })
    }

    /// `x^T M x / 2` of vectors that are mapped one by one; without cables that are paid out.
    fn quadratic<N: Number>(
        &self,
        x: &[Node<D, N>],
        map: impl Fn(Vector<D, N>) -> Vector<D, N>,
    ) -> N {
        let mut sum = N::of(0.0);
        let chains = self.chains.iter();
        for chain in chains.filter(|chain| chain.winch().is_none()) {
            for (j, element) in chain.elements().iter().enumerate() {
                let e: Nodal<D, N> = chain.element(j, x);
                let e = Nodal::from_columns(&[0, 1, 2, 3].map(|k| map(e.column(k).into())));
                sum += (e * element.mass().map(N::of)).dot(&e);
            }
        }
        for lump in &self.lumped_masses {
            let marker = lump.marker.lift();
            let (at, on) = (map(marker.position(x)), map(marker.direction(x)));
            sum +=
                at.norm_squared() * N::of(lump.moved()) + on.norm_squared() * N::of(lump.inertia);
        }
        for (node, part, mass) in self.frames.list().iter().flat_map(RigidBodyFrame::masses) {
            sum += map(x[node][part].into()).norm_squared() * N::of(mass);
        }
        N::of(0.5) * sum
    }

    /// Strain energy, J.
    pub fn strain_energy<N: Number>(&self, drives: &[[N; 3]], x: &[Node<D, N>]) -> N {
        let lines = self.chains.iter();
        let lines = lines.map(|chain| chain.strain_energy(x, chain.length_now(drives).by));
        let energies = lines.chain((self.rod_chains.iter()).map(|chain| chain.strain_energy(x)));
        energies.fold(N::of(0.0), |sum, energy| sum + energy)
    }

    /// Calls with strain energies, J, of every element at two configurations of cables at their reference length.
    pub fn for_each_strain_energy(&self, x: [&[Node<D>]; 2], mut call: impl FnMut([f64; 2])) {
        for chain in &self.chains {
            for (j, element) in chain.elements().iter().enumerate() {
                call(x.map(|x| element.energy(&chain.element(j, x))));
            }
        }
        for chain in &self.rod_chains {
            for j in 0..chain.count() {
                call(x.map(|x| chain.element(j).energy(&chain.at(j, x))));
            }
        }
    }

    /// Power that damping in bodies dissipates, W.
    pub fn dissipation<N: Number>(
        &self,
        drives: &[[N; 3]],
        motion: (&[Node<D, N>], &[Node<D, N>]),
    ) -> N {
        let lines = self.chains.iter().map(|chain| {
            let longer = chain.length_now(drives).longer();
            chain.dissipation(motion, longer)
        });
        let sections = self.rod_chains.iter();
        let sections = sections.map(|chain| chain.dissipation(motion, &self.frames));
        lines
            .chain(sections)
            .fold(N::of(0.0), |sum, power| sum + power)
    }

    /// Returns the work of gravity (m/s^2) on what cables on winches have more of than their reference, J.
    pub fn fall_of_paid_out<N: Number>(
        &self,
        gravity: Vector<D>,
        drives: &[[N; 3]],
        x: &[Node<D, N>],
    ) -> N {
        self.winches().fold(N::of(0.0), |fall, (chain, winch)| {
            let more = N::of(1.0) / winch.now(drives).by - N::of(1.0);
            let sum = sum_of(chain, x);
            fall + sum.dot(&gravity.map(N::of)) * more
        })
    }

    /// Momentum (kg m/s) and angular momentum about the origin (kg m^2/s), in the plane its third component.
    pub fn momentum<N: Number>(
        &self,
        drives: &[[N; 3]],
        motion @ (x, v): (&[Node<D, N>], &[Node<D, N>]),
    ) -> (Vector<D, N>, [N; 3]) {
        let (mut linear, mut angular) = (Vector::zeros(), Vector3::zeros());
        let mut add = |at: Vector<D, N>, p: Vector<D, N>, translates: bool| {
            if translates {
                linear += p;
            }
            angular += Vector3::from(moment(&at, &p));
        };
        for chain in &self.chains {
            let paid_out = chain.winch().map(|winch| (winch, winch.now(drives)));
            for (j, element) in chain.elements().iter().enumerate() {
                let at: Nodal<D, N> = chain.element(j, x);
                let mut p = chain.element(j, v) * element.mass().map(N::of);
                if let Some((winch, now)) = &paid_out {
                    p = p / now.by + winch.passing_momentum(chain, j, x, now);
                }
                for k in 0..4 {
                    add(at.column(k).into(), p.column(k).into(), k % 2 == 0);
                }
            }
        }
        for lump in &self.lumped_masses {
            let marker = lump.marker.lift();
            let (m, j) = (N::of(lump.moved()), N::of(lump.inertia));
            let (at, d) = (marker.position(x), marker.direction(x));
            let (p, s) = (marker.position(v) * m, marker.direction(v) * j);
            add(at, p, true);
            add(d, s, false);
        }
        for frame in self.frames.list() {
            for (node, part, mass) in frame.masses() {
                let [at, rate] = [x, v].map(|of| Vector::from(of[node][part]));
                let is_center = (node, part) == (frame.node, 0);
                add(at, rate * N::of(mass), is_center);
            }
        }
        for chain in &self.rod_chains {
            chain.for_each_momentum(motion, &self.frames, |frame, momentum| {
                angular += combined(&frame.axes(x), &momentum.into());
            });
            if D == 2 {
                angular[2] += chain.planar_momentum(motion, &self.frames);
            }
        }
        (linear, angular.into())
    }

    /// Center of mass, m.
    pub fn center_of_mass<N: Number>(&self, drives: &[[N; 3]], x: &[Node<D, N>]) -> Vector<D, N> {
        let (mut sum, mut mass) = (Vector::zeros(), N::of(self.mass()));
        for chain in &self.chains {
            let longer = N::of(1.0) / chain.length_now(drives).by;
            sum += sum_of(chain, x) * longer;
            mass += (longer - N::of(1.0)) * N::of(chain.mass());
        }
        for lump in &self.lumped_masses {
            sum += lump.marker.lift().position(x) * N::of(lump.mass);
        }
        for frame in self.frames.list() {
            sum += Vector::from(x[frame.node][0]) * N::of(frame.mass);
        }
        sum / mass
    }
}

/// Sum of the positions of a chain of its reference length, each times its mass, kg m.
fn sum_of<const D: usize, N: Number>(chain: &LineChain<D>, x: &[Node<D, N>]) -> Vector<D, N> {
    let mut sum = Vector::zeros();
    for (j, element) in chain.elements().iter().enumerate() {
        sum += chain.element(j, x) * element.weight().map(N::of);
    }
    sum
}
