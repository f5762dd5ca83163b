//! Lines that loads are distributed along, by segments with Gauss points: the elements of a flexible body, or equal parts of a straight rigid
//! one.
//!
//! Source: M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), 25.4.29 (Gauss's rule).

use super::connectivity::Node;
use super::winch::PaidOut;
use super::{Bodies, RigidRod};
use crate::elements::{Element as _, shape};
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::Vector;

/// Number of equal parts of a straight rigid body that loads along it are integrated over.
pub const PANELS: usize = 8;

/// Line that a load is distributed along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoadedLine {
    /// A line of a flexible body, by its index.
    Chain(usize),
    /// A straight rigid body.
    Rod(RigidRod),
}

/// A Gauss point of a segment.
#[derive(Clone, Copy, Debug)]
pub struct LinePoint {
    /// Nodes that it lies between, twice the same of a rigid body.
    pub nodes: [usize; 2],
    /// Weights of position and direction of both nodes in its position.
    pub position: [f64; 4],
    /// Weights of position and direction of both nodes in its slope.
    pub slope: [f64; 4],
    /// Length that it stands for, m.
    pub weight: f64,
}

impl LinePoint {
    /// Sum of nodal vectors with these weights.
    pub fn sum<const D: usize, N: Number>(
        &self,
        weights: &[f64; 4],
        x: &[Node<D, N>],
    ) -> Vector<D, N> {
        let mut sum = Vector::zeros();
        for (k, weight) in weights.iter().enumerate() {
            sum += Vector::from(x[self.nodes[k / 2]][k % 2]) * N::of(*weight);
        }
        sum
    }

    /// Calls with each of its nodes and the weights, times the length, of its position and direction in the position.
    pub fn for_each_node(&self, mut call: impl FnMut(usize, [f64; 2])) {
        let [p, s, q, t] = self.position.map(|part| part * self.weight);
        call(self.nodes[0], [p, s]);
        if self.nodes[1] != self.nodes[0] {
            call(self.nodes[1], [q, t]);
        }
    }
}

impl LoadedLine {
    /// First node of the body.
    pub fn first_node<const D: usize>(&self, bodies: &Bodies<D>) -> usize {
        match self {
            Self::Chain(line) => bodies.lines[*line].first_node(),
            Self::Rod(rod) => rod.node,
        }
    }

    /// The line, if a winch pays it out.
    pub fn paid_out<'a, const D: usize, N: Number>(
        &self,
        bodies: &'a Bodies<D>,
        drives: &[[N; 3]],
    ) -> Option<PaidOut<'a, D, N>> {
        match self {
            Self::Chain(line) => bodies.lines[*line].paid_out(drives),
            Self::Rod(_) => None,
        }
    }

    /// Number of segments.
    pub fn segments<const D: usize>(&self, bodies: &Bodies<D>) -> usize {
        match self {
            Self::Chain(line) => bodies.lines[*line].elements().len(),
            Self::Rod(_) => PANELS,
        }
    }

    /// Nodes of a segment, twice the same of a rigid body.
    pub fn nodes<const D: usize>(&self, bodies: &Bodies<D>, segment: usize) -> [usize; 2] {
        match self {
            Self::Chain(line) => bodies.lines[*line].nodes(segment),
            Self::Rod(rod) => [rod.node; 2],
        }
    }

    /// A Gauss point of a segment, by index.
    pub fn point<const D: usize>(
        &self,
        bodies: &Bodies<D>,
        segment: usize,
        point: usize,
    ) -> LinePoint {
        let point = GAUSS_5[point];
        let nodes = self.nodes(bodies, segment);
        match self {
            Self::Chain(line) => {
                let length = bodies.lines[*line].element_length(segment);
                LinePoint {
                    nodes,
                    position: shape::values(point.at, length).into(),
                    slope: shape::slopes(point.at, length).into(),
                    weight: point.weight * length,
                }
            }
            Self::Rod(rod) => {
                let part = rod.length / PANELS as f64;
                let arm = (segment as f64 + point.at) * part - 0.5 * rod.length;
                LinePoint {
                    nodes,
                    position: [1.0, arm, 0.0, 0.0],
                    slope: [0.0, 1.0, 0.0, 0.0],
                    weight: point.weight * part,
                }
            }
        }
    }

    /// Calls with each node and the integrals, over the whole line, of the weights of its position and direction in that of a point, m.
    pub fn for_each_integral<const D: usize>(
        &self,
        bodies: &Bodies<D>,
        mut call: impl FnMut(usize, [f64; 2]),
    ) {
        let line = match self {
            Self::Chain(line) => &bodies.lines[*line],
            Self::Rod(rod) => return call(rod.node, [rod.length, 0.0]),
        };
        for (j, element) in line.elements().iter().enumerate() {
            let [p, s, q, t] = shape::integrals(1.0, element.length()).into();
            let [a, b] = line.nodes(j);
            call(a, [p, s]);
            call(b, [q, t]);
        }
    }
}
