//! How well the mesh of a plate or shell carries the shape that it has.
//!
//! On a mesh line the surface is a cubic between nodes, as a cable is, and its curvature along the line jumps at nodes where the moment of
//! the material does not. Half a jump times the square of the length of the element is what the shape misses, and ends without a moment tell
//! where few nodes do (docs/decisions/0036-resolution.md, docs/decisions/0081-meshes-of-plates-by-need.md).
//!
//! Source: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Methods Eng. 24 (1987) 337-357 (the mean of both sides of a node as the better value);
//! S. P. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells, 2nd ed. (1959), Eqs. 101 and 112 (moments of both curvatures, none at
//! a free or simply supported edge).

use nalgebra::Vector3;

use super::resolution::{bend, displaced, too_far};
use crate::bodies::{Node, Patch};
use crate::math::jet::Number;
use crate::math::space::{Vector, components};
use crate::system::{Evaluation, System};

/// Most elements along a direction of which the ends tell too: shapes that are symmetric have no jump in their middle.
const FEW: usize = 2;
/// Places of an element at which its tangents are compared: between two of them it rotates by less than half a turn.
const PLACES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// A line of the mesh, at this configuration of its nodes.
struct SurfaceLine<'a, const D: usize, N> {
    patch: &'a Patch,
    x: &'a [Node<D, N>],
    /// Direction along which it runs, and its number across.
    along: usize,
    number: usize,
}

impl<const D: usize, N: Number> SurfaceLine<'_, D, N> {
    /// First node of its mesh node.
    fn node(&self, k: usize) -> usize {
        match self.along {
            0 => self.patch.mesh_node(k, self.number),
            _ => self.patch.mesh_node(self.number, k),
        }
    }

    fn vector(&self, node: usize, part: usize) -> Vector3<N> {
        Vector3::from(components::<D, N>(&Vector::from(self.x[node][part])))
    }

    fn point(&self, k: usize) -> Vector3<N> {
        self.vector(self.node(k), 0)
    }

    /// Derivative of the position along a direction, by length.
    fn slope(&self, k: usize, direction: usize) -> Vector3<N> {
        let first = self.node(k);
        match direction {
            0 => self.vector(first, 1),
            _ => self.vector(first + 1, 0),
        }
    }

    /// Normal at a node, of unit length.
    fn normal(&self, k: usize) -> Vector3<N> {
        let normal = self.slope(k, 0).cross(&self.slope(k, 1));
        let size = normal.norm_squared();
        if size.plain() > 0.0 {
            normal * (N::of(1.0) / size.root())
        } else {
            normal
        }
    }

    /// Curvature `r_aa . n` along the line at its end 0 or 1 of an element, 1/m.
    fn curvature(&self, element: usize, end: usize) -> N {
        let length = self.patch.spacing(self.along, element);
        let way = self.point(element + 1) - self.point(element);
        let [first, second] = [element, element + 1].map(|k| self.slope(k, self.along));
        let second_derivative = match end {
            0 => way * N::of(6.0) - (first * N::of(4.0) + second * N::of(2.0)) * N::of(length),
            _ => (first * N::of(2.0) + second * N::of(4.0)) * N::of(length) - way * N::of(6.0),
        };
        second_derivative.dot(&self.normal(element + end)) * N::of(1.0 / (length * length))
    }

    /// Tangents of an element, of any length.
    fn tangents(&self, element: usize) -> [Vector3<N>; PLACES.len()] {
        let length = self.patch.spacing(self.along, element);
        let way = (self.point(element + 1) - self.point(element)) * N::of(1.0 / length);
        let [first, second] = [element, element + 1].map(|k| self.slope(k, self.along));
        PLACES.map(|xi| {
            way * N::of(6.0 * xi * (1.0 - xi))
                + first * N::of((1.0 - xi) * (1.0 - 3.0 * xi))
                + second * N::of(xi * (3.0 * xi - 2.0))
        })
    }
}

/// A mesh line now and as drawn.
struct BentLine<'a, const D: usize, N> {
    now: SurfaceLine<'a, D, N>,
    drawn: SurfaceLine<'a, D, f64>,
}

