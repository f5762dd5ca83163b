//! CPU time of a step against the number of elements.

use anyhow::Result;

use super::bench::{Bench, Run};
use super::csv::{Csv, digits};

const MESHES: [u32; 7] = [10, 20, 50, 100, 200, 500, 1000];
const TOLERANCE: f64 = 1e-4;
/// Steps times elements of a run with rkn43: a few hundredths of a second.
const WORK: f64 = 2e5;
/// Stop time of the runs with radau, whose steps depend little on the mesh, s.
const STOP_TIME: f64 = 1.1;

/// Measures. Stability fixes the steps of rkn43, and a short run tells how long they are.
pub fn measure(bench: &Bench) -> Result<()> {
    let scene = bench.case("soft_pendulum/scene.json")?;
    let run = |elements: u32, stop_time: f64, method: &str| {
        let run = Run::new(&scene, stop_time, stop_time).elements(elements);
        run.tolerance(TOLERANCE).integrator(method)
    };
    let short = |elements: u32| 1.1 * (10.0 / f64::from(elements)).powi(2);
    let pilots = MESHES.map(|elements| run(elements, short(elements), "rkn43"));
    let (mut runs, mut times) = (Vec::new(), Vec::new());
    for (elements, outcome) in MESHES.into_iter().zip(bench.run("cost, pilot", &pilots)?) {
        let step = short(elements) / outcome.cost()?.steps;
        times.push(step * WORK / f64::from(elements));
        runs.push(run(elements, times[times.len() - 1], "rkn43"));
        runs.push(run(elements, STOP_TIME, "radau"));
    }
    let outcomes = bench.time("cost", &runs)?;
    let header = "elements,rkn43_time_s,rkn43_steps,rkn43_rejected,rkn43_step_s,radau_steps,radau_rejected,\
                  radau_newton_iterations,radau_step_s,radau_iteration_s";
    let mut csv = Csv::new(bench, "cost", header);
    for ((elements, time), pair) in MESHES.iter().zip(times).zip(outcomes.chunks(2)) {
        let (rkn43, radau) = (pair[0].cost()?, pair[1].cost()?);
        csv.row(&[
            elements,
            &digits(time),
            &rkn43.steps,
            &rkn43.rejected,
            &digits(rkn43.per_step()),
            &radau.steps,
            &radau.rejected,
            &radau.newton_iterations,
            &digits(radau.per_step()),
            &digits(radau.per_iteration()),
        ]);
    }
    csv.save()
}
