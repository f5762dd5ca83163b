//! Reduced bodies beside Exudyn's floating frame with the same modes: error against CPU time, from the whole solid and from each
//! program's own converged answer.

use anyhow::{Context, Result};
use fmu_package::prepared;
use serde_json::{Value, json};

use super::bench::{Bench, Ran, Run};
use super::csv::Csv;
use super::numbers::{Path, distance, largest, largest_distance, median, number, path};
use super::peers::described;
use super::server::{EXUDYN, Server};
use crate::process::run_quietly;
use crate::python::Python;

/// A bracket that swings from two points, and places of its tip that a solid reaches.
const SCENE: &str = "reduced_bracket/scene.json";
const SOLID: &str = "reduced_bracket/case.json";
const MARKER: &str = "bracket.tip";
/// Writes the bracket with several numbers of modes, with second-order displacements and without.
const MODELS: &str = "crates/studies/exudyn/bracket.py";
/// Simulated time, time between points, s, and the size of the bracket, m.
const STOP_TIME: f64 = 1.0;
const EVERY: f64 = 0.05;
const SIZE: f64 = 0.36;
/// Numbers of modes.
const MODES: [u32; 4] = [3, 5, 9, 17];
/// Models of the product; the second one is that of Exudyn.
const ORDERS: [(&str, &str); 2] = [("second order", ""), ("linear", "_linear")];
/// The product's tolerances, its explicit methods, whose steps their stability sets at any tolerance, and its converged answers.
const TOLERANCES: [f64; 11] = [
    3e-2, 2e-2, 1e-2, 7e-3, 5e-3, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5,
];
const EXPLICIT: [(&str, f64); 2] = [("rk4", 1e-2), ("dopri853", 1e-2)];
const CONVERGED: (&str, f64) = ("radau", 1e-9);
/// Exudyn's steps between points, and those of its converged answers.
const STEPS: [u32; 9] = [10, 12, 14, 16, 18, 20, 28, 40, 100];
const FINEST: [u32; 2] = [500, 1000];
/// Exudyn's settings: tolerances of Newton's method and spectral radii with one or the other contractivity that renews a Jacobian.
const NEWTON: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
const RADII: [f64; 4] = [1.0, 0.9, 0.8, 0.6];
const CONTRACTIVITIES: [Option<f64>; 2] = [None, Some(0.2)];
/// What settings that nobody chose are called.
const PLAIN: &str = "as it comes";
/// Rounds of timed runs; what is so many times dearer than something as good runs once, and so does what takes longer, s.
const ROUNDS: usize = 5;
const DEARER: f64 = 1.2;
const LONG: f64 = 0.3;

/// The bracket with so many modes.
struct Case {
    modes: u32,
    scene: Value,
    /// Indices of points and places of the tip of the solid, m.
    solid: Vec<(usize, [f64; 3])>,
}

/// A choice that is timed.
struct Timed {
    program: &'static str,
    model: &'static str,
    /// Integrator of the product; whether Exudyn runs as it comes.
    method: &'static str,
    settings: String,
    /// Distances from the solid and from the program's own converged answer, over the size.
    error: f64,
    own_error: f64,
    cpu_times: Vec<f64>,
}

/// Converged answers.
struct Converged {
    /// Those of the product by models.
    own: [Path<3>; ORDERS.len()],
    exudyn: Path<3>,
}

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let mut exudyn = Server::start(bench.workspace(), EXUDYN)?;
    make_models(bench)?;
    let header = "modes,program,model,method,settings,error,own_error,cpu_time_s";
    let mut csv = Csv::new(bench, "reduced", header);
    let header = "modes,model,error,from_exudyn,exudyn_step,acceleration_s";
    let mut models = Csv::new(bench, "reduced_models", header);
    for modes in MODES {
        let case = Case::new(bench, modes)?;
        let converged = case.converge(bench, &mut exudyn, &mut models)?;
        for timed in case.runs(bench, &mut exudyn, &converged)? {
            csv.row(&[
                &modes,
                &timed.program,
                &timed.model,
                &timed.method,
                &timed.settings,
                &timed.error,
                &timed.own_error,
                &median(&timed.cpu_times),
            ]);
        }
    }
    csv.save()?;
    models.save()
}

/// Writes the files of the models beside the scenes of runs.
fn make_models(bench: &Bench) -> Result<()> {
    let python = Python::prepare_peers(bench.workspace())?;
    let folder = prepared(&bench.workspace().target("chart/models"))?.with_file_name("");
    let mut command = python.script(&bench.workspace().path(MODELS));
    run_quietly(
        command
            .arg(folder)
            .args(MODES.map(|modes| modes.to_string())),
    )
}

