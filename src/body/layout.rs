//! Where free coordinates and multipliers stand: in vectors of the former alone, and in those that matrices are applied
//! to, where multipliers stand between them.

use std::ops::Range;

use super::connectivity::{Cluster, Node};
use crate::math::sparse::{Component, Pattern};

/// A constraint with a multiplier.
#[derive(Clone, Debug)]
pub(super) struct Held {
    /// Vertex of its multiplier and place among those of this vertex.
    pub vertex: usize,
    pub row: usize,
    /// The vertices that it holds.
    pub on: Vec<usize>,
}

/// The bases of all clusters, but for what of them is zero.
#[derive(Clone, Debug, Default)]
pub(super) struct Bases {
    /// Free coordinate and value.
    entries: Vec<(usize, f64)>,
    /// Node, coordinate of it, and its entries; node by node.
    rows: Vec<(usize, usize, Range<usize>)>,
    /// Rows of every node.
    of_node: Vec<Range<usize>>,
}

impl Held {
    pub fn edges(&self) -> impl Iterator<Item = (usize, usize)> {
        self.on.iter().map(|v| (self.vertex, *v))
    }
}

/// Numbers that stand side by side in vectors of free coordinates and in those of matrices.
#[derive(Clone, Debug)]
pub(super) struct Run {
    pub free: Range<usize>,
    pub start: usize,
}

/// Constraints one by one; vertices of their multipliers are counted on from `first`.
pub(super) fn held(held: &[(Vec<usize>, usize)], vertices: &[usize], first: usize) -> Vec<Held> {
    let mut constraints = Vec::new();
    for (index, (nodes, count)) in held.iter().enumerate() {
        let mut on: Vec<usize> = nodes.iter().map(|node| vertices[*node]).collect();
        on.sort_unstable();
        on.dedup();
        constraints.extend((0..*count).map(|row| Held {
            vertex: first + index,
            row,
            on: on.clone(),
        }));
    }
    constraints
}

/// Where the free coordinates stand between multipliers.
pub(super) fn runs(pattern: &Pattern, of_mass: &Pattern) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for v in of_mass.order() {
        let (free, start) = (of_mass.range(*v), pattern.range(*v).start);
        match runs.last_mut() {
            _ if free.is_empty() => {}
            Some(run) if run.start + run.free.len() == start => run.free.end = free.end,
            _ => runs.push(Run { free, start }),
        }
    }
    runs
}

/// The free coordinates of every component of a pattern; vertices with sizes are no multipliers.
pub(super) fn components(pattern: &Pattern, sizes: &[usize]) -> Vec<Range<usize>> {
    let mut start = 0;
    let range = |component: &Component| {
        let vertices = pattern.order()[component.vertices.clone()].iter();
        let size: usize = vertices.filter_map(|v| sizes.get(*v)).sum();
        start += size;
        start - size..start
    };
    pattern.components().iter().map(range).collect()
}

/// A node's cluster and its first row in the basis, if it is tied.
pub(super) type Tied = Option<(usize, usize)>;

/// Vertices of all nodes and their sizes, in the order of their first node so that chains stay in order; those of
/// clusters.
pub(super) fn vertices<const D: usize>(
    tied: &[Tied],
    clusters: &[Cluster],
) -> (Vec<usize>, Vec<usize>, Vec<Option<usize>>) {
    let mut sizes = Vec::new();
    let mut of_cluster = vec![None; clusters.len()];
    let vertex = |tied: &Tied| match tied {
        None => {
            sizes.push(2 * D);
            sizes.len() - 1
        }
        Some((index, _)) => *of_cluster[*index].get_or_insert_with(|| {
            sizes.push(clusters[*index].basis.ncols());
            sizes.len() - 1
        }),
    };
    let vertices = tied.iter().map(vertex).collect();
    (vertices, sizes, of_cluster)
}

impl Bases {
    /// Of clusters whose free coordinates have these ranges.
    pub fn new<const D: usize>(
        clusters: &[Cluster],
        ranges: &[Range<usize>],
        nodes: usize,
    ) -> Self {
        let mut bases = Self {
            of_node: vec![0..0; nodes],
            ..Self::default()
        };
        for (cluster, range) in clusters.iter().zip(ranges) {
            for (row, node) in cluster.nodes.iter().enumerate() {
                let first = bases.rows.len();
                for coordinate in 0..2 * D {
                    let start = bases.entries.len();
                    let basis = cluster.basis.row(2 * D * row + coordinate);
                    let values = basis.iter().enumerate().filter(|(_, value)| **value != 0.0);
                    let stored = values.map(|(column, value)| (range.start + column, *value));
                    bases.entries.extend(stored);
                    let own = start..bases.entries.len();
                    bases.rows.push((*node, coordinate, own));
                }
                bases.of_node[*node] = first..bases.rows.len();
            }
        }
        bases
    }

    /// The coordinates of a node, each with its entries.
    pub fn of(&self, node: usize) -> impl Iterator<Item = (usize, &[(usize, f64)])> {
        let rows = self.rows[self.of_node[node].clone()].iter();
        rows.map(|(_, coordinate, own)| (*coordinate, &self.entries[own.clone()]))
    }

    /// Coordinates of tied nodes from free ones.
    pub fn prolong<const D: usize>(&self, y: &[f64], x: &mut [Node<D>]) {
        for (node, coordinate, own) in &self.rows {
            let products = self.entries[own.clone()]
                .iter()
                .map(|(free, value)| value * y[*free]);
            x[*node].as_flattened_mut()[*coordinate] = products.sum();
        }
    }

    /// Adds to `y` what forces on tied nodes are restricted to (`N^T f`).
    pub fn restrict<const D: usize>(&self, f: &[Node<D>], y: &mut [f64]) {
        for (node, coordinate, own) in &self.rows {
            let force = f[*node].as_flattened()[*coordinate];
            for (free, value) in &self.entries[own.clone()] {
                y[*free] += value * force;
            }
        }
    }
}
