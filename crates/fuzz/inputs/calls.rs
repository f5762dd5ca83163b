//! Bytes as calls of a hostile master, each answer checked against the lifecycle of the standard.

use crate::{hostile, support};

/// Puts bytes through all of it.
pub fn put_through(data: &[u8]) {
    let (unit, foreign) = (support::Unit::new(), hostile::foreign_unit());
    hostile::Master::new(&unit, &foreign, true).run(data);
}
