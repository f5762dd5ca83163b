//! Gaps of joints: what is missing of rows and constraints where bodies are, and how that changes where bodies are moved, each
//! as a whole.

use std::ops::Range;

use nalgebra::DMatrix;

use super::placement::Gap;
use crate::bodies::{Node, NodeKind, product, rotate_inner};
use crate::math::space::{Vector, moment, rotated, spins};
use crate::system::joints::{Constraint, ConstraintKind, Equation as _, Linear, View};
use crate::system::{System, Workspace};

impl<const D: usize> System<D> {
    /// Returns the point that placement rotates a body about: the mean of its nodes, m.
    pub(super) fn center(&self, body: usize, x: &[Node<D>]) -> Vector<D> {
        let nodes = self.bodies.ranges[body].clone();
        if self.bodies.rigid_at(nodes.start).is_some() {
            return x[nodes.start][0].into();
        }
        let points = nodes.filter(|node| self.bodies.kind(*node) == NodeKind::Point);
        let points: Vec<Vector<D>> = points.map(|node| x[node][0].into()).collect();
        points.iter().sum::<Vector<D>>() / points.len() as f64
    }

    /// Moves a body as a whole, rotating it about a point.
    pub(super) fn move_body(
        &self,
        (nodes, about): (Range<usize>, Vector<D>),
        way: Vector<D>,
        turn: [f64; 3],
        x: &mut [Node<D>],
    ) {
        for node in nodes {
            let [p, d] = x[node].map(Vector::from);
            let p = match self.bodies.kind(node) {
                NodeKind::Point => about + way + rotated(p - about, turn),
                NodeKind::Axes => rotated(p, turn),
                NodeKind::Inner => {
                    rotate_inner(&mut x[node], turn[2]);
                    continue;
                }
                NodeKind::Modal => continue,
            };
            x[node] = [p.into(), rotated(d, turn).into()];
        }
    }

    /// Lists the position and angle gaps of every joint that exceed `least`, relative to the size of the system.
    pub(super) fn gaps_by_joint(&self, x: &[Node<D>], work: &Workspace<D>, least: f64) -> Vec<Gap> {
        let size = self.bodies.extent(x);
        let gaps = self.gaps(x, work, size);
        // Squares of the sines of angles, or of lengths, and how many.
        let mut sums: Vec<(Gap, usize)> = Vec::new();
        for (gap, (owner, is_angle)) in gaps.iter().zip(self.owners()) {
            let (Some(joint), true) = (owner, gap.is_nan() || gap.abs() > least) else {
                continue;
            };
            let gap = if is_angle {
                gap.abs()
            } else {
                self.length_of(joint, gap * size).abs()
            };
            match (sums.iter_mut()).find(|(g, _)| (g.joint, g.is_angle) == (joint, is_angle)) {
                Some((sum, count)) => (sum.size, *count) = (sum.size.hypot(gap), *count + 1),
                None => sums.push((
                    Gap {
                        joint,
                        size: gap,
                        is_angle,
                    },
                    1,
                )),
            }
        }
        let angle = |(gap, count): (Gap, usize)| match (gap.is_angle, count) {
            (false, _) => gap,
            (true, 1) => Gap {
                size: gap.size.min(1.0).asin(),
                ..gap
            },
            (true, _) => Gap {
                size: 2.0 * (0.5 * gap.size).min(1.0).asin(),
                ..gap
            },
        };
        sums.into_iter().map(angle).collect()
    }

    /// A gap in m: that of a distance is measured by squares.
    fn length_of(&self, joint: usize, gap: f64) -> f64 {
        match self.joints[joint].length() {
            Some(length) => (length * (length + 2.0 * gap)).max(0.0).sqrt() - length,
            None => gap,
        }
    }

    fn all_constraints(&self) -> impl Iterator<Item = &Constraint<D>> {
        let held = self.settled.iter().chain(&self.clamped);
        self.constraints.iter().chain(held)
    }

    /// Joints of the entries of [`System::gaps`], and whether those are of angles.
    fn owners(&self) -> Vec<(Option<usize>, bool)> {
        let linear = self.linear.iter();
        let linear = linear.map(|linear| (linear.joint, linear.on_ends[1][0].norm() == 0.0));
        let constraints = self.all_constraints();
        let constraints = constraints.map(|c| (c.joint, constraint_size(c, 2.0) == 1.0));
        linear.chain(constraints).collect()
    }

