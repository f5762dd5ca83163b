//! `studies accelerate`: what one acceleration costs in a formulation.

use std::hint::black_box;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use cpu_time::ThreadTime;
use serde_json::json;

use crate::formulations::{Formulation, System, uniform};
use crate::space;

/// CPU time of a batch, at least.
const BATCH: Duration = Duration::from_millis(2);
/// Time of free fall that bends the chain before it is timed, s.
const FALL: f64 = 0.01;

/// Times accelerations of a pinned chain of elements; prints JSON.
#[derive(Args)]
pub struct Accelerate {
    /// Scene file: one straight cable.
    scene: PathBuf,
    /// Formulation.
    #[arg(long)]
    formulation: Formulation,
    /// Number of elements.
    #[arg(long)]
    elements: usize,
    /// Number of batches; times are medians.
    #[arg(long, default_value_t = 9)]
    repeat: usize,
}

/// Times accelerations.
///
/// # Errors
/// A scene that cannot be read or assembled, in words.
pub fn accelerate(arguments: &Accelerate) -> Result<(), String> {
    let problem = space::read(&arguments.scene)?;
    let elements = uniform(problem.cable(), arguments.elements);
    let started = ThreadTime::now();
    let mut system = System::new(arguments.formulation, elements, problem.gravity)?;
    let set_up = started.elapsed();
    let n = system.transformation.coordinates();
    let (mut q, mut a) = (vec![0.0; n], vec![0.0; n]);
    system.acceleration(&q, &mut a);
    for (q, a) in q.iter_mut().zip(&a) {
        *q = 0.5 * FALL * FALL * a;
    }
    let time = median(arguments.repeat, || {
        system.acceleration(black_box(&q), &mut a);
        black_box(&mut a);
    });
    let (x, mut f) = (system.nodes(&q).to_vec(), system.rod.reference.clone());
    let force = median(arguments.repeat, || {
        system.rod.force(black_box(&x), &mut f);
        black_box(&mut f);
    });
    let report = json!({
        "coordinates": n,
        "acceleration": time,
        "force": force,
        "set_up": set_up.as_secs_f64(),
        "memory": system.transformation.memory(),
    });
    println!("{report}");
    Ok(())
}

/// CPU time of a call, s: the median over batches.
pub fn median(batches: usize, mut call: impl FnMut()) -> f64 {
    let mut batch = |calls: u32| {
        let started = ThreadTime::now();
        (0..calls).for_each(|_| call());
        started.elapsed()
    };
    let mut calls = 1;
    while batch(calls) < BATCH {
        calls *= 2;
    }
    let time = |_| batch(calls).as_secs_f64() / f64::from(calls);
    let mut times: Vec<f64> = (0..batches.max(1)).map(time).collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
