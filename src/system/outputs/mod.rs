//! What is read of a system at a state, and its derivatives.

mod across;
mod clamp;
pub(in crate::system) mod derivatives;
mod edge;
pub(in crate::system) mod evaluation;
pub(in crate::system) mod fit;
mod forces;
pub(in crate::system) mod gauge;
mod patch_resolution;
mod resolution;
pub(in crate::system) mod rod;
pub(in crate::system) mod section;
pub(in crate::system) mod stress;
pub(in crate::system) mod surface;