impl<'a, const D: usize, N: Number> BentLine<'a, D, N> {
    fn new(
        patch: &'a Patch,
        (x, drawn): (&'a [Node<D, N>], &'a [Node<D>]),
        (along, number): (usize, usize),
    ) -> Self {
        Self {
            now: SurfaceLine {
                patch,
                x,
                along,
                number,
            },
            drawn: SurfaceLine {
                patch,
                x: drawn,
                along,
                number,
            },
        }
    }

    /// Curvature along the line less that as drawn, at an end of an element, 1/m.
    fn change(&self, element: usize, end: usize) -> N {
        self.now.curvature(element, end) - N::of(self.drawn.curvature(element, end))
    }

    /// Displacement that bending of whole elements makes of one end where the other one is held, m.
    fn bent_away(&self) -> N {
        let elements = self.now.patch.divisions()[self.now.along];
        displaced(
            elements,
            |k| self.now.point(k),
            |element| {
                let (now, drawn) = (self.now.tangents(element), self.drawn.tangents(element));
                too_far::<D, N>(bend(now), bend(drawn))
            },
        )
    }
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Returns the curvature error along a direction of a plate or shell times the square of the element length, m, with its nodes as drawn: the
    /// largest over inner nodes without a moment on all mesh lines, and where elements are few over ends without one. Nothing where no node
    /// tells.
    pub fn missed_along(
        &self,
        system: &System<D>,
        (patch, drawn): (&Patch, &[Node<D>]),
        along: usize,
    ) -> Option<N> {
        let divisions = patch.divisions();
        let (count, x) = (divisions[along], &self.x[..]);
        let mut largest: Option<N> = None;
        let mut take = |error: N, length: f64| {
            let size = if error.plain() < 0.0 { -error } else { error } * N::of(length * length);
            if largest.is_none_or(|largest| size > largest) {
                largest = Some(size);
            }
        };
        for number in 0..=divisions[1 - along] {
            let line = BentLine::new(patch, (x, drawn), (along, number));
            let is_free = |k: usize| !system.takes_moments[line.now.node(k) + along];
            for k in (1..count).filter(|k| is_free(*k)) {
                let jump = line.change(k, 0) - line.change(k - 1, 1);
                let length = patch.spacing(along, k - 1).max(patch.spacing(along, k));
                take(jump * N::of(0.5), length);
            }
            // At a corner a moment along the other direction has one along this.
            let is_bare =
                |k: usize| is_free(k) && !system.takes_moments[line.now.node(k) + 1 - along];
            for k in [0, count] {
                if count > FEW || !is_bare(k) {
                    continue;
                }
                let element = k.min(count - 1);
                let own = line.change(element, k - element);
                let across = BentLine::new(patch, (x, drawn), (1 - along, k));
                let moment = own + across.mean_change(number) * N::of(patch.contraction()[along]);
                take(moment, patch.spacing(along, element));
            }
        }
        largest
    }

    /// Displacement, m, that bending of whole elements makes of one end of a mesh line of a plate or shell where the other one is held: the
    /// largest of all lines and both ends. What elements are bent by as drawn, from these nodes, makes none.
    pub fn surface_bent_away(&self, patch: &Patch, drawn: &[Node<D>]) -> N {
        let divisions = patch.divisions();
        let mut largest = N::of(0.0);
        for along in 0..2 {
            for number in 0..=divisions[1 - along] {
                let line = BentLine::new(patch, (&self.x[..], drawn), (along, number));
                let off = line.bent_away();
                if off > largest {
                    largest = off;
                }
            }
        }
        largest
    }
}

impl<const D: usize, N: Number> BentLine<'_, D, N> {
    /// Mean of the changes of curvature on both sides of a node, 1/m; at an end that of its element.
    fn mean_change(&self, k: usize) -> N {
        let count = self.now.patch.divisions()[self.now.along];
        match k {
            0 => self.change(0, 0),
            k if k == count => self.change(count - 1, 1),
            k => (self.change(k - 1, 1) + self.change(k, 0)) * N::of(0.5),
        }
    }
}
