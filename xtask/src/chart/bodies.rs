//! CPU time of a step against the number of bodies, apart from each other, pinned in a chain and in loops.

use std::f64::consts::FRAC_PI_2;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, REPEATS, Run};
use super::csv::Csv;
use super::numbers::{distance, median};
use super::server::{EXUDYN, Server};

const TOLERANCE: f64 = 1e-4;
/// Simulated time, s.
const STOP_TIME: f64 = 1.0;
/// Length of a body, m.
const LENGTH: f64 = 1.2;
/// Elements of a cable.
const ELEMENTS: u32 = 8;
/// Angles over which bodies apart from each other are spread at the start, rad.
const SPREAD: f64 = 0.6;
/// Loops that Exudyn computes too, its step (s), and the tolerance beside it.
const PEER_LOOPS: [u32; 4] = [20, 40, 80, 200];
const PEER_STEP: f64 = 1e-3;
const PEER_TOLERANCE: f64 = 1e-7;
/// The point that is compared.
const MARKER: &str = "rod1.end";

/// Bodies and joints of so many bodies or loops.
type Parts = (Vec<Value>, Vec<Value>);

/// Ways to put bodies together, with numbers of them.
type Family = (&'static str, fn(u32) -> Parts, &'static [u32]);
const FAMILIES: [Family; 5] = [
    ("cables apart", |n| links(n, cable, false), &[1, 10, 100]),
    ("chain of cables", |n| links(n, cable, true), &[1, 10, 100]),
    ("rigid apart", |n| links(n, rigid, false), &[1, 10, 100]),
    (
        "chain of rigid",
        |n| links(n, rigid, true),
        &[1, 3, 10, 30, 100, 300, 1000],
    ),
    ("loops of rigid", loops, &[1, 3, 10, 20, 40, 100, 200]),
];

/// The scene of such parts.
fn scene((bodies, joints): Parts) -> Value {
    json!({
        "name": "bodies",
        "dimension": 2,
        "gravity": [0.0, -9.81],
        "bodies": bodies,
        "joints": joints,
        "outputs": [{ "kind": "energy" }],
        "accuracy": { "relative_tolerance": TOLERANCE },
        "experiment": { "stop_time": STOP_TIME, "step": STOP_TIME },
    })
}

/// Links in a chain, or each pinned to the ground.
fn links(count: u32, link: fn(u32, [f64; 2], f64) -> Value, is_chain: bool) -> Parts {
    let (mut bodies, mut joints) = (Vec::new(), Vec::new());
    for index in 0..count {
        let part = f64::from(index) / f64::from(count.max(2) - 1);
        let (from, angle, before) = match index.checked_sub(1) {
            Some(before) if is_chain => {
                let from = [LENGTH * f64::from(index), 0.0];
                (from, 0.0, format!("link{before}.end"))
            }
            _ if is_chain => ([0.0; 2], 0.0, "ground".to_owned()),
            _ => ([0.0; 2], -SPREAD * part, "ground".to_owned()),
        };
        bodies.push(link(index, from, angle));
        joints.push(json!({
            "name": format!("pin{index}"),
            "kind": "revolute",
            "markers": [before, format!("link{index}.start")],
        }));
    }
    (bodies, joints)
}

/// Rods of 1 m and 1 kg, the uprights upright and moving to the right with 1 m/s at their heads: IFToMM's benchmark A02.
fn loops(count: u32) -> Parts {
    let (mut bodies, mut joints) = (Vec::new(), Vec::new());
    let moving = |name: &str, position: [f64; 2], angle: f64, velocity: f64, spin: f64| {
        let mut rod = rod(name, 1.0, position, angle);
        rod["motion"] = json!({ "velocity": [velocity, 0.0], "spin": spin });
        rod
    };
    let pin = |first: String, second: String| {
        let name = format!("{first} {second}").replace(['.', ' '], "_");
        json!({ "name": name, "kind": "revolute", "markers": [first, second] })
    };
    for index in 0..=count {
        let x = f64::from(index);
        let name = format!("upright{index}");
        joints.push(pin("ground".into(), format!("{name}.start")));
        bodies.push(moving(&name, [x, 0.5], FRAC_PI_2, 0.5, -1.0));
        if let Some(before) = index.checked_sub(1) {
            let name = format!("rod{index}");
            joints.push(pin(format!("upright{before}.end"), format!("{name}.start")));
            joints.push(pin(format!("upright{index}.end"), format!("{name}.end")));
            bodies.push(moving(&name, [x - 0.5, 1.0], 0.0, 1.0, 0.0));
        }
    }
    (bodies, joints)
}

