//! Points of bodies: their position and direction are linear in the coordinates of one or two nodes.

use nalgebra::{SMatrix, Vector3};

use super::Chain;
use super::assembly::{NodeBlock, no_block};
use super::connectivity::{ConnectivityRow, Node, add_node};
use crate::elements::{Element, shape};
use crate::math::jet::Number;
use crate::math::space::{Vector, perpendicular, perpendicular_matrix};
use crate::math::vector::norm;

/// A point of a body, with a direction: the slope of a cable, the unit vector of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker<N = f64> {
    /// The body, by its index in the system.
    pub body: usize,
    /// The nodes that it depends on.
    pub nodes: [usize; 2],
    /// Weights of position and direction of both nodes in the position.
    values: [N; 4],
    /// Weights of position and direction of both nodes in the direction.
    slopes: [N; 4],
    /// Weight, in the position, of the first node's direction rotated left by a right angle, m; planar bodies.
    across: N,
    /// Element of a cable and the place inside it, in [0, 1].
    pub element: Option<(usize, f64)>,
}

/// Derivatives of a vector by position and direction of a node.
pub type Partial<const D: usize> = [SMatrix<f64, D, D>; 2];

impl Marker {
    /// A vector that is a weighted sum of those of two nodes, or of one that stands twice, as a direction; the position is that of the first.
    pub fn weighted(body: usize, nodes: [usize; 2], weights: [f64; 4]) -> Self {
        Self {
            body,
            nodes,
            values: [1.0, 0.0, 0.0, 0.0],
            slopes: weights,
            across: 0.0,
            element: None,
        }
    }

    /// The section of a planar beam at a node of its line: its position is that of the line, its direction that of the section's node.
    pub fn sheared(body: usize, nodes: [usize; 2]) -> Self {
        Self {
            body,
            nodes,
            values: [1.0, 0.0, 0.0, 0.0],
            slopes: [0.0, 0.0, 0.0, 1.0],
            across: 0.0,
            element: None,
        }
    }

    /// Returns a marker at the point of this one on a rigid body in space, with another direction.
    pub fn directed(&self, direction: [f64; 3]) -> Self {
        let [a, b, c] = direction;
        Self {
            slopes: [0.0, a, b, c],
            ..*self
        }
    }

    /// The point of a cable at a length along it, m.
    pub fn along<E: Element<D>, const D: usize>(
        body: usize,
        chain: &Chain<E, D>,
        length: f64,
    ) -> Self {
        let (element, xi) = chain.find(length);
        // A marker on a node must be on it exactly: joints and loads act there.
        let xi = if xi < 1e-9 {
            0.0
        } else if xi > 1.0 - 1e-9 {
            1.0
        } else {
            xi
        };
        Self::inside(body, chain, element, xi)
    }

    /// The point of a cable inside an element, `xi` in [0, 1].
    pub fn inside<E: Element<D>, const D: usize>(
        body: usize,
        chain: &Chain<E, D>,
        element: usize,
        xi: f64,
    ) -> Self {
        let mut marker = Self::within(body, chain, element, xi);
        if xi == 0.0 || xi == 1.0 {
            let node = marker.nodes[usize::from(xi == 1.0)];
            marker.nodes = [node, node];
            marker.values = [1.0, 0.0, 0.0, 0.0];
            marker.slopes = [0.0, 1.0, 0.0, 0.0];
        }
        marker
    }

    /// Distance of a point of a rigid body from the centre of mass, m.
    pub fn arm(&self) -> f64 {
        match self.values {
            [_, a, 0.0, 0.0] => a.hypot(self.across),
            [_, a, b, c] => norm(&[a, b, c]),
        }
    }

    /// Converts the weights of the marker to constants of another number type.
    #[inline(always)]
    pub fn lift<N: Number>(&self) -> Marker<N> {
        Marker {
            body: self.body,
            nodes: self.nodes,
            values: self.values.map(N::of),
            slopes: self.slopes.map(N::of),
            across: N::of(self.across),
            element: self.element,
        }
    }

    /// Jacobian of position (`part` 0) or direction (1) by the coordinates of each node.
    pub fn jacobian<const D: usize>(&self, part: usize) -> [(usize, Partial<D>); 2] {
        let weights = if part == 0 {
            &self.values
        } else {
            &self.slopes
        };
        let across = if part == 0 { self.across } else { 0.0 };
        let one = SMatrix::<f64, D, D>::identity();
        [
            (
                self.nodes[0],
                [
                    one * weights[0],
                    one * weights[1] + perpendicular_matrix() * across,
                ],
            ),
            (self.nodes[1], [one * weights[2], one * weights[3]]),
        ]
    }

    /// Calls with the blocks, for each pair of nodes once, of the matrix `k` over its position (`part` 0) or direction (1).
    pub fn for_each_block<const D: usize>(
        &self,
        part: usize,
        k: &SMatrix<f64, D, D>,
        mut call: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let terms = self.jacobian::<D>(part);
        let terms = &terms[..if self.is_nodal() { 1 } else { 2 }];
        for (a, of_a) in terms {
            for (b, of_b) in terms.iter().filter(|(b, _)| a <= b) {
                call(*a, *b, &block_of(of_a, of_b, k));
            }
        }
    }

    /// Adds what a force along `position` on the position and along `direction` on the direction
    /// would do, as terms of a row.
    pub fn add_terms<const D: usize>(
        &self,
        position: Vector<D>,
        direction: Vector<D>,
        row: &mut ConnectivityRow<D>,
    ) {
        for (node, part) in self.forces(position, direction) {
            match row.terms.iter_mut().find(|(other, _)| *other == node) {
                Some((_, sum)) => add_node(sum, 1.0, &part),
                None if part != [[0.0; D]; 2] => row.terms.push((node, part)),
                None => {}
            }
        }
    }
}

