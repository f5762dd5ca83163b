//! Reduced bodies as bodies.

use nalgebra::Vector3;

use super::ReducedBody;
use crate::bodies::assembly::{Assembly, Links, NodeBlock, no_block};
use crate::bodies::body::{BodyPart, Momentum, NodalMotion};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{Derivative, combined, completed, part_block, unplaced};
use crate::bodies::linearized::{LinearTerms, LinearizationPoint};
use crate::bodies::map::Rotations;
use crate::bodies::setup::NodeNumber;
use crate::bodies::stages::RotatingNodes;
use crate::math::jet::Number;
use crate::math::rotation::Quaternion;
use crate::math::space::{Vector, spin_matrix};
use crate::math::sparse::Matrix;

impl<const D: usize> BodyPart<D> for ReducedBody {
    fn mass(&self) -> f64 {
        self.model.mass
    }

    /// Products of all pairs of modes take most of the time.
    fn cost(&self) -> usize {
        1 + self.model.modes() * self.model.modes() / 16
    }

    fn is_damped(&self) -> bool {
        self.damping.iter().any(|damping| *damping != 0.0)
    }

    fn add_links(&self, links: &mut Links) {
        let acted: Vec<usize> = self.acted().collect();
        links.mass.extend(acted.iter().map(|node| (*node, *node)));
        for (i, a) in acted.iter().enumerate() {
            (links.stiffness).extend(acted[i + 1..].iter().map(|b| (*a, *b)));
        }
    }

    fn unplace(&self, nodes: &mut [Node<D>]) {
        for node in (self.frame.node..self.inner()).step_by(2) {
            let at = unplaced(&nodes[node]);
            nodes[node..][..2].fill(at);
        }
    }

    /// Interfaces and what follows from amplitudes have no coordinates.
    fn add_fixed_numbers(&self, at: &[Node<D>], fixed: &mut Vec<(NodeNumber, f64)>) {
        BodyPart::add_fixed_numbers(&self.frame, at, fixed);
        let size = 2 * D;
        let free = self.inner() * size..self.inner() * size + self.model.modes();
        for number in self.interface(0) * size..self.all().end * size {
            if !free.contains(&number) {
                let (node, place) = (number / size, number % size);
                let (part, axis) = (place / D, place % D);
                fixed.push(((node, part, axis), at[node][part][axis]));
            }
        }
    }

    fn mark_rotating(&self, rotating: &mut RotatingNodes) {
        rotating.still[self.interface(0)..self.all().end].fill(true);
        rotating.modal[self.all()].fill(true);
    }

    fn frame_count(&self) -> usize {
        1
    }

    fn place(&self, from: &[Quaternion], rotations: &mut Rotations, x: &mut [Node<D>]) {
        self.frame.place(from, rotations, x);
        self.place_derived(&mut rotations.reduced[self.index], x);
        self.place_interfaces(x);
    }

    fn place_rates(&self, x: &[Node<D>], rotations: &mut Rotations, v: &mut [Node<D>]) {
        self.frame.place_rates(x, rotations, v);
        self.place_velocity_terms(v);
        let spin = self.frame.spin(x, v);
        self.place_interface_rates(x, &spin, v);
    }

    fn place_changes<N: Number>(&self, x: &[Node<D, N>], dx: &mut [Node<D, N>]) {
        let spin = self.resolve(x, dx);
        let axes = crate::bodies::frame::axis_rates(&self.axes(x), &spin);
        self.frame.set_axes(&axes, dx);
        self.place_derived_rates(x, dx);
        self.place_interface_rates(x, &spin, dx);
    }

    fn add_centripetal<N: Number>(&self, motion: NodalMotion<'_, D, N>, a: &mut [Node<D, N>]) {
        self.frame.add_centripetal(motion, a);
        self.add_interface_bias(motion.pair(), a);
    }

