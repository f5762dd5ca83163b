//! Energy and residuals of undamped mechanisms over long times.

use anyhow::Result;

use super::bench::{Bench, Outcome, Run};
use super::numbers::{peaks, short, three_digits};
use super::page;
use super::plot::{Axis, Line, Mark, Panel, draw};

const TOLERANCES: [f64; 3] = [1e-4, 1e-6, 1e-8];
const STEP: f64 = 0.05;

/// A mechanism.
struct Mechanism {
    name: &'static str,
    scene: &'static str,
    /// Simulated time, s.
    stop_time: f64,
}

const MECHANISMS: [Mechanism; 3] = [
    Mechanism {
        name: "double pendulum, rigid",
        scene: "double_pendulum/scene.json",
        stop_time: 60.0,
    },
    // A minute of it at three tolerances would take minutes of CPU time.
    Mechanism {
        name: "double pendulum, cables",
        scene: "double_pendulum/cables.json",
        stop_time: 10.0,
    },
    Mechanism {
        name: "ring on a rope",
        scene: "ring_on_rope/scene.json",
        stop_time: 60.0,
    },
];

/// What one run shows.
struct Row {
    mechanism: &'static Mechanism,
    tolerance: f64,
    method: String,
    steps: f64,
    cpu_time: f64,
    /// Largest kinetic energy, J: what the drift is measured by.
    scale: f64,
    /// Time, and change of the energy over the scale.
    drift: Vec<(f64, f64)>,
    residuals: [f64; 2],
}

impl Row {
    fn largest(&self) -> f64 {
        let sizes = self.drift.iter().map(|(_, drift)| drift.abs());
        sizes.fold(0.0, f64::max)
    }

    fn last(&self) -> f64 {
        self.drift.last().map_or(0.0, |(_, drift)| *drift)
    }
}

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let (mut runs, mut plan) = (Vec::new(), Vec::new());
    for mechanism in &MECHANISMS {
        let scene = bench.case_json(mechanism.scene)?;
        for tolerance in TOLERANCES {
            let run = Run::new(&scene, mechanism.stop_time, STEP);
            runs.push(run.integrator("auto").tolerance(tolerance));
            plan.push((mechanism, tolerance));
        }
    }
    let outcomes = bench.run("energies", &runs)?;
    let rows = plan.into_iter().zip(&outcomes);
    let rows: Vec<Row> = rows
        .map(|((mechanism, tolerance), outcome)| row(mechanism, tolerance, outcome))
        .collect::<Result<_>>()?;
    write(bench, &rows)?;
    Ok(section(&rows))
}

fn row(mechanism: &'static Mechanism, tolerance: f64, outcome: &Outcome) -> Result<Row> {
    let (cost, table) = (outcome.cost()?, outcome.table()?);
    let kinetic = table.column("energy.kinetic")?;
    let strain = table.column("energy.strain")?;
    let gravity = table.column("energy.gravity")?;
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let total = |i: usize| kinetic[i] + strain[i] + gravity[i];
    let scale = largest(&kinetic);
    let times = table.column("time")?.into_iter().enumerate();
    Ok(Row {
        mechanism,
        tolerance,
        method: cost.method.clone(),
        steps: cost.steps,
        cpu_time: cost.cpu_time,
        scale,
        drift: times
            .map(|(i, time)| (time, (total(i) - total(0)) / scale))
            .collect(),
        residuals: [
            largest(&table.column("residual.position")?),
            largest(&table.column("residual.velocity")?),
        ],
    })
}

