//! Formulations of one chain of elements: what an acceleration costs, and error against CPU time.

use anyhow::Result;
use serde_json::Value;

use super::bench::{Bench, progress_bar};
use super::csv::{Csv, digits};
use super::numbers::{largest_distance, median, number, path};

/// Names of the lab.
const KINDS: [&str; 7] = [
    "as_printed",
    "qr_dense",
    "qr_applied",
    "cholesky",
    "product",
    "assembled",
    "augmented",
];
const COUNTS: [u32; 8] = [5, 10, 20, 50, 100, 200, 500, 1000];
const MESHES: [u32; 5] = [5, 10, 20, 40, 80];
const LENGTH: f64 = 1.2;
/// Rounds over all measurements.
const ROUNDS: usize = 3;

/// Measures.
pub fn measure(bench: &Bench) -> Result<()> {
    let costs = reports(bench, "accelerate", &COUNTS, &[])?;
    let swings = reports(
        bench,
        "swing",
        &MESHES,
        &["--stop-time", "1.1", "--every", "0.01"],
    )?;
    let reference = bench.table("soft_pendulum/reference.csv")?;
    let reference = reference.points("x_tip", "y_tip")?;
    let header = "formulation,elements,acceleration_s,force_s,set_up_s,memory_B,swing_s,error,gap_m,pin_distance_m";
    let mut csv = Csv::new(bench, "formulations", header);
    for (kind, (costs, swings)) in KINDS.iter().zip(costs.iter().zip(swings)) {
        for (count, rounds) in COUNTS.iter().zip(costs) {
            let [acceleration, force, set_up, memory] =
                medians(rounds, ["acceleration", "force", "set_up", "memory"])?;
            csv.row(&[
                kind,
                count,
                &acceleration,
                &force,
                &set_up,
                &memory,
                &"",
                &"",
                &"",
                &"",
            ]);
        }
        for (count, rounds) in MESHES.iter().zip(swings) {
            let [time, gap, pin] = medians(&rounds, ["cpu_time", "gap", "pin"])?;
            let path = path(&rounds[0]["path"])?;
            let is_whole = path.len() >= reference.len();
            let error = largest_distance(&path, &reference) / LENGTH;
            let error = if is_whole {
                digits(error)
            } else {
                "inf".to_owned()
            };
            csv.row(&[kind, count, &"", &"", &"", &"", &time, &error, &gap, &pin]);
        }
    }
    csv.save()
}

/// Reports by formulation, number and round; formulations take turns.
fn reports(
    bench: &Bench,
    measurement: &str,
    counts: &[u32],
    options: &[&str],
) -> Result<Vec<Vec<Vec<Value>>>> {
    let scene = bench.case("soft_pendulum/scene.json")?;
    let mut reports = vec![vec![Vec::new(); counts.len()]; KINDS.len()];
    let bar = progress_bar(measurement, ROUNDS * counts.len() * KINDS.len());
    for _ in 0..ROUNDS {
        for (at, count) in counts.iter().enumerate() {
            for (kind, reports) in KINDS.iter().zip(&mut reports) {
                let count = count.to_string();
                let all = [
                    &[measurement, "--formulation", kind, "--elements", &count],
                    options,
                ]
                .concat();
                reports[at].push(bench.lab(&all, Some(&scene))?);
                bar.inc(1);
            }
        }
    }
    bar.finish_and_clear();
    Ok(reports)
}

/// The middle values of numbers of reports.
fn medians<const N: usize>(reports: &[Value], keys: [&str; N]) -> Result<[String; N]> {
    let mut found = [(); N].map(|()| String::new());
    for (cell, key) in found.iter_mut().zip(keys) {
        let numbers: Result<Vec<f64>> = reports.iter().map(|report| number(&report[key])).collect();
        *cell = digits(median(&numbers?));
    }
    Ok(found)
}
