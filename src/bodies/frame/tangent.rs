//! Derivatives over the nodes of rigid bodies become those over their coordinates.

use nalgebra::{Matrix3, Vector3};

use super::section_frame::angular;
use super::{Axes, RigidBodyFrame, SectionFrame, axes_at, axis_rates};
use crate::bodies::Bodies;
use crate::bodies::assembly::{NodeBlock, no_block};
use crate::bodies::connectivity::Node;
use crate::bodies::nodes::NodeOwner;

/// The block of a node whose second vector stands for a rotation.
pub fn rotation_block<const D: usize>(matrix: &Matrix3<f64>) -> NodeBlock<D> {
    if D == 2 {
        let about = |i: usize, j: usize| if i + j == 0 { matrix[(2, 2)] } else { 0.0 };
        return part_block(1, about);
    }
    part_block(1, |i, j| matrix[(i, j)])
}

/// The block of a node over one of its vectors alone, by entries (row, column).
pub(in crate::bodies) fn part_block<const D: usize>(
    part: usize,
    entry: impl Fn(usize, usize) -> f64,
) -> NodeBlock<D> {
    let mut block = no_block();
    for (i, j) in (0..D).flat_map(|i| (0..D).map(move |j| (i, j))) {
        block[part][i][part][j] = entry(i, j);
    }
    block
}

/// Parts and axes of a nodal vector.
fn entries<const D: usize>() -> impl Iterator<Item = (usize, usize)> {
    (0..2).flat_map(|part| (0..D).map(move |axis| (part, axis)))
}

/// `to += factor * from`.
fn add_scaled<const D: usize>(factor: f64, from: &Node<D>, to: &mut Node<D>) {
    let pairs = to.as_flattened_mut().iter_mut().zip(from.as_flattened());
    pairs.for_each(|(to, from)| *to += factor * from);
}

/// `A^T K B`.
pub(super) fn transformed<const D: usize>(
    block: &NodeBlock<D>,
    by_a: &NodeBlock<D>,
    by_b: &NodeBlock<D>,
) -> NodeBlock<D> {
    let mut pulled = no_block();
    for (p, r) in entries::<D>() {
        // A row of the block times the derivatives of the second node; most of both are zero.
        let mut row = [[0.0; D]; 2];
        let row_of_block = entries::<D>().map(|(q, s)| (block[p][r][q][s], &by_b[q][s]));
        for (value, partial) in row_of_block.filter(|(value, _)| *value != 0.0) {
            add_scaled(value, partial, &mut row);
        }
        for (i, k) in entries::<D>().filter(|(i, k)| by_a[p][r][*i][*k] != 0.0) {
            add_scaled(by_a[p][r][i][k], &row, &mut pulled[i][k]);
        }
    }
    pulled
}

/// Adds its transpose to a block.
fn add_transposed<const D: usize>(block: &mut NodeBlock<D>) {
    let once = *block;
    for (i, k) in entries::<D>() {
        for (j, l) in entries::<D>() {
            block[i][k][j][l] += once[j][l][i][k];
        }
    }
}

/// Stiffness that forces on axes add where these rotate, along them: `sum (E_i.F_i) I - F_i E_i^T`, symmetric where the forces have no
/// moment.
pub(in crate::bodies) fn geometric(axes: &Axes, forces: &Axes) -> Matrix3<f64> {
    let along = Matrix3::from_fn(|i, j| forces[j].dot(&axes[i]));
    Matrix3::from_diagonal_element(along.trace()) - along
}

/// Derivatives of a node by the coordinates of the nodes that have them.
pub(in crate::bodies) type Partials<const D: usize> = [Option<(usize, NodeBlock<D>)>; 2];

impl RigidBodyFrame {
    /// Derivatives of the vectors of its first or second node by its coordinates.
    pub(in crate::bodies) fn partial<const D: usize>(
        &self,
        is_second: bool,
        x: &[Node<D>],
    ) -> NodeBlock<D> {
        let mut partial = no_block();
        let axes = self.axes(x);
        for turn in 0..D {
            let [a, b, c] = axis_rates(&axes, &Vector3::ith(turn, 1.0));
            let changes = if is_second {
                [b, c]
            } else {
                [Vector3::zeros(), a]
            };
            for (part, change) in changes.iter().enumerate() {
                for axis in 0..D {
                    partial[part][axis][1][turn] = change[axis];
                }
            }
            if !is_second {
                partial[0][turn][0][turn] = 1.0;
            }
        }
        partial
    }

