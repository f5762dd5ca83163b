//! Runs of the default experiment.

use std::f64::consts::PI;

use super::motion::Motion;
use super::outputs::RelativeTo;
use super::response::Responses;
use crate::scene::{Course, Error, InputCourse, Scene, did_you_mean};
use crate::simulation::{Causality, Signals, Simulation, Source, Variable, variables};

/// Communication points that are compared, about, where there are more.
const POINTS: u64 = 10_000;
/// Times that a cosine goes to and fro.
const SWINGS: f64 = 3.0;

/// A run: what is computed, at communication points.
#[derive(Clone, Debug)]
pub(super) struct Run {
    pub times: Vec<f64>,
    /// One value a computed variable, in their order, at every time.
    pub rows: Vec<Vec<f64>>,
    /// What these are where the scene moves by its nature, and its size, m.
    pub natural: Vec<f64>,
    pub size: f64,
    /// What these are where the scene draws its bodies: places, angles and directions.
    pub drawn: Vec<f64>,
    /// Largest displacements of bodies from where they were drawn, and from a rigid motion of what was drawn, m.
    pub moved: Vec<f64>,
    pub deformed: Vec<f64>,
    /// What inputs that are held would do.
    pub responses: Responses,
    /// What errors of every output are measured by, in its unit; filled in by the search.
    pub scales: Vec<(f64, RelativeTo)>,
    /// Work: operations times parts.
    pub work: f64,
    /// Sub-steps.
    pub steps: u64,
    /// Integrator at the end.
    pub method: &'static str,
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
pub(super) struct Experiment {
    /// Table of the inputs.
    signals: Option<String>,
    /// Communication steps.
    pub steps: u64,
    step: f64,
    stop: f64,
    /// Steps from one point that is compared to the next.
    every: u64,
    /// Inputs that keep their start values, but for rates of others.
    pub held: Vec<String>,
    /// These, then other components of their vectors: answers are measured by the largest of a vector's components.
    asked: Vec<String>,
}

impl Experiment {
    /// The default experiment of a scene.
    ///
    /// # Errors
    /// A course of what is no input.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        let steps = scene.experiment.steps() as u64;
        let held = held(scene);
        Ok(Self {
            signals: courses(scene)?,
            steps,
            step: scene.experiment.step,
            stop: scene.experiment.stop_time,
            every: steps / POINTS + 1,
            asked: asked(scene, &held),
            held,
        })
    }

