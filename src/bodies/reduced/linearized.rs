//! Tangents of reduced bodies over what is integrated.

use nalgebra::{Matrix3, Vector3};

use super::{ReducedBody, Site};
use crate::bodies::assembly::{NodeBlock, no_block};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{
    Axes, RigidBodyFrame, along, axes_at, geometric, rotation_block, rotation_numbers, spin_of,
    turned_back,
};
use crate::elements::reduced::{Interface, ModalStiffness, SpinScale};
use crate::math::space::{Vector, components};

/// Nodes with amplitudes whose derivatives are computed together.
const TOGETHER: usize = 8;

/// A symmetric matrix over small rotations along the axes and amplitudes of the modes.
pub(super) trait Stiffness {
    /// Over rotations alone.
    fn rotations(&self) -> Matrix3<f64> {
        Matrix3::zeros()
    }

    /// Over rotations and the amplitude of a mode.
    fn mixed(&self, _k: usize) -> Vector3<f64> {
        Vector3::zeros()
    }

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
    fn modal(&self, k: usize, l: usize) -> f64 {
        if k == l { self.0[k] } else { 0.0 }
    }

    fn is_diagonal(&self) -> bool {
        true
    }
}

impl Stiffness for ModalStiffness<'_> {
    fn modal(&self, k: usize, l: usize) -> f64 {
        self.at(k, l)
    }
}

/// What a force at an interface adds where modes change its place, and where the body rotates with them.
struct AtInterface<'a> {
    interface: &'a Interface,
    /// Along the axes of the body, N.
    force: Vector3<f64>,
    /// Derivatives of its place by the amplitudes, m, `[n]`.
    shapes: &'a [[f64; 3]],
    paired: usize,
    eta: &'a [f64],
    /// Moment on it; none where none acts.
    moment: Option<AtMoment>,
}

/// What forces on the axes of an interface add where these rotate by modes. Over rotations of the body and rotation vectors of the axes all of it is
/// constant.
struct AtMoment {
    /// Over rotations of the body and rotation vectors, N m.
    mixed: Matrix3<f64>,
    /// Over two rotation vectors, N m.
    turned: Matrix3<f64>,
    /// Moment on a second-order rotation vector, N m.
    moment: Vector3<f64>,
}

impl AtMoment {
    /// For axes that stand along those of a body after a rotation vector, and forces on them along those of the body, N m.
    fn new(turn: &Vector3<f64>, own: &Axes, on_own: &Axes) -> Self {
        let pairs = || own.iter().zip(on_own);
        let products: Matrix3<f64> = pairs().map(|(axis, force)| axis * force.transpose()).sum();
        let moment: Vector3<f64> = pairs().map(|(axis, force)| axis.cross(force)).sum();
        // Rotation of the axes along those of the body by changes of the rotation vector.
        let spins = [0, 1, 2].map(|k| turned_back(&-turn, &spin_of(turn, &Vector3::ith(k, 1.0))));
        let spins = Matrix3::from_columns(&spins);
        let traces = Matrix3::from_diagonal_element(products.trace());
        let symmetric = (products + products.transpose()) * 0.5;
        Self {
            mixed: (traces - products) * spins,
            turned: spins.transpose() * (symmetric - traces) * spins,
            moment: spins.tr_mul(&moment),
        }
    }
}

impl Stiffness for AtInterface<'_> {
    fn mixed(&self, k: usize) -> Vector3<f64> {
        let mut mixed = self.force.cross(&Vector3::from(self.shapes[k]));
        if let Some(moment) = &self.moment {
            mixed += moment.mixed * self.interface.rotation_shape(k, self.eta);
        }
        mixed
    }

    fn modal(&self, k: usize, l: usize) -> f64 {
        let has_pair = k < self.paired && l < self.paired;
        let second = self.interface.second.get(self.paired * k + l);
        let second = second.filter(|_| has_pair);
        let mut modal = -second.map_or(0.0, |second| second.dot(&self.force));
        if let Some(moment) = &self.moment {
            let [a, b] = [k, l].map(|k| self.interface.rotation_shape(k, self.eta));
            let second = self.interface.second_turn(k, l);
            modal -= a.dot(&(moment.turned * b)) + second.dot(&moment.moment);
        }
        modal
    }
}

