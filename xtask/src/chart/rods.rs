//! Rods in space beside Exudyn's geometrically exact beam: error against CPU time, each program against its own converged answer.

use std::time::Duration;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, Ran, Run};
use super::csv::Csv;
use super::numbers::{Path, largest_distance, median, number, text};
use super::peers::{described, options};
use super::server::{EXUDYN, Server};
use crate::table::Table;

/// Scenes with what Exudyn does best there and its converged answers, made by `lab/exudyn/rods.py`.
const SETTINGS: &str = "lab/exudyn/rods.json";
/// Rounds of timed runs.
const ROUNDS: usize = 3;
/// The product's meshes, methods and tolerances.
const MESHES: [u32; 5] = [2, 4, 8, 16, 32];
const METHODS: [&str; 4] = ["auto", "rk4", "dopri853", "radau"];
const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
/// Elements and tolerance of converged runs; half the elements tell what the mesh leaves.
const FINEST: u32 = 64;
const CONVERGED: f64 = 1e-7;
/// A run that takes longer is not repeated, and one that takes much longer is given up, s.
const LONG: f64 = 0.3;
const MOST: Duration = Duration::from_secs(2);

/// A scene for both programs.
struct Case {
    name: String,
    setting: Value,
    scene: Value,
}

/// A run that is repeated.
struct Timed {
    program: &'static str,
    elements: u64,
    settings: String,
    error: f64,
    cpu_times: Vec<f64>,
}

/// Measures.
pub fn measure(bench: &Bench) -> Result<()> {
    let mut exudyn = Server::start(bench.workspace(), EXUDYN)?;
    let header = "scene,program,elements,settings,error,cpu_time_s";
    let mut csv = Csv::new(bench, "rods", header);
    let header = "scene,stiffer,apart,own_mesh,exudyn_mesh,exudyn_step,sweep_runs";
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
        let own = case.converge(bench, &mut models)?;
        for timed in case.runs(bench, &mut exudyn, &own)? {
            csv.row(&[
                &case.name,
                &timed.program,
                &timed.elements,
                &timed.settings,
                &timed.error,
                &median(&timed.cpu_times),
            ]);
        }
    }
    csv.save()?;
    models.save()
}

impl Case {
    /// A run of the product.
    fn run(&self, elements: u32, method: &str, tolerance: f64) -> Result<Run> {
        let mut scene = self.scene.clone();
        scene["bodies"][0]["elements"] = json!(elements);
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

    /// The product's converged answer, held against Exudyn's with ever less shear and rotary inertia.
    fn converge(&self, bench: &Bench, csv: &mut Csv) -> Result<Path<3>> {
        let (method, tolerance) = (&self.setting["finest_method"], CONVERGED);
        let runs = [FINEST, FINEST / 2].map(|n| self.run(n, text(method)?, tolerance));
        let runs = runs.into_iter().collect::<Result<Vec<_>>>()?;
        let title = format!("rods, {}, converged", self.name);
        let mut paths = Vec::new();
        for ran in bench.run(&title, &runs)? {
            paths.push(self.path(&ran?)?);
        }
        let own_mesh = self.apart(&paths[0], &paths[1])?;
        let references = self.setting["references"].as_array();
        for reference in references.context("expected references")? {
            let apart = self.apart(&self.reference(bench, &reference["file"])?, &paths[0])?;
            let [stiffer, mesh, step] = ["stiffer", "mesh", "step"].map(|key| &reference[key]);
            let runs = &self.setting["runs"];
            csv.row(&[&self.name, stiffer, &apart, &own_mesh, mesh, step, runs]);
        }
        Ok(paths.swap_remove(0))
    }

    /// Runs everything in rounds. What fails or takes too long is left out.
    fn runs(&self, bench: &Bench, exudyn: &mut Server, own: &Path<3>) -> Result<Vec<Timed>> {
        let points = self.setting["points"].as_array();
        let points = points.context("expected points")?;
        let reference = self.reference(bench, &self.setting["reference"])?;
        let mut others = Vec::new();
        let mut owns = self.first(bench, own)?;
        for round in 1..=ROUNDS {
            for (index, point) in points.iter().enumerate() {
                let answer = exudyn.run(&options(bench, &self.setting, point)?)?;
                if round == 1 {
                    others.push(Timed {
                        program: "Exudyn",
                        elements: point["elements"].as_u64().context("expected elements")?,
                        settings: described(point)?,
                        error: self.apart(&answer.path, &reference)?,
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
                own.0.cpu_times.push(outcome?.cpu_time);
            }
        }
        others.extend(owns.into_iter().map(|own| own.0));
        Ok(others)
    }

    /// Errors of the product, and which runs reach the end in time.
    fn first(&self, bench: &Bench, own: &Path<3>) -> Result<Vec<(Timed, Run)>> {
        let mut choices = Vec::new();
        for method in METHODS {
            for elements in MESHES {
                choices.extend(TOLERANCES.map(|tolerance| (elements, method, tolerance)));
            }
        }
        let run = |(n, method, tolerance): &(u32, &str, f64)| {
            Ok(self.run(*n, method, *tolerance)?.within(MOST))
        };
        let runs = choices.iter().map(run).collect::<Result<Vec<_>>>()?;
        let title = format!("rods, {}, first", self.name);
        let mut found = Vec::new();
        for ((outcome, run), choice) in bench.run(&title, &runs)?.into_iter().zip(runs).zip(choices)
        {
            let (elements, method, tolerance) = choice;
            let Ok(ran) = outcome else {
                continue;
            };
            let timed = Timed {
                program: "Flexbody",
                elements: elements.into(),
                settings: format!("{method}; tolerance {tolerance:e}"),
                error: self.apart(&self.path(&ran)?, own)?,
                cpu_times: vec![ran.cpu_time],
            };
            found.push((timed, run));
        }
        Ok(found)
    }
}
