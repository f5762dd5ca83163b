//! CPU time of a step against the number of elements.

use anyhow::Result;
use serde_json::Value;

use super::bench::{Bench, Cost, Run};
use super::numbers::{fitted_slope, three_digits};
use super::page;
use super::plot::{Axis, Line, Mark, Panel, draw};

const MESHES: [u32; 7] = [10, 20, 50, 100, 200, 500, 1000];
const SCENE: &str = "soft_pendulum/scene.json";
const TOLERANCE: f64 = 1e-4;
/// Steps times elements of a run with rkn43: a few hundredths of a second.
const WORK: f64 = 2e5;
/// Stop time of the runs with radau, whose steps depend little on the mesh, s.
const STOP_TIME: f64 = 1.1;

/// Cost of both methods on one mesh.
struct Row {
    elements: u32,
    rkn43: Cost,
    /// Simulated time of the run with rkn43, s.
    explicit_time: f64,
    radau: Cost,
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let scene = bench.case_json(SCENE)?;
    let explicit = explicit_runs(bench, &scene)?;
    let mut runs = Vec::new();
    let mut explicit_times = Vec::new();
    for (elements, explicit) in MESHES.iter().zip(explicit) {
        explicit_times.push(explicit.stop_time());
        let implicit = Run::new(&scene, STOP_TIME, STOP_TIME).elements(*elements);
        runs.push(explicit);
        runs.push(implicit.tolerance(TOLERANCE).integrator("radau"));
    }
    let outcomes = bench.time("cost", &runs)?;
    let mut rows = Vec::new();
    for ((&elements, explicit_time), pair) in
        MESHES.iter().zip(explicit_times).zip(outcomes.chunks(2))
    {
        rows.push(Row {
            elements,
            explicit_time,
            rkn43: pair[0].cost()?.clone(),
            radau: pair[1].cost()?.clone(),
        });
    }
    write(bench, &rows)?;
    Ok(section(&rows))
}

/// Runs of about the same work. Stability fixes the steps of rkn43, and a short run tells how long
/// they are.
fn explicit_runs(bench: &Bench, scene: &Value) -> Result<Vec<Run>> {
    let run = |elements: u32, stop_time: f64| {
        let run = Run::new(scene, stop_time, stop_time).elements(elements);
        run.tolerance(TOLERANCE).integrator("rkn43")
    };
    let short = |elements: u32| 1.1 * (10.0 / f64::from(elements)).powi(2);
    let pilots: Vec<Run> = MESHES.iter().map(|&n| run(n, short(n))).collect();
    let outcomes = bench.run("cost, pilot", &pilots)?;
    let mut runs = Vec::new();
    for (&elements, outcome) in MESHES.iter().zip(&outcomes) {
        let step = short(elements) / outcome.cost()?.steps;
        runs.push(run(elements, step * WORK / f64::from(elements)));
    }
    Ok(runs)
}

