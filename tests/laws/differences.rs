//! Derivatives by central differences, and a deterministic runner of random cases.

use std::fmt::Debug;
use std::ops::{Mul, Sub};

use flexbody::elements::{Blocks, Nodal};
use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngSeed, TestCaseError, TestError, TestRunner};

/// Outcome of a law in one case.
pub type Outcome = Result<(), TestCaseError>;

/// Checks a law on this many random cases, the same ones every time.
pub fn check<S>(cases: u32, strategy: S, law: impl Fn(S::Value) -> Outcome)
where
    S: Strategy,
    S::Value: Debug,
{
    let config = Config {
        cases,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1997),
        ..Config::default()
    };
    match TestRunner::new(config).run(&strategy, law) {
        Ok(()) => {}
        Err(TestError::Fail(reason, case)) => panic!("{reason}, for {case:?}"),
        Err(TestError::Abort(reason)) => panic!("{reason}"),
    }
}

/// Refuses an error above what is allowed; NaN is above everything.
pub fn within(what: &str, error: f64, allowed: f64) -> Outcome {
    if error <= allowed {
        return Ok(());
    }
    let message = format!("{what}: off by {error:.3e}, allowed {allowed:.3e}");
    Err(TestCaseError::fail(message))
}

/// Derivative at 0 by central differences, extrapolated once.
pub fn derivative<T>(step: f64, mut f: impl FnMut(f64) -> T) -> T
where
    T: Sub<Output = T> + Mul<f64, Output = T>,
{
    let mut central = |h: f64| (f(h) - f(-h)) * (0.5 / h);
    central(0.5 * step) * (4.0 / 3.0) - central(step) * (1.0 / 3.0)
}

/// Lengths that make coordinates and forces of an element comparable: positions count in lengths.
pub fn scaled<const D: usize>(x: &Nodal<D>, length: f64) -> Nodal<D> {
    let mut x = *x;
    for column in [0, 2] {
        x.column_mut(column).scale_mut(length);
    }
    x
}

/// All coordinate directions of an element of this length.
pub fn directions<const D: usize>(length: f64) -> Vec<Nodal<D>> {
    let unit = |index: usize| {
        let mut x = Nodal::zeros();
        x[(index % D, index / D)] = 1.0;
        scaled(&x, length)
    };
    (0..4 * D).map(unit).collect()
}

/// Product of a matrix of blocks with coordinates.
pub fn apply<const D: usize>(blocks: &Blocks<D>, x: &Nodal<D>) -> Nodal<D> {
    let mut y = Nodal::<D>::zeros();
    for (a, row) in blocks.iter().enumerate() {
        for (b, block) in row.iter().enumerate() {
            let sum = y.column(a) + block * x.column(b);
            y.set_column(a, &sum);
        }
    }
    y
}