/// Exudyn's settings as they come.
fn plain(steps: u32) -> Value {
    json!({ "solver": "alpha", "step": EVERY / f64::from(steps), "linear": "dense" })
}

/// Exudyn's settings in the order in which they are tried, the first of every step as they come.
fn points() -> Vec<Value> {
    let mut all = Vec::new();
    for steps in STEPS {
        let plain = plain(steps);
        let mut add = |key: &[(&str, Value)]| {
            let mut point = plain.clone();
            for (key, value) in key {
                point[*key] = value.clone();
            }
            all.push(point);
        };
        add(&[]);
        add(&[("linear", json!("sparse"))]);
        for tolerance in NEWTON {
            let tolerance = ("newton_tolerance", json!(tolerance));
            add(&[tolerance.clone(), ("newton", json!("full"))]);
            add(&[tolerance.clone(), ("solver", json!("newmark"))]);
            for radius in RADII {
                for contractivity in CONTRACTIVITIES {
                    let radius = ("rho", json!(radius));
                    let mut keys = vec![tolerance.clone(), radius];
                    keys.extend(contractivity.map(|value| ("contractivity", json!(value))));
                    add(&keys);
                }
            }
        }
    }
    all
}

impl Case {
    fn new(bench: &Bench, modes: u32) -> Result<Self> {
        let mut scene = bench.case(SCENE)?;
        scene["outputs"] = json!([{ "kind": "position", "marker": MARKER }]);
        let solid = bench.case(SOLID)?;
        let claims = solid["claims"].as_array().context("expected claims")?;
        let claims = claims.iter().filter(|claim| claim["kind"] == "values");
        let places = claims.map(|claim| {
            let at = |axis: usize| number(&claim["values"][format!("{MARKER}.position[{axis}]")]);
            let index = (number(&claim["time"])? / EVERY).round() as usize;
            Ok((index, [at(1)?, at(2)?, at(3)?]))
        });
        Ok(Self {
            modes,
            scene,
            solid: places.collect::<Result<_>>()?,
        })
    }

    /// The scene with a model.
    fn with(&self, ending: &str) -> Value {
        let mut scene = self.scene.clone();
        scene["bodies"][0]["file"] = json!(format!("bracket_{}{ending}.safetensors", self.modes));
        scene
    }

    /// A run of the product.
    fn run(&self, ending: &str, (method, tolerance): (&str, f64)) -> Run {
        let run = Run::new(&self.with(ending), STOP_TIME, EVERY);
        run.integrator(method).tolerance(tolerance)
    }

    /// A run of Exudyn.
    fn peer(&self, bench: &Bench, point: &Value) -> Result<Value> {
        let mut options = point.clone();
        options["scene"] = json!(bench.write(&self.with(ORDERS[1].1))?);
        options["marker"] = json!(MARKER);
        options["stop_time"] = json!(STOP_TIME);
        options["every"] = json!(EVERY);
        Ok(options)
    }

    /// Largest distance from the solid, over the size.
    fn error(&self, path: &Path<3>) -> Result<f64> {
        let mut distances = Vec::new();
        for (index, place) in &self.solid {
            let found = path.get(*index).context("expected more points")?;
            distances.push(distance(*found, *place));
        }
        Ok(largest(distances) / SIZE)
    }

    /// Converged answers: Exudyn's from two steps, extrapolated, and those of the product, held against it.
    fn converge(&self, bench: &Bench, exudyn: &mut Server, csv: &mut Csv) -> Result<Converged> {
        let mut answers = Vec::new();
        for steps in FINEST {
            answers.push(exudyn.run::<3>(&self.peer(bench, &plain(steps))?)?.path);
        }
        let halved = largest_distance(&answers[0], &answers[1]) / SIZE;
        let pairs = answers[0].iter().zip(&answers[1]);
        let mean = |(coarse, fine): (&[f64; 3], &[f64; 3])| {
            [0, 1, 2].map(|k| fine[k] + (fine[k] - coarse[k]) / 3.0)
        };
        let peer: Path<3> = pairs.map(mean).collect();
        let mut own: [Path<3>; ORDERS.len()] = Default::default();
        for ((model, ending), own) in ORDERS.iter().zip(&mut own) {
            let title = format!("reduced, {} modes, converged, {model}", self.modes);
            let ran = bench
                .run(&title, &[self.run(ending, CONVERGED)])?
                .remove(0)?;
            *own = ran.table.marker(MARKER)?;
            let apart = largest_distance(own, &peer) / SIZE;
            let timed = bench.studies(&["dynamics"], Some(&self.with(ending)))?;
            let time = number(&timed["acceleration"])?;
            let error = self.error(own)?;
            csv.row(&[&self.modes, model, &error, &apart, &halved, &time]);
        }
        Ok(Converged { own, exudyn: peer })
    }

