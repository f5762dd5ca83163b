//! Exudyn and the product: error against CPU time, each with its best settings.

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, Run};
use super::csv::{Csv, digits};
use super::exudyn::Exudyn;
use super::numbers::{Path, largest_distance, median, number, text};
use crate::table::Table;

const SETTINGS: &str = "lab/exudyn/settings.json";
/// Rounds of timed runs.
const ROUNDS: usize = 3;

/// A scene that both programs run, as the product runs it; the rest is in the settings of Exudyn.
struct Case {
    /// Name in the settings.
    name: &'static str,
    /// Start values.
    set: &'static [(&'static str, f64)],
    /// Parameters that hold numbers of elements, each with its multiple.
    elements: &'static [(&'static str, u32)],
    /// Numbers of elements, times those multiples.
    meshes: &'static [u32],
    /// Relative tolerances.
    tolerances: &'static [f64],
    /// The product's finest run, which confirms the reference.
    finest: (u32, f64),
}

const ROD: &[(&str, u32)] = &[("rod.elements", 1)];
const STEEL: &[(&str, f64)] = &[("rod.youngs_modulus", 2.07e11), ("rod.density", 7800.0)];
const CASES: [Case; 6] = [
    Case {
        name: "soft_pendulum",
        set: &[],
        elements: ROD,
        meshes: &[5, 10, 20, 30, 40, 60, 80, 160, 320],
        tolerances: &[1e-3, 1e-4, 1e-5, 1e-6],
        finest: (320, 1e-7),
    },
    Case {
        name: "steel_pendulum",
        set: STEEL,
        elements: ROD,
        meshes: &[1, 2, 4, 8, 16],
        tolerances: &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7],
        finest: (32, 1e-8),
    },
    Case {
        name: "flying_spaghetti",
        set: &[],
        elements: ROD,
        meshes: &[6, 8, 12, 16, 24, 32, 48, 64, 128],
        tolerances: &[1e-3, 1e-4, 1e-5, 1e-6],
        finest: (128, 1e-8),
    },
    Case {
        name: "spin_up",
        set: &[],
        elements: ROD,
        meshes: &[1, 2, 3, 4, 8, 16],
        tolerances: &[1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8],
        finest: (64, 1e-8),
    },
    Case {
        name: "slider_crank",
        set: &[],
        elements: &[("crank.elements", 1), ("rod.elements", 2)],
        meshes: &[1, 2, 4, 8, 16],
        tolerances: &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6],
        finest: (32, 1e-7),
    },
    Case {
        name: "catenary",
        set: &[],
        elements: ROD,
        meshes: &[4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128],
        tolerances: &[1e-3, 1e-5, 1e-7],
        finest: (320, 1e-8),
    },
];

/// A case with its settings.
struct Peers<'a> {
    case: &'static Case,
    setting: &'a Value,
    scene: Value,
    reference: Path,
}

/// Measures.
pub fn measure(bench: &Bench) -> Result<()> {
    let settings = bench.json(SETTINGS)?;
    let mut exudyn = Exudyn::start(bench.workspace())?;
    let header = "scene,program,pins,settings,elements,error,cpu_time_s";
    let mut csv = Csv::new(bench, "peers", header);
    let header = "scene,file,marker,stop_time_s,every_s,length_m,reference,confirmed,sweep_runs";
    let mut scenes = Csv::new(bench, "peers_scenes", header);
    for case in &CASES {
        let setting = &settings[case.name];
        let place = || format!("{SETTINGS}, {}", case.name);
        let peers = Peers::new(bench, case, setting).with_context(place)?;
        let number = |key: &str| number(&setting[key]).with_context(place);
        let text = |key: &str| text(&setting[key]).with_context(place);
        let finest = peers.run(case.finest.0, case.finest.1)?;
        let finest = bench.run(&format!("peers, {}, finest", case.name), &[finest])?;
        scenes.row(&[
            &case.name,
            &text("scene")?,
            &text("marker")?,
            &number("stop_time")?,
            &number("every")?,
            &number("length")?,
            &text("source")?,
            &digits(peers.error(&peers.path(finest[0].table()?)?)?),
            &number("runs")?,
        ]);
        peers.measure(bench, &mut exudyn, &mut csv)?;
    }
    csv.save()?;
    scenes.save()
}

impl<'a> Peers<'a> {
    fn new(bench: &Bench, case: &'static Case, setting: &'a Value) -> Result<Self> {
        let reference = bench.workspace().path(text(&setting["reference"])?);
        let reference = Table::read(&reference)?;
        let every = number(&setting["every"])?;
        let on_grid = |t: &f64| ((t / every).round() * every - t).abs() < 1e-9;
        let places = reference.points("x_tip", "y_tip")?;
        let rows = reference.column("t")?.into_iter().zip(places);
        Ok(Self {
            case,
            setting,
            scene: bench.json(text(&setting["scene"])?)?,
            reference: rows
                .filter(|row| on_grid(&row.0))
                .map(|row| row.1)
                .collect(),
        })
    }

