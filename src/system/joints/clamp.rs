//! A section of a rod or beam that the ground holds. Where it is, along which direction a rod's slope points, and how its section has
//! rotated from the start are coordinates of nodes: rows are all that it takes, and the slope stays free to stretch.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eq. 9 (linear constraints in nodal coordinates), for the coordinates of
//! `body/frame/section_frame.rs`.

use super::{Linear, Target};
use crate::bodies::{ConnectivityRow, Marker, Node, no_node};
use crate::math::space::{Vector, axis, normals};
use crate::system::end::Attachment;

/// A section that the ground holds.
#[derive(Clone, Copy, Debug)]
pub struct Clamp {
    /// The point of the line, at a node.
    pub line: Marker,
    /// First node of its frame.
    pub frame: usize,
    /// Whether it has_shear against the line, as a beam's does: its slope is not held then.
    pub has_shear: bool,
}

impl Clamp {
    /// Returns the linear rows of the clamp at a point of the ground, for the section as it is in these nodes. The rows
    /// belong to no joint. The reaction follows from the loads on the section (`outputs/clamp.rs`).
    pub(super) fn rows<const D: usize>(
        &self,
        ground: &Vector<D>,
        nodes: &[Node<D>],
    ) -> Vec<Linear<D>> {
        let none = Vector::zeros();
        let row = |terms: ConnectivityRow<D>, value: f64| Linear {
            joint: None,
            row: terms,
            target: Target::Fixed(value),
            on_ends: [[none; 2]; 2],
        };
        let blank = || ConnectivityRow {
            terms: Vec::new(),
            is_driven: false,
        };
        let on_line = |position: Vector<D>, direction: Vector<D>| {
            let mut terms = blank();
            Attachment::Body(self.line).add_terms(position, direction, &mut terms);
            terms
        };
        let places = (0..D).map(|k| row(on_line(axis(k), none), ground[k]));
        let mut rows: Vec<Linear<D>> = places.collect();
        let turns = if self.has_shear { D } else { 1 };
        if !self.has_shear {
            let tangent = Vector::from(nodes[self.frame][1]);
            rows.extend(normals(&tangent).map(|normal| row(on_line(none, normal), 0.0)));
        }
        for axis in 0..turns {
            let (mut terms, mut coefficients) = (blank(), no_node());
            coefficients[1][axis] = 1.0;
            terms.terms.push((self.frame, coefficients));
            rows.push(row(terms, 0.0));
        }
        rows
    }
}
