//! `studies integrate`: a scene with a named integrator, at a fixed step or at a tolerance.

use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use cpu_time::ThreadTime;
use flexbody::integrators::{
    Attempt, Counts, OneStepMethod, StateView, StepError, Tolerance, advance,
};
use flexbody::math::switches::grain;
use flexbody::scene::Experiment;
use flexbody::system::{
    DrivenSystem, Dynamics, Evaluation, State, StepOutcome, natural_frequencies,
};

use crate::integrators::{self, Build, Probe, Tally};
use crate::outputs::Outputs;
use crate::scene::{Outcome, Start, at, read};

/// Into how many pieces a step is divided at most.
const MOST_PIECES: f64 = 64.0;

/// Arguments of an integration: scene, method and outputs.
#[derive(clap::Args)]
pub struct Integrate {
    /// Scene file.
    scene: PathBuf,
    /// Integrator: see `integrators/mod.rs`.
    #[arg(long)]
    method: String,
    /// Longest step, s: fixed steps that divide the time between outputs.
    #[arg(long)]
    step: Option<f64>,
    /// Relative tolerance: of every step where there is no fixed one, else what Newton's method leaves.
    #[arg(long, default_value_t = 1e-6)]
    tolerance: f64,
    /// How constraints that are not linear are kept.
    #[arg(long, value_enum, default_value_t)]
    constraints: Constraints,
    /// Time at which to end, s.
    #[arg(long)]
    stop_time: f64,
    /// Time between outputs, s.
    #[arg(long)]
    every: f64,
    /// Value of a body, e.g. `rod.density=7800`; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// CSV file.
    #[arg(long)]
    output: PathBuf,
    /// JSON file.
    #[arg(long)]
    report: PathBuf,
}

/// Ways to keep constraints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Constraints {
    /// As the product does: positions and velocities projected after every step
    #[default]
    Projection,
    /// Independent coordinates are integrated, dependent ones follow
    Partitioning,
}

/// Total cost of the steps.
#[derive(Default)]
struct Cost {
    counts: Counts,
    cpu_time: Duration,
    tally: Tally,
}

/// Runs the subcommand.
pub fn integrate(arguments: &Integrate) -> Outcome<()> {
    let scene = read(&arguments.scene, &arguments.set)?;
    let mut start = Start::new(scene)?;
    let tolerance = tolerance(&mut start, arguments.tolerance);
    let partitioned = arguments.constraints == Constraints::Partitioning;
    if partitioned && !matches!(&*arguments.method, "rk4" | "dopri5") {
        let name = &arguments.method;
        return Err(format!(
            "--method {name}: expected rk4 or dopri5 with coordinate partitioning"
        ));
    }
    let mut table = Outputs::new(&start);
    let nodes = Arc::new(Mutex::new(start.assembled.nodes.clone()));
    let build = Build {
        start: &start,
        nodes: nodes.clone(),
        fixed: arguments.step.is_some(),
    };
    let mut method = integrators::build(&arguments.method, &build)?;
    let watches = arguments.method == "energy_momentum";
    let (system, inputs) = (&start.assembled.system, &start.inputs[..]);
    let (mut state, mut work) = (start.state.clone(), start.work.clone());
    let mut cost = Cost::default();
    table.add(&start, &state, &mut work);
    let experiment = Experiment {
        stop_time: arguments.stop_time,
        step: arguments.every,
    };
    let points = experiment.steps() as u64;
    for point in 1..=points {
        let until = (point as f64 * arguments.every).min(arguments.stop_time);
        let model = DrivenSystem::new(system, inputs, &mut work, &state);
        let mut probe = Probe::new(model, watches.then(|| nodes.clone()));
        if partitioned {
            probe = probe.partitioned(&state);
        }
        let started = ThreadTime::now();
        let (counts, outcome) = match arguments.step {
            Some(step) => {
                let mut steps = FixedSteps {
                    method: &mut *method,
                    dynamics: &mut probe,
                    step,
                    tolerance: &tolerance,
                    counts: Counts::default(),
                };
                let outcome = steps.advance(&mut state, until);
                (steps.counts, outcome)
            }
            None => advance(&mut *method, &mut probe, &mut state, until, &tolerance),
        };
        cost.cpu_time += started.elapsed();
        cost.tally.add(&probe.tally);
        cost.counts.steps += counts.steps;
        cost.counts.rejected += counts.rejected;
        cost.counts.newton_iterations += counts.newton_iterations;
        outcome.map_err(|stop| format!("{}: {stop:?} at {} s", arguments.method, state.time))?;
        table.add(&start, &state, &mut work);
    }
    std::fs::write(&arguments.output, table.text).map_err(|e| at(&arguments.output, e))?;
    let report = cost.json(&arguments.method);
    std::fs::write(&arguments.report, report).map_err(|e| at(&arguments.report, e))
}

/// Steps of equal length with one method.
struct FixedSteps<'a> {
    method: &'a mut dyn OneStepMethod,
    dynamics: &'a mut dyn Dynamics,
    /// Longest step, s.
    step: f64,
    tolerance: &'a Tolerance,
    counts: Counts,
}

