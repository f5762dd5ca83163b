//! Small motions about a state: the linearized equations, their natural frequencies and eigenvalues.

mod dense;
pub(in crate::system) mod fastest;
mod iteration;
pub(in crate::system) mod linearization;
pub(in crate::system) mod modes;
pub(in crate::system) mod response;
mod rotating_constraints;
mod shifted;
pub(in crate::system) mod spectrum;