    /// Derivatives of the rates of these vectors by rotations about its axes as they stand: `E_i x v`.
    pub(in crate::bodies) fn partial_of_rates<const D: usize>(
        &self,
        is_second: bool,
        x: &[Node<D>],
        v: &[Node<D>],
    ) -> NodeBlock<D> {
        let mut partial = no_block();
        let (axes, [a, b, c]) = (self.axes(x), self.axes(v));
        for (turn, about) in axes.iter().enumerate().take(D) {
            let rates = if is_second {
                [b, c]
            } else {
                [Vector3::zeros(), a]
            };
            for (part, rate) in rates.iter().enumerate() {
                let change = about.cross(rate);
                for axis in 0..D {
                    partial[part][axis][1][turn] = change[axis];
                }
            }
        }
        partial
    }

    /// Stiffness that forces over the nodes on its axes add where it rotates, along its axes.
    pub fn geometric<const D: usize>(&self, f: &[Node<D>], x: &[Node<D>]) -> Matrix3<f64> {
        geometric(&self.axes(x), &self.axes(f))
    }
}

impl<const D: usize> Bodies<D> {
    /// Second derivatives by nodal coordinates become those by what is integrated, added pair by pair of the nodes that have these; what a
    /// pair of nodes has both ways that stand for one is in it.
    pub(in crate::bodies) fn rotate_block(
        &self,
        (a, b): (usize, usize),
        block: &NodeBlock<D>,
        x: &[Node<D>],
        mut add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let is_pair = a != b;
        if [a, b].iter().any(|node| self.follows_many(*node)) {
            return self.rotate_modal_block((a, b), block, x, add);
        }
        let [of_a, of_b] = [a, b].map(|node| self.partials(node, x));
        for (i, (to_a, by_a)) in of_a.into_iter().flatten().enumerate() {
            for (j, (to_b, by_b)) in of_b.into_iter().flatten().enumerate() {
                // Of what belongs to one node the lower half is what the upper one is.
                if !is_pair && j > i {
                    continue;
                }
                let mut pulled = transformed(block, &by_a, &by_b);
                if is_pair && to_a == to_b {
                    add_transposed(&mut pulled);
                }
                add(to_a, to_b, &pulled);
            }
        }
    }

    /// Whether a node is one of a frame that follows many nodes: of a reduced body, or of a point of a plate.
    fn follows_many(&self, node: usize) -> bool {
        matches!(
            self.owner(node),
            NodeOwner::Reduced(..) | NodeOwner::Point(..)
        )
    }

    /// [`Self::rotate_block`] where nodes follow from many others.
    #[inline(never)]
    fn rotate_modal_block(
        &self,
        (a, b): (usize, usize),
        block: &NodeBlock<D>,
        x: &[Node<D>],
        mut add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let (is_pair, mut i) = (a != b, 0);
        self.for_each_partial(a, x, |to_a, by_a| {
            let mut j = 0;
            self.for_each_partial(b, x, |to_b, by_b| {
                if is_pair || j <= i {
                    let mut pulled = transformed(block, by_a, by_b);
                    if is_pair && to_a == to_b {
                        add_transposed(&mut pulled);
                    }
                    add(to_a, to_b, &pulled);
                }
                j += 1;
            });
            i += 1;
        });
    }

    /// Calls with the derivatives of a node's vectors by the coordinates of each node that they follow from.
    pub(in crate::bodies) fn for_each_partial(
        &self,
        node: usize,
        x: &[Node<D>],
        mut call: impl FnMut(usize, &NodeBlock<D>),
    ) {
        if let NodeOwner::Reduced(index, site, is_second) = self.owner(node) {
            return self.reduced[index].for_each_partial((site, is_second), x, call);
        }
        if let NodeOwner::Point(index, point, is_second) = self.owner(node) {
            return self.patches[index].for_each_partial((point, is_second), x, call);
        }
        for (owner, partial) in self.partials(node, x).iter().flatten() {
            call(*owner, partial);
        }
    }

    /// Derivatives of a node's vectors by the coordinates of the nodes that have them: one node, but for section frames.
    fn partials(&self, node: usize, x: &[Node<D>]) -> Partials<D> {
        match self.owner(node) {
            NodeOwner::Rigid(index, is_second) => {
                let frame = &self.rigid[index];
                [Some((frame.node, frame.partial(is_second, x))), None]
            }
            NodeOwner::Section(chain, k, is_second) => {
                let frame = self.sections[chain].frame(k);
                frame.partials(is_second, x).map(Some)
            }
            _ => {
                let mut partial = no_block();
                for (i, k) in entries::<D>() {
                    partial[i][k][i][k] = 1.0;
                }
                [Some((node, partial)), None]
            }
        }
    }

