//! Joints of edges and mesh lines of plates and shells. What holds them is linear in the coordinates of the mesh nodes on the ground and
//! between two surfaces, and is eliminated; on the frame of a body it keeps multipliers.
//!
//! Source: docs/decisions/0078-edges-of-plates.md.

use super::{ConstraintKind, Linear, Target};
use crate::bodies::ConnectivityRow;
use crate::math::space::Vector;

/// Conditions on the mesh nodes of a line of a plate or shell.
#[derive(Clone, Debug)]
pub struct Edge<const D: usize> {
    /// Index of its patch.
    pub patch: usize,
    /// First nodes of the mesh nodes of the line.
    pub nodes: Vec<usize>,
    /// The middle of the line, about which moments of the reaction are: the element and the place in it.
    pub middle: ([usize; 2], [f64; 2]),
    /// Nodes of the slopes across both lines, where a moment may act; none of a pin.
    pub moments: Vec<usize>,
    /// Rows that are eliminated, with their values.
    pub rows: Vec<(ConnectivityRow<D>, f64)>,
    /// Conditions that keep multipliers.
    pub constraints: Vec<ConstraintKind<D>>,
}

impl<const D: usize> Edge<D> {
    /// Linear rows of the edge, those of the joint with this index. Reactions follow from their terms on the nodes (`outputs/edge.rs`).
    pub(super) fn rows(&self, joint: usize) -> impl Iterator<Item = Linear<D>> {
        self.rows.iter().map(move |(row, value)| Linear {
            joint: Some(joint),
            row: row.clone(),
            target: Target::Fixed(*value),
            on_ends: [[Vector::zeros(); 2]; 2],
        })
    }

    /// Whether a node is one of the two of a mesh node of the line, and whether it is the first one, which has the position.
    pub fn holds(&self, node: usize) -> Option<bool> {
        let of_first = self.nodes.contains(&node);
        (of_first || self.nodes.iter().any(|first| first + 1 == node)).then_some(of_first)
    }
}
