//! Plates beside Exudyn's thin plate: error against CPU time over motions and equilibria, and what the product costs on ever larger meshes.

mod problems;
mod size;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::bench::{Bench, Run};
use super::csv::Csv;
use super::numbers::{Path, distance, largest, largest_distance, median, number, path};
use super::server::{PLATES, Server};
use problems::{Answer, Motion, Problem, problems};

/// The product's tolerances of motions.
const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
/// Exudyn's steps (s), tolerances of Newton's method and spectral radii of motions.
const STEPS: [f64; 5] = [1e-2, 5e-3, 2e-3, 1e-3, 5e-4];
const NEWTON: [f64; 3] = [1e-2, 1e-3, 1e-4];
const RADII: [f64; 2] = [0.6, 0.9];
/// The first of these steps that runs on all meshes, and the step of settings that run on the coarsest mesh alone, s.
const FIRST_STEP: usize = 2;
const TRIED_STEP: f64 = 1e-3;
/// Tolerances of Newton's method of equilibria.
const STATIC_NEWTON: [f64; 2] = [1e-2, 1e-3];
/// What settings of equilibria are called, which nobody chooses.
const PLAIN: &str = "as it comes";
/// Rounds of timed runs; what is so many times dearer than something as good runs once, and so does what takes longer, s.
const ROUNDS: usize = 3;
const DEARER: f64 = 1.3;
const LONG: f64 = 1.0;

/// Paths of the points of a problem.
type Paths = Vec<Path<3>>;

/// A choice of the product.
#[derive(Clone, Copy)]
struct Choice {
    elements: u32,
    method: &'static str,
    /// Nothing of equilibria.
    tolerance: Option<f64>,
}

/// A choice that is timed.
struct Timed {
    program: &'static str,
    method: &'static str,
    elements: u32,
    settings: String,
    error: f64,
    /// Error at the end of a motion alone.
    end_error: Option<f64>,
    cpu_times: Vec<f64>,
}

/// A problem with the answer of the finest mesh.
struct Case {
    problem: Problem,
    finest: Paths,
}

/// Measures the chart.
///
/// # Errors
/// A run fails, or a file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let mut exudyn = Server::start(bench.workspace(), PLATES)?;
    let header = "problem,program,method,elements,settings,error,end_error,cpu_time_s";
    let mut csv = Csv::new(bench, "plates", header);
    let header = "problem,answer,own_mesh,before,own_error,exudyn_mesh,exudyn_error,exudyn_cpu_time_s,settings";
    let mut references = Csv::new(bench, "plates_references", header);
    for problem in problems() {
        let (case, before) = Case::new(bench, problem)?;
        let others = case.sweep(&mut exudyn)?;
        case.write_reference(before, &others, &mut references)?;
        let others = worth_it(others);
        for timed in case.rounds(bench, &mut exudyn, others)? {
            let end = timed.end_error.map(|error| error.to_string());
            csv.row(&[
                &case.problem.name,
                &timed.program,
                &timed.method,
                &case.problem.mesh_name(timed.elements),
                &timed.settings,
                &timed.error,
                &end.unwrap_or_default(),
                &median(&timed.cpu_times),
            ]);
        }
    }
    csv.save()?;
    references.save()?;
    size::measure(bench)
}

/// Leaves out what is dearer than something as good.
fn worth_it(mut found: Vec<(Timed, Value)>) -> Vec<(Timed, Value)> {
    let seen = |timed: &Timed| (timed.error, timed.end_error, timed.cpu_times[0]);
    let tried: Vec<_> = found.iter().map(|(timed, _)| seen(timed)).collect();
    found.retain(|(timed, _)| {
        let (error, end, time) = seen(timed);
        !tried.iter().any(|(other, other_end, other_time)| {
            *other <= error && *other_end <= end && DEARER * other_time < time
        })
    });
    found
}

