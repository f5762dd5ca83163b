//! CPU time of a step against the number of bodies, apart from each other, pinned in a chain and in loops.

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, REPEATS, Run};
use super::csv::{Csv, digits};
use super::exudyn::Exudyn;
use super::numbers::{distance, median};

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

/// How bodies are joined.
#[derive(Clone, Copy, PartialEq)]
enum Joined {
    Apart,
    Chain,
    /// Uprights pinned to the ground and rods between their heads: a four-bar linkage each.
    Loops,
}

/// A way to put bodies together.
struct Family {
    name: &'static str,
    is_rigid: bool,
    joined: Joined,
    counts: &'static [u32],
}

#[rustfmt::skip]
const FAMILIES: [Family; 5] = [
    Family { name: "cables apart", is_rigid: false, joined: Joined::Apart, counts: &[1, 10, 100] },
    Family { name: "chain of cables", is_rigid: false, joined: Joined::Chain, counts: &[1, 10, 100] },
    Family { name: "rigid apart", is_rigid: true, joined: Joined::Apart, counts: &[1, 10, 100] },
    Family { name: "chain of rigid", is_rigid: true, joined: Joined::Chain, counts: &[1, 3, 10, 30, 100, 300, 1000] },
    Family { name: "loops of rigid", is_rigid: true, joined: Joined::Loops, counts: &[1, 3, 10, 20, 40, 100, 200] },
];

