//! Solves for the stages of an implicit method together, with one tangent that rotates along.
//!
//! The stage equations become one real and one complex system when all stages share a tangent. In
//! absolute coordinates they hardly do: a slope that rotates by `t` in a step rotates the axial stiffness
//! with it, and Newton's method diverges as soon as `EA t^2` outweighs inertia. So forces of every
//! stage are rotated back, node by node, to where the tangent was made, and displacements are rotated
//! forth again. Mass is isotropic and hardly notices; what is left of the rotation only slows convergence
//! down in proportion (docs/decisions/0005-corotated-newton.md).
//!
//! Nodes that are tied together rotate differently, and what is common to them cannot follow all. It
//! follows the stiff directions: a displacement is taken to the one that stretches every cable at the
//! joint as much as before, forces the opposite way.
//!
//! Rotating every node by itself changes sums over nodes. The translation of a part that nothing holds
//! is therefore put right before and after, so that momentum is kept exactly however far the
//! iteration goes.

mod sections;

use std::ops::Range;

use nalgebra::{Complex, SVector};

use super::Tangent;
use super::assembly::Assembly;
use super::connectivity::{Cluster, Node, no_node};
use super::elimination::Elimination;
use super::layout::side_by_side;
use crate::math::space::axis;
use crate::math::sparse::{Matrix, Pattern};
use sections::StageSections;

/// Most stages: one real and one complex system.
pub const STAGES: usize = 3;

/// Which nodes rotate with bodies, and how.
#[derive(Clone, Debug)]
pub struct RotatingNodes {
    /// Nodes that rotate with elastic lines, `[nodes]`.
    pub elastic: Vec<bool>,
    /// Nodes of sections and of what is inside elements, which do not rotate on their own, `[nodes]`.
    pub still: Vec<bool>,
    /// Nodes of reduced bodies, whose coordinates rotate with them as it is, `[nodes]`.
    pub modal: Vec<bool>,
    /// Nodes of lines with those of the sections that they rotate with.
    pub sections: Vec<(usize, usize)>,
    /// First nodes of mesh nodes of plates and shells, which rotate with their tangent planes.
    pub surfaces: Vec<usize>,
    /// Nodes of stiffeners, with the first nodes of the mesh nodes that they rotate with.
    pub stiffeners: Vec<(usize, usize)>,
}

/// Vectors of the stages and how far the directions of nodes have rotated.
#[derive(Clone, Debug)]
pub struct Stages<const D: usize> {
    nodes: Vec<Node<D>>,
    /// Unit directions where the tangent was made.
    base: Vec<SVector<f64, D>>,
    /// Unit directions at the stages.
    turned: [Vec<SVector<f64, D>>; STAGES],
    knots: Vec<TiedCluster>,
    /// Whether nodes belong to cables.
    elastic: Vec<bool>,
    /// Nodes whose vectors rotate by themselves, side by side. Rigid bodies of space have coordinates that rotate with them as it is.
    turning: Vec<Range<usize>>,
    /// Beams rotate with these.
    sections: StageSections,
    floating: Vec<Floating>,
}

/// Weights by which the motion of tied nodes follows each of them: along a cable, across it, and a
/// rigid body.
const ALONG: f64 = 1.0;
const ACROSS: f64 = 1e-3;
const RIGID: f64 = 1e-6;
/// Difference of rotations, rad, from which on tied nodes cannot each rotate by itself.
const APART: f64 = 3e-3;

/// How the free coordinates of a cluster with cables rotate at the stages: by least squares with the weights `W` above,
/// `(N^T W N)^-1 N^T W R N`.
#[derive(Clone, Debug)]
struct TiedCluster {
    cluster: usize,
    range: Range<usize>,
    /// Factors of `N^T W N` at the stages; what of it is the same in all directions.
    normal: [Matrix<f64>; STAGES],
    pattern: Pattern,
    across: Vec<f64>,
    /// Stages at which its nodes rotate apart: at others each node may rotate by itself.
    active: [bool; STAGES],
    /// Scratch: a vector of free coordinates.
    along: Vec<f64>,
}