/// Describes Exudyn's settings: all that are told, in the order of their names.
fn described(settings: &Value) -> Result<String> {
    let mut words = Vec::new();
    for (key, value) in settings.as_object().context("expected settings")? {
        words.push(match key.as_str() {
            "step" => format!("step {:.2e}", number(value)?),
            _ => format!(
                "{} {}",
                key.replace('_', " "),
                value.to_string().trim_matches('"')
            ),
        });
    }
    Ok(words.join("; "))
}

/// Settings with some others in their place.
fn with(settings: &Value, others: &[(&str, Value)]) -> Value {
    let mut all = settings.clone();
    for (key, value) in others {
        all[*key] = value.clone();
    }
    all
}

/// Settings of motions on a mesh: all on the coarsest one.
fn moving_settings(is_coarsest: bool) -> Vec<Value> {
    let plain = |step: f64, tolerance: f64, radius: f64| json!({ "integration": 1, "newton": "modified", "newton_tolerance": tolerance, "rho": radius, "step": step });
    let steps = if is_coarsest {
        &STEPS[..]
    } else {
        &STEPS[FIRST_STEP..]
    };
    let tolerances = if is_coarsest {
        &NEWTON[..]
    } else {
        &NEWTON[..1]
    };
    let mut all = Vec::new();
    for step in steps {
        for tolerance in tolerances {
            all.extend(RADII.map(|radius| plain(*step, *tolerance, radius)));
        }
    }
    if is_coarsest {
        let tried = plain(TRIED_STEP, NEWTON[0], RADII[0]);
        all.push(with(&tried, &[("newton", json!("full"))]));
        all.extend(dearer(&tried));
    }
    all
}

/// Settings of equilibria on a mesh: all on the coarsest one.
fn static_settings(load_steps: &[u32], is_coarsest: bool) -> Vec<Value> {
    let mut all = Vec::new();
    for parts in load_steps {
        let plain = |newton: &str, tolerance: f64| json!({ "integration": 1, "load_steps": parts, "newton": newton, "newton_tolerance": tolerance });
        for newton in ["full", "modified"] {
            all.extend(STATIC_NEWTON.map(|tolerance| plain(newton, tolerance)));
        }
        if is_coarsest {
            all.extend(dearer(&plain("full", STATIC_NEWTON[0])));
        }
    }
    all
}

/// Settings with full integration and with the dense solver.
fn dearer(settings: &Value) -> [Value; 2] {
    [("integration", json!(0)), ("linear", json!("dense"))].map(|other| with(settings, &[other]))
}

impl Case {
    /// Finds the answer of the finest mesh, and how far that of the one before is from it.
    fn new(bench: &Bench, problem: Problem) -> Result<(Self, f64)> {
        let choices = problem.meshes.finest.map(|elements| match problem.motion {
            Some(Motion {
                method, tightest, ..
            }) => Choice::moving(elements, method, tightest),
            None => Choice::still(elements),
        });
        let title = format!("plates, {}, converged", problem.name);
        let mut case = Self {
            problem,
            finest: Vec::new(),
        };
        let mut found = case.take(bench, &title, &choices)?.into_iter();
        let (finest, coarser) = (found.next(), found.next());
        let (finest, _) = finest.context("expected a run")?;
        let (coarser, _) = coarser.context("expected two runs")?;
        case.finest = finest;
        let before = case.apart(&coarser)?;
        Ok((case, before))
    }

    /// Runs choices of the product: paths and CPU times, s.
    fn take(&self, bench: &Bench, title: &str, choices: &[Choice]) -> Result<Vec<(Paths, f64)>> {
        let points = 0..self.problem.points.len();
        if let Some(motion) = self.problem.motion {
            let runs: Vec<Run> = choices.iter().map(|c| self.run(motion, c)).collect();
            let mut all = Vec::new();
            for outcome in bench.run(title, &runs)? {
                let ran = outcome?;
                // Without the start.
                let path = |k| Ok(ran.table.marker(&Problem::marker(k))?.split_off(1));
                let paths = points.clone().map(path).collect::<Result<_>>()?;
                all.push((paths, ran.cpu_time));
            }
            return Ok(all);
        }
        let mut all = Vec::new();
        for choice in choices {
            let scene = self.problem.scene(choice.elements);
            let report = bench.studies(&["statics"], Some(&scene))?;
            let path = |k| {
                let place = &report["places"][Problem::marker(k)];
                let [x, y, z] = [0, 1, 2].map(|axis| number(&place[axis]));
                Ok(vec![[x?, y?, z?]])
            };
            let paths = points.clone().map(path).collect::<Result<_>>()?;
            all.push((paths, number(&report["cpu_time"])?));
        }
        eprintln!("{title}: {} equilibria", choices.len());
        Ok(all)
    }

