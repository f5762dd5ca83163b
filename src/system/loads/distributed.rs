//! A dead force per reference length of a cable.

use nalgebra::Vector2;

use super::Instant;
use crate::body::Node;
use crate::elements::Element;
use crate::math::jet::Number;
use crate::system::PlanarChain;
use crate::system::signal::Signal;

/// A distributed force.
#[derive(Clone, Debug)]
pub struct Distributed {
    /// The chain.
    pub chain: usize,
    /// Components, N/m.
    pub components: [Signal; 2],
}

impl Distributed {
    pub(in crate::system) fn value<N: Number>(&self, at: Instant<'_, N>) -> Vector2<N> {
        let components = self.components.each_ref();
        components.map(|c| c.value(at)).into()
    }

    /// Sum over elements of what the load does per unit: as weight does, but for the density.
    fn each(&self, chain: &PlanarChain, mut add: impl FnMut(usize, [f64; 4])) {
        for (j, element) in chain.elements().iter().enumerate() {
            let weight = element.weight();
            let scale = element.length() / (weight[0] + weight[2]);
            add(j, (weight * scale).into());
        }
    }

    pub(super) fn add_force<N: Number>(&self, at: Instant<'_, N>, f: &mut [Node<4, N>]) {
        let (load, chain) = (self.value(at), &at.chains[self.chain]);
        self.each(chain, |j, weights| {
            let [a, b] = chain.nodes(j);
            for (node, pair) in [(a, [weights[0], weights[1]]), (b, [weights[2], weights[3]])] {
                for (k, weight) in pair.iter().enumerate() {
                    f[node][2 * k] += load.x * N::of(*weight);
                    f[node][2 * k + 1] += load.y * N::of(*weight);
                }
            }
        });
    }

    /// The integral of the load times a nodal field.
    fn along<N: Number>(&self, at: Instant<'_, N>, field: &[Node<4, N>]) -> N {
        let (load, chain) = (self.value(at), &at.chains[self.chain]);
        let mut sum = N::of(0.0);
        self.each(chain, |j, weights| {
            let e = chain.element(j, field);
            for (k, weight) in weights.iter().enumerate() {
                sum += (load.x * e[(0, k)] + load.y * e[(1, k)]) * N::of(*weight);
            }
        });
        sum
    }

    pub(super) fn power<N: Number>(&self, at: Instant<'_, N>) -> N {
        self.along(at, at.v)
    }

    pub(super) fn work(&self, before: Instant<'_>, after: Instant<'_>) -> f64 {
        self.along(before, after.x) - self.along(before, before.x)
    }
}
