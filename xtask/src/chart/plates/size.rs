//! What plates cost on ever larger meshes: an acceleration, a step of an explicit method, a step of an implicit one.

use anyhow::{Context, Result};

use super::problems::{Problem, panel, thrown};
use crate::chart::bench::{Bench, Ran, Run};
use crate::chart::csv::Csv;
use crate::chart::numbers::number;

/// Numbers of elements of a side.
const SIDES: [u32; 9] = [4, 6, 8, 12, 16, 20, 28, 36, 50];
/// Time of the explicit method over the number of elements of a side, whose steps are as much shorter, and time of the implicit one, s.
const EXPLICIT: f64 = 0.2;
const IMPLICIT: f64 = 0.01;
/// Tolerance of both.
const TOLERANCE: f64 = 1e-4;
/// Rounds, and what runs once, s.
const ROUNDS: usize = 3;
const LONG: f64 = 3.0;

/// A run to its end in one communication step.
fn run(problem: &Problem, side: u32, method: &str, stop: f64) -> Run {
    let run = Run::new(&problem.scene(side), stop, stop);
    run.integrator(method).tolerance(TOLERANCE)
}

/// Measures costs over sizes.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let header = "side,elements,numbers,acceleration_s,dopri853_step_s,radau_step_s,radau_iterations,radau_iteration_s";
    let mut csv = Csv::new(bench, "plates_size", header);
    let (thrown, panel) = (thrown(), panel());
    let mut runs = Vec::new();
    for side in SIDES {
        let stop = EXPLICIT / f64::from(side);
        runs.push(run(&thrown, side, "dopri853", stop));
        runs.push(run(&panel, side, "radau", IMPLICIT));
    }
    let mut ran = bench
        .repeat("plates, sizes", &runs, ROUNDS, LONG)?
        .into_iter();
    for side in SIDES {
        let mut next = || -> Result<Ran> { ran.next().context("expected a run")? };
        let (explicit, implicit) = (next()?, next()?);
        let report = bench.studies(&["dynamics"], Some(&thrown.scene(side)))?;
        let numbers = number(&report["coordinates"])?;
        let acceleration = number(&report["acceleration"])?;
        let iterations = implicit.number("newton_iterations") / implicit.number("steps");
        csv.row(&[
            &side,
            &(side * side),
            &numbers,
            &acceleration,
            &explicit.per("steps"),
            &implicit.per("steps"),
            &iterations,
            &implicit.per("newton_iterations"),
        ]);
    }
    csv.save()
}
