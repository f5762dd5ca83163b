//! Error in time against CPU time: soft, middling and steel pendulums, each method and the automatic
//! choice.

use anyhow::Result;
use serde_json::Value;

use super::bench::{Bench, Cost, Outcome, REPEATS, Run};
use super::numbers::{fitted_slope, largest_distance, milliseconds, needed_for, short};
use super::page;
use super::plot::{Axis, Line, Mark, Panel, draw};

const SCENE: &str = "soft_pendulum/scene.json";
const ELEMENTS: u32 = 20;
const STOP_TIME: f64 = 1.1;
const STEP: f64 = 0.1;
const TOLERANCES: [f64; 6] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
/// Tolerances of the references.
const REFERENCE_RADAU: f64 = 1e-9;
const REFERENCE_RK4: f64 = 1e-11;

/// A pendulum.
struct Pendulum {
    name: &'static str,
    /// Pa.
    modulus: f64,
    /// kg/m^3.
    density: f64,
    /// Tolerances for rk4: on steel stability makes all of them the same run of seconds.
    explicit: &'static [f64],
}

const PENDULUMS: [Pendulum; 3] = [
    Pendulum {
        name: "soft",
        modulus: 0.7e6,
        density: 5540.0,
        explicit: &TOLERANCES,
    },
    Pendulum {
        name: "middling",
        modulus: 0.7e9,
        density: 5540.0,
        explicit: &TOLERANCES,
    },
    Pendulum {
        name: "steel",
        modulus: 2.07e11,
        density: 7800.0,
        explicit: &[1e-4],
    },
];

/// One measured point.
struct Point {
    tolerance: f64,
    error: f64,
    cost: Cost,
}

/// All that was measured on a pendulum.
struct Measured {
    pendulum: &'static Pendulum,
    rk4: Vec<Point>,
    radau: Vec<Point>,
    auto: Vec<Point>,
    /// Distance between the references of both methods, m.
    uncertainty: f64,
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let scene = bench.case_json(SCENE)?;
    let mut measured = Vec::new();
    for pendulum in &PENDULUMS {
        measured.push(measure(bench, &scene, pendulum)?);
    }
    write(bench, &measured)?;
    Ok(section(&measured))
}

fn measure(bench: &Bench, scene: &Value, pendulum: &'static Pendulum) -> Result<Measured> {
    let run = |method: &str, tolerance: f64| {
        let run = Run::new(scene, STOP_TIME, STEP).elements(ELEMENTS);
        let run = run.set("rod.youngs_modulus", pendulum.modulus);
        let run = run.set("rod.density", pendulum.density);
        run.tolerance(tolerance).integrator(method)
    };
    let title = format!("time, {}", pendulum.name);
    let references = [run("radau", REFERENCE_RADAU), run("rk4", REFERENCE_RK4)];
    let references = bench.run(&format!("{title}, references"), &references)?;
    let (radau, rk4) = (tip(&references[0])?, tip(&references[1])?);
    let plan = |method: &'static str, tolerances: &[f64]| -> Vec<(&'static str, f64)> {
        tolerances.iter().map(|t| (method, *t)).collect()
    };
    let plan = [
        plan("rk4", pendulum.explicit),
        plan("radau", &TOLERANCES),
        plan("auto", &TOLERANCES),
    ]
    .concat();
    let runs: Vec<Run> = plan.iter().map(|(m, t)| run(m, *t)).collect();
    let outcomes = bench.time(&title, &runs)?;
    let mut points = Measured {
        pendulum,
        rk4: Vec::new(),
        radau: Vec::new(),
        auto: Vec::new(),
        uncertainty: largest_distance(&radau, &rk4),
    };
    for ((method, tolerance), outcome) in plan.into_iter().zip(&outcomes) {
        let cost = outcome.cost()?.clone();
        // The reference is always that of the other method.
        let reference = if cost.method == "rk4" { &radau } else { &rk4 };
        let point = Point {
            tolerance,
            error: largest_distance(&tip(outcome)?, reference),
            cost,
        };
        match method {
            "rk4" => points.rk4.push(point),
            "radau" => points.radau.push(point),
            _ => points.auto.push(point),
        }
    }
    Ok(points)
}

