//! Points of patches: their place is a weighted sum of vectors of mesh nodes, their axes follow from two such sums of derivatives. The third
//! axis is the normal, the first two are the rotation of the polar decomposition in the tangent plane.
//!
//! Source: docs/decisions/0076-plates-and-shells.md; R. A. Horn, C. R. Johnson, Matrix Analysis, 2nd ed. (2013), section 7.3 (polar
//! decomposition).

use nalgebra::Vector3;

use super::{Patch, corner};
use crate::bodies::assembly::{NodeBlock, no_block};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{Axes, axes_at, axis_rates, set_axes_at};
use crate::elements::shell::{SurfaceFrame, VECTORS};
use crate::math::jet::{Jet, Number};
use crate::math::space::{components, vector};

/// Weights of the vectors of a mesh node.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeshWeights {
    /// First node of the mesh node.
    pub node: usize,
    /// In the place.
    pub position: [f64; VECTORS],
    /// In the derivatives along the orthonormal directions of the unstressed surface.
    pub along: [[f64; VECTORS]; 2],
}

impl MeshWeights {
    /// Without any weight.
    pub fn at(node: usize) -> Self {
        Self {
            node,
            position: [0.0; VECTORS],
            along: [[0.0; VECTORS]; 2],
        }
    }
}

/// A point of a patch with axes.
#[derive(Clone, Debug, Default)]
pub(super) struct PatchFrame {
    terms: Vec<MeshWeights>,
}

/// Derivatives along both directions, and what follows from them.
#[derive(Clone, Copy)]
struct Tangents<N: Number> {
    axes: Axes<N>,
    dual: [Vector3<N>; 2],
    /// Length whose direction is the first axis.
    stretch: N,
}

impl<N: Number> Tangents<N> {
    fn of([first, second]: &[Vector3<N>; 2]) -> Self {
        let SurfaceFrame { normal, dual } = SurfaceFrame::of(&(*first).into(), &(*second).into());
        let normal = Vector3::from(normal);
        let along = first + second.cross(&normal);
        let stretch = along.norm();
        let along = along / stretch;
        Self {
            axes: [along, normal.cross(&along), normal],
            dual: dual.map(Vector3::from),
            stretch,
        }
    }

    /// Rate of the normal, of rates of both derivatives.
    fn normal_rate(&self, rates: &[Vector3<N>; 2]) -> Vector3<N> {
        let [_, _, normal] = &self.axes;
        -(self.dual[0] * normal.dot(&rates[0]) + self.dual[1] * normal.dot(&rates[1]))
    }

    /// Angular velocity about the normal, times the stretch.
    fn twist(&self, rates: &[Vector3<N>; 2]) -> N {
        rates[0].dot(&self.axes[1]) - rates[1].dot(&self.axes[0])
    }

    /// Angular velocity of the axes in global components.
    fn spin(&self, rates: &[Vector3<N>; 2]) -> Vector3<N> {
        let normal = &self.axes[2];
        normal.cross(&self.normal_rate(rates)) + normal * (self.twist(rates) / self.stretch)
    }

    /// Angular acceleration in global components that rates alone ask for.
    fn spin_bias(&self, rates: &[Vector3<N>; 2]) -> Vector3<N> {
        let [e1, e2, normal] = &self.axes;
        let (turned, spin) = (self.normal_rate(rates), self.spin(rates));
        let about = self.twist(rates) / self.stretch;
        let dual_rate = |c: usize| {
            let dual = &self.dual[c];
            -(self.dual[0] * dual.dot(&rates[0])
                + self.dual[1] * dual.dot(&rates[1])
                + normal * dual.dot(&turned))
        };
        let mut second = Vector3::zeros();
        for c in 0..2 {
            second -= self.dual[c] * turned.dot(&rates[c]) + dual_rate(c) * normal.dot(&rates[c]);
        }
        let moved = rates[0].dot(&spin.cross(e2)) - rates[1].dot(&spin.cross(e1));
        let stretching = rates[0].dot(e1) + rates[1].dot(e2);
        normal.cross(&second)
            + normal * ((moved - about * stretching) / self.stretch)
            + turned * about
    }

    /// Forces on both derivatives that a moment in global components does as.
    fn forces(&self, moment: &Vector3<N>) -> [Vector3<N>; 2] {
        let [e1, e2, normal] = &self.axes;
        let about = moment.dot(normal) / self.stretch;
        let across = |c: usize| -normal * moment.dot(&normal.cross(&self.dual[c]));
        [across(0) + e2 * about, across(1) - e1 * about]
    }
}

impl PatchFrame {
    /// Adds weights.
    pub fn add(&mut self, term: &MeshWeights) {
        let Some(own) = self.terms.iter_mut().find(|own| own.node == term.node) else {
            return self.terms.push(*term);
        };
        for k in 0..VECTORS {
            own.position[k] += term.position[k];
            (0..2).for_each(|c| own.along[c][k] += term.along[c][k]);
        }
    }

