//! What inputs do in the experiment that is planned for (`accuracy.input_profiles`), as a table over time.

use std::f64::consts::PI;

use super::experiment::POINTS;
use crate::math::function::Function;
use crate::scene::{Course, Error, InputCourse, Interpolation, Scene, Value, did_you_mean};
use crate::simulation::{Causality, InputTable, Variable, variables};

/// Times that a cosine goes to and fro.
const SWINGS: f64 = 3.0;
/// Part of the experiment over which ramps and cosines are differentiated.
const DIFFERENCE: f64 = 1e-4;
/// Parts of the experiment after which what jumps does, and ramps begin or end.
const JUMPS: [f64; 2] = [0.1, 0.5];
/// Most kinks and jumps of a course of one's own.
const MOST_BREAKS: usize = 100_000;
/// Part of a communication step within which two times are one.
const SAME: f64 = 1e-9;

/// Words for a driven coordinate and its derivatives in the names of inputs.
pub(super) const RATES: [[&str; 3]; 4] = [
    [".position", ".velocity", ".acceleration"],
    [".displacement", ".velocity", ".acceleration"],
    [".travel", ".velocity", ".acceleration"],
    [".angle", ".angular_velocity", ".angular_acceleration"],
];

/// A column of the table: an input with a course, or a rate that follows from one.
struct InputColumn {
    name: String,
    /// Place of the course.
    course: usize,
    /// Derivative of it.
    order: usize,
}

/// Columns of the table: inputs with a course, and the rates of driven motions that follow from it.
fn columns(courses: &[InputCourse], variables: &[Variable]) -> Vec<InputColumn> {
    let mut found: Vec<InputColumn> = Vec::new();
    for (place, course) in courses.iter().enumerate() {
        let mut add = |name: String, order: usize| {
            found.push(InputColumn {
                name,
                course: place,
                order,
            });
        };
        add(course.input.clone(), 0);
        for [value, rate, acceleration] in RATES {
            for (name, order) in [(rate, 1), (acceleration, 2)] {
                let name = course.input.replace(value, name);
                let is_named = courses.iter().any(|other| other.input == name);
                if !is_named && variables.iter().any(|variable| variable.name == name) {
                    add(name, order);
                }
            }
        }
    }
    found
}

/// Builds the table of inputs for the experiment that is planned for. It has a row at every communication point, and
/// two at every jump and kink. `None` if all inputs keep their start values.
///
/// # Errors
/// A course of what is no input; one with too many kinks and jumps.
pub fn courses(scene: &Scene) -> Result<Option<InputTable>, Error> {
    let given = &scene.accuracy.input_profiles;
    if given.is_empty() {
        return Ok(None);
    }
    let variables = variables(scene);
    check_inputs(given, &variables)?;
    let jumps = JUMPS.map(|part| {
        let steps = (part * scene.experiment.steps()).round();
        steps * scene.experiment.step
    });
    let moves = given.iter().enumerate();
    let moves = moves.map(|(place, course)| Move::new(place, course, jumps));
    let moves: Result<Vec<Move>, Error> = moves.collect();
    let moves = moves?;
    let columns = columns(given, &variables);
    let names: Vec<&str> = columns.iter().map(|column| &*column.name).collect();
    let mut text = format!("time,{}\n", names.join(","));
    let stop = scene.experiment.stop_time;
    let mut row = |time: f64, is_after: bool| {
        let cells = columns.iter().map(|column| {
            let value = moves[column.course].derivative(time, stop, is_after, column.order);
            format!("{value:?}")
        });
        text += &format!("{time:?},{}\n", cells.collect::<Vec<_>>().join(","));
    };
    for (time, is_break) in times(scene, &moves)? {
        row(time, !is_break);
        if is_break && time < stop {
            row(time, true);
        }
    }
    let table = InputTable {
        text,
        curve: Interpolation::Linear,
    };
    match table.signals(&variables) {
        Ok(_) => Ok(Some(table)),
        Err(error) => Err(Error::new("accuracy.input_profiles", error.to_string())),
    }
}

fn check_inputs(courses: &[InputCourse], variables: &[Variable]) -> Result<(), Error> {
    let inputs = || (variables.iter()).filter(|v| Causality::of(v) == Causality::Input);
    for (place, course) in courses.iter().enumerate() {
        let found = &course.input;
        if !inputs().any(|input| input.name == *found) {
            let meant = did_you_mean(found, inputs().map(|input| input.name.as_str()));
            let message = format!("expected the name of an input, found \"{found}\"{meant}");
            return Err(Error::new(
                format!("accuracy.input_profiles[{place}].input"),
                message,
            ));
        }
    }
    Ok(())
}

