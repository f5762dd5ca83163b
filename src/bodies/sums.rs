//! Energies, momenta and centre of mass of all bodies.

use nalgebra::Vector3;

use super::body::{BodyPart, Momentum, NodalMotion, each};
use super::connectivity::Node;
use super::{Bodies, LineChain};
use crate::elements::Element as _;
use crate::math::jet::Number;
use crate::math::space::{Vector, moment, spun};

impl<const D: usize, N: Number> Momentum<D, N> {
    /// Adds a momentum at a place. Whether it `translates`: the momentum of a direction has a moment alone.
    pub fn add(&mut self, at: Vector<D, N>, p: Vector<D, N>, translates: bool) {
        if translates {
            self.linear += p;
        }
        self.angular += Vector3::from(moment(&at, &p));
    }
}

impl<const D: usize> Bodies<D> {
    /// Kinetic energy, J.
    pub fn kinetic<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> N {
        let mut energy = self.quadratic(motion.v, |v| v);
        each!(self, |body| energy +=
            BodyPart::kinetic_beside(body, motion));
        energy
    }

    /// Energy of the centrifugal force in a frame that rotates (rad/s), with the other sign, J: that of the velocities `W x r` and of spins.
    pub fn centrifugal<N: Number>(&self, rotation: [f64; 3], x: &[Node<D, N>]) -> N {
        let mut energy = self.quadratic(x, |v| spun(rotation, v));
        each!(self, |body| energy +=
            BodyPart::frame_spin_energy(body, x, rotation));
        energy
    }

    /// `x^T M x / 2` of vectors that are mapped one by one; without cables that are paid out.
    fn quadratic<N: Number>(
        &self,
        x: &[Node<D, N>],
        map: impl Fn(Vector<D, N>) -> Vector<D, N>,
    ) -> N {
        let mut sum = N::of(0.0);
        each!(self, |body| BodyPart::add_quadratic(
            body, x, &map, &mut sum
        ));
        N::of(0.5) * sum
    }

    /// Strain energy, J.
    pub fn strain_energy<N: Number>(&self, drives: &[[N; 3]], x: &[Node<D, N>]) -> N {
        let mut energy = N::of(0.0);
        each!(self, |body| energy +=
            BodyPart::strain_energy(body, drives, x));
        energy
    }

    /// Calls with strain energies, J, of every element at two configurations of cables at their reference length.
    pub fn for_each_strain_energy(&self, x: [&[Node<D>]; 2], mut call: impl FnMut([f64; 2])) {
        each!(self, |body| BodyPart::for_each_strain_energy(
            body, x, &mut call
        ));
    }

    /// Power that damping in bodies dissipates, W.
    pub fn dissipation<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> N {
        let mut power = N::of(0.0);
        each!(self, |body| power += BodyPart::dissipation(body, motion));
        power
    }

    /// Returns the work of gravity (m/s^2) on what cables on winches have more of than their reference, J.
    pub fn fall_of_paid_out<N: Number>(
        &self,
        gravity: Vector<D>,
        drives: &[[N; 3]],
        x: &[Node<D, N>],
    ) -> N {
        self.winches().fold(N::of(0.0), |fall, (line, winch)| {
            let more = N::of(1.0) / winch.now(drives).by - N::of(1.0);
            let sum = line.weighted_positions(x);
            fall + sum.dot(&gravity.map(N::of)) * more
        })
    }

    /// Momentum (kg m/s) and angular momentum about the origin (kg m^2/s), in the plane its third component.
    pub fn momentum<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> (Vector<D, N>, [N; 3]) {
        let mut sum = Momentum {
            linear: Vector::zeros(),
            angular: Vector3::zeros(),
        };
        each!(self, |body| BodyPart::add_momentum(body, motion, &mut sum));
        (sum.linear, sum.angular.into())
    }

    /// Center of mass, m.
    pub fn center_of_mass<N: Number>(&self, drives: &[[N; 3]], x: &[Node<D, N>]) -> Vector<D, N> {
        let (mut sum, mut mass) = (Vector::zeros(), N::of(self.mass()));
        each!(self, |body| mass +=
            BodyPart::add_center(body, drives, x, &mut sum));
        sum / mass
    }
}

impl<const D: usize> LineChain<D> {
    /// Sum of the positions of a line of its reference length, each times its mass, kg m.
    pub(super) fn weighted_positions<N: Number>(&self, x: &[Node<D, N>]) -> Vector<D, N> {
        let mut sum = Vector::zeros();
        for (j, element) in self.elements().iter().enumerate() {
            sum += self.element(j, x) * element.weight().map(N::of);
        }
        sum
    }
}
