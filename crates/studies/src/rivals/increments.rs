//! Incremental method in the strict sense, as the report has it: the displacement of every increment goes through the
//! linear strains of a conventional beam element, then its axes follow.
//!
//! Source: A. A. Shabana, Finite element incremental approach and exact rigid body inertia, J. Mech. Des. 118 (1996)
//! 171-178.

use super::{dot, plus};

/// Axial strain that an undeformed element has gathered after a whole turn about its first node in so many equal
/// increments: 0 were rigid motion exact.
pub fn stretch_of_a_turn(increments: usize) -> f64 {
    let full = std::f64::consts::TAU;
    let end = |count: usize| {
        let (s, c) = (full * count as f64 / increments as f64).sin_cos();
        [c, s]
    };
    let strain = (0..increments).map(|count| {
        let displacement = plus(end(count + 1), -1.0, end(count));
        // Along the axis that the element has at the start of the increment; unit length.
        dot(end(count), displacement)
    });
    strain.sum()
}
