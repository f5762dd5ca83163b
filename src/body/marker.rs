//! Markers: material points of a body, found by a coordinate in [0, 1] whatever the mesh.

use nalgebra::SVector;

use crate::elements::{Element, Nodal, shape};

use super::FlexibleBody;

/// A material point.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Element it lies on.
    pub element: usize,
    /// Coordinate inside the element, in [0, 1].
    pub xi: f64,
    /// Shape functions there: position is `e * values`.
    pub values: SVector<f64, 4>,
    /// Their derivatives: slope is `e * slopes`.
    pub slopes: SVector<f64, 4>,
}

impl Marker {
    /// The node nearest to it; joints and loads act on nodes.
    pub fn node(&self) -> usize {
        self.element + usize::from(self.xi > 0.5)
    }

    /// Position, or velocity or acceleration where `e` holds rates.
    pub fn position<const D: usize>(&self, e: &[Nodal<D>]) -> SVector<f64, D> {
        e[self.element] * self.values
    }

    /// Slope, or its rate.
    pub fn slope<const D: usize>(&self, e: &[Nodal<D>]) -> SVector<f64, D> {
        e[self.element] * self.slopes
    }
}

impl<E: Element<D>, const D: usize, const B: usize> FlexibleBody<E, D, B> {
    /// The marker at a material coordinate in [0, 1] (fraction of the reference length).
    pub fn marker(&self, coordinate: f64) -> Marker {
        let target = coordinate * self.length();
        let (mut start, mut element) = (0.0, 0);
        while element + 1 < self.elements.len() && start + self.elements[element].length() <= target
        {
            start += self.elements[element].length();
            element += 1;
        }
        let length = self.elements[element].length();
        let xi = ((target - start) / length).clamp(0.0, 1.0);
        // A marker on a node must be on it exactly: reactions and loads act there.
        let xi = if xi < 1e-9 {
            0.0
        } else if xi > 1.0 - 1e-9 {
            1.0
        } else {
            xi
        };
        Marker {
            element,
            xi,
            values: shape::values(xi, length),
            slopes: shape::slopes(xi, length),
        }
    }
}
