//! What was measured, as CSV, pictures and text.

use anyhow::Result;

use super::super::bench::Bench;
use super::super::numbers::{milliseconds, short};
use super::super::page;
use super::super::plot::{Axis, Line, Mark, Panel, draw};
use super::{ERRORS, Measured};

/// Name in settings, name on the page, colour, mark; dashed where the step adapts.
const NAMES: [(&str, &str, usize, Mark); 24] = [
    ("product_auto", "auto (product)", 6, Mark::Dot),
    ("product_rk4", "RK4 (product)", 0, Mark::Ring),
    ("product_radau", "Radau IIA 5 (product)", 1, Mark::Ring),
    ("product_rkn43", "Nystrom 4(3) (product)", 0, Mark::Dot),
    ("product_verlet", "velocity Verlet (product)", 2, Mark::Ring),
    ("verlet", "velocity Verlet", 2, Mark::Triangle),
    (
        "verlet_adaptive",
        "velocity Verlet, adaptive",
        2,
        Mark::Cross,
    ),
    ("rkn43", "Nystrom 4(3)", 0, Mark::Triangle),
    ("rkn43_adaptive", "Nystrom 4(3), adaptive", 0, Mark::Cross),
    ("rkn64", "Nystrom 6(4)", 5, Mark::Triangle),
    ("rkn64_adaptive", "Nystrom 6(4), adaptive", 5, Mark::Cross),
    ("dopri5", "Dormand-Prince 5", 4, Mark::Triangle),
    (
        "dopri5_adaptive",
        "Dormand-Prince 5(4), adaptive",
        4,
        Mark::Cross,
    ),
    ("gauss6", "Gauss 6", 1, Mark::Square),
    ("alpha_1.0", "generalized-alpha 1.0", 2, Mark::Square),
    ("alpha_0.8", "generalized-alpha 0.8", 3, Mark::Square),
    ("alpha_0.6", "generalized-alpha 0.6", 4, Mark::Square),
    (
        "alpha_0.8_turned",
        "generalized-alpha 0.8, tangent turned along",
        6,
        Mark::Square,
    ),
    (
        "alpha_0.8_adaptive",
        "generalized-alpha 0.8, adaptive",
        3,
        Mark::Cross,
    ),
    (
        "alpha_0.6_adaptive",
        "generalized-alpha 0.6, adaptive",
        4,
        Mark::Dot,
    ),
    ("trapezoid", "trapezoidal rule", 0, Mark::Square),
    ("midpoint", "implicit midpoint", 5, Mark::Square),
    ("energy_momentum", "energy-momentum", 5, Mark::Dot),
    ("diffsol", "BDF (diffsol)", 3, Mark::Dot),
];

fn called(method: &str) -> &str {
    let found = NAMES.iter().find(|name| name.0 == method);
    found.map_or(method, |name| name.1)
}

/// Writes CSV and pictures.
pub fn write(bench: &Bench, measured: &[Measured]) -> Result<()> {
    let header = [
        "scene",
        "method",
        "step_s",
        "tolerance",
        "error_over_length",
        "cpu_time_s",
    ];
    let mut rows = Vec::new();
    for scene in measured {
        for point in &scene.points {
            let optional = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:e}"));
            rows.push(vec![
                scene.setting.name.clone(),
                point.plan.method.clone(),
                optional(point.plan.step),
                optional(point.plan.tolerance),
                format!("{:e}", point.error),
                format!("{:e}", point.outcome.cpu_time()),
            ]);
        }
    }
    page::write_csv(&bench.output("methods.csv"), &header, &rows)?;
    for (number, part) in measured.chunks(3).enumerate() {
        let panels: Vec<Panel> = part.iter().map(panel).collect();
        draw(
            &bench.output(&format!("methods_{}.svg", number + 1)),
            &panels,
        )?;
    }
    Ok(())
}

fn panel(scene: &Measured) -> Panel {
    let mut lines = Vec::new();
    for (method, name, colour, mark) in NAMES {
        let points = scene.of(method);
        if !points.is_empty() {
            let line = Line::new(name, points, colour, mark);
            let adapts = method.ends_with("_adaptive") || method == "diffsol";
            lines.push(if adapts { line.dashed() } else { line });
        }
    }
    Panel {
        title: scene.setting.title.clone(),
        x: Axis::log("CPU time, s"),
        y: Axis::log("error in time / length").floor(1e-9),
        lines,
    }
}

/// Text of the page.
pub fn section(measured: &[Measured]) -> String {
    let mut text = "## Integrators: error in time against CPU time\n\n".to_owned();
    for number in 1..=measured.len().div_ceil(3) {
        text += &format!("![Error in time against CPU time](methods_{number}.svg)\n");
    }
    text += "\nThe product's integrators (through `flexbody simulate`, tolerances) and those of the lab (fixed steps, \
             or tolerances where the method adapts) on meshes of 20 elements a cable. The error is the largest distance of any marker \
             that the scene reads from the reference on the same mesh, over all compared times, divided by the length: error in time alone. \
             Steps and tolerances of all points are in `lab/methods.json`, measurements in [methods.csv](methods.csv); times are medians \
             of 3 runs, but for runs beyond 0.4 s, which ran once. Cells: CPU time, ms, for an error, interpolated between points; \
             the least is bold.\n";
    for scene in measured {
        text += &of_scene(scene);
    }
    text += &summary(measured);
    text
}

