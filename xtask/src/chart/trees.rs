//! Open trees of rigid bodies in space: error against CPU time, and the time of one acceleration, beside MuJoCo, Pinocchio and
//! Exudyn.

use std::f64::consts::FRAC_1_SQRT_2;

use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

use super::bench::{Bench, Ran, Run};
use super::csv::Csv;
use super::numbers::{largest, largest_distance, median, number, numbers};
use super::server::{Server, TREES};

/// Simulated time, and time between points at which places are compared, s.
const STOP_TIME: f64 = 1.0;
const EVERY: f64 = 0.05;
/// Rounds of timed runs.
const ROUNDS: usize = 5;
/// Numbers of links of the chains, and the length of a link, m.
const CHAINS: [usize; 3] = [8, 32, 128];
const LENGTH: f64 = 0.25;
/// Steps between points: those that are timed, and of references.
const STEPS: [u32; 9] = [1, 2, 4, 8, 16, 32, 64, 128, 256];
const FINEST: [u32; 2] = [1024, 512];
/// The product's methods, and tolerances; the last one is held against references only.
const METHODS: [&str; 3] = ["auto", "rk4", "radau"];
const TOLERANCES: [f64; 8] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
const TIGHTEST: f64 = 1e-11;
/// A run of more CPU time than this is the last of its method that is refined, s.
const LONG: f64 = 3.0;
/// Calls of accelerations that are timed at once, for one body.
const CALLS: usize = 40_000;

/// Program, model of bodies, method.
const OTHERS: [Solver; 8] = [
    Solver::new("MuJoCo", "joint angles", "rk4"),
    Solver::new("MuJoCo", "joint angles", "implicitfast"),
    Solver::new("Pinocchio", "joint angles", "rk4"),
    Solver::new("Exudyn", "kinematic tree", "rk4"),
    Solver::new("Exudyn", "kinematic tree", "rk67"),
    Solver::new("Exudyn", "euler parameters", "trapezoidal"),
    Solver::new("Exudyn", "rotation vectors", "trapezoidal"),
    Solver::new("Exudyn", "euler parameters", "alpha"),
];

/// Places of a point in space, m.
type Path = super::numbers::Path<3>;

/// A tree whose last body is watched.
struct Tree {
    name: String,
    bodies: usize,
    marker: String,
    scene: Value,
}

/// A program with its model of joints and its method.
#[derive(Clone, Copy, PartialEq)]
struct Solver {
    program: &'static str,
    model: &'static str,
    method: &'static str,
}

impl Solver {
    const fn new(program: &'static str, model: &'static str, method: &'static str) -> Self {
        Self {
            program,
            model,
            method,
        }
    }
}

/// A run that is repeated: its method and setting, its error, m, and its CPU times, s.
struct Timed {
    solver: Solver,
    setting: f64,
    steps: f64,
    error: f64,
    cpu_times: Vec<f64>,
}

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let mut server = Server::start(bench.workspace(), TREES)?;
    let header = "scene,bodies,program,model,method,setting,steps,error_m,cpu_time_s";
    let mut csv = Csv::new(bench, "trees", header);
    let header = "scene,bodies,doubled_m,mujoco_m,flexbody_m";
    let mut references = Csv::new(bench, "trees_references", header);
    let header = "scene,bodies,program,time_s,apart";
    let mut accelerations = Csv::new(bench, "trees_acceleration", header);
    for tree in trees(bench)? {
        let reference = tree.reference(bench, &mut server, &mut references)?;
        for timed in tree.runs(bench, &mut server, &reference)? {
            csv.row(&[
                &tree.name,
                &tree.bodies,
                &timed.solver.program,
                &timed.solver.model,
                &timed.solver.method,
                &timed.setting,
                &timed.steps,
                &timed.error,
                &median(&timed.cpu_times),
            ]);
        }
        tree.accelerate(bench, &mut server, &mut accelerations)?;
    }
    csv.save()?;
    references.save()?;
    accelerations.save()
}

