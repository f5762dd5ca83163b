//! From free coordinates `y` to nodal coordinates `x = N y` and back, for vectors and for matrices.

use std::ops::Range;

use super::connectivity::{Cluster, Dependent, Node, Row, clusters};
use crate::math::sparse::{Component, General, Matrix, Pattern, Slot};

/// A matrix over two nodes.
pub type NodeBlock<const B: usize> = [[f64; B]; B];

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
pub struct Assembly<const B: usize> {
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

impl<const B: usize> Assembly<B> {
    /// For nodes under these rows, with matrices that couple the nodes of every link. Also says which
    /// rows depend on others.
    pub fn new(nodes: usize, rows: &[Row<B>], links: &[(usize, usize)]) -> (Self, Vec<Dependent>) {
        let (clusters, dependent) = clusters(nodes, rows);
        let mut tied = vec![None; nodes];
        for (index, cluster) in clusters.iter().enumerate() {
            for (row, node) in cluster.nodes.iter().enumerate() {
                tied[*node] = Some((index, row * B));
            }
        }
        // Vertices in the order of their first node, so that chains stay in order.
        let (mut vertices, mut sizes) = (vec![0; nodes], Vec::new());
        let mut of_cluster = vec![None; clusters.len()];
        for node in 0..nodes {
            vertices[node] = match tied[node] {
                None => {
                    sizes.push(B);
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
    pub fn spread(&self, y: &[f64], x: &mut [Node<B>]) {
        for (place, x) in self.places.iter().zip(x.iter_mut()) {
            if let Place::Alone(start) = place {
                x.copy_from_slice(&y[*start..start + B]);
            }
        }
        for (cluster, range) in self.clusters.iter().zip(&self.ranges) {
            let y = &y[range.clone()];
            for (i, node) in cluster.nodes.iter().enumerate() {
                for k in 0..B {
                    let row = cluster.basis.row(i * B + k);
                    x[*node][k] = row.iter().zip(y).map(|(n, y)| n * y).sum();
                }
            }
        }
    }

    /// `y = N^T f`.
    pub fn gather(&self, f: &[Node<B>], y: &mut [f64]) {
        for (place, f) in self.places.iter().zip(f) {
            if let Place::Alone(start) = place {
                y[*start..start + B].copy_from_slice(f);
            }
        }
        for (cluster, range) in self.clusters.iter().zip(&self.ranges) {
            for (y, column) in y[range.clone()].iter_mut().zip(cluster.basis.column_iter()) {
                let nodes = cluster.nodes.iter().flat_map(|node| &f[*node]);
                *y = nodes.zip(column.iter()).map(|(f, n)| n * f).sum();
            }
        }
    }

    /// Adds to `y`, of which `first` is the first number, what a force on one node gathers to.
    pub fn gather_node(&self, node: usize, f: &Node<B>, first: usize, y: &mut [f64]) {
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
                let rows = self.clusters[index].basis.rows(row, B);
                for (y, column) in y[range].iter_mut().zip(rows.column_iter()) {
                    *y += column.iter().zip(f).map(|(n, f)| n * f).sum::<f64>();
                }
            }
        }
    }

    /// Adds a block over the nodes `a` and `b` to a symmetric matrix, and its transpose over `b` and
    /// `a` where they differ.
    #[inline(always)]
    pub fn add(&self, a: usize, b: usize, block: &NodeBlock<B>, matrix: &mut Matrix<f64>) {
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
        let values = &mut matrix.values[slot.at..slot.at + B * B];
        let rows = values.as_chunks_mut::<B>().0;
        for r in 0..B {
            for c in 0..B {
                rows[r][c] += if slot.transposed {
                    block[c][r]
                } else {
                    block[r][c]
                };
            }
        }
    }

    /// [`Self::add`] where nodes are tied to others or do not follow each other.
    #[inline(never)]
    fn add_apart(&self, a: usize, b: usize, block: &NodeBlock<B>, matrix: &mut Matrix<f64>) {
        let alone = |node: usize| matches!(self.places[node], Place::Alone(_));
        if !(alone(a) && alone(b)) {
            return self.add_tied(a, b, block, matrix);
        }
        let Some(slot) = self.pattern.slot(self.vertices[a], self.vertices[b]) else {
            return;
        };
        let values = &mut matrix.values[slot.at..slot.at + B * B];
        for (r, row) in block.iter().enumerate() {
            for (c, value) in row.iter().enumerate() {
                let at = if slot.transposed {
                    c * B + r
                } else {
                    r * B + c
                };
                values[at] += value;
            }
        }
    }

    fn add_tied(&self, a: usize, b: usize, block: &NodeBlock<B>, matrix: &mut Matrix<f64>) {
        let (va, vb) = (self.vertices[a], self.vertices[b]);
        let Some(slot) = self.pattern.slot(va, vb) else {
            return;
        };
        let (m, n) = (self.pattern.range(va).len(), self.pattern.range(vb).len());
        for r in 0..m {
            for c in 0..n {
                let mut value = 0.0;
                for (i, row) in block.iter().enumerate() {
                    let left = self.weight(a, i, r);
                    if left != 0.0 {
                        let sum = row
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
        block: &NodeBlock<B>,
        matrix: &mut General<f64>,
        elsewhere: &mut dyn FnMut(usize, usize, f64),
    ) {
        let [of_a, of_b] = [a, b].map(|node| self.pattern.range(self.vertices[node]));
        let slot = self.pattern.slot(self.vertices[a], self.vertices[b]);
        for r in 0..of_a.len() {
            for c in 0..of_b.len() {
                let mut value = 0.0;
                for (i, row) in block.iter().enumerate() {
                    let left = self.weight(a, i, r);
                    if left != 0.0 {
                        let sum = row
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
