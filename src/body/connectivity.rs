//! Linear constraints of a body, the rows of `Phi`: connectivity of its elements and what joints to
//! ground hold at its nodes.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eqs. 17-18. Connectivity needs no list: every
//! interior node ties position and slope of two neighbours.

use nalgebra::SVector;

/// What a joint holds at a node. Every row keeps the value that it has in the reference
/// configuration, so constraints never contradict each other; they may repeat each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint<const D: usize> {
    /// Node, 0 at the first end.
    pub node: usize,
    /// What is held there.
    pub hold: Hold<D>,
    /// Index of the joint that asks for it.
    pub joint: usize,
}

/// Rows of `Phi` at one node.
#[derive(Clone, Debug, PartialEq)]
pub enum Hold<const D: usize> {
    /// All components of the position: one row times the identity of space.
    Position,
    /// One component of the position, along this unit vector.
    PositionAlong(SVector<f64, D>),
    /// One component of the slope, along this unit vector.
    SlopeAlong(SVector<f64, D>),
}

impl<const D: usize> Constraint<D> {
    /// Coefficients of the node's position and slope when the row applies to whole vectors.
    pub(super) fn vector_row(&self) -> Option<[f64; 2]> {
        match self.hold {
            Hold::Position => Some([1.0, 0.0]),
            _ => None,
        }
    }

    /// Rows over the components of the node's position (first) and slope.
    pub(super) fn component_rows(&self) -> Vec<[SVector<f64, D>; 2]> {
        let zero = SVector::zeros();
        match self.hold {
            Hold::Position => (0..D)
                .map(|axis| {
                    [
                        SVector::from_fn(|i, _| f64::from(u8::from(i == axis))),
                        zero,
                    ]
                })
                .collect(),
            Hold::PositionAlong(direction) => vec![[direction, zero]],
            Hold::SlopeAlong(direction) => vec![[zero, direction]],
        }
    }
}
