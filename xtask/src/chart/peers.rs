//! Exudyn at its best settings and the product as it plans: error against CPU time.

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, Ran};
use super::csv::Csv;
use super::numbers::{Path, largest_distance, median, number, numbers, text};
use super::planned::{self, Case, Choice, ERRORS, SETTINGS, chosen};
use super::server::{EXUDYN, Server};
use crate::table::Table;

/// Loosest error that a scene may ask for.
const LOOSEST: f64 = 0.1;

/// Rounds of timed runs.
const ROUNDS: usize = 7;

/// A scene with its settings, for both programs.
struct Peers {
    case: Case,
    setting: Value,
    reference: Path,
}

/// A run that is timed: its error and CPU times, and its integrator.
#[derive(Clone, Default)]
struct Timed {
    error: f64,
    cpu_times: Vec<f64>,
    method: String,
}

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let mut exudyn = Server::start(bench.workspace(), EXUDYN)?;
    let header = "scene,program,model,elements,settings,wanted,tolerance,method,error,cpu_time_s";
    let mut csv = Csv::new(bench, "peers", header);
    let header = "scene,file,marker,stop_time_s,every_s,length_m,reference,confirmed,sweep_runs";
    let mut scenes = Csv::new(bench, "peers_scenes", header);
    for (case, setting) in planned::peers(bench)? {
        let place = format!("{SETTINGS}, {}", case.name);
        let measured = Peers::new(bench, case, setting).and_then(|peers| {
            peers.confirm(bench, &mut scenes)?;
            peers.measure(bench, &mut exudyn, &mut csv)
        });
        measured.context(place)?;
    }
    csv.save()?;
    scenes.save()
}

impl Peers {
    fn new(bench: &Bench, case: Case, setting: Value) -> Result<Self> {
        let reference = bench.workspace().path(text(&setting["reference"])?);
        let reference = Table::read(&reference)?;
        let every = number(&setting["every"])?;
        let on_grid = |t: f64| ((t / every).round() * every - t).abs() < 1e-9;
        let places = reference.points("x_tip", "y_tip")?;
        let rows = reference.column("t")?.into_iter().zip(places);
        let reference = rows.filter_map(|(t, place)| on_grid(t).then_some(place));
        Ok(Self {
            case,
            reference: reference.collect(),
            setting,
        })
    }

    /// Largest distance of a path from the reference, divided by the length.
    fn error(&self, path: &[[f64; 2]]) -> Result<f64> {
        Ok(largest_distance(path, &self.reference) / number(&self.setting["length"])?)
    }

    /// Returns the error that a plan is asked for, a part of the largest displacement of the marker, for a distance of `wanted` times the
    /// length; at most the loosest that a scene may ask for.
    fn planned_error(&self, wanted: f64) -> Result<f64> {
        let start = *self.reference.first().context("expected a reference")?;
        let largest = largest_distance(&vec![start; self.reference.len()], &self.reference);
        let error = wanted * number(&self.setting["length"])? / largest;
        Ok(error.min(LOOSEST))
    }

    /// Returns the error of the marker's motion against the reference.
    fn error_of(&self, ran: &Ran) -> Result<f64> {
        self.error(&ran.table.marker(text(&self.setting["marker"])?)?)
    }

    /// Holds the product's finest run against the reference.
    fn confirm(&self, bench: &Bench, scenes: &mut Csv) -> Result<()> {
        let (name, setting) = (&self.case.name, &self.setting);
        let [elements, tolerance] = numbers(&setting["finest"])?[..] else {
            anyhow::bail!("expected elements and tolerance of the finest run");
        };
        let finest = self.case.run(&(self.counts(elements)?, tolerance))?;
        let ran = bench.run(&format!("peers, {name}, finest"), &[finest])?;
        let confirmed = self.error_of(&ran.into_iter().next().context("expected a run")??)?;
        let [file, marker, source] = ["scene", "marker", "source"].map(|key| text(&setting[key]));
        let (file, marker, source) = (file?, marker?, source?);
        let keys = ["stop_time", "every", "length", "runs"];
        let [stop, every, length, runs] = keys.map(|key| &setting[key]);
        scenes.row(&[
            name, &file, &marker, stop, every, length, &source, &confirmed, runs,
        ]);
        Ok(())
    }

    /// Elements of every cable: as many times more as it is longer.
    fn counts(&self, elements: f64) -> Result<Vec<u32>> {
        let shares = numbers(&self.setting["shares"])?;
        let shares = if shares.is_empty() { vec![1.0] } else { shares };
        Ok(shares
            .iter()
            .map(|share| (share * elements) as u32)
            .collect())
    }