    /// A run of the product.
    fn run(&self, motion: Motion, choice: &Choice) -> Run {
        let scene = self.problem.scene(choice.elements);
        let run = Run::new(&scene, motion.stop, motion.every).integrator(choice.method);
        choice.tolerance.into_iter().fold(run, Run::tolerance)
    }

    /// Distance of paths from those of the finest mesh, as errors are measured.
    fn apart(&self, paths: &Paths) -> Result<f64> {
        if let Answer::Deflection(..) = self.problem.answer {
            return Ok((deflection(paths)? / deflection(&self.finest)? - 1.0).abs());
        }
        let pairs = paths.iter().zip(&self.finest);
        let most = largest(pairs.map(|(own, fine)| largest_distance(own, fine)));
        Ok(most / self.problem.length)
    }

    /// Error of paths.
    fn error(&self, paths: &Paths) -> Result<f64> {
        match &self.problem.answer {
            Answer::Converged => self.apart(paths),
            Answer::Place(_, place) => Ok(distance(last(paths, 0)?, *place) / self.problem.length),
            Answer::Deflection(_, exact) => Ok((deflection(paths)? / exact - 1.0).abs()),
        }
    }

    /// Error at the end of a motion.
    fn end_error(&self, paths: &Paths) -> Result<Option<f64>> {
        if self.problem.motion.is_none() {
            return Ok(None);
        }
        let mut most = 0.0_f64;
        for point in 0..paths.len() {
            most = most.max(distance(last(paths, point)?, last(&self.finest, point)?));
        }
        Ok(Some(most / self.problem.length))
    }

    /// Exudyn's settings on all meshes, each run once. What does not converge is left out.
    fn sweep(&self, exudyn: &mut Server) -> Result<Vec<(Timed, Value)>> {
        let mut found = Vec::new();
        for (elements, settings) in self.settings() {
            let answer = exudyn.ask(&self.problem.options(elements, &settings))?;
            if answer["good"] != json!(true) {
                continue;
            }
            let paths = answer["paths"].as_array().context("expected paths")?;
            let paths = paths.iter().map(path).collect::<Result<Paths>>()?;
            let timed = Timed {
                program: "Exudyn",
                method: "swept",
                elements,
                settings: described(&settings)?,
                error: self.error(&paths)?,
                end_error: self.end_error(&paths)?,
                cpu_times: vec![number(&answer["cpu_time"])?],
            };
            found.push((timed, settings));
        }
        Ok(found)
    }

    /// Exudyn's settings by the number of elements.
    fn settings(&self) -> Vec<(u32, Value)> {
        let mut all = Vec::new();
        for (index, elements) in self.problem.meshes.exudyn.iter().enumerate() {
            let own = match self.problem.motion {
                Some(_) => moving_settings(index == 0),
                None => static_settings(self.problem.load_steps, index == 0),
            };
            all.extend(own.into_iter().map(|settings| (*elements, settings)));
        }
        all
    }

