//! Frame of a rigid body that rotates, and the points of the body that touch and are touched: markers whose place in the body follows from
//! where it is at this instant.

use nalgebra::SMatrix;

use crate::bodies::{Marker, Node};
use crate::math::jet::Number;
use crate::math::space::{Vector, components, perpendicular, perpendicular_matrix};
use crate::system::end::{Add, bilinear};

/// Frame of a rigid body that rotates: in its centre of mass, in space along its principal axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidFrame {
    /// The body, by its index in the system.
    body: usize,
    /// Its first node.
    node: usize,
}

impl RigidFrame {
    /// The frame of the body that a marker is on, which has to be rigid and to rotate.
    pub fn of(marker: &Marker) -> Self {
        Self {
            body: marker.body,
            node: marker.nodes[0],
        }
    }

    /// Nodes of the body in `D` dimensions.
    pub fn nodes<const D: usize>(&self) -> impl Iterator<Item = usize> + use<D> {
        self.node..self.node + D - 1
    }

    /// Unit vectors along the axes.
    fn axes<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> [Vector<D, N>; D] {
        let first = Vector::from(x[self.node][1]);
        std::array::from_fn(|k| match k {
            0 => first,
            _ if D == 2 => perpendicular(first),
            _ => Vector::from(x[self.node + 1][k - 1]),
        })
    }

    /// Components of a vector along the axes.
    pub fn along<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        vector: &Vector<D, N>,
    ) -> Vector<D, N> {
        let axes = self.axes(x);
        Vector::from_fn(|k, _| axes[k].dot(vector))
    }

    /// Components along the axes of the way from the centre of mass to a point, m.
    pub fn components<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        point: &Vector<D, N>,
    ) -> Vector<D, N> {
        self.along(x, &(point - Vector::from(x[self.node][0])))
    }

    /// A vector with these components along the axes.
    pub fn vector<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        of: &Vector<D, N>,
    ) -> Vector<D, N> {
        let axes = self.axes(x).into_iter().zip(of.iter());
        axes.fold(Vector::zeros(), |sum, (axis, part)| sum + axis * *part)
    }

    /// Where the point of the body with these components is, m.
    pub fn position<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        of: &Vector<D, N>,
    ) -> Vector<D, N> {
        Vector::from(x[self.node][0]) + self.vector(x, of)
    }

    /// The point of the body that is at a point, m.
    pub fn point<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        point: &Vector<D, N>,
    ) -> Marker<N> {
        let [a, b, c] = components(&self.components(x, point));
        let (zero, one) = (N::of(0.0), N::of(1.0));
        match D {
            2 => Marker::rigid(self.body, self.node, [a, b]),
            _ => Marker::framed(self.body, self.node, [a, b, c], [one, zero, zero]),
        }
    }

    /// Adds what a force that rotates with the axes adds to the stiffness: with the angular velocity `w` of the axes, `dw` of a variation
    /// and the way `g` from a point of this body to another marker, `dg . (F x w) + g' . (F x dw)`.
    pub fn add_rotation<const D: usize>(
        &self,
        x: &[Node<D>],
        (from, to): (&Marker, &Marker),
        force: &Vector<D>,
        add: Add<'_, D>,
    ) {
        let axes = self.axes(x);
        let mut add_along = |k: usize, on: &Marker, part: SMatrix<f64, D, D>| {
            let by: SMatrix<f64, D, D> = axes[k] * force.transpose() * part;
            bilinear([(to, 0), (on, 1)], by, &mut *add);
            bilinear([(from, 0), (on, 1)], -by, &mut *add);
        };
        if D == 2 {
            let on = Marker::rigid(self.body, self.node, [0.0; 2]);
            add_along(0, &on, SMatrix::identity());
            add_along(1, &on, perpendicular_matrix());
            return;
        }
        for k in 0..D {
            let direction = std::array::from_fn(|axis| if axis == k { 1.0 } else { 0.0 });
            let on = Marker::framed(self.body, self.node, [0.0; 3], direction);
            add_along(k, &on, SMatrix::identity());
        }
    }
}
