//! Bytes as calls of a hostile master.
#![no_main]

#[path = "../inputs/calls.rs"]
mod calls;
#[path = "../../../tests/abi/hostile/mod.rs"]
#[allow(
    dead_code,
    unused_imports,
    reason = "shared with the tests of the C interface"
)]
mod hostile;
#[path = "../../../tests/abi/support.rs"]
#[allow(dead_code, reason = "shared with the tests of the C interface")]
mod support;

libfuzzer_sys::fuzz_target!(|data: &[u8]| calls::put_through(data));
