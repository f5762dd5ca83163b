//! Bodies of finite element models reduced to modes: a frame in mean axes, amplitudes of modes, and interfaces that follow from both.
//!
//! Nodes of a body, six numbers each, four in the plane: the centre of mass and the axes as of a rigid body (two nodes), place and axes of every interface
//! (two nodes each), amplitudes of the modes, and what follows from these: the scale of spins `S^-1` and all terms that are linear in the
//! amplitudes (`elements/reduced/terms.rs`). Forces, rows and derivatives read them there. Coordinates are the first node and the amplitudes. Rates of constant mass are
//! `nu = S w`, `zeta = eta' + h^T w` (`elements/reduced/inertia.rs`). Small rotations and changes of amplitudes are counted alike. A moment
//! `t` along the axes and forces `Q` on modes are conjugate to them as `S^-T (t - h Q)` and `Q`.

mod body;
mod changes;
mod forces;
mod frame_spin;
mod linearized;

use nalgebra::Vector3;

use super::Elimination;
use super::connectivity::Node;
use super::frame::{Axes, RigidBodyFrame, combined, completed, turned_back};
use crate::elements::reduced::{
    Interface, ModalMatrix, ModalStrain, ModalTerms, ReducedModel, SPIN_SCALE, SpinScale, Symmetric,
};
use crate::math::jet::Number;
use crate::math::space::{components, vector};

/// A finite element model reduced to modes, as a body.
#[derive(Clone, Debug)]
pub struct ReducedBody {
    /// Centre of mass and principal axes without deformation.
    pub(super) frame: RigidBodyFrame,
    /// Index among the reduced bodies.
    pub(super) index: usize,
    /// Numbers in a node.
    numbers: usize,
    pub(super) model: ReducedModel,
    strain: ModalStrain,
    matrix: ModalMatrix,
    /// Damping by mode, `2 d sqrt(lambda)`, 1/s.
    damping: Vec<f64>,
    /// Where amplitudes are among the coordinates `q`, and how many of that make an amplitude of 1, `[n]`.
    places: Vec<(usize, f64)>,
}

/// Numbers that follow from the amplitudes of a body.
#[derive(Clone, Debug, Default)]
pub(super) struct ModalState {
    scale: SpinScale,
    /// Couplings `h`, `[n]`.
    coupling: Vec<Vector3<f64>>,
}

impl ModalState {
    /// Without deformation.
    pub fn of(body: &ReducedBody) -> Self {
        Self {
            scale: SpinScale::ONE,
            coupling: vec![Vector3::zeros(); body.model.modes()],
        }
    }

    /// Becomes the same as another one, without new memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.scale = other.scale;
        self.coupling.copy_from_slice(&other.coupling);
    }
}

/// A place of a reduced body that forces act on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Site {
    /// The frame.
    Frame,
    /// An interface.
    Interface(usize),
}

/// Axes that rotate with an interface, from those of the body now and those given in them without deformation.
fn rotated_axes(interface: &Interface, eta: &[f64], of_body: &Axes, axes: &Axes) -> Axes {
    let back = -interface.turn(eta);
    axes.each_ref()
        .map(|axis| combined(of_body, &turned_back(&back, axis)))
}

/// Numbers that nodes hold one after the other.
fn numbers<const D: usize, N>(nodes: &[Node<D, N>]) -> &[N] {
    nodes.as_flattened().as_flattened()
}

/// Numbers that nodes hold one after the other, to be changed.
fn numbers_mut<const D: usize, N>(nodes: &mut [Node<D, N>]) -> &mut [N] {
    nodes.as_flattened_mut().as_flattened_mut()
}

impl ReducedBody {
    /// A body with its first node and the damping ratio of each of its modes, `[n]`. A system finds where its coordinates are.
    pub fn new<const D: usize>(node: usize, model: ReducedModel, damping_ratios: &[f64]) -> Self {
        let roots = model.eigenvalues.iter().map(|lambda| lambda.sqrt());
        let damping = roots
            .zip(damping_ratios)
            .map(|(root, ratio)| 2.0 * ratio * root);
        let strain = ModalStrain::new(&model);
        Self {
            frame: RigidBodyFrame::new(node, model.mass, model.moments),
            index: 0,
            numbers: 2 * D,
            damping: damping.collect(),
            places: Vec::new(),
            matrix: ModalMatrix::new(&model, &strain),
            strain,
            model,
        }
    }