    /// Largest distance of a path from the reference, divided by the length.
    fn error(&self, path: &[[f64; 2]]) -> Result<f64> {
        Ok(largest_distance(path, &self.reference) / number(&self.setting["length"])?)
    }

    /// A run of the product. What `auto` picks is what a user gets.
    fn run(&self, elements: u32, tolerance: f64) -> Result<Run> {
        let (stop, every) = (
            number(&self.setting["stop_time"])?,
            number(&self.setting["every"])?,
        );
        let mut run = Run::new(&self.scene, stop, every).tolerance(tolerance);
        for (name, value) in self.case.set {
            run = run.set(name, *value);
        }
        for (name, multiple) in self.case.elements {
            run = run.set(name, f64::from(elements * multiple));
        }
        Ok(run.integrator("auto"))
    }

    /// What the marker did.
    fn path(&self, table: &Table) -> Result<Path> {
        let marker = text(&self.setting["marker"])?;
        table.points(
            &format!("{marker}.position[1]"),
            &format!("{marker}.position[2]"),
        )
    }

    /// Runs all points of both programs in rounds.
    fn measure(&self, bench: &Bench, exudyn: &mut Exudyn, csv: &mut Csv) -> Result<()> {
        let points = self.setting["points"]
            .as_array()
            .context("expected points")?;
        let meshes = self.case.meshes.iter();
        let plan: Vec<(u32, f64)> = meshes
            .flat_map(|mesh| {
                self.case
                    .tolerances
                    .iter()
                    .map(|tolerance| (*mesh, *tolerance))
            })
            .collect();
        let runs = plan
            .iter()
            .map(|(elements, tolerance)| self.run(*elements, *tolerance));
        let runs = runs.collect::<Result<Vec<_>>>()?;
        let mut others = vec![(0.0, Vec::new()); points.len()];
        let mut own = vec![(0.0, Vec::new()); plan.len()];
        for round in 1..=ROUNDS {
            for (point, (error, times)) in points.iter().zip(&mut others) {
                let answer = exudyn.run(&self.options(bench, point)?)?;
                let path: Path = answer.path.iter().map(|row| [row[1], row[2]]).collect();
                *error = self.error(&path)?;
                times.push(answer.cpu_time);
            }
            let title = format!("peers, {}, round {round} of {ROUNDS}", self.case.name);
            for (outcome, (error, times)) in bench.run(&title, &runs)?.iter().zip(&mut own) {
                // A mesh too coarse for its scene may fail: no point then.
                let Ok(table) = outcome.table() else { continue };
                *error = self.error(&self.path(table)?)?;
                times.push(outcome.cost()?.cpu_time);
            }
        }
        for (point, (error, times)) in points.iter().zip(others) {
            let pins = point.get("heavy").map_or("own", |_| "heavy nodes");
            let (elements, time) = (number(&point["elements"])?, digits(median(&times)));
            csv.row(&[
                &self.case.name,
                &"Exudyn",
                &pins,
                &described(point)?,
                &elements,
                &digits(error),
                &time,
            ]);
        }
        for ((elements, tolerance), (error, times)) in plan.iter().zip(own) {
            if !times.is_empty() {
                let (settings, time) = (format!("tolerance {tolerance:e}"), digits(median(&times)));
                csv.row(&[
                    &self.case.name,
                    &"Flexbody",
                    &"",
                    &settings,
                    elements,
                    &digits(error),
                    &time,
                ]);
            }
        }
        Ok(())
    }

    /// Options of a run of Exudyn: those of all runs, and its own.
    fn options(&self, bench: &Bench, point: &Value) -> Result<Value> {
        let mut all = json!({ "scene": bench.workspace().path(text(&self.setting["scene"])?) });
        for key in ["marker", "stop_time", "every", "shares"] {
            if let Some(value) = self.setting.get(key) {
                all[key] = value.clone();
            }
        }
        for options in [&self.setting["options"], point] {
            for (key, option) in options.as_object().into_iter().flatten() {
                all[key] = option.clone();
            }
        }
        Ok(all)
    }
}

/// Settings of Exudyn in words; what is not said is its default.
fn described(options: &Value) -> Result<String> {
    const APART: [&str; 6] = ["elements", "error", "cpu_time", "heavy", "step", "solver"];
    let mut words = format!(
        "{}; step {:.2e}",
        text(&options["solver"])?,
        number(&options["step"])?
    );
    for (key, value) in options.as_object().into_iter().flatten() {
        if !APART.contains(&key.as_str()) {
            words += &format!("; {key} {}", value.to_string().trim_matches('"'));
        }
    }
    Ok(words)
}
