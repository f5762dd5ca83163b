//! Derivatives of forces by the coordinates of a few nodes, on numbers that carry derivatives.

use nalgebra::DMatrix;

use super::Bodies;
use super::assembly::{Assembly, NodeBlock, no_block};
use super::connectivity::{Node, map_node};
use crate::elements;
use crate::math::jet::Jet;
use crate::math::sparse::General;

/// Part of a block that its transpose must differ by to count as not symmetric.
pub const SKEW: f64 = 1e-10;

/// Nodal vectors that carry derivatives, of which few at a time are not zero.
pub struct Probe<const D: usize> {
    x: Vec<Node<D, Jet>>,
    v: Vec<Node<D, Jet>>,
    f: Vec<Node<D, Jet>>,
}

/// Nodal vectors of numbers that carry derivatives.
pub type Nodes<const D: usize> = [Node<D, Jet>];

impl<const D: usize> Probe<D> {
    /// At nodal coordinates and rates.
    pub fn new(x: &[Node<D>], v: &[Node<D>]) -> Self {
        let lift = |x: &[Node<D>]| x.iter().map(|x| map_node(x, Jet::from_re)).collect();
        Self {
            x: lift(x),
            v: lift(v),
            f: vec![[[Jet::from_re(0.0); D]; 2]; x.len()],
        }
    }

    /// Minus the derivatives, by coordinates or rates, of forces on these nodes that depend on no others.
    pub fn differentiate(
        &mut self,
        nodes: &[usize],
        by_rates: bool,
        force: &dyn Fn(&Nodes<D>, &Nodes<D>, &mut Nodes<D>),
    ) -> NodeBlocks {
        let mut nodes = nodes.to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        let size = 2 * D * nodes.len();
        let mut whole = DMatrix::zeros(size, size);
        for (j, column) in nodes.iter().enumerate() {
            for c in 0..2 * D {
                let seeded = if by_rates { &mut self.v } else { &mut self.x };
                seeded[*column].as_flattened_mut()[c].v1 = 1.0;
                force(&self.x, &self.v, &mut self.f);
                let seeded = if by_rates { &mut self.v } else { &mut self.x };
                seeded[*column].as_flattened_mut()[c].v1 = 0.0;
                for (i, row) in nodes.iter().enumerate() {
                    let none = [[Jet::from_re(0.0); D]; 2];
                    let force = std::mem::replace(&mut self.f[*row], none);
                    for (r, force) in force.as_flattened().iter().enumerate() {
                        whole[(2 * D * i + r, 2 * D * j + c)] = -force.v1;
                    }
                }
            }
        }
        NodeBlocks { nodes, whole }
    }
}

/// A block over two nodes.
fn part<const D: usize>(whole: &DMatrix<f64>, i: usize, j: usize) -> NodeBlock<D> {
    let mut block = no_block::<D>();
    for (r, row) in block.as_flattened_mut().iter_mut().enumerate() {
        for (c, entry) in row.as_flattened_mut().iter_mut().enumerate() {
            *entry = whole[(2 * D * i + r, 2 * D * j + c)];
        }
    }
    block
}

/// A matrix over a few nodes.
pub struct NodeBlocks {
    nodes: Vec<usize>,
    whole: DMatrix<f64>,
}

impl NodeBlocks {
    /// The matrix over two nodes, vector by vector.
    pub fn vectors<const D: usize>(&self) -> elements::Blocks<D> {
        let part = |r: usize, c: usize| self.whole.fixed_view::<D, D>(r * D, c * D).into();
        std::array::from_fn(|r| std::array::from_fn(|c| part(r, c)))
    }

    /// Over nodes.
    pub fn new(nodes: &[usize], whole: DMatrix<f64>) -> Self {
        let nodes = nodes.to_vec();
        Self { nodes, whole }
    }

    /// Transforms the matrix to the coordinates of bodies at this configuration: rotations replace axes.
    pub fn pulled<const D: usize>(self, bodies: &Bodies<D>, x: &[Node<D>]) -> Self {
        if bodies.has_no_frames() {
            return self;
        }
        let (nodes, change) = self.changes(|node, call| bodies.for_each_partial(node, x, call));
        Self {
            whole: change.transpose() * self.whole * change,
            nodes,
        }
    }

    /// Adds, over the coordinates of bodies, what derivatives by rates make of those that small rotations change: the axes of a
    /// body that is rotated by `p` have the rates `p x e'`.
    pub fn add_by_rates_of_axes<const D: usize>(
        &mut self,
        by_rates: &Self,
        bodies: &Bodies<D>,
        (x, v): (&[Node<D>], &[Node<D>]),
    ) {
        if bodies.has_no_frames() {
            return;
        }
        let (nodes, change) = by_rates.changes(|node, call| bodies.for_each_partial(node, x, call));
        let (_, turned) = by_rates.changes(|node, call| {
            bodies.for_each_partial_of_rates(node, (x, v), call);
        });
        debug_assert_eq!(nodes, self.nodes);
        self.whole += change.transpose() * &by_rates.whole * turned;
    }

    /// Nodes that stand for bodies, and derivatives of all vectors by their coordinates.
    fn changes<const D: usize>(
        &self,
        partials_at: impl Fn(usize, &mut dyn FnMut(usize, &NodeBlock<D>)),
    ) -> (Vec<usize>, DMatrix<f64>) {
        let mut partials = Vec::new();
        for (i, node) in self.nodes.iter().enumerate() {
            partials_at(*node, &mut |owner, partial| {
                partials.push((i, owner, *partial))
            });
        }
        let mut nodes: Vec<usize> = Vec::new();
        for (_, owner, _) in &partials {
            if !nodes.contains(owner) {
                nodes.push(*owner);
            }
        }
        let size = 2 * D;
        let mut change = DMatrix::zeros(size * self.nodes.len(), size * nodes.len());
        for (i, owner, partial) in &partials {
            let j = nodes.iter().position(|node| node == owner);
            let j = j.expect("every owner is among the nodes");
            for (r, row) in partial.as_flattened().iter().enumerate() {
                for (c, entry) in row.as_flattened().iter().enumerate() {
                    change[(size * i + r, size * j + c)] += *entry;
                }
            }
        }
        (nodes, change)
    }

    /// The whole matrix, over the numbers of its nodes in their order.
    pub fn into_whole(self) -> DMatrix<f64> {
        self.whole
    }

    /// Whether it is symmetric up to roundoff.
    pub fn is_symmetric(&self) -> bool {
        (&self.whole - self.whole.transpose()).amax() <= SKEW * self.whole.amax()
    }

    /// Adds the matrix to one over the free coordinates. What it adds to places that are not stored is told instead: row, column, value.
    pub fn add<const D: usize>(
        &self,
        assembly: &Assembly<D>,
        matrix: &mut General<f64>,
        elsewhere: &mut dyn FnMut(usize, usize, f64),
    ) {
        for (i, row) in self.nodes.iter().enumerate() {
            for (j, column) in self.nodes.iter().enumerate() {
                let block = part(&self.whole, i, j);
                assembly.add_block((*row, *column), &block, matrix, elsewhere);
            }
        }
    }
}
