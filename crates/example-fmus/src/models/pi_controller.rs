//! Controller with a proportional and an integral part.

use super::{Model, output, quantity};

/// `y = k_p e + I`, `I' = k_i e`, `e = reference - measured`. On a velocity it acts as a damper and
/// a spring to a point that moves with the reference.
pub const MODEL: Model = Model {
    name: "pi_controller",
    description: "Controller with a proportional and an integral part",
    inputs: &[
        quantity("reference", "", 0.0, "What the measured value should be"),
        quantity("measured", "", 0.0, "Measured value"),
    ],
    outputs: &[output("command", "", "Command")],
    parameters: &[
        quantity("proportional_gain", "", 1.0, "Command per error"),
        quantity("integral_gain", "1/s", 0.0, "Rate of command per error"),
        quantity("initial_command", "", 0.0, "Integral part at the start"),
    ],
    initial: |p| vec![p[2]],
    rates: |p, _, u| vec![p[1] * (u[0] - u[1])],
    read: |p, x, u| vec![p[0] * (u[0] - u[1]) + x[0]],
};