/// The arm of the ready scene, mounted on a base that leans by 30 degrees and let go, and chains.
fn trees(bench: &Bench) -> Result<Vec<Tree>> {
    let mut arm = bench.json("scenes/robot_6_axis.json")?;
    let joints = arm["joints"].as_array_mut().context("expected joints")?;
    for joint in joints {
        *joint = json!({ "name": joint["name"], "kind": "revolute", "markers": joint["markers"],
                         "direction": joint["direction"] });
    }
    arm["gravity"] = json!([0.0, 4.905, -8.496]);
    for left in ["loads", "inputs", "initial"] {
        arm.as_object_mut()
            .context("expected a scene")?
            .remove(left);
    }
    let bodies = arm["bodies"].as_array().map_or(0, Vec::len);
    // Where joints ask for them to be, beyond the digits of the file.
    let mut from = [0.0, 0.2];
    for body in arm["bodies"].as_array_mut().context("expected bodies")? {
        let angle = body["orientation"]["rotation_vector"][1]
            .as_f64()
            .unwrap_or(0.0);
        let half = number(&body["markers"]["out"][0])?;
        let way = [half * angle.cos(), -half * angle.sin()];
        body["position"] = json!([from[0] + way[0], 0.0, from[1] + way[1]]);
        from = [0, 1].map(|k| from[k] + 2.0 * way[k]);
    }
    let arm = Tree::new("arm", bodies, "tool.out", arm);
    Ok([arm].into_iter().chain(CHAINS.map(chain)).collect())
}

/// Links in a row on axes that lean to one side and to the other, let go from the horizontal.
fn chain(count: usize) -> Tree {
    let (mut bodies, mut joints) = (Vec::new(), Vec::new());
    for index in 0..count {
        let name = format!("link{index}");
        let half = 0.5 * LENGTH;
        let before = match index {
            0 => "ground".to_owned(),
            _ => format!("link{}.end", index - 1),
        };
        let side = if index % 2 == 0 { -1.0 } else { 1.0 };
        joints.push(json!({ "name": format!("pin{index}"), "kind": "revolute",
            "markers": [before, format!("{name}.start")], "direction": [0.0, FRAC_1_SQRT_2, side * FRAC_1_SQRT_2] }));
        bodies.push(
            json!({ "name": name, "element": "rigid", "mass": 1.0, "inertia": [0.002, 0.006, 0.007],
            "position": [LENGTH * (index as f64 + 0.5), 0.0, 0.0],
            "markers": { "start": [-half, 0.0, 0.0], "end": [half, 0.0, 0.0] } }),
        );
    }
    let scene = json!({ "name": "chain", "dimension": 3, "gravity": [0.0, 0.0, -9.81], "bodies": bodies,
                        "joints": joints });
    Tree::new(
        &format!("chain of {count}"),
        count,
        &format!("link{}.end", count - 1),
        scene,
    )
}

impl Tree {
    fn new(name: &str, bodies: usize, marker: &str, mut scene: Value) -> Self {
        scene["outputs"] = json!([{ "kind": "position", "marker": marker }]);
        scene["accuracy"] = json!({});
        scene["experiment"] = json!({ "stop_time": STOP_TIME, "step": EVERY });
        let [name, marker] = [name, marker].map(str::to_owned);
        Self {
            name,
            bodies,
            marker,
            scene,
        }
    }

    /// Options of a run of another program.
    fn options(&self, bench: &Bench, solver: Solver, steps: u32) -> Result<Value> {
        Ok(json!({
            "scene": bench.write(&self.scene)?, "marker": self.marker, "program": solver.program,
            "model": solver.model, "method": solver.method, "step": EVERY / f64::from(steps), "stop_time": STOP_TIME, "every": EVERY,
            "folder": bench.workspace().target("chart"),
        }))
    }

    /// A run of the product.
    fn run(&self, method: &str, tolerance: f64) -> Run {
        Run::new(&self.scene, STOP_TIME, EVERY)
            .integrator(method)
            .tolerance(tolerance)
    }

    /// Places of the marker, without the start.
    fn path(&self, ran: &Ran) -> Result<Path> {
        Ok(ran.table.marker(&self.marker)?.split_off(1))
    }

