//! Finite elements to compare the product's cable with: planar rods that stretch and bend, with the
//! same strain energy but any shape functions, meshes, quadratures and masses.

pub mod band;
pub mod basis;
pub mod rod;
pub mod rule;

#[cfg(test)]
mod tests;
