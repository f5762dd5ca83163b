//! CPU time that a unit takes besides its solver: until the first step, and at every step.

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::Bench;
use super::numbers::three_digits;
use super::page;
use super::plot::{Axis, Line, Mark, Panel, draw};

const SCENE: &str = "soft_pendulum/scene.json";
const MESHES: [u32; 4] = [1, 10, 100, 1000];
const TOLERANCE: f64 = 1e-4;

/// Phases of a start, as in the lab's report and on the page.
const START: [(&str, &str); 6] = [
    ("instantiate", "instantiate"),
    ("set_up", "set up"),
    ("enter", "enter initialization"),
    ("exit", "exit"),
    ("first_step", "first step"),
    ("whole", "all"),
];
/// Parts of a step.
const STEP: [(&str, &str); 4] = [
    ("solver", "solver, one step of rk4"),
    ("step", "rest of `fmi2DoStep`"),
    ("exchange", "set 2, get 12"),
    ("outside", "outside the solver"),
];
/// What masters do between steps.
const STATE: [(&str, &str); 7] = [
    ("save", "get state"),
    ("restore", "set state"),
    ("serialize", "serialize"),
    ("deserialize", "deserialize"),
    ("directional", "12 directional derivatives"),
    ("first", "12 first derivatives"),
    ("second", "12 second derivatives"),
];

/// Times of one scene, s.
struct Row {
    /// Elements; 0 for a rigid body.
    elements: u32,
    start: [f64; START.len()],
    step: [f64; STEP.len()],
    state: [f64; STATE.len()],
    bytes: f64,
}

impl Row {
    fn name(&self) -> String {
        match self.elements {
            0 => "rigid".into(),
            count => count.to_string(),
        }
    }
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let cable = bench.case_json(SCENE)?;
    let mut rows = Vec::new();
    for elements in [0].into_iter().chain(MESHES) {
        let report = bench.lab(&["overhead"], &scene(&cable, elements))?;
        rows.push(Row {
            elements,
            start: times(&report["start"], &START)?,
            step: times(&report["step"], &STEP)?,
            state: times(&report["state"], &STATE)?,
            bytes: times(&report["state"], &[("bytes", "")])?[0],
        });
    }
    write(bench, &rows)?;
    Ok(section(&rows))
}

/// A pendulum with two inputs and twelve outputs.
fn scene(cable: &Value, elements: u32) -> Value {
    let mut scene = cable.clone();
    match elements {
        0 => {
            scene["bodies"] = json!([{
                "name": "rod", "element": "rigid", "mass": 12.0, "inertia": 1.4, "position": [0.6, 0.0],
                "markers": { "root": [-0.6, 0.0], "middle": [0.0, 0.0], "tip": [0.6, 0.0] },
            }]);
        }
        count => scene["bodies"][0]["elements"] = count.into(),
    }
    scene["inputs"] = json!([{ "kind": "force", "marker": "rod.tip" }]);
    let at = |kind: &str, marker: &str| json!({ "kind": kind, "marker": marker });
    scene["outputs"] = json!([
        at("position", "rod.tip"),
        at("position", "rod.middle"),
        at("velocity", "rod.tip"),
        at("velocity", "rod.middle"),
        { "kind": "energy" },
    ]);
    scene["accuracy"] = json!({ "relative_tolerance": TOLERANCE });
    scene
}

fn times<const N: usize>(report: &Value, parts: &[(&str, &str); N]) -> Result<[f64; N]> {
    let mut times = [0.0; N];
    for (time, (key, _)) in times.iter_mut().zip(parts) {
        let found = report[key].as_f64();
        *time = found.with_context(|| format!("expected a time {key}, found {}", report[key]))?;
    }
    Ok(times)
}