    /// Coordinates of all its nodes without deformation, for a centre of mass (m) and axes.
    pub fn reference<const D: usize>(&self, center: [f64; 3], axes: &Axes) -> Vec<Node<D>> {
        let [a, b, c] = axes.map(|axis| vector::<D, f64>(axis.into()).into());
        let origin = Vector3::zeros();
        let places = self.model.interfaces.iter().map(|of| &of.position);
        let mut nodes = Vec::new();
        for place in std::iter::once(&origin).chain(places) {
            let at = Vector3::from(center) + combined(axes, place);
            nodes.extend([[vector::<D, f64>(at.into()).into(), a], [b, c]]);
        }
        nodes.resize(nodes.len() + self.inner_nodes(), [[0.0; D]; 2]);
        let derived = self.derived() - self.frame.node;
        let undeformed = self.matrix.undeformed();
        let (scale, terms) = numbers_mut(&mut nodes[derived..]).split_at_mut(SPIN_SCALE);
        scale.copy_from_slice(&SpinScale::ONE.0);
        terms[..undeformed.len()].copy_from_slice(undeformed);
        nodes
    }

    /// Place of a point of a line that deforms as an interface does, m, and directions that are along these axes without deformation,
    /// given in the axes of the body.
    pub fn directed<const D: usize>(
        &self,
        point: &Interface,
        axes: &Axes,
        x: &[Node<D>],
    ) -> ([f64; 3], [[f64; 3]; 3]) {
        let (eta, of_body) = (self.amplitudes(x), completed::<D, _>(self.axes(x)));
        let center = Vector3::from(components(&x[self.frame.node][0].into()));
        let at = center + combined(&of_body, &point.deformed(eta));
        let axes = rotated_axes(point, eta, &of_body, axes);
        (at.into(), axes.map(Into::into))
    }

    /// First node of the frame of an interface, by its index.
    pub fn interface(&self, index: usize) -> usize {
        self.frame.node + 2 + 2 * index
    }

    /// Largest displacement of an interface against the axes, relative to the size of the body, and largest rotation of one, rad.
    pub fn deformation<const D: usize>(&self, x: &[Node<D>]) -> [f64; 2] {
        let (eta, interfaces) = (self.amplitudes(x), &self.model.interfaces);
        let terms = self.terms(x);
        let reach = interfaces.iter().map(|of| of.position.norm());
        let size = 2.0 * reach.fold(self.frame.gyration(), f64::max);
        let moved = interfaces
            .iter()
            .enumerate()
            .map(|(index, of)| (of.place(eta, terms.shapes(index)) - of.position).norm());
        let rotated = interfaces.iter().map(|of| of.turn(eta).norm());
        [
            moved.fold(0.0, f64::max) / size,
            rotated.fold(0.0, f64::max),
        ]
    }

    /// Stress at a point for the stresses there by modes, `[modes][6]`, Pa: their sum times the strains of the modes. Damping adds none.
    pub fn stress<const D: usize, N: Number>(
        &self,
        by_modes: &[Symmetric],
        x: &[Node<D, N>],
    ) -> Symmetric<N> {
        let (eta, terms) = (self.amplitudes(x), self.terms(x));
        let mut sum = [N::of(0.0); 6];
        for (m, by_mode) in by_modes.iter().enumerate() {
            let strain = self.strain.of_mode(m, eta, terms);
            let parts = sum.iter_mut().zip(by_mode);
            parts.for_each(|(sum, part)| *sum += strain * N::of(*part));
        }
        sum
    }

    /// First nodes of its frames.
    pub(super) fn sites(&self) -> impl Iterator<Item = (usize, Site)> {
        let interfaces = 0..self.model.interfaces.len();
        let interfaces = interfaces.map(|index| (self.interface(index), Site::Interface(index)));
        std::iter::once((self.frame.node, Site::Frame)).chain(interfaces)
    }

    /// Finds the amplitudes among the coordinates. `y` is scratch of zeros.
    pub(super) fn find_amplitudes<const D: usize>(
        &mut self,
        elimination: &Elimination<D>,
        y: &mut [f64],
    ) {
        let place = |k: usize| {
            let mut unit = [[0.0; D]; 2];
            unit.as_flattened_mut()[k % (2 * D)] = 1.0;
            let node = self.inner() + k / (2 * D);
            let moved = elimination.reduce_node(node, &unit, y);
            moved.first().copied()
        };
        self.places = (0..self.model.modes()).filter_map(place).collect();
    }

