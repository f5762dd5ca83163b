//! Inputs that vary in time, by the rows of a table.

use super::curves::{Curves, Implied, implied};
use super::{Error, Simulation, Source, Variable};
use crate::scene::Interpolation;

/// Rows of a table that are this far apart at most, in communication steps, are at one time.
const SAME_TIME: f64 = 1e-9;

/// Values of inputs at times. Between two rows an input follows a straight line, or a spline
/// ([`Self::interpolated`]); two rows of one time are a jump, and what is read at that time belongs to the motion before it.
/// A rate of a prescribed motion that has no column is that of the curve of its value.
#[derive(Clone, Debug)]
pub struct Signals {
    /// Indices of the inputs among the variables.
    pub(super) inputs: Vec<usize>,
    /// Times, s, in order.
    pub(super) times: Vec<f64>,
    /// One value per input, at every time.
    pub(super) rows: Vec<Vec<f64>>,
    /// Curves through the rows.
    pub(super) curves: Curves,
    /// Inputs without a column that follow from these.
    pub(super) implied: Vec<Implied>,
}

/// A table of inputs as text, and the curve through its rows: what inputs do before the variables are known.
#[derive(Clone, Debug, PartialEq)]
pub struct InputTable {
    /// CSV as [`Signals::from_csv`] reads it.
    pub text: String,
    /// The curve.
    pub curve: Interpolation,
}

impl InputTable {
    /// The signals of a scene with these variables.
    ///
    /// # Errors
    /// As [`Signals::from_csv`] and [`Signals::interpolated`].
    pub fn signals(&self, variables: &[Variable]) -> Result<Signals, SignalError> {
        Signals::from_csv(&self.text, variables)?.interpolated(self.curve)
    }
}

/// Why a table of inputs is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SignalError {
    /// A column that no variable is named like.
    #[error("column {0}: no variable of this name")]
    Unknown(String),
    /// Anything else: the place, what was expected, what was found.
    #[error("{0}")]
    Wrong(String),
}

/// Returns an error in words.
///
/// # Errors
/// Always: the message.
pub(super) fn wrong<T>(message: String) -> Result<T, SignalError> {
    Err(SignalError::Wrong(message))
}

impl Signals {
    /// Reads a CSV file: a line of names, `time` first, then numbers.
    ///
    /// # Errors
    /// A column that is no input or stands twice, or is the rate of a prescribed motion whose value has none; a field that is no finite number, times that go back or stand
    /// more than twice.
    pub fn from_csv(text: &str, variables: &[Variable]) -> Result<Self, SignalError> {
        let mut lines = text.trim_start_matches('\u{feff}').lines();
        let mut names = lines.next().unwrap_or_default().split(',').map(str::trim);
        let first = names.next().unwrap_or_default();
        if first != "time" {
            return wrong(format!(
                "line 1: expected a first column `time`, found `{first}`"
            ));
        }
        let mut inputs = Vec::new();
        for name in names {
            let index = variables.iter().position(|variable| variable.name == name);
            let index = index.ok_or_else(|| SignalError::Unknown(name.into()))?;
            if !matches!(variables[index].source, Source::Input(_)) {
                return wrong(format!(
                    "column {name}: expected an input, found another variable"
                ));
            }
            if inputs.contains(&index) {
                return wrong(format!(
                    "column {name}: expected every input once, found it twice"
                ));
            }
            inputs.push(index);
        }
        if inputs.is_empty() {
            return wrong("line 1: expected a column for an input beside `time`".into());
        }
        let mut signals = Self {
            implied: implied(&inputs, variables)?,
            inputs,
            times: Vec::new(),
            rows: Vec::new(),
            curves: Curves::Linear,
        };
        for (number, line) in lines
            .enumerate()
            .filter(|(_, line)| !line.trim().is_empty())
        {
            signals
                .add(line)
                .or_else(|message| wrong(format!("line {}: {message}", number + 2)))?;
        }
        if signals.times.is_empty() {
            return wrong("expected a row of numbers below the names, found none".into());
        }
        Ok(signals)
    }

