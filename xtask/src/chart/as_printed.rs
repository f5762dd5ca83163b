//! The report's equations as printed against the mass-weighted elimination, on the soft pendulum.

use anyhow::Result;
use serde_json::{Value, json};

use crate::table::Table;

use super::bench::{Bench, Outcome, Run};
use super::numbers::{distance, short};
use super::page;
use super::plot::{Axis, Line, Mark, Panel, draw};

const MESHES: [u32; 3] = [2, 4, 10];
const FORMULATIONS: [&str; 2] = ["as_printed", "mass_weighted"];
const STOP_TIME: f64 = 1.1;
const STEP: f64 = 0.01;
const TOLERANCE: f64 = 1e-6;
/// Ends of the elements that meet in the middle: markers this near to a node lie on it, each on
/// its own element.
const LEFT: f64 = 0.5 - 1e-11;
const RIGHT: f64 = 0.5;
/// Distances below this are drawn here; exact zeros occur.
const FLOOR: f64 = 1e-17;

/// One run: what is torn at the communication points that it reached.
struct Curve {
    formulation: &'static str,
    elements: u32,
    time: Vec<f64>,
    /// Between the two elements that meet in the middle, m.
    gap: Vec<f64>,
    /// Between the first end and its pin, m.
    pin: Vec<f64>,
    /// Of the tip from the independent solution, m.
    tip: Vec<f64>,
    failure: Option<String>,
}

/// What a rod did at communication points: gaps and distances from the pin (m), positions of the tip.
#[derive(Default)]
struct Moved {
    time: Vec<f64>,
    gap: Vec<f64>,
    pin: Vec<f64>,
    tip: Vec<[f64; 2]>,
    failure: Option<String>,
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let scene = marked(bench.case_json("soft_pendulum/scene.json")?);
    let reference = Table::read(&bench.case_file("soft_pendulum/reference.csv"))?;
    let [printed, weighted] = FORMULATIONS;
    let mut curves = Vec::new();
    for elements in MESHES {
        let moved = as_printed(bench, &scene, elements)?;
        curves.push(curve(printed, elements, moved, &reference)?);
    }
    let run = |elements| Run::new(&scene, STOP_TIME, STEP).elements(elements);
    let runs = MESHES.map(|elements| run(elements).tolerance(TOLERANCE).integrator("rk4"));
    for (elements, outcome) in MESHES.into_iter().zip(bench.run("as printed", &runs)?) {
        curves.push(curve(weighted, elements, moved(&outcome)?, &reference)?);
    }
    write(bench, &curves)?;
    Ok(section(&curves))
}

/// The scene with markers at both sides of the node in the middle, and at the pin.
fn marked(mut scene: Value) -> Value {
    scene["bodies"][0]["markers"] = json!({"root": 0.0, "left": LEFT, "right": RIGHT, "tip": 1.0});
    let output = |marker: &str| json!({"kind": "position", "marker": format!("rod.{marker}")});
    scene["outputs"] = ["root", "left", "right", "tip"].map(output).into();
    scene
}

/// The report's equations in the lab.
fn as_printed(bench: &Bench, scene: &Value, elements: u32) -> Result<Moved> {
    let [elements, stop, every] = [f64::from(elements), STOP_TIME, STEP].map(|x| x.to_string());
    let options = ["swing", "--formulation", "as_printed", "--consistent"];
    let sizes = [
        "--elements",
        &elements,
        "--stop-time",
        &stop,
        "--every",
        &every,
    ];
    let report = bench.lab(&[&options[..], &sizes[..]].concat(), scene)?;
    let numbers = |value: &Value| -> Vec<f64> {
        let values = value.as_array().into_iter().flatten();
        values.filter_map(Value::as_f64).collect()
    };
    let points = report["path"].as_array().into_iter().flatten();
    let path: Vec<Vec<f64>> = points.map(numbers).collect();
    Ok(Moved {
        time: path.iter().map(|point| point[0]).collect(),
        gap: numbers(&report["middle"]),
        pin: numbers(&report["pins"]),
        tip: path.iter().map(|point| [point[1], point[2]]).collect(),
        failure: report["lost_at"]
            .as_f64()
            .map(|time| format!("lost at {time} s")),
    })
}

fn path(table: &Table, x: &str, y: &str) -> Result<Vec<[f64; 2]>> {
    let (x, y) = (table.column(x)?, table.column(y)?);
    Ok(x.into_iter().zip(y).map(|(x, y)| [x, y]).collect())
}

/// What a run of the product did.
fn moved(outcome: &Outcome) -> Result<Moved> {
    let mut moved = Moved {
        failure: outcome.cost.as_ref().err().cloned(),
        ..Moved::default()
    };
    let Some(table) = &outcome.table else {
        return Ok(moved);
    };
    let marker = |name: &str| {
        let column = |axis: u32| format!("rod.{name}.position[{axis}]");
        path(table, &column(1), &column(2))
    };
    let (left, right, root) = (marker("left")?, marker("right")?, marker("root")?);
    let gaps = left.into_iter().zip(right);
    moved.time = table.column("time")?;
    moved.gap = gaps.map(|(left, right)| distance(left, right)).collect();
    moved.pin = root
        .into_iter()
        .map(|root| distance(root, [0.0; 2]))
        .collect();
    moved.tip = marker("tip")?;
    Ok(moved)
}