    /// Divides all weights. Terms without any are left out.
    pub fn divide(&mut self, by: f64) {
        let weights = |term: &mut MeshWeights| {
            term.position = term.position.map(|weight| weight / by);
            term.along = term.along.map(|of| of.map(|weight| weight / by));
        };
        self.terms.iter_mut().for_each(weights);
        let weighs = |term: &MeshWeights| {
            let along = term.along.as_flattened();
            (term.position.iter().chain(along)).any(|weight| *weight != 0.0)
        };
        self.terms.retain(weighs);
    }

    /// First nodes of the mesh nodes that it follows.
    pub fn followed(&self) -> impl Iterator<Item = usize> {
        self.terms.iter().map(|term| term.node)
    }

    /// Place and derivatives, or their rates.
    fn sums<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> (Vector3<N>, [Vector3<N>; 2]) {
        let (mut position, mut along) = (Vector3::zeros(), [Vector3::zeros(); 2]);
        for term in &self.terms {
            for (k, v) in corner(term.node, x).into_iter().enumerate() {
                let v = Vector3::from(v);
                position += v * N::of(term.position[k]);
                along[0] += v * N::of(term.along[0][k]);
                along[1] += v * N::of(term.along[1][k]);
            }
        }
        (position, along)
    }

    /// Forces on mesh nodes of forces on place and derivatives: passed to `term`, node by node.
    fn spread<const D: usize, N: Number>(
        &self,
        (force, along): (&Vector3<N>, &[Vector3<N>; 2]),
        call: &mut impl FnMut(usize, &Node<D, N>),
    ) {
        for term in &self.terms {
            let on = [0, 1, 2, 3].map(|k| {
                let sum = force * N::of(term.position[k])
                    + along[0] * N::of(term.along[0][k])
                    + along[1] * N::of(term.along[1][k]);
                vector::<D, N>(sum.into()).into()
            });
            call(term.node, &[on[0], on[1]]);
            call(term.node + 1, &[on[2], on[3]]);
        }
    }
}

/// Whether nodes hold nothing.
fn is_nothing<const D: usize, N: Number>(nodes: &[Node<D, N>]) -> bool {
    let mut numbers = nodes.as_flattened().as_flattened().iter();
    numbers.all(|number| number.largest() == 0.0)
}

impl Patch {
    /// Points with their first nodes.
    fn frames(&self) -> impl Iterator<Item = (usize, &PatchFrame)> {
        (self.points.iter().enumerate()).map(|(index, frame)| (self.point_node(index), frame))
    }

    /// Writes places and axes of points at the mesh nodes in `x`.
    pub(super) fn place_points<const D: usize>(&self, x: &mut [Node<D>]) {
        for (node, frame) in self.frames() {
            let (position, along) = frame.sums(x);
            x[node][0] = vector::<D, f64>(position.into()).into();
            set_axes_at(node, &Tangents::of(&along).axes, x);
        }
    }

