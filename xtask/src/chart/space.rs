//! Discretizations of a rod: error against the number of coordinates and against CPU time.

use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::Value;

use crate::table::Table;

use super::bench::Bench;
use super::numbers::{distance, median, needed_for, short, slope, three_digits};
use super::page;
use super::plot::{Axis, Line, Mark, Panel, draw};

/// Names of the lab, names in the chart, colours and marks.
type Kind = (&'static str, &'static str, usize, Mark);
const KINDS: [Kind; 8] = [
    ("cubic", "cubic", 0, Mark::Dot),
    ("cubic_graded", "cubic, graded 2:1", 0, Mark::Ring),
    ("cubic_mass", "cubic, mass of order 8", 1, Mark::Triangle),
    (
        "cubic_mass_bending",
        "the same, bending at 3",
        1,
        Mark::Square,
    ),
    ("quintic", "quintic", 2, Mark::Dot),
    ("quintic_mass", "quintic, extra mass", 2, Mark::Ring),
    ("spline3", "cubic spline", 3, Mark::Cross),
    ("spline4", "quartic spline, extra mass", 6, Mark::Cross),
];
const STILL: [u32; 5] = [2, 4, 8, 16, 32];
const SLENDER: [&str; 4] = ["100", "10000", "1e+06", "1e+08"];
/// Mesh of the table of locking.
const COARSE: usize = 2;
const GOALS: [(f64, &str); 4] = [
    (1e-2, "1e-2"),
    (1e-3, "1e-3"),
    (1e-4, "1e-4"),
    (1e-5, "1e-5"),
];
/// Rounds over all runs.
const ROUNDS: usize = 3;
/// A rod that moves: case, meshes, end and interval of the time it is compared over, s, and length, m.
struct Moving {
    title: &'static str,
    scene: &'static str,
    meshes: [u32; 6],
    stop_time: &'static str,
    every: &'static str,
    length: f64,
}

const PENDULUM: Moving = Moving {
    title: "Soft pendulum",
    scene: "soft_pendulum/scene.json",
    meshes: [10, 20, 40, 60, 80, 120],
    stop_time: "1.1",
    every: "0.01",
    length: 1.2,
};
const SPAGHETTI: Moving = Moving {
    title: "Flying spaghetti",
    scene: "flying_spaghetti/triangular.json",
    meshes: [4, 6, 8, 12, 16, 32],
    stop_time: "10",
    every: "0.1",
    length: 10.0,
};
/// Two fine meshes for a reference, coarser than their own lines end.
const FINE: [(&str, u32); 2] = [("quintic", 24), ("spline4", 48)];

/// One mesh of a line.
#[derive(Clone)]
struct Point {
    elements: u32,
    coordinates: f64,
    error: f64,
    cpu_time: f64,
    frequency: f64,
    iteration: f64,
}

type Path = Vec<[f64; 2]>;

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let still = elastica(bench)?;
    let reference = pendulum_reference(bench)?;
    let pendulum = moving(bench, &PENDULUM, &reference)?;
    let fine: Vec<Path> = FINE
        .iter()
        .map(|&(kind, elements)| Ok(path(&run(bench, &SPAGHETTI, kind, elements)?)?.0))
        .collect::<Result<_>>()?;
    let apart = largest(&fine[0], &fine[1]) / SPAGHETTI.length;
    let spaghetti = moving(bench, &SPAGHETTI, &fine[0])?;
    write(bench, &still[2], &pendulum, &spaghetti)?;
    Ok(section(&still, &pendulum, &spaghetti, apart))
}

/// Tip under `F L^2 / EI = 5`, by slenderness, kind and mesh.
fn elastica(bench: &Bench) -> Result<Vec<Vec<Vec<Point>>>> {
    let scene = bench.case_json("elastica/scene.json")?;
    let case = bench.case_json("elastica/case.json")?;
    let claims = case["claims"].as_array().context("expected claims")?;
    let family = |ratio: &&str| {
        let note = format!("EA L^2/EI = {ratio}");
        let wanted = |claim: &&Value| claim["kind"] == "values" && claim["note"] == *note;
        let claim = claims.iter().find(wanted);
        let claim = claim.with_context(|| format!("elastica/case.json: expected {note:?}"))?;
        let mut scene = scene.clone();
        scene["bodies"][0]["section"]["area"] = claim["set"]["rod.area"].clone();
        let force = claim["set"]["rod.tip.force[2]"].to_string();
        let exact = ["rod.tip.position[1]", "rod.tip.position[2]"]
            .map(|name| claim["values"][name].as_f64().unwrap_or(f64::NAN));
        let point = |kind: &str, elements: u32| {
            let count = elements.to_string();
            let options = [
                "bend",
                "--element",
                kind,
                "--elements",
                &count,
                "--force",
                &force,
            ];
            let report = bench.lab(&options, &scene)?;
            Ok(Point {
                elements,
                coordinates: number(&report["coordinates"])?,
                error: distance([number(&report["x"])?, number(&report["y"])?], exact),
                cpu_time: f64::NAN,
                frequency: f64::NAN,
                iteration: f64::NAN,
            })
        };
        let line = |kind: &Kind| STILL.iter().map(|&n| point(kind.0, n)).collect();
        KINDS.iter().map(line).collect::<Result<_>>()
    };
    SLENDER.iter().map(family).collect()
}