impl Family {
    /// The scene of a number of bodies.
    fn scene(&self, count: u32) -> Value {
        let (bodies, joints) = match self.joined {
            Joined::Loops => loops(count),
            _ => self.links(count),
        };
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

    fn links(&self, count: u32) -> (Vec<Value>, Vec<Value>) {
        let is_chain = self.joined == Joined::Chain;
        let (mut bodies, mut joints) = (Vec::new(), Vec::new());
        for index in 0..count {
            let (from, angle) = if is_chain {
                ([LENGTH * f64::from(index), 0.0], 0.0)
            } else {
                let part = f64::from(index) / f64::from(count.max(2) - 1);
                ([0.0, 0.0], -SPREAD * part)
            };
            bodies.push(if self.is_rigid {
                rigid(index, from, angle)
            } else {
                cable(index, from, angle)
            });
            let before = match index.checked_sub(1) {
                Some(before) if is_chain => format!("link{before}.end"),
                _ => "ground".to_owned(),
            };
            joints.push(json!({
                "name": format!("pin{index}"),
                "kind": "revolute",
                "markers": [before, format!("link{index}.start")],
            }));
        }
        (bodies, joints)
    }
}

/// Rods of 1 m and 1 kg, the uprights upright and moving to the right with 1 m/s at their heads: IFToMM's benchmark A02.
fn loops(count: u32) -> (Vec<Value>, Vec<Value>) {
    let (mut bodies, mut joints) = (Vec::new(), Vec::new());
    let rod = |name: String, position: [f64; 2], angle: f64, spin: f64, velocity: f64| {
        json!({
            "name": name,
            "element": "rigid",
            "mass": 1.0,
            "inertia": 1.0 / 12.0,
            "position": position,
            "angle": angle,
            "motion": { "velocity": [velocity, 0.0], "spin": spin },
            "markers": { "start": [-0.5, 0.0], "end": [0.5, 0.0] },
        })
    };
    let pin = |first: String, second: String| {
        let name = format!("{first} {second}").replace(['.', ' '], "_");
        json!({ "name": name, "kind": "revolute", "markers": [first, second] })
    };
    for index in 0..=count {
        let x = f64::from(index);
        let name = format!("upright{index}");
        joints.push(pin("ground".into(), format!("{name}.start")));
        bodies.push(rod(name, [x, 0.5], std::f64::consts::FRAC_PI_2, -1.0, 0.5));
        if let Some(before) = index.checked_sub(1) {
            let name = format!("rod{index}");
            joints.push(pin(format!("upright{before}.end"), format!("{name}.start")));
            joints.push(pin(format!("upright{index}.end"), format!("{name}.end")));
            bodies.push(rod(name, [x - 0.5, 1.0], 0.0, 0.0, 1.0));
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

/// A uniform rod of 1 kg.
fn rigid(index: u32, from: [f64; 2], angle: f64) -> Value {
    let (sine, cosine) = angle.sin_cos();
    let half = 0.5 * LENGTH;
    json!({
        "name": format!("link{index}"),
        "element": "rigid",
        "mass": 1.0,
        "inertia": LENGTH * LENGTH / 12.0,
        "position": [from[0] + half * cosine, from[1] + half * sine],
        "angle": angle,
        "markers": { "start": [-half, 0.0], "end": [half, 0.0] },
    })
}

/// Measures.
pub fn measure(bench: &Bench) -> Result<()> {
    let (mut plan, mut runs, mut choices) = (Vec::new(), Vec::new(), Vec::new());
    for family in &FAMILIES {
        for &count in family.counts {
            let scene = family.scene(count);
            plan.push((family.name, count));
            let run = |method: &str| Run::new(&scene, STOP_TIME, STOP_TIME).integrator(method);
            runs.extend(["radau", "rk4"].map(run));
            choices.push(Run::new(&scene, 1e-3, 1e-3).integrator("auto"));
        }
    }
    let choices = bench.run("bodies, choice", &choices)?;
    let outcomes = bench.time("bodies", &runs)?;
    let header = "family,bodies,chosen,radau_steps,radau_rejected,radau_newton_iterations,radau_iteration_s,\
                  radau_step_s,rk4_steps,rk4_rejected,rk4_step_s";
    let mut csv = Csv::new(bench, "bodies", header);
    for (((family, count), pair), choice) in plan.iter().zip(outcomes.chunks(2)).zip(&choices) {
        let (radau, rk4) = (pair[0].cost()?, pair[1].cost()?);
        csv.row(&[
            family,
            count,
            &choice.cost()?.method,
            &radau.steps,
            &radau.rejected,
            &radau.newton_iterations,
            &digits(radau.per_iteration()),
            &digits(radau.per_step()),
            &rk4.steps,
            &rk4.rejected,
            &digits(rk4.per_step()),
        ]);
    }
    csv.save()?;
    peers(bench)
}

/// Runs the loops in both programs in turns.
fn peers(bench: &Bench) -> Result<()> {
    let mut exudyn = Exudyn::start(bench.workspace())?;
    let family = &FAMILIES[FAMILIES.len() - 1];
    let header = "loops,own_step_s,own_steps,exudyn_step_s,exudyn_steps,distance_m";
    let mut csv = Csv::new(bench, "bodies_peers", header);
    for count in PEER_LOOPS {
        let mut scene = family.scene(count);
        scene["outputs"] = json!([{ "kind": "position", "marker": MARKER }]);
        scene["accuracy"] = json!({ "relative_tolerance": PEER_TOLERANCE });
        let run = [Run::new(&scene, STOP_TIME, STOP_TIME).integrator("rk4")];
        let options = json!({
            "scene": bench.write("loops.scene.json", &scene)?, "marker": MARKER, "solver": "alpha", "newton": "modified",
            "linear": "sparse", "step": PEER_STEP, "stop_time": STOP_TIME, "every": STOP_TIME,
        });
        let (mut own, mut other, mut steps, mut apart) = (Vec::new(), Vec::new(), 0.0, 0.0);
        for _ in 0..REPEATS {
            let outcome = &bench.run(&format!("bodies, {count} loops beside Exudyn"), &run)?[0];
            let (table, cost, answer) = (outcome.table()?, outcome.cost()?, exudyn.run(&options)?);
            own.push(cost.per_step());
            other.push(answer.cpu_time * PEER_STEP / STOP_TIME);
            let path = table.points(
                &format!("{MARKER}.position[1]"),
                &format!("{MARKER}.position[2]"),
            )?;
            let ends = path.last().zip(answer.path.last());
            let (end, [_, x, y]) = ends.context("expected a path")?;
            (steps, apart) = (cost.steps, distance(*end, [*x, *y]));
        }
        csv.row(&[
            &count,
            &digits(median(&own)),
            &steps,
            &digits(median(&other)),
            &(STOP_TIME / PEER_STEP).round(),
            &digits(apart),
        ]);
    }
    csv.save()
}
