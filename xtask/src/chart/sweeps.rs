//! Many runs of one scene: `flexbody sweep` with one job to one for every processor, the same on a local cluster, and the usual loop.

use std::process::Command;
use std::time::Instant;

use anyhow::{Context, Result};
use fmu_package::Platform;

use super::bench::Bench;
use super::csv::Csv;
use super::numbers::median;
use crate::process::{run_quietly, stdout};
use crate::product::Product;
use crate::python::Python;

/// Varied parameter, with its least and largest value.
const VARIED: (&str, f64, f64) = ("rod.density", 5000.0, 6000.0);
/// Runs of a sweep, and of a loop.
const RUNS: usize = 800;
const LOOPED: usize = 100;
/// End of a run and time between the points at which it is read, s.
const STOP_TIME: f64 = 1.1;
const STEP: f64 = 0.01;
/// Rounds, of which the median counts; all ways take turns.
const ROUNDS: usize = 3;

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let mut scene = bench.case("soft_pendulum/scene.json")?;
    scene["bodies"][0]["elements"] = 8.into();
    scene["accuracy"] = serde_json::json!({ "relative_tolerance": 1e-3 });
    let scene = bench.write(&scene)?;
    let product = Product::new(bench.workspace(), &[Platform::host()?])?;
    let fmu = scene.with_extension("fmu");
    let mut command = product.packager();
    command.arg(&scene).arg("--no-animation");
    run_quietly(command.arg("--output").arg(&fmu))?;
    let own = Python::prepare_own(bench.workspace())?;
    let usual = Python::prepare(bench.workspace())?;
    let processors = std::thread::available_parallelism()?.get();
    let (name, first, last) = VARIED;
    let sweep = |jobs: usize, runs: usize| {
        let mut command = Command::new(bench.program());
        command.arg("sweep").arg(&fmu);
        command.arg(format!("--vary={name}={first}:{last}:{runs}"));
        command.args([format!("--stop-time={STOP_TIME}"), format!("--step={STEP}")]);
        command.arg(format!("--jobs={jobs}"));
        command.arg("--output").arg(fmu.with_extension("parquet"));
        command
    };
    let timed = |mut command: Command| {
        let started = Instant::now();
        run_quietly(&mut command).map(|()| started.elapsed().as_secs_f64())
    };
    let mut ways: Vec<(&str, usize, usize, Vec<f64>)> = (1..=processors)
        .map(|jobs| ("flexbody sweep", jobs, RUNS, Vec::new()))
        .collect();
    ways.push(("flexbody sweep on Dask", processors, RUNS, Vec::new()));
    ways.push(("simulate_fmu in a loop", 1, LOOPED, Vec::new()));
    for _ in 0..ROUNDS {
        for (way, jobs, runs, times) in &mut ways {
            times.push(match *way {
                "flexbody sweep" => timed(sweep(*jobs, *runs))?,
                "flexbody sweep on Dask" => {
                    let mut command = sweep(*jobs, *runs);
                    command.env("FLEXBODY_PYTHON", own.program("python"));
                    command.env("PYTHONPATH", bench.workspace().path("python/src"));
                    command.args(["--scheduler", "local"]);
                    timed(command)?
                }
                _ => {
                    let mut command =
                        usual.script(&bench.workspace().path("crates/studies/simulate_loop.py"));
                    command.arg(&fmu).arg(name);
                    let numbers = [first, last, *runs as f64, STOP_TIME, STEP];
                    let printed = stdout(command.args(numbers.map(|number| number.to_string())))?;
                    let seconds = printed.trim().parse();
                    seconds.with_context(|| format!("expected seconds, found {printed:?}"))?
                }
            });
        }
    }
    let header = "way,jobs,runs,simulated_s,wall_s";
    let mut csv = Csv::new(bench, "sweeps", header);
    for (way, jobs, runs, times) in &ways {
        csv.row(&[way, jobs, runs, &(*runs as f64 * STOP_TIME), &median(times)]);
    }
    csv.save()
}
