//! From free coordinates `y` to nodal coordinates `x = N y` and back, for vectors and for matrices. Matrices of solves
//! are over the free coordinates and the multipliers of constraints, which stand between them.

use std::ops::Range;

use nalgebra::SMatrix;

use super::connectivity::{Cluster, ConnectivityRow, Dependent, Node, clusters, no_node};
use super::layout::{
    Entry, FreeRange, MultiplierConstraint, Tied, alone, components, entries, held, late,
    mass_pattern, runs, side_by_side, vertices,
};
use crate::math::sparse::{Cholesky, General, Matrix, Number, Pattern, Reach, Slot};

/// A matrix over two nodes: by vector and axis of the one, then of the other.
pub type NodeBlock<const D: usize> = [[[[f64; D]; 2]; D]; 2];

/// A matrix over two nodes that is zero.
pub const fn no_block<const D: usize>() -> NodeBlock<D> {
    [[[[0.0; D]; 2]; D]; 2]
}

/// A matrix over two nodes, by its parts over a vector of the one and a vector of the other.
pub fn block_of_parts<const D: usize>(
    part: impl Fn(usize, usize) -> SMatrix<f64, D, D>,
) -> NodeBlock<D> {
    let mut block = no_block();
    for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let part = part(p, q);
        for (r, c) in (0..D).flat_map(|r| (0..D).map(move |c| (r, c))) {
            block[p][r][q][c] = part[(r, c)];
        }
    }
    block
}

/// Nodes of an element of a surface, and pairs of them: the second one is no later one.
const SURFACE_NODES: usize = 8;
const SURFACE_PAIRS: usize = SURFACE_NODES * (SURFACE_NODES + 1) / 2;

/// Where the block of two nodes that are alone stands in the values of a matrix.
#[derive(Clone, Copy, Debug)]
struct BlockPlace {
    at: u32,
    is_transposed: bool,
}

/// Where the coordinates of a node are.
#[derive(Clone, Copy, Debug)]
enum NodeCoordinates {
    /// Free coordinates, which begin here in `y`.
    Alone(usize),
    /// Coordinates of a cluster: its index, and the first row of its basis.
    Tied(usize, usize),
}

/// Couplings between nodes, from which the sparsity patterns follow.
#[derive(Clone, Debug, Default)]
pub struct Links {
    /// Pairs that the mass couples.
    pub mass: Vec<(usize, usize)>,
    /// Pairs that stiffness and damping may couple besides.
    pub stiffness: Vec<(usize, usize)>,
    /// Nodes of each element of surfaces, which its mass couples.
    pub surfaces: Vec<[usize; SURFACE_NODES]>,
    /// Nodes that constraints with multipliers hold, and how many constraints there are on the same nodes.
    pub held: Vec<(Vec<usize>, usize)>,
}

/// How nodal coordinates follow from free ones.
#[derive(Clone, Debug)]
pub struct Assembly<const D: usize = 2> {
    /// Structure of matrices over the free coordinates and multipliers.
    pattern: Pattern,
    /// Structure of the mass, over the free coordinates alone.
    of_mass: Pattern,
    runs: Vec<FreeRange>,
    held: Vec<MultiplierConstraint>,
    /// Parts of the free coordinates without links between them.
    components: Vec<Range<usize>>,
    places: Vec<NodeCoordinates>,
    /// Runs of nodes that are alone, with the place of the first; and runs of those that are tied.
    alone: Vec<(Range<usize>, usize)>,
    tied: Vec<Range<usize>>,
    vertices: Vec<usize>,
    clusters: Vec<Cluster>,
    /// Nonzero entries of all bases, and the range of entries of every node.
    entries: Vec<Entry>,
    of_node: Vec<Range<usize>>,
    /// Where the free coordinates of every cluster are.
    ranges: Vec<Range<usize>>,
    /// Block of a node that is alone with itself.
    diagonal: Vec<Option<Slot>>,
    /// Block of a node with the one after it, where both are alone and linked.
    next: Vec<Option<Slot>>,
    /// Blocks of all pairs of nodes of each element of surfaces, where both are alone.
    of_elements: Vec<[Option<BlockPlace>; SURFACE_PAIRS]>,
}

