//! Bytes as the file of a reduced body.
#![no_main]

#[path = "../inputs/container.rs"]
mod container;

libfuzzer_sys::fuzz_target!(|data: &[u8]| container::put_through(data));
