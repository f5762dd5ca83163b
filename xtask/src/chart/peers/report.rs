//! Pictures, tables and sentences of the chart.

use anyhow::Result;
use serde_json::Value;

use super::{Measured, Point, ROUNDS};
use crate::chart::bench::Bench;
use crate::chart::numbers::{milliseconds, needed_for, short, three_digits};
use crate::chart::page;
use crate::chart::plot::{Axis, Line, Mark, Panel, draw};

const LEVELS: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
/// Panels of a picture.
const PANELS: usize = 3;

/// Writes the CSV file and the pictures.
pub fn write(bench: &Bench, measured: &[Measured]) -> Result<()> {
    let header = [
        "scene",
        "program",
        "settings",
        "elements",
        "error",
        "cpu_time_s",
    ];
    let mut rows = Vec::new();
    for case in measured {
        for (program, points) in [("Exudyn", &case.exudyn), ("Flexbody", &case.product)] {
            rows.extend(points.iter().map(|point| {
                vec![
                    case.case.name.to_owned(),
                    program.to_owned(),
                    point.what.clone(),
                    point.elements.to_string(),
                    format!("{:.3e}", point.error),
                    format!("{:.3e}", point.cpu_time),
                ]
            }));
        }
    }
    page::write_csv(&bench.output("peers.csv"), &header, &rows)?;
    for (index, part) in measured.chunks(PANELS).enumerate() {
        let panels: Vec<Panel> = part.iter().map(panel).collect();
        draw(&bench.output(&picture(index)), &panels)?;
    }
    Ok(())
}

fn picture(index: usize) -> String {
    match index {
        0 => "peers.svg".to_owned(),
        _ => format!("peers_{}.svg", index + 1),
    }
}

fn panel(case: &Measured) -> Panel {
    // Coarser than this is no answer, and would squeeze the rest.
    let xy = |points: &[Point]| -> Vec<(f64, f64)> {
        let shown = points.iter().filter(|point| point.error < 0.1);
        shown.map(|p| (1e3 * p.cpu_time, p.error)).collect()
    };
    let best = |points: &[Point]| xy(&frontier(points));
    let mut lines = vec![Line::new("Exudyn", best(&own(case)), 1, Mark::Triangle)];
    if is_helped(case) {
        let name = "Exudyn, explicit with heavy nodes for pins";
        lines.push(Line::new(name, best(&case.exudyn), 4, Mark::Square));
    }
    let others = Line::new(
        "Flexbody, all meshes and tolerances",
        xy(&case.product),
        5,
        Mark::Cross,
    );
    lines.push(others.scattered());
    lines.push(Line::new(
        "Flexbody, the best of them",
        best(&case.product),
        0,
        Mark::Dot,
    ));
    Panel {
        title: case.case.title.to_owned(),
        x: Axis::log("CPU time / ms"),
        y: Axis::log("largest error / length"),
        lines,
    }
}

/// The points of Exudyn with its own joints.
fn own(case: &Measured) -> Vec<Point> {
    let own = case.exudyn.iter().filter(|point| !point.is_helped);
    own.cloned().collect()
}

fn is_helped(case: &Measured) -> bool {
    case.exudyn.iter().any(|point| point.is_helped)
}

/// The section of the page.
pub fn section(measured: &[Measured]) -> String {
    let pictures: Vec<String> = (0..measured.len().div_ceil(PANELS))
        .map(|index| {
            format!(
                "![Exudyn and Flexbody: error against CPU time]({})",
                picture(index)
            )
        })
        .collect();
    format!(
        "\
## peers: Exudyn and Flexbody

{}

Exudyn 1.13.6 (its build without range checks, `ANCFCable2D`) and Flexbody (`auto`) on the same scenes, read from the same files: the same strains, loads, joints and initial state, no damping. Lower left is better.
CPU time is that of the steps alone in one thread, without set-up and files, Exudyn in a warm process, medians of {ROUNDS} rounds that take turns. The error is the largest distance of a marker from the reference over equally spaced points, divided by the length.

{}
The last column is how far the finest run of Flexbody is from the reference, divided by the length: errors near it are not resolved. Exudyn's finest runs are made by `lab/exudyn/references.py`.

CPU time in ms for an error: Exudyn / Flexbody = how many times less. Times between points are read off the straight line between them on logarithmic axes; – where no point is as good.

{}
{}
Each point of Exudyn has the settings that a sweep found best (`lab/exudyn/sweep.py`, {} runs: generalized-alpha and index-2 Newmark with full and modified Newton, tolerances, spectral radii, dense and sparse solver, three quadratures; velocity Verlet and RK4 from their stability limit on). At 1e-3 the best are:

{}
Exudyn's explicit solvers divide by the inertia without the joint, which makes pins wrong. *Heavy nodes* is a way round that we found for it: a node of 1e9 kg instead of the pin. The joints of slider-crank and spin-up they do not take.
",
        pictures.join("\n\n"),
        scenes(measured),
        times(measured),
        meaning(measured),
        measured.iter().map(|case| case.setting.sweep_runs).sum::<u64>(),
        best_settings(measured),
    )
}

/// Where each scene is, and how its error is measured.
fn scenes(measured: &[Measured]) -> String {
    let row = |case: &Measured| {
        let setting = &case.setting;
        vec![
            case.case.title.to_owned(),
            format!("`{}`", setting.path),
            format!("`{}`", setting.marker),
            format!("{}", setting.stop_time),
            format!("{}", setting.every),
            format!("{}", setting.length),
            setting.source.clone(),
            short(case.uncertainty),
        ]
    };
    let rows: Vec<Vec<String>> = measured.iter().map(row).collect();
    let header = [
        "scene",
        "file",
        "marker",
        "until, s",
        "points every, s",
        "length, m",
        "reference",
        "confirmed to",
    ];
    page::table(&header, &rows)
}