    /// Writes rates of points, or changes, of those of mesh nodes in `v`.
    pub(super) fn place_point_rates<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        v: &mut [Node<D, N>],
    ) {
        for (node, frame) in self.frames() {
            let (velocity, rates) = frame.sums(v);
            let axes = axes_at(node, x);
            let spin = Tangents::of(&frame.sums(x).1).spin(&rates);
            let own = Vector3::from_fn(|k, _| axes[k].dot(&spin));
            v[node][0] = vector::<D, N>(velocity.into()).into();
            set_axes_at(node, &axis_rates(&axes, &own), v);
        }
    }

    /// Adds to accelerations of axes of points what rates alone ask for.
    pub(super) fn add_point_bias<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        a: &mut [Node<D, N>],
    ) {
        for (node, frame) in self.frames() {
            let (tangents, rates) = (Tangents::of(&frame.sums(x).1), frame.sums(v).1);
            let (spin, bias) = (tangents.spin(&rates), tangents.spin_bias(&rates));
            let mut axes = axes_at(node, a);
            for (axis, sum) in tangents.axes.iter().zip(&mut axes) {
                *sum += spin.cross(&spin.cross(axis)) + bias.cross(axis);
            }
            set_axes_at(node, &axes, a);
        }
    }

    /// Takes a force in global components and a moment along the axes of a point to the mesh nodes that it follows.
    pub(in crate::bodies) fn pull_marker<const D: usize, N: Number>(
        &self,
        point: usize,
        (force, moment): (&[N; D], &Vector3<N>),
        x: &[Node<D, N>],
        term: &mut impl FnMut(usize, &Node<D, N>),
    ) {
        let frame = &self.points[point];
        let tangents = Tangents::of(&frame.sums(x).1);
        let [e1, e2, e3] = &tangents.axes;
        let moment = e1 * moment[0] + e2 * moment[1] + e3 * moment[2];
        let force = Vector3::from(components::<D, N>(&(*force).into()));
        frame.spread((&force, &tangents.forces(&moment)), term);
    }

    /// Takes forces on points to mesh nodes.
    pub(super) fn pull_points<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        f: &mut [Node<D, N>],
    ) {
        for (node, frame) in self.frames() {
            let on_point = [f[node], f[node + 1]];
            if is_nothing(&on_point) {
                continue;
            }
            f[node..][..2].fill([[N::of(0.0); D]; 2]);
            let force = Vector3::from(components::<D, N>(&on_point[0][0].into()));
            let tangents = Tangents::of(&frame.sums(x).1);
            let along = tangents.forces(&moment(&tangents.axes, &axes_at(0, &on_point)));
            frame.spread((&force, &along), &mut |node, term: &Node<D, N>| {
                let sums = f[node].as_flattened_mut().iter_mut();
                sums.zip(term.as_flattened())
                    .for_each(|(sum, part)| *sum += *part);
            });
        }
    }

    /// Calls with the derivatives of one of the nodes of a point by the coordinates of the mesh nodes that it follows.
    pub(in crate::bodies) fn for_each_partial<const D: usize>(
        &self,
        (point, is_second): (usize, bool),
        x: &[Node<D>],
        mut call: impl FnMut(usize, &NodeBlock<D>),
    ) {
        let frame = &self.points[point];
        let tangents = Tangents::of(&frame.sums(x).1);
        // Columns of the map from changes of a derivative to the rotation of the axes.
        let rotations = [0, 1].map(|c| {
            [0, 1, 2].map(|d| {
                let mut rates = [Vector3::zeros(); 2];
                rates[c][d] = 1.0;
                tangents.spin(&rates)
            })
        });
        let own: &[Option<usize>; 2] = if is_second {
            &[Some(1), Some(2)]
        } else {
            &[None, Some(0)]
        };
        for term in &frame.terms {
            for half in 0..2 {
                let mut block = no_block::<D>();
                for (q, k) in [2 * half, 2 * half + 1].into_iter().enumerate() {
                    for (p, axis) in own.iter().enumerate() {
                        for d in 0..D {
                            let Some(axis) = axis else {
                                block[p][d][q][d] = term.position[k];
                                continue;
                            };
                            let rotation = rotations[0][d] * term.along[0][k]
                                + rotations[1][d] * term.along[1][k];
                            let change = rotation.cross(&tangents.axes[*axis]);
                            (0..D).for_each(|r| block[p][r][q][d] = change[r]);
                        }
                    }
                }
                call(term.node + half, &block);
            }
        }
    }

    /// Calls with the symmetric stiffness of forces on the axes of points, over mesh nodes, for each pair once.
    pub(super) fn geometric_blocks<const D: usize>(
        &self,
        f: &[Node<D>],
        x: &[Node<D>],
        add: &mut impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        for (node, frame) in self.frames() {
            let on_axes: Axes = axes_at(node, f);
            if on_axes.iter().all(|force| force.norm_squared() == 0.0) {
                continue;
            }
            let stiffness = turning_stiffness(&frame.sums(x).1, &on_axes);
            let halves = frame.terms.iter().flat_map(|term| [(term, 0), (term, 1)]);
            let halves: Vec<(&MeshWeights, usize)> = halves.collect();
            for (a, (first, of_first)) in halves.iter().enumerate() {
                for (second, of_second) in &halves[..=a] {
                    let mut block = no_block::<D>();
                    for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        for (c, d) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                            let weight = first.along[c][2 * of_first + p]
                                * second.along[d][2 * of_second + q];
                            for r in 0..D {
                                for s in 0..D {
                                    block[p][r][q][s] += weight * stiffness[3 * c + r][3 * d + s];
                                }
                            }
                        }
                    }
                    add(first.node + of_first, second.node + of_second, &block);
                }
            }
        }
    }
}

/// Moment of forces on axes in global components, N m.
fn moment<N: Number>(axes: &Axes<N>, forces: &Axes<N>) -> Vector3<N> {
    let pairs = axes.iter().zip(forces);
    pairs.fold(Vector3::zeros(), |sum, (axis, force)| {
        sum + axis.cross(force)
    })
}

/// Symmetric stiffness over both derivatives of constant forces on the axes, by numbers that carry derivatives.
fn turning_stiffness(along: &[Vector3<f64>; 2], on_axes: &Axes) -> [[f64; 6]; 6] {
    let mut stiffness = [[0.0; 6]; 6];
    let forces = on_axes.map(|force| force.map(Jet::from_re));
    for column in 0..6 {
        let mut along = along.map(|v| v.map(Jet::from_re));
        along[column / 3][column % 3].v1 = 1.0;
        let tangents = Tangents::of(&along);
        let on = tangents.forces(&moment(&tangents.axes, &forces));
        for row in 0..6 {
            let change = -0.5 * on[row / 3][row % 3].v1;
            stiffness[row][column] += change;
            stiffness[column][row] += change;
        }
    }
    stiffness
}