fn curve(
    formulation: &'static str,
    elements: u32,
    moved: Moved,
    reference: &Table,
) -> Result<Curve> {
    let known = path(reference, "x_tip", "y_tip")?;
    let known_times = reference.column("t")?;
    let mut curve = Curve {
        formulation,
        elements,
        time: Vec::new(),
        gap: Vec::new(),
        pin: Vec::new(),
        tip: Vec::new(),
        failure: moved.failure,
    };
    for (index, time) in moved.time.into_iter().enumerate() {
        let same = |other: &f64| (other - time).abs() < 1e-9;
        if let Some(at) = known_times.iter().position(same) {
            curve.time.push(time);
            curve.gap.push(moved.gap[index]);
            curve.pin.push(moved.pin[index]);
            curve.tip.push(distance(moved.tip[index], known[at]));
        }
    }
    Ok(curve)
}

fn write(bench: &Bench, curves: &[Curve]) -> Result<()> {
    let header = [
        "formulation",
        "elements",
        "time_s",
        "gap_m",
        "pin_distance_m",
        "tip_error_m",
    ];
    let mut rows = Vec::new();
    for curve in curves {
        for index in 0..curve.time.len() {
            rows.push(vec![
                curve.formulation.to_owned(),
                curve.elements.to_string(),
                format!("{:.2}", curve.time[index]),
                format!("{:.3e}", curve.gap[index]),
                format!("{:.3e}", curve.pin[index]),
                format!("{:.3e}", curve.tip[index]),
            ]);
        }
    }
    page::write_csv(&bench.output("as_printed.csv"), &header, &rows)?;
    let marks = [Mark::Dot, Mark::Ring, Mark::Triangle];
    let lines = |quantity: fn(&Curve) -> &[f64]| -> Vec<Line> {
        let line = |index: usize| {
            // Row by row of the legend: one mesh, both formulations.
            let (mesh, formulation) = (index / FORMULATIONS.len(), index % FORMULATIONS.len());
            let curve = &curves[formulation * MESHES.len() + mesh];
            let name = format!("{}, {} elements", curve.formulation, curve.elements);
            let points = curve.time.iter().zip(quantity(curve));
            let points = points.filter(|(_, y)| y.is_finite()).skip(5).step_by(5);
            let points = points.map(|(x, y)| (*x, *y)).collect();
            let line = Line::new(&name, points, formulation, marks[mesh]);
            if formulation == 0 {
                line
            } else {
                line.dashed()
            }
        };
        (0..curves.len()).map(line).collect()
    };
    let panels = [
        Panel {
            title: "Gap between two elements in the middle".into(),
            x: Axis::linear("time / s", 0.2),
            y: Axis::log("gap / m").floor(FLOOR),
            lines: lines(|curve| &curve.gap),
        },
        Panel {
            title: "Distance of the pinned end from its pin".into(),
            x: Axis::linear("time / s", 0.2),
            y: Axis::log("distance / m").floor(FLOOR),
            lines: lines(|curve| &curve.pin),
        },
        Panel {
            title: "Error of the tip".into(),
            x: Axis::linear("time / s", 0.2),
            y: Axis::log("distance from the reference / m").floor(1e-9),
            lines: lines(|curve| &curve.tip),
        },
    ];
    draw(&bench.output("as_printed.svg"), &panels)
}

fn section(curves: &[Curve]) -> String {
    let header = [
        "formulation",
        "elements",
        "gap at 0.1 s / m",
        "at 0.5 s",
        "largest",
        "largest distance from the pin / m",
        "largest error of the tip / m",
        "run ends",
    ];
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let row = |curve: &Curve| {
        let at = |wanted: f64| {
            let index = curve.time.iter().position(|t| (t - wanted).abs() < 1e-9);
            index.map_or("–".to_owned(), |index| short(curve.gap[index]))
        };
        let end = match (&curve.failure, curve.time.last()) {
            (None, _) => format!("{STOP_TIME} s"),
            (Some(_), Some(time)) => format!("fails after {time:.2} s"),
            (Some(_), None) => "fails at once".to_owned(),
        };
        vec![
            curve.formulation.to_owned(),
            curve.elements.to_string(),
            at(0.1),
            at(0.5),
            short(largest(&curve.gap)),
            short(largest(&curve.pin)),
            short(largest(&curve.tip)),
            end,
        ]
    };
    let rows: Vec<Vec<String>> = curves.iter().map(row).collect();
    let (printed, weighted) = curves.split_at(MESHES.len());
    let range = |curves: &[Curve], of: fn(&Curve) -> &[f64]| {
        let values = curves.iter().map(|curve| largest(of(curve)));
        let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        if low == high {
            return short(low);
        }
        format!("{} to {}", short(low), short(high))
    };
    format!(
        "\
## as_printed: the report's elimination as printed

![Gaps and errors of the printed equations](as_printed.svg)

Soft pendulum. `as_printed` integrates report MBS97-2-UIC, Eqs. 23–34, as they stand, in the lab (classical Runge-Kutta, steps of 0.7 of the largest that is stable at rest); `mass_weighted` is the product, rk4 at tolerance {TOLERANCE:e}.
The gap is the distance between the ends of the two elements that meet in the middle: zero if the body is whole. The tip is compared with the independent solution of the case. Values below {FLOOR:e} m are drawn there.

{}
**What it means.** As printed no connection holds: the elements drift apart by {} m in {STOP_TIME} s, and the pinned end leaves its pin and falls {} m, nearly freely. Weighted by the square root of the mass the gaps are {} m. \
The errors of the tip that remain ({} m) are those of such coarse meshes (see mesh).
",
        page::table(&header, &rows),
        range(printed, |curve| &curve.gap),
        short(printed.iter().map(|curve| largest(&curve.pin)).fold(0.0, f64::max)),
        range(weighted, |curve| &curve.gap),
        range(weighted, |curve| &curve.tip),
    )
}
