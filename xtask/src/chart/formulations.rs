//! Formulations of one chain of elements: what an acceleration costs, and error against CPU time.

use anyhow::{Context, Result};
use serde_json::Value;

use crate::table::Table;

use super::bench::Bench;
use super::numbers::{distance, median, needed_for, short, three_digits};
use super::page;
use super::plot::{Axis, Line, Mark, Panel, draw};

/// Names of the lab, names in the chart, colours and marks.
type Kind = (&'static str, &'static str, usize, Mark);
const KINDS: [Kind; 7] = [
    ("as_printed", "as printed, dense", 1, Mark::Cross),
    ("qr_dense", "QR weighted, dense", 4, Mark::Square),
    ("qr_applied", "QR weighted, by fronts", 2, Mark::Triangle),
    ("cholesky", "Cholesky coordinates", 0, Mark::Ring),
    ("product", "the product", 0, Mark::Dot),
    ("assembled", "assembled, M⁻¹", 3, Mark::Triangle),
    ("augmented", "augmented, multipliers", 6, Mark::Square),
];
const PRODUCT: usize = 4;
/// The exact formulation in which the forces are timed for the sentence on them.
const ASSEMBLED: usize = 5;
const SCENE: &str = "soft_pendulum/scene.json";
const LENGTH: f64 = 1.2;
const COUNTS: [u32; 8] = [5, 10, 20, 50, 100, 200, 500, 1000];
const MESHES: [u32; 5] = [5, 10, 20, 40, 80];
const GOALS: [(f64, &str); 3] = [(1e-1, "1e-1"), (1e-2, "1e-2"), (1e-3, "1e-3")];
/// Rounds over all measurements.
const ROUNDS: usize = 3;

/// One number of elements.
struct Cost {
    acceleration: f64,
    force: f64,
    set_up: f64,
    memory: f64,
}

/// One mesh of the pendulum.
struct Swing {
    cpu_time: f64,
    /// Over the length.
    error: f64,
    gap: f64,
    pin: f64,
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let scene = bench.case_json(SCENE)?;
    let costs = measured(&COUNTS, |kind, count| {
        bench.lab(
            &["accelerate", "--formulation", kind, "--elements", count],
            &scene,
        )
    })?;
    let costs = each(&costs, |reports| {
        Ok(Cost {
            acceleration: middle(reports, "acceleration")?,
            force: middle(reports, "force")?,
            set_up: middle(reports, "set_up")?,
            memory: middle(reports, "memory")?,
        })
    })?;
    let reference = Table::read(&bench.case_file("soft_pendulum/reference.csv"))?;
    let (x, y) = (reference.column("x_tip")?, reference.column("y_tip")?);
    let reference: Vec<[f64; 2]> = x.into_iter().zip(y).map(|(x, y)| [x, y]).collect();
    let swings = measured(&MESHES, |kind, count| {
        let mut options = vec!["swing", "--formulation", kind, "--elements", count];
        options.extend(["--stop-time", "1.1", "--every", "0.01"]);
        bench.lab(&options, &scene)
    })?;
    let swings = each(&swings, |reports| {
        Ok(Swing {
            cpu_time: middle(reports, "cpu_time")?,
            error: error(&reports[0], &reference)?,
            gap: middle(reports, "gap")?,
            pin: middle(reports, "pin")?,
        })
    })?;
    write(bench, &costs, &swings)?;
    Ok(section(&costs, &swings))
}

/// Reports by formulation, number and round; formulations take turns.
fn measured(
    counts: &[u32],
    report: impl Fn(&str, &str) -> Result<Value>,
) -> Result<Vec<Vec<Vec<Value>>>> {
    let mut reports: Vec<Vec<Vec<Value>>> = Vec::new();
    reports.resize_with(KINDS.len(), || vec![Vec::new(); counts.len()]);
    for _ in 0..ROUNDS {
        for (at, count) in counts.iter().enumerate() {
            for (kind, reports) in KINDS.iter().zip(&mut reports) {
                reports[at].push(report(kind.0, &count.to_string())?);
            }
        }
    }
    Ok(reports)
}

fn each<T>(
    reports: &[Vec<Vec<Value>>],
    read: impl Fn(&[Value]) -> Result<T>,
) -> Result<Vec<Vec<T>>> {
    let line = |line: &Vec<Vec<Value>>| line.iter().map(|reports| read(reports)).collect();
    reports.iter().map(line).collect()
}

