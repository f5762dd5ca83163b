//! What planned numbers of elements and tolerances are worth: true errors over the error wanted, CPU time over that of
//! the cheapest choice of a grid, the cost of a plan.

use std::collections::HashMap;
use std::time::Duration;

use anyhow::{Context, Result};

use super::bench::{Bench, Planned, REPEATS, Ran, Run, TooLong};
use super::csv::Csv;
use super::numbers::{largest, number, text};
use super::planned::{self, Case, Choice, ERRORS, chosen, counts};

const READY: &str = "boom cable_net cantilever crane double_pendulum flying_spaghetti four_bar hanging_cable \
                     kite_tether pendulum robot_arm slider_crank spin_up_beam travelling_load";
/// The grid: meshes as multiples of the coarsest, and tolerances.
const MESHES: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];
const TOLERANCES: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
/// Most a run may take, s: of the grid, planned, of the reference.
const MOST_GRID: f64 = 4.0;
const MOST_PLANNED: f64 = 60.0;
const MOST_FINE: f64 = 90.0;
/// How many times the dearest planned run a run of the grid may take besides its start, s: one that takes longer is no
/// rival.
const RIVAL: f64 = 1.5;
const START: f64 = 0.1;
/// References: how many times the most elements of the plans, and the least of their tolerances over how much, which
/// counts as no looser than `LOOSE`, and an integrator. The next is taken where one takes too long or fails.
const FINE: [(u32, f64, &str); 4] = [
    (4, 100.0, "auto"),
    (2, 100.0, "auto"),
    (2, 10.0, "auto"),
    (2, 10.0, "radau"),
];
const LOOSE: f64 = 1e-5;
const MOST_ELEMENTS: u32 = 1000;
const LEAST_TOLERANCE: f64 = 1e-10;
/// Choices of the grid that are timed in turns with the plan's.
const TIMED: usize = 3;
/// Runs that take longer are timed once, s.
const LONG: f64 = 0.5;

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let header = "scene,of,error,elements,tolerance,method,plan_runs,plan_cost,outputs,unsettled,worst,worst_output,\
                  worst_of_all,cpu_time_s,best_elements,best_tolerance,best_cpu_time_s,cpu_over_best,\
                  reference_elements,reference_tolerance";
    let mut csv = Csv::new(bench, "economy", header);
    for case in cases(bench)? {
        // One scene too dear for this machine is no reason to lose the others.
        if let Err(reason) = case.measure(bench, &mut csv) {
            eprintln!(
                "economy, {} of {}: left out: {reason:#}",
                case.name, case.of
            );
        }
    }
    csv.save()
}

/// All scenes, left to the planner.
fn cases(bench: &Bench) -> Result<Vec<Case>> {
    let mut cases = Vec::new();
    for name in READY.split(' ') {
        let scene = bench.json(&format!("scenes/{name}.json"))?;
        let (name, of) = (name.to_owned(), "ready");
        cases.push(Case { name, of, scene }.left_to_the_planner());
    }
    cases.extend(planned::peers(bench)?.into_iter().map(|(case, _)| case));
    Ok(cases)
}

