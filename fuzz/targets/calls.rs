//! Bytes as calls of a hostile master, each answer checked against the lifecycle of the standard.
#![no_main]

#[path = "../../tests/abi/hostile/mod.rs"]
#[allow(
    dead_code,
    unused_imports,
    reason = "shared with the tests of the C interface"
)]
mod hostile;
#[path = "../../tests/abi/support.rs"]
#[allow(dead_code, reason = "shared with the tests of the C interface")]
mod support;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let (unit, foreign) = (support::Unit::new(), hostile::foreign_unit());
    hostile::Master::new(&unit, &foreign, true).run(data);
});