fn number(value: &Value) -> Result<f64> {
    value
        .as_f64()
        .with_context(|| format!("the lab: expected a number, found {value}"))
}

fn pendulum_reference(bench: &Bench) -> Result<Path> {
    let table = Table::read(&bench.case_file("soft_pendulum/reference.csv"))?;
    let (x, y) = (table.column("x_tip")?, table.column("y_tip")?);
    Ok(x.into_iter().zip(y).map(|(x, y)| [x, y]).collect())
}

fn run(bench: &Bench, moving: &Moving, kind: &str, elements: u32) -> Result<Value> {
    let scene = bench.case_json(moving.scene)?;
    let count = elements.to_string();
    let mut options = vec!["space", "--element", kind, "--elements", &count];
    options.extend(["--stop-time", moving.stop_time, "--every", moving.every]);
    bench.lab(&options, &scene)
}

/// Path of the end and CPU time of the steps.
fn path(report: &Value) -> Result<(Path, f64)> {
    let rows = report["path"].as_array().context("expected a path")?;
    let row = |row: &Value| Ok([number(&row[1])?, number(&row[2])?]);
    let path = rows.iter().map(row).collect::<Result<_>>()?;
    Ok((path, number(&report["cpu_time"])?))
}

fn largest(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    assert_eq!(a.len(), b.len(), "points in time");
    super::numbers::largest_distance(a, b)
}

/// All kinds on all meshes, by turns; CPU times are medians.
fn moving(bench: &Bench, moving: &Moving, reference: &Path) -> Result<Vec<Vec<Point>>> {
    let runs = KINDS.len() * moving.meshes.len() * ROUNDS;
    let style = ProgressStyle::with_template("{msg} {bar:40} {pos}/{len} runs  {elapsed}")?;
    let bar = ProgressBar::new(runs as u64)
        .with_style(style)
        .with_message(moving.title);
    let mut lines = vec![Vec::new(); KINDS.len()];
    let mut times = vec![vec![Vec::new(); moving.meshes.len()]; KINDS.len()];
    for round in 0..ROUNDS {
        for (k, kind) in KINDS.iter().enumerate() {
            for (m, &elements) in moving.meshes.iter().enumerate() {
                let report = run(bench, moving, kind.0, elements)?;
                let (path, cpu_time) = path(&report)?;
                times[k][m].push((cpu_time, number(&report["iteration_time"])?));
                if round == 0 {
                    lines[k].push(Point {
                        elements,
                        coordinates: number(&report["coordinates"])?,
                        error: largest(&path, reference) / moving.length,
                        cpu_time,
                        frequency: number(&report["largest_frequency"])?,
                        iteration: number(&report["iteration_time"])?,
                    });
                }
                bar.inc(1);
            }
        }
    }
    bar.finish_and_clear();
    for (line, times) in lines.iter_mut().zip(&times) {
        for (point, times) in line.iter_mut().zip(times) {
            let (steps, iterations): (Vec<f64>, Vec<f64>) = times.iter().copied().unzip();
            point.cpu_time = median(&steps);
            point.iteration = median(&iterations);
        }
    }
    Ok(lines)
}

