//! Tests of the library from outside: one program, so that it is linked once.

mod abi;
mod bounds;
mod cases;
mod cases_runner;
mod checkers;
mod claims;
mod dense;
mod derivatives;
mod driven_inputs;
mod elements;
mod equilibria;
mod examples;
mod hostile_scenes;
mod house;
mod laws;
mod order;
mod planner;
mod scenes;
mod selection;
mod steps;

/// The folder of the project.
fn root() -> &'static std::path::Path {
    let own = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().expect("a folder above the tests")
}

// Files that fuzzing shares find these at the root.
use abi::{hostile, saved, support};
