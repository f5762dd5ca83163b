//! Joints that hold what others hold already, at the start, at a dead point and along the way, by their names.

use super::engine::Engine;
use crate::system::{HoldingParts, State};

/// Part of a constraint that is left beside the others near a dead point.
const NEAR: f64 = 1e-2;

/// Names of what holds, at least in part, what others hold already.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RedundantNames {
    /// Exactly: this does no harm, what is held twice is held once.
    pub exactly: Vec<String>,
    /// Nearly: accelerations and reactions are found as if these did not hold it.
    pub nearly: Vec<String>,
}

/// Meaning of nearly redundant joints, and remedies, for messages.
pub const NEARLY: &str = "accelerations and reactions here are those without them; give lengths and axes that agree in \
                          all digits, release what is held twice, or start from another position";

/// A singular position that a motion came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Singular {
    /// When, s.
    pub time: f64,
    /// Names of joints, gears, motions and bodies whose constraints repeat others there, exactly or nearly.
    pub names: Vec<String>,
}

impl std::fmt::Display for Singular {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { time, names } = self;
        let names = names.join(", ");
        write!(
            f,
            "{names}: at {time} s at or near a singular position, where others hold this already; accelerations and \
             reactions there are those without it, positions and velocities are kept; read them elsewhere, or change \
             lengths so that the motion keeps away"
        )
    }
}

impl<const D: usize> Engine<D> {
    /// Finds joints, gears, motions and bodies whose constraints repeat others at a state.
    pub(super) fn redundant(&mut self, state: &State) -> RedundantNames {
        let found = (self.assembled.system).redundant_at(state, &mut self.work);
        self.forget();
        RedundantNames {
            exactly: self.names(&found.exactly),
            nearly: self.names(&found.nearly),
        }
    }

    /// Lists the owners of constraints that nearly repeat others at this state but not at every state, in words. `None`
    /// if there are none.
    pub(super) fn newly_redundant(&mut self, state: &State) -> Option<String> {
        let held = (self.assembled.system).held_within(NEAR, state, &mut self.work);
        self.forget();
        let names = self.names(&held);
        let names: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
        (!names.is_empty()).then(|| names.join(", "))
    }

    /// A singular position that steps came to, with what was not told of before.
    pub(super) fn next_singular(&mut self) -> Option<Singular> {
        let (time, held) = self.assembled.system.newly_singular(&mut self.work)?;
        let names = self.names(&held);
        Some(Singular { time, names })
    }

    fn names(&self, held: &HoldingParts) -> Vec<String> {
        let holders = held.holders.iter().map(|holder| self.name(*holder));
        let bodies = held.bodies.iter().map(|body| &self.bodies[*body][..]);
        holders.chain(bodies).map(str::to_owned).collect()
    }
}
