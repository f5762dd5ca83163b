//! Rods and beams in space beside Exudyn's geometrically exact beam: error against CPU time, each program against its own converged
//! answer. Beams solve Exudyn's equations, so that their distance from its converged answer is told as well.

use std::time::Duration;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, Ran, Run};
use super::csv::Csv;
use super::numbers::{Path, largest_distance, median, number, text};
use super::peers::{described, options};
use super::server::{ELASTICA, EXUDYN, Server};
use crate::table::Table;

/// Scenes with what Exudyn does best there and its converged answers, made by `crates/studies/exudyn/rods.py`.
const SETTINGS: &str = "crates/studies/exudyn/rods.json";
/// Rounds of timed runs after the first.
const ROUNDS: usize = 2;
/// The product's meshes and tolerances.
const MESHES: [u32; 6] = [2, 4, 8, 12, 17, 32];
const TOLERANCES: [f64; 2] = [1e-3, 1e-4];
/// Element models, for each of which `crates/studies/exudyn/space.py` has a section with the same properties.
const MODELS: [&str; 2] = ["rod", "beam"];
/// Shear factors of beams, as those of Exudyn.
const SHEAR: [f64; 2] = [5.0 / 6.0; 2];
/// Elements of converged runs; half of them tell what the mesh leaves.
const FINEST: u32 = 64;
/// A run that takes longer is not repeated, and one that takes much longer is given up, s.
const LONG: f64 = 0.3;
const MOST: Duration = Duration::from_secs(3);

/// A scene for all programs.
struct Case {
    name: String,
    setting: Value,
    scene: Value,
}

/// A run that is repeated.
struct Timed {
    program: &'static str,
    model: &'static str,
    elements: u64,
    settings: String,
    /// Distance from the program's own converged answer, and of what solves Exudyn's equations from Exudyn's.
    error: f64,
    from_exudyn: Option<f64>,
    cpu_times: Vec<f64>,
}

/// Converged answers.
struct Converged {
    /// Paths of the product, one for every model.
    own: [Path<3>; MODELS.len()],
    exudyn: Path<3>,
}

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let mut exudyn = Server::start(bench.workspace(), EXUDYN)?;
    let mut elastica = Server::start(bench.workspace(), ELASTICA)?;
    let header = "scene,program,model,elements,settings,error,from_exudyn,cpu_time_s";
    let mut csv = Csv::new(bench, "rods", header);
    let header = "scene,model,stiffer,apart,own_mesh,exudyn_mesh,exudyn_step,sweep_runs";
    let mut models = Csv::new(bench, "rods_models", header);
    let settings = bench.json(SETTINGS)?;
    for (name, setting) in settings.as_object().context("expected scenes")? {
        let scene = bench.json(text(&setting["scene"])?)?;
        let (name, setting) = (name.clone(), setting.clone());
        let case = Case {
            name,
            setting,
            scene,
        };
        let converged = case.converge(bench, &mut models)?;
        let mut all = case.elastica(bench, &mut elastica, &converged)?;
        all.extend(case.runs(bench, &mut exudyn, &converged)?);
        for timed in all {
            let from_exudyn = timed.from_exudyn.map(|d| d.to_string());
            csv.row(&[
                &case.name,
                &timed.program,
                &timed.model,
                &timed.elements,
                &timed.settings,
                &timed.error,
                &from_exudyn.unwrap_or_default(),
                &median(&timed.cpu_times),
            ]);
        }
    }
    csv.save()?;
    models.save()
}

impl Case {
    /// A run of the product.
    fn run(&self, model: &str, elements: u32, method: &str, tolerance: f64) -> Result<Run> {
        let mut scene = self.scene.clone();
        let bodies = scene["bodies"].as_array_mut().context("expected bodies")?;
        for (index, body) in bodies.iter_mut().enumerate() {
            if body["element"] == "rigid" {
                continue;
            }
            let share = self.setting["shares"][index].as_f64().unwrap_or(1.0);
            body["element"] = json!(model);
            body["elements"] = json!((f64::from(elements) * share).round().max(1.0) as u32);
            let section = body["section"].as_object_mut();
            let section = section.context("expected a section")?;
            match model {
                "beam" => {
                    let factors = section.entry("shear_factors");
                    factors.or_insert(json!(SHEAR));
                }
                _ => {
                    section.remove("shear_factors");
                }
            }
        }
        let [stop, every] = ["stop_time", "every"].map(|key| number(&self.setting[key]));
        let run = Run::new(&scene, stop?, every?);
        Ok(run.integrator(method).tolerance(tolerance))
    }

    /// Where the marker was.
    fn path(&self, ran: &Ran) -> Result<Path<3>> {
        ran.table.marker(text(&self.setting["marker"])?)
    }

    /// Largest distance of two paths, divided by the length.
    fn apart(&self, a: &Path<3>, b: &Path<3>) -> Result<f64> {
        Ok(largest_distance(a, b) / number(&self.setting["length"])?)
    }

    /// A converged answer of Exudyn.
    fn reference(&self, bench: &Bench, file: &Value) -> Result<Path<3>> {
        Table::read(&bench.workspace().path(text(file)?))?.curve(["x", "y", "z"])
    }

