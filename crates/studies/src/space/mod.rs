//! `studies space` and `studies bend`: one rod in any shape functions, mesh, quadrature and mass; in motion, and
//! in equilibrium.

mod discretization;
mod motion;
mod problem;
mod statics;

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use cpu_time::ThreadTime;
use serde_json::json;

use crate::elements::rod::{Rod, Vector};
use discretization::Discretization;
use motion::{Motion, STABLE};
pub use problem::Problem;
use statics::Loads;

/// Iterations of Newton's method that are timed together.
const TIMED: u32 = 200;

/// Moves the rod of a scene by an explicit method with fixed steps; prints JSON: the path of its end,
/// steps and CPU times.
#[derive(Args)]
pub struct Space {
    /// Scene file: one straight cable, held at its ends or loaded at its start.
    scene: PathBuf,
    /// Discretization.
    #[arg(long)]
    element: Discretization,
    /// Number of elements.
    #[arg(long)]
    elements: usize,
    /// Step over the largest that is stable.
    #[arg(long, default_value_t = 0.9)]
    courant: f64,
    /// Time at which it ends, s.
    #[arg(long)]
    stop_time: f64,
    /// Time between outputs, s.
    #[arg(long)]
    every: f64,
}

/// Bends the rod of a scene, clamped at its start, by a force across its tip; prints JSON.
#[derive(Args)]
pub struct Bend {
    /// Scene file: one cable along the first axis.
    scene: PathBuf,
    /// Discretization.
    #[arg(long)]
    element: Discretization,
    /// Number of elements.
    #[arg(long)]
    elements: usize,
    /// Force, N.
    #[arg(long)]
    force: f64,
}

/// Moves a rod.
///
/// # Errors
/// A scene that cannot be read or a motion that cannot be computed, in words.
pub fn space(arguments: &Space) -> Result<(), String> {
    let problem = read(&arguments.scene)?;
    match arguments.element.basis().local() {
        4 => move_rod::<4>(arguments, &problem),
        5 => move_rod::<5>(arguments, &problem),
        _ => move_rod::<6>(arguments, &problem),
    }
}

/// Bends a rod.
///
/// # Errors
/// A scene that cannot be read or a load without equilibrium, in words.
pub fn bend(arguments: &Bend) -> Result<(), String> {
    let problem = read(&arguments.scene)?;
    match arguments.element.basis().local() {
        4 => bend_rod::<4>(arguments, &problem),
        5 => bend_rod::<5>(arguments, &problem),
        _ => bend_rod::<6>(arguments, &problem),
    }
}

/// Reads a scene of one straight cable.
///
/// # Errors
/// A file that cannot be read, or a scene of another kind, in words.
pub fn read(path: &Path) -> Result<Problem, String> {
    let text = std::fs::read_to_string(path).map_err(|e| at(path, e))?;
    let scene = serde_json::from_str(&text).map_err(|e| at(path, e))?;
    Problem::read(&scene).map_err(|e| at(path, e))
}

fn at(path: &Path, error: impl std::fmt::Display) -> String {
    format!("{}: {error}", path.display())
}

fn move_rod<const F: usize>(arguments: &Space, problem: &Problem) -> Result<(), String> {
    let mesh = arguments
        .element
        .mesh(&problem.material, problem.length(), arguments.elements);
    let rod = Rod::<F>::new(problem.material, mesh);
    let mut c = rod.fit(|s| problem.straight(s));
    let mut v = vec![[0.0; 2]; c.len()];
    let mut motion = Motion::new(rod, problem).ok_or("expected a mass that is positive")?;
    let frequency = motion.largest_frequency(&c);
    let points = (arguments.stop_time / arguments.every).round() as usize;
    let longest = arguments.courant * STABLE / frequency;
    let steps = (arguments.every / longest).ceil().max(1.0) as usize;
    let step = arguments.every / steps as f64;
    let iteration = motion.time_iteration(&c, TIMED);
    let end =
        |motion: &Motion<F>, c: &[Vector]| motion.rod().vector(c, arguments.elements - 1, 1.0, 0);
    let mut path = Vec::new();
    let mut spent = Duration::ZERO;
    for point in 0..=points {
        let time = point as f64 * arguments.every;
        let [x, y] = end(&motion, &c);
        path.push([time, x, y]);
        if point == points {
            break;
        }
        let started = ThreadTime::now();
        for number in 0..steps {
            motion.step(time + number as f64 * step, step, &mut c, &mut v);
        }
        spent += started.elapsed();
        if !c.iter().flatten().all(|value| value.is_finite()) {
            return Err(format!("expected a finite motion, lost it before {time} s"));
        }
    }
    let report = json!({
        "path": path,
        "coordinates": motion.coordinates(),
        "largest_frequency": frequency,
        "steps": points * steps,
        "cpu_time": spent.as_secs_f64(),
        "acceleration_time": spent.as_secs_f64() / (3 * points * steps) as f64,
        "iteration_time": iteration.as_secs_f64(),
    });
    println!("{report}");
    Ok(())
}

fn bend_rod<const F: usize>(arguments: &Bend, problem: &Problem) -> Result<(), String> {
    let element = arguments.element;
    let mesh = element.mesh(&problem.material, problem.length(), arguments.elements);
    let rod = Rod::<F>::new(problem.material, mesh);
    let loads = Loads {
        force: [0.0, arguments.force],
        ..Loads::default()
    };
    let c = statics::cantilever(&rod, &loads).ok_or("expected an equilibrium, found none")?;
    let [x, y] = rod.vector(&c, arguments.elements - 1, 1.0, 0);
    let coordinates = 2 * rod.functions() - statics::HELD.len();
    println!("{}", json!({ "x": x, "y": y, "coordinates": coordinates }));
    Ok(())
}
