//! The C interface, called the way a master calls it.

mod guest;
mod hostile;
mod instantiation;
mod lifecycle;
mod logging;
mod parallelogram;
mod random;
mod resources;
mod runs;
mod states;
mod steps;
mod support;
mod tolerances;
mod values;
