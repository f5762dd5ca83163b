//! Hydraulic cylinder behind a servo valve.
//! Source: H. E. Merritt, Hydraulic Control Systems, Wiley 1967, section 6-1: a double-ended
//! cylinder near mid-stroke with a critical-centre valve, linear in the load pressure.

use super::{Model, output, quantity};

/// Load flow of the valve `Q = K_q x_v - K_c p` fills the chambers, `Q = A v + V/(4 beta) p'`, with
/// leakage in `K_c`; the piston pushes with `F = A p`. A motion of the piston changes the pressure,
/// never the force at once.
pub const MODEL: Model = Model {
    name: "hydraulic_cylinder",
    description: "Double-ended hydraulic cylinder behind a servo valve, linear (Merritt 1967)",
    inputs: &[
        quantity("valve", "m", 0.0, "Opening of the valve"),
        quantity("velocity", "m/s", 0.0, "Velocity of the piston"),
    ],
    outputs: &[
        output("force", "N", "Force of the piston on the load"),
        output("pressure", "Pa", "Load pressure between the chambers"),
    ],
    parameters: &[
        quantity("area", "m2", 1.0e-3, "Area of the piston"),
        quantity(
            "flow_gain",
            "m2/s",
            0.5,
            "Load flow per opening of the valve",
        ),
        quantity(
            "leakage",
            "m4.s/kg",
            1.0e-11,
            "Loss of load flow per load pressure",
        ),
        quantity("volume", "m3", 1.0e-3, "Volume of both chambers"),
        quantity(
            "bulk_modulus",
            "Pa",
            7.0e8,
            "Effective bulk modulus of the oil",
        ),
    ],
    initial: |_| vec![0.0],
    rates: |p, x, u| {
        let flow = p[1] * u[0] - p[2] * x[0] - p[0] * u[1];
        vec![4.0 * p[4] / p[3] * flow]
    },
    read: |p, x, _| vec![p[0] * x[0], x[0]],
};
