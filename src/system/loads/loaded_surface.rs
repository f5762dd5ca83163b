//! The plate or shell that a load acts on, element by element.

use nalgebra::Matrix3;

use super::Add;
use crate::bodies::{Bodies, Node, Patch, block_of_parts};
use crate::elements::shell::ElementCorners;
use crate::math::jet::Number;

/// The plate or shell that a load acts on: its index among all of them.
#[derive(Clone, Copy, Debug)]
pub struct LoadedSurface(pub usize);

impl LoadedSurface {
    /// The patch.
    pub fn patch<const D: usize>(self, bodies: &Bodies<D>) -> &Patch {
        &bodies.patches()[self.0]
    }

    /// Number of its elements.
    pub(super) fn count<const D: usize>(self, bodies: &Bodies<D>) -> usize {
        self.patch(bodies).elements().len()
    }

    /// Nodes of each element, on which forces there depend and act.
    pub(super) fn parts<const D: usize>(self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        let patch = self.patch(bodies);
        let elements = 0..self.count(bodies);
        elements
            .map(|element| patch.element_nodes(element).to_vec())
            .collect()
    }

    /// Adds forces on the corners of an element.
    pub(super) fn add<const D: usize, N: Number>(
        self,
        bodies: &Bodies<D>,
        element: usize,
        (force, f): (&ElementCorners<N>, &mut [Node<D, N>]),
    ) {
        self.patch(bodies).add_to(element, force, f);
    }

    /// Adds a symmetric matrix over the vectors of the corners of an element.
    pub(super) fn add_matrix<const D: usize>(
        self,
        bodies: &Bodies<D>,
        element: usize,
        (blocks, add): (&[[Matrix3<f64>; 16]; 16], Add<'_, D>),
    ) {
        let nodes = self.patch(bodies).element_nodes(element);
        for (i, a) in nodes.iter().enumerate() {
            for (j, b) in nodes.iter().enumerate().take(i + 1) {
                let block = block_of_parts::<D>(|p, q| {
                    blocks[2 * i + p][2 * j + q].fixed_view::<D, D>(0, 0).into()
                });
                add(*a, *b, &block);
            }
        }
    }
}
