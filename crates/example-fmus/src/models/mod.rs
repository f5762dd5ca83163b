//! The models, one file each.

use crate::model::{Model, Quantity};

mod hydraulic_cylinder;
mod mass;
mod pi_controller;
mod spring_damper;

/// All models of the library.
pub static ALL: [Model; 4] = [
    mass::MODEL,
    spring_damper::MODEL,
    pi_controller::MODEL,
    hydraulic_cylinder::MODEL,
];

/// A quantity with a start value.
const fn quantity(
    name: &'static str,
    unit: &'static str,
    start: f64,
    description: &'static str,
) -> Quantity {
    Quantity {
        name,
        unit,
        start,
        description,
    }
}

/// An output.
const fn output(name: &'static str, unit: &'static str, description: &'static str) -> Quantity {
    quantity(name, unit, 0.0, description)
}
