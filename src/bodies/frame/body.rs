//! Rigid bodies of space as bodies.

use nalgebra::{DMatrix, Vector3};

use super::tangent::transformed;
use super::{
    Derivative, RigidBodyFrame, axis_rates, part_block, rotation_axes, rotation_block, rotation_of,
};
use crate::bodies::assembly::{Assembly, Links, NodeBlock, no_block};
use crate::bodies::body::{BodyPart, Momentum, NodalMotion};
use crate::bodies::connectivity::Node;
use crate::bodies::linearized::{LinearTerms, LinearizationPoint};
use crate::bodies::map::Rotations;
use crate::bodies::probe::NodeBlocks;
use crate::bodies::setup::NodeNumber;
use crate::math::jet::Number;
use crate::math::rotation::{Quaternion, axes, normalized};
use crate::math::space::{Vector, components, spin_matrix, vector};
use crate::math::sparse::Matrix;

/// Coordinates of both nodes where the body has not rotated.
pub(in crate::bodies) fn unplaced<const D: usize>([center, _]: &Node<D>) -> Node<D> {
    [*center, [0.0; D]]
}

impl<const D: usize> BodyPart<D> for RigidBodyFrame {
    fn mass(&self) -> f64 {
        self.mass
    }

    fn cost(&self) -> usize {
        1
    }

    fn add_links(&self, links: &mut Links) {
        links.mass.push((self.node, self.node));
    }

    fn unplace(&self, nodes: &mut [Node<D>]) {
        let at = unplaced(&nodes[self.node]);
        nodes[self.node..][..2].fill(at);
    }

    /// The second node has no coordinates, and the first has no rotation about an axis without inertia.
    fn add_fixed_numbers(&self, unplaced: &[Node<D>], fixed: &mut Vec<(NodeNumber, f64)>) {
        for (part, vector) in unplaced[self.node + 1].iter().enumerate() {
            let numbers = vector.iter().enumerate();
            fixed.extend(numbers.map(|(axis, value)| ((self.node + 1, part, axis), *value)));
        }
        let counted: Vec<usize> = rotation_axes::<D>()
            .filter(|(_, axis)| self.moments[*axis] > 0.0)
            .map(|(number, _)| number)
            .collect();
        let without = (0..D).filter(|number| !counted.contains(number));
        fixed.extend(without.map(|number| ((self.node, 1, number), 0.0)));
    }

    fn frame_count(&self) -> usize {
        1
    }

    fn place(&self, from: &[Quaternion], rotations: &mut Rotations, x: &mut [Node<D>]) {
        let turn = &mut rotations.rigid[self.index];
        turn.rotation = rotation_of(&x[self.node][1]);
        self.set_axes(&axes(&turn.quaternion(&from[self.index])), x);
    }

    fn place_rates(&self, x: &[Node<D>], rotations: &mut Rotations, v: &mut [Node<D>]) {
        let turn = &mut rotations.rigid[self.index];
        turn.rate = rotation_of(&v[self.node][1]);
        turn.spin = turn.spin_of(&turn.rate);
        self.set_axes(&axis_rates(&self.axes(x), &turn.spin), v);
    }

    fn place_changes<N: Number>(&self, x: &[Node<D, N>], dx: &mut [Node<D, N>]) {
        let turn = components(&dx[self.node][1].into()).into();
        self.set_axes(&axis_rates(&self.axes(x), &turn), dx);
    }

    /// `w x (w x e)` of each axis.
    fn add_centripetal<N: Number>(&self, motion: NodalMotion<'_, D, N>, a: &mut [Node<D, N>]) {
        let by_spin = axis_rates(&self.axes(motion.v), &self.spin(motion.x, motion.v));
        let sum = self.axes(a);
        self.set_axes(&std::array::from_fn(|k| sum[k] + by_spin[k]), a);
    }

    fn pull_back<N: Number>(
        &self,
        (x, v): (&[Node<D, N>], Option<&[Node<D, N>]>),
        f: &mut [Node<D, N>],
    ) {
        let mut moment = RigidBodyFrame::moment(&self.axes(x), &self.axes(f));
        if let Some(v) = v {
            moment += self.gyroscopic(&self.spin(x, v));
        }
        f[self.node][1] = vector::<D, N>(moment.into()).into();
        f[self.node + 1] = [[N::of(0.0); D]; 2];
    }

    fn convert(&self, order: Derivative, at: &Rotations, q: &mut [f64]) {
        let turn = &at.rigid[self.index];
        let mut spin = self.read(q);
        let converted = match order {
            Derivative::First => {
                self.complete(turn, &mut spin, false);
                turn.rate_of(&spin)
            }
            Derivative::Second => {
                self.complete(turn, &mut spin, true);
                turn.second_of(&spin)
            }
            Derivative::Back => turn.spin_of(&spin),
        };
        self.write(&converted, q);
    }

    fn rotation_in(&self, q: &[f64]) -> f64 {
        self.read(q).norm()
    }

    /// Frames become what they are, of unit length, and rates spins.
    fn renew(&self, frames: &mut [Quaternion], q: &mut [f64], v: &mut [f64]) {
        let mut turn = self.increment(q);
        turn.spin = turn.spin_of(&self.read(v));
        let from = &mut frames[self.index];
        *from = normalized(turn.quaternion(from));
        self.write(&Vector3::zeros(), q);
        self.write(&turn.spin, v);
    }