    fn pull_back<N: Number>(
        &self,
        motion: (&[Node<D, N>], Option<&[Node<D, N>]>),
        f: &mut [Node<D, N>],
    ) {
        self.pull_back_all(motion, f);
    }

    fn convert(&self, order: Derivative, at: &Rotations, q: &mut [f64]) {
        let state = &at.reduced[self.index];
        if order == Derivative::Back {
            BodyPart::<D>::convert(&self.frame, order, at, q);
            let spin = self.frame.read(q);
            self.frame.write(&state.scale.solve(&spin), q);
            for ((place, scale), coupling) in self.places.iter().zip(&state.coupling) {
                q[*place] += coupling.dot(&spin) * scale;
            }
            return;
        }
        let spin = state.scale.times(&self.frame.read(q));
        self.frame.write(&spin, q);
        for ((place, scale), coupling) in self.places.iter().zip(&state.coupling) {
            q[*place] -= coupling.dot(&spin) * scale;
        }
        BodyPart::<D>::convert(&self.frame, order, at, q);
    }

    fn rotation_in(&self, q: &[f64]) -> f64 {
        BodyPart::<D>::rotation_in(&self.frame, q)
    }

    fn renew(&self, frames: &mut [Quaternion], q: &mut [f64], v: &mut [f64]) {
        BodyPart::<D>::renew(&self.frame, frames, q, v);
    }

    fn for_each_geometric(
        &self,
        f: &[Node<D>],
        x: &[Node<D>],
        add: &mut impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        self.geometric_blocks(f, x, add);
    }

    fn add_mass(&self, assembly: &Assembly<D>, mass: &mut Matrix<f64>) {
        self.frame.add_mass(assembly, mass);
        let mut block = no_block();
        for (part, axis) in (0..2).flat_map(|part| (0..D).map(move |axis| (part, axis))) {
            block[part][axis][part][axis] = 1.0;
        }
        for node in self.modal() {
            assembly.add(node, node, &block, mass);
        }
    }

    /// Of the centre of mass alone: spins and rates of modes are counted by [`BodyPart::add_spin_momentum`].
    fn add_inertia<N: Number>(&self, s: f64, a: &[Node<D, N>], f: &mut [Node<D, N>]) {
        let node = self.frame.node;
        for (f, a) in f[node][0].iter_mut().zip(&a[node][0]) {
            *f += N::of(s * self.model.mass) * *a;
        }
    }

    fn add_centrifugal(
        &self,
        rotation: [f64; 3],
        x: &[Node<D>],
        assembly: &Assembly<D>,
        matrix: &mut Matrix<f64>,
    ) {
        let node = self.frame.node;
        let spin = spin_matrix::<D>(rotation);
        let axes = spin * spin;
        let block = part_block(0, |r, c| self.model.mass * axes[(r, c)]);
        assembly.add(node, node, &block, matrix);
        self.centrifugal_blocks(rotation, x, |a, b, block| {
            assembly.add(a, b, block, matrix);
        });
    }

