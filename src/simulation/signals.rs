//! Inputs that vary in time: straight lines between the rows of a table.

use super::{Error, Simulation, Source, Variable};

/// Rows of a table that are this far apart at most, in communication steps, are at one time.
const SAME_TIME: f64 = 1e-9;

/// Values of inputs at times. Between two rows an input follows a straight line; two rows of one time are a jump,
/// and what is read at that time belongs to the motion before it.
#[derive(Clone, Debug, PartialEq)]
pub struct Signals {
    /// Indices of the inputs among the variables.
    inputs: Vec<usize>,
    /// Times, s, in order.
    times: Vec<f64>,
    /// One value per input, at every time.
    rows: Vec<Vec<f64>>,
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

fn wrong<T>(message: String) -> Result<T, SignalError> {
    Err(SignalError::Wrong(message))
}

impl Signals {
    /// Reads a CSV file: a line of names, `time` first, then numbers.
    ///
    /// # Errors
    /// A column that is no input or stands twice, a field that is no finite number, times that go back or stand
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
            inputs,
            times: Vec::new(),
            rows: Vec::new(),
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

    /// Whether an input, by its index among the variables, has a column.
    pub fn holds(&self, index: usize) -> bool {
        self.inputs.contains(&index)
    }

    /// Sets the inputs to their values at a time, and to the slopes of the lines that they follow from there.
    ///
    /// # Errors
    /// As [`Simulation::set_real`].
    fn apply(&self, simulation: &mut Simulation, time: f64, slack: f64) -> Result<(), Error> {
        let row = self
            .times
            .partition_point(|&at| at <= time + slack)
            .saturating_sub(1);
        let next = (row + 1).min(self.times.len() - 1);
        let span = self.times[next] - self.times[row];
        for (place, &index) in self.inputs.iter().enumerate() {
            let (from, to) = (self.rows[row][place], self.rows[next][place]);
            let slope = if span > 0.0 { (to - from) / span } else { 0.0 };
            simulation.set_real(index, from + slope * (time - self.times[row]))?;
            simulation.set_input_derivative(index, 1, slope)?;
        }
        Ok(())
    }
}

impl Simulation {
    /// Sets inputs to their values at the present time.
    ///
    /// # Errors
    /// As [`Self::set_real`].
    pub fn set_inputs(&mut self, signals: &Signals) -> Result<(), Error> {
        signals.apply(self, self.time(), 0.0)
    }

    /// Advances to `until`, or to the next row of the signals where that comes first, with inputs that follow
    /// them; the caller goes on until it is there.
    ///
    /// # Errors
    /// As [`Self::step`], as a text.
    pub fn step_along(&mut self, signals: &Signals, until: f64) -> Result<(), String> {
        let time = self.time();
        let slack = SAME_TIME * (until - time);
        let stop = signals.times.partition_point(|&at| at <= time + slack);
        let row = signals.times.get(stop).copied().unwrap_or(until);
        let end = if row < until - slack { row } else { until };
        let applied = signals.apply(self, time, slack);
        applied.map_err(|error| error.to_string())?;
        self.step(end).map_err(|failure| failure.to_string())
    }
}
