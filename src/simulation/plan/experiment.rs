//! Runs of the default experiment.

use super::courses::RATES;
use super::given::TrialConditions;
use super::motion::LargestDisplacements;
use super::outputs::RelativeTo;
use super::response::Responses;
use crate::scene::{Error, Scene};
use crate::simulation::{Causality, InputTable, Simulation, Source, variables};

/// Communication points that are compared, about, where there are more.
pub(super) const POINTS: u64 = 10_000;
/// Part of the most work of a run that a step which ran out of it has done at least.
const SPENT: f64 = 0.999;

/// A run: what is computed, at communication points.
#[derive(Clone, Debug)]
pub(super) struct TrialRun {
    pub times: Vec<f64>,
    /// One value a computed variable, in their order, at every time.
    pub rows: Vec<Vec<f64>>,
    /// Natural sizes of the computed variables, in their order.
    pub natural: Vec<f64>,
    pub size: f64,
    /// Values of the computed variables in the configuration that the scene draws. Other variables than positions,
    /// angles and directions are 0.
    pub drawn: Vec<f64>,
    /// Largest displacements of bodies from where they were drawn, and from a rigid motion of what was drawn, m.
    pub moved: Vec<f64>,
    pub deformed: Vec<f64>,
    /// Largest error (m) that the meshes of plates and shells make along both directions, with the places of the bodies.
    pub missed: Vec<(usize, [f64; 2])>,
    /// Linear responses to inputs that are held.
    pub responses: Responses,
    /// Reference size of the errors of every output, in the output's unit. The search fills it in.
    pub scales: Vec<(f64, RelativeTo)>,
    /// Work: operations times parts.
    pub work: f64,
    /// Sub-steps.
    pub steps: u64,
    /// Integrator at the end.
    pub method: &'static str,
    /// Whether nothing leaves the equilibrium that it starts in: steps make no errors.
    pub rests: bool,
}

/// Why a run was not finished.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Unfinished {
    /// More work than there is left.
    TooMuchWork,
    /// No initial state, or a step that could not be taken.
    Failed(String),
}

/// The experiment that is planned for.
pub(super) struct PlannedExperiment {
    given: TrialConditions,
    /// Table of inputs.
    moved: Option<InputTable>,
    /// Communication steps.
    pub steps: u64,
    step: f64,
    stop: f64,
    /// Steps from one point that is compared to the next.
    every: u64,
    /// Inputs that keep their start values, but for rates of others.
    pub held: Vec<String>,
    /// Inputs that are held, followed by the other components of their vectors. Responses are measured by the largest
    /// component of a vector.
    asked: Vec<String>,
}

impl PlannedExperiment {
    /// The default experiment of a scene.
    ///
    /// # Errors
    /// A course of what is no input.
    pub fn new(scene: &Scene, given: &TrialConditions) -> Result<Self, Error> {
        let steps = scene.experiment.steps() as u64;
        let moved = given.moved(scene)?;
        let held = held(scene, moved.as_ref());
        Ok(Self {
            given: given.clone(),
            moved,
            steps,
            step: scene.experiment.step,
            stop: scene.experiment.stop_time,
            every: steps / POINTS + 1,
            asked: asked(scene, &held),
            held,
        })
    }

    /// Runs a scene with numbers of elements and a tolerance, within `most_work` and until `is_over`. Responses of the
    /// mesh are not computed again if they are known.
    ///
    /// # Errors
    /// The work or time limit is reached, or the run fails.
    pub fn run(
        &self,
        scene: Scene,
        responses: Option<Responses>,
        most_work: f64,
        is_over: &dyn Fn() -> bool,
    ) -> Result<TrialRun, Unfinished> {
        let failed = |reason: String| Unfinished::Failed(reason);
        let mut simulation = Simulation::new(scene);
        let set = self.given.set(&mut simulation);
        set.map_err(|error| failed(error.to_string()))?;
        // Indices of inputs follow from what bodies are.
        let moved = self.moved.as_ref();
        let signals = moved.map(|moved| moved.signals(simulation.variables()));
        let signals = signals
            .transpose()
            .map_err(|error| failed(error.to_string()))?;
        if let Some(signals) = &signals {
            let set = simulation.set_inputs(signals);
            set.map_err(|error| failed(error.to_string()))?;
        }
        let started = simulation.initialize(0.0).and_then(|()| simulation.start());
        started.map_err(|error| failed(error.to_string()))?;
        let mut run = TrialRun::begun(self, &mut simulation, responses);
        let variables = simulation.variables().iter().enumerate();
        let computed = variables.filter(|(_, variable)| variable.is_computed());
        let computed: Vec<usize> = computed.map(|(index, _)| index).collect();
        let mut motion = LargestDisplacements::new(&simulation);
        for number in 0..=self.steps {
            let until = (number as f64 * self.step).min(self.stop);
            while simulation.time() < until {
                // One step of communication may take longer than a run.
                simulation.limit_work(most_work - run.work);
                let taken = match &signals {
                    Some(signals) => simulation.step_along(signals, until),
                    None => simulation
                        .step(until)
                        .map_err(|failure| failure.to_string()),
                };
                let report = simulation.report();
                if let Err(reason) = taken {
                    return Err(if run.work + report.work < SPENT * most_work {
                        failed(reason)
                    } else {
                        Unfinished::TooMuchWork
                    });
                }
                run.work += report.work;
                run.steps += report.steps;
                run.method = report.method;
                if run.work > most_work || is_over() {
                    return Err(Unfinished::TooMuchWork);
                }
            }
            if number % self.every != 0 && number != self.steps {
                continue;
            }
            let values = computed.iter().map(|index| simulation.real(*index));
            let row: Result<Vec<f64>, _> = values.collect();
            let row = row.and_then(|row| motion.take(&mut simulation).map(|()| row));
            run.rows
                .push(row.map_err(|error| failed(error.to_string()))?);
            run.times.push(simulation.time());
        }
        (run.moved, run.deformed, run.missed) = (motion.moved, motion.deformed, motion.missed);
        Ok(run)
    }