    fn add_frame_spin<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        rotation: [f64; 3],
        f: &mut [Node<D, N>],
    ) {
        self.add_frame_forces(motion.pair(), rotation, f);
    }

    fn frame_spin_energy<N: Number>(&self, x: &[Node<D, N>], rotation: [f64; 3]) -> N {
        self.frame_energy(x, rotation)
    }

    fn add_spin_momentum(&self, motion: (&[Node<D>], &[Node<D>]), momentum: &mut [Node<D>]) {
        self.add_modal_momentum(motion, momentum);
    }

    fn add_weight(&self, gravity: &Vector<D>, f: &mut [Node<D>]) {
        self.frame.add_weight(gravity, f);
    }

    fn add_force(&self, motion: NodalMotion<'_, D>, out: (&mut [Node<D>], &mut [[f64; 3]])) -> f64 {
        self.add_modal_force(motion.pair(), out.0)
    }

    fn add_force_of<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        out: (&mut [Node<D, N>], &mut [[N; 3]]),
    ) {
        self.add_modal_force(motion.pair(), out.0);
    }

    fn add_tangent(
        &self,
        motion: NodalMotion<'_, D>,
        assembly: &Assembly<D>,
        [stiffness, damping]: [&mut Matrix<f64>; 2],
    ) {
        let x = motion.x;
        self.elastic_blocks(x, |a, b, block| assembly.add(a, b, block, stiffness));
        if BodyPart::<D>::is_damped(self) {
            self.damping_blocks(x, |a, b, block| assembly.add(a, b, block, damping));
        }
    }

    /// Of the centre of mass alone.
    fn add_quadratic<N: Number>(
        &self,
        x: &[Node<D, N>],
        map: &impl Fn(Vector<D, N>) -> Vector<D, N>,
        sum: &mut N,
    ) {
        let center = map(x[self.frame.node][0].into());
        *sum += center.norm_squared() * N::of(self.model.mass);
    }

    /// `(w^T (J w + h eta') + eta'^T (eta' + h^T w)) / 2`.
    fn kinetic_beside<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> N {
        let (x, v) = motion.pair();
        let spin = self.frame.spin(x, v);
        let (eta, rates) = (self.amplitudes(x), self.amplitudes(v));
        let terms = self.terms(x);
        let momentum = (self.model).angular_momentum((eta, rates), terms, &spin);
        let mut twice = spin.dot(&momentum);
        for (k, rate) in rates.iter().enumerate() {
            twice += *rate * (*rate + terms.coupling(k).dot(&spin));
        }
        twice * N::of(0.5)
    }

    fn strain_energy<N: Number>(&self, _drives: &[[N; 3]], x: &[Node<D, N>]) -> N {
        self.strain.energy(self.amplitudes(x), self.terms(x))
    }

    fn for_each_strain_energy(&self, x: [&[Node<D>]; 2], call: &mut impl FnMut([f64; 2])) {
        call(x.map(|x| self.strain.energy(self.amplitudes(x), self.terms(x))));
    }

    fn dissipation<N: Number>(&self, motion: NodalMotion<'_, D, N>) -> N {
        let rates = self.amplitudes(motion.v).iter().zip(&self.damping);
        rates.fold(N::of(0.0), |sum, (rate, damping)| {
            sum + *rate * *rate * N::of(*damping)
        })
    }

    fn add_momentum<N: Number>(&self, motion: NodalMotion<'_, D, N>, sum: &mut Momentum<D, N>) {
        let (x, v) = motion.pair();
        let [at, rate] = [x, v].map(|of| Vector::from(of[self.frame.node][0]));
        sum.add(at, rate * N::of(self.model.mass), true);
        let spin: Vector3<N> = self.frame.spin(x, v);
        let motion = (self.amplitudes(x), self.amplitudes(v));
        let own = (self.model).angular_momentum(motion, self.terms(x), &spin);
        sum.angular += combined(&completed::<D, N>(self.axes(x)), &own);
    }

    fn add_center<N: Number>(
        &self,
        drives: &[[N; 3]],
        x: &[Node<D, N>],
        sum: &mut Vector<D, N>,
    ) -> N {
        self.frame.add_center(drives, x, sum)
    }

    fn linearize(&self, at: &mut LinearizationPoint<'_, D>, terms: &mut LinearTerms) {
        let [stiffness, damping] = &mut terms.symmetric;
        let (x, assembly) = (at.motion.x, at.assembly);
        self.geometric_blocks(at.forces, x, &mut |a, b, block| {
            assembly.add(a, b, block, stiffness);
        });
        self.elastic_blocks(x, |a, b, block| assembly.add(a, b, block, stiffness));
        if !at.at_rest && BodyPart::<D>::is_damped(self) {
            terms.is_damped = true;
            self.damping_blocks(x, |a, b, block| assembly.add(a, b, block, damping));
        }
        if at.rotation != [0.0; 3] {
            self.linearize_coriolis(at, terms);
        }
    }
}