/// CPU times for errors.
fn times(measured: &[Measured]) -> String {
    let levels: Vec<String> = LEVELS.iter().map(|level| format!("{level:.0e}")).collect();
    let levels: Vec<&str> = levels.iter().map(String::as_str).collect();
    let cell = |peer: &[Point], product: &[Point], level: f64| {
        let time = |points| needed(points, level).map_or("–".to_owned(), milliseconds);
        let ratio = ratio(peer, product, level);
        let ratio = ratio.map_or(String::new(), |r| format!(" = **{}**", three_digits(r)));
        format!("{} / {}{ratio}", time(peer), time(product))
    };
    let row = |name: String, peer: &[Point], product: &[Point]| -> Vec<String> {
        let cells = LEVELS.iter().map(|level| cell(peer, product, *level));
        [name].into_iter().chain(cells).collect()
    };
    let mut rows = Vec::new();
    for case in measured {
        let title = case.case.title;
        rows.push(row(title.to_owned(), &own(case), &case.product));
        if is_helped(case) {
            rows.push(row(
                format!("{title}, heavy nodes"),
                &case.exudyn,
                &case.product,
            ));
        }
    }
    page::table(&[&["scene"], levels.as_slice()].concat(), &rows)
}

/// How many times less CPU time the product takes for an error.
fn ratio(peer: &[Point], product: &[Point], error: f64) -> Option<f64> {
    Some(needed(peer, error)? / needed(product, error)?)
}

fn best_settings(measured: &[Measured]) -> String {
    let best = |points: &[Point]| {
        let found = frontier(points)
            .into_iter()
            .find(|point| point.error <= 1e-3);
        found.map_or("–".to_owned(), |p| {
            format!("{} elements; {}", p.elements, p.what)
        })
    };
    let mut rows = Vec::new();
    for case in measured {
        let title = case.case.title;
        rows.push(vec![
            title.to_owned(),
            best(&own(case)),
            best(&case.product),
        ]);
        if is_helped(case) {
            rows.push(vec![
                format!("{title}, heavy nodes"),
                best(&case.exudyn),
                String::new(),
            ]);
        }
    }
    page::table(&["scene", "Exudyn", "Flexbody"], &rows)
}

/// What the ratios say, against what is wanted.
fn meaning(measured: &[Measured]) -> String {
    let mut wanted = Vec::new();
    let mut ratios = Vec::new();
    for case in measured {
        let title = case.case.title;
        for (level, target) in case.case.wanted {
            let said = |peer: &[Point]| {
                ratio(peer, &case.product, *level).map_or(
                    "not reached by both".to_owned(),
                    |ratio| {
                        let verdict = if ratio >= *target { "met" } else { "missed" };
                        format!("{}, {verdict}", three_digits(ratio))
                    },
                )
            };
            let helped = match is_helped(case) {
                true => format!(" (with heavy nodes {})", said(&case.exudyn)),
                false => String::new(),
            };
            wanted.push(format!(
                "{title} at {level:.0e} {target}: {}{helped}",
                said(&own(case))
            ));
        }
        let all = LEVELS
            .iter()
            .filter_map(|level| Some((ratio(&case.exudyn, &case.product, *level)?, *level, title)));
        ratios.extend(all);
    }
    ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (Some(worst), Some(best)) = (ratios.first(), ratios.last()) else {
        return String::new();
    };
    let lost = ratios.iter().filter(|(ratio, ..)| *ratio < 1.0).count();
    let said = |(ratio, level, title): &(f64, f64, &str)| {
        format!("{} ({title} at {level:.0e})", three_digits(*ratio))
    };
    format!(
        "**What it means.** Exudyn at its very best, heavy nodes included, takes between {} and {} times the CPU time of Flexbody for the same error; it is the faster in {lost} of the {} places where both arrive. Wanted, times less: {}.\n",
        said(worst),
        said(best),
        ratios.len(),
        wanted.join("; "),
    )
}

/// The points that none of the others beats in both error and CPU time, from loose to tight.
fn frontier(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.cpu_time.total_cmp(&b.cpu_time));
    let mut best: Vec<Point> = Vec::new();
    for point in sorted {
        if best.last().is_none_or(|last| point.error < last.error) {
            best.push(point);
        }
    }
    best
}

/// CPU time for an error, s.
fn needed(points: &[Point], error: f64) -> Option<f64> {
    let points = frontier(points).into_iter().map(|p| (p.cpu_time, p.error));
    needed_for(&points.collect::<Vec<_>>(), error)
}

/// Settings of Exudyn in words; what is not said is its default.
pub fn described(options: &Value) -> String {
    let own = |key: &&String| {
        !["elements", "error", "cpu_time", "heavy", "step", "solver"].contains(&key.as_str())
    };
    let object = options.as_object().into_iter().flatten();
    let rest: Vec<String> = object
        .filter(|(key, _)| own(key))
        .map(|(key, value)| format!("{key} {}", value.to_string().trim_matches('"')))
        .collect();
    let solver = options["solver"].as_str().unwrap_or_default();
    let step = options["step"].as_f64().unwrap_or(f64::NAN);
    let all = [vec![solver.to_owned(), format!("step {step:.2e}")], rest].concat();
    all.join("; ")
}
