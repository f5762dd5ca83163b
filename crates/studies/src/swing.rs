//! `studies swing`: a pinned rod falls, in a formulation.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use cpu_time::ThreadTime;
use flexbody::elements::cable::Inertia;
use serde_json::json;

use crate::formulations::{Element, Formulation, System, uniform};
use crate::space;

/// Largest stable step of the classical method of Runge and Kutta times the largest frequency.
const STABLE: f64 = 2.828;
/// Step over the largest that is stable at rest, where nothing else is said.
pub const COURANT: f64 = 0.7;
/// Iterations for the largest frequency.
const ITERATIONS: usize = 300;
/// Largest coordinate, m, beyond which a run is given up.
const LOST: f64 = 1e6;

/// Lets a pinned rod fall, by the classical method of Runge and Kutta with fixed steps, the same in all
/// formulations; prints JSON: the path of the tip, the largest gap, steps and CPU time.
#[derive(Args)]
pub struct Swing {
    /// Scene file: one straight cable.
    scene: PathBuf,
    /// Formulation.
    #[arg(long)]
    formulation: Formulation,
    /// Number of elements.
    #[arg(long)]
    elements: usize,
    /// The consistent mass, as in the report, in place of the product's.
    #[arg(long)]
    consistent: bool,
    /// Step over the largest that is stable at rest.
    #[arg(long, default_value_t = COURANT)]
    courant: f64,
    /// Time at which it ends, s.
    #[arg(long)]
    stop_time: f64,
    /// Time between outputs, s.
    #[arg(long)]
    every: f64,
}

/// Motion of a rod that falls.
pub struct Fall {
    /// Times (s) and positions of the tip, m.
    pub path: Vec<[f64; 3]>,
    /// Largest gap between elements that meet, and the one in the middle, at these times, m.
    pub gaps: Vec<[f64; 2]>,
    /// Distances from the pin at these times, m.
    pub pins: Vec<f64>,
    ended: Option<f64>,
    steps: usize,
    spent: Duration,
}

/// Lets a rod fall.
///
/// # Errors
/// Rods that cannot be built or reports that cannot be written, in words.
pub fn swing(arguments: &Swing) -> Result<(), String> {
    let problem = space::read(&arguments.scene)?;
    let mut cable = problem.cable();
    if arguments.consistent {
        cable.inertia = Inertia::Consistent;
    }
    let elements = uniform(cable, arguments.elements);
    let found = fall(
        arguments.formulation,
        elements,
        problem.gravity,
        arguments.courant,
        [arguments.every, arguments.stop_time],
    )?;
    let report = json!({
        "path": found.path,
        "gap": found.gaps.iter().fold(0.0_f64, |most, gap| most.max(gap[0])),
        "pin": found.pins.iter().fold(0.0_f64, |most, pin| most.max(*pin)),
        "middle": found.gaps.iter().map(|gap| gap[1]).collect::<Vec<_>>(),
        "pins": found.pins,
        "lost_at": found.ended,
        "steps": found.steps,
        "cpu_time": found.spent.as_secs_f64(),
    });
    println!("{report}");
    Ok(())
}

/// Lets elements in a row fall under gravity, in steps of a part of the largest stable one. The motion is recorded
/// every `every` until `stop`, s.
///
/// # Errors
/// A system that cannot be built, in words.
pub fn fall(
    formulation: Formulation,
    elements: Vec<Element>,
    gravity: [f64; 2],
    courant: f64,
    [every, stop]: [f64; 2],
) -> Result<Fall, String> {
    let exact = System::new(Formulation::Cholesky, elements.clone(), gravity)?;
    let longest = courant * STABLE / largest_frequency(exact);
    let mut system = System::new(formulation, elements, gravity)?;
    let n = system.transformation.coordinates();
    let points = (stop / every).round() as usize;
    let steps = (every / longest).ceil().max(1.0) as usize;
    let step = every / steps as f64;
    let mut motion = Motion {
        q: vec![0.0; n],
        v: vec![0.0; n],
        scratch: [(); 5].map(|()| vec![0.0; n]),
    };
    let mut found = Fall {
        path: Vec::new(),
        gaps: Vec::new(),
        pins: Vec::new(),
        ended: None,
        steps: points * steps,
        spent: Duration::ZERO,
    };
    for point in 0..=points {
        let time = point as f64 * every;
        let x = system.nodes(&motion.q).to_vec();
        if !x.iter().flatten().flatten().all(|value| value.abs() < LOST) {
            found.ended = Some(time);
            break;
        }
        let [tip, _] = x[x.len() - 1];
        found.path.push([time, tip[0], tip[1]]);
        let rod = &system.rod;
        found.gaps.push(match rod.count() {
            1 => [0.0; 2],
            count => [rod.gap(&x), rod.gap_before(count / 2, &x)],
        });
        found.pins.push(x[0][0][0].hypot(x[0][0][1]));
        let started = ThreadTime::now();
        for _ in 0..steps.min((points - point) * steps) {
            motion.step(&mut system, step);
        }
        found.spent += started.elapsed();
    }
    Ok(found)
}

struct Motion {
    q: Vec<f64>,
    v: Vec<f64>,
    scratch: [Vec<f64>; 5],
}

impl Motion {
    /// One step of the classical method of Runge and Kutta.
    fn step(&mut self, system: &mut System, h: f64) {
        let Self { q, v, scratch } = self;
        let [stage_q, stage_v, a, sum_q, sum_v] = scratch;
        stage_q.copy_from_slice(q);
        stage_v.copy_from_slice(v);
        sum_q.copy_from_slice(q);
        sum_v.copy_from_slice(v);
        for (weight, next) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
            system.acceleration(stage_q, a);
            for i in 0..q.len() {
                let rate = stage_v[i];
                sum_q[i] += h / 6.0 * weight * rate;
                sum_v[i] += h / 6.0 * weight * a[i];
                stage_q[i] = q[i] + h * next * rate;
                stage_v[i] = v[i] + h * next * a[i];
            }
        }
        q.copy_from_slice(sum_q);
        v.copy_from_slice(sum_v);
    }
}

/// Returns the largest frequency of small oscillations about rest, rad/s, by power iteration on differences of
/// accelerations.
fn largest_frequency(mut system: System) -> f64 {
    let n = system.transformation.coordinates();
    let mut z: Vec<f64> = (0..n).map(|i| (1.7 * i as f64).sin()).collect();
    let (mut plus, mut minus) = (vec![0.0; n], vec![0.0; n]);
    let mut square = 0.0_f64;
    for _ in 0..ITERATIONS {
        let size = z.iter().map(|z| z * z).sum::<f64>().sqrt();
        let small = 1e-6 / size;
        z.iter_mut().for_each(|z| *z *= small);
        system.acceleration(&z, &mut plus);
        z.iter_mut().for_each(|z| *z = -*z);
        system.acceleration(&z, &mut minus);
        for i in 0..n {
            z[i] = 0.5 * (minus[i] - plus[i]);
        }
        square = z.iter().map(|z| z * z).sum::<f64>().sqrt() / 1e-6;
    }
    square.sqrt()
}
