//! How bodies along a line stand, for pictures: flexible bodies, and straight rigid ones.

use super::{Bodies, LineChain, Marker, RigidRod};
use crate::bodies::connectivity::Node;
use crate::math::space::{Vector, components};

/// Stance of a body along a line.
#[derive(Clone, Debug)]
pub struct LineStance {
    /// Places, m, and slopes of the nodes of its line.
    pub nodes: Vec<[[f64; 3]; 2]>,
    /// Axes of its sections at these nodes; none where it has no sections.
    pub axes: Vec<[[f64; 3]; 3]>,
}

/// Three components of one part of a node.
fn part<const D: usize>(node: &Node<D>, part: usize) -> [f64; 3] {
    components(&Vector::from(node[part]))
}

impl<const D: usize> Bodies<D> {
    /// How a body along a line stands at nodal coordinates; none of other bodies.
    pub fn line_stance(&self, body: usize, x: &[Node<D>]) -> Option<LineStance> {
        if let Some(line) = self.line(body) {
            return Some(self.flexible_stance(line, x));
        }
        let rod = self.rod(self.ranges[body].start)?;
        let [_, slope] = [0, 1].map(|k| part(&x[rod.node], k));
        let ends = rod_ends(body, rod).map(|end| components(&end.position(x)));
        Some(LineStance {
            nodes: ends.map(|end| [end, slope]).into(),
            axes: Vec::new(),
        })
    }

    fn flexible_stance(&self, line: &LineChain<D>, x: &[Node<D>]) -> LineStance {
        let nodes = line.range().map(|node| [0, 1].map(|k| part(&x[node], k)));
        let mut axes = Vec::new();
        if let Some(sections) = self.sections(line) {
            for element in 0..sections.count() {
                let ends = sections.at(element, x).axes;
                // Every element tells of both its ends; its first is the last of the one before.
                axes.extend_from_slice(&ends[usize::from(element > 0)..]);
            }
        }
        LineStance {
            nodes: nodes.collect(),
            axes,
        }
    }

    /// Points along the line of a body, m, in so many parts as `parts` tells for a number of elements; its first node alone of other bodies.
    pub fn outline(
        &self,
        body: usize,
        x: &[Node<D>],
        parts: &dyn Fn(usize) -> u32,
    ) -> Vec<[f64; 3]> {
        let first = self.ranges[body].start;
        if let Some(line) = self.line(body) {
            let parts = parts(line.elements().len());
            let along = |part: u32| line.length() * f64::from(part) / f64::from(parts);
            let place = |part| Marker::along(body, line, along(part)).position(x);
            return (0..=parts).map(|part| components(&place(part))).collect();
        }
        match self.rod(first) {
            Some(rod) => rod_ends(body, rod)
                .map(|end| components(&end.position(x)))
                .into(),
            None => vec![part(&x[first], 0)],
        }
    }

    /// Whether a body stands along a line.
    pub fn is_along_line(&self, body: usize) -> bool {
        self.line(body).is_some() || self.rod(self.ranges[body].start).is_some()
    }
}

/// Both ends of a straight rigid body.
fn rod_ends(body: usize, rod: &RigidRod) -> [Marker; 2] {
    [-0.5, 0.5].map(|part| Marker::rigid(body, rod.node, [part * rod.length, 0.0]))
}