fn write(
    bench: &Bench,
    still: &[Vec<Point>],
    pendulum: &[Vec<Point>],
    spaghetti: &[Vec<Point>],
) -> Result<()> {
    let scenes = [
        ("elastica", still),
        ("soft pendulum", pendulum),
        ("flying spaghetti", spaghetti),
    ];
    let mut rows = Vec::new();
    for (scene, lines) in scenes {
        for (kind, line) in KINDS.iter().zip(lines) {
            for point in line {
                let timed = |value: f64| match value.is_nan() {
                    true => String::new(),
                    false => format!("{value:.4e}"),
                };
                rows.push(vec![
                    scene.to_owned(),
                    kind.0.to_owned(),
                    point.elements.to_string(),
                    point.coordinates.to_string(),
                    format!("{:.4e}", point.error),
                    timed(point.cpu_time),
                    timed(point.frequency),
                    timed(point.iteration),
                ]);
            }
        }
    }
    let header = [
        "scene",
        "discretization",
        "elements",
        "coordinates",
        "error",
        "cpu_time",
        "largest_frequency",
        "iteration_time",
    ];
    page::write_csv(&bench.output("space.csv"), &header, &rows)?;
    let count = |point: &Point| point.coordinates;
    let time = |point: &Point| 1e3 * point.cpu_time;
    let panel = |title: &str, label, lines: &[Vec<Point>], x: fn(&Point) -> f64| Panel {
        title: title.into(),
        x: Axis::log(label),
        y: Axis::log("error / L").floor(1e-13),
        lines: drawn(lines, x),
    };
    let counts = [
        panel("Elastica, EA L²/EI = 1e6", "coordinates", still, count),
        panel("Soft pendulum", "coordinates", pendulum, count),
        panel("Flying spaghetti", "coordinates", spaghetti, count),
    ];
    draw(&bench.output("space.svg"), &counts)?;
    let times = [
        panel("Soft pendulum", "CPU time / ms", pendulum, time),
        panel("Flying spaghetti", "CPU time / ms", spaghetti, time),
    ];
    draw(&bench.output("space_time.svg"), &times)
}

fn drawn(lines: &[Vec<Point>], x: fn(&Point) -> f64) -> Vec<Line> {
    let line = |(kind, line): (&Kind, &Vec<Point>)| {
        let points = line.iter().map(|point| (x(point), point.error)).collect();
        Line::new(kind.1, points, kind.2, kind.3)
    };
    KINDS.iter().zip(lines).map(line).collect()
}

/// What is needed for an error, by kind; the least in bold.
fn goals(lines: &[Vec<Point>], scale: f64, cost: fn(&Point) -> f64) -> Vec<Vec<String>> {
    let needed = |line: &Vec<Point>, goal: f64| {
        let points: Vec<(f64, f64)> = line.iter().map(|p| (scale * cost(p), p.error)).collect();
        needed_for(&points, goal)
    };
    let best = |goal: f64| {
        let all = lines.iter().filter_map(|line| needed(line, goal));
        all.min_by(f64::total_cmp)
    };
    let cell = |line: &Vec<Point>, goal: f64| match (needed(line, goal), best(goal)) {
        (Some(value), Some(best)) if value <= best => format!("**{}**", three_digits(value)),
        (Some(value), _) => three_digits(value),
        (None, _) => "–".to_owned(),
    };
    let row = |line: &Vec<Point>| GOALS.iter().map(|goal| cell(line, goal.0)).collect();
    lines.iter().map(row).collect()
}