    fn for_each_geometric(
        &self,
        f: &[Node<D>],
        x: &[Node<D>],
        add: &mut impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let turned = self.geometric(f, x);
        let block = rotation_block(&((turned + turned.transpose()) * 0.5));
        add(self.node, self.node, &block);
    }

    fn add_mass(&self, assembly: &Assembly<D>, mass: &mut Matrix<f64>) {
        let mut block = no_block();
        for axis in 0..D {
            block[0][axis][0][axis] = self.mass;
        }
        for (number, axis) in rotation_axes::<D>() {
            block[1][number][1][number] = self.moments[axis];
        }
        assembly.add(self.node, self.node, &block, mass);
    }

    fn add_centrifugal(
        &self,
        rotation: [f64; 3],
        x: &[Node<D>],
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        let spin = spin_matrix::<D>(rotation);
        let axes = spin * spin;
        for (node, part, mass) in self.masses() {
            let block: NodeBlock<D> = part_block(part, |r, c| mass * axes[(r, c)]);
            let partial = self.partial(node != self.node, x);
            assembly.add(
                self.node,
                self.node,
                &transformed(&block, &partial, &partial),
                matrix,
            );
        }
    }

    fn add_inertia<N: Number>(&self, s: f64, a: &[Node<D, N>], f: &mut [Node<D, N>]) {
        for (node, part, mass) in self.masses() {
            for (f, a) in f[node][part].iter_mut().zip(&a[node][part]) {
                *f += N::of(s * mass) * *a;
            }
        }
    }

    fn add_weight(&self, gravity: &Vector<D>, f: &mut [Node<D>]) {
        f[self.node][0] = (gravity * self.mass).into();
    }

    fn add_quadratic<N: Number>(
        &self,
        x: &[Node<D, N>],
        map: &impl Fn(Vector<D, N>) -> Vector<D, N>,
        sum: &mut N,
    ) {
        for (node, part, mass) in self.masses() {
            *sum += map(x[node][part].into()).norm_squared() * N::of(mass);
        }
    }

    fn add_momentum<N: Number>(&self, motion: NodalMotion<'_, D, N>, sum: &mut Momentum<D, N>) {
        for (node, part, mass) in self.masses() {
            let [at, rate] = [motion.x, motion.v].map(|of| Vector::from(of[node][part]));
            let is_center = (node, part) == (self.node, 0);
            sum.add(at, rate * N::of(mass), is_center);
        }
    }

    fn add_center<N: Number>(
        &self,
        _drives: &[[N; 3]],
        x: &[Node<D, N>],
        sum: &mut Vector<D, N>,
    ) -> N {
        *sum += Vector::from(x[self.node][0]) * N::of(self.mass);
        N::of(0.0)
    }

    /// Geometric stiffness of forces on the axes, gyroscopic moments, and the Coriolis force in a frame that rotates. Small rotations are
    /// measured about axes fixed in the frame of the scene, those of the body at the instant. With the angular momentum `L = J w` the moment
    /// is `J p'' + (w J - J w - L) p'`; each vector stands for the matrix of its cross product.
    fn linearize(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        let mut none = |_: usize, _: usize, _: f64| {};
        let (node, (x, v)) = ((self.node, self.node), at.motion.pair());
        let spin = self.spin(x, v);
        let mut turned = self.geometric(at.forces, x);
        if spin == Vector3::zeros() {
            // At rest without the moment that speeds the body up, which is none in equilibrium.
            turned = (turned + turned.transpose()) * 0.5;
        }
        let block = rotation_block(&turned);
        (at.assembly).add_block(node, &block, &mut terms.stiffness, &mut none);
        if spin != Vector3::zeros() {
            (terms.is_damped, terms.is_symmetric) = (true, false);
            let gyroscopic = self.inertia_rate(&spin) - self.momentum(&spin).cross_matrix();
            let block = rotation_block(&gyroscopic);
            (at.assembly).add_block(node, &block, &mut terms.damping, &mut none);
        }
        if at.rotation != [0.0; 3] {
            self.linearize_coriolis(at, terms);
        }
    }
}

impl RigidBodyFrame {
    /// The Coriolis force in a frame of the scene that rotates.
    fn linearize_coriolis<const D: usize>(
        &self,
        at: &LinearizationPoint<'_, D>,
        terms: &mut LinearTerms,
    ) {
        let mut none = |_: usize, _: usize, _: f64| {};
        let coriolis = spin_matrix::<D>(at.rotation) * 2.0;
        let nodes = [self.node, self.node + 1];
        let mut whole = DMatrix::zeros(4 * D, 4 * D);
        for (node, part, mass) in self.masses() {
            let place = 2 * D * (node - nodes[0]) + D * part;
            whole
                .fixed_view_mut::<D, D>(place, place)
                .copy_from(&(coriolis * mass));
        }
        let by_rates = NodeBlocks::new(&nodes, whole);
        let mut blocks = NodeBlocks::new(&[self.node], DMatrix::zeros(2 * D, 2 * D));
        blocks.add_by_rates_of_axes(&by_rates, at.bodies, at.motion.pair());
        blocks.add(at.assembly, &mut terms.stiffness, &mut none);
        let by_rates = by_rates.pulled(at.bodies, at.motion.x);
        by_rates.add(at.assembly, &mut terms.damping, &mut none);
    }
}
