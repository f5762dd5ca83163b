//! How a system moves: forces on its nodes, constraints, accelerations, and what integrators see of them.

pub(in crate::system) mod breaks;
pub(in crate::system) mod dynamics;
mod events;
mod followed;
pub(in crate::system) mod forces;
mod frictions;
mod latches;
pub(in crate::system) mod multipliers;
pub(in crate::system) mod prices;
pub(in crate::system) mod rank;
mod rotations;
pub(in crate::system) mod sticking;
pub(in crate::system) mod tree;
