//! Inertia forces of the material of a cable that a winch pays out, which passes through its mesh ([`Winch`]): those that
//! accelerations of the nodes do not tell.

use super::{ForceElement, Instant};
use crate::bodies::winch::PaidOut;
use crate::bodies::{Bodies, Node};
use crate::elements::shape::{Values, on_coordinates};
use crate::math::jet::Number;

/// Inertia forces of material that a winch moves through the mesh of its cable.
#[derive(Clone, Debug)]
pub struct ConvectiveInertia {
    /// Index of the cable among the lines.
    pub line: usize,
}

impl ConvectiveInertia {
    fn cable<'a, const D: usize, N: Number>(&self, at: Instant<'a, D, N>) -> PaidOut<'a, D, N> {
        let paid_out = at.bodies.lines()[self.line].paid_out(at.drives);
        paid_out.expect("a winch pays the cable out")
    }

    /// Forces at the Gauss points of an element, N/m.
    pub(super) fn values<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> Values<D, N> {
        let of = self.cable(at);
        of.winch.transport(of.chain, element, (at.x, at.v), &of.now)
    }
}

impl<const D: usize> ForceElement<D> for ConvectiveInertia {
    /// Nodes of its elements.
    fn parts(&self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        let chain = &bodies.lines()[self.line];
        let elements = 0..chain.elements().len();
        elements.map(|j| chain.nodes(j).to_vec()).collect()
    }

    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        let of = self.cable(at);
        let [_, rate, second] = at.drives[of.winch.coordinate];
        // Derivatives may not vanish where values do.
        if rate.largest() == 0.0 && second.largest() == 0.0 {
            return;
        }
        for j in 0..of.chain.elements().len() {
            self.add_part(at, j, f);
        }
    }

    /// Adds the forces on an element.
    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, element: usize, f: &mut [Node<D, N>]) {
        let chain = &at.bodies.lines()[self.line];
        let values = self.values(at, element);
        let forces = on_coordinates(&values, chain.element_length(element));
        chain.add_to(element, &forces, f);
    }

    /// Power that comes in, W.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let of = self.cable(at);
        [of.winch.power(of.chain, (at.x, at.v), &of.now), N::of(0.0)]
    }

    fn changing<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        first: usize,
        segment: usize,
    ) -> Option<Values<D, N>> {
        (at.bodies.lines()[self.line].first_node() == first).then(|| self.values(at, segment))
    }

    /// Winches stand where equilibria are sought.
    fn work(&self, _before: Instant<'_, D>, _after: Instant<'_, D>) -> f64 {
        0.0
    }
}