/// A component that may move as a whole.
#[derive(Clone, Debug)]
struct Floating {
    range: Range<usize>,
    mass: f64,
    /// Unit translation along every axis, and mass times it.
    translation: Vec<Vec<f64>>,
    momentum: Vec<Vec<f64>>,
    before: Vec<f64>,
}

impl<const D: usize> Stages<D> {
    pub(super) fn new(
        elimination: &Elimination<D>,
        grounded: &[usize],
        rotating: &RotatingNodes,
    ) -> Self {
        let nodes = elimination.assembly.nodes();
        let directions = || vec![axis(0); nodes];
        let turns = |node: &usize| rotating.elastic[*node] || D == 2 && !rotating.modal[*node];
        Self {
            turning: side_by_side((0..nodes).filter(turns)),
            floating: floating::<D>(elimination, grounded, &rotating.still),
            knots: knots(&elimination.assembly, &rotating.elastic),
            elastic: rotating.elastic.clone(),
            sections: StageSections::new(rotating),
            nodes: vec![no_node(); nodes],
            base: directions(),
            turned: [directions(), directions(), directions()],
        }
    }

    /// The tangent is made at this configuration.
    pub fn set_base(&mut self, x: &[Node<D>]) {
        unit_directions(x, &self.turning, &mut self.base);
        self.sections.direct(&mut self.base);
        self.sections.set_base(x);
        for turned in &mut self.turned {
            turned.copy_from_slice(&self.base);
        }
    }

    /// Sets the configuration of a stage.
    pub fn set(&mut self, assembly: &Assembly<D>, stage: usize, x: &[Node<D>]) {
        unit_directions(x, &self.turning, &mut self.turned[stage]);
        self.sections.direct(&mut self.turned[stage]);
        self.sections.set(stage, x);
        let directions = (&self.base[..], &self.turned[stage][..]);
        for knot in &mut self.knots {
            let cluster = &assembly.clusters()[knot.cluster];
            knot.tie(cluster, stage, &self.elastic, directions);
        }
    }

    /// Whether no node rotates, by itself or with a section.
    fn is_still(&self) -> bool {
        self.turning.is_empty() && self.sections.is_empty()
    }

    /// Rotates the forces on a stage back to where the tangent was made; their sum stays.
    pub(super) fn rotate_to_tangent(
        &mut self,
        assembly: &Assembly<D>,
        stage: usize,
        y: &mut [f64],
    ) {
        if self.is_still() {
            return;
        }
        for f in &mut self.floating {
            f.remember(|f| &f.translation, y);
        }
        for knot in self.knots.iter().filter(|knot| knot.active[stage]) {
            knot.solve(stage, y);
        }
        assembly.prolong(y, &mut self.nodes);
        self.weigh(assembly, stage);
        let directions = [&self.turned[stage][..], &self.base];
        rotate_all(&mut self.nodes, &self.turning, directions);
        self.sections.rotate_to_tangent(stage, &mut self.nodes);
        assembly.restrict(&self.nodes, y);
        for f in &self.floating {
            f.restore((&f.translation, &f.momentum), y);
        }
    }

    /// Rotates displacements forth to a stage; their mean translation stays.
    pub(super) fn rotate_to_stage(&mut self, assembly: &Assembly<D>, stage: usize, y: &mut [f64]) {
        if self.is_still() {
            return;
        }
        for f in &mut self.floating {
            f.remember(|f| &f.momentum, y);
        }
        assembly.prolong(y, &mut self.nodes);
        let directions = [&self.base[..], &self.turned[stage]];
        rotate_all(&mut self.nodes, &self.turning, directions);
        self.sections.rotate_to_stage(stage, &mut self.nodes);
        self.weigh(assembly, stage);
        assembly.restrict(&self.nodes, y);
        for knot in self.knots.iter().filter(|knot| knot.active[stage]) {
            knot.solve(stage, y);
        }
        for f in &self.floating {
            f.restore((&f.momentum, &f.translation), y);
        }
    }

