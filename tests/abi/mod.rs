//! The C interface, called the way a master calls it.

mod corpus;
mod guest;
pub mod hostile;
mod instantiation;
mod lifecycle;
mod logging;
mod parallelogram;
mod random;
mod resources;
mod runs;
#[path = "../../crates/fuzz/inputs/saved.rs"]
pub mod saved;
mod states;
mod steps;
pub mod support;
mod tolerances;
mod values;