    /// Converged answers, the product's held against Exudyn's: of rods with ever less shear and rotary inertia.
    fn converge(&self, bench: &Bench, csv: &mut Csv) -> Result<Converged> {
        let references = self.setting["references"].as_array();
        let references = references.context("expected references")?;
        let mut own: [Path<3>; MODELS.len()] = Default::default();
        for (model, own) in MODELS.iter().zip(&mut own) {
            let finest = &self.setting["finest"][*model];
            let (method, tolerance) = (text(&finest["method"])?, number(&finest["tolerance"])?);
            let runs = [FINEST, FINEST / 2].map(|n| self.run(model, n, method, tolerance));
            let runs = runs.into_iter().collect::<Result<Vec<_>>>()?;
            let title = format!("rods, {}, converged {model}", self.name);
            let mut paths = Vec::new();
            for ran in bench.run(&title, &runs)? {
                paths.push(self.path(&ran?)?);
            }
            let own_mesh = self.apart(&paths[0], &paths[1])?;
            for reference in references.iter().take(if *model == "beam" { 1 } else { 3 }) {
                let apart = self.apart(&self.reference(bench, &reference["file"])?, &paths[0])?;
                let [stiffer, mesh, step] = ["stiffer", "mesh", "step"].map(|key| &reference[key]);
                let runs = &self.setting["runs"];
                csv.row(&[
                    &self.name, model, stiffer, &apart, &own_mesh, mesh, step, runs,
                ]);
            }
            *own = paths.swap_remove(0);
        }
        let exudyn = self.reference(bench, &self.setting["reference"])?;
        Ok(Converged { own, exudyn })
    }

    /// Runs everything in rounds. What fails or takes too long is left out.
    fn runs(
        &self,
        bench: &Bench,
        exudyn: &mut Server,
        converged: &Converged,
    ) -> Result<Vec<Timed>> {
        let points = self.setting["points"].as_array();
        let points = points.context("expected points")?;
        let mut others = Vec::new();
        let mut owns = self.first(bench, converged)?;
        for round in 1..=ROUNDS {
            for (index, point) in points.iter().enumerate() {
                let answer = exudyn.run(&options(bench, &self.setting, point)?)?;
                if round == 1 {
                    let error = self.apart(&answer.path, &converged.exudyn)?;
                    others.push(Timed {
                        program: "Exudyn",
                        model: "beam",
                        elements: point["elements"].as_u64().context("expected elements")?,
                        settings: described(point)?,
                        error,
                        from_exudyn: Some(error),
                        cpu_times: vec![],
                    });
                }
                others[index].cpu_times.push(answer.cpu_time);
            }
            let short = |own: &&mut (Timed, Run)| own.0.cpu_times[0] < LONG;
            let mut repeated: Vec<_> = owns.iter_mut().filter(short).collect();
            let runs: Vec<Run> = repeated.iter().map(|own| own.1.clone()).collect();
            let title = format!("rods, {}, round {round} of {ROUNDS}", self.name);
            for (outcome, own) in bench.run(&title, &runs)?.into_iter().zip(&mut repeated) {
                // It took too long this time.
                own.0.cpu_times.extend(outcome.ok().map(|ran| ran.cpu_time));
            }
        }
        others.extend(owns.into_iter().map(|own| own.0));
        Ok(others)
    }

    /// Errors of the product, and which runs reach the end in time.
    fn first(&self, bench: &Bench, converged: &Converged) -> Result<Vec<(Timed, Run)>> {
        let mut choices = Vec::new();
        for model in MODELS.iter().enumerate() {
            let methods = self.setting["methods"][model.1].as_array();
            for method in methods.context("expected methods")? {
                let method = text(method)?;
                for elements in MESHES {
                    choices.extend(TOLERANCES.map(|t| (model, elements, method, t)));
                }
            }
        }
        let run = |((_, model), n, method, tolerance): &((usize, &&str), u32, &str, f64)| {
            Ok(self.run(model, *n, method, *tolerance)?.within(MOST))
        };
        let runs = choices.iter().map(run).collect::<Result<Vec<_>>>()?;
        let title = format!("rods, {}, first", self.name);
        let mut found = Vec::new();
        for ((outcome, run), choice) in bench.run(&title, &runs)?.into_iter().zip(runs).zip(choices)
        {
            let ((index, model), elements, method, tolerance) = choice;
            let Ok(ran) = outcome else {
                continue;
            };
            let path = self.path(&ran)?;
            let from_exudyn = self.apart(&path, &converged.exudyn)?;
            let timed = Timed {
                program: "Flexbody",
                model,
                elements: elements.into(),
                settings: format!("{method}; tolerance {tolerance:e}"),
                error: self.apart(&path, &converged.own[index])?,
                from_exudyn: (*model == "beam").then_some(from_exudyn),
                cpu_times: vec![ran.cpu_time],
            };
            found.push((timed, run));
        }
        Ok(found)
    }

    /// Runs of PyElastica, once each: its rods solve Exudyn's equations, against whose answer they stand.
    fn elastica(
        &self,
        bench: &Bench,
        elastica: &mut Server,
        converged: &Converged,
    ) -> Result<Vec<Timed>> {
        let mut found = Vec::new();
        for point in self.setting["elastica"].as_array().into_iter().flatten() {
            let answer = elastica.run(&options(bench, &self.setting, point)?)?;
            let error = self.apart(&answer.path, &converged.exudyn)?;
            found.push(Timed {
                program: "PyElastica",
                model: "beam",
                elements: point["elements"].as_u64().context("expected elements")?,
                settings: format!("position Verlet; step {:.2e}", number(&point["step"])?),
                error,
                from_exudyn: Some(error),
                cpu_times: vec![answer.cpu_time],
            });
        }
        Ok(found)
    }
}