/// Nodes of a pair of an element.
fn pair_of(pair: usize) -> [usize; 2] {
    let before = |a: usize| a * (a + 1) / 2;
    let a = (1..SURFACE_NODES)
        .take_while(|a| before(*a) <= pair)
        .count();
    [a, pair - before(a)]
}

impl<const D: usize> Assembly<D> {
    /// For nodes under these rows. Also says which rows depend on others.
    pub fn new(nodes: usize, rows: &[ConnectivityRow<D>], links: &Links) -> (Self, Vec<Dependent>) {
        let (clusters, dependent) = clusters(nodes, rows);
        let mut tied: Vec<Tied> = vec![None; nodes];
        for (index, cluster) in clusters.iter().enumerate() {
            for (row, node) in cluster.nodes.iter().enumerate() {
                tied[*node] = Some((index, row * 2 * D));
            }
        }
        let (vertices, sizes, of_cluster) = vertices::<D>(&tied, &clusters);
        let edge = |(a, b): &(usize, usize)| (vertices[*a], vertices[*b]);
        let mass_edges: Vec<_> = links.mass.iter().map(edge).collect();
        let first = sizes.len();
        let held = held(&links.held, &vertices, first);
        let mut edges = mass_edges.clone();
        edges.extend(links.stiffness.iter().map(edge));
        edges.extend(held.iter().flat_map(MultiplierConstraint::edges));
        let of_multipliers = links.held.iter().map(|(_, count)| *count);
        let all: Vec<usize> = sizes.iter().copied().chain(of_multipliers).collect();
        let pattern = Pattern::with_multipliers(&all, &edges, first);
        let late = late::<D>(
            (&links.surfaces, &vertices),
            (&clusters, &of_cluster),
            (&sizes, &mass_edges),
        );
        let of_mass = mass_pattern(&pattern, (&sizes, &mass_edges), &late);
        let place = |node: usize| match tied[node] {
            None => NodeCoordinates::Alone(of_mass.range(vertices[node]).start),
            Some((index, row)) => NodeCoordinates::Tied(index, row),
        };
        let places: Vec<NodeCoordinates> = (0..nodes).map(place).collect();
        let free = places.iter().map(|place| match place {
            NodeCoordinates::Alone(start) => Some(*start),
            NodeCoordinates::Tied(..) => None,
        });
        let alone = alone(free, 2 * D);
        let slot = |a: usize, b: usize| pattern.slot(vertices[a], vertices[b]);
        let next = (0..nodes.saturating_sub(1))
            .map(|node| match (places[node], places[node + 1]) {
                (NodeCoordinates::Alone(_), NodeCoordinates::Alone(_)) => slot(node, node + 1),
                _ => None,
            })
            .collect();
        let diagonal = (0..nodes)
            .map(|node| match places[node] {
                NodeCoordinates::Alone(_) => slot(node, node),
                NodeCoordinates::Tied(..) => None,
            })
            .collect();
        let of_element = |nodes: &[usize; SURFACE_NODES]| {
            std::array::from_fn(|pair| {
                let [a, b] = pair_of(pair).map(|k| nodes[k]);
                let are_alone = [a, b].map(|n| matches!(places[n], NodeCoordinates::Alone(_)));
                let slot = slot(a, b).filter(|_| are_alone == [true; 2])?;
                Some(BlockPlace {
                    at: u32::try_from(slot.at).ok()?,
                    is_transposed: slot.transposed,
                })
            })
        };
        let range = |v: &Option<usize>| v.map_or(0..0, |v| of_mass.range(v));
        let ranges: Vec<Range<usize>> = of_cluster.iter().map(range).collect();
        let (entries, of_node) = entries::<D>(&clusters, &ranges, nodes);
        let assembly = Self {
            ranges,
            entries,
            of_node,
            runs: runs(&pattern, &of_mass),
            components: components(&pattern, &sizes),
            held,
            diagonal,
            next,
            of_elements: links.surfaces.iter().map(of_element).collect(),
            alone,
            tied: side_by_side((0..nodes).filter(|node| tied[*node].is_some())),
            places,
            vertices,
            clusters,
            pattern,
            of_mass,
        };
        (assembly, dependent)
    }

