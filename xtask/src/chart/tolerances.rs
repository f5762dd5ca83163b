//! What the tolerance holds: errors of every kind of output of the ready scenes over it.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, Ran, Run};
use super::csv::Csv;
use super::planned;

const TOLERANCES: [f64; 6] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];
/// Tolerance of the references, all with the implicit method: explicit ones are stable there or are not.
const REFERENCE: f64 = 1e-10;
/// Ready scenes, and those of them that rest in their default experiment: they are let go from their shapes.
const SCENES: &str = "boom cantilever crane double_pendulum flying_spaghetti four_bar hanging_cable \
                      pendulum robot_arm slider_crank spin_up_beam travelling_load";
const RESTING: [&str; 4] = ["boom", "cantilever", "crane", "hanging_cable"];
/// Kinds of outputs that magnify errors.
const FORCES: &str =
    "reaction reaction_moment axial_force bending_moment force moment acceleration strain";

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let header = "scene,output,kind,class,tolerance,method,steps,error,over_tolerance,named";
    let mut csv = Csv::new(bench, "tolerances", header);
    for name in SCENES.split(' ') {
        let mut scene = bench.json(&format!("scenes/{name}.json"))?;
        if RESTING.contains(&name) {
            scene["initial"] = json!("undeformed");
        }
        planned::settle(bench, &mut scene)?;
        let number = |key: &str| scene["experiment"][key].as_f64();
        let (stop, step) = (number("stop_time"), number("step"));
        let (stop, step) = stop.zip(step).context("expected an experiment")?;
        let run = |tolerance: f64| Run::new(&scene, stop, step).tolerance(tolerance);
        let mut runs = vec![run(REFERENCE).integrator("radau")];
        runs.extend(TOLERANCES.map(run));
        let outcomes = bench.run(&format!("tolerances, {name}"), &runs)?;
        let mut outcomes = outcomes.into_iter();
        let reference = outcomes.next().context("expected runs")??;
        for (tolerance, outcome) in TOLERANCES.into_iter().zip(outcomes) {
            compare(&mut csv, name, tolerance, &reference, &outcome?)?;
        }
    }
    csv.save()
}

/// Adds the errors of all outputs of a run, each over the largest size of the output.
fn compare(csv: &mut Csv, scene: &str, tolerance: f64, reference: &Ran, ran: &Ran) -> Result<()> {
    let (exact, found) = (&reference.table, &ran.table);
    let doubtful = ran.report["doubtful"].as_array();
    let doubtful: Vec<&Value> = doubtful.into_iter().flatten().collect();
    let mut outputs: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for name in exact.names().filter(|name| !name.starts_with("residual")) {
        let output = name.split('[').next().unwrap_or(name);
        outputs.entry(output).or_default().push(name);
    }
    outputs.remove("time");
    for (output, components) in outputs {
        // Squares of errors and of sizes by time.
        let mut squares: Vec<[f64; 2]> = Vec::new();
        for name in components {
            let pairs = exact.column(name)?.into_iter().zip(found.column(name)?);
            for (at, (exact, found)) in pairs.enumerate() {
                squares.resize(squares.len().max(at + 1), [0.0; 2]);
                squares[at][0] += (found - exact).powi(2);
                squares[at][1] += exact.powi(2);
            }
        }
        let largest = |part: usize| squares.iter().map(|s| s[part].sqrt()).fold(0.0, f64::max);
        let (error, size) = (largest(0), largest(1));
        if size == 0.0 {
            continue;
        }
        let kind = match output.split_once('.') {
            Some(("energy", _)) => output,
            _ => output.rsplit('.').next().unwrap_or(output),
        };
        let is_force = FORCES.split(' ').any(|force| force == kind);
        let class = if is_force { "force" } else { "motion" };
        let is_named = doubtful.iter().any(|name| **name == output);
        let (method, steps, error) = (ran.method(), ran.number("steps"), error / size);
        let over = error / tolerance;
        csv.row(&[
            &scene, &output, &kind, &class, &tolerance, &method, &steps, &error, &over, &is_named,
        ]);
    }
    Ok(())
}
