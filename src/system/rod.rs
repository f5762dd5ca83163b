//! Straight rigid bodies with a uniform mass along them: cables that do not bend.

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