/// The path of the tip.
fn tip(outcome: &Outcome) -> Result<Vec<[f64; 2]>> {
    let table = outcome.table()?;
    let x = table.column("rod.tip.position[1]")?;
    let y = table.column("rod.tip.position[2]")?;
    Ok(x.into_iter().zip(y).map(|(x, y)| [x, y]).collect())
}

/// Order in time, fitted and between the two tightest tolerances: slope of the error against the mean step, over the points where the tolerance and
/// not stability set the step, and whose error the reference resolves.
fn orders(points: &[Point], uncertainty: f64) -> Option<(f64, f64)> {
    let loosest = points.first()?.cost.steps;
    let counted = points.iter().enumerate().filter(|(index, point)| {
        let at_the_limit = point.cost.method == "rk4" && point.cost.steps < 1.05 * loosest;
        let last_at_the_limit = at_the_limit
            && points
                .get(index + 1)
                .is_some_and(|next| next.cost.steps < 1.05 * loosest);
        !last_at_the_limit && point.error > 10.0 * uncertainty
    });
    let counted: Vec<(f64, f64)> = counted
        .map(|(_, point)| (STOP_TIME / point.cost.steps, point.error))
        .collect();
    let last = counted.get(counted.len().checked_sub(2)?..)?;
    Some((fitted_slope(&counted)?, fitted_slope(last)?))
}

/// CPU time that a method needs for an error.
fn needed(points: &[Point], error: f64) -> Option<f64> {
    let points = points.iter().map(|p| (p.cost.cpu_time, p.error));
    needed_for(&points.collect::<Vec<_>>(), error)
}

/// CPU time of a point over that of the better method at the same error.
fn ratio(measured: &Measured, point: &Point) -> f64 {
    let candidates = [&measured.rk4, &measured.radau];
    let needed = candidates.iter().filter_map(|m| needed(m, point.error));
    point.cost.cpu_time / needed.fold(point.cost.cpu_time, f64::min)
}

fn write(bench: &Bench, measured: &[Measured]) -> Result<()> {
    let header = [
        "pendulum",
        "method",
        "ran",
        "tolerance",
        "error_m",
        "cpu_time_s",
        "steps",
        "rejected",
        "newton_iterations",
    ];
    let mut rows = Vec::new();
    for case in measured {
        let methods = [
            ("rk4", &case.rk4),
            ("radau", &case.radau),
            ("auto", &case.auto),
        ];
        for (method, points) in methods {
            rows.extend(points.iter().map(|point| {
                vec![
                    case.pendulum.name.to_owned(),
                    method.to_owned(),
                    point.cost.method.clone(),
                    format!("{:e}", point.tolerance),
                    format!("{:.3e}", point.error),
                    format!("{:.3e}", point.cost.cpu_time),
                    point.cost.steps.to_string(),
                    point.cost.rejected.to_string(),
                    point.cost.newton_iterations.to_string(),
                ]
            }));
        }
    }
    page::write_csv(&bench.output("time.csv"), &header, &rows)?;
    let panel = |case: &Measured| {
        let xy = |points: &[Point]| -> Vec<(f64, f64)> {
            let xy = |point: &Point| (1e3 * point.cost.cpu_time, point.error);
            points.iter().map(xy).collect()
        };
        let (name, modulus) = (case.pendulum.name, case.pendulum.modulus);
        Panel {
            title: format!("{name}, E = {modulus:e} Pa"),
            x: Axis::log("CPU time / ms"),
            y: Axis::log("largest error of the tip / m"),
            lines: vec![
                Line::new("rk4", xy(&case.rk4), 0, Mark::Dot),
                Line::new("radau", xy(&case.radau), 1, Mark::Triangle),
                Line::new("auto", xy(&case.auto), 6, Mark::Square).dashed(),
            ],
        }
    };
    let panels: Vec<Panel> = measured.iter().map(panel).collect();
    draw(&bench.output("time.svg"), &panels)
}

