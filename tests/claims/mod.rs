//! Every key of the scene format, every output, input and parameter has a claim that moves with it.
//!
//! A specimen is a small scene with claims in closed form. The tests walk the published JSON Schema,
//! change every key of every specimen, leave it out, or put it where it was not, and expect that a claim
//! notices; a key for which none does is named.

mod coverage;
mod elements;
mod mutate;
mod own;
mod patches;
mod quantities;
mod reduced;
mod scenes;
mod schema;
mod settings;
mod specimen;