    /// Number of free coordinates.
    pub fn free(&self) -> usize {
        self.of_mass.len()
    }

    /// Structure of matrices over the free coordinates and multipliers.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Structure of the mass, over the free coordinates alone.
    pub fn of_mass(&self) -> &Pattern {
        &self.of_mass
    }

    /// Copies free coordinates into a vector that a matrix can be applied to; multipliers become zero.
    pub fn put<T: Number>(&self, y: &[T], into: &mut [T]) {
        if into.len() > y.len() {
            into.fill(T::from(0.0));
        }
        for (free, at) in self.runs() {
            into[at].copy_from_slice(&y[free]);
        }
    }

    /// Copies the free coordinates out of such a vector.
    pub fn take<T: Number>(&self, from: &[T], y: &mut [T]) {
        for (free, at) in self.runs() {
            y[free].copy_from_slice(&from[at]);
        }
    }

    /// Free coordinates, side by side, and where they stand in vectors that matrices are applied to.
    pub fn runs(&self) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
        self.runs.iter().map(|FreeRange { free, start }| {
            let at = *start..*start + free.len();
            (free.clone(), at)
        })
    }

    /// Number of constraints with multipliers.
    pub fn constraints(&self) -> usize {
        self.held.len()
    }

    /// Where the multiplier of a constraint stands in vectors that matrices are applied to.
    pub fn multiplier(&self, constraint: usize) -> usize {
        let MultiplierConstraint { vertex, row, .. } = self.held[constraint];
        self.pattern.range(vertex).start + row
    }

    /// Adds a number where the multiplier of a constraint meets itself in a matrix.
    pub fn add_corner(&self, constraint: usize, value: f64, matrix: &mut Matrix<f64>) {
        let MultiplierConstraint { vertex, row, .. } = self.held[constraint];
        if let Some(slot) = self.pattern.slot(vertex, vertex) {
            matrix.values[slot.entry(row, row)] += value;
        }
    }

    /// The vertices that a constraint holds.
    pub fn held(&self, constraint: usize) -> &[usize] {
        &self.held[constraint].on
    }

    /// Returns the nonzero variables of `W^-1 y` for the forces `y` of a constraint.
    pub fn reach(&self, constraint: usize, factor: &Cholesky) -> Reach {
        factor.reach(&self.of_mass, &self.held[constraint].on)
    }

    /// Returns the nonzero variables of `W^-1 y` for forces `y` on one node.
    pub fn reach_of_node(&self, node: usize, factor: &Cholesky) -> Reach {
        factor.reach(&self.of_mass, &[self.vertices[node]])
    }

    /// The free coordinates that move a node, and others that they move with it.
    pub fn range_of(&self, node: usize) -> Range<usize> {
        self.of_mass.range(self.vertices[node])
    }

    /// Adds the derivatives of a constraint by one node to a matrix, in the row and column of its multiplier.
    pub fn add_gradient(
        &self,
        (constraint, node): (usize, usize),
        term: &Node<D>,
        matrix: &mut Matrix<f64>,
    ) {
        let MultiplierConstraint { vertex, row, .. } = self.held[constraint];
        let Some(slot) = self.pattern.slot(vertex, self.vertices[node]) else {
            return;
        };
        self.each_entry(node, |column, coordinate, weight| {
            let value = weight * term.as_flattened()[coordinate];
            matrix.values[slot.entry(row, column)] += value;
        });
    }

    /// Nodes that rows tie together.
    pub fn clusters(&self) -> &[Cluster] {
        &self.clusters
    }

    /// Where the free coordinates of a cluster are.
    pub fn cluster_range(&self, cluster: usize) -> Range<usize> {
        self.ranges[cluster].clone()
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.places.len()
    }

    /// The part of the system that a node belongs to and that no link leaves.
    pub fn component(&self, node: usize) -> usize {
        self.pattern.component_of(self.vertices[node])
    }

    /// The free coordinates of parts of the system without links between them.
    pub fn components(&self) -> &[Range<usize>] {
        &self.components
    }

    /// `x = N y`.
    pub fn prolong(&self, y: &[f64], x: &mut [Node<D>]) {
        for (nodes, start) in &self.alone {
            let x = x[nodes.clone()].as_flattened_mut().as_flattened_mut();
            x.copy_from_slice(&y[*start..*start + x.len()]);
        }
        for run in &self.tied {
            x[run.clone()].fill(no_node());
        }
        self.follow(y, x);
    }

    /// `x = start + N y`.
    pub fn prolong_from(&self, start: &[Node<D>], y: &[f64], x: &mut [Node<D>]) {
        for (nodes, first) in &self.alone {
            let x = x[nodes.clone()].as_flattened_mut().as_flattened_mut();
            let start = start[nodes.clone()].as_flattened().as_flattened();
            for ((x, start), y) in x.iter_mut().zip(start).zip(&y[*first..]) {
                *x = start + y;
            }
        }
        for run in &self.tied {
            x[run.clone()].copy_from_slice(&start[run.clone()]);
        }
        self.follow(y, x);
    }

    /// Adds how tied nodes follow the free coordinates.
    fn follow(&self, y: &[f64], x: &mut [Node<D>]) {
        let x = x.as_flattened_mut().as_flattened_mut();
        for entry in &self.entries {
            x[entry.at] += entry.value * y[entry.free];
        }
    }

    /// `y = N^T f`.
    pub fn restrict(&self, f: &[Node<D>], y: &mut [f64]) {
        for (nodes, start) in &self.alone {
            let f = f[nodes.clone()].as_flattened().as_flattened();
            y[*start..*start + f.len()].copy_from_slice(f);
        }
        for range in &self.ranges {
            y[range.clone()].fill(0.0);
        }
        let f = f.as_flattened().as_flattened();
        for entry in &self.entries {
            y[entry.free] += entry.value * f[entry.at];
        }
    }

    /// Adds to `y` what a force on one node is restricted to.
    pub fn restrict_node(&self, node: usize, f: &Node<D>, y: &mut [f64]) {
        let f = f.as_flattened();
        match self.places[node] {
            NodeCoordinates::Alone(start) => {
                let y = &mut y[start..];
                y.iter_mut().zip(f).for_each(|(y, f)| *y += f);
            }
            NodeCoordinates::Tied(..) => {
                for entry in &self.entries[self.of_node[node].clone()] {
                    y[entry.free] += entry.value * f[entry.coordinate];
                }
            }
        }
    }

    /// Adds a block over the nodes `a` and `b` to a symmetric matrix, and its transpose over `b` and
    /// `a` where they differ.
    #[inline(always)]
    pub fn add(&self, a: usize, b: usize, block: &NodeBlock<D>, matrix: &mut Matrix<f64>) {
        let slot = if a == b {
            self.diagonal[a]
        } else if b == a + 1 {
            self.next[a]
        } else if a == b + 1 {
            self.next[b].map(Slot::flipped)
        } else {
            None
        };
        let Some(slot) = slot else {
            return self.add_apart(a, b, block, matrix);
        };
        Self::add_at((slot.at, slot.transposed), block, matrix);
    }

    /// Adds a block over two nodes of an element of a surface, as [`Self::add`] does; the second of them is no later one in the element.
    #[inline(always)]
    pub fn add_of_element(
        &self,
        (element, nodes): (usize, &[usize; SURFACE_NODES]),
        (a, b): (usize, usize),
        block: &NodeBlock<D>,
        matrix: &mut Matrix<f64>,
    ) {
        let places = self.of_elements.get(element);
        match places.and_then(|places| places[a * (a + 1) / 2 + b]) {
            Some(BlockPlace { at, is_transposed }) => {
                Self::add_at((at as usize, is_transposed), block, matrix);
            }
            None => self.add(nodes[a], nodes[b], block, matrix),
        }
    }

    /// Adds a block over two nodes that are alone to the one that stands here, or to its transpose.
    #[inline(always)]
    fn add_at((at, is_transposed): (usize, bool), block: &NodeBlock<D>, matrix: &mut Matrix<f64>) {
        let values = &mut matrix.values[at..at + 4 * D * D];
        let values = values.as_chunks_mut::<D>().0.as_chunks_mut::<2>().0;
        let values = values.as_chunks_mut::<D>().0;
        for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            for r in 0..D {
                for c in 0..D {
                    values[p][r][q][c] += if is_transposed {
                        block[q][c][p][r]
                    } else {
                        block[p][r][q][c]
                    };
                }
            }
        }
    }

    /// [`Self::add`] where nodes are tied to others or do not follow each other.
    #[inline(never)]
    fn add_apart(&self, a: usize, b: usize, block: &NodeBlock<D>, matrix: &mut Matrix<f64>) {
        let alone = |node: usize| matches!(self.places[node], NodeCoordinates::Alone(_));
        if !(alone(a) && alone(b)) {
            return self.add_tied(a, b, block, matrix);
        }
        let Some(slot) = self.pattern.slot(self.vertices[a], self.vertices[b]) else {
            return;
        };
        let size = 2 * D;
        let values = &mut matrix.values[slot.at..slot.at + size * size];
        for (r, row) in block.as_flattened().iter().enumerate() {
            for (c, value) in row.as_flattened().iter().enumerate() {
                let at = if slot.transposed {
                    c * size + r
                } else {
                    r * size + c
                };
                values[at] += value;
            }
        }
    }

    fn add_tied(&self, a: usize, b: usize, block: &NodeBlock<D>, matrix: &mut Matrix<f64>) {
        let (va, vb) = (self.vertices[a], self.vertices[b]);
        let Some(slot) = self.pattern.slot(va, vb) else {
            return;
        };
        let (m, n) = (self.pattern.range(va).len(), self.pattern.range(vb).len());
        let (by_row, by_column) = if slot.transposed { (1, m) } else { (n, 1) };
        let values = &mut matrix.values[slot.at..slot.at + m * n];
        let twice = a != b && va == vb;
        self.each_entry(a, |r, i, left| {
            let row = block.as_flattened()[i].as_flattened();
            self.each_entry(b, |c, j, right| {
                let value = left * row[j] * right;
                values[r * by_row + c * by_column] += value;
                if twice {
                    values[c * n + r] += value;
                }
            });
        });
    }

    /// Calls with every free coordinate of its vertex that moves a node, counted from the first, the coordinate of the
    /// node that it moves, and how much.
    #[inline(always)]
    fn each_entry(&self, node: usize, mut call: impl FnMut(usize, usize, f64)) {
        match self.places[node] {
            NodeCoordinates::Alone(_) => (0..2 * D).for_each(|k| call(k, k, 1.0)),
            NodeCoordinates::Tied(index, _) => {
                let start = self.ranges[index].start;
                for entry in &self.entries[self.of_node[node].clone()] {
                    call(entry.free - start, entry.coordinate, entry.value);
                }
            }
        }
    }

    /// Adds a block over the rows of node `a` and the columns of node `b` to a matrix that need not be
    /// symmetric. What it adds to places that are not stored is told instead: row, column, value.
    pub fn add_block(
        &self,
        (a, b): (usize, usize),
        block: &NodeBlock<D>,
        matrix: &mut General<f64>,
        elsewhere: &mut dyn FnMut(usize, usize, f64),
    ) {
        let [of_a, of_b] = [a, b].map(|node| self.of_mass.range(self.vertices[node]));
        let slot = self.pattern.slot(self.vertices[a], self.vertices[b]);
        for r in 0..of_a.len() {
            for c in 0..of_b.len() {
                let mut value = 0.0;
                for (i, row) in block.as_flattened().iter().enumerate() {
                    let left = self.weight(a, i, r);
                    if left != 0.0 {
                        let sum = row
                            .as_flattened()
                            .iter()
                            .enumerate()
                            .map(|(j, k)| k * self.weight(b, j, c));
                        value += left * sum.sum::<f64>();
                    }
                }
                match slot {
                    Some(slot) => matrix.add_entry(slot, r, c, value),
                    None if value != 0.0 => elsewhere(of_a.start + r, of_b.start + c, value),
                    None => {}
                }
            }
        }
    }

    /// How much coordinate `row` of a node moves with the free coordinate `column` of its vertex.
    fn weight(&self, node: usize, row: usize, column: usize) -> f64 {
        match self.places[node] {
            NodeCoordinates::Alone(_) => f64::from(u8::from(row == column)),
            NodeCoordinates::Tied(index, first) => {
                self.clusters[index].basis[(first + row, column)]
            }
        }
    }
}
