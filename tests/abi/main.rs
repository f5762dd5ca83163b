//! The C interface, called the way a master calls it.

mod instantiation;
mod lifecycle;
mod logging;
mod states;
mod steps;
mod support;
mod values;