    /// Calls with the derivatives of the rates of a node's vectors by rotations of its body about its axes as they stand, for each node of
    /// [`Self::for_each_partial`]. Frames that follow others are linearized at rest, where these are zero.
    pub(in crate::bodies) fn for_each_partial_of_rates(
        &self,
        node: usize,
        (x, v): (&[Node<D>], &[Node<D>]),
        call: &mut dyn FnMut(usize, &NodeBlock<D>),
    ) {
        if self.follows_many(node) {
            return self.for_each_partial(node, x, |owner, _| call(owner, &no_block()));
        }
        for (owner, partial) in self.partials_of_rates(node, x, v).iter().flatten() {
            call(*owner, partial);
        }
    }

    /// [`Self::for_each_partial_of_rates`] of nodes that follow one body or section.
    fn partials_of_rates(&self, node: usize, x: &[Node<D>], v: &[Node<D>]) -> Partials<D> {
        match self.owner(node) {
            NodeOwner::Rigid(index, is_second) => {
                let frame = &self.rigid[index];
                [
                    Some((frame.node, frame.partial_of_rates(is_second, x, v))),
                    None,
                ]
            }
            NodeOwner::Section(chain, k, _) => {
                let frame = self.sections[chain].frame(k);
                [frame.line, frame.node].map(|owner| Some((owner, no_block())))
            }
            _ => [Some((node, no_block())), None],
        }
    }
}

impl SectionFrame {
    /// Calls with the stiffness that forces on its axes add where it rotates, over the coordinates of the line's node and its
    /// rotations, pair by pair of nodes. Of a rotation `a + p t` with `a = t x du / |u|` the second order is
    /// `p (a x t) / 2 - a (t.du) / |u|`.
    pub fn for_each_geometric<const D: usize>(
        &self,
        f: &[Node<D>],
        x: &[Node<D>],
        mut add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        if self.has_shear {
            let (axes, forces) = (self.axes(x), axes_at(self.node, f));
            let turned = geometric(&axes, &forces);
            let block = rotation_block(&((turned + turned.transpose()) * 0.5));
            return add(self.node, self.node, &block);
        }
        let (axes, forces, slope) = (self.axes(x), axes_at(self.node, f), self.slope(x));
        let (stretch, t) = (slope.norm(), axes[0]);
        // Over small rotations in global components: sum (E.F) I - (F E^T + E F^T) / 2.
        let mut turning = Matrix3::zeros();
        let mut moment = Vector3::zeros();
        for (axis, force) in axes.iter().zip(&forces) {
            let product = force * axis.transpose();
            turning += Matrix3::from_diagonal_element(axis.dot(force))
                - (product + product.transpose()) * 0.5;
            moment += axis.cross(force);
        }
        let by_slope = t.cross_matrix() / stretch;
        let mut on_slope = by_slope.transpose() * turning * by_slope;
        let sheared = moment.cross(&t) * t.transpose() / (stretch * stretch);
        on_slope += sheared + sheared.transpose();
        let across = moment - t * moment.dot(&t);
        let mixed = by_slope.transpose() * turning * t - across * (0.5 / stretch);
        let on_turn = t.dot(&(turning * t));
        let [mut line, mut both, mut turn] = [no_block(), no_block(), no_block()];
        for r in 0..D {
            for c in 0..D {
                line[1][r][1][c] = on_slope[(r, c)];
            }
            both[1][0][1][r] = mixed[r];
        }
        turn[1][0][1][0] = on_turn;
        let (a, b) = (self.line, self.node);
        add(a, a, &line);
        add(b, a, &both);
        add(b, b, &turn);
    }

    /// Derivatives of one of its nodes' vectors by the coordinates of the line's node and by its rotation.
    fn partials<const D: usize>(
        &self,
        is_second: bool,
        x: &[Node<D>],
    ) -> [(usize, NodeBlock<D>); 2] {
        let (axes, slope) = (self.axes(x), self.slope(x));
        let [mut by_line, mut by_turn] = [no_block(), no_block()];
        let kept = if is_second { [1, 2] } else { [3, 0] };
        for (p, k) in kept.into_iter().enumerate().filter(|(_, k)| *k < 3) {
            if self.has_shear {
                for (turn, about) in axes.iter().enumerate().take(D) {
                    let change = about.cross(&axes[k]);
                    (0..D).for_each(|axis| by_turn[p][axis][1][turn] = change[axis]);
                }
                continue;
            }
            let turn = axes[0].cross(&axes[k]);
            for axis in 0..D {
                by_turn[p][axis][1][0] = turn[axis];
            }
            for along in 0..D {
                let change = angular(&slope, &Vector3::ith(along, 1.0), 0.0).cross(&axes[k]);
                for axis in 0..D {
                    by_line[p][axis][1][along] = change[axis];
                }
            }
        }
        if !is_second {
            (0..D).for_each(|axis| by_line[0][axis][0][axis] = 1.0);
        }
        [(self.line, by_line), (self.node, by_turn)]
    }
}