impl Case {
    fn measure(&self, bench: &Bench, csv: &mut Csv) -> Result<()> {
        let title = format!("economy, {} of {}", self.name, self.of);
        let (mut plans, mut choices) = (Vec::new(), Vec::new());
        for error in ERRORS {
            plans.push(self.plan(bench, error)?);
            choices.push(chosen(&plans[plans.len() - 1])?);
        }
        let run = |choice: &Choice, most: f64| self.limited(&plans[0], choice, most);
        let runs: Result<Vec<Run>> = choices.iter().map(|c| run(c, MOST_PLANNED)).collect();
        let planned = bench.run(&title, &runs?)?;
        let planned = planned.into_iter().collect::<Result<Vec<Ran>>>()?;
        let (fine, reference) = self.fine(bench, &plans[0], &choices)?;
        let longest = largest(planned.iter().map(|ran| ran.cpu_time));
        let most = (RIVAL * longest + START).min(MOST_GRID);
        let grid = self.grid(bench, &plans[0], most)?;
        for (at, error) in ERRORS.into_iter().enumerate() {
            let (plan, ran, choice) = (&plans[at], &planned[at], &choices[at]);
            let outputs = outputs(plan, error)?;
            let errors = errors(&outputs, ran, &fine);
            let kept = errors
                .iter()
                .zip(&outputs)
                .filter(|(_, output)| output.is_kept);
            let worst = kept.max_by(|a, b| a.0.total_cmp(b.0));
            let is_good = |ran: &Ran| {
                let errors = self::errors(&outputs, ran, &fine);
                let mut kept = errors.iter().zip(&outputs).filter(|(_, o)| o.is_kept);
                worst.is_some() && kept.all(|(found, _)| *found <= error)
            };
            let mut good: Vec<&(Choice, Ran)> =
                grid.iter().filter(|(_, ran)| is_good(ran)).collect();
            good.sort_by(|a, b| a.1.cpu_time.total_cmp(&b.1.cpu_time));
            good.truncate(TIMED);
            let rivals: Vec<&Choice> = good.iter().map(|(choice, _)| choice).collect();
            let (own, best) = self.timed(bench, plan, choice, &rivals)?;
            let (best, best_time) = best.map_or((None, f64::NAN), |(c, time)| (Some(c), time));
            let sum = |choice: &Choice| choice.0.iter().sum::<u32>();
            let shown = |value: Option<f64>| value.unwrap_or(f64::NAN);
            let [runs, cost] = ["runs", "runs_cost"].map(|key| plan.report[key].as_f64());
            let unsettled = outputs.iter().filter(|output| !output.is_kept).count();
            csv.row(&[
                &self.name,
                &self.of,
                &error,
                &sum(choice),
                &choice.1,
                &ran.method(),
                &shown(runs),
                &shown(cost),
                &outputs.len(),
                &unsettled,
                &shown(worst.map(|(found, _)| found / error)),
                &worst.map_or("", |(_, output)| &output.name),
                &(largest(errors.iter().copied()) / error),
                &own,
                &shown(best.map(|c| f64::from(sum(c)))),
                &shown(best.map(|c| c.1)),
                &best_time,
                &(own / best_time),
                &sum(&reference),
                &reference.1,
            ]);
        }
        Ok(())
    }

    /// A run with a choice, with the inputs of a plan; one that takes longer than that, s, fails.
    fn limited(&self, plan: &Planned, choice: &Choice, most: f64) -> Result<Run> {
        let run = self.run(choice)?.inputs(plan.inputs.as_deref());
        Ok(run.within(Duration::from_secs_f64(most)))
    }

    /// Runs the reference of a scene, and returns it with its mesh and tolerance.
    fn fine(&self, bench: &Bench, plan: &Planned, planned: &[Choice]) -> Result<(Ran, Choice)> {
        let most = |cable: usize| planned.iter().map(move |(counts, _)| counts[cable]).max();
        let counts: Vec<u32> = (0..planned[0].0.len()).filter_map(most).collect();
        let tolerance = planned.iter().map(|choice| choice.1).fold(LOOSE, f64::min);
        let mut failure = anyhow::anyhow!("no reference");
        for (times, part, method) in FINE {
            let bending = counts.iter().zip(planned::counts(&plan.report, "fewest"));
            let bending = bending.map(|(n, least)| (*n).max(least));
            let finer = bending.map(|n| (times * n).min(MOST_ELEMENTS).max(n));
            let choice = (finer.collect(), (tolerance / part).max(LEAST_TOLERANCE));
            let title = format!("economy, {} of {}, reference", self.name, self.of);
            let run = self.limited(plan, &choice, MOST_FINE)?.integrator(method);
            let ran = bench.run(&title, &[run])?;
            match ran.into_iter().next().context("expected a run")? {
                Ok(ran) => return Ok((ran, choice)),
                Err(reason) => failure = reason,
            }
        }
        Err(failure)
    }