    /// Weighs the vectors of tied nodes whose directions rotate apart.
    fn weigh(&mut self, assembly: &Assembly<D>, stage: usize) {
        for knot in self.knots.iter().filter(|knot| knot.active[stage]) {
            for node in &assembly.clusters()[knot.cluster].nodes {
                for vector in &mut self.nodes[*node] {
                    let (v, to) = (SVector::from(*vector), &self.turned[stage][*node]);
                    *vector = if self.elastic[*node] {
                        to * (to.dot(&v) * (ALONG - ACROSS)) + v * ACROSS
                    } else {
                        v * RIGID
                    }
                    .into();
                }
            }
        }
    }
}

fn knots<const D: usize>(assembly: &Assembly<D>, elastic: &[bool]) -> Vec<TiedCluster> {
    let clusters = assembly.clusters().iter().enumerate();
    // A single node rotates as it is; without a cable nothing is stiff.
    let stiff = clusters.filter(|(_, c)| c.nodes.len() > 1 && c.nodes.iter().any(|n| elastic[*n]));
    stiff
        .filter(|(_, cluster)| cluster.basis.ncols() > 0)
        .map(|(index, cluster)| {
            let n = cluster.basis.ncols();
            let weight = |row: usize| {
                if elastic[cluster.nodes[row / (2 * D)]] {
                    ACROSS
                } else {
                    RIGID
                }
            };
            let pattern = Pattern::new(&[n], &[]);
            let mut across = Matrix::zeros(&pattern);
            for (i, row) in cluster.basis.row_iter().enumerate() {
                add_square(weight(i), row.transpose().as_slice(), &mut across.values);
            }
            TiedCluster {
                cluster: index,
                range: assembly.cluster_range(index),
                normal: [across.clone(), across.clone(), across.clone()],
                across: across.values,
                pattern,
                active: [false; STAGES],
                along: vec![0.0; n],
            }
        })
        .collect()
}

impl TiedCluster {
    /// Factors `N^T W N` at a stage.
    fn tie<const D: usize>(
        &mut self,
        cluster: &Cluster,
        stage: usize,
        elastic: &[bool],
        (base, turned): (&[SVector<f64, D>], &[SVector<f64, D>]),
    ) {
        // How differently two nodes rotate the direction of the first one.
        let first = cluster.nodes[0];
        let apart = |node: &usize| {
            let other = rotated(&base[*node], &turned[*node], &base[first]);
            (turned[first] - other).norm()
        };
        self.active[stage] = cluster.nodes.iter().map(apart).fold(0.0, f64::max) > APART;
        if !self.active[stage] {
            return;
        }
        let normal = &mut self.normal[stage];
        normal.values.copy_from_slice(&self.across);
        let nodes = cluster.nodes.iter().enumerate();
        for (i, node) in nodes.filter(|(_, node)| elastic[**node]) {
            for part in 0..2 {
                let rows = cluster.basis.fixed_rows::<D>((2 * i + part) * D);
                for (along, column) in self.along.iter_mut().zip(rows.column_iter()) {
                    *along = turned[*node].dot(&column);
                }
                add_square(ALONG - ACROSS, &self.along, &mut normal.values);
            }
        }
        self.active[stage] = normal.factor(&self.pattern).is_some();
    }

    /// Solves with the factors of a stage in place.
    fn solve(&self, stage: usize, y: &mut [f64]) {
        self.normal[stage].solve(&self.pattern, &mut y[self.range.clone()]);
    }
}

/// Adds a multiple of `a a^T` to a matrix by rows.
fn add_square(factor: f64, a: &[f64], matrix: &mut [f64]) {
    for (row, left) in matrix.chunks_exact_mut(a.len()).zip(a) {
        for (sum, right) in row.iter_mut().zip(a) {
            *sum += factor * left * right;
        }
    }
}

impl Floating {
    /// Keeps the products of `y` with these vectors.
    fn remember(&mut self, with: impl Fn(&Self) -> &Vec<Vec<f64>>, y: &[f64]) {
        let y = &y[self.range.clone()];
        for axis in 0..self.before.len() {
            self.before[axis] = dot(&with(self)[axis], y);
        }
    }

    /// Brings the products with the first vectors back by adding the second ones.
    fn restore(&self, (with, along): (&[Vec<f64>], &[Vec<f64>]), y: &mut [f64]) {
        let y = &mut y[self.range.clone()];
        for (axis, before) in self.before.iter().enumerate() {
            let change = (before - dot(&with[axis], y)) / self.mass;
            y.iter_mut()
                .zip(&along[axis])
                .for_each(|(y, v)| *y += change * v);
        }
    }
}

