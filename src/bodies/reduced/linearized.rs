//! Tangents of reduced bodies over what is integrated.

use nalgebra::{Matrix3, Vector3};

use super::{ReducedBody, Site, coupling_at};
use crate::bodies::assembly::{NodeBlock, no_block};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{RigidBodyFrame, axes_at, rotation_block};
use crate::elements::reduced::ModalStiffness;
use crate::math::space::components;

/// Nodes with amplitudes whose derivatives are computed together.
const TOGETHER: usize = 8;

/// A symmetric matrix over small rotations along the axes and amplitudes of the modes.
trait Stiffness {
    /// Over rotations.
    fn rotations(&self) -> Matrix3<f64>;

    /// Over rotations and the amplitude of a mode.
    fn mixed(&self, k: usize) -> Vector3<f64>;

    /// Over the amplitudes of two modes.
    fn modal(&self, k: usize, l: usize) -> f64;

    /// Whether amplitudes of different modes are not coupled.
    fn is_diagonal(&self) -> bool {
        false
    }
}

/// Over the amplitudes alone, each by itself.
struct Diagonal<'a>(&'a [f64]);

impl Stiffness for Diagonal<'_> {
    fn rotations(&self) -> Matrix3<f64> {
        Matrix3::zeros()
    }

    fn mixed(&self, _k: usize) -> Vector3<f64> {
        Vector3::zeros()
    }

    fn modal(&self, k: usize, l: usize) -> f64 {
        if k == l { self.0[k] } else { 0.0 }
    }

    fn is_diagonal(&self) -> bool {
        true
    }
}

impl Stiffness for ModalStiffness<'_> {
    fn rotations(&self) -> Matrix3<f64> {
        Matrix3::zeros()
    }

    fn mixed(&self, _k: usize) -> Vector3<f64> {
        Vector3::zeros()
    }

    fn modal(&self, k: usize, l: usize) -> f64 {
        self.at(k, l)
    }
}

/// What forces at interfaces add where the frame rotates and modes change their shape.
struct Geometric<'a, const D: usize> {
    body: &'a ReducedBody,
    forces: &'a [Node<D>],
    x: &'a [Node<D>],
}

impl<const D: usize> Geometric<'_, D> {
    /// Force at an interface along the axes of the body, N.
    fn force(&self, index: usize) -> Vector3<f64> {
        let axes = self.body.axes(self.x);
        let force = &self.forces[self.body.interface(index)][0];
        let force = Vector3::from(components(&(*force).into()));
        Vector3::from_fn(|k, _| axes[k].dot(&force))
    }

    /// Forces that are not zero, with the indices of their interfaces.
    fn all(&self) -> impl Iterator<Item = (usize, Vector3<f64>)> {
        let all = 0..self.body.model.interfaces.len();
        let forces = all.map(|index| (index, self.force(index)));
        forces.filter(|(_, force)| *force != Vector3::zeros())
    }
}

impl<const D: usize> Stiffness for Geometric<'_, D> {
    /// `sum (e.f) I - f e^T` of forces on the axes, to which a force at an arm `y` adds `y_k f`, symmetric.
    fn rotations(&self) -> Matrix3<f64> {
        let axes = self.body.axes(self.x);
        let mut sum = self.body.frame.geometric(self.forces, self.x);
        for (index, force) in self.all() {
            let arm = self.body.arm(self.body.interface(index), &axes, self.x);
            sum += Matrix3::from_diagonal_element(arm.dot(&force)) - arm * force.transpose();
        }
        for index in 0..self.body.model.interfaces.len() {
            let node = self.body.interface(index);
            let (own, on) = (axes_at(node, self.x), axes_at(node, self.forces));
            for (axis, force) in own.iter().zip(&on) {
                let along = |v: &Vector3<f64>| Vector3::from_fn(|k, _| axes[k].dot(v));
                let (axis, force) = (along(axis), along(force));
                sum += Matrix3::from_diagonal_element(axis.dot(&force)) - axis * force.transpose();
            }
        }
        (sum + sum.transpose()) * 0.5
    }

    fn mixed(&self, k: usize) -> Vector3<f64> {
        let eta = self.body.amplitudes(self.x);
        self.all().fold(Vector3::zeros(), |sum, (index, force)| {
            let interface = &self.body.model.interfaces[index];
            sum - interface
                .shape(k, eta, self.body.model.paired)
                .cross(&force)
        })
    }

    fn modal(&self, k: usize, l: usize) -> f64 {
        let paired = self.body.model.paired;
        if k >= paired || l >= paired {
            return 0.0;
        }
        self.all().fold(0.0, |sum, (index, force)| {
            let second = &self.body.model.interfaces[index].second;
            let bend = second.get(paired * k + l);
            sum - bend.map_or(0.0, |bend| bend.dot(&force))
        })
    }
}

