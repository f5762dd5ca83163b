//! Mass on a line.

use super::{Model, output, quantity};

/// `m x'' = F - k x - d x' + k_c (x_o - x) + d_c (x_o' - x')`: a mass with a spring and a damper to
/// the ground, and a coupling spring and damper of its own to another body's position `x_o`.
pub const MODEL: Model = Model {
    name: "mass",
    description: "Mass on a line with springs and dampers to the ground and to another body",
    inputs: &[
        quantity("force", "N", 0.0, "Force on the mass"),
        quantity("other_position", "m", 0.0, "Position of the other body"),
        quantity("other_velocity", "m/s", 0.0, "Velocity of the other body"),
    ],
    outputs: &[
        output("position", "m", "Position"),
        output("velocity", "m/s", "Velocity"),
        output("acceleration", "m/s2", "Acceleration"),
        output("coupling_force", "N", "Coupling force on the other body"),
    ],
    parameters: &[
        quantity("mass", "kg", 1.0, "Mass"),
        quantity("stiffness", "N/m", 0.0, "Stiffness to the ground"),
        quantity("damping", "N.s/m", 0.0, "Damping to the ground"),
        quantity("coupling_stiffness", "N/m", 0.0, "Coupling stiffness"),
        quantity("coupling_damping", "N.s/m", 0.0, "Coupling damping"),
        quantity("initial_position", "m", 0.0, "Position at the start"),
        quantity("initial_velocity", "m/s", 0.0, "Velocity at the start"),
    ],
    initial: |p| vec![p[5], p[6]],
    rates: |p, x, u| vec![x[1], acceleration(p, x, u)],
    read: |p, x, u| vec![x[0], x[1], acceleration(p, x, u), coupling_force(p, x, u)],
};

fn coupling_force(p: &[f64], x: &[f64], u: &[f64]) -> f64 {
    p[3] * (x[0] - u[1]) + p[4] * (x[1] - u[2])
}

fn acceleration(p: &[f64], x: &[f64], u: &[f64]) -> f64 {
    (u[0] - p[1] * x[0] - p[2] * x[1] - coupling_force(p, x, u)) / p[0]
}