    /// Pinocchio at the finest step, which another mechanics in the same steps, steps twice as long and the product must confirm.
    fn reference(&self, bench: &Bench, server: &mut Server, csv: &mut Csv) -> Result<Path> {
        let mut path = |program: &'static str, steps: u32| {
            let solver = Solver::new(program, "joint angles", "rk4");
            let answer = server.ask(&self.options(bench, solver, steps)?)?;
            places(&answer).with_context(|| format!("{program} failed: {}", answer["failure"]))
        };
        let reference = path("Pinocchio", FINEST[0])?;
        let doubled = largest_distance(&path("Pinocchio", FINEST[1])?, &reference);
        let other = largest_distance(&path("MuJoCo", FINEST[0])?, &reference);
        let title = format!("trees, {}, reference", self.name);
        let ran = bench.run(&title, &[self.run("rk4", TIGHTEST)])?.remove(0)?;
        let own = largest_distance(&self.path(&ran)?, &reference);
        csv.row(&[&self.name, &self.bodies, &doubled, &other, &own]);
        Ok(reference)
    }

    /// Runs everything in rounds. What fails or is unstable is left out.
    fn runs(&self, bench: &Bench, server: &mut Server, reference: &Path) -> Result<Vec<Timed>> {
        let mut all: Vec<Timed> = Vec::new();
        for round in 1..=ROUNDS {
            let mut found = self.own(bench, round, reference)?;
            for solver in OTHERS {
                for steps in STEPS {
                    let answer = server.ask(&self.options(bench, solver, steps)?)?;
                    let Some(path) = places(&answer) else {
                        continue;
                    };
                    let cpu_time = number(&answer["cpu_time"])?;
                    found.push(Timed {
                        solver,
                        setting: EVERY / f64::from(steps),
                        steps: (f64::from(steps) * STOP_TIME / EVERY).round(),
                        error: largest_distance(&path, reference),
                        cpu_times: vec![cpu_time],
                    });
                    if cpu_time > LONG {
                        break;
                    }
                }
            }
            if all.is_empty() {
                all = found;
                continue;
            }
            for timed in found {
                let is_same =
                    |old: &&mut Timed| old.solver == timed.solver && old.setting == timed.setting;
                if let Some(old) = all.iter_mut().find(is_same) {
                    old.cpu_times.extend(timed.cpu_times);
                }
            }
        }
        Ok(all)
    }

    /// One round of the product.
    fn own(&self, bench: &Bench, round: usize, reference: &Path) -> Result<Vec<Timed>> {
        let plan = METHODS.map(|method| TOLERANCES.map(|tolerance| (method, tolerance)));
        let plan = plan.as_flattened();
        let runs: Vec<Run> = (plan
            .iter()
            .map(|(method, tolerance)| self.run(method, *tolerance)))
        .collect();
        let title = format!("trees, {}, round {round} of {ROUNDS}", self.name);
        let mut found = Vec::new();
        for (outcome, (method, setting)) in bench.run(&title, &runs)?.into_iter().zip(plan) {
            let ran = outcome?;
            found.push(Timed {
                solver: Solver::new("Flexbody", "", method),
                setting: *setting,
                steps: ran.number("steps"),
                error: largest_distance(&self.path(&ran)?, reference),
                cpu_times: vec![ran.cpu_time],
            });
        }
        Ok(found)
    }

    /// Times one acceleration at the start in turns. What is found must be the same: of MuJoCo and Pinocchio angles, of the product
    /// the place of the marker.
    fn accelerate(&self, bench: &Bench, server: &mut Server, csv: &mut Csv) -> Result<()> {
        let rest = vec![0.0; self.bodies];
        let mut times = [vec![], vec![], vec![]];
        let mut found = Vec::new();
        for _ in 0..ROUNDS {
            for (program, times) in ["MuJoCo", "Pinocchio"].iter().zip(&mut times) {
                let mut options = self.options(bench, Solver::new(program, "", ""), 1)?;
                options["angles"] = json!(rest);
                options["rates"] = json!(rest);
                options["calls"] = json!((CALLS / self.bodies).max(100));
                let answer = server.ask(&options)?;
                ensure!(answer["good"] == Value::Bool(true), "{}", answer["failure"]);
                times.push(number(&answer["cpu_time"])?);
                found.push(numbers(&answer["acceleration"])?);
            }
            let report = bench.studies(&["dynamics"], Some(&self.scene))?;
            times[2].push(number(&report["acceleration"])?);
        }
        let pairs = found[0].iter().zip(&found[1]);
        let apart =
            largest(pairs.map(|(a, b)| (a - b).abs())) / largest(found[0].iter().map(|a| a.abs()));
        for (program, times) in ["MuJoCo", "Pinocchio", "Flexbody"].iter().zip(&times) {
            csv.row(&[&self.name, &self.bodies, program, &median(times), &apart]);
        }
        Ok(())
    }
}

/// The places of an answer, if it is one.
fn places(answer: &Value) -> Option<Path> {
    let rows = answer["path"]
        .as_array()
        .filter(|_| answer["good"] == Value::Bool(true))?;
    let place = |row: &Value| Some([row[0].as_f64()?, row[1].as_f64()?, row[2].as_f64()?]);
    rows.iter().map(place).collect()
}