fn middle(reports: &[Value], key: &str) -> Result<f64> {
    let numbers: Result<Vec<f64>> = reports.iter().map(|report| number(&report[key])).collect();
    Ok(median(&numbers?))
}

fn number(value: &Value) -> Result<f64> {
    value
        .as_f64()
        .with_context(|| format!("the lab: expected a number, found {value}"))
}

/// Largest distance of the tip from the reference, over the length; infinite where the path ends early.
fn error(report: &Value, reference: &[[f64; 2]]) -> Result<f64> {
    let path = report["path"].as_array().context("expected a path")?;
    if path.len() < reference.len() {
        return Ok(f64::INFINITY);
    }
    let mut largest = 0.0_f64;
    for (row, known) in path.iter().zip(reference) {
        largest = largest.max(distance([number(&row[1])?, number(&row[2])?], *known));
    }
    Ok(largest / LENGTH)
}

fn write(bench: &Bench, costs: &[Vec<Cost>], swings: &[Vec<Swing>]) -> Result<()> {
    let mut rows = Vec::new();
    for (kind, (costs, swings)) in KINDS.iter().zip(costs.iter().zip(swings)) {
        let row = |count: &u32, values: [f64; 4]| {
            let values = values.map(|value| format!("{value:.3e}"));
            ([kind.0.to_owned(), count.to_string()], values.to_vec())
        };
        let none = || vec![String::new(); 4];
        for (count, c) in COUNTS.iter().zip(costs) {
            let (name, values) = row(count, [c.acceleration, c.force, c.set_up, c.memory]);
            rows.push([&name[..], &values, &none()].concat());
        }
        for (count, s) in MESHES.iter().zip(swings) {
            let (name, values) = row(count, [s.cpu_time, s.error, s.gap, s.pin]);
            rows.push([&name[..], &none(), &values].concat());
        }
    }
    let header = [
        "formulation",
        "elements",
        "acceleration_s",
        "force_s",
        "set_up_s",
        "memory_B",
        "swing_s",
        "error",
        "gap_m",
        "pin_distance_m",
    ];
    page::write_csv(&bench.output("formulations.csv"), &header, &rows)?;
    let line = |kind: &Kind, points: Vec<(f64, f64)>| Line::new(kind.1, points, kind.2, kind.3);
    let cost = |(kind, costs): (&Kind, &Vec<Cost>)| {
        let points = COUNTS.iter().zip(costs);
        let points = points.map(|(count, c)| (f64::from(*count), 1e6 * c.acceleration));
        line(kind, points.collect())
    };
    let swing = |(kind, swings): (&Kind, &Vec<Swing>)| {
        let found = swings.iter().filter(|s| s.error.is_finite());
        line(kind, found.map(|s| (1e3 * s.cpu_time, s.error)).collect())
    };
    let panels = [
        Panel {
            title: "One acceleration".into(),
            x: Axis::counts("elements", &COUNTS),
            y: Axis::log("CPU time / µs"),
            lines: KINDS.iter().zip(costs).map(cost).collect(),
        },
        Panel {
            title: "Soft pendulum, 1.1 s, 5 to 80 elements".into(),
            x: Axis::log("CPU time / ms"),
            y: Axis::log("error of the tip / L"),
            lines: KINDS.iter().zip(swings).map(swing).collect(),
        },
    ];
    draw(&bench.output("formulations.svg"), &panels)
}

fn cost_table(costs: &[Vec<Cost>]) -> String {
    let mut header = vec!["formulation".to_owned()];
    header.extend(COUNTS.iter().map(|count| format!("{count} / µs")));
    header.extend([
        "set-up of 1000 / ms".to_owned(),
        "matrices of 1000 / MB".to_owned(),
    ]);
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let row = |(kind, costs): (&Kind, &Vec<Cost>)| {
        let mut row = vec![kind.1.to_owned()];
        row.extend(costs.iter().map(|c| three_digits(1e6 * c.acceleration)));
        let largest = &costs[costs.len() - 1];
        row.push(three_digits(1e3 * largest.set_up));
        row.push(three_digits(1e-6 * largest.memory));
        row
    };
    let rows: Vec<_> = KINDS.iter().zip(costs).map(row).collect();
    page::table(&header, &rows)
}

