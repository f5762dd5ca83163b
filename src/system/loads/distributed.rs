//! A dead force per reference length of a cable or a rod.

use super::Instant;
use crate::body::Node;
use crate::elements::{Element, shape};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::signal::Signal;
use crate::system::{CableChain, Rod};

/// What a force is distributed along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Line {
    /// A chain.
    Chain(usize),
    /// A rod.
    Rod(Rod),
}

/// A distributed force.
#[derive(Clone, Debug)]
pub struct Distributed<const D: usize = 2> {
    /// What it is distributed along.
    pub on: Line,
    /// Components, N/m.
    pub components: [Signal; D],
}

impl<const D: usize> Distributed<D> {
    pub(in crate::system) fn value<N: Number>(&self, at: Instant<'_, D, N>) -> Vector<D, N> {
        let components = self.components.each_ref();
        components.map(|c| c.value(at)).into()
    }

    /// First node of the body that it acts on.
    pub(in crate::system) fn first_node(&self, chains: &[CableChain<D>]) -> usize {
        match self.on {
            Line::Chain(chain) => chains[chain].nodes(0)[0],
            Line::Rod(rod) => rod.node,
        }
    }

    /// Forces on the nodes of a load of one N/m along every axis, on position and direction: on a chain the integrals of its
    /// shape functions; on a rod in the middle.
    fn each(&self, chains: &[CableChain<D>], mut add: impl FnMut(usize, [f64; 2])) {
        let chain = match self.on {
            Line::Chain(chain) => &chains[chain],
            Line::Rod(rod) => return add(rod.node, [rod.length, 0.0]),
        };
        for (j, element) in chain.elements().iter().enumerate() {
            let weights = shape::integrals(1.0, element.length());
            let [a, b] = chain.nodes(j);
            add(a, [weights[0], weights[1]]);
            add(b, [weights[2], weights[3]]);
        }
    }

    pub(super) fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        let load = self.value(at);
        self.each(at.chains, |node, weights| {
            for (k, weight) in weights.into_iter().enumerate() {
                for d in 0..D {
                    f[node][k][d] += load[d] * N::of(weight);
                }
            }
        });
    }

    /// The integral of the load times a nodal field.
    fn along<N: Number>(&self, at: Instant<'_, D, N>, field: &[Node<D, N>]) -> N {
        let load = self.value(at);
        let mut sum = N::of(0.0);
        self.each(at.chains, |node, weights| {
            for (k, weight) in weights.into_iter().enumerate() {
                sum += load.dot(&Vector::from(field[node][k])) * N::of(weight);
            }
        });
        sum
    }

    pub(super) fn power<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.along(at, at.v)
    }

    pub(super) fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        self.along(before, after.x) - self.along(before, before.x)
    }
}