fn of_scene(scene: &Measured) -> String {
    let setting = &scene.setting;
    let mut text = format!(
        "\n### {}\n\nTo {} s, compared every {} s. Reference: {} and {}, {} of the length apart.\n\n",
        setting.title,
        short(setting.stop_time),
        short(setting.every),
        described(scene, 0),
        described(scene, 1),
        short(scene.uncertainty)
    );
    let header = ["method", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6"];
    let mut rows = Vec::new();
    for (method, name, ..) in NAMES {
        if scene.of(method).is_empty() {
            continue;
        }
        let mut row = vec![name.to_owned()];
        for error in ERRORS {
            let best = scene.best(error).map(|best| best.0);
            row.push(match scene.needed(method, error) {
                Some(time) if best == Some(method) => format!("**{}**", milliseconds(time)),
                Some(time) => milliseconds(time),
                None => "-".to_owned(),
            });
        }
        rows.push(row);
    }
    let ratios = ERRORS.map(|error| ratio(scene, error).map_or("-".to_owned(), short));
    let mut row = vec!["*auto over the least*".to_owned()];
    row.extend(ratios);
    rows.push(row);
    text += &page::table(&header, &rows);
    let single: Vec<&str> = NAMES
        .iter()
        .filter(|name| scene.of(name.0).len() == 1)
        .map(|name| name.1)
        .collect();
    if !single.is_empty() {
        text += &format!(
            "\nOne point, at their limit of stability: {}.\n",
            single.join(", ")
        );
    }
    if !scene.failed.is_empty() {
        let words: Vec<String> = (scene.failed.iter())
            .map(|plan| {
                let numbers = [plan.step, plan.tolerance].into_iter().flatten();
                let numbers: Vec<String> = numbers.map(short).collect();
                format!("{} at {}", called(&plan.method), numbers.join(" s and "))
            })
            .collect();
        text += &format!("\nWithout a result: {}.\n", words.join(", "));
    }
    if !setting.left_out.is_empty() {
        let words: Vec<String> = (setting.left_out.iter())
            .map(|(method, reason)| format!("{} ({reason})", called(method)))
            .collect();
        text += &format!("\nLeft out: {}.\n", words.join(", "));
    }
    text
}

fn described(scene: &Measured, index: usize) -> String {
    let plan = &scene.setting.references[index];
    let mut words = called(&plan.method).to_owned();
    if let Some(step) = plan.step {
        words += &format!(" with steps of {} s", short(step));
    } else if let Some(tolerance) = plan.tolerance {
        words += &format!(" at {tolerance:e}");
    }
    words
}

/// How near `auto` should be to the least.
const GOAL: f64 = 1.3;

/// Time of `auto` over the least.
fn ratio(scene: &Measured, error: f64) -> Option<f64> {
    Some(scene.needed("product_auto", error)? / scene.best(error)?.1)
}

/// Which method is best where, and how far `auto` is from it.
fn summary(measured: &[Measured]) -> String {
    let header = ["scene", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6"];
    let mut rows = Vec::new();
    let mut worst: Option<(f64, &str, f64)> = None;
    for scene in measured {
        let mut row = vec![scene.setting.title.clone()];
        for error in ERRORS {
            let of_auto = ratio(scene, error);
            if let Some(ratio) = of_auto
                && worst.is_none_or(|worst| ratio > worst.0)
            {
                worst = Some((ratio, &scene.setting.title, error));
            }
            row.push(match (scene.best(error), of_auto) {
                (Some((method, _)), Some(ratio)) => format!("{}, {}", called(method), short(ratio)),
                (Some((method, _)), None) => called(method).to_owned(),
                (None, _) => "-".to_owned(),
            });
        }
        rows.push(row);
    }
    let mut text = format!(
        "\n### Which method is the least, and the time of `auto` over it\n\n{}",
        page::table(&header, &rows)
    );
    let all = ERRORS.iter().flat_map(|error| {
        let ratios = measured.iter().filter_map(|scene| ratio(scene, *error));
        ratios.collect::<Vec<f64>>()
    });
    let (near, far): (Vec<f64>, Vec<f64>) = all.partition(|ratio| *ratio <= GOAL);
    if let Some((ratio, title, error)) = worst {
        text += &format!(
            "\n**What it means.** Leave the integrator to `auto`: in {} of {} places it is within {GOAL} times the least of all methods, whose steps are fixed ones \
             chosen afterwards; at most it takes {} times the least ({}, error {error:e}).",
            near.len(),
            near.len() + far.len(),
            short(ratio),
            title.to_lowercase()
        );
    }
    let never: Vec<&str> = NAMES
        .iter()
        .filter(|name| measured.iter().any(|scene| !scene.of(name.0).is_empty()))
        .filter(|name| !wins(measured, name.0))
        .map(|name| name.1)
        .collect();
    text += &format!(" Never the least: {}.\n", never.join(", "));
    text
}

fn wins(measured: &[Measured], method: &str) -> bool {
    let is_best =
        |scene: &Measured, error: f64| scene.best(error).is_some_and(|best| best.0 == method);
    measured
        .iter()
        .any(|scene| ERRORS.iter().any(|error| is_best(scene, *error)))
}
