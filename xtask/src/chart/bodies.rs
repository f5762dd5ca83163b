//! CPU time of a step against the number of bodies, apart from each other, pinned in a chain and in loops.

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, Cost, REPEATS, Run};
use super::exudyn::Exudyn;
use super::numbers::{distance, fitted_slope, median, three_digits};
use super::page;
use super::plot::{Axis, Line, Mark, Panel, draw};

const TOLERANCE: f64 = 1e-4;
/// Simulated time, s.
const STOP_TIME: f64 = 1.0;
/// Length of a body, m.
const LENGTH: f64 = 1.2;
/// Elements of a cable.
const ELEMENTS: u32 = 8;
/// Angles over which bodies apart from each other are spread at the start, rad.
const SPREAD: f64 = 0.6;
const METHODS: [&str; 2] = ["radau", "rk4"];
/// Loops that Exudyn computes too, its step (s), and the tolerance beside it.
const PEER_LOOPS: &[u32] = &[20, 40, 80, 200];
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

const FAMILIES: [Family; 5] = [
    Family {
        name: "cables apart",
        is_rigid: false,
        joined: Joined::Apart,
        counts: &[1, 10, 100],
    },
    Family {
        name: "chain of cables",
        is_rigid: false,
        joined: Joined::Chain,
        counts: &[1, 10, 100],
    },
    Family {
        name: "rigid apart",
        is_rigid: true,
        joined: Joined::Apart,
        counts: &[1, 10, 100],
    },
    Family {
        name: "chain of rigid",
        is_rigid: true,
        joined: Joined::Chain,
        counts: &[1, 3, 10, 30, 100, 300, 1000],
    },
    Family {
        name: "loops of rigid",
        is_rigid: true,
        joined: Joined::Loops,
        counts: &[1, 3, 10, 20, 40, 100, 200],
    },
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

/// Cost of both methods for a number of bodies.
struct Row {
    family: &'static Family,
    count: u32,
    radau: Cost,
    rk4: Cost,
    /// The method that is chosen.
    chosen: String,
}

/// Loops in Exudyn: a step of fixed length beside one of rk4.
struct Peer {
    count: u32,
    /// CPU time of a step, s: ours and Exudyn's.
    per_step: [f64; 2],
    /// Steps in the simulated time.
    steps: [f64; 2],
    /// How far apart both end, m.
    distance: f64,
}

/// Runs the loops in both programs in turns.
fn peers(bench: &Bench) -> Result<Vec<Peer>> {
    let mut exudyn = Exudyn::start(bench.workspace())?;
    let family = &FAMILIES[FAMILIES.len() - 1];
    let mut peers = Vec::new();
    for &count in PEER_LOOPS {
        let mut scene = family.scene(count);
        scene["outputs"] = json!([{ "kind": "position", "marker": MARKER }]);
        scene["accuracy"] = json!({ "relative_tolerance": PEER_TOLERANCE });
        let run = [Run::new(&scene, STOP_TIME, STOP_TIME).integrator("rk4")];
        let title = format!("bodies, {count} loops beside Exudyn");
        let file = bench.write("loops.scene.json", &scene)?;
        let options = json!({
            "scene": file, "marker": MARKER, "solver": "alpha", "newton": "modified", "linear": "sparse",
            "step": PEER_STEP, "stop_time": STOP_TIME, "every": STOP_TIME,
        });
        let (mut times, mut ends, mut steps) = ([vec![], vec![]], [[0.0; 2]; 2], 0.0);
        for _ in 0..REPEATS {
            let outcome = &bench.run(&title, &run)?[0];
            let (table, cost) = (outcome.table()?, outcome.cost()?);
            steps = cost.steps;
            times[0].push(cost.per_step());
            for (axis, end) in ends[0].iter_mut().enumerate() {
                let column = table.column(&format!("{MARKER}.position[{}]", axis + 1))?;
                *end = *column.last().context("expected a row")?;
            }
            let answer = exudyn.run(&options)?;
            times[1].push(answer.cpu_time / (STOP_TIME / PEER_STEP));
            let [_, x, y] = answer.path.last().context("expected a path")?;
            ends[1] = [*x, *y];
        }
        peers.push(Peer {
            count,
            per_step: times.map(|times| median(&times)),
            steps: [steps, STOP_TIME / PEER_STEP],
            distance: distance(ends[0], ends[1]),
        });
    }
    Ok(peers)
}

fn peer_table(peers: &[Peer]) -> String {
    let header = [
        "loops",
        "Flexbody: µs a step",
        "steps",
        "Exudyn: µs a step",
        "steps",
        "Exudyn over Flexbody, a step",
        "a second",
        "apart at the end, m",
    ];
    let cells = |peer: &Peer| {
        let [own, other] = peer.per_step;
        let [own_all, other_all] = [own * peer.steps[0], other * peer.steps[1]];
        vec![
            peer.count.to_string(),
            three_digits(1e6 * own),
            format!("{}", peer.steps[0]),
            three_digits(1e6 * other),
            format!("{}", peer.steps[1]),
            three_digits(other / own),
            three_digits(other_all / own_all),
            format!("{:.1e}", peer.distance),
        ]
    };
    page::table(&header, &peers.iter().map(cells).collect::<Vec<_>>())
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let (mut plan, mut runs, mut choices) = (Vec::new(), Vec::new(), Vec::new());
    for family in &FAMILIES {
        for &count in family.counts {
            let scene = family.scene(count);
            plan.push((family, count));
            let run = |method: &&str| Run::new(&scene, STOP_TIME, STOP_TIME).integrator(method);
            runs.extend(METHODS.iter().map(run));
            choices.push(Run::new(&scene, 1e-3, 1e-3).integrator("auto"));
        }
    }
    let choices = bench.run("bodies, choice", &choices)?;
    let outcomes = bench.time("bodies", &runs)?;
    let outcomes = outcomes.chunks(METHODS.len()).zip(&choices);
    let mut rows = Vec::new();
    for ((family, count), (outcomes, choice)) in plan.into_iter().zip(outcomes) {
        rows.push(Row {
            family,
            count,
            radau: outcomes[0].cost()?.clone(),
            rk4: outcomes[1].cost()?.clone(),
            chosen: choice.cost()?.method.clone(),
        });
    }
    write(bench, &rows)?;
    Ok(section(&rows, &peers(bench)?))
}

type Quantity = (&'static str, fn(&Row) -> f64);

const QUANTITIES: [Quantity; 3] = [
    ("radau, a Newton iteration", |row| row.radau.per_iteration()),
    ("radau, a step", |row| row.radau.per_step()),
    ("rk4, a step", |row| row.rk4.per_step()),
];

/// A quantity against the number of bodies of a family.
fn points(rows: &[Row], family: &Family, quantity: fn(&Row) -> f64) -> Vec<(f64, f64)> {
    let own = rows.iter().filter(|row| row.family.name == family.name);
    own.map(|row| (f64::from(row.count), quantity(row)))
        .collect()
}

fn write(bench: &Bench, rows: &[Row]) -> Result<()> {
    let header = [
        "family",
        "bodies",
        "chosen",
        "radau_steps",
        "radau_rejected",
        "radau_newton_iterations",
        "radau_iteration_s",
        "radau_step_s",
        "rk4_steps",
        "rk4_rejected",
        "rk4_step_s",
    ];
    let cells = |row: &Row| {
        vec![
            row.family.name.to_owned(),
            row.count.to_string(),
            row.chosen.clone(),
            row.radau.steps.to_string(),
            row.radau.rejected.to_string(),
            row.radau.newton_iterations.to_string(),
            format!("{:.3e}", row.radau.per_iteration()),
            format!("{:.3e}", row.radau.per_step()),
            row.rk4.steps.to_string(),
            row.rk4.rejected.to_string(),
            format!("{:.3e}", row.rk4.per_step()),
        ]
    };
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    page::write_csv(&bench.output("bodies.csv"), &header, &cells)?;
    let marks = [
        Mark::Dot,
        Mark::Triangle,
        Mark::Ring,
        Mark::Square,
        Mark::Dot,
    ];
    let panel = |&(name, quantity): &Quantity| {
        let line = |(index, family): (usize, &Family)| {
            let own = points(rows, family, quantity);
            let scaled = own.into_iter().map(|(count, time)| (count, 1e6 * time));
            Line::new(family.name, scaled.collect(), index, marks[index])
        };
        let mut lines: Vec<Line> = FAMILIES.iter().enumerate().map(line).collect();
        lines.push(Line::guide("proportional", (1.0, 3.0), 1000.0, 1.0));
        Panel {
            title: name.into(),
            x: Axis::counts("bodies or loops", &[1, 3, 10, 30, 100, 300, 1000]),
            y: Axis::log("CPU time / µs"),
            lines,
        }
    };
    let panels: Vec<Panel> = QUANTITIES.iter().map(panel).collect();
    draw(&bench.output("bodies.svg"), &panels)
}

fn table(rows: &[Row]) -> String {
    let header = [
        "scene",
        "bodies",
        "`auto` takes",
        "radau: µs an iteration",
        "iterations a step",
        "µs a step",
        "rejected of steps",
        "rk4: µs a step",
        "rejected of steps",
    ];
    let cells = |row: &Row| {
        let rejected = |cost: &Cost| format!("{} of {}", cost.rejected, cost.rejected + cost.steps);
        vec![
            row.family.name.to_owned(),
            row.count.to_string(),
            row.chosen.clone(),
            three_digits(1e6 * row.radau.per_iteration()),
            format!("{:.1}", row.radau.newton_iterations / row.radau.steps),
            three_digits(1e6 * row.radau.per_step()),
            rejected(&row.radau),
            three_digits(1e6 * row.rk4.per_step()),
            rejected(&row.rk4),
        ]
    };
    page::table(&header, &rows.iter().map(cells).collect::<Vec<_>>())
}

/// Ratios of the time for many bodies to that for fewer.
fn growth(rows: &[Row]) -> String {
    let mut table = Vec::new();
    for family in &FAMILIES {
        let mut cells = vec![family.name.to_owned()];
        for (_, quantity) in QUANTITIES {
            let own = points(rows, family, quantity);
            let [from_1, from_10] = [1.0, 10.0].map(|count| ratio(&own, count));
            let last = own.get(own.len().saturating_sub(2)..).unwrap_or_default();
            let slope = fitted_slope(last).unwrap_or(f64::NAN);
            cells.push(format!(
                "{}, {}, {slope:.2}",
                three_digits(from_1),
                three_digits(from_10)
            ));
        }
        table.push(cells);
    }
    let names = QUANTITIES.map(|(name, _)| name);
    page::table(&[&["scene"], names.as_slice()].concat(), &table)
}

/// Time for 100 bodies over that for fewer.
fn ratio(points: &[(f64, f64)], count: f64) -> f64 {
    let at = |count: f64| points.iter().find(|point| point.0 == count);
    match (at(100.0), at(count)) {
        (Some(many), Some(few)) => many.1 / few.1,
        _ => f64::NAN,
    }
}

fn section(rows: &[Row], peers: &[Peer]) -> String {
    let of = |family: usize, quantity: usize| {
        let own = points(rows, &FAMILIES[family], QUANTITIES[quantity].1);
        three_digits(ratio(&own, 1.0))
    };
    let at = |family: usize, quantity: usize, count: f64| {
        let own = points(rows, &FAMILIES[family], QUANTITIES[quantity].1);
        let found = own.iter().find(|point| point.0 == count);
        found.map_or(f64::NAN, |point| point.1)
    };
    format!(
        "\
## bodies: CPU time of a step against the number of bodies

![Cost of a step against the number of bodies](bodies.svg)

One scene with 1 to 1,000 bodies of {LENGTH} m: pendulums apart from each other, let go between the horizontal and {SPREAD} rad below it, or a chain let go from the horizontal, each link pinned to the next. Cables are those of the soft pendulum with {ELEMENTS} elements, rigid bodies uniform rods of 1 kg. Loops are four-bar linkages side by side, rods of 1 m and 1 kg (IFToMM's benchmark A02): uprights pinned to the ground, rods between their heads, all heads moving with 1 m/s.
Tolerance {TOLERANCE:e}, {STOP_TIME} s; CPU time of all steps over the number of accepted ones, rejected ones paid for; medians of {REPEATS} runs that take turns.

{}
Growth: time for 100 bodies over that for 1, over that for 10, and the slope between the two largest numbers (1 = proportional):

{}
The same loops beside Exudyn (1.13.6, generalized-alpha with modified Newton and sparse solver, steps of {PEER_STEP} s, from `lab/exudyn/model.py`), in turns, medians of {REPEATS}; rk4 at tolerance {PEER_TOLERANCE:e}:

{}
**What it means.** What is not joined costs in proportion to the number of bodies, and so does a chain of cables: 100 cables apart cost {} times what one costs (a Newton iteration; a step of rk4: {} times), 100 in a chain {} times ({} times). 100 rigid pendulums apart cost {} times ({} times); a step of one alone is mostly overhead. A step of radau costs more in a chain of cables for another reason as well: it takes more iterations and rejects more steps. \
\
100 rigid links in a chain cost {} times one ({} times), 100 loops {} times one ({} times); ten links cost {:.1} times what ten rigid pendulums apart cost. Up to 8 rigid bodies that pins tie together are reduced to their free coordinates; beyond that pins keep multipliers, and all constraints are solved for by sparse factors (docs/decisions/0029-constraints-at-linear-cost.md).
",
        table(rows),
        growth(rows),
        peer_table(peers),
        of(0, 0),
        of(0, 2),
        of(1, 0),
        of(1, 2),
        of(2, 0),
        of(2, 2),
        of(3, 0),
        of(3, 2),
        of(4, 0),
        of(4, 2),
        at(3, 2, 10.0) / at(2, 2, 10.0),
    )
}