impl FixedSteps<'_> {
    /// Advances to a time (s), in equal steps from one output or jump to the next.
    fn advance(&mut self, state: &mut State, until: f64) -> Result<(), StepError> {
        while state.time < until {
            let (from, near) = (state.time, grain(state.time));
            let dynamics = &mut *self.dynamics;
            // History goes on over outputs but not over jumps.
            let jumps = dynamics.begin_smooth_interval(from - 8.0 * near, until) <= from + near;
            let end = dynamics.begin_smooth_interval(from, until);
            let way = end - from;
            if from <= 0.0 || jumps {
                let (q, v) = (&state.coordinates, &state.rates);
                self.method.begin(dynamics, from, q, v);
            }
            let before = self.method.newton_iterations();
            let pieces = (way / self.step - 1e-9).ceil().max(1.0) as u64;
            let h = way / pieces as f64;
            for piece in 1..=pieces {
                let target = if piece == pieces {
                    end
                } else {
                    from + piece as f64 * h
                };
                self.step_to(state, target)?;
            }
            if let StepOutcome::Jumped(drive) = self.dynamics.end_smooth_interval(state) {
                return Err(StepError::Jumped(drive));
            }
            self.counts.newton_iterations += self.method.newton_iterations() - before;
            if !state.coordinates.iter().all(|q| q.is_finite()) {
                return Err(StepError::NotFinite);
            }
        }
        Ok(())
    }

    /// Takes one step to a time (s), in halves where the iteration does not converge.
    fn step_to(&mut self, state: &mut State, target: f64) -> Result<(), StepError> {
        let (method, dynamics) = (&mut *self.method, &mut *self.dynamics);
        let way = target - state.time;
        let mut h = way;
        while state.time < target {
            let now = StateView::of(state);
            let left = target - state.time;
            let last = left <= h * (1.0 + 1e-9);
            let outcome =
                method.attempt(dynamics, now, if last { left } else { h }, self.tolerance);
            let Attempt::Done(_) = outcome else {
                self.counts.rejected += 1;
                h *= 0.5;
                if h < way / MOST_PIECES {
                    return Err(StepError::StepTooSmall);
                }
                continue;
            };
            method.accept(&mut state.coordinates, &mut state.rates);
            state.time = if last { target } else { state.time + h };
            self.counts.steps += 1;
            match dynamics.accepted(state) {
                StepOutcome::AsIs => {}
                StepOutcome::Moved => {
                    method.refresh(dynamics, state.time, &state.coordinates, &state.rates);
                }
                StepOutcome::SliderLeftCable(joint) => {
                    return Err(StepError::SliderLeftCable(joint));
                }
                StepOutcome::WinchEmpty(drive) => return Err(StepError::WinchEmpty(drive)),
                StepOutcome::ElementOverDeformed(rod, place) => {
                    return Err(StepError::ElementOverDeformed(rod, place));
                }
                StepOutcome::ConstraintsViolated => return Err(StepError::ConstraintsViolated),
                StepOutcome::Jumped(drive) => return Err(StepError::Jumped(drive)),
                StepOutcome::NotFinite => return Err(StepError::NotFinite),
            }
        }
        Ok(())
    }
}

/// Errors as the product measures them.
pub fn tolerance(start: &mut Start, relative: f64) -> Tolerance {
    Tolerance {
        relative,
        position: start.assembled.system.scale(),
        time: 1.0 / rate(start),
    }
}

/// How fast the scene moves, 1/s, as the product has it: by its motion at the start, by gravity; where
/// it has neither, by its slowest oscillation.
fn rate(start: &mut Start) -> f64 {
    let system = &start.assembled.system;
    let mut evaluation = Evaluation::new(system);
    evaluation.kinematics(system, &start.state, &mut start.work);
    let kinetic = evaluation.kinetic_energy(system);
    let (size, mass) = (system.size(), system.mass());
    let motion = (2.0 * kinetic / mass).sqrt() / size;
    let gravity = (system.gravity().norm() / size).sqrt();
    let rate = motion
        .max(gravity)
        .max(start.scene.rotation.full()[2].abs());
    if rate > 0.0 {
        return rate;
    }
    let few = system.coordinates().min(12);
    let found = natural_frequencies(system, &start.inputs, &mut start.work, &start.state, few);
    let found = found.unwrap_or_default();
    let least = 1e-3 * found.last().copied().unwrap_or(1.0);
    found.into_iter().find(|w| *w > least).unwrap_or(1.0)
}

impl Cost {
    /// One line of JSON; CPU time in seconds.
    fn json(&self, method: &str) -> String {
        format!(
            "{{\"method\": \"{method}\", \"steps\": {}, \"rejected\": {}, \"newton_iterations\": {}, \
             \"accelerations\": {}, \"linearizations\": {}, \"factorizations\": {}, \"solves\": {}, \
             \"cpu_time\": {:?}}}\n",
            self.counts.steps,
            self.counts.rejected,
            self.counts.newton_iterations,
            self.tally.accelerations,
            self.tally.linearizations,
            self.tally.factorizations,
            self.tally.solves,
            self.cpu_time.as_secs_f64()
        )
    }
}
