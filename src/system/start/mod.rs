//! Where a system starts from: bodies that fit together, at rest in equilibrium or in a steady motion.

pub mod equilibrium;
pub(in crate::system) mod gaps;
pub(in crate::system) mod held;
pub(in crate::system) mod placement;
pub(in crate::system) mod steady;
