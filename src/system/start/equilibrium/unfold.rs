//! Folded elements. A cable without bending stiffness can be in balance with elements that fold back on themselves: both slopes point along
//! the line, and the tangent between them points against it. Such a state balances the forces of the discretization and is no state of a
//! cable. An equilibrium that has folds is looked for again from the start, with a bending stiffness under which nothing folds, and which
//! fades on the way.

use super::{BENT, CLOSING, FoundEquilibrium, Path};
use crate::bodies::Node;
use crate::system::{State, System, Workspace};

/// Bending stiffness shortly before there is none, relative to that at first.
const FADED: f64 = 1e-10;

impl Path<'_> {
    /// Finds an equilibrium of `held` without folded elements from `start`; `found` at `state` stays where it has none, or where none is
    /// found.
    pub(super) fn unfold<const D: usize>(
        &self,
        held: &System<D>,
        found: FoundEquilibrium,
        start: &State,
        work: &mut Workspace<D>,
        state: &mut State,
    ) -> FoundEquilibrium {
        if !held.is_folded(state, work) {
            return found;
        }
        let folded = state.clone();
        state.copy_from(start);
        let path = |fraction: f64, work: &Workspace<D>| {
            let mut part = held.clone();
            if fraction < 1.0 {
                part.scale_loads(f64::min(1.0, 2.0 * fraction), work);
                part.stiffen(
                    FADED.powf(f64::max(0.0, 2.0 * fraction - 1.0)),
                    &held.bodies.reference,
                );
            }
            part
        };
        match self.follow(CLOSING, path, work, state) {
            Ok(again) if !held.is_folded(state, work) => again,
            _ => {
                state.copy_from(&folded);
                found
            }
        }
    }
}

impl<const D: usize> System<D> {
    /// Gives cables without bending stiffness one, from the unstressed shape with these nodal coordinates on: a part of that under which joints
    /// are closed.
    pub(super) fn stiffen(&mut self, part: f64, shape: &[Node<D>]) {
        for chain in self.bodies.lines_mut() {
            let stiffness = BENT * chain.axial_stiffness() * chain.length().powi(2);
            chain.stiffen(part * stiffness, shape);
        }
    }

    /// Whether an element folds back on itself.
    pub(super) fn is_folded(&self, state: &State, work: &mut Workspace<D>) -> bool {
        let x = self.nodes_of(state, work);
        self.bodies.lines().iter().any(|chain| {
            let mut elements = 0..chain.elements().len();
            elements.any(|j| chain.is_folded(j, &x))
        })
    }
}
