//! Where free coordinates and multipliers stand: in vectors of the former alone, and in those that matrices are applied
//! to, where multipliers stand between them.

use std::collections::BTreeSet;
use std::ops::Range;

use super::connectivity::Cluster;
use crate::math::sparse::{GraphComponent, Pattern, graph, parts};

/// A constraint with a multiplier.
#[derive(Clone, Debug)]
pub(super) struct MultiplierConstraint {
    /// Vertex of its multiplier and place among those of this vertex.
    pub vertex: usize,
    pub row: usize,
    /// The vertices that it holds.
    pub on: Vec<usize>,
}

/// An entry of the basis of a cluster that is not zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    /// Free coordinate.
    pub free: usize,
    /// Coordinate, among those of all nodes and of its own.
    pub at: usize,
    pub coordinate: usize,
    pub value: f64,
}

impl MultiplierConstraint {
    pub fn edges(&self) -> impl Iterator<Item = (usize, usize)> {
        self.on.iter().map(|v| (self.vertex, *v))
    }
}

/// Numbers that stand side by side in vectors of free coordinates and in those of matrices.
#[derive(Clone, Debug)]
pub(super) struct FreeRange {
    pub free: Range<usize>,
    pub start: usize,
}

/// Runs of nodes whose coordinates are free and stand side by side, from the places of those that are: the nodes, and
/// where their first free coordinate stands.
pub(super) fn alone(
    places: impl Iterator<Item = Option<usize>>,
    size: usize,
) -> Vec<(Range<usize>, usize)> {
    let mut runs: Vec<(Range<usize>, usize)> = Vec::new();
    for (node, start) in places.enumerate() {
        match (runs.last_mut(), start) {
            (Some((nodes, first)), Some(start))
                if nodes.end == node && *first + size * nodes.len() == start =>
            {
                nodes.end += 1;
            }
            (_, Some(start)) => runs.push((node..node + 1, start)),
            (_, None) => {}
        }
    }
    runs
}

/// Constraints one by one; vertices of their multipliers are counted on from `first`.
pub(super) fn held(
    held: &[(Vec<usize>, usize)],
    vertices: &[usize],
    first: usize,
) -> Vec<MultiplierConstraint> {
    let mut constraints = Vec::new();
    for (index, (nodes, count)) in held.iter().enumerate() {
        let mut on: Vec<usize> = nodes.iter().map(|node| vertices[*node]).collect();
        on.sort_unstable();
        on.dedup();
        constraints.extend((0..*count).map(|row| MultiplierConstraint {
            vertex: first + index,
            row,
            on: on.clone(),
        }));
    }
    constraints
}

/// Where the free coordinates stand between multipliers.
pub(super) fn runs(pattern: &Pattern, of_mass: &Pattern) -> Vec<FreeRange> {
    let mut runs: Vec<FreeRange> = Vec::new();
    for v in of_mass.order() {
        let (free, start) = (of_mass.range(*v), pattern.range(*v).start);
        match runs.last_mut() {
            _ if free.is_empty() => {}
            Some(run) if run.start + run.free.len() == start => run.free.end = free.end,
            _ => runs.push(FreeRange { free, start }),
        }
    }
    runs
}

/// The free coordinates of every component of a pattern; vertices with sizes are no multipliers.
pub(super) fn components(pattern: &Pattern, sizes: &[usize]) -> Vec<Range<usize>> {
    let mut start = 0;
    let range = |component: &GraphComponent| {
        let vertices = pattern.order()[component.vertices.clone()].iter();
        let size: usize = vertices.filter_map(|v| sizes.get(*v)).sum();
        start += size;
        start - size..start
    };
    pattern.components().iter().map(range).collect()
}

/// Runs of ascending numbers that follow each other.
pub fn side_by_side(numbers: impl Iterator<Item = usize>) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for number in numbers {
        match runs.last_mut() {
            Some(run) if run.end == number => run.end += 1,
            _ => runs.push(number..number + 1),
        }
    }
    runs
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

/// Which vertices the mass may eliminate last: clusters whose free coordinates depend on the direction, on parts that surfaces belong to. All that
/// is eliminated before them has numbers times the identity of space. `edges` are those of the mass.
pub(super) fn late<const D: usize>(
    (surfaces, vertices): (&[[usize; 8]], &[usize]),
    (clusters, of_cluster): (&[Cluster], &[Option<usize>]),
    (sizes, edges): (&[usize], &[(usize, usize)]),
) -> Vec<bool> {
    let mut late = vec![false; sizes.len()];
    if surfaces.is_empty() {
        return late;
    }
    let of_surface: BTreeSet<usize> = (surfaces.as_flattened().iter())
        .map(|node| vertices[*node])
        .collect();
    for (cluster, vertex) in clusters.iter().zip(of_cluster) {
        if let Some(vertex) = vertex {
            late[*vertex] = !cluster.is_isotropic::<D>();
        }
    }
    for part in parts(&graph(sizes, edges)) {
        if !part.iter().any(|v| of_surface.contains(v)) {
            part.iter().for_each(|v| late[*v] = false);
        }
    }
    late
}

/// The structure of the mass: in the order of the whole matrix, or with vertices that are `late` last where substitutions are less work then.
pub(super) fn mass_pattern(
    pattern: &Pattern,
    (sizes, edges): (&[usize], &[(usize, usize)]),
    late: &[bool],
) -> Pattern {
    let as_it_is = pattern.of_part(sizes, edges, &vec![false; sizes.len()]);
    if !late.contains(&true) {
        return as_it_is;
    }
    let with_late = pattern.of_part(sizes, edges, late);
    let [before, after] = [&as_it_is, &with_late].map(|of| of.substitution_in_space(late));
    if after < before { with_late } else { as_it_is }
}

/// Lists the nonzero entries of the bases of clusters, node by node, and the range of entries of every node, `[nodes]`.
pub(super) fn entries<const D: usize>(
    clusters: &[Cluster],
    ranges: &[Range<usize>],
    nodes: usize,
) -> (Vec<Entry>, Vec<Range<usize>>) {
    let (mut entries, mut of_node) = (Vec::new(), vec![0..0; nodes]);
    for (cluster, range) in clusters.iter().zip(ranges) {
        for (row, node) in cluster.nodes.iter().enumerate() {
            let first = entries.len();
            for coordinate in 0..2 * D {
                let basis = cluster.basis.row(2 * D * row + coordinate);
                let stored = basis.iter().enumerate().filter(|(_, value)| **value != 0.0);
                entries.extend(stored.map(|(column, value)| Entry {
                    free: range.start + column,
                    at: 2 * D * node + coordinate,
                    coordinate,
                    value: *value,
                }));
            }
            of_node[*node] = first..entries.len();
        }
    }
    (entries, of_node)
}