impl ReducedBody {
    /// Calls with the blocks, for each pair of nodes once, of a matrix over rotations and amplitudes.
    fn blocks<const D: usize>(
        &self,
        of: &impl Stiffness,
        x: &[Node<D>],
        mut add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let (scale, coupling) = self.derived_of(x);
        let (n, node, size) = (self.model.modes(), self.frame.node, 2 * D);
        let mut rotations = of.rotations();
        for (a, first) in self.modal().enumerate() {
            let mut mixed = no_block::<D>();
            for k in (size * a..n).take(size) {
                let (coupled, by_mode) = (coupling_at(coupling, k), of.mixed(k));
                let mut by_others = Vector3::zeros();
                let others = if of.is_diagonal() { k..k + 1 } else { 0..n };
                for l in others {
                    by_others += coupling_at(coupling, l) * of.modal(k, l);
                }
                rotations +=
                    coupled * (by_others - by_mode).transpose() - by_mode * coupled.transpose();
                let column = scale.transposed_times(&(by_mode - by_others));
                let place = k - size * a;
                for axis in 0..D {
                    mixed[1][axis][place / D][place % D] = column[axis];
                }
            }
            add(node, first, &mixed);
            for (b, second) in self.modal().enumerate().skip(a) {
                if a != b && of.is_diagonal() {
                    continue;
                }
                let mut block = no_block::<D>();
                for k in (size * a..n).take(size) {
                    for l in (size * b..n).take(size) {
                        let (r, c) = (k - size * a, l - size * b);
                        block[r / D][r % D][c / D][c % D] = of.modal(k, l);
                    }
                }
                add(first, second, &block);
            }
        }
        let scale = scale.matrix();
        add(
            node,
            node,
            &rotation_block(&(scale.transpose() * rotations * scale)),
        );
    }

    /// Calls with the second derivatives of the strain energy.
    pub(super) fn elastic_blocks<const D: usize>(
        &self,
        x: &[Node<D>],
        add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let eta = self.amplitudes(x);
        self.blocks(&self.strain.stiffness(eta), x, add);
    }

    /// Calls with the damping of the modes.
    pub(super) fn damping_blocks<const D: usize>(
        &self,
        x: &[Node<D>],
        add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        self.blocks(&Diagonal(&self.damping), x, add);
    }

    /// Calls with what forces over the nodes add where the body rotates and deforms.
    pub(super) fn geometric_blocks<const D: usize>(
        &self,
        forces: &[Node<D>],
        x: &[Node<D>],
        add: &mut impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let body = self;
        self.blocks(&Geometric { body, forces, x }, x, add);
    }

    /// Calls with the derivatives of the vectors of a node of the frame or an interface by what is integrated, node by node.
    pub(in crate::bodies) fn for_each_partial<const D: usize>(
        &self,
        (site, is_second): (Site, bool),
        x: &[Node<D>],
        mut call: impl FnMut(usize, &NodeBlock<D>),
    ) {
        let axes = axes_at(self.site_node(site), x);
        let modal = self.modal();
        for first in modal.clone().step_by(TOGETHER) {
            let mut of_modes = [no_block::<D>(); TOGETHER];
            let mut of_frame = no_block::<D>();
            for (part, axis) in (0..2).flat_map(|part| (0..D).map(move |axis| (part, axis))) {
                let (mut force, mut moment) = ([0.0; D], Vector3::zeros());
                if part == 0 && !is_second {
                    force[axis] = 1.0;
                } else {
                    let mut on_axes = [Vector3::zeros(); 3];
                    on_axes[if is_second { 1 + part } else { 0 }][axis] = 1.0;
                    moment = RigidBodyFrame::moment(&axes, &on_axes);
                }
                // What a unit force does is the derivative of what it acts on.
                self.pull_marker(site, (&force, &moment), x, &mut |node, term| {
                    if node == self.frame.node {
                        of_frame[part][axis] = *term;
                    } else if let Some(block) = of_modes.get_mut(node.wrapping_sub(first)) {
                        block[part][axis] = *term;
                    }
                });
            }
            if first == modal.start {
                call(self.frame.node, &of_frame);
            }
            for (node, block) in (first..modal.end).zip(&of_modes) {
                call(node, block);
            }
        }
    }

    /// First node of a place.
    fn site_node(&self, site: Site) -> usize {
        match site {
            Site::Frame => self.frame.node,
            Site::Interface(index) => self.interface(index),
        }
    }
}
