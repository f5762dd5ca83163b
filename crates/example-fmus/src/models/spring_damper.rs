//! Spring and damper between two bodies on a line.

use super::{Model, output, quantity};

/// `F_a = k (x_b - x_a) + d (x_b' - x_a') = -F_b`: no state, outputs follow inputs at once.
pub const MODEL: Model = Model {
    name: "spring_damper",
    description: "Spring and damper between two bodies a and b on a line",
    inputs: &[
        quantity("position_a", "m", 0.0, "Position of a"),
        quantity("velocity_a", "m/s", 0.0, "Velocity of a"),
        quantity("position_b", "m", 0.0, "Position of b"),
        quantity("velocity_b", "m/s", 0.0, "Velocity of b"),
    ],
    outputs: &[
        output("force_a", "N", "Force on a"),
        output("force_b", "N", "Force on b"),
    ],
    parameters: &[
        quantity("stiffness", "N/m", 1.0, "Stiffness"),
        quantity("damping", "N.s/m", 0.0, "Damping"),
    ],
    initial: |_| Vec::new(),
    rates: |_, _, _| Vec::new(),
    read: |p, _, u| {
        let force = p[0] * (u[2] - u[0]) + p[1] * (u[3] - u[1]);
        vec![force, -force]
    },
};
