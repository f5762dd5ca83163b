//! Masses in points of bodies, and straight rigid bodies with a uniform mass along them: cables that do not bend.

use super::Marker;

/// Mass in a point of a body: a point mass, or a rigid body about its centre of mass.
#[derive(Clone, Copy, Debug)]
pub struct LumpedMass {
    /// Where it is.
    pub marker: Marker,
    /// Mass, kg.
    pub mass: f64,
    /// Mass of the fluid that moves along, kg: it has inertia and no weight.
    pub added: f64,
    /// Inertia of the direction against turning (and of a slope against stretching), kg m^2.
    pub inertia: f64,
}

impl LumpedMass {
    /// Mass that is moved, kg.
    pub fn moved(&self) -> f64 {
        self.mass + self.added
    }
}

/// A rigid body along its direction, its mass uniform and its node in the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidRod {
    /// Index of the node.
    pub node: usize,
    /// Length, m.
    pub length: f64,
    /// Place of its own mass among the lumped masses.
    pub mass: usize,
}