    fn add(&mut self, line: &str) -> Result<(), String> {
        let number = |field: &str| match field.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(format!(
                "expected a finite number, found `{}`",
                field.trim()
            )),
        };
        let fields = line
            .split(',')
            .map(number)
            .collect::<Result<Vec<f64>, _>>()?;
        let (time, row) = (fields[0], &fields[1..]);
        if row.len() != self.inputs.len() {
            let expected = self.inputs.len() + 1;
            return Err(format!(
                "expected {expected} numbers, found {}",
                fields.len()
            ));
        }
        if let Some(&last) = self.times.last()
            && time < last
        {
            return Err(format!(
                "expected a time of {last} s or later, found {time} s"
            ));
        }
        if let [.., first, _] = self.times[..]
            && time == first
        {
            return Err(format!(
                "expected two rows at most at {time} s, found a third"
            ));
        }
        self.times.push(time);
        self.rows.push(row.to_vec());
        Ok(())
    }

    /// Replaces the curve through the rows by one of another interpolation.
    ///
    /// # Errors
    /// Rows that no curve goes through.
    pub fn interpolated(self, interpolation: Interpolation) -> Result<Self, SignalError> {
        let curves = Curves::new(interpolation, &self.times, &self.rows);
        let curves = curves.or_else(wrong)?;
        Ok(Self { curves, ..self })
    }

    /// Refuses a table that does not cover a run.
    ///
    /// # Errors
    /// It begins after the start or ends before the stop time, s.
    pub fn check_covers(&self, start: f64, stop: f64) -> Result<(), SignalError> {
        let (first, last) = (self.times[0], self.times[self.times.len() - 1]);
        let slack = SAME_TIME * (stop - start);
        if first > start + slack || last < stop - slack {
            return wrong(format!(
                "expected rows from {start} s to the stop time {stop} s, found {first} s to {last} s"
            ));
        }
        Ok(())
    }

    /// Indices of inputs without a column that follow from those that have one: rates of prescribed motions.
    pub fn following(&self) -> impl Iterator<Item = usize> {
        self.implied.iter().map(|implied| implied.input)
    }

    /// Whether an input, by its index among the variables, has a column or follows from one.
    pub fn holds(&self, index: usize) -> bool {
        self.inputs.contains(&index) || self.implied.iter().any(|implied| implied.input == index)
    }
}

impl Simulation {
    /// Sets inputs to their values at the present time.
    ///
    /// # Errors
    /// As [`Self::set_real`].
    pub fn set_inputs(&mut self, signals: &Signals) -> Result<(), Error> {
        signals.apply(self, [self.time(), 0.0], 0.0)
    }

    /// Advances to `until`, or to the next row of the signals where that comes first, with inputs that follow
    /// them; the caller goes on until it is there.
    ///
    /// # Errors
    /// As [`Self::step`], as a text.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let mut simulation = Simulation::new(scene.clone());
    /// # use flexbody::simulation::Signals;
    /// let table = "time,stone.centre.force[1]\n0,0\n1,6\n";
    /// let signals = Signals::from_csv(table, simulation.variables())?;
    /// simulation.set_inputs(&signals)?;
    /// simulation.step_along(&signals, 1.0)?;
    /// assert!((simulation.real(place("stone.centre.velocity[1]"))? - 1.5).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn step_along(&mut self, signals: &Signals, until: f64) -> Result<(), String> {
        let time = self.time();
        let slack = SAME_TIME * (until - time);
        let stop = signals.times.partition_point(|&at| at <= time + slack);
        let row = signals.times.get(stop).copied().unwrap_or(until);
        let end = if row < until - slack { row } else { until };
        let applied = signals.apply(self, [time, end - time], slack);
        applied.map_err(|error| error.to_string())?;
        self.step(end).map_err(|failure| failure.to_string())
    }
}