    /// Runs a scene with numbers of elements and a tolerance, with at most so much work, and until time is over; where it is halved, in
    /// two steps from one communication point to the next. Responses are those of the mesh, where they are known.
    pub fn run(
        &self,
        scene: Scene,
        responses: Option<Responses>,
        is_halved: bool,
        (most_work, is_over): (f64, &dyn Fn() -> bool),
    ) -> Result<Run, Unfinished> {
        let failed = |reason: String| Unfinished::Failed(reason);
        let mut simulation = Simulation::new(scene);
        // Indices of inputs follow from what bodies are.
        let signals = self.signals.as_deref();
        let signals = signals.map(|text| Signals::from_csv(text, simulation.variables()));
        let signals = signals
            .transpose()
            .map_err(|error| failed(error.to_string()))?;
        if let Some(signals) = &signals {
            let set = simulation.set_inputs(signals);
            set.map_err(|error| failed(error.to_string()))?;
        }
        let started = simulation.initialize(0.0).and_then(|()| simulation.start());
        started.map_err(|error| failed(error.to_string()))?;
        let mut run = Run::begun(self, &mut simulation, responses);
        let variables = simulation.variables().iter().enumerate();
        let computed = variables.filter(|(_, variable)| variable.is_computed());
        let computed: Vec<usize> = computed.map(|(index, _)| index).collect();
        let mut motion = Motion::new(&simulation);
        for number in 0..=self.steps {
            let until = (number as f64 * self.step).min(self.stop);
            let middle = (until - 0.5 * self.step).max(0.0);
            while simulation.time() < until {
                let until = match is_halved && simulation.time() < middle {
                    true => middle,
                    false => until,
                };
                match &signals {
                    Some(signals) => simulation.step_along(signals, until).map_err(failed)?,
                    None => simulation
                        .step(until)
                        .map_err(|failure| failed(failure.to_string()))?,
                }
                let report = simulation.report();
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
        (run.moved, run.deformed) = (motion.moved, motion.deformed);
        Ok(run)
    }

    /// What a simulation that has been initialized answers to inputs that are held.
    fn responses(&self, simulation: &mut Simulation) -> Responses {
        let places = self.asked.iter().filter_map(|name| {
            let variable = simulation.variables().iter().find(|v| v.name == *name);
            match variable.map(|variable| variable.source) {
                Some(Source::Input(place)) => Some(place),
                _ => None,
            }
        });
        let places: Vec<usize> = places.collect();
        match places.is_empty() {
            true => Responses::default(),
            false => Responses::new(simulation, &places, (self.stop, self.step)),
        }
    }

    /// Places among the inputs whose answers are known of the components of the vector of one that is held.
    pub fn components(&self, held: usize) -> Vec<usize> {
        let asked = self.asked.iter().enumerate();
        let same = asked.filter(|(_, name)| vector(name) == vector(&self.held[held]));
        same.map(|(index, _)| index).collect()
    }
}

impl Run {
    /// At the start of a simulation that has been initialized.
    fn begun(
        experiment: &Experiment,
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
            responses,
            scales: Vec::new(),
            work: 0.0,
            steps: 0,
            method: "",
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

/// Inputs that no course moves, but for the rates of driven motions.
fn held(scene: &Scene) -> Vec<String> {
    let variables = variables(scene);
    let inputs = variables.iter();
    let inputs = inputs.filter(|variable| Causality::of(variable) == Causality::Input);
    let names: Vec<&str> = inputs.map(|variable| &variable.name[..]).collect();
    let is_rate = |name: &str| {
        let mut pairs = RATES.iter().flat_map(|[value, rates @ ..]| {
            let values = rates.iter().map(move |rate| (*rate, *value));
            values.filter(|(rate, _)| name.contains(rate))
        });
        pairs.any(|(rate, value)| names.contains(&&*name.replace(rate, value)))
    };
    let moved = columns(&scene.accuracy.courses, &variables);
    let is_moved = |name: &str| moved.iter().any(|(moved, ..)| moved == name);
    let held = names
        .iter()
        .filter(|name| !is_moved(name) && !is_rate(name));
    held.map(|name| (*name).to_owned()).collect()
}

/// What inputs do while a scene is planned, as a CSV table with a row at every communication point; nothing where
/// all keep their start values.
///
/// # Errors
/// A course of what is no input.
pub fn courses(scene: &Scene) -> Result<Option<String>, Error> {
    let (courses, steps) = (&scene.accuracy.courses, scene.experiment.steps() as u64);
    if courses.is_empty() {
        return Ok(None);
    }
    let variables = variables(scene);
    for (place, course) in courses.iter().enumerate() {
        let is_input = variables
            .iter()
            .any(|v| v.name == course.input && Causality::of(v) == Causality::Input);
        if !is_input {
            let inputs = variables
                .iter()
                .filter(|v| Causality::of(v) == Causality::Input);
            let meant = did_you_mean(&course.input, inputs.map(|v| v.name.as_str()));
            let found = &course.input;
            let message = format!("expected the name of an input, found \"{found}\"{meant}");
            return Err(Error::new(format!("accuracy.for[{place}].input"), message));
        }
    }
    let columns = columns(courses, &variables);
    let names: Vec<&str> = columns.iter().map(|(name, ..)| name.as_str()).collect();
    let mut text = format!("time,{}\n", names.join(","));
    let stop = scene.experiment.stop_time;
    let mut row = |time: f64, passed: [bool; 2]| {
        let value = |(_, course, order): &(String, &InputCourse, u32)| {
            format!("{:?}", derivative(course, (time, stop), passed, *order))
        };
        let cells: Vec<String> = columns.iter().map(value).collect();
        text += &format!("{time:?},{}\n", cells.join(","));
    };
    let jumps = JUMPS.map(|part| (part * steps as f64).round() as u64);
    let every = steps / POINTS + 1;
    for number in 0..=steps {
        if number % every != 0 && number != steps && !jumps.contains(&number) {
            continue;
        }
        let time = (number as f64 * scene.experiment.step).min(stop);
        row(time, jumps.map(|jump| number > jump));
        // A jump is two rows of one time.
        if jumps.contains(&number) && number < steps {
            row(time, jumps.map(|jump| number >= jump));
        }
    }
    match Signals::from_csv(&text, &variables) {
        Ok(_) => Ok(Some(text)),
        Err(error) => Err(Error::new("accuracy.for", error.to_string())),
    }
}

/// Columns of the table: inputs with a course, and the rates of driven motions that follow from it: name, course, order.
pub(super) fn columns<'a>(
    courses: &'a [InputCourse],
    variables: &[Variable],
) -> Vec<(String, &'a InputCourse, u32)> {
    let mut found: Vec<(String, &InputCourse, u32)> = Vec::new();
    for course in courses {
        found.push((course.input.clone(), course, 0));
        for [value, rate, acceleration] in RATES {
            for (name, order) in [(rate, 1), (acceleration, 2)] {
                let name = course.input.replace(value, name);
                let is_named = courses.iter().any(|other| other.input == name);
                if !is_named && variables.iter().any(|variable| variable.name == name) {
                    found.push((name, course, order));
                }
            }
        }
    }
    found
}

/// Words for a driven coordinate and its derivatives in the names of inputs.
const RATES: [[&str; 3]; 4] = [
    [".position", ".velocity", ".acceleration"],
    [".displacement", ".velocity", ".acceleration"],
    [".travel", ".velocity", ".acceleration"],
    [".angle", ".angular_velocity", ".angular_acceleration"],
];

/// Derivative of an order of a course at a time in an experiment, s; of one that jumps only its value.
fn derivative(
    course: &InputCourse,
    (time, stop): (f64, f64),
    passed: [bool; 2],
    order: u32,
) -> f64 {
    let value = |time: f64| at(course, time / stop, passed);
    let h = DIFFERENCE * stop;
    match (order, course.course) {
        (0, _) => value(time),
        (_, Course::Step) => 0.0,
        (1, _) => (value(time + h) - value(time - h)) / (2.0 * h),
        _ => (value(time + h) - 2.0 * value(time) + value(time - h)) / (h * h),
    }
}

/// Part of the experiment over which courses are differentiated.
const DIFFERENCE: f64 = 1e-4;
/// Parts of the experiment after which what jumps does, and ramps begin or end.
const JUMPS: [f64; 2] = [0.1, 0.5];

/// Value of an input after a part of the experiment, where those jumps have passed.
fn at(course: &InputCourse, part: f64, passed: [bool; 2]) -> f64 {
    let InputCourse { from, to, .. } = course;
    let way = match course.course {
        Course::Ramp => {
            let up = (part / JUMPS[0]).clamp(0.0, 1.0);
            let back = ((part - JUMPS[1]) / JUMPS[0]).clamp(0.0, 1.0);
            0.5 * ((PI * back).cos() - (PI * up).cos())
        }
        Course::Step => f64::from(u8::from(passed[0] && !passed[1])),
        Course::Sine => 0.5 - 0.5 * (2.0 * PI * SWINGS * part).cos(),
    };
    from + way * (to - from)
}
