//! Floor 0. Numerics that know nothing of mechanics: quadrature, structured solves, eigenvalues.
//! The only user of pulp.

pub mod curve;
pub mod eigen;
pub mod expression;
pub mod function;
mod grammar;
mod hessenberg;
pub mod householder;
mod interval;
pub mod jet;
pub mod krylov;
pub mod lanes;
pub mod least;
pub mod quadrature;
pub mod radau;
pub mod recent;
pub mod rotation;
pub mod row_space;
pub mod space;
pub mod sparse;
pub mod state_expression;
pub mod sums;
pub mod switches;
pub mod vector;
