//! What a unit costs besides its solver: from instantiation to the first step, and at every step.

mod master;

use std::path::PathBuf;

use cpu_time::ThreadTime;
use flexbody::integrators::{RK4, RungeKutta, Tolerance, advance};
use flexbody::scene::{Integrator, Scene};
use flexbody::system::{DrivenSystem, fastest};
use master::{Instance, Unit};
use serde_json::{Value, json};

use crate::scene::{Start, read};

/// Starts of which the median is taken: as many as take this long (s), within these bounds.
const STARTS: (f64, usize, usize) = (1.0, 5, 101);
/// Rounds of which the median is taken.
const ROUNDS: usize = 25;
/// CPU time of a batch of calls, s: long against what a clock can tell.
const BATCH: f64 = 5e-3;
/// Communication step, s: one sub-step of the solver.
const STEP: f64 = 1e-7;
/// Outputs read after a step.
const READ: usize = 12;

/// Arguments.
#[derive(clap::Args)]
pub struct Overhead {
    /// Scene file; the steps are those of rk4.
    scene: PathBuf,
}

/// Measures and prints the report: CPU times, s.
///
/// # Errors
/// A scene that cannot be read, or a call that is not answered with `fmi2OK`, in words.
pub fn overhead(arguments: &Overhead) -> Result<(), String> {
    let scene = read(&arguments.scene, &[])?;
    let report = json!({
        "start": start(&scene)?,
        "step": step(&scene)?,
        "state": state(&scene)?,
    });
    println!("{report:#}");
    Ok(())
}

/// CPU time of a call, s.
fn timed<T>(call: impl FnOnce() -> Result<T, String>) -> Result<(T, f64), String> {
    let before = ThreadTime::now();
    let value = call()?;
    Ok((value, before.elapsed().as_secs_f64()))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// CPU times from instantiation to the first step, s.
fn start(scene: &Scene) -> Result<Value, String> {
    let unit = Unit::new(scene)?;
    let mut all: Vec<[f64; 6]> = Vec::new();
    let (span, least, most) = STARTS;
    let mut spent = 0.0;
    while all.len() < most && (all.len() < least || spent < span) {
        let (instance, instantiate) = timed(|| Instance::new(&unit))?;
        let ((), set_up) = timed(|| instance.set_up())?;
        let ((), enter) = timed(|| instance.enter())?;
        let ((), exit) = timed(|| instance.exit())?;
        let ((), first) = timed(|| instance.step(0.0, STEP))?;
        let phases = [instantiate, set_up, enter, exit, first];
        let whole = phases.iter().sum();
        spent += whole;
        all.push([instantiate, set_up, enter, exit, first, whole]);
    }
    let of = |phase: usize| median(all.iter().map(|times| times[phase]).collect());
    Ok(json!({
        "instantiate": of(0),
        "set_up": of(1),
        "enter": of(2),
        "exit": of(3),
        "first_step": of(4),
        "whole": of(5),
    }))
}

/// CPU time of one of `count` calls, s.
fn each(count: usize, mut call: impl FnMut(usize) -> Result<(), String>) -> Result<f64, String> {
    let run = || (0..count).try_for_each(&mut call);
    Ok(timed(run)?.1 / count as f64)
}

/// CPU times at every step, s: rounds of batches that take turns.
fn step(scene: &Scene) -> Result<Value, String> {
    let mut scene = scene.clone();
    scene.method.integrator = Integrator::Rk4;
    let unit = Unit::new(&scene)?;
    let [stepped, exchanged] = [begun(&unit)?, begun(&unit)?];
    let Start {
        scene,
        assembled,
        inputs,
        mut state,
        mut work,
    } = Start::new(scene)?;
    let system = &assembled.system;
    let (frequency, decay) = fastest(system, &inputs, &mut work, &state);
    let mut method = RungeKutta::new(&RK4, system.coordinates(), frequency, decay);
    let tolerance = Tolerance {
        relative: scene.relative_tolerance(),
        position: system.scale(),
        time: 1.0,
    };
    let mut model = DrivenSystem::new(system, &inputs, &mut work, &state);
    let mut solve = |until: f64| {
        let (_, result) = advance(&mut method, &mut model, &mut state, until, &tolerance);
        result.map_err(|stop| format!("the solver: {stop:?}"))
    };
    let outputs = &unit.outputs[..READ.min(unit.outputs.len())];
    let mut values = vec![0.0; outputs.len()];
    let count = ((BATCH / each(100, |i| solve(STEP * (i + 1) as f64))?) as usize).max(20);
    let mut all: Vec<[f64; 4]> = Vec::new();
    for round in 0..ROUNDS {
        let time = |i: usize| STEP * (round * count + i) as f64;
        let alone = each(count, |i| solve(STEP * (101 + round * count + i) as f64))?;
        let step = each(count, |i| stepped.step(time(i), STEP))?;
        let exchange = each(count, |i| {
            exchanged.set(&unit.inputs, &inputs)?;
            exchanged.step(time(i), STEP)?;
            exchanged.get(outputs, &mut values)
        })?;
        all.push([alone, step - alone, exchange - step, exchange - alone]);
    }
    let of = |part: usize| median(all.iter().map(|times| times[part]).collect());
    Ok(json!({
        "solver": of(0),
        "step": of(1),
        "exchange": of(2),
        "outside": of(3),
        "inputs": inputs.len(),
        "outputs": outputs.len(),
    }))
}

/// CPU times of what masters do between steps, s, and the size of a state, bytes.
fn state(scene: &Scene) -> Result<Value, String> {
    let unit = Unit::new(scene)?;
    let mut instance = begun(&unit)?;
    let (mut bytes, mut values) = (Vec::new(), vec![0.0; unit.outputs.len()]);
    instance.save()?;
    instance.serialize(&mut bytes)?;
    let count = 100;
    let mut all: Vec<[f64; 7]> = Vec::new();
    for round in 0..ROUNDS {
        let save = each(count, |_| instance.save())?;
        let restore = each(count, |_| instance.restore())?;
        let serialize = each(count, |_| instance.serialize(&mut bytes))?;
        let deserialize = each(count, |_| instance.deserialize(&bytes))?;
        let input = unit.inputs[0];
        let directional = each(count, |_| {
            instance.directional(&unit.outputs, input, &mut values)
        })?;
        let mut order = |order: i32| {
            each(count, |i| {
                // Another input: nothing is left from the call before.
                let value = (round * count + i) as f64 * 1e-9;
                instance.set(&unit.inputs[..1], &[value])?;
                instance.derivatives(&unit.outputs, order, &mut values)
            })
        };
        let (first, second) = (order(1)?, order(2)?);
        all.push([
            save,
            restore,
            serialize,
            deserialize,
            directional,
            first,
            second,
        ]);
    }
    let of = |part: usize| median(all.iter().map(|times| times[part]).collect());
    Ok(json!({
        "save": of(0),
        "restore": of(1),
        "serialize": of(2),
        "deserialize": of(3),
        "directional": of(4),
        "first": of(5),
        "second": of(6),
        "bytes": bytes.len(),
    }))
}

/// An instance at its first communication point.
fn begun(unit: &Unit) -> Result<Instance, String> {
    let instance = Instance::new(unit)?;
    instance.set_up()?;
    instance.enter()?;
    instance.exit()?;
    Ok(instance)
}
