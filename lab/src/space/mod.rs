//! `lab space` and `lab bend`: one rod in any shape functions, mesh, quadrature and mass; in motion, and
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

use crate::elements::rod::{Material, Rod, Vector};
use discretization::Discretization;
use motion::{Motion, STABLE};
use problem::Problem;
use statics::Loads;

/// Iterations of Newton's method that are timed together.
const TIMED: u32 = 200;

/// Moves the rod of a scene by an explicit method with fixed steps.
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
    /// CSV file for the path of the end.
    #[arg(long)]
    output: PathBuf,
    /// JSON file for steps and CPU times.
    #[arg(long)]
    report: PathBuf,
}

/// Bends a cantilever of length 1 and bending stiffness 1 by a force across its tip; prints JSON.
#[derive(Args)]
pub struct Bend {
    /// Discretization.
    #[arg(long)]
    element: Discretization,
    /// Number of elements.
    #[arg(long)]
    elements: usize,
    /// Axial stiffness.
    #[arg(long)]
    axial: f64,
    /// Force.
    #[arg(long)]
    force: f64,
}

/// Moves a rod.
pub fn space(arguments: &Space) -> Result<(), String> {
    let text = std::fs::read_to_string(&arguments.scene).map_err(|e| at(&arguments.scene, e))?;
    let scene = serde_json::from_str(&text).map_err(|e| at(&arguments.scene, e))?;
    let problem = Problem::read(&scene).map_err(|e| at(&arguments.scene, e))?;
    match arguments.element.basis().local() {
        4 => move_rod::<4>(arguments, &problem),
        5 => move_rod::<5>(arguments, &problem),
        _ => move_rod::<6>(arguments, &problem),
    }
}

/// Bends a rod.
pub fn bend(arguments: &Bend) -> Result<(), String> {
    match arguments.element.basis().local() {
        4 => bend_rod::<4>(arguments),
        5 => bend_rod::<5>(arguments),
        _ => bend_rod::<6>(arguments),
    }
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
    let mut csv = String::from("time,x,y\n");
    let mut spent = Duration::ZERO;
    for point in 0..=points {
        let time = point as f64 * arguments.every;
        let [x, y] = end(&motion, &c);
        csv += &format!("{time:?},{x:?},{y:?}\n");
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
    std::fs::write(&arguments.output, csv).map_err(|e| at(&arguments.output, e))?;
    let report = json!({
        "coordinates": motion.coordinates(),
        "largest_frequency": frequency,
        "steps": points * steps,
        "cpu_time": spent.as_secs_f64(),
        "acceleration_time": spent.as_secs_f64() / (3 * points * steps) as f64,
        "iteration_time": iteration.as_secs_f64(),
    });
    std::fs::write(&arguments.report, report.to_string()).map_err(|e| at(&arguments.report, e))
}

fn bend_rod<const F: usize>(arguments: &Bend) -> Result<(), String> {
    let material = Material {
        axial: arguments.axial,
        bending: 1.0,
        density: 1.0,
    };
    let mesh = arguments.element.mesh(&material, 1.0, arguments.elements);
    let rod = Rod::<F>::new(material, mesh);
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
