//! What coupling costs: error against communication step in several masters, and the largest steps
//! that are stable, beside figures.

use anyhow::{Context, Result};
use serde_json::Value;

use super::bench::Bench;
use super::numbers::{short, three_digits};
use super::page;
use super::plot::{Axis, Line, Mark, Panel, draw};
use crate::process::stdout;
use crate::python::Python;

/// Measures with real FMUs and prints JSON.
const PROGRAM: &str = "tests/masters/coupling.py";
/// Masters in the order of the legend; their places are their colours.
const MASTERS: [&str; 5] = [
    "Jacobi",
    "Gauss-Seidel",
    "output derivatives",
    "rollback",
    "ECCO",
];
/// Systems as in the report, with their titles.
const SYSTEMS: [(&str, &str); 2] = [
    ("two_masses", "two masses"),
    ("beam", "beam and mass at its tip"),
];
/// What stands for a step where all that were tried are stable.
const ALL_STABLE: &str = "all to 2 s";
/// Errors that the table gives steps for.
const ERRORS: [f64; 2] = [1e-2, 1e-3];

/// A run: a master with a communication step.
struct Point {
    master: String,
    degree: u64,
    /// s; of ECCO the mean.
    step: f64,
    /// Largest error of the position, relative to the largest position.
    error: f64,
    /// Attempts a step.
    attempts: f64,
}

/// The largest stable step of a master.
struct Limit {
    coupling: String,
    master: String,
    degree: u64,
    /// s; nothing where all tried were stable.
    step: Option<f64>,
}

/// All that was measured.
struct Measured {
    /// By system.
    points: [Vec<Point>; 2],
    /// The table of figures: with partners as units and with scenes, and the figures.
    tabled: [Vec<Limit>; 2],
    figures: Vec<Option<f64>>,
    /// Of masters without figures, by system.
    others: [Vec<Limit>; 2],
    /// Shortest period of the whole, s, by system.
    periods: [f64; 2],
    /// Distance of the reference of the beam from a closed form.
    closed_form: f64,
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let python = Python::prepare_masters(bench.workspace())?;
    let xtask = std::env::current_exe().context("cannot find this program itself")?;
    let mut command = python.script(&bench.workspace().path(PROGRAM));
    let report = stdout(command.env("FLEXBODY_XTASK", xtask))?;
    let report = serde_json::from_str(&report).context("expected a report in JSON")?;
    let measured = read(&report)?;
    write(bench, &measured)?;
    Ok(section(&measured))
}

fn read(report: &Value) -> Result<Measured> {
    let [masses, beam] = SYSTEMS.map(|(key, _)| &report[key]);
    let figures = list(&masses["figures"])?;
    Ok(Measured {
        points: [points(&masses["curves"])?, points(&beam["curves"])?],
        tabled: [
            limits(&masses["units"]["partners"])?,
            limits(&masses["units"]["scenes"])?,
        ],
        figures: figures.iter().map(Value::as_f64).collect(),
        others: [limits(&masses["limits"])?, limits(&beam["limits"])?],
        periods: [number(&masses["period"])?, number(&beam["period"])?],
        closed_form: number(&beam["closed_form"])?,
    })
}

fn points(rows: &Value) -> Result<Vec<Point>> {
    let point = |row: &Value| {
        Ok(Point {
            master: text(&row["master"])?,
            degree: row["degree"].as_u64().context("expected a degree")?,
            step: number(&row["step"])?,
            error: number(&row["error"])?,
            attempts: number(&row["attempts"])?,
        })
    };
    list(rows)?.iter().map(point).collect()
}

fn limits(rows: &Value) -> Result<Vec<Limit>> {
    let limit = |row: &Value| {
        Ok(Limit {
            coupling: text(&row["coupling"])?,
            master: text(&row["master"])?,
            degree: row["degree"].as_u64().context("expected a degree")?,
            step: row["step"].as_f64(),
        })
    };
    list(rows)?.iter().map(limit).collect()
}

fn list(value: &Value) -> Result<&Vec<Value>> {
    value.as_array().context("expected a list")
}

fn number(value: &Value) -> Result<f64> {
    let message = || format!("expected a number, found {value}");
    value.as_f64().with_context(message)
}

fn text(value: &Value) -> Result<String> {
    let message = || format!("expected a text, found {value}");
    value.as_str().map(str::to_owned).with_context(message)
}