impl<N: Number> Marker<N> {
    /// The point of a planar rigid body at `(x, y)` in its frame, m, or a particle.
    pub fn rigid(body: usize, node: usize, point: [N; 2]) -> Self {
        let (zero, one) = (N::of(0.0), N::of(1.0));
        Self {
            body,
            nodes: [node, node],
            values: [one, point[0], zero, zero],
            slopes: [zero, one, zero, zero],
            across: point[1],
            element: None,
        }
    }

    /// The point of a rigid body of space, and a direction there: their components along its axes, m and 1.
    pub fn framed(body: usize, node: usize, point: [N; 3], direction: [N; 3]) -> Self {
        let ([a, b, c], [d, e, f]) = (point, direction);
        let (zero, one) = (N::of(0.0), N::of(1.0));
        Self {
            body,
            nodes: [node, node + 1],
            values: [one, a, b, c],
            slopes: [zero, d, e, f],
            across: zero,
            element: None,
        }
    }

    /// Whether it is a node of a cable, or belongs to a rigid body: then the second node weighs nothing.
    pub fn is_nodal(&self) -> bool {
        self.nodes[0] == self.nodes[1]
    }

    /// The point with so much of its own direction and so much of that of another marker there.
    pub fn blended(&self, own: N, other: &Self, its: N) -> Self {
        let slope = |k: usize| own * self.slopes[k] + its * other.slopes[k];
        Self {
            slopes: std::array::from_fn(slope),
            ..*self
        }
    }

    /// Whether it belongs to a rigid body of space that rotates: to both of its nodes, of which the second follows the first.
    pub fn is_framed(&self) -> bool {
        self.element.is_none() && self.nodes[1] == self.nodes[0] + 1
    }

    /// Components along the axes of a rigid body of space: of the point, m, and of the direction.
    pub fn components(&self) -> [Vector3<N>; 2] {
        [self.values, self.slopes].map(|[_, a, b, c]| Vector3::new(a, b, c))
    }

    /// How far along its direction a point of a rigid body is from the centre of mass, m.
    pub fn offset(&self) -> N {
        self.values[1]
    }

    /// The point of a cable inside an element, which may move along it: `xi` has derivatives then.
    pub fn within<E: Element<D>, const D: usize>(
        body: usize,
        chain: &Chain<E, D>,
        element: usize,
        xi: N,
    ) -> Self {
        let length = chain.elements()[element].length();
        Self {
            body,
            nodes: chain.nodes(element),
            values: shape::values(xi, length).into(),
            slopes: shape::slopes(xi, length).into(),
            across: N::of(0.0),
            element: Some((element, xi.plain())),
        }
    }

    /// Position, or velocity or acceleration where `x` holds rates.
    #[inline(always)]
    pub fn position<const D: usize>(&self, x: &[Node<D, N>]) -> Vector<D, N> {
        let [p, s, q, t] = self.values;
        let a = &x[self.nodes[0]];
        let mut sum = Vector::from_fn(|k, _| p * a[0][k] + s * a[1][k]);
        if self.is_nodal() {
            sum[0] -= self.across * a[1][1];
            sum[1] += self.across * a[1][0];
        } else {
            let b = &x[self.nodes[1]];
            sum += Vector::from_fn(|k, _| q * b[0][k] + t * b[1][k]);
        }
        sum
    }

    /// Direction (not of unit length on a cable), or its rate.
    #[inline(always)]
    pub fn direction<const D: usize>(&self, x: &[Node<D, N>]) -> Vector<D, N> {
        let [p, s, q, t] = self.slopes;
        let a = &x[self.nodes[0]];
        let own = Vector::from_fn(|k, _| p * a[0][k] + s * a[1][k]);
        if self.is_nodal() {
            return own;
        }
        let b = &x[self.nodes[1]];
        own + Vector::from_fn(|k, _| q * b[0][k] + t * b[1][k])
    }

    /// Forces on the nodes of a force on the position and one on the direction.
    #[inline(always)]
    pub fn forces<const D: usize>(
        &self,
        position: Vector<D, N>,
        direction: Vector<D, N>,
    ) -> [(usize, Node<D, N>); 2] {
        let part = |k: usize, across: N| {
            let at = position * self.values[2 * k] + direction * self.slopes[2 * k];
            let on = position * self.values[2 * k + 1] + direction * self.slopes[2 * k + 1]
                - perpendicular(position) * across;
            [at.into(), on.into()]
        };
        [
            (self.nodes[0], part(0, self.across)),
            (self.nodes[1], part(1, N::of(0.0))),
        ]
    }

    /// Adds such forces.
    #[inline(always)]
    pub fn add_force<const D: usize>(
        &self,
        position: Vector<D, N>,
        direction: Vector<D, N>,
        f: &mut [Node<D, N>],
    ) {
        for (node, part) in self.forces(position, direction) {
            let sums = f[node].as_flattened_mut().iter_mut();
            for (sum, part) in sums.zip(part.as_flattened()) {
                *sum += *part;
            }
        }
    }
}

/// `p^T k q` of the derivatives of two vectors by position and direction of a node each.
pub fn block_of<const D: usize>(
    p: &Partial<D>,
    q: &Partial<D>,
    k: &SMatrix<f64, D, D>,
) -> NodeBlock<D> {
    let mut block = no_block();
    for (i, p) in p.iter().enumerate() {
        for (j, q) in q.iter().enumerate() {
            let part = p.transpose() * k * q;
            for r in 0..D {
                for c in 0..D {
                    block[i][r][j][c] = part[(r, c)];
                }
            }
        }
    }
    block
}
