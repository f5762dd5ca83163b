//! What the ground exerts on a section of a rod or beam that it holds by rows: the opposite of what acts on the node there, less the inertia of
//! what is around it.
//!
//! Source: S. S. Antman, Nonlinear Problems of Elasticity, 2nd ed. (2005), section 4.1 (balance of a rod).

use nalgebra::Vector3;

use super::evaluation::Evaluation;
use crate::bodies::Marker;
use crate::math::jet::Number;
use crate::math::space::{Vector, moment};
use crate::system::System;
use crate::system::end::Attachment;
use crate::system::joints::Clamp;

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Force (N) and moment (N m) of the ground on the section that a clamp holds.
    pub(super) fn clamped(&self, system: &System<D>, clamp: &Clamp) -> (Vector<D, N>, [N; 3]) {
        let (mut force, mut turning) = (Vector::zeros(), Vector3::zeros());
        let Some((chain, j, xi)) = system.bodies.element_after(&clamp.line) else {
            return (force, turning.into());
        };
        // The element after the node, and the one before it.
        let sides = if xi == 1.0 {
            [None, Some(j)]
        } else {
            [Some(j), j.checked_sub(1)]
        };
        for (end, element) in sides.into_iter().enumerate() {
            let Some(element) = element else {
                continue;
            };
            let (lack, torques) = self.lack(system, (chain, element));
            let slope = Vector::from(self.x[clamp.line.nodes[0]][1]);
            let [on, by]: [Vector<D, N>; 2] = [0, 1].map(|k| lack.column(2 * end + k).into());
            force -= on;
            turning -= Vector3::from(moment(&slope, &by)) + torques[end];
        }
        let is_on = |marker: &Marker| [clamp.line.nodes[0], clamp.frame].contains(&marker.nodes[0]);
        self.each_force(system, (is_on, |_| false), |end, [position, direction]| {
            if let Attachment::Body(marker) = end
                && [clamp.line.nodes[0], clamp.frame].contains(&marker.nodes[0])
            {
                force -= position;
                turning -= Vector3::from(moment(&marker.direction(&self.x), &direction));
            }
        });
        let [position, direction] = self.edges_on(system, clamp.line.nodes[0]);
        let slope = Vector::from(self.x[clamp.line.nodes[0]][1]);
        force -= position;
        turning -= Vector3::from(moment(&slope, &direction));
        (force, turning.into())
    }
}