fn section(measured: &[Measured]) -> String {
    let mut methods = Vec::new();
    for case in measured {
        for (method, points) in [("rk4", &case.rk4), ("radau", &case.radau)] {
            let cell = |point: &Point| {
                let (error, time) = (short(point.error), milliseconds(point.cost.cpu_time));
                format!("{error}, {time} ms")
            };
            let cells = TOLERANCES.iter().map(|tolerance| {
                let mut found = points.iter();
                let found = found.find(|point| point.tolerance == *tolerance);
                found.map_or("–".to_owned(), cell)
            });
            let orders = orders(points, case.uncertainty);
            let orders = orders.map_or("–".to_owned(), |(fitted, last)| {
                format!("{fitted:.1} ({last:.1})")
            });
            let names = [format!("{}, {method}", case.pendulum.name)];
            methods.push(names.into_iter().chain(cells).chain([orders]).collect());
        }
    }
    let choices: Vec<Vec<String>> = measured
        .iter()
        .map(|case| {
            let cell = |point: &Point| {
                let ratio = ratio(case, point);
                format!("{}, {ratio:.2}", point.cost.method)
            };
            let cells = case.auto.iter().map(cell);
            [case.pendulum.name.to_owned()]
                .into_iter()
                .chain(cells)
                .collect()
        })
        .collect();
    let tolerances: Vec<String> = TOLERANCES.iter().map(|t| format!("{t:.0e}")).collect();
    let tolerances: Vec<&str> = tolerances.iter().map(String::as_str).collect();
    let header = [&["pendulum, method"], tolerances.as_slice(), &["order"]].concat();
    let choice_header = [&["auto"], tolerances.as_slice()].concat();
    let uncertainties: Vec<String> = measured
        .iter()
        .map(|case| format!("{} {}", case.pendulum.name, short(case.uncertainty)))
        .collect();
    format!(
        "\
## time: error in time against CPU time

![Error in time against CPU time](time.svg)

Pendulums of the shape of the soft one, {ELEMENTS} elements, to {STOP_TIME} s with a communication step of {STEP} s; relative tolerances 1e-2 to 1e-7, medians of {REPEATS} runs. Lower left is better.
The error is that in time alone: largest distance of the tip from a run of the same mesh with the *other* method at a tolerance at least 100 times tighter (radau {REFERENCE_RADAU:e} for rk4, rk4 {REFERENCE_RK4:e} for radau).
Both references agree to, in m: {}; errors near that are not resolved. The order is the slope of the error against the mean step where the tolerance sets the step, fitted, and in parentheses between the two tightest tolerances.

{}
rk4 on steel is one point: stability sets the step, whatever the tolerance, and the same holds for rk4 on the middling pendulum.
Steps that adapt blur the order: with uniform steps on a smooth motion it is 4 for rk4 and 5 for radau (tests/order/). On the stiff pendulums radau's is reduced, as theory has it where the fastest vibrations are shorter than a step.

What `auto` picks, and its CPU time over that of the better method at the same error (1.00 = nothing to gain):

{}
{}",
        uncertainties.join(", "),
        page::table(&header, &methods),
        page::table(&choice_header, &choices),
        meaning(measured),
    )
}

fn meaning(measured: &[Measured]) -> String {
    let all = measured
        .iter()
        .flat_map(|case| case.auto.iter().map(move |point| (case, point)));
    let ratios = all.map(|(case, point)| (ratio(case, point), case, point));
    let Some((worst, case, point)) = ratios.max_by(|a, b| a.0.total_cmp(&b.0)) else {
        return String::new();
    };
    let (name, tolerance) = (case.pendulum.name, point.tolerance);
    let gains: Vec<String> = measured
        .iter()
        .filter_map(|case| {
            let fast = needed(&case.auto, 1e-4)?;
            Some(format!("{} {} ms", case.pendulum.name, milliseconds(fast)))
        })
        .collect();
    format!(
        "**What it means.** Leave the integrator to `auto`: at worst it takes {worst:.1} times what the better method takes for the same error ({name}, {tolerance:.0e}). \
         An error of 0.1 mm in 1.1 s of motion costs: {}. \
         A tolerance is an error a step may make, not the error at the end: read from the table what it amounts to.\n",
        gains.join(", ")
    )
}