    /// All choices of the grid that run and take no longer than that, s.
    fn grid(&self, bench: &Bench, plan: &Planned, most: f64) -> Result<Vec<(Choice, Ran)>> {
        let fewest = counts(&plan.report, "fewest");
        let mut found = Vec::new();
        for tolerance in TOLERANCES {
            for times in MESHES {
                let choice = (fewest.iter().map(|n| times * n).collect(), tolerance);
                let title = format!("economy, {} of {}, grid", self.name, self.of);
                let ran = bench.run(&title, &[self.limited(plan, &choice, most)?])?;
                let ran = ran.into_iter().next().context("expected a run")?;
                let is_late = ran.as_ref().is_err_and(|reason| reason.is::<TooLong>());
                found.extend(ran.ok().map(|ran| (choice, ran)));
                // A finer mesh takes longer still.
                if is_late {
                    break;
                }
            }
        }
        Ok(found)
    }

    /// CPU time of a choice, and the quickest of its rivals with its own, all in turns, s.
    fn timed<'c>(
        &self,
        bench: &Bench,
        plan: &Planned,
        choice: &Choice,
        rivals: &[&'c Choice],
    ) -> Result<(f64, Option<(&'c Choice, f64)>)> {
        let all = [choice].into_iter().chain(rivals.iter().copied());
        let runs: Result<Vec<Run>> = all.map(|c| self.limited(plan, c, MOST_PLANNED)).collect();
        let title = format!("economy, {} of {}, timed", self.name, self.of);
        let mut times = Vec::new();
        for outcome in bench.repeat(&title, &runs?, REPEATS, LONG)? {
            times.push(outcome?.cpu_time);
        }
        let rivals = rivals.iter().copied().zip(times[1..].iter().copied());
        Ok((times[0], rivals.min_by(|a, b| a.1.total_cmp(&b.1))))
    }
}

/// An output that counts.
struct Output {
    name: String,
    scale: f64,
    skips_start: bool,
    /// Whether the plan says that it keeps the error wanted.
    is_kept: bool,
}

/// The outputs of a plan for an error that move at all.
fn outputs(plan: &Planned, error: f64) -> Result<Vec<Output>> {
    let outputs = plan.report["outputs"].as_array();
    let outputs = outputs.context("expected outputs")?.iter().map(|output| {
        Ok(Output {
            name: text(&output["name"])?.to_owned(),
            scale: number(&output["scale"])?,
            skips_start: output["skips_start"] == true,
            is_kept: output["settles"] == true
                && output["error"].as_f64().is_some_and(|said| said <= error),
        })
    });
    outputs
        .filter(|output: &Result<Output>| output.as_ref().map_or(true, |output| output.scale > 0.0))
        .collect()
}

/// Largest distances of outputs between two runs, relative, as the planner measures them.
fn errors(outputs: &[Output], ran: &Ran, fine: &Ran) -> Vec<f64> {
    let [own, exact] = [ran, fine].map(values);
    let errors = outputs.iter().map(|output| {
        let mut squares = Vec::new();
        for (name, exact) in &exact {
            // Frequencies are listed one by one, components of a vector together.
            let vector = name.split('[').next();
            if *name != output.name && vector != Some(&output.name) {
                continue;
            }
            let own = own.get(name).map_or(&[][..], Vec::as_slice);
            squares.resize(exact.len(), 0.0);
            for (at, exact) in exact.iter().enumerate() {
                let own = own.get(at).copied().unwrap_or(f64::INFINITY);
                squares[at] += (own - exact).powi(2);
            }
        }
        let first = usize::from(output.skips_start && squares.len() > 1);
        largest(squares.iter().skip(first).map(|square| square.sqrt())) / output.scale
    });
    errors.collect()
}

/// All that a run gave by name: outputs over time, and what is calculated once.
fn values(ran: &Ran) -> HashMap<String, Vec<f64>> {
    let names = ran.table.names();
    let mut all: HashMap<String, Vec<f64>> = names
        .filter_map(|name| Some((name.to_owned(), ran.table.column(name).ok()?)))
        .collect();
    for (name, value) in ran.report["calculated"].as_object().into_iter().flatten() {
        all.extend(value.as_f64().map(|value| (name.clone(), vec![value])));
    }
    all
}