    /// Writes how far the finest meshes are from the answer: of Exudyn the best of its settings there.
    fn write_reference(&self, before: f64, others: &[(Timed, Value)], csv: &mut Csv) -> Result<()> {
        let meshes = self.problem.meshes;
        let finest = meshes.exudyn.last().context("expected meshes")?;
        let there = others.iter().map(|(timed, _)| timed);
        let there = there.filter(|timed| timed.elements == *finest);
        let best = there.min_by(|a, b| a.error.total_cmp(&b.error));
        let best = best.context("expected a run of Exudyn on its finest mesh that converges")?;
        let (answer, own) = match &self.problem.answer {
            Answer::Converged => ("converged", String::new()),
            Answer::Place(name, _) | Answer::Deflection(name, _) => {
                (*name, self.error(&self.finest)?.to_string())
            }
        };
        csv.row(&[
            &self.problem.name,
            &answer,
            &self.problem.mesh_name(meshes.finest[0]),
            &before,
            &own,
            &self.problem.mesh_name(*finest),
            &best.error,
            &best.cpu_times[0],
            &self.settings().len(),
        ]);
        Ok(())
    }

    /// The product's choices.
    fn choices(&self) -> Vec<Choice> {
        let mut all = Vec::new();
        for elements in self.problem.meshes.own {
            let Some(motion) = self.problem.motion else {
                all.push(Choice::still(*elements));
                continue;
            };
            for method in ["auto", motion.method] {
                all.extend(TOLERANCES.map(|t| Choice::moving(*elements, method, t)));
            }
        }
        all
    }

    /// Runs everything in rounds, that of the sweep of Exudyn included.
    fn rounds(
        &self,
        bench: &Bench,
        exudyn: &mut Server,
        mut others: Vec<(Timed, Value)>,
    ) -> Result<Vec<Timed>> {
        let name = &self.problem.name;
        let title = |round: usize| format!("plates, {name}, round {round} of {ROUNDS}");
        let choices = self.choices();
        let first = self.take(bench, &title(1), &choices)?;
        let mut owns = Vec::new();
        for (choice, (paths, time)) in choices.into_iter().zip(first) {
            owns.push((self.timed(choice, &paths, time)?, choice));
        }
        for round in 2..=ROUNDS {
            for (timed, settings) in &mut others {
                if timed.is_short() {
                    let options = self.problem.options(timed.elements, settings);
                    let answer = exudyn.ask(&options)?;
                    timed.cpu_times.push(number(&answer["cpu_time"])?);
                }
            }
            let mut repeated: Vec<_> = owns.iter_mut().filter(|own| own.0.is_short()).collect();
            let choices: Vec<Choice> = repeated.iter().map(|own| own.1).collect();
            let found = self.take(bench, &title(round), &choices)?;
            for (own, (_, time)) in repeated.iter_mut().zip(found) {
                own.0.cpu_times.push(time);
            }
        }
        let owns = owns.into_iter().map(|(timed, _)| timed);
        Ok(owns
            .chain(others.into_iter().map(|other| other.0))
            .collect())
    }

    /// The first run of a choice.
    fn timed(&self, choice: Choice, paths: &Paths, cpu_time: f64) -> Result<Timed> {
        let settings = choice.tolerance.map_or(PLAIN.to_owned(), |tolerance| {
            format!("{}; tolerance {tolerance:e}", choice.method)
        });
        Ok(Timed {
            program: "Flexbody",
            method: choice.method,
            elements: choice.elements,
            settings,
            error: self.error(paths)?,
            end_error: self.end_error(paths)?,
            cpu_times: vec![cpu_time],
        })
    }
}

/// Last place of a point, m.
fn last(paths: &Paths, point: usize) -> Result<[f64; 3]> {
    let path = paths.get(point).context("expected more points")?;
    path.last().copied().context("expected places of a point")
}

/// Deflection of the first point, m.
fn deflection(paths: &Paths) -> Result<f64> {
    Ok(last(paths, 0)?[2])
}

impl Choice {
    /// A motion.
    fn moving(elements: u32, method: &'static str, tolerance: f64) -> Self {
        let tolerance = Some(tolerance);
        Self {
            elements,
            method,
            tolerance,
        }
    }

    /// An equilibrium.
    fn still(elements: u32) -> Self {
        Self {
            elements,
            method: "equilibrium",
            tolerance: None,
        }
    }
}

impl Timed {
    /// Whether it is repeated.
    fn is_short(&self) -> bool {
        self.cpu_times[0] < LONG
    }
}
