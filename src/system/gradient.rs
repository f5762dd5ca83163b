//! Derivatives of a function of two ends, such as a constraint or a coordinate of a joint: forces on both, and over the nodes.

use super::end::{Add, Attachment};
use crate::bodies::{Bodies, Node, add_node, no_node};
use crate::math::jet::Number;
use crate::math::space::{Vector, is_nothing};

/// Derivatives by position and direction of two ends.
#[derive(Clone, Copy, Debug)]
pub struct Gradient<const D: usize, N: Number = f64> {
    /// The ends and, for each, the derivatives by position and direction.
    pub ends: [(Attachment<D, N>, [Vector<D, N>; 2]); 2],
}

impl<const D: usize, N: Number> Gradient<D, N> {
    /// The derivative along a nodal vector.
    #[inline(always)]
    pub fn along(&self, rates: &[Node<D, N>]) -> N {
        let mut sum = N::of(0.0);
        for (end, [position, direction]) in &self.ends {
            let Attachment::Body(marker) = end else {
                continue;
            };
            if !is_nothing(position) {
                sum += position.dot(&marker.position(rates));
            }
            if !is_nothing(direction) {
                sum += direction.dot(&marker.direction(rates));
            }
        }
        sum
    }

    /// Multiplies the gradient by a factor.
    pub fn scaled(mut self, factor: N) -> Self {
        for (_, [position, direction]) in &mut self.ends {
            *position *= factor;
            *direction *= factor;
        }
        self
    }

    /// Terms over the nodes.
    #[inline(always)]
    pub fn for_each(&self, mut term: impl FnMut(usize, &Node<D, N>)) {
        for (end, [position, direction]) in &self.ends {
            if let Attachment::Body(marker) = end {
                let [a, b] = marker.forces(*position, *direction);
                term(a.0, &a.1);
                if !marker.is_nodal() {
                    term(b.0, &b.1);
                }
            }
        }
    }

    /// Terms over the nodes that have coordinates: of rigid bodies of space the first one.
    #[inline(always)]
    pub fn for_each_pulled(
        &self,
        bodies: &Bodies<D>,
        x: &[Node<D, N>],
        mut term: impl FnMut(usize, &Node<D, N>),
    ) {
        for (end, [position, direction]) in &self.ends {
            if let Attachment::Body(marker) = end {
                bodies.pull_marker(marker, [position, direction], x, &mut term);
            }
        }
    }
}

/// Derivatives by the coordinates of a few nodes, four of two ends.
#[derive(Clone, Copy, Debug)]
pub struct Terms<const D: usize, const MOST: usize = 4> {
    terms: [(usize, Node<D>); MOST],
    count: usize,
}

impl<const D: usize, const MOST: usize> Default for Terms<D, MOST> {
    fn default() -> Self {
        Self {
            terms: [(usize::MAX, no_node()); MOST],
            count: 0,
        }
    }
}

impl<const D: usize, const MOST: usize> Terms<D, MOST> {
    /// Adds derivatives by the coordinates of a node.
    pub fn add(&mut self, node: usize, term: &Node<D>) {
        let mut known = self.terms[..self.count].iter();
        let place = known.position(|(at, _)| *at == node).unwrap_or(self.count);
        self.count = self.count.max(place + 1);
        self.terms[place].0 = node;
        add_node(&mut self.terms[place].1, 1.0, term);
    }

    /// Adds derivatives by position and direction of an end.
    pub fn add_end(&mut self, end: &Attachment<D>, [position, direction]: [Vector<D>; 2]) {
        if let Attachment::Body(marker) = end {
            for (node, term) in marker.forces(position, direction) {
                self.add(node, &term);
            }
        }
    }

    /// Adds the product with themselves, times a factor, to a matrix over nodes.
    pub fn add_square(&self, factor: f64, add: Add<'_, D>) {
        let terms = &self.terms[..self.count];
        for (i, (a, p)) in terms.iter().enumerate() {
            for (b, q) in &terms[i..] {
                let row = |part: &[f64; D], by: f64| part.map(|c| factor * by * c);
                let block = p.map(|on| on.map(|by| q.map(|part| row(&part, by))));
                add(*a, *b, &block);
            }
        }
    }
}

impl<const D: usize> Gradient<D> {
    /// Adds the product with itself, times a factor, to a matrix over nodes.
    pub fn add_square(&self, factor: f64, add: Add<'_, D>) {
        let mut terms: Terms<D> = Terms::default();
        self.for_each(|node, term| terms.add(node, term));
        terms.add_square(factor, add);
    }
}
