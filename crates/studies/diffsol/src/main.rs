//! diffsol's BDF on a scene: what a Rust user would take for `y' = f(t, y)`, `y` coordinates and rates.
//! The Jacobian is dense and by differences, as nothing structured fits through its interface.

#[path = "../../src/outputs.rs"]
mod outputs;
#[path = "../../src/scene.rs"]
mod scene;

use std::cell::RefCell;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use cpu_time::ThreadTime;
use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod};
use flexbody::system::{Dynamics, DrivenSystem, Workspace};

use outputs::Outputs;
use scene::{Outcome, Start, at, read};

#[derive(Parser)]
#[command(version, about = "diffsol's BDF on a scene")]
struct Arguments {
    /// Scene file.
    scene: PathBuf,
    /// Relative tolerance; the absolute one is it times the size of the coordinates.
    #[arg(long, default_value_t = 1e-6)]
    tolerance: f64,
    /// Time at which to end, s.
    #[arg(long)]
    stop_time: f64,
    /// Time between outputs, s.
    #[arg(long)]
    every: f64,
    /// Value of a body, e.g. `rod.density=7800`; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// CSV file.
    #[arg(long)]
    output: PathBuf,
    /// JSON file.
    #[arg(long)]
    report: PathBuf,
}

fn main() -> ExitCode {
    match integrate(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("studies-diffsol: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Accelerations, and their derivatives along a direction.
struct Right<'a> {
    start: &'a Start,
    work: RefCell<Workspace>,
    accelerations: RefCell<u64>,
}

impl Right<'_> {
    fn acceleration(&self, t: f64, y: &[f64], a: &mut [f64]) {
        let (q, v) = y.split_at(y.len() / 2);
        let mut work = self.work.borrow_mut();
        let system = &self.start.assembled.system;
        let mut model = DrivenSystem::new(system, &self.start.inputs, &mut work, &self.start.state);
        model.acceleration(t, q, v, a);
        *self.accelerations.borrow_mut() += 1;
    }

    fn derivative(&self, t: f64, y: &[f64], direction: &[f64], out: &mut [f64]) {
        let n = y.len() / 2;
        out.fill(0.0);
        out[..n].copy_from_slice(&direction[n..]);
        let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let along = size(&direction[..n]);
        // The systems that run here are not damped: accelerations depend on positions alone.
        if along > 0.0 {
            let step = 1e-7 * self.start.assembled.system.scale() / along;
            let mut moved = y.to_vec();
            moved[..n]
                .iter_mut()
                .zip(direction)
                .for_each(|(y, d)| *y += step * d);
            let mut before = vec![0.0; n];
            self.acceleration(t, y, &mut before);
            self.acceleration(t, &moved, &mut out[n..]);
            for (out, before) in out[n..].iter_mut().zip(&before) {
                *out = (*out - before) / step;
            }
        }
    }
}

fn integrate(arguments: &Arguments) -> Outcome<()> {
    let start = Start::new(read(&arguments.scene, &arguments.set)?)?;
    let right = Right {
        start: &start,
        work: RefCell::new(start.work.clone()),
        accelerations: RefCell::new(0),
    };
    let (mut state, mut work) = (start.state.clone(), start.work.clone());
    let mut table = Outputs::new(&start);
    table.add(&start, &state, &mut work);
    let n = state.rates.len();
    let begin = [&state.coordinates[..], &state.rates[..]].concat();
    // Per coordinate what the product tolerates of all together.
    let each = arguments.tolerance * start.assembled.system.scale() / (n as f64).sqrt();
    let failed = |error: diffsol::DiffsolError| error.to_string();
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(arguments.tolerance)
        .atol(vec![each; 2 * n])
        .rhs_implicit(
            |y: &[f64], _: &[f64], t: f64, out: &mut [f64]| {
                out[..n].copy_from_slice(&y[n..]);
                right.acceleration(t, y, &mut out[n..]);
            },
            |y: &[f64], _: &[f64], t: f64, direction: &[f64], out: &mut [f64]| {
                right.derivative(t, y, direction, out);
            },
        )
        .init(
            |_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(&begin),
            2 * n,
        )
        .build()
        .map_err(failed)?;
    let mut cpu_time = Duration::ZERO;
    let mut solver = problem.bdf::<NalgebraLU<f64>>().map_err(failed)?;
    let points = (arguments.stop_time / arguments.every - 1e-9)
        .ceil()
        .max(1.0) as u64;
    for point in 1..=points {
        let until = (point as f64 * arguments.every).min(arguments.stop_time);
        let started = ThreadTime::now();
        while solver.state().t < until {
            solver.step().map_err(failed)?;
        }
        let y = solver.interpolate(until).map_err(failed)?;
        cpu_time += started.elapsed();
        for i in 0..n {
            (state.coordinates[i], state.rates[i]) = (y[i], y[n + i]);
        }
        state.time = until;
        table.add(&start, &state, &mut work);
    }
    let counts = solver.get_statistics();
    let report = format!(
        "{{\"method\": \"diffsol_bdf\", \"steps\": {}, \"rejected\": {}, \"newton_iterations\": {}, \
         \"accelerations\": {}, \"factorizations\": {}, \"cpu_time\": {:?}}}\n",
        counts.number_of_steps,
        counts.number_of_error_test_failures,
        counts.number_of_nonlinear_solver_iterations,
        right.accelerations.borrow(),
        counts.number_of_linear_solver_setups,
        cpu_time.as_secs_f64()
    );
    std::fs::write(&arguments.output, table.text).map_err(|error| at(&arguments.output, error))?;
    std::fs::write(&arguments.report, report).map_err(|error| at(&arguments.report, error))
}
