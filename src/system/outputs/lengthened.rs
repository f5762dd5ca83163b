//! Derivatives of what cables that are paid out add: every number of theirs changes with their length.

use super::derivatives::Derivatives;
use crate::math::jet::{Jet, Number};
use crate::system::{Evaluation, System};

impl<const D: usize> Derivatives<D> {
    /// Takes derivative `k` of the accelerations of coordinates, over the nodes, to what it is in that of the nodes.
    pub(super) fn lengthen_accelerations(
        &mut self,
        system: &System<D>,
        plain: &Evaluation<D>,
        k: usize,
    ) {
        for (_, winch) in system.bodies.winches() {
            let [root, ..] = winch.now(&self.values.drives).root;
            for node in winch.nodes.clone() {
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

    /// Adds the inertia that a longer cable has more to what constraints supply.
    pub(super) fn lengthen_supply(&mut self, system: &System<D>) {
        let values = &mut self.values;
        for (chain, winch) in system.bodies.winches() {
            let more = winch.now(&values.drives).longer_by() - Jet::of(1.0);
            chain.add_inertia(
                more,
                &values.acceleration,
                &mut values.linear_constraint_forces,
            );
        }
    }
}
