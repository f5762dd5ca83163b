//! Error against CPU time: projection against coordinate partitioning on rigid mechanisms.

use anyhow::{Context, Result};

use super::bench::{Bench, Ran, Run};
use super::csv::Csv;
use super::numbers::largest;
use crate::table::Table;

const TOLERANCES: [f64; 6] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
/// Integrator and treatment of constraints.
const METHODS: [(&str, &str); 3] = [
    ("rk4", "projection"),
    ("rk4", "partitioning"),
    ("radau", "projection"),
];
/// Coordinates of a point: outputs with columns of a reference.
type Place = &'static [(&'static str, &'static str)];
const TIP: Place = &[
    ("lower.tip.position[1]", "x_tip"),
    ("lower.tip.position[2]", "y_tip"),
];
const PIN: Place = &[
    ("crank.pin.position[1]", "x_A"),
    ("crank.pin.position[2]", "y_A"),
];
const BLOCK: Place = &[("block.centre.position[1]", "x_B")];
/// Name, scene, reference, the point that is compared.
#[rustfmt::skip]
const MECHANISMS: [(&str, &str, &str, Place); 4] = [
    ("slider-crank", "slider_crank_free/scene.json", "slider_crank_free/reference.csv", BLOCK),
    ("double pendulum", "double_pendulum/scene.json", "double_pendulum/reference.csv", TIP),
    ("parallelogram, heavy", "parallelogram/heavy.json", "parallelogram/heavy.csv", PIN),
    ("parallelogram, landing", "parallelogram/landing.json", "parallelogram/landing.csv", PIN),
];

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let (mut runs, mut plan) = (Vec::new(), Vec::new());
    for mechanism in MECHANISMS {
        let (scene, reference) = (bench.case(mechanism.1)?, bench.table(mechanism.2)?);
        let times = reference.column("t")?;
        let last = times.last().zip(times.get(1));
        let (stop, every) = last.context("expected a reference of two times at least")?;
        for method in METHODS {
            for tolerance in TOLERANCES {
                let run = Run::new(&scene, *stop, *every);
                let options = [
                    ("--method", method.0.to_owned()),
                    ("--constraints", method.1.to_owned()),
                    ("--tolerance", tolerance.to_string()),
                ];
                runs.push(match method.1 {
                    "projection" => run.tolerance(tolerance).integrator(method.0),
                    _ => run.by_lab(&options, None),
                });
                plan.push((mechanism, method, tolerance));
            }
        }
    }
    let header = "mechanism,integrator,constraints,tolerance,error_m,cpu_time_s,steps,rejected,\
                  newton_iterations,residual_position,residual_velocity";
    let mut csv = Csv::new(bench, "constraints", header);
    let outcomes = bench.time("constraints", &runs)?;
    for ((mechanism, (integrator, treatment), tolerance), outcome) in plan.iter().zip(outcomes) {
        let (name, _, reference, place) = mechanism;
        let found = match outcome {
            Ok(ran) => numbers(place, &bench.table(reference)?, &ran)?,
            Err(_) => [f64::NAN; 7],
        };
        let [error, time, steps, rejected, newton, position, velocity] = &found;
        csv.row(&[
            name, integrator, treatment, tolerance, error, time, steps, rejected, newton, position,
            velocity,
        ]);
    }
    csv.save()
}

/// Error, cost and residuals of a run.
fn numbers(place: Place, reference: &Table, ran: &Ran) -> Result<[f64; 7]> {
    let mut squares = vec![0.0; ran.table.column("time")?.len()];
    for (output, column) in place {
        let pairs = ran.table.column(output)?.into_iter();
        let pairs = pairs.zip(reference.column(column)?);
        for (square, (found, known)) in squares.iter_mut().zip(pairs) {
            *square += (found - known).powi(2);
        }
    }
    let residual = |kind: &str| ran.table.column(&format!("residual.{kind}")).map(largest);
    let [steps, rejected, iterations] =
        ["steps", "rejected", "newton_iterations"].map(|key| ran.number(key));
    Ok([
        largest(squares).sqrt(),
        ran.cpu_time,
        steps,
        rejected,
        iterations,
        residual("position")?,
        residual("velocity")?,
    ])
}
