//! What a joint exerts on a line of a plate or shell: forces of its rows and conditions on the vectors of the mesh nodes.

use nalgebra::Vector3;

use super::evaluation::Evaluation;
use crate::math::jet::Number;
use crate::math::space::{Vector, components, vector};
use crate::system::System;
use crate::system::end::Attachment;
use crate::system::joints::Edge;

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Force (N), and moment (N m) about the middle of the line, of a joint on the line that it holds. What two joints hold at a corner
    /// counts to the one that is named first.
    pub(super) fn on_edge(
        &self,
        system: &System<D>,
        (joint, edge): (usize, &Edge<D>),
    ) -> (Vector<D, N>, [N; 3]) {
        let full = |v: Vector<D, N>| Vector3::from(components::<D, N>(&v));
        let patch = &system.bodies.patches()[edge.patch];
        let middle = Vector3::from(patch.position(edge.middle.0, edge.middle.1, &self.x));
        let (mut force, mut turning) = (Vector3::zeros(), Vector3::zeros());
        for (row, linear) in system.linear.iter().enumerate() {
            if linear.joint != Some(joint) {
                continue;
            }
            let lambda = self.edge_multiplier(system, row);
            for (node, coefficients) in &linear.row.terms {
                let Some(is_first) = edge.holds(*node) else {
                    continue;
                };
                for (part, on) in coefficients.iter().enumerate() {
                    let on = full(Vector::from(*on).map(N::of)) * lambda;
                    let at = full(self.x[*node][part].into());
                    if is_first && part == 0 {
                        force += on;
                        turning += (at - middle).cross(&on);
                    } else {
                        turning += at.cross(&on);
                    }
                }
            }
        }
        let view = self.view(system);
        for (constraint, lambda) in system.constraints.iter().zip(&self.lambda) {
            if constraint.joint != Some(joint) {
                continue;
            }
            constraint.for_each_pair(&view, |pair| {
                for (end, [position, direction]) in &pair.ends {
                    let marker = match end {
                        Attachment::Body(marker) if edge.holds(marker.nodes[0]).is_some() => marker,
                        _ => continue,
                    };
                    let (position, direction) = (full(*position), full(*direction));
                    let arm = full(marker.position(&self.x)) - middle;
                    force -= position * *lambda;
                    turning -= (arm.cross(&position)
                        + full(marker.direction(&self.x)).cross(&direction))
                        * *lambda;
                }
            });
        }
        (vector::<D, N>(force.into()), turning.into())
    }

    /// Forces of rows of joints of edges on position and slope of a node.
    pub(super) fn edges_on(&self, system: &System<D>, node: usize) -> [Vector<D, N>; 2] {
        let mut sum = [Vector::zeros(); 2];
        for (row, linear) in system.linear.iter().enumerate() {
            let is_of_edge = |joint: usize| system.joints[joint].edge().is_some();
            if !linear.joint.is_some_and(is_of_edge) {
                continue;
            }
            for (_, coefficients) in linear.row.terms.iter().filter(|(of, _)| *of == node) {
                let lambda = self.edge_multiplier(system, row);
                for (sum, on) in sum.iter_mut().zip(coefficients) {
                    *sum += Vector::from(*on).map(N::of) * lambda;
                }
            }
        }
        sum
    }

    /// Multiplier of a row of a joint of an edge; zero for one that repeats others. What acts on the sections of a stiffener counts to its line.
    fn edge_multiplier(&self, system: &System<D>, row: usize) -> N {
        let forces = &self.linear_constraint_forces;
        system.row_multiplier(row, |node| {
            system.bodies.with_section(node, &self.x, forces)
        })
    }
}