type Quantity = (&'static str, fn(&Row) -> f64);

const QUANTITIES: [Quantity; 3] = [
    ("rkn43, a step", |row| row.rkn43.per_step()),
    ("radau, a step", |row| row.radau.per_step()),
    ("radau, a Newton iteration", |row| row.radau.per_iteration()),
];

fn write(bench: &Bench, rows: &[Row]) -> Result<()> {
    let header = [
        "elements",
        "rkn43_steps",
        "rkn43_rejected",
        "rkn43_step_s",
        "radau_steps",
        "radau_rejected",
        "radau_newton_iterations",
        "radau_step_s",
        "radau_iteration_s",
    ];
    let cells = |row: &Row| {
        vec![
            row.elements.to_string(),
            row.rkn43.steps.to_string(),
            row.rkn43.rejected.to_string(),
            format!("{:.3e}", row.rkn43.per_step()),
            row.radau.steps.to_string(),
            row.radau.rejected.to_string(),
            row.radau.newton_iterations.to_string(),
            format!("{:.3e}", row.radau.per_step()),
            format!("{:.3e}", row.radau.per_iteration()),
        ]
    };
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    page::write_csv(&bench.output("cost.csv"), &header, &cells)?;
    let marks = [Mark::Dot, Mark::Triangle, Mark::Ring];
    let lines = |scaled: fn(f64, u32) -> f64| -> Vec<Line> {
        let line = |(index, (name, quantity)): (usize, &Quantity)| {
            let point = |row: &Row| (f64::from(row.elements), scaled(quantity(row), row.elements));
            let points = rows.iter().map(point).collect();
            Line::new(name, points, index, marks[index])
        };
        QUANTITIES.iter().enumerate().map(line).collect()
    };
    let mut whole = lines(|seconds, _| 1e6 * seconds);
    whole.push(Line::guide("proportional", (10.0, 1.0), 1000.0, 1.0));
    let panels = [
        Panel {
            title: "CPU time".into(),
            x: Axis::counts("elements", &MESHES),
            y: Axis::log("CPU time / µs"),
            lines: whole,
        },
        Panel {
            title: "CPU time per element".into(),
            x: Axis::counts("elements", &MESHES),
            y: Axis::log("CPU time per element / ns"),
            lines: lines(|seconds, elements| 1e9 * seconds / f64::from(elements)),
        },
    ];
    draw(&bench.output("cost.svg"), &panels)
}

fn section(rows: &[Row]) -> String {
    let header = [
        "elements",
        "rkn43: µs a step",
        "ns a step and element",
        "radau: µs a step",
        "ns a step and element",
        "iterations a step",
        "µs an iteration",
        "ns an iteration and element",
    ];
    let cells = |row: &Row| {
        let n = f64::from(row.elements);
        let (rkn43, radau) = (row.rkn43.per_step(), row.radau.per_step());
        let iteration = row.radau.per_iteration();
        vec![
            row.elements.to_string(),
            three_digits(1e6 * rkn43),
            three_digits(1e9 * rkn43 / n),
            three_digits(1e6 * radau),
            three_digits(1e9 * radau / n),
            format!("{:.1}", row.radau.newton_iterations / row.radau.steps),
            three_digits(1e6 * iteration),
            three_digits(1e9 * iteration / n),
        ]
    };
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let summary = |(name, quantity): &Quantity| {
        let at = |elements: u32| {
            let row = rows.iter().find(|row| row.elements == elements);
            row.map_or(f64::NAN, quantity)
        };
        let points: Vec<(f64, f64)> = rows
            .iter()
            .map(|row| (f64::from(row.elements), quantity(row)))
            .collect();
        let slope = fitted_slope(&points).unwrap_or(f64::NAN);
        let ratio = at(1000) / at(100);
        format!("{name}: 1000 elements cost {ratio:.1} times what 100 cost, slope {slope:.2}")
    };
    let summaries: Vec<String> = QUANTITIES.iter().map(summary).collect();
    format!(
        "\
## cost: CPU time of a step against the number of elements

![Cost of a step](cost.svg)

The soft pendulum at tolerance {TOLERANCE:e}; CPU time of all steps over the number of accepted ones, rejected ones paid for.
radau runs to {STOP_TIME} s; rkn43 until steps times elements are about {WORK:e}, since stability makes its steps shorter on finer meshes.

{}
**What it means.** The cost of a step grows in proportion to the mesh (target: less than 12 times from 100 to 1000 elements). {}. \
The cost of a whole run with rkn43 grows faster, since finer meshes also force shorter steps: {} steps for a second with 10 elements, {} with 1000. radau's steps follow the motion, not the mesh.
",
        page::table(&header, &cells),
        summaries.join("; "),
        steps_a_second(rows, 10),
        steps_a_second(rows, 1000),
    )
}

/// Steps of rkn43 for a second of simulated time.
fn steps_a_second(rows: &[Row], elements: u32) -> String {
    let row = rows.iter().find(|row| row.elements == elements);
    row.map_or("–".to_owned(), |row| {
        format!("{:.0}", row.rkn43.steps / row.explicit_time)
    })
}