fn write(bench: &Bench, rows: &[Row]) -> Result<()> {
    let header = [
        "mechanism",
        "stop_time_s",
        "method",
        "tolerance",
        "scale_J",
        "largest_drift",
        "last_drift",
        "residual_position",
        "residual_velocity",
        "steps",
        "cpu_time_s",
    ];
    let cells = |row: &Row| {
        vec![
            row.mechanism.name.replace(", ", " "),
            row.mechanism.stop_time.to_string(),
            row.method.clone(),
            format!("{:e}", row.tolerance),
            format!("{:.3e}", row.scale),
            format!("{:.3e}", row.largest()),
            format!("{:.3e}", row.last()),
            format!("{:.1e}", row.residuals[0]),
            format!("{:.1e}", row.residuals[1]),
            row.steps.to_string(),
            format!("{:.3e}", row.cpu_time),
        ]
    };
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    page::write_csv(&bench.output("energies.csv"), &header, &cells)?;
    let marks = [Mark::Dot, Mark::Ring, Mark::Triangle];
    let line = |(index, rows): (usize, &[Row])| {
        let points = rows.iter().map(|row| (row.tolerance, row.largest()));
        let name = MECHANISMS[index].name;
        Line::new(name, points.collect(), index, marks[index])
    };
    let curve = |(index, rows): (usize, &[Row])| {
        let middle = &rows[TOLERANCES.len() / 2];
        let name = MECHANISMS[index].name;
        Line::new(name, peaks(&middle.drift), index, Mark::None)
    };
    let families = || rows.chunks(TOLERANCES.len()).enumerate();
    let panels = [
        Panel {
            title: "Largest drift".into(),
            x: Axis::log("relative tolerance"),
            y: Axis::log("largest |E − E₀| / largest kinetic energy"),
            lines: families().map(line).collect(),
        },
        Panel {
            title: format!("Drift so far at tolerance {:e}", TOLERANCES[1]),
            x: Axis::linear("time / s", 10.0),
            y: Axis::log("largest |E − E₀| so far / largest kinetic energy").floor(1e-9),
            lines: families().map(curve).collect(),
        },
    ];
    draw(&bench.output("energies.svg"), &panels)
}

fn section(rows: &[Row]) -> String {
    let header = [
        "mechanism",
        "time / s",
        "tolerance",
        "method",
        "largest drift",
        "drift at the end",
        "largest residual of positions",
        "of velocities",
        "steps",
        "CPU s",
    ];
    let cells = |row: &Row| {
        vec![
            row.mechanism.name.to_owned(),
            row.mechanism.stop_time.to_string(),
            format!("{:.0e}", row.tolerance),
            row.method.clone(),
            short(row.largest()),
            format!("{:+.1e}", row.last()),
            short(row.residuals[0]),
            short(row.residuals[1]),
            row.steps.to_string(),
            three_digits(row.cpu_time),
        ]
    };
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let residuals = rows.iter().flat_map(|row| row.residuals);
    let residual = residuals.fold(0.0, f64::max);
    let drifts = |mechanism: &Mechanism| {
        let own = rows.iter().filter(|r| r.mechanism.name == mechanism.name);
        let drifts: Vec<String> = own.map(|row| short(row.largest())).collect();
        format!("{} {}", mechanism.name, drifts.join(", "))
    };
    let drifts: Vec<String> = MECHANISMS.iter().map(drifts).collect();
    format!(
        "\
## energies: energy and residuals over a minute

![Energy drift of mechanisms](energies.svg)

Undamped mechanisms of the cases, `auto`, read every {STEP} s. The drift is the change of the total energy over the largest kinetic energy of the run; negative is loss. Residuals are the largest at communication points; those of the pendulum of cables are zero, since their pins are eliminated.
The pendulum of cables runs for 10 s: a minute of it at three tolerances takes minutes of CPU time, since its energy goes over into fast vibrations.

{}
**What it means.** Constraints hold to {} whatever the tolerance and however long the run, with no constant to tune; the tolerance sets the energy alone. Drift at 1e-4, 1e-6 and 1e-8: {}. \
What whips loses most: part of its energy goes into waves so fast that both methods damp them (see drift). Where energy matters over a minute, take 1e-8.
",
        page::table(&header, &cells),
        short(residual),
        drifts.join("; "),
    )
}