    /// Runs everything in rounds.
    fn runs(
        &self,
        bench: &Bench,
        exudyn: &mut Server,
        converged: &Converged,
    ) -> Result<Vec<Timed>> {
        let mut others = self.first(bench, exudyn, converged)?;
        let mut owns = self.own_choices();
        for round in 1..=ROUNDS {
            if round > 1 {
                for (timed, point) in &mut others {
                    let answer = exudyn.run::<3>(&self.peer(bench, point)?)?;
                    timed.cpu_times.push(answer.cpu_time);
                }
            }
            let short = |own: &&mut (usize, Timed, Run)| own.1.cpu_times.iter().all(|t| *t < LONG);
            let mut repeated: Vec<_> = owns.iter_mut().filter(short).collect();
            let runs: Vec<Run> = repeated.iter().map(|(_, _, run)| run.clone()).collect();
            let title = format!("reduced, {} modes, round {round} of {ROUNDS}", self.modes);
            for (outcome, (order, timed, _)) in
                bench.run(&title, &runs)?.into_iter().zip(&mut repeated)
            {
                let ran: Ran = outcome?;
                let path = ran.table.marker(MARKER)?;
                timed.error = self.error(&path)?;
                timed.own_error = largest_distance(&path, &converged.own[*order]) / SIZE;
                timed.cpu_times.push(ran.cpu_time);
            }
        }
        let owns = owns.into_iter().map(|(_, timed, _)| timed);
        Ok(others
            .into_iter()
            .map(|(timed, _)| timed)
            .chain(owns)
            .collect())
    }

    /// The product's choices, each with the index of its model.
    fn own_choices(&self) -> Vec<(usize, Timed, Run)> {
        let mut all = Vec::new();
        for (order, (model, ending)) in ORDERS.into_iter().enumerate() {
            let choices = TOLERANCES.map(|tolerance| ("auto", tolerance));
            for (method, tolerance) in choices.into_iter().chain(EXPLICIT) {
                let settings = format!("tolerance {tolerance:e}");
                let timed = Timed::new("Flexbody", model, method, settings);
                all.push((order, timed, self.run(ending, (method, tolerance))));
            }
        }
        all
    }

    /// Exudyn's settings as they come, and those that nothing else beats by much.
    fn first(
        &self,
        bench: &Bench,
        exudyn: &mut Server,
        converged: &Converged,
    ) -> Result<Vec<(Timed, Value)>> {
        let mut found = Vec::new();
        for point in points() {
            let answer = exudyn.ask(&self.peer(bench, &point)?)?;
            // Newton's method may fail.
            if answer["good"] != json!(true) {
                continue;
            }
            let path: Path<3> = path(&answer["path"])?;
            if path.len() != converged.exudyn.len() {
                continue;
            }
            let is_plain = STEPS.iter().any(|steps| point == plain(*steps));
            let method = if is_plain { PLAIN } else { "swept" };
            let mut timed = Timed::new("Exudyn", ORDERS[1].0, method, described(&point)?);
            timed.error = self.error(&path)?;
            timed.own_error = largest_distance(&path, &converged.exudyn) / SIZE;
            timed.cpu_times.push(number(&answer["cpu_time"])?);
            found.push((timed, point));
        }
        let tried: Vec<(f64, f64)> = found
            .iter()
            .map(|(timed, _)| (timed.own_error, timed.cpu_times[0]))
            .collect();
        found.retain(|(timed, _)| {
            let is_beaten = tried.iter().any(|(error, time)| {
                *error <= timed.own_error && DEARER * time < timed.cpu_times[0]
            });
            !is_beaten || timed.method == PLAIN
        });
        Ok(found)
    }
}

impl Timed {
    fn new(
        program: &'static str,
        model: &'static str,
        method: &'static str,
        settings: String,
    ) -> Self {
        Self {
            program,
            model,
            method,
            settings,
            error: f64::NAN,
            own_error: f64::NAN,
            cpu_times: Vec::new(),
        }
    }
}
