//! From free coordinates `y` to nodal coordinates `x = N y` and back, for vectors and for matrices.

use std::ops::Range;

use super::connectivity::{Cluster, Dependent, Node, Row, clusters};
use crate::math::sparse::{Component, General, Matrix, Pattern, Slot};

/// A matrix over two nodes: by vector and axis of the one, then of the other.
pub type NodeBlock<const D: usize> = [[[[f64; D]; 2]; D]; 2];

/// A matrix over two nodes that is zero.
pub const fn no_block<const D: usize>() -> NodeBlock<D> {
    [[[[0.0; D]; 2]; D]; 2]
}

/// Where the coordinates of a node are.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// They are free: from here on in `y`.
    Alone(usize),
    /// They follow from those of a cluster: its index, first row of its basis.
    Tied(usize, usize),
}

/// How nodal coordinates follow from free ones.
#[derive(Clone, Debug)]
pub struct Assembly<const D: usize = 2> {
    pattern: Pattern,
    places: Vec<Place>,
    vertices: Vec<usize>,
    clusters: Vec<Cluster>,
    /// Where the free coordinates of every cluster are.
    ranges: Vec<Range<usize>>,
    /// Block of a node that is alone with itself.
    diagonal: Vec<Option<Slot>>,
    /// Block of a node with the one after it, where both are alone and linked.
    next: Vec<Option<Slot>>,
}

impl<const D: usize> Assembly<D> {
    /// For nodes under these rows, with matrices that couple the nodes of every link. Also says which
    /// rows depend on others.
    pub fn new(nodes: usize, rows: &[Row<D>], links: &[(usize, usize)]) -> (Self, Vec<Dependent>) {
        let (clusters, dependent) = clusters(nodes, rows);
        let mut tied = vec![None; nodes];
        for (index, cluster) in clusters.iter().enumerate() {
            for (row, node) in cluster.nodes.iter().enumerate() {
                tied[*node] = Some((index, row * 2 * D));
            }
        }
        // Vertices in the order of their first node, so that chains stay in order.
        let (mut vertices, mut sizes) = (vec![0; nodes], Vec::new());
        let mut of_cluster = vec![None; clusters.len()];
        for node in 0..nodes {
            vertices[node] = match tied[node] {
                None => {
                    sizes.push(2 * D);
                    sizes.len() - 1
                }
                Some((index, _)) => *of_cluster[index].get_or_insert_with(|| {
                    sizes.push(clusters[index].basis.ncols());
                    sizes.len() - 1
                }),
            };
        }
        let edges: Vec<_> = links
            .iter()
            .map(|(a, b)| (vertices[*a], vertices[*b]))
            .collect();
        let pattern = Pattern::new(&sizes, &edges);
        let place = |node: usize| match tied[node] {
            None => Place::Alone(pattern.range(vertices[node]).start),
            Some((index, row)) => Place::Tied(index, row),
        };
        let places: Vec<Place> = (0..nodes).map(place).collect();
        let slot = |a: usize, b: usize| pattern.slot(vertices[a], vertices[b]);
        let next = (0..nodes.saturating_sub(1))
            .map(|node| match (places[node], places[node + 1]) {
                (Place::Alone(_), Place::Alone(_)) => slot(node, node + 1),
                _ => None,
            })
            .collect();
        let diagonal = (0..nodes)
            .map(|node| match places[node] {
                Place::Alone(_) => slot(node, node),
                Place::Tied(..) => None,
            })
            .collect();
        let range = |v: &Option<usize>| v.map_or(0..0, |v| pattern.range(v));
        let assembly = Self {
            ranges: of_cluster.iter().map(range).collect(),
            diagonal,
            next,
            places,
            vertices,
            clusters,
            pattern,
        };
        (assembly, dependent)
    }

    /// Structure of matrices over the free coordinates.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
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

    /// Parts of the system without links between them.
    pub fn components(&self) -> &[Component] {
        self.pattern.components()
    }

    /// `x = N y`.
    pub fn spread(&self, y: &[f64], x: &mut [Node<D>]) {
        for (place, x) in self.places.iter().zip(x.iter_mut()) {
            if let Place::Alone(start) = place {
                x.as_flattened_mut()
                    .copy_from_slice(&y[*start..start + 2 * D]);
            }
        }
        for (cluster, range) in self.clusters.iter().zip(&self.ranges) {
            let y = &y[range.clone()];
            for (i, node) in cluster.nodes.iter().enumerate() {
                for (k, x) in x[*node].as_flattened_mut().iter_mut().enumerate() {
                    let row = cluster.basis.row(i * 2 * D + k);
                    *x = row.iter().zip(y).map(|(n, y)| n * y).sum();
                }
            }
        }
    }

    /// `y = N^T f`.
    pub fn gather(&self, f: &[Node<D>], y: &mut [f64]) {
        for (place, f) in self.places.iter().zip(f) {
            if let Place::Alone(start) = place {
                y[*start..start + 2 * D].copy_from_slice(f.as_flattened());
            }
        }
        for (cluster, range) in self.clusters.iter().zip(&self.ranges) {
            for (y, column) in y[range.clone()].iter_mut().zip(cluster.basis.column_iter()) {
                let nodes = cluster
                    .nodes
                    .iter()
                    .flat_map(|node| f[*node].as_flattened());
                *y = nodes.zip(column.iter()).map(|(f, n)| n * f).sum();
            }
        }
    }

    /// Adds to `y`, of which `first` is the first number, what a force on one node gathers to.
    pub fn gather_node(&self, node: usize, f: &Node<D>, first: usize, y: &mut [f64]) {
        let f = f.as_flattened();
        match self.places[node] {
            Place::Alone(start) => {
                let y = &mut y[start - first..];
                y.iter_mut().zip(f).for_each(|(y, f)| *y += f);
            }
            Place::Tied(index, row) => {
                // Nodes that are held or driven altogether are nowhere in `y`.
                if self.ranges[index].is_empty() {
                    return;
                }
                let range = self.ranges[index].start - first..self.ranges[index].end - first;
                let rows = self.clusters[index].basis.rows(row, 2 * D);
                for (y, column) in y[range].iter_mut().zip(rows.column_iter()) {
                    *y += column.iter().zip(f).map(|(n, f)| n * f).sum::<f64>();
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
        let values = &mut matrix.values[slot.at..slot.at + 4 * D * D];
        let values = values.as_chunks_mut::<D>().0.as_chunks_mut::<2>().0;
        let values = values.as_chunks_mut::<D>().0;
        for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            for r in 0..D {
                for c in 0..D {
                    values[p][r][q][c] += if slot.transposed {
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
        let alone = |node: usize| matches!(self.places[node], Place::Alone(_));
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
        for r in 0..m {
            for c in 0..n {
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
                let at = if slot.transposed {
                    c * m + r
                } else {
                    r * n + c
                };
                matrix.values[slot.at + at] += value;
                if a != b && va == vb {
                    matrix.values[slot.at + c * n + r] += value;
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
        let [of_a, of_b] = [a, b].map(|node| self.pattern.range(self.vertices[node]));
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
            Place::Alone(_) => f64::from(u8::from(row == column)),
            Place::Tied(index, first) => self.clusters[index].basis[(first + row, column)],
        }
    }
}
