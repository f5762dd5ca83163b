//! What the law tests share: random mechanisms and the dense equations that they are compared with.
#![expect(dead_code, reason = "the law tests use more of it")]

#[path = "../../../tests/laws/built.rs"]
pub mod built;
#[path = "../../../tests/laws/chain.rs"]
pub mod chain;
#[path = "../../../tests/laws/dense.rs"]
pub mod dense;
#[path = "../../../tests/laws/differences.rs"]
pub mod differences;
#[path = "../../../tests/laws/mechanism.rs"]
pub mod mechanism;
#[path = "../../../tests/laws/random.rs"]
pub mod random;
#[path = "../../../tests/laws/specimen.rs"]
pub mod specimen;