    /// Computes the responses of an initialized simulation to inputs that are held.
    fn responses(&self, simulation: &mut Simulation) -> Responses {
        let places = self.asked.iter().filter_map(|name| {
            let variable = simulation.variables().iter().find(|v| v.name == *name);
            match variable.map(|variable| variable.source) {
                Some(Source::Input(place)) => Some(place),
                _ => None,
            }
        });
        let places: Vec<usize> = places.collect();
        if places.is_empty() {
            Responses::default()
        } else {
            Responses::new(simulation, &places, self.stop, self.step)
        }
    }

    /// Places among the inputs whose answers are known of the components of the vector of one that is held.
    pub fn components(&self, held: usize) -> Vec<usize> {
        let asked = self.asked.iter().enumerate();
        let same = asked.filter(|(_, name)| vector(name) == vector(&self.held[held]));
        same.map(|(index, _)| index).collect()
    }
}

impl TrialRun {
    /// At the start of a simulation that has been initialized.
    fn begun(
        experiment: &PlannedExperiment,
        simulation: &mut Simulation,
        responses: Option<Responses>,
    ) -> Self {
        let (size, natural) = simulation.natural();
        let responses = responses.unwrap_or_else(|| experiment.responses(simulation));
        Self {
            times: Vec::new(),
            rows: Vec::new(),
            natural,
            size,
            drawn: simulation.drawn(),
            moved: Vec::new(),
            deformed: Vec::new(),
            missed: Vec::new(),
            responses,
            scales: Vec::new(),
            work: 0.0,
            steps: 0,
            method: "",
            rests: experiment.moved.is_none() && simulation.scene().rests(),
        }
    }
}

/// The vector that an input is a component of.
fn vector(input: &str) -> &str {
    input.split('[').next().unwrap_or(input)
}

/// Inputs, then other components of their vectors.
fn asked(scene: &Scene, held: &[String]) -> Vec<String> {
    let variables = variables(scene);
    let inputs = variables.iter();
    let inputs = inputs.filter(|variable| Causality::of(variable) == Causality::Input);
    let names = inputs.map(|variable| &variable.name);
    let others = names.filter(|name| {
        let is_held = held.contains(name);
        !is_held && held.iter().any(|held| vector(held) == vector(name))
    });
    held.iter().chain(others).cloned().collect()
}

/// Inputs that keep their values, but for the rates of driven motions.
fn held(scene: &Scene, moved: Option<&InputTable>) -> Vec<String> {
    let variables = variables(scene);
    let signals = moved.and_then(|moved| moved.signals(&variables).ok());
    let inputs = variables.iter().enumerate();
    let inputs = inputs.filter(|(_, variable)| Causality::of(variable) == Causality::Input);
    let inputs: Vec<(usize, &str)> = inputs
        .map(|(place, input)| (place, &input.name[..]))
        .collect();
    let is_rate = |name: &str| {
        let mut pairs = RATES.iter().flat_map(|[value, rates @ ..]| {
            let values = rates.iter().map(move |rate| (*rate, *value));
            values.filter(|(rate, _)| name.contains(rate))
        });
        pairs.any(|(rate, value)| {
            let of = name.replace(rate, value);
            inputs.iter().any(|(_, name)| *name == of)
        })
    };
    let is_moved = |place: usize| signals.as_ref().is_some_and(|signals| signals.holds(place));
    let held = (inputs.iter()).filter(|(place, name)| !is_moved(*place) && !is_rate(name));
    held.map(|(_, name)| (*name).to_owned()).collect()
}
