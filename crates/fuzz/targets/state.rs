//! Bytes as a saved state.
#![no_main]

#[path = "../inputs/saved.rs"]
mod saved;
#[path = "../inputs/state.rs"]
mod state;
#[path = "../../../tests/abi/support.rs"]
#[allow(dead_code, reason = "shared with the tests of the C interface")]
mod support;

libfuzzer_sys::fuzz_target!(|data: &[u8]| state::put_through(data));