/// A cable of the soft pendulum's section and material.
fn cable(index: u32, from: [f64; 2], angle: f64) -> Value {
    let (sine, cosine) = angle.sin_cos();
    let to = [from[0] + LENGTH * cosine, from[1] + LENGTH * sine];
    json!({
        "name": format!("link{index}"),
        "element": "cable",
        "elements": ELEMENTS,
        "material": { "youngs_modulus": 0.7e6, "density": 5540.0 },
        "section": { "area": 0.0018, "second_moment": 1.215e-8 },
        "shape": { "line": { "from": from, "to": to } },
        "markers": { "start": 0.0, "end": 1.0 },
    })
}

/// A link that is a rod.
fn rigid(index: u32, from: [f64; 2], angle: f64) -> Value {
    let (sine, cosine) = angle.sin_cos();
    let middle = [
        from[0] + 0.5 * LENGTH * cosine,
        from[1] + 0.5 * LENGTH * sine,
    ];
    rod(&format!("link{index}"), LENGTH, middle, angle)
}

/// A uniform rod of 1 kg.
fn rod(name: &str, length: f64, position: [f64; 2], angle: f64) -> Value {
    json!({
        "name": name,
        "element": "rigid",
        "mass": 1.0,
        "inertia": length * length / 12.0,
        "position": position,
        "angle": angle,
        "markers": { "start": [-0.5 * length, 0.0], "end": [0.5 * length, 0.0] },
    })
}

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let (mut plan, mut runs, mut choices) = (Vec::new(), Vec::new(), Vec::new());
    for (name, family, counts) in FAMILIES {
        for &count in counts {
            let scene = scene(family(count));
            plan.push((name, count));
            let run = |method: &str| Run::new(&scene, STOP_TIME, STOP_TIME).integrator(method);
            runs.extend(["radau", "rk4"].map(run));
            choices.push(Run::new(&scene, 1e-3, 1e-3).integrator("auto"));
        }
    }
    let choices = bench.run("bodies, choice", &choices)?;
    let mut outcomes = bench.time("bodies", &runs)?.into_iter();
    let header = "family,bodies,chosen,radau_steps,radau_rejected,radau_newton_iterations,radau_iteration_s,\
                  radau_step_s,rk4_steps,rk4_rejected,rk4_step_s";
    let mut csv = Csv::new(bench, "bodies", header);
    for ((family, count), choice) in plan.iter().zip(choices) {
        let (choice, mut next) = (choice?, || outcomes.next().expect("as many as runs"));
        let (radau, rk4) = (next()?, next()?);
        let keys = ["steps", "rejected", "newton_iterations"];
        let [steps, failed, newton] = keys.map(|key| radau.number(key));
        let [own, rejected, _] = keys.map(|key| rk4.number(key));
        let (each, step, rk4) = (radau.per(keys[2]), radau.per(keys[0]), rk4.per(keys[0]));
        let method = choice.method();
        csv.row(&[
            family, count, &method, &steps, &failed, &newton, &each, &step, &own, &rejected, &rk4,
        ]);
    }
    csv.save()?;
    peers(bench)
}

/// Runs the loops in both programs in turns.
fn peers(bench: &Bench) -> Result<()> {
    let mut exudyn = Server::start(bench.workspace(), EXUDYN)?;
    let (_, family, _) = FAMILIES[FAMILIES.len() - 1];
    let header = "loops,own_step_s,own_steps,exudyn_step_s,exudyn_steps,distance_m";
    let mut csv = Csv::new(bench, "bodies_peers", header);
    for count in PEER_LOOPS {
        let mut scene = scene(family(count));
        scene["outputs"] = json!([{ "kind": "position", "marker": MARKER }]);
        scene["accuracy"] = json!({ "relative_tolerance": PEER_TOLERANCE });
        let run = [Run::new(&scene, STOP_TIME, STOP_TIME).integrator("rk4")];
        let title = format!("bodies, {count} loops beside Exudyn");
        let (mut own, mut other, mut steps, mut apart) = (vec![], vec![], 0.0, 0.0);
        for _ in 0..REPEATS {
            let ran = bench.run(&title, &run)?.remove(0)?;
            let answer = exudyn.run::<2>(&json!({
                "scene": bench.write(&scene)?, "marker": MARKER, "solver": "alpha", "newton": "modified",
                "linear": "sparse", "step": PEER_STEP, "stop_time": STOP_TIME, "every": STOP_TIME,
            }))?;
            own.push(ran.per("steps"));
            other.push(answer.cpu_time * PEER_STEP / STOP_TIME);
            let path = ran.table.marker(MARKER)?;
            let ends = path.last().zip(answer.path.last());
            let (end, other_end) = ends.context("expected a path")?;
            (steps, apart) = (ran.number("steps"), distance(*end, *other_end));
        }
        let (own, other, taken) = (median(&own), median(&other), STOP_TIME / PEER_STEP);
        csv.row(&[&count, &own, &steps, &other, &taken.round(), &apart]);
    }
    csv.save()
}