/// Components that uniform translation of all their nodes does not strain.
fn floating<const D: usize>(
    elimination: &Elimination<D>,
    grounded: &[usize],
    still: &[bool],
) -> Vec<Floating> {
    let assembly = &elimination.assembly;
    let (n, all) = (elimination.scratch(), assembly.pattern().len());
    let mut held = vec![false; assembly.components().len()];
    for node in grounded {
        held[assembly.component(*node)] = true;
    }
    let (mut translation, mut momentum) = (Vec::new(), Vec::new());
    for axis in 0..D {
        let mut unit: Node<D> = no_node();
        unit[0][axis] = 1.0;
        let mut x = vec![unit; assembly.nodes()];
        let held_still = x.iter_mut().zip(still).filter(|(_, still)| **still);
        held_still.for_each(|(x, _)| *x = no_node());
        let (mut y, mut product) = (vec![0.0; n], vec![0.0; n]);
        let [mut padded, mut sum] = [vec![0.0; all], vec![0.0; all]];
        assembly.restrict(&x, &mut y);
        let mut back = x.clone();
        assembly.prolong(&y, &mut back);
        for (node, (x, back)) in x.iter().zip(&back).enumerate() {
            let pairs = x.as_flattened().iter().zip(back.as_flattened());
            let change: f64 = pairs.map(|(a, b)| (a - b).abs()).sum();
            if change > 1e-9 {
                held[assembly.component(node)] = true;
            }
        }
        assembly.put(&y, &mut padded);
        elimination
            .mass
            .multiply(assembly.pattern(), &padded, &mut sum);
        assembly.take(&sum, &mut product);
        translation.push(y);
        momentum.push(product);
    }
    let components = assembly.components().iter().zip(held);
    components
        .filter(|(range, held)| !held && !range.is_empty())
        .map(|(range, _)| {
            let range = range.clone();
            let part = |of: &Vec<f64>| of[range.clone()].to_vec();
            Floating {
                mass: dot(&translation[0][range.clone()], &momentum[0][range.clone()]),
                translation: translation.iter().map(part).collect(),
                momentum: momentum.iter().map(part).collect(),
                before: vec![0.0; D],
                range,
            }
        })
        .collect()
}

impl<const D: usize> Tangent<D> {
    /// Solves in place, in the coordinates `q`, for as many stages as there are vectors. `forward` and `back` are square
    /// matrices by rows: the first takes the right-hand sides to one for the real factors, where their number is
    /// odd, then to real and imaginary part of one for the complex factors; the other takes the solutions to the
    /// stages.
    pub fn solve_stages(
        &mut self,
        elimination: &Elimination<D>,
        [forward, back]: [&[f64]; 2],
        q: &mut [Vec<f64>],
    ) {
        let assembly = &elimination.assembly;
        for (i, q) in q.iter_mut().enumerate() {
            elimination.forces(q);
            self.stages.rotate_to_tangent(assembly, i, q);
            if assembly.constraints() > 0 {
                self.y.copy_from_slice(q);
                elimination.project_in_place(&mut self.y);
                self.normals.measure(i, &self.y);
            }
        }
        match q.len() {
            1 => self.solve_together::<1>(assembly, [forward, back], q),
            2 => self.solve_together::<2>(assembly, [forward, back], q),
            _ => self.solve_together::<3>(assembly, [forward, back], q),
        }
        for (i, q) in q.iter_mut().enumerate() {
            self.stages.rotate_to_stage(assembly, i, q);
            elimination.coordinates_of(q);
        }
    }

