//! Every function in every mode with hostile arguments, against the lifecycle of the standard.

use std::cell::RefCell;

use proptest::collection::vec;
use proptest::prelude::any;
use proptest::test_runner::{Config, RngSeed, TestRunner};

use crate::hostile::{Master, Mode, Tally, foreign_unit, functions};
use crate::support::Unit;

#[test]
fn a_hostile_master_gets_what_the_standard_says() {
    let (unit, foreign) = (Unit::new(), foreign_unit());
    let tally = RefCell::new(Tally::new());
    let config = Config {
        cases: 1000,
        rng_seed: RngSeed::Fixed(5),
        failure_persistence: None,
        max_shrink_iters: 2_000,
        ..Config::default()
    };
    let started = std::time::Instant::now();
    let outcome = TestRunner::new(config).run(&vec(any::<u8>(), 1500), |bytes| {
        let mut master = Master::new(&unit, &foreign, false);
        master.run(&bytes);
        for (place, calls) in std::mem::take(&mut master.tally) {
            *tally.borrow_mut().entry(place).or_default() += calls;
        }
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    let tally = tally.into_inner();
    println!(
        "{} calls in {:?}",
        tally.values().sum::<u64>(),
        started.elapsed()
    );
    for function in functions() {
        for mode in Mode::ALL {
            let place = (function, format!("{mode:?}"));
            let calls = tally.get(&place).copied().unwrap_or_default();
            assert!(calls >= 10, "{function} in {mode:?}: {calls} calls");
        }
    }
}
