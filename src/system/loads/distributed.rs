//! A dead force per reference length of a cable.

use super::Instant;
use crate::body::Node;
use crate::elements::Element;
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::CableChain;
use crate::system::signal::Signal;

/// A distributed force.
#[derive(Clone, Debug)]
pub struct Distributed<const D: usize = 2> {
    /// The chain.
    pub chain: usize,
    /// Components, N/m.
    pub components: [Signal; D],
}

impl<const D: usize> Distributed<D> {
    pub(in crate::system) fn value<N: Number>(&self, at: Instant<'_, D, N>) -> Vector<D, N> {
        let components = self.components.each_ref();
        components.map(|c| c.value(at)).into()
    }

    /// Sum over elements of what the load does per unit: as weight does, but for the density.
    fn each(&self, chain: &CableChain<D>, mut add: impl FnMut(usize, [f64; 4])) {
        for (j, element) in chain.elements().iter().enumerate() {
            let weight = element.weight();
            let scale = element.length() / (weight[0] + weight[2]);
            add(j, (weight * scale).into());
        }
    }

    pub(super) fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        let (load, chain) = (self.value(at), &at.chains[self.chain]);
        self.each(chain, |j, weights| {
            let [a, b] = chain.nodes(j);
            for (node, pair) in [(a, [weights[0], weights[1]]), (b, [weights[2], weights[3]])] {
                for (k, weight) in pair.iter().enumerate() {
                    for d in 0..D {
                        f[node][k][d] += load[d] * N::of(*weight);
                    }
                }
            }
        });
    }

    /// The integral of the load times a nodal field.
    fn along<N: Number>(&self, at: Instant<'_, D, N>, field: &[Node<D, N>]) -> N {
        let (load, chain) = (self.value(at), &at.chains[self.chain]);
        let mut sum = N::of(0.0);
        self.each(chain, |j, weights| {
            let e = chain.element(j, field);
            for (k, weight) in weights.iter().enumerate() {
                sum += load.dot(&e.column(k)) * N::of(*weight);
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
