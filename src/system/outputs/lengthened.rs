//! Derivatives of what cables that are paid out add: every number of theirs changes with their length.

use nalgebra::SVector;

use super::derivatives::Derivatives;
use crate::body::Node;
use crate::elements::{Element, Nodal};
use crate::math::jet::{Jet, Number};
use crate::system::{Evaluation, System};

impl<const D: usize> Derivatives<D> {
    /// Adds weight, and inertia forces of accelerations that do not follow from those of coordinates, to forces on the nodes.
    pub(super) fn lengthen(&mut self, system: &System<D>) {
        if system.winches().is_empty() {
            return;
        }
        let (values, scratch) = (&self.values, &mut self.pulled);
        scratch.fill([[Jet::from_re(0.0); D]; 2]);
        system.add_lengthened(&values.drives, (&values.x, &values.v), scratch);
        for winch in system.winches() {
            let (chain, longer) = (&system.chains()[winch.chain], winch.now(&values.drives));
            let longer = Jet::of(1.0) / longer.by;
            let gravity: SVector<Jet, D> = winch.gravity.map(Jet::of) * (longer - Jet::of(1.0));
            for (j, element) in chain.elements().iter().enumerate() {
                let moved: Nodal<D, Jet> = chain.element(j, scratch);
                let inertia = moved * element.mass().map(Jet::of) * longer;
                let weight = gravity * element.weight().transpose().map(Jet::of);
                chain.add_to(j, &(weight - inertia), &mut self.f);
            }
        }
    }

    /// Takes derivative `k` of the accelerations of coordinates, over the nodes, to what it is in that of the nodes.
    pub(super) fn lengthen_accelerations(
        &mut self,
        system: &System<D>,
        plain: &Evaluation<D>,
        k: usize,
    ) {
        for winch in system.winches() {
            let [root, ..] = winch.now(&self.values.drives).root;
            for node in winch.range() {
                let driven = self.driven[node].as_flattened();
                let known = self.values.acceleration[node].as_flattened();
                let value = plain.acceleration[node].as_flattened();
                let found = self.other[node].as_flattened_mut().iter_mut();
                for (i, found) in found.enumerate() {
                    let own = (value[i] - driven[i].re) / root.re;
                    let below = match k {
                        1 => root.v1 * own,
                        _ => {
                            let first = known[i].v1 - driven[i].v1 - root.v1 * own;
                            2.0 * root.v1 * first / root.re + root.v2 * own
                        }
                    };
                    *found = root.re * *found + below;
                }
            }
        }
    }

    /// What a constraint's derivative by a node is by its coordinates.
    pub(super) fn shortened(
        system: &System<D>,
        (node, drives): (usize, &[[Jet; 3]]),
        term: &Node<D, Jet>,
    ) -> Node<D, Jet> {
        let root = system.root_at(node, drives);
        term.map(|vector| vector.map(|number| number * root))
    }

    /// Adds the inertia that a longer cable has more to what constraints supply.
    pub(super) fn lengthen_supply(&mut self, system: &System<D>) {
        let values = &mut self.values;
        for winch in system.winches() {
            let chain = &system.chains()[winch.chain];
            let more = Jet::of(1.0) / winch.now(&values.drives).by - Jet::of(1.0);
            for (j, element) in chain.elements().iter().enumerate() {
                let a: Nodal<D, Jet> = chain.element(j, &values.acceleration);
                let inertia = a * element.mass().map(Jet::of) * more;
                chain.add_to(j, &inertia, &mut values.supply);
            }
        }
    }
}
