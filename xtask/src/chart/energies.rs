//! Energy over long times: of undamped pendulums over a hundred swings, of mechanisms over a minute.

use anyhow::{Context, Result};
use serde_json::Value;

use crate::table::Table;

use super::bench::{Bench, Run};
use super::csv::Csv;
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
    let part = |name: &str| table.column(&format!("energy.{name}"));
    let (kinetic, strain, gravity) = (part("kinetic")?, part("strain")?, part("gravity")?);
    let total = |i: usize| kinetic[i] + strain[i] + gravity[i];
    let times = table.column("time")?.into_iter().enumerate();
    Ok(times
        .map(|(i, time)| (time, (total(i) - total(0)) / scale))
        .collect())
}

/// Returns the largest size and the last value of a curve.
fn ends(curve: &[(f64, f64)]) -> [f64; 2] {
    let last = curve.last().map_or(0.0, |point| point.1);
    [largest(curve.iter().map(|point| point.1.abs())), last]
}

/// Measures the chart `drift`.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn drift(bench: &Bench) -> Result<()> {
    let header = "pendulum,method,tolerance,largest_drift,last_drift,steps,cpu_time_s";
    let mut csv = Csv::new(bench, "drift", header);
    let header = "pendulum,method,time_s,largest_drift";
    let mut curves = Csv::new(bench, "drift_curves", header);
    for (file, pendulum, method, tolerances) in PENDULUMS {
        let scene = bench.case(&format!("energy_drift/{file}"))?;
        let run = |tolerance: &f64| {
            let run = Run::new(&scene, SWINGS, 0.1).integrator(method);
            run.tolerance(*tolerance)
        };
        let runs: Vec<Run> = tolerances.iter().map(run).collect();
        let title = format!("drift, {pendulum}, {method}");
        for (tolerance, outcome) in tolerances.iter().zip(bench.run(&title, &runs)?) {
            let ran = outcome?;
            let curve = change(&ran.table, scale(&scene)?)?;
            let ([largest, last], steps) = (ends(&curve), ran.number("steps"));
            let (time, name) = (ran.cpu_time, pendulum);
            csv.row(&[&name, &method, tolerance, &largest, &last, &steps, &time]);
            for (time, largest) in peaks(&curve).iter().filter(|_| *tolerance == 1e-5) {
                curves.row(&[&pendulum, &method, time, largest]);
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
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn energies(bench: &Bench) -> Result<()> {
    let header = "mechanism,stop_time_s,method,tolerance,scale_J,largest_drift,last_drift,residual_position,\
                  residual_velocity,steps,cpu_time_s";
    let mut csv = Csv::new(bench, "energies", header);
    let mut curves = Csv::new(bench, "energies_curves", "mechanism,time_s,largest_drift");
    let tolerances = [1e-4, 1e-6, 1e-8];
    for (name, file, stop) in MECHANISMS {
        let scene = bench.case(file)?;
        let run = |tolerance| {
            let run = Run::new(&scene, stop, 0.05).integrator("auto");
            run.tolerance(tolerance)
        };
        let outcomes = bench.run(&format!("energies, {name}"), &tolerances.map(run))?;
        for (tolerance, outcome) in tolerances.into_iter().zip(outcomes) {
            let ran = outcome?;
            let most = |column: &str| anyhow::Ok(largest(ran.table.column(column)?));
            let scale = most("energy.kinetic")?;
            let curve = change(&ran.table, scale)?;
            let (method, [top, last]) = (ran.method(), ends(&curve));
            let (position, velocity) = (most("residual.position")?, most("residual.velocity")?);
            let (steps, time) = (ran.number("steps"), ran.cpu_time);
            csv.row(&[
                &name, &stop, &method, &tolerance, &scale, &top, &last, &position, &velocity,
                &steps, &time,
            ]);
            for (time, largest) in peaks(&curve).iter().filter(|_| tolerance == 1e-6) {
                curves.row(&[&name, time, largest]);
            }
        }
    }
    csv.save()?;
    curves.save()
}