fn goal_table(pendulum: Vec<Vec<String>>, spaghetti: Vec<Vec<String>>) -> String {
    let mut header = vec!["discretization".to_owned()];
    for scene in ["pendulum", "spaghetti"] {
        header.extend(GOALS.iter().map(|goal| format!("{scene}, {}", goal.1)));
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let cells = pendulum.into_iter().zip(spaghetti);
    let row = |(kind, (left, right)): (&Kind, (Vec<String>, Vec<String>))| {
        let name = std::iter::once(kind.1.to_owned());
        name.chain(left).chain(right).collect()
    };
    page::table(
        &header,
        &KINDS.iter().zip(cells).map(row).collect::<Vec<_>>(),
    )
}

fn section(
    still: &[Vec<Vec<Point>>],
    pendulum: &[Vec<Point>],
    spaghetti: &[Vec<Point>],
    apart: f64,
) -> String {
    let times = |lines| goals(lines, 1e3, |point| point.cpu_time);
    let iterations = |lines| goals(lines, 1e6, |point| point.iteration);
    format!(
        "\
## space: shape functions, meshes, quadratures and masses

![Error against the number of coordinates](space.svg)

![Error against CPU time](space_time.svg)

One strain energy, `1/2 int EA (|r'| - 1)^2 + EI theta'^2`, discretized in eight ways by one program (`lab space`, `lab/src/elements`), apart from the product's. Motion by the explicit method of Nyström (order 4, three accelerations a step) at 0.9 of the largest stable step, CPU times are medians of {ROUNDS} runs that take turns; the errors are those of space and time together.
Soft pendulum: largest distance of the tip from the independent solution of its case, every 0.01 s, over L. Flying spaghetti (triangular loads): the same every 0.1 s from {} quintic elements, {} L from {} quartic splines. Elastica: distance of the tip under `F L²/EI = 5` from the elliptic integrals.
`cubic` has position and slope at the nodes, the consistent mass, axial strain at three points (of Lobatto where slender, docs/decisions/0003-quadrature.md), bending at two Gauss points; `graded` has elements half as long at the end as at the start. The *mass of order 8* counts the quadratic and the cubic part of the velocity in an element 2 and 26/3 times, with which bending waves are exact to the order 8 instead of 4, and takes wider axial points (0.5 ± 0.465); with three bending points it is the product's cable (docs/decisions/0012-mass-against-dispersion.md). `quintic` has position, slope and rate of slope at the nodes, Gauss 4 and 4; its extra mass counts the quartic part twice, the quintic nine times. Splines have continuous curvature, at 2 and 2, 3 and 3 Gauss points.

CPU time in ms for an error of

{}
For implicit methods, whose steps follow the motion and not the mesh: µs of one iteration (tangent, banded factor, solve; none of it tuned) on the mesh that has the error

{}
On a mesh of {} elements of the pendulum, and locking: error of the elastica with {} elements by EA L²/EI

{}{}",
        FINE[0].1,
        short(apart),
        FINE[1].1,
        goal_table(times(pendulum), times(spaghetti)),
        goal_table(iterations(pendulum), iterations(spaghetti)),
        PENDULUM.meshes[2],
        STILL[COARSE],
        mesh_table(still, pendulum),
        meaning(still, pendulum, spaghetti),
    )
}

fn mesh_table(still: &[Vec<Vec<Point>>], pendulum: &[Vec<Point>]) -> String {
    let mut header = vec![
        "discretization",
        "coordinates",
        "largest frequency / rad/s",
        "error",
    ];
    header.extend(["1e2", "1e4", "1e6", "1e8", "order, 4 to 8 (1e4)"]);
    let row = |(k, kind): (usize, &Kind)| {
        let point = &pendulum[k][2];
        let mut row = vec![
            kind.1.to_owned(),
            point.coordinates.to_string(),
            format!("{:.0}", point.frequency),
            short(point.error),
        ];
        row.extend(still.iter().map(|lines| short(lines[k][COARSE].error)));
        let at = |mesh: usize| {
            let point = &still[1][k][mesh];
            (1.0 / f64::from(point.elements), point.error)
        };
        row.push(format!("{:.1}", slope(at(COARSE - 1), at(COARSE))));
        row
    };
    page::table(
        &header,
        &KINDS.iter().enumerate().map(row).collect::<Vec<_>>(),
    )
}

fn meaning(still: &[Vec<Vec<Point>>], pendulum: &[Vec<Point>], spaghetti: &[Vec<Point>]) -> String {
    let index = |name: &str| KINDS.iter().position(|kind| kind.0 == name).unwrap_or(0);
    let times = |lines: &[Vec<Point>], name: &str| -> Vec<(f64, f64)> {
        let line = &lines[index(name)];
        line.iter()
            .map(|point| (point.cpu_time, point.error))
            .collect()
    };
    let gain = |lines: &[Vec<Point>], slow: &str, fast: &str| {
        let ratio = |goal: f64| {
            let slow = needed_for(&times(lines, slow), goal)?;
            Some(slow / needed_for(&times(lines, fast), goal)?)
        };
        let gains = GOALS
            .iter()
            .filter_map(|goal| Some(format!("{} at {}", three_digits(ratio(goal.0)?), goal.1)));
        gains.collect::<Vec<_>>().join(", ")
    };
    let frequency = |name: &str| pendulum[index(name)][2].frequency;
    let locking = |name: &str| short(still[3][index(name)][COARSE].error);
    format!(
        "\n**What it means.** The mass decides where waves run: that of order 8 costs nothing, lowers the largest frequency {} times, and with it takes less CPU time than the consistent mass by a factor of {} on the pendulum; with a third bending point, {} on the spaghetti, whose error is that of slow bending. \
         The quintic element pays on smooth motion at tight errors (with its extra mass, CPU time of the best cubic over its own on the spaghetti: {}) and not where a wave whips ({}). \
         Grading the mesh loses, since the smallest element sets the step ({} on the pendulum; below 1 is a loss). \
         The cubic spline has half the coordinates, but locks where the rod is slender: elastica at EA L²/EI = 1e8 {}, against {} of the cubic element; the quartic spline, {}, does not, and takes the time of the best cubic over {} on the pendulum. Its coordinates are no positions and slopes, though, where joints and loads act inside a body.\n",
        three_digits(frequency("cubic") / frequency("cubic_mass")),
        gain(pendulum, "cubic", "cubic_mass"),
        gain(spaghetti, "cubic", "cubic_mass_bending"),
        gain(spaghetti, "cubic_mass_bending", "quintic_mass"),
        gain(pendulum, "cubic_mass_bending", "quintic_mass"),
        gain(pendulum, "cubic", "cubic_graded"),
        locking("spline3"),
        locking("cubic"),
        locking("spline4"),
        gain(pendulum, "cubic_mass_bending", "spline4"),
    )
}
