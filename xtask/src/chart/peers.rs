//! Exudyn and the product: error against CPU time, each with its best settings.

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, Ran, Run};
use super::csv::Csv;
use super::exudyn::Exudyn;
use super::numbers::{Path, largest_distance, median, number, numbers, text};
use crate::table::Table;

const SETTINGS: &str = "lab/exudyn/settings.json";
/// Scenes of the settings, in the order of the page.
const SCENES: &str = "soft_pendulum steel_pendulum flying_spaghetti spin_up slider_crank catenary";
/// Rounds of timed runs.
const ROUNDS: usize = 3;

/// A scene with its settings, for both programs.
struct Peers<'a> {
    name: &'a str,
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
    for name in SCENES.split(' ') {
        let peers = Peers::new(bench, name, &settings[name]);
        let measured = peers.and_then(|peers| {
            peers.confirm(bench, &mut scenes)?;
            peers.measure(bench, &mut exudyn, &mut csv)
        });
        measured.with_context(|| format!("{SETTINGS}, {name}"))?;
    }
    csv.save()?;
    scenes.save()
}

impl<'a> Peers<'a> {
    fn new(bench: &Bench, name: &'a str, setting: &'a Value) -> Result<Self> {
        let reference = bench.workspace().path(text(&setting["reference"])?);
        let reference = Table::read(&reference)?;
        let every = number(&setting["every"])?;
        let on_grid = |t: f64| ((t / every).round() * every - t).abs() < 1e-9;
        let places = reference.points("x_tip", "y_tip")?;
        let rows = reference.column("t")?.into_iter().zip(places);
        Ok(Self {
            name,
            setting,
            scene: bench.json(text(&setting["scene"])?)?,
            reference: rows
                .filter_map(|(t, place)| on_grid(t).then_some(place))
                .collect(),
        })
    }

    /// Largest distance of a path from the reference, divided by the length.
    fn error(&self, path: &[[f64; 2]]) -> Result<f64> {
        Ok(largest_distance(path, &self.reference) / number(&self.setting["length"])?)
    }

    /// A run of the product. What `auto` picks is what a user gets.
    fn run(&self, elements: f64, tolerance: f64) -> Result<Run> {
        let [stop, every] = ["stop_time", "every"].map(|key| number(&self.setting[key]));
        let mut run = Run::new(&self.scene, stop?, every?).tolerance(tolerance);
        let product = &self.setting["product"];
        for (key, unit) in [("set", 1.0), ("elements", elements)] {
            for (name, value) in product[key].as_object().into_iter().flatten() {
                run = run.set(name, unit * number(value)?);
            }
        }
        Ok(run.integrator("auto"))
    }

    /// What the marker did, against the reference.
    fn error_of(&self, ran: &Ran) -> Result<f64> {
        self.error(&ran.table.marker(text(&self.setting["marker"])?)?)
    }

    /// Holds the product's finest run against the reference.
    fn confirm(&self, bench: &Bench, scenes: &mut Csv) -> Result<()> {
        let setting = self.setting;
        let [elements, tolerance] = numbers(&setting["product"]["finest"])?[..] else {
            anyhow::bail!("expected elements and tolerance of the finest run");
        };
        let finest = self.run(elements, tolerance)?;
        let ran = bench.run(&format!("peers, {}, finest", self.name), &[finest])?;
        let confirmed = self.error_of(&ran.into_iter().next().context("expected a run")??)?;
        let [file, marker, source] = ["scene", "marker", "source"].map(|key| text(&setting[key]));
        let (file, marker, source) = (file?, marker?, source?);
        let keys = ["stop_time", "every", "length", "runs"];
        let [stop, every, length, runs] = keys.map(|key| &setting[key]);
        scenes.row(&[
            &self.name, &file, &marker, &stop, &every, &length, &source, &confirmed, &runs,
        ]);
        Ok(())
    }

    /// Runs all points of both programs in rounds.
    fn measure(&self, bench: &Bench, exudyn: &mut Exudyn, csv: &mut Csv) -> Result<()> {
        let (product, points) = (&self.setting["product"], self.setting["points"].as_array());
        let points = points.context("expected points")?;
        let tolerances = numbers(&product["tolerances"])?;
        let mut plan = Vec::new();
        for mesh in numbers(&product["meshes"])? {
            plan.extend(tolerances.iter().map(|tolerance| (mesh, *tolerance)));
        }
        let runs = plan
            .iter()
            .map(|(elements, tolerance)| self.run(*elements, *tolerance));
        let runs = runs.collect::<Result<Vec<_>>>()?;
        let mut others = vec![(0.0, Vec::new()); points.len()];
        let mut own = vec![(0.0, Vec::new()); plan.len()];
        for round in 1..=ROUNDS {
            for (point, (error, times)) in points.iter().zip(&mut others) {
                let answer = exudyn.run(&self.options(bench, point)?)?;
                *error = self.error(&answer.path)?;
                times.push(answer.cpu_time);
            }
            let title = format!("peers, {}, round {round} of {ROUNDS}", self.name);
            for (outcome, (error, times)) in bench.run(&title, &runs)?.iter().zip(&mut own) {
                // A mesh too coarse for its scene may fail: no point then.
                let Ok(ran) = outcome else { continue };
                *error = self.error_of(ran)?;
                times.push(ran.cpu_time);
            }
        }
        let scene = self.name;
        for (point, (error, times)) in points.iter().zip(others) {
            let pins = point.get("heavy").map_or("own", |_| "heavy nodes");
            let (words, count, time) = (described(point)?, &point["elements"], median(&times));
            csv.row(&[&scene, &"Exudyn", &pins, &words, count, &error, &time]);
        }
        for ((count, tolerance), (error, times)) in plan.iter().zip(own) {
            let (words, time) = (format!("tolerance {tolerance:e}"), median(&times));
            if !times.is_empty() {
                csv.row(&[&scene, &"Flexbody", &"", &words, count, &error, &time]);
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
