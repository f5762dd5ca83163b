//! Tables of inputs that vary in time.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Error, Result};
use flexbody::scene::{Interpolation, did_you_mean};
use flexbody::simulation::{Causality, InputTable, SignalError, Signals, Variable};

use crate::reading::at;
use crate::settings::names;

/// A table, and what is between its rows.
#[derive(clap::Args)]
pub struct Inputs {
    /// CSV file of inputs that vary in time: a column `time` and one for every input, named like it; two rows of one time are
    /// a jump. Rates of prescribed motions without a column are those of the curve through the values.
    #[arg(long)]
    pub input: Option<PathBuf>,
    /// The curve through the rows of `--input`.
    #[arg(long, value_enum, default_value_t = Curve::Linear)]
    pub interpolation: Curve,
}

/// Curves through the rows of a table.
#[derive(Clone, Copy, clap::ValueEnum)]
pub enum Curve {
    /// Straight lines: the rate of a prescribed motion jumps at every row, its acceleration is 0 between them.
    Linear,
    /// Cubic splines with continuous first and second derivatives.
    Spline,
}

impl From<Curve> for Interpolation {
    fn from(curve: Curve) -> Self {
        match curve {
            Curve::Linear => Self::Linear,
            Curve::Spline => Self::Spline,
        }
    }
}

impl Inputs {
    /// Reads the table of inputs, if a file is named.
    ///
    /// # Errors
    /// A file that cannot be read, or is no table.
    pub fn table(&self) -> Result<Option<(InputTable, &Path)>> {
        let Some(path) = &self.input else {
            return Ok(None);
        };
        let text = fs::read_to_string(path).map_err(|error| at(path, error))?;
        let curve = self.interpolation.into();
        Ok(Some((InputTable { text, curve }, path)))
    }
}

/// Builds the signals of a table for a run that ends at `stop_time`, s.
///
/// # Errors
/// A column that is no input, or rows that do not cover the run.
pub fn signals(
    table: &InputTable,
    path: &Path,
    variables: &[Variable],
    stop_time: f64,
) -> Result<Signals> {
    let found = table.signals(variables);
    let found = found.and_then(|signals| signals.check_covers(0.0, stop_time).map(|()| signals));
    found.map_err(|error| refused(&error, path, variables))
}

/// A refusal of a table, with the names that may have been meant.
fn refused(error: &SignalError, path: &Path, variables: &[Variable]) -> Error {
    match error {
        SignalError::Unknown(name) => {
            let inputs = names(variables, |kind| kind == Causality::Input);
            at(path, format!("{error}{}", did_you_mean(name, inputs)))
        }
        SignalError::Wrong(_) => at(path, error),
    }
}