    /// Runs all points of Exudyn and all plans in rounds. Of a plan, the error wanted is all that is given.
    fn measure(&self, bench: &Bench, exudyn: &mut Server, csv: &mut Csv) -> Result<()> {
        let points = self.setting["points"].as_array();
        let points = points.context("expected points")?;
        let choices = ERRORS.map(|wanted| {
            let error = self.planned_error(wanted)?;
            chosen(&self.case.plan(bench, error)?)
        });
        let choices = choices.into_iter().collect::<Result<Vec<Choice>>>()?;
        let runs = choices.iter().map(|choice| self.case.run(choice));
        let runs = runs.collect::<Result<Vec<_>>>()?;
        let mut others = vec![Timed::default(); points.len()];
        let mut owns = vec![Timed::default(); runs.len()];
        for round in 1..=ROUNDS {
            for (point, timed) in points.iter().zip(&mut others) {
                let answer = exudyn.run(&options(bench, &self.setting, point)?)?;
                timed.error = self.error(&answer.path)?;
                timed.cpu_times.push(answer.cpu_time);
            }
            let title = format!("peers, {}, round {round} of {ROUNDS}", self.case.name);
            for (outcome, timed) in bench.run(&title, &runs)?.into_iter().zip(&mut owns) {
                let ran = outcome?;
                timed.error = self.error_of(&ran)?;
                timed.cpu_times.push(ran.cpu_time);
                timed.method = ran.method().to_owned();
            }
        }
        for (point, timed) in points.iter().zip(&others) {
            self.write_point(point, timed, csv)?;
        }
        for ((wanted, choice), timed) in ERRORS.iter().zip(&choices).zip(&owns) {
            self.write_plan(*wanted, choice, timed, csv);
        }
        Ok(())
    }

    fn write_point(&self, point: &Value, timed: &Timed, csv: &mut Csv) -> Result<()> {
        let models = [("heavy", "heavy nodes"), ("rigid", "rigid")];
        let apart = models.iter().find(|(key, _)| point.get(key).is_some());
        let model = apart.map_or("cables", |(_, model)| model);
        let mesh = mesh(&self.counts(number(&point["elements"])?)?);
        let (words, time, none) = (described(point)?, median(&timed.cpu_times), &"");
        csv.row(&[
            &self.case.name,
            &"Exudyn",
            &model,
            &mesh,
            &words,
            none,
            none,
            none,
            &timed.error,
            &time,
        ]);
        Ok(())
    }

    fn write_plan(&self, wanted: f64, choice: &Choice, timed: &Timed, csv: &mut Csv) {
        let (mesh, time, none) = (mesh(&choice.0), median(&timed.cpu_times), &"");
        csv.row(&[
            &self.case.name,
            &"Flexbody",
            none,
            &mesh,
            none,
            &wanted,
            &choice.1,
            &timed.method,
            &timed.error,
            &time,
        ]);
    }
}

/// Collects the options of a run of Exudyn: those of all runs of a scene, and its own.
///
/// # Errors
/// A setting is missing.
pub fn options(bench: &Bench, setting: &Value, point: &Value) -> Result<Value> {
    let mut all = json!({ "scene": bench.workspace().path(text(&setting["scene"])?) });
    for key in ["marker", "stop_time", "every", "shares"] {
        if let Some(value) = setting.get(key) {
            all[key] = value.clone();
        }
    }
    for options in [&setting["options"], point] {
        for (key, option) in options.as_object().into_iter().flatten() {
            all[key] = option.clone();
        }
    }
    Ok(all)
}

/// Elements of cables in words.
fn mesh(counts: &[u32]) -> String {
    let words = counts.iter().map(|count| match count {
        0 => "rigid".to_owned(),
        count => count.to_string(),
    });
    words.collect::<Vec<_>>().join(" + ")
}

/// Describes the settings of Exudyn that differ from its defaults.
///
/// # Errors
/// A setting has another form.
pub fn described(options: &Value) -> Result<String> {
    const APART: &str = "elements error cpu_time heavy rigid step solver";
    let mut words = format!(
        "{}; step {:.2e}",
        text(&options["solver"])?,
        number(&options["step"])?
    );
    for (key, value) in options.as_object().into_iter().flatten() {
        if !APART.split(' ').any(|apart| apart == key) {
            words += &format!("; {key} {}", value.to_string().trim_matches('"'));
        }
    }
    Ok(words)
}
