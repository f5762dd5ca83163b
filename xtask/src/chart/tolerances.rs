//! What the tolerance holds: errors of every kind of output of the ready scenes over it.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use serde_json::json;

use super::bench::{Bench, Outcome, Run};
use super::csv::{Csv, digits};

const TOLERANCES: [f64; 6] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];
/// Tolerance of the references, all with the implicit method: explicit ones are stable there or are not.
const REFERENCE: f64 = 1e-10;
/// Ready scenes; those that rest in their default experiment are let go from their shapes.
const SCENES: [(&str, bool); 12] = [
    ("boom", true),
    ("cantilever", true),
    ("crane", true),
    ("double_pendulum", false),
    ("flying_spaghetti", false),
    ("four_bar", false),
    ("hanging_cable", true),
    ("pendulum", false),
    ("robot_arm", false),
    ("slider_crank", false),
    ("spin_up_beam", false),
    ("travelling_load", false),
];
/// Kinds of outputs that magnify errors.
const FORCES: [&str; 8] = [
    "reaction",
    "reaction_moment",
    "axial_force",
    "bending_moment",
    "force",
    "moment",
    "acceleration",
    "strain",
];

/// Measures.
pub fn measure(bench: &Bench) -> Result<()> {
    let header = "scene,output,kind,class,tolerance,method,steps,error,over_tolerance,named";
    let mut csv = Csv::new(bench, "tolerances", header);
    for (name, rests) in SCENES {
        let mut scene = bench.json(&format!("scenes/{name}.json"))?;
        if rests {
            scene["initial"] = json!("as_shaped");
        }
        let number = |key: &str| scene["experiment"][key].as_f64();
        let (stop, step) = (number("stop_time"), number("step"));
        let (stop, step) = stop.zip(step).context("expected an experiment")?;
        let run = |tolerance: f64| Run::new(&scene, stop, step).tolerance(tolerance);
        let mut runs = vec![run(REFERENCE).integrator("radau")];
        runs.extend(TOLERANCES.map(run));
        let outcomes = bench.run(&format!("tolerances, {name}"), &runs)?;
        let (reference, others) = outcomes.split_first().context("expected runs")?;
        for (tolerance, outcome) in TOLERANCES.into_iter().zip(others) {
            compare(&mut csv, name, tolerance, (reference, outcome))?;
        }
    }
    csv.save()
}

/// Adds the errors of all outputs of a run, each over the largest size of the output.
fn compare(
    csv: &mut Csv,
    scene: &str,
    tolerance: f64,
    (reference, outcome): (&Outcome, &Outcome),
) -> Result<()> {
    let (exact, found, cost) = (reference.table()?, outcome.table()?, outcome.cost()?);
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
        let is_force = FORCES.contains(&kind);
        csv.row(&[
            &scene,
            &output,
            &kind,
            &(if is_force { "force" } else { "motion" }),
            &format!("{tolerance:e}"),
            &cost.method,
            &cost.steps,
            &digits(error / size),
            &digits(error / size / tolerance),
            &cost.doubtful.iter().any(|name| name == output),
        ]);
    }
    Ok(())
}