    /// The solves themselves, over the free coordinates.
    fn solve_together<const S: usize>(
        &mut self,
        assembly: &Assembly<D>,
        [forward, back]: [&[f64]; 2],
        q: &mut [Vec<f64>],
    ) {
        let [forward, back] = [forward, back].map(|matrix| matrix.as_chunks::<S>().0);
        // The real system comes first.
        let (has_real, first) = (S % 2 == 1, S % 2);
        for (free, at) in assembly.runs() {
            let n = free.len();
            let q: [&[f64]; S] = std::array::from_fn(|i| &q[i][free.clone()][..n]);
            let (x, z) = (&mut self.x[at.clone()][..n], &mut self.z[at][..n]);
            for k in 0..n {
                let y: [f64; S] = std::array::from_fn(|i| q[i][k]);
                if has_real {
                    x[k] = product(&forward[0], &y);
                }
                if S > 1 {
                    let [re, im] = [first, first + 1].map(|row| product(&forward[row], &y));
                    z[k] = Complex::new(re, im);
                }
            }
        }
        self.ask_of_constraints(assembly, forward);
        if has_real {
            self.real.solve(assembly.pattern(), &mut self.x);
        }
        if S > 1 {
            self.complex.solve(assembly.pattern(), &mut self.z);
        }
        for (free, at) in assembly.runs() {
            let (x, z) = (&self.x[at.clone()], &self.z[at]);
            for (q, row) in q.iter_mut().zip(back) {
                for ((q, x), z) in q[free.clone()].iter_mut().zip(x).zip(z) {
                    let solution: [f64; S] = std::array::from_fn(|i| match i {
                        0 if has_real => *x,
                        i if i == first => z.re,
                        _ => z.im,
                    });
                    *q = product(row, &solution);
                }
            }
        }
    }

    /// Sets how far solutions are to leave the tangent plane of the constraints.
    fn ask_of_constraints<const S: usize>(&mut self, assembly: &Assembly<D>, forward: &[[f64; S]]) {
        let (real, complex) = (1.0 / self.inertia.0, self.inertia.1.inv());
        let (has_real, first) = (S % 2 == 1, S % 2);
        for constraint in 0..assembly.constraints() {
            let place = assembly.multiplier(constraint);
            (self.x[place], self.z[place]) = (0.0, Complex::new(0.0, 0.0));
        }
        for (place, parts) in self.normals.parts() {
            let of_stages = std::array::from_fn(|stage| parts[stage]);
            let mixed = |row: usize| product(&forward[row], &of_stages);
            if has_real {
                self.x[place] = real * mixed(0);
            }
            if S > 1 {
                self.z[place] = complex * Complex::new(mixed(first), mixed(first + 1));
            }
        }
    }
}

/// Directions that nodes rotate with.
fn unit_directions<const D: usize>(
    x: &[Node<D>],
    turning: &[Range<usize>],
    units: &mut [SVector<f64, D>],
) {
    for run in turning {
        for (x, unit) in x[run.clone()].iter().zip(&mut units[run.clone()]) {
            *unit = SVector::from(x[1]).normalize();
        }
    }
}

/// Rotates the vectors of nodes.
fn rotate_all<const D: usize>(
    nodes: &mut [Node<D>],
    turning: &[Range<usize>],
    directions: [&[SVector<f64, D>]; 2],
) {
    for run in turning {
        let [from, to] = directions.map(|of| &of[run.clone()]);
        for (x, (from, to)) in nodes[run.clone()].iter_mut().zip(from.iter().zip(to)) {
            turn(from, to, x);
        }
    }
}

/// Rotates the vectors of a node by the smallest rotation that takes the unit vector `from` to `to`.
fn turn<const D: usize>(from: &SVector<f64, D>, to: &SVector<f64, D>, x: &mut Node<D>) {
    for vector in x {
        *vector = rotated(from, to, &SVector::from(*vector)).into();
    }
}

/// A vector rotated by the smallest rotation that takes the unit vector `from` to `to`.
pub(super) fn rotated<const D: usize>(
    from: &SVector<f64, D>,
    to: &SVector<f64, D>,
    v: &SVector<f64, D>,
) -> SVector<f64, D> {
    let sum = from + to;
    let scale = 1.0 + from.dot(to);
    if scale < 1e-6 {
        // Opposite directions have no smallest rotation, and the step is far too long anyway.
        return *v;
    }
    v - sum * (sum.dot(v) * (1.0 / scale)) + to * (2.0 * from.dot(v))
}

fn product<const S: usize>(a: &[f64; S], b: &[f64; S]) -> f64 {
    let products = a.iter().zip(b).map(|(a, b)| a * b);
    products.fold(0.0, |sum, product| sum + product)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
