//! Rows that joints make of what they hold.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eq. 9 (linear constraints in nodal coordinates).

use super::{Linear, Target};
use crate::bodies::{ConnectivityRow, Node};
use crate::math::space::Vector;
use crate::system::end::Attachment;

/// Where joints put their rows.
pub(super) struct Rows<'a, const D: usize> {
    pub joint: usize,
    pub ends: &'a [Attachment<D>; 2],
    pub nodes: &'a [Node<D>],
    pub linear: &'a mut Vec<Linear<D>>,
}

impl<const D: usize> Rows<'_, D> {
    /// `second . (position, direction of the second end) - first . (of the first end) = target`.
    pub fn push(&mut self, first: [Vector<D>; 2], second: [Vector<D>; 2], target: Target) {
        let mut row = ConnectivityRow {
            terms: Vec::new(),
            is_driven: target.is_driven(),
        };
        let on_ends = [first.map(|part| -part), second];
        for (end, [position, direction]) in self.ends.iter().zip(on_ends) {
            end.add_terms(position, direction, &mut row);
        }
        self.linear.push(Linear {
            joint: Some(self.joint),
            row,
            target,
            on_ends,
        });
    }

    /// Holds the position of the second end along an axis against that of the first; `target` takes
    /// where a first end on the ground is along it.
    pub fn hold_position(&mut self, axis: Vector<D>, target: impl Fn(f64) -> Target) {
        let none = Vector::zeros();
        let start = match self.ends[0] {
            Attachment::Ground(point) => axis.dot(&point),
            Attachment::Body(_) => 0.0,
        };
        self.push([axis, none], [axis, none], target(start));
    }
}
