//! Forces of eliminated joints, from what the nodes they hold lack for equilibrium:
//! `M e'' - F = Phi^T lambda` (report Eq. 20), solved node by node.

use nalgebra::{DMatrix, SMatrix, SVector};

use super::connectivity::Constraint;
use super::{FlexibleBody, elimination};
use crate::elements::{Element, Nodal};

/// Force and generalized force on the slope that a joint exerts on a body at one node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction<const D: usize> {
    /// Force on the position, N.
    pub force: SVector<f64, D>,
    /// Generalized force on the slope, N m.
    pub slope_force: SVector<f64, D>,
}

/// The independent constraint rows at one node.
#[derive(Clone, Debug)]
pub(super) struct Support<const B: usize> {
    pub(super) node: usize,
    /// Joint and coefficients over the node's coordinates.
    rows: Vec<(usize, SVector<f64, B>)>,
    /// `lambda = multipliers * force`, one row per row.
    multipliers: Vec<SVector<f64, B>>,
    /// Projector on the node's free directions.
    pub(super) free: SMatrix<f64, B, B>,
    /// Orthonormal directions that are held.
    pub(super) held: Vec<SVector<f64, B>>,
}

impl<const B: usize> Support<B> {
    pub(super) fn collect<const D: usize>(constraints: &[Constraint<D>]) -> Vec<Self> {
        let mut nodes: Vec<usize> = constraints.iter().map(|c| c.node).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
            .into_iter()
            .map(|node| Self::at(node, constraints))
            .collect()
    }

    fn at<const D: usize>(node: usize, constraints: &[Constraint<D>]) -> Self {
        // The same order as the elimination: rows over whole vectors first.
        let here = || constraints.iter().filter(|c| c.node == node);
        let ordered = here()
            .filter(|c| c.vector_row().is_some())
            .chain(here().filter(|c| c.vector_row().is_none()));
        let mut free = SMatrix::<f64, B, B>::identity();
        let (mut rows, mut held) = (Vec::new(), Vec::new());
        for constraint in ordered {
            for [position, slope] in constraint.component_rows() {
                let row =
                    SVector::<f64, B>::from_iterator(position.iter().chain(slope.iter()).copied());
                let rest = free * row;
                if rest.norm() <= elimination::RANK_TOLERANCE * row.norm() {
                    continue;
                }
                let unit = rest.normalize();
                free -= unit * unit.transpose();
                held.push(unit);
                rows.push((constraint.joint, row));
            }
        }
        let gram = DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i].1.dot(&rows[j].1));
        let inverse = gram
            .try_inverse()
            .unwrap_or_else(|| DMatrix::zeros(rows.len(), rows.len()));
        let multipliers = (0..rows.len())
            .map(|i| (0..rows.len()).map(|j| rows[j].1 * inverse[(i, j)]).sum())
            .collect();
        Self {
            node,
            rows,
            multipliers,
            free,
            held,
        }
    }
}

impl<E: Element<D>, const D: usize, const B: usize> FlexibleBody<E, D, B> {
    /// What a joint exerts on the body; `lack` is `F - M e''` of every element.
    pub fn reaction(&self, joint: usize, lack: &[Nodal<D>]) -> Reaction<D> {
        let mut total = SVector::<f64, B>::zeros();
        for support in &self.supports {
            let held = -self.nodal_sum(support.node, lack);
            for ((owner, row), multiplier) in support.rows.iter().zip(&support.multipliers) {
                if *owner == joint {
                    total += row * multiplier.dot(&held);
                }
            }
        }
        Reaction {
            force: SVector::from_fn(|axis, _| total[axis]),
            slope_force: SVector::from_fn(|axis, _| total[D + axis]),
        }
    }

    /// Force and generalized slope force that element `interface` exerts on its right neighbour
    /// through their common node (report Eq. 14), from `lack` as in [`Self::reaction`]. A load or
    /// joint at the node is counted with the right neighbour.
    pub fn connectivity_force(&self, interface: usize, lack: &[Nodal<D>]) -> Reaction<D> {
        let right = &lack[interface];
        Reaction {
            force: right.column(2).into(),
            slope_force: right.column(3).into(),
        }
    }

    fn nodal_sum(&self, node: usize, f: &[Nodal<D>]) -> SVector<f64, B> {
        let mut sum = SVector::zeros();
        let mut add = |element: usize, column: usize| {
            for axis in 0..D {
                sum[axis] += f[element][(axis, column)];
                sum[D + axis] += f[element][(axis, column + 1)];
            }
        };
        if node < f.len() {
            add(node, 0);
        }
        if node > 0 {
            add(node - 1, 2);
        }
        sum
    }
}