/// A course, ready to be evaluated.
struct Move<'a> {
    course: &'a InputCourse,
    /// Function of a course that is given by an expression or a table.
    function: Option<Function>,
    /// Times of jumps, s: communication points.
    jumps: [f64; 2],
}

impl<'a> Move<'a> {
    fn new(place: usize, course: &'a InputCourse, jumps: [f64; 2]) -> Result<Self, Error> {
        let function = course.value.as_ref().map(Value::function).transpose();
        let function = function.map_err(|message| {
            Error::new(format!("accuracy.input_profiles[{place}].value"), message)
        })?;
        Ok(Self {
            course,
            function,
            jumps,
        })
    }

    /// Derivative of an order (up to 2) at a time in an experiment that ends at `stop`, s, before or after what jumps there; of a step only its value.
    fn derivative(&self, time: f64, stop: f64, is_after: bool, order: usize) -> f64 {
        if let Some(function) = &self.function {
            let at = if is_after { time } else { time.next_down() };
            return function.derivatives(at)[order];
        }
        let value = |time: f64| self.value(time, stop, is_after);
        let h = DIFFERENCE * stop;
        match (order, self.course.course.unwrap_or_default()) {
            (0, _) => value(time),
            (_, Course::Step) => 0.0,
            (1, _) => (value(time + h) - value(time - h)) / (2.0 * h),
            _ => (value(time + h) - 2.0 * value(time) + value(time - h)) / (h * h),
        }
    }

    /// Value of a ramp, step or cosine.
    fn value(&self, time: f64, stop: f64, is_after: bool) -> f64 {
        let [from, to] = [self.course.from, self.course.to].map(Option::unwrap_or_default);
        let part = time / stop;
        let risen = |part: f64| 0.5 - 0.5 * (PI * part.clamp(0.0, 1.0)).cos();
        let way = match (self.course.course.unwrap_or_default(), self.course.duration) {
            (Course::Ramp, Some(duration)) => risen(time / duration),
            (Course::Ramp, None) => risen(part / JUMPS[0]) - risen((part - JUMPS[1]) / JUMPS[0]),
            (Course::Step, _) => {
                let passed = self
                    .jumps
                    .map(|jump| if is_after { time >= jump } else { time > jump });
                f64::from(u8::from(passed[0] && !passed[1]))
            }
            (Course::Sine, _) => 0.5 - 0.5 * (2.0 * PI * SWINGS * part).cos(),
        };
        from + way * (to - from)
    }

    /// Times within an experiment (s) at which it has a kink or jumps, in order; nothing where they are too many.
    fn breaks(&self, stop: f64) -> Option<Vec<f64>> {
        let Some(function) = &self.function else {
            return Some(self.jumps.to_vec());
        };
        let next = |time: &f64| function.next_break(*time, stop);
        let found = std::iter::successors(function.next_break(0.0, stop), next);
        let found: Vec<f64> = found.take(MOST_BREAKS + 1).collect();
        (found.len() <= MOST_BREAKS).then_some(found)
    }
}

/// Times of rows, s, in order, and whether something jumps or has a kink there.
fn times(scene: &Scene, moves: &[Move]) -> Result<Vec<(f64, bool)>, Error> {
    let experiment = &scene.experiment;
    let (steps, stop) = (experiment.steps() as u64, experiment.stop_time);
    let every = steps / POINTS + 1;
    let numbers = (0..=steps).filter(|number| number % every == 0 || *number == steps);
    let mut times: Vec<(f64, bool)> =
        (numbers.map(|number| ((number as f64 * experiment.step).min(stop), false))).collect();
    for (place, of) in moves.iter().enumerate() {
        let breaks = of.breaks(stop).ok_or_else(|| {
            let message = format!(
                "expected at most {MOST_BREAKS} kinks and jumps in the experiment, found more"
            );
            Error::new(format!("accuracy.input_profiles[{place}].value"), message)
        })?;
        times.extend(breaks.into_iter().map(|time| (time, true)));
    }
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    let same = SAME * experiment.step;
    times.dedup_by(|later, first| {
        let is_same = later.0 - first.0 <= same;
        if is_same && later.1 {
            *first = *later;
        }
        is_same
    });
    Ok(times)
}
