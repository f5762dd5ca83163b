//! Energy over long times: of undamped pendulums over a hundred swings, of mechanisms over a minute.

use anyhow::{Context, Result};
use serde_json::Value;

use crate::table::Table;

use super::bench::{Bench, Run};
use super::csv::{Csv, digits};
use super::numbers::{largest, peaks};

/// Scene of the case, name, integrator, tolerances. Not steel with rkn43: stability would hold it to
/// steps of microseconds, minutes for a run.
type Pendulum = (&'static str, &'static str, &'static str, &'static [f64]);
const PENDULUMS: [Pendulum; 3] = [
    ("scene.json", "steel", "radau", &[1e-4, 1e-5, 1e-6]),
    ("soft.json", "soft", "radau", &[1e-4, 1e-5, 1e-6]),
    ("soft.json", "soft", "rkn43", &[1e-4, 1e-5, 1e-6, 1e-7]),
];
/// A hundred swings of the steel one, s.
const SWINGS: f64 = 212.0;

/// Name, scene and simulated time, s. A minute of the cables at three tolerances would take minutes of CPU time.
const MECHANISMS: [(&str, &str, f64); 3] = [
    ("double pendulum, rigid", "double_pendulum/scene.json", 60.0),
    (
        "double pendulum, cables",
        "double_pendulum/cables.json",
        10.0,
    ),
    ("ring on a rope", "ring_on_rope/scene.json", 60.0),
];

/// Change of the total energy over a scale, by time.
fn change(table: &Table, scale: f64) -> Result<Vec<(f64, f64)>> {
    let parts =
        ["energy.kinetic", "energy.strain", "energy.gravity"].map(|part| table.column(part));
    let [kinetic, strain, gravity] = parts;
    let (kinetic, strain, gravity) = (kinetic?, strain?, gravity?);
    let total = |i: usize| kinetic[i] + strain[i] + gravity[i];
    let times = table.column("time")?.into_iter().enumerate();
    Ok(times
        .map(|(i, time)| (time, (total(i) - total(0)) / scale))
        .collect())
}

/// Its largest size and its last value.
fn ends(curve: &[(f64, f64)]) -> [f64; 2] {
    let last = curve.last().map_or(0.0, |point| point.1);
    [largest(curve.iter().map(|point| point.1.abs())), last]
}

/// Measures the chart `drift`.
pub fn drift(bench: &Bench) -> Result<()> {
    let header = "pendulum,method,tolerance,largest_drift,last_drift,steps,cpu_time_s";
    let mut csv = Csv::new(bench, "drift", header);
    let mut curves = Csv::new(
        bench,
        "drift_curves",
        "pendulum,method,time_s,largest_drift",
    );
    for (file, pendulum, method, tolerances) in PENDULUMS {
        let scene = bench.case(&format!("energy_drift/{file}"))?;
        let run = |tolerance: &f64| {
            Run::new(&scene, SWINGS, 0.1)
                .integrator(method)
                .tolerance(*tolerance)
        };
        let runs: Vec<Run> = tolerances.iter().map(run).collect();
        let outcomes = bench.run(&format!("drift, {pendulum}, {method}"), &runs)?;
        for (tolerance, outcome) in tolerances.iter().zip(outcomes) {
            let (curve, cost) = (change(outcome.table()?, scale(&scene)?)?, outcome.cost()?);
            let [largest, last] = ends(&curve).map(digits);
            let time = digits(cost.cpu_time);
            csv.row(&[
                &pendulum,
                &method,
                &format!("{tolerance:e}"),
                &largest,
                &last,
                &cost.steps,
                &time,
            ]);
            if *tolerance == 1e-5 {
                for (time, largest) in peaks(&curve) {
                    curves.row(&[&pendulum, &method, &time, &digits(largest)]);
                }
            }
        }
    }
    csv.save()?;
    curves.save()
}

/// m g L/2 of a horizontal pendulum, J: what it could gain in falling to the lowest point.
fn scale(scene: &Value) -> Result<f64> {
    let body = &scene["bodies"][0];
    let end = |key: &str, axis: usize| body["shape"]["line"][key][axis].as_f64();
    let product = || {
        let length = (end("to", 0)? - end("from", 0)?).hypot(end("to", 1)? - end("from", 1)?);
        let mass = body["material"]["density"].as_f64()? * body["section"]["area"].as_f64()?;
        Some(mass * scene["gravity"][1].as_f64()?.abs() * length.powi(2) / 2.0)
    };
    product().context("energy_drift: expected a straight pendulum with density, area and gravity")
}

/// Measures the chart `energies`.
pub fn energies(bench: &Bench) -> Result<()> {
    let header = "mechanism,stop_time_s,method,tolerance,scale_J,largest_drift,last_drift,residual_position,\
                  residual_velocity,steps,cpu_time_s";
    let mut csv = Csv::new(bench, "energies", header);
    let mut curves = Csv::new(bench, "energies_curves", "mechanism,time_s,largest_drift");
    let tolerances = [1e-4, 1e-6, 1e-8];
    for (name, file, stop_time) in MECHANISMS {
        let scene = bench.case(file)?;
        let run = |tolerance| {
            Run::new(&scene, stop_time, 0.05)
                .integrator("auto")
                .tolerance(tolerance)
        };
        let outcomes = bench.run(&format!("energies, {name}"), &tolerances.map(run))?;
        for (tolerance, outcome) in tolerances.into_iter().zip(outcomes) {
            let (table, cost) = (outcome.table()?, outcome.cost()?);
            let scale = largest(table.column("energy.kinetic")?);
            let curve = change(table, scale)?;
            let [highest, last] = ends(&curve).map(digits);
            csv.row(&[
                &name,
                &stop_time,
                &cost.method,
                &format!("{tolerance:e}"),
                &digits(scale),
                &highest,
                &last,
                &digits(largest(table.column("residual.position")?)),
                &digits(largest(table.column("residual.velocity")?)),
                &cost.steps,
                &digits(cost.cpu_time),
            ]);
            if tolerance == 1e-6 {
                for (time, largest) in peaks(&curve) {
                    curves.row(&[&name, &time, &digits(largest)]);
                }
            }
        }
    }
    csv.save()?;
    curves.save()
}