/// Masters with their degrees, in the order of the legend.
fn kinds(points: &[Point]) -> Vec<(String, u64)> {
    let mut kinds: Vec<(String, u64)> = Vec::new();
    for point in points {
        let kind = (point.master.clone(), point.degree);
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    kinds
}

fn shown(master: &str, degree: u64) -> String {
    match master {
        "ECCO" => "ECCO, mean step".to_owned(),
        _ => format!("{master}, degree {degree}"),
    }
}

/// Steps and errors of one master, the steps growing.
fn curve(points: &[Point], (master, degree): &(String, u64)) -> Vec<(f64, f64)> {
    let of = |point: &&Point| point.master == *master && point.degree == *degree;
    let found = points.iter().filter(of);
    let mut curve: Vec<(f64, f64)> = found.map(|point| (point.step, point.error)).collect();
    curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    curve
}

/// The largest step up to which a curve keeps an error, on straight lines between points with
/// logarithmic axes; nothing where its first point does not.
fn step_for(curve: &[(f64, f64)], error: f64) -> Option<f64> {
    let beyond = curve.iter().position(|point| point.1 > error);
    match beyond {
        Some(0) => None,
        None => curve.last().map(|point| point.0),
        Some(next) => {
            let (a, b) = (curve[next - 1], curve[next]);
            let part = (error / a.1).ln() / (b.1 / a.1).ln();
            Some(a.0 * (b.0 / a.0).powf(part))
        }
    }
}

fn write(bench: &Bench, measured: &Measured) -> Result<()> {
    let mut rows = Vec::new();
    for ((key, _), points) in SYSTEMS.iter().zip(&measured.points) {
        for point in points {
            rows.push(vec![
                (*key).to_owned(),
                point.master.clone(),
                point.degree.to_string(),
                format!("{:.6e}", point.step),
                format!("{:.4e}", point.error),
                format!("{:.2}", point.attempts),
            ]);
        }
    }
    let header = ["system", "master", "degree", "step_s", "error", "attempts"];
    page::write_csv(&bench.output("coupling.csv"), &header, &rows)?;
    write_limits(bench, measured)?;
    let marks = [Mark::Ring, Mark::Dot, Mark::Triangle];
    let panels = SYSTEMS
        .iter()
        .zip(&measured.points)
        .map(|(system, points)| {
            let line = |kind: &(String, u64)| {
                let colour = MASTERS.iter().position(|name| *name == kind.0);
                let mark = match kind.0.as_str() {
                    "ECCO" => Mark::Cross,
                    _ => marks[kind.1 as usize],
                };
                let name = shown(&kind.0, kind.1);
                Line::new(&name, curve(points, kind), colour.unwrap_or(0), mark)
            };
            Panel {
                title: format!("Coupled: {}", system.1),
                x: Axis::log("communication step / s"),
                y: Axis::log("error / largest position"),
                lines: kinds(points).iter().map(line).collect(),
            }
        });
    draw(&bench.output("coupling.svg"), &panels.collect::<Vec<_>>())
}

fn write_limits(bench: &Bench, measured: &Measured) -> Result<()> {
    let [partners, scenes] = &measured.tabled;
    let [masses, beam] = &measured.others;
    let figures = measured.figures.iter().copied();
    let tabled = [("partners", partners), ("scenes", scenes)]
        .into_iter()
        .flat_map(|(units, rows)| rows.iter().map(move |row| ("two_masses", units, row)))
        .zip(figures.clone().chain(figures));
    let others = masses.iter().map(|row| ("two_masses", "partners", row));
    let others = others.chain(beam.iter().map(|row| ("beam", "scene and partner", row)));
    let rows: Vec<Vec<String>> = tabled
        .chain(others.map(|row| (row, None)))
        .map(|((system, units, row), figure)| {
            let step = |step: Option<f64>| step.map(|step| format!("{step:.5}"));
            vec![
                system.to_owned(),
                units.to_owned(),
                row.coupling.clone(),
                row.master.clone(),
                row.degree.to_string(),
                step(row.step).unwrap_or_default(),
                step(figure).unwrap_or_default(),
            ]
        })
        .collect();
    let header = [
        "system",
        "units",
        "coupling",
        "master",
        "degree",
        "largest_stable_step_s",
        "figure_s",
    ];
    page::write_csv(&bench.output("coupling_limits.csv"), &header, &rows)
}

/// Figures beside what was measured with both kinds of units.
fn figures(measured: &Measured) -> String {
    let [partners, scenes] = &measured.tabled;
    let rows = measured.figures.iter().zip(partners.iter().zip(scenes));
    let cell = |step: Option<f64>, figure: Option<f64>| match (step, figure) {
        (Some(step), Some(figure)) => {
            let percent = (100.0 * (step / figure - 1.0)).abs();
            format!("{step:.4} ({percent:.1} % off)")
        }
        (Some(step), None) => format!("{step:.4}"),
        (None, _) => ALL_STABLE.to_owned(),
    };
    let row = |(figure, (partner, scene)): (&Option<f64>, (&Limit, &Limit))| {
        vec![
            partner.coupling.clone(),
            partner.master.clone(),
            partner.degree.to_string(),
            figure.map_or(ALL_STABLE.to_owned(), |figure| format!("{figure:.4}")),
            cell(partner.step, *figure),
            cell(scene.step, *figure),
        ]
    };
    let header = [
        "coupling",
        "scheme",
        "degree",
        "figure / s",
        "partners / s",
        "scenes / s",
    ];
    page::table(&header, &rows.map(row).collect::<Vec<_>>())
}

/// Largest distance of a measured step from its figure; infinite where one is stable and the other not.
fn worst(measured: &Measured) -> f64 {
    let rows = measured
        .tabled
        .iter()
        .flat_map(|limits| limits.iter().zip(&measured.figures));
    let distance = |(limit, figure): (&Limit, &Option<f64>)| match (limit.step, figure) {
        (Some(step), Some(figure)) => (step / figure - 1.0).abs(),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    };
    rows.map(distance).fold(0.0, f64::max)
}

/// Largest stable steps of masters, a column for each way of coupling.
fn limits_table(limits: &[Limit]) -> String {
    let (mut ways, mut masters): (Vec<&str>, Vec<(&str, u64)>) = (Vec::new(), Vec::new());
    for limit in limits {
        let master = (limit.master.as_str(), limit.degree);
        if !ways.contains(&limit.coupling.as_str()) {
            ways.push(&limit.coupling);
        }
        if !masters.contains(&master) {
            masters.push(master);
        }
    }
    let row = |&(master, degree): &(&str, u64)| {
        let cell = |way: &&str| {
            let is_it = |l: &&Limit| l.coupling == *way && l.master == master && l.degree == degree;
            match limits.iter().find(is_it) {
                Some(limit) => limit.step.map_or(ALL_STABLE.to_owned(), largest),
                None => "–".to_owned(),
            }
        };
        let cells = ways.iter().map(cell);
        [shown(master, degree)].into_iter().chain(cells).collect()
    };
    let rows: Vec<Vec<String>> = masters.iter().map(row).collect();
    let ways = ways.iter().map(|way| format!("{way} / s"));
    let header: Vec<String> = ["master".to_owned()].into_iter().chain(ways).collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    page::table(&header, &rows)
}

fn largest(step: f64) -> String {
    match step {
        0.0 => "0".to_owned(),
        _ => three_digits(step),
    }
}

/// Steps that errors allow, and what each costs in attempts.
fn steps_table(measured: &Measured) -> String {
    let kinds = kinds(&measured.points[0]);
    let row = |kind: &(String, u64)| {
        let mut cells = vec![shown(&kind.0, kind.1)];
        for points in &measured.points {
            let curve = curve(points, kind);
            let steps = ERRORS.map(|error| step_for(&curve, error));
            cells.extend(steps.map(|step| step.map_or("–".to_owned(), |step| short(1e3 * step))));
        }
        let of = |point: &&Point| (&point.master, point.degree) == (&kind.0, kind.1);
        let own = measured
            .points
            .iter()
            .flatten()
            .filter(of)
            .map(|p| p.attempts);
        cells.push(short(own.fold(0.0, f64::max)));
        cells
    };
    let rows: Vec<Vec<String>> = kinds.iter().map(row).collect();
    let columns = SYSTEMS.iter().flat_map(|(_, title)| {
        ERRORS.map(|error| format!("{title}: ms for {} %", short(100.0 * error)))
    });
    let mut header = vec!["master".to_owned()];
    header.extend(columns);
    header.push("attempts a step, at most".to_owned());
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    page::table(&header, &rows)
}

/// Error of a master on the line between points at a step; not a number where it has none.
fn error_at(points: &[Point], master: (&str, u64), step: f64) -> f64 {
    let curve = curve(points, &(master.0.to_owned(), master.1));
    let pair = curve
        .windows(2)
        .find(|pair| pair[0].0 <= step && step <= pair[1].0);
    pair.map_or(f64::NAN, |pair| {
        let part = (step / pair[0].0).ln() / (pair[1].0 / pair[0].0).ln();
        pair[0].1 * (pair[1].1 / pair[0].1).powf(part)
    })
}

/// The smallest error of a master in percent, and how many steps a period it has there.
fn best(measured: &Measured, system: usize, master: (&str, u64)) -> String {
    let curve = curve(&measured.points[system], &(master.0.to_owned(), master.1));
    let first = curve.first().copied().unwrap_or((f64::NAN, f64::NAN));
    let count = measured.periods[system] / first.0;
    format!(
        "{} % with {count:.0} steps a period",
        short(100.0 * first.1)
    )
}

/// Largest stable step of Jacobi with inputs held, by way of coupling.
fn held(limits: &[Limit], way: &str) -> f64 {
    let is_it =
        |limit: &&Limit| limit.coupling == way && limit.master == "Jacobi" && limit.degree == 0;
    limits
        .iter()
        .find(is_it)
        .and_then(|limit| limit.step)
        .unwrap_or(f64::NAN)
}

fn section(measured: &Measured) -> String {
    let tenth = |system: usize, master: (&str, u64)| {
        let step = measured.periods[system] / 10.0;
        short(100.0 * error_at(&measured.points[system], master, step))
    };
    let beam = &measured.others[1];
    format!(
        "\
## coupling: what it costs in accuracy

![Error against communication step](coupling.svg)

Units coupled in masters that call them as FMUs (`tests/masters/coupling.py`): Jacobi (all from one communication point), Gauss-Seidel (one after the other), both with inputs held (degree 0) or continued through the last two or three points by derivatives of inputs (degrees 1, 2); Jacobi with derivatives of outputs for derivatives of inputs; `examples/rollback_master.py`, which repeats a step until both sides agree, inputs on lines (1) or parabolas (2); ECCO of libcosimpy, which holds inputs and chooses its steps by the power that the coupling loses. Masters here read outputs again once inputs are set, so that a force follows the motion of the same point.

Errors are the largest of a position over the run, relative to the largest position. Two masses of 1 kg, each on 10 N/m and 1 N s/m, with 100 N/m and 1 N s/m between them, one set free at 1 m: exact solution, exact units (`partners/`). Beam and mass: a steel cantilever of 1 m with a port that has a spring of 2000 N/m and a damper of 2 N s/m, 0.5 kg thrown against it; reference is the scene that holds both, {closed:.0e} from the closed form without damping.

Largest stable steps of the two masses, beside figures from amplification matrices (`tests/masters/two_masses.json`). FD: the first unit has the spring, motion goes to it and force to the other; DD: both have it; FF: a third unit has it. `Partners` are exact units, `scenes` are scenes of the product with ports.

{figures}
Measured by bisection on runs; the largest distance from a figure is {worst:.1} %.

Other masters, same masses:

{masses}
Beam and mass. FD: the beam's port has the spring; FD': the mass has it; FF: a third unit has it. 0: unstable with 1 ms already.

{beam_limits}
Communication steps, in ms, that keep errors:

{steps}
**How to choose a communication step.** \
Put spring and damper of the coupling into the port of one unit, continue inputs with derivatives (order 1 is safe, order 2 pays once the fastest motion that crosses the coupling is resolved), and begin with a tenth of the period with which the coupled bodies move against each other: errors are then {od_masses} % (two masses) and {od_beam} % (beam) with first derivatives of outputs, {rb_masses} % and {rb_beam} % with rollback on parabolas, while inputs that are held are still off by {j_masses} and {j_beam}. \
Then halve the step until results stop changing: the error halves each time with inputs held, falls to a quarter with first and to an eighth with second derivatives, and what still changes by more is near the end of stability.

**What it means.** \
The spring in the beam's port lets held inputs step {port} times as far as the same spring in the mass, and {outside} times as far as a spring outside both. \
Derivatives of outputs beat points of the past with the same degree, for the unit knows what it will do and the past does not. Rollback is stable until there are about two steps in a period, at {attempts} attempts a step at most; where stiff or fast units are coupled it is the only one that keeps its order at large steps. ECCO chooses steps by itself but holds inputs: its error falls in proportion to its step.
",
        closed = measured.closed_form,
        figures = figures(measured),
        worst = 100.0 * worst(measured),
        masses = limits_table(&measured.others[0]),
        beam_limits = limits_table(beam),
        steps = steps_table(measured),
        od_masses = tenth(0, ("output derivatives", 1)),
        od_beam = tenth(1, ("output derivatives", 1)),
        rb_masses = tenth(0, ("rollback", 2)),
        rb_beam = tenth(1, ("rollback", 2)),
        j_masses = best(measured, 0, ("Jacobi", 0)),
        j_beam = best(measured, 1, ("Jacobi", 0)),
        port = short(held(beam, "FD") / held(beam, "FD'")),
        outside = short(held(beam, "FD") / held(beam, "FF")),
        attempts = short(
            measured.points.iter().flatten().map(|p| p.attempts).fold(0.0, f64::max)
        ),
    )
}