    /// First node that holds amplitudes and what follows from them.
    pub fn inner(&self) -> usize {
        self.interface(self.model.interfaces.len())
    }

    /// Nodes that hold axes only: the second ones of the frame and of all interfaces.
    pub fn axes_nodes(&self) -> impl Iterator<Item = usize> {
        (self.frame.node..self.inner()).skip(1).step_by(2)
    }

    /// Number of nodes with amplitudes.
    fn modal_nodes(&self) -> usize {
        self.model.modes().div_ceil(self.numbers)
    }

    /// Number of nodes with amplitudes and with what follows from them.
    fn inner_nodes(&self) -> usize {
        let derived = SPIN_SCALE + self.matrix.undeformed().len();
        self.modal_nodes() + derived.div_ceil(self.numbers)
    }

    /// First node with what follows from amplitudes.
    fn derived(&self) -> usize {
        self.inner() + self.modal_nodes()
    }

    /// Number of rotations that are counted: three in space, one in the plane.
    fn rotations(&self) -> usize {
        if self.numbers == 4 { 1 } else { 3 }
    }

    /// Nodes with amplitudes.
    pub(super) fn modal(&self) -> std::ops::Range<usize> {
        self.inner()..self.derived()
    }

    /// All its nodes.
    pub(super) fn all(&self) -> std::ops::Range<usize> {
        self.frame.node..self.inner() + self.inner_nodes()
    }

    /// Nodes whose coordinates forces on it act on.
    pub(super) fn acted(&self) -> impl Iterator<Item = usize> {
        std::iter::once(self.frame.node).chain(self.modal())
    }

    /// The model in the basis that is taken.
    pub fn model(&self) -> &ReducedModel {
        &self.model
    }

    /// Amplitudes of the modes of the file, `[modes of the file]`.
    pub fn file_amplitudes<const D: usize>(&self, x: &[Node<D>]) -> Vec<f64> {
        self.model.file_amplitudes(self.amplitudes(x))
    }

    /// Strains of the modes of the file, `[modes of the file]`: stresses by these modes times them are those of the body.
    pub fn file_strains<const D: usize>(&self, x: &[Node<D>]) -> Vec<f64> {
        let (eta, terms) = (self.amplitudes(x), self.terms(x));
        let strains = (0..eta.len()).map(|m| self.strain.of_mode(m, eta, terms));
        self.model.file_amplitudes(&strains.collect::<Vec<_>>())
    }

    /// Amplitudes of the modes, or their rates where `x` holds rates, `[n]`.
    #[inline(always)]
    pub fn amplitudes<'a, const D: usize, N>(&self, x: &'a [Node<D, N>]) -> &'a [N] {
        &numbers(&x[self.inner()..])[..self.model.modes()]
    }

    /// Amplitudes, to be changed.
    #[inline(always)]
    fn amplitudes_mut<'a, const D: usize, N>(&self, x: &'a mut [Node<D, N>]) -> &'a mut [N] {
        &mut numbers_mut(&mut x[self.inner()..])[..self.model.modes()]
    }

    /// Scale of spins and terms, or their rates where `x` holds rates.
    #[inline(always)]
    fn derived_of<'a, const D: usize, N: Number>(
        &self,
        x: &'a [Node<D, N>],
    ) -> (SpinScale<N>, ModalTerms<'a, N>) {
        (SpinScale::of(numbers(&x[self.derived()..])), self.terms(x))
    }

    /// Terms that are linear in the amplitudes, or their rates where `x` holds rates.
    #[inline(always)]
    fn terms<'a, const D: usize, N: Number>(&self, x: &'a [Node<D, N>]) -> ModalTerms<'a, N> {
        self.matrix
            .read(&numbers(&x[self.derived()..])[SPIN_SCALE..])
    }

    /// Mutable access to both.
    #[inline(always)]
    fn derived_mut<'a, const D: usize, N: Number>(
        &self,
        derived: &'a mut [Node<D, N>],
    ) -> (&'a mut [N], &'a mut [N]) {
        let (scale, terms) = numbers_mut(derived).split_at_mut(SPIN_SCALE);
        (scale, &mut terms[..self.matrix.undeformed().len()])
    }

    /// Axes of its frame, or their rates where `x` holds rates; the third one is zero in the plane.
    fn axes<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> Axes<N> {
        self.frame.axes(x)
    }
}