fn swing_table(swings: &[Vec<Swing>]) -> String {
    let mut header = vec!["formulation".to_owned()];
    header.extend(
        GOALS
            .iter()
            .map(|goal| format!("CPU time for {} / ms", goal.1)),
    );
    let last = MESHES[MESHES.len() - 1];
    for what in [
        "error",
        "largest gap / m",
        "largest distance from the pin / m",
    ] {
        header.push(format!("{what}, {last} elements"));
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let row = |(kind, swings): (&Kind, &Vec<Swing>)| {
        let points: Vec<_> = swings.iter().map(|s| (1e3 * s.cpu_time, s.error)).collect();
        let mut row = vec![kind.1.to_owned()];
        let needed = |goal: &(f64, &str)| needed_for(&points, goal.0);
        let shown = |time: Option<f64>| time.map_or("–".to_owned(), three_digits);
        row.extend(GOALS.iter().map(needed).map(shown));
        let finest = &swings[swings.len() - 1];
        row.push(match finest.error.is_finite() {
            true => short(finest.error),
            false => "lost".to_owned(),
        });
        row.extend([short(finest.gap), short(finest.pin)]);
        row
    };
    let rows: Vec<_> = KINDS.iter().zip(swings).map(row).collect();
    page::table(&header, &rows)
}

fn section(costs: &[Vec<Cost>], swings: &[Vec<Swing>]) -> String {
    let at = |count: u32| COUNTS.iter().position(|c| *c == count).unwrap_or(0);
    let times = |kind: usize, count: u32| {
        let (this, product) = (&costs[kind][at(count)], &costs[PRODUCT][at(count)]);
        three_digits(this.acceleration / product.acceleration)
    };
    let force = &costs[ASSEMBLED][at(100)];
    format!(
        "\
## formulations: coordinates and how accelerations follow from forces

![CPU time of an acceleration; error against CPU time](formulations.svg)

One chain of the product's cable elements, pinned at one end, under gravity, in seven forms that share the evaluation of forces (`lab accelerate`, `lab swing`, `lab/src/formulations`). In the plane mass and constraints are scalars times the identity, which all of them use. \
As printed is report Eqs. 23–34 with a dense Q2; weighted is `M = L Lᵀ`, `L⁻¹ Φᵀ = Q R`, `T = L⁻ᵀ Q2`, dense or applied as one front of at most 6 x 6 an interface. \
Dense matrices are written out from such fronts, so their set-up is not that of a dense QR. Cholesky coordinates and assembled are lean block-tridiagonal forms of this chain alone; augmented keeps connectivity and pin with multipliers (Schur complement), without projection. \
Left: median CPU time of one acceleration. Right: the soft pendulum by the classical method of Runge and Kutta with the same fixed steps in all forms (0.7 of the stable one), error against the independent solution of the case, every 0.01 s, over L. Medians of {ROUNDS} rounds in which the forms take turns.

{}
{}
**What it means.** With 10, 100 and 1000 elements an acceleration takes, relative to the product: dense {}, {} and {}; by fronts {}, {} and {}; lean Cholesky coordinates {}, {} and {}; assembled {}, {} and {}; augmented {}, {} and {}. \
With 100 elements the forces alone take {} of the {} µs of the assembled form: what is left to gain from coordinates is the rest. \
All exact forms have the same error on the same mesh, so the cheaper acceleration decides. As printed the pendulum falls apart: its largest gap is {} m, that of the augmented form {} m.
",
        cost_table(costs),
        swing_table(swings),
        times(1, 10),
        times(1, 100),
        times(1, 1000),
        times(2, 10),
        times(2, 100),
        times(2, 1000),
        times(3, 10),
        times(3, 100),
        times(3, 1000),
        times(ASSEMBLED, 10),
        times(ASSEMBLED, 100),
        times(ASSEMBLED, 1000),
        times(6, 10),
        times(6, 100),
        times(6, 1000),
        three_digits(1e6 * force.force),
        three_digits(1e6 * force.acceleration),
        short(swings[0].iter().map(|s| s.gap).fold(0.0, f64::max)),
        short(swings[6].iter().map(|s| s.gap).fold(0.0, f64::max)),
    )
}