impl ReducedBody {
    /// Calls with the blocks, for each pair of nodes once, of a matrix over rotations and amplitudes.
    pub(super) fn blocks<const D: usize>(
        &self,
        of: &impl Stiffness,
        x: &[Node<D>],
        mut add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let (scale, terms) = self.derived_of(x);
        let couplings = terms.couplings();
        let (n, node, size) = (self.model.modes(), self.frame.node, 2 * D);
        let mut rotations = of.rotations();
        for (a, first) in self.modal().enumerate() {
            let mut mixed = no_block::<D>();
            for k in (size * a..n).take(size) {
                let (coupled, by_mode) = (Vector3::from(couplings[k]), of.mixed(k));
                let mut by_others = Vector3::zeros();
                let others = if of.is_diagonal() { k..k + 1 } else { 0..n };
                for l in others {
                    by_others += Vector3::from(couplings[l]) * of.modal(k, l);
                }
                rotations +=
                    coupled * (by_others - by_mode).transpose() - by_mode * coupled.transpose();
                let column = scale.transposed_times(&(by_mode - by_others));
                let place = k - size * a;
                let column: [f64; D] = rotation_numbers(&column);
                for (row, entry) in mixed[1].iter_mut().zip(column) {
                    row[place / D][place % D] = entry;
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
        add(node, node, &counted_block(&scale, &rotations));
    }

    /// Calls with the second derivatives of the strain energy.
    pub(super) fn elastic_blocks<const D: usize>(
        &self,
        x: &[Node<D>],
        add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let stiffness = self.strain.stiffness(self.amplitudes(x), self.terms(x));
        self.blocks(&stiffness, x, add);
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
        let (node, axes) = (self.frame.node, self.axes(x));
        // A force at an arm does as one on each axis, times the component of the arm.
        let mut on_axes = self.axes(forces);
        for (index, interface) in self.model.interfaces.iter().enumerate() {
            let node = self.interface(index);
            let force = Vector::from(forces[node][0]);
            let global = Vector3::from(components(&force));
            let arm = self.arm(node, &axes, x);
            let (own, on_own) = (axes_at(node, x), axes_at(node, forces));
            for k in 0..3 {
                on_axes[k] += global * arm[k];
                for (axis, on_axis) in own.iter().zip(&on_own) {
                    on_axes[k] += on_axis * axis.dot(&axes[k]);
                }
            }
            let of_body = |of: &Axes| of.each_ref().map(|axis| along(&axes, axis));
            let has_moment = on_own.iter().any(|force| *force != Vector3::zeros());
            let has_moment = has_moment && interface.rotation.is_some();
            if force != Vector::<D>::zeros() || has_moment {
                let eta = self.amplitudes(x);
                let at = AtInterface {
                    interface,
                    force: along(&axes, &force),
                    shapes: self.terms(x).shapes(index),
                    paired: self.model.paired,
                    eta,
                    moment: has_moment.then(|| {
                        AtMoment::new(&interface.turn(eta), &of_body(&own), &of_body(&on_own))
                    }),
                };
                self.blocks(&at, x, &mut *add);
            }
        }
        let turned = geometric(&axes, &on_axes);
        let (scale, _) = self.derived_of(x);
        add(
            node,
            node,
            &counted_block(&scale, &((turned + turned.transpose()) * 0.5)),
        );
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

/// A block over small rotations of the frame, counted as spins are.
fn counted_block<const D: usize>(scale: &SpinScale, rotations: &Matrix3<f64>) -> NodeBlock<D> {
    let scale = scale.matrix();
    rotation_block(&(scale.transpose() * rotations * scale))
}
