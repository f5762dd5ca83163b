//! Formulations of one chain of elements: what an acceleration costs, and error against CPU time.

use anyhow::Result;
use serde_json::Value;

use super::bench::{Bench, progress_bar};
use super::csv::Csv;
use super::numbers::{largest_distance, medians, path};

/// Names of the studies.
const KINDS: &str = "as_printed qr_dense qr_applied cholesky product assembled augmented";
const COUNTS: [u32; 8] = [5, 10, 20, 50, 100, 200, 500, 1000];
const MESHES: [u32; 5] = [5, 10, 20, 40, 80];
const LENGTH: f64 = 1.2;
/// Rounds over all measurements.
const ROUNDS: usize = 3;

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
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
    let header = "formulation,elements,acceleration_s,force_s,set_up_s,memory_B,swing_s,error,gap_m,\
                  pin_distance_m";
    let (mut csv, no) = (Csv::new(bench, "formulations", header), f64::NAN);
    for ((kind, costs), (_, swings)) in costs.iter().zip(&swings) {
        for (count, rounds) in COUNTS.iter().zip(costs) {
            let keys = ["acceleration", "force", "set_up", "memory"];
            let [time, force, set_up, memory] = medians(rounds, keys)?;
            csv.row(&[
                kind, count, &time, &force, &set_up, &memory, &no, &no, &no, &no,
            ]);
        }
        for (count, rounds) in MESHES.iter().zip(swings) {
            let [time, gap, pin] = medians(rounds, ["cpu_time", "gap", "pin"])?;
            let path = path(&rounds[0]["path"])?;
            let error = if path.len() < reference.len() {
                f64::INFINITY
            } else {
                largest_distance(&path, &reference) / LENGTH
            };
            csv.row(&[kind, count, &no, &no, &no, &no, &time, &error, &gap, &pin]);
        }
    }
    csv.save()
}

/// Reports by number and round.
type Reports = Vec<Vec<Value>>;

/// Reports by formulation; formulations take turns.
fn reports(
    bench: &Bench,
    measurement: &str,
    counts: &[u32],
    options: &[&str],
) -> Result<Vec<(&'static str, Reports)>> {
    let scene = bench.case("soft_pendulum/scene.json")?;
    let empty = |kind| (kind, vec![Vec::new(); counts.len()]);
    let mut reports: Vec<(&str, Reports)> = KINDS.split(' ').map(empty).collect();
    let bar = progress_bar(measurement, ROUNDS * counts.len() * reports.len());
    for _ in 0..ROUNDS {
        for (at, count) in counts.iter().enumerate() {
            for (kind, reports) in &mut reports {
                let count = count.to_string();
                let own = [measurement, "--formulation", kind, "--elements", &count];
                reports[at].push(bench.studies(&[&own, options].concat(), Some(&scene))?);
                bar.inc(1);
            }
        }
    }
    bar.finish_and_clear();
    Ok(reports)
}
