//! Error against CPU time: projection against coordinate partitioning on rigid mechanisms.

use anyhow::{Context, Result};

use super::bench::{Bench, Outcome, Run};
use super::csv::{Csv, digits};
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

/// Measures.
pub fn measure(bench: &Bench) -> Result<()> {
    let (mut runs, mut plan) = (Vec::new(), Vec::new());
    for mechanism in MECHANISMS {
        let scene = bench.case(mechanism.1)?;
        let times = bench.table(mechanism.2)?.column("t")?;
        let last = times.last().zip(times.get(1));
        let (stop_time, step) = last.context("expected a reference of two times at least")?;
        for method in METHODS {
            for tolerance in TOLERANCES {
                let run = Run::new(&scene, *stop_time, *step);
                let options = format!(
                    "--method {} --constraints {} --tolerance {tolerance:e}",
                    method.0, method.1
                );
                runs.push(match method.1 {
                    "projection" => run.tolerance(tolerance).integrator(method.0),
                    _ => run.by_lab(options.split(' ').map(str::to_owned).collect()),
                });
                plan.push((mechanism, method, tolerance));
            }
        }
    }
    let header = "mechanism,integrator,constraints,tolerance,error_m,cpu_time_s,steps,rejected,newton_iterations,\
                  residual_position,residual_velocity";
    let mut csv = Csv::new(bench, "constraints", header);
    for ((mechanism, method, tolerance), outcome) in
        plan.into_iter().zip(bench.time("constraints", &runs)?)
    {
        let reference = bench.table(mechanism.2)?;
        let [error, time, steps, rejected, iterations, position, velocity] =
            &cells(mechanism.3, &reference, &outcome)?;
        let tolerance = format!("{tolerance:e}");
        csv.row(&[
            &mechanism.0,
            &method.0,
            &method.1,
            &tolerance,
            error,
            time,
            steps,
            rejected,
            iterations,
            position,
            velocity,
        ]);
    }
    csv.save()
}

/// What a run showed; nothing where it failed.
fn cells(place: Place, reference: &Table, outcome: &Outcome) -> Result<[String; 7]> {
    let Ok(cost) = &outcome.cost else {
        return Ok(Default::default());
    };
    let table = outcome.table()?;
    let mut squares = vec![0.0; table.column("time")?.len()];
    for (output, column) in place {
        let pairs = table
            .column(output)?
            .into_iter()
            .zip(reference.column(column)?);
        for (square, (found, known)) in squares.iter_mut().zip(pairs) {
            *square += (found - known).powi(2);
        }
    }
    Ok([
        digits(largest(squares).sqrt()),
        digits(cost.cpu_time),
        cost.steps.to_string(),
        cost.rejected.to_string(),
        cost.newton_iterations.to_string(),
        digits(largest(table.column("residual.position")?)),
        digits(largest(table.column("residual.velocity")?)),
    ])
}
