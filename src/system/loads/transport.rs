//! Inertia forces of the material of a cable that a winch pays out, which passes through its mesh ([`Winch`]): those that
//! accelerations of the nodes do not tell.

use super::{Instant, Values};
use crate::body::Node;
use crate::math::jet::Number;
use crate::system::CableChain;
use crate::system::loads::on_coordinates;
use crate::system::winch::Winch;

/// What a winch does to its cable.
#[derive(Clone, Debug)]
pub struct Transport<const D: usize = 2> {
    /// The winch.
    pub winch: Winch<D>,
}

impl<const D: usize> Transport<D> {
    /// First node of the cable.
    pub(super) fn first_node(&self) -> usize {
        self.winch.nodes[0]
    }

    /// Nodes of its elements.
    pub(super) fn parts(&self, chains: &[CableChain<D>]) -> Vec<Vec<usize>> {
        let chain = &chains[self.winch.chain];
        let elements = 0..chain.elements().len();
        elements.map(|j| chain.nodes(j).to_vec()).collect()
    }

    /// Forces at the Gauss points of an element, N/m.
    pub(super) fn values<N: Number>(&self, at: Instant<'_, D, N>, element: usize) -> Values<D, N> {
        let (winch, chain) = (&self.winch, &at.chains[self.winch.chain]);
        winch.transport(chain, element, (at.x, at.v), &winch.now(at.drives))
    }

    pub(super) fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        let [_, rate, second] = at.drives[self.winch.drive];
        // Derivatives may not vanish where values do.
        if rate.largest() == 0.0 && second.largest() == 0.0 {
            return;
        }
        for j in 0..at.chains[self.winch.chain].elements().len() {
            self.add_part(at, j, f);
        }
    }

    /// Adds the forces on an element.
    pub(super) fn add_part<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
        f: &mut [Node<D, N>],
    ) {
        let chain = &at.chains[self.winch.chain];
        let values = self.values(at, element);
        let forces = on_coordinates(&values, chain.element_length(element));
        chain.add_to(element, &forces, f);
    }

    /// Power that comes in, W.
    pub(super) fn power<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let (winch, chain) = (&self.winch, &at.chains[self.winch.chain]);
        winch.power(chain, (at.x, at.v), &winch.now(at.drives))
    }
}