    /// Where slides are on their chains, wherever they were before.
    pub(super) fn find_slides(&self, x: &[Node<D>], travel: &mut [f64]) {
        for (travel, constraint) in travel.iter_mut().zip(&self.slides) {
            if let ConstraintKind::PointOnCurve(along) = &self.constraints[*constraint].kind {
                *travel = along.nearest(&self.bodies.lines()[along.chain], x);
            }
        }
    }

    /// Whether a row is one of what joints see: not that a rigid body of space has no coordinates but its own.
    fn is_seen(&self, linear: &Linear<D>) -> bool {
        let mut nodes = linear.row.terms.iter().map(|(node, _)| *node);
        !nodes.any(|node| self.bodies.holds(node))
    }

    /// Returns the left-hand side of a row minus its target.
    pub(super) fn gap_of(&self, linear: &Linear<D>, x: &[Node<D>], work: &Workspace<D>) -> f64 {
        if !self.is_seen(linear) {
            return 0.0;
        }
        let terms = linear.row.terms.iter();
        let value: f64 = terms.map(|(node, c)| product(c, &x[*node])).sum();
        value - linear.target.derivatives(&work.kinematics.drives)[0]
    }

    /// Returns the gaps of every row and constraint. Lengths are relative to `size`.
    pub(super) fn gaps(&self, x: &[Node<D>], work: &Workspace<D>, size: f64) -> Vec<f64> {
        let mut gaps = Vec::new();
        for linear in &self.linear {
            gaps.push(self.gap_of(linear, x, work) / linear_size(linear, size));
        }
        let view = View {
            x,
            ..self.view(&work.kinematics)
        };
        for constraint in self.all_constraints() {
            gaps.push(constraint.value(&view) / constraint_size(constraint, size));
        }
        gaps
    }

    /// Derivatives of the gaps by translations (relative to `size`) and rotations of all bodies.
    pub(super) fn rigid_jacobian(
        &self,
        x: &[Node<D>],
        work: &Workspace<D>,
        size: f64,
    ) -> DMatrix<f64> {
        let count = self.linear.len() + self.all_constraints().count();
        let free = D + spins(D).len();
        let mut jacobian = DMatrix::zeros(count, free * self.bodies.ranges.len());
        let mut of_node = vec![0; x.len()];
        for (body, nodes) in self.bodies.ranges.iter().enumerate() {
            of_node[nodes.clone()].fill(body);
        }
        let mut enter = |row: usize, node: usize, c: &Node<D>, scale: f64| {
            let body = of_node[node];
            let about = self.center(body, x);
            let ([p, d], [on, by]) = (x[node].map(Vector::from), c.map(Vector::from));
            let is_second = self.bodies.kind(node) == NodeKind::Axes;
            for k in (0..D).filter(|_| !is_second) {
                jacobian[(row, free * body + k)] += on[k] * size / scale;
            }
            // Of a second node both vectors are axes.
            let arm = if is_second { p } else { p - about };
            let turns = [moment(&arm, &on), moment(&d, &by)];
            for (i, k) in spins(D).enumerate() {
                jacobian[(row, free * body + D + i)] += (turns[0][k] + turns[1][k]) / scale;
            }
        };
        for (row, linear) in self.linear.iter().enumerate() {
            for (node, c) in linear.row.terms.iter().filter(|_| self.is_seen(linear)) {
                enter(row, *node, c, linear_size(linear, size));
            }
        }
        let view = View {
            x,
            ..self.view(&work.kinematics)
        };
        for (i, constraint) in self.all_constraints().enumerate() {
            constraint.for_each(&view, |node, c| {
                let scale = constraint_size(constraint, size);
                enter(self.linear.len() + i, node, c, scale);
            });
        }
        jacobian
    }
}

fn linear_size<const D: usize>(linear: &Linear<D>, size: f64) -> f64 {
    let positions = linear.on_ends[1][0].norm() > 0.0;
    if positions { size } else { 1.0 }
}

fn constraint_size<const D: usize>(constraint: &Constraint<D>, size: f64) -> f64 {
    if constraint.kind.is_angle() {
        1.0
    } else {
        size
    }
}
