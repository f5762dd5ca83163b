//! CPU time of a step against the number of elements.

use anyhow::Result;

use super::bench::{Bench, Run};
use super::csv::Csv;

const MESHES: [u32; 7] = [10, 20, 50, 100, 200, 500, 1000];
/// Steps times elements of a run with rkn43: a few hundredths of a second.
const WORK: f64 = 2e5;
/// Stop time of the runs with radau, whose steps depend little on the mesh, s.
const STOP_TIME: f64 = 1.1;

/// Measures the chart. Stability fixes the steps of rkn43, and a short run determines their length.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let scene = bench.case("soft_pendulum/scene.json")?;
    let run = |elements: u32, stop_time: f64, method: &str| {
        let run = Run::new(&scene, stop_time, stop_time).elements(elements);
        run.tolerance(1e-4).integrator(method)
    };
    let short = |elements: u32| 1.1 * (10.0 / f64::from(elements)).powi(2);
    let pilots = MESHES.map(|elements| run(elements, short(elements), "rkn43"));
    let (mut runs, mut times) = (Vec::new(), Vec::new());
    for (elements, pilot) in MESHES.into_iter().zip(bench.run("cost, pilot", &pilots)?) {
        let time = short(elements) / pilot?.number("steps") * WORK / f64::from(elements);
        times.push(time);
        runs.push(run(elements, time, "rkn43"));
        runs.push(run(elements, STOP_TIME, "radau"));
    }
    let header = "elements,rkn43_time_s,rkn43_steps,rkn43_rejected,rkn43_step_s,radau_steps,radau_rejected,\
                  radau_newton_iterations,radau_step_s,radau_iteration_s";
    let mut csv = Csv::new(bench, "cost", header);
    let mut outcomes = bench.time("cost", &runs)?.into_iter();
    for (elements, time) in MESHES.iter().zip(times) {
        let mut next = || outcomes.next().expect("as many as runs");
        let (rkn43, radau) = (next()?, next()?);
        let [steps, rejected] = ["steps", "rejected"].map(|key| rkn43.number(key));
        let keys = ["steps", "rejected", "newton_iterations"];
        let [all, failed, newton] = keys.map(|key| radau.number(key));
        let [step, own, each] = [rkn43.per("steps"), radau.per(keys[0]), radau.per(keys[2])];
        csv.row(&[
            elements, &time, &steps, &rejected, &step, &all, &failed, &newton, &own, &each,
        ]);
    }
    csv.save()
}