fn write(bench: &Bench, rows: &[Row]) -> Result<()> {
    let parts = || {
        START
            .iter()
            .chain(&STEP)
            .chain(&STATE)
            .map(|(key, _)| format!("{key}_s"))
    };
    let ends = |first: String, last: String, inner: Vec<String>| -> Vec<String> {
        [vec![first], inner, vec![last]].concat()
    };
    let header = ends("body".into(), "bytes".into(), parts().collect());
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let cells = |row: &Row| {
        let times = row.start.iter().chain(&row.step).chain(&row.state);
        let times = times.map(|time| format!("{time:.3e}"));
        ends(row.name(), format!("{}", row.bytes), times.collect())
    };
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    page::write_csv(&bench.output("overhead.csv"), &header, &cells)?;
    let marks = [Mark::Dot, Mark::Triangle, Mark::Ring, Mark::Square];
    let lines = |names: &[(&str, &str)], chosen: &[usize], time: fn(&Row, usize) -> f64| {
        let line = |(index, part): (usize, &usize)| {
            let cables = rows.iter().filter(|row| row.elements > 0);
            let points = cables.map(|row| (f64::from(row.elements), time(row, *part)));
            Line::new(names[*part].1, points.collect(), index, marks[index])
        };
        chosen.iter().enumerate().map(line).collect()
    };
    let panels = [
        Panel {
            title: "From instantiation to the first step".into(),
            x: Axis::counts("elements", &MESHES),
            y: Axis::log("CPU time / ms"),
            lines: lines(&START, &[5, 0, 2, 4], |row, part| 1e3 * row.start[part]),
        },
        Panel {
            title: "At every step".into(),
            x: Axis::counts("elements", &MESHES),
            y: Axis::log("CPU time / µs"),
            lines: lines(&STEP, &[0, 3], |row, part| 1e6 * row.step[part]),
        },
        Panel {
            title: "Between steps".into(),
            x: Axis::counts("elements", &MESHES),
            y: Axis::log("CPU time / µs"),
            lines: lines(&STATE, &[1, 2, 4, 6], |row, part| 1e6 * row.state[part]),
        },
    ];
    draw(&bench.output("overhead.svg"), &panels)
}

fn table<const N: usize>(
    rows: &[Row],
    parts: &[(&str, &str); N],
    times: impl Fn(&Row) -> [f64; N],
    unit: (&str, f64),
) -> String {
    let (symbol, per) = unit;
    let names = parts.iter().map(|(_, name)| format!("{name} / {symbol}"));
    let header: Vec<String> = ["elements".to_owned()].into_iter().chain(names).collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let cells = |row: &Row| {
        // A difference of two times that scatter more than they differ.
        let shown = |time: f64| match time > 0.0 {
            true => three_digits(per * time),
            false => "–".to_owned(),
        };
        let times = times(row).map(shown);
        [row.name()].into_iter().chain(times).collect()
    };
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    page::table(&header, &cells)
}

fn section(rows: &[Row]) -> String {
    let of = |elements: u32| rows.iter().find(|row| row.elements == elements);
    let start = |elements: u32| {
        let found = of(elements).map_or(f64::NAN, |row| row.start[START.len() - 1]);
        three_digits(1e3 * found)
    };
    let outside = |elements: u32, part: usize| {
        let found = of(elements).map_or(f64::NAN, |row| row.step[part]);
        three_digits(1e6 * found)
    };
    let between = |elements: u32, parts: &[usize]| {
        let sum = |row: &Row| parts.iter().map(|part| row.state[*part]).sum();
        three_digits(1e6 * of(elements).map_or(f64::NAN, sum))
    };
    format!(
        "\
## overhead: what a unit costs besides its solver

![CPU time besides the solver](overhead.svg)

The soft pendulum with a force at its tip as input and twelve outputs (positions and velocities of two markers, all energies), and a rigid one; tolerance {TOLERANCE:e}. A small master calls the C interface.
The start is that of `auto`, files read from memory. For the steps, those of rk4, so short that the solver takes one sub-step each; `the solver` is the same sub-step without the interface, and the rest is what `fmi2DoStep` takes more (–: less than the scatter of the solver, about 1 %). Medians of rounds that take turns.

Start:

{}
Every step:

{}
Between steps, as masters do that go back; derivatives of all twelve outputs by a force, and in time:

{}
**What it means.** A unit of 100 elements stands ready {} ms after a master asks for it, one of 1000 after {} ms. `fmi2DoStep` adds {} µs to the solver with a rigid body and {} µs with 1 element (with more it is lost in scatter). Setting two inputs and reading twelve outputs takes {} µs with 1 element. With more, outputs cost what it takes to compute them, nodes from coordinates and sums over elements: {} µs with 100 elements. Only what is read is computed.
A state of 100 elements is taken and set in {} µs; as bytes it has {}, and making them and reading them takes {} µs, of which most is their checksum. Exact derivatives by an input take {} µs for the twelve outputs, second ones in time {} µs.
",
        table(rows, &START, |row| row.start, ("ms", 1e3)),
        table(rows, &STEP, |row| row.step, ("µs", 1e6)),
        table(rows, &STATE, |row| row.state, ("µs", 1e6)),
        start(100),
        start(1000),
        outside(0, 1),
        outside(1, 1),
        outside(1, 2),
        outside(100, 2),
        between(100, &[0, 1]),
        of(100).map_or(f64::NAN, |row| row.bytes),
        between(100, &[2, 3]),
        between(100, &[4]),
        between(100, &[6]),
    )
}
