//! What a simulation refuses: variables that are not there, numbers that are not finite, orientations that are none.

use super::{Error, Simulation, Variable};

impl Simulation {
    /// Returns the variable of an index.
    ///
    /// # Errors
    /// An index beyond the last variable.
    pub(super) fn variable(&self, index: usize) -> Result<&Variable, Error> {
        self.variables.get(index).ok_or_else(|| Error::Variable {
            name: format!("value reference {index}"),
            message: format!("expected one below {}", self.variables.len()),
        })
    }

    /// Returns a computed value that is finite.
    ///
    /// # Errors
    /// A value that is not finite, or inputs that are no orientation.
    pub(super) fn finite(&self, index: usize, found: f64) -> Result<f64, Error> {
        if found.is_finite() {
            return Ok(found);
        }
        self.check_quaternions()?;
        let message = format!(
            "expected a finite number, found {found}: an input or a parameter is too large"
        );
        Err(self.refuse(index, &message))
    }

    /// Checks the inputs of orientations. Their parts are set one after another, so they are checked together when they
    /// are used.
    ///
    /// # Errors
    /// Four parts of length 0 or not finite.
    pub(super) fn check_quaternions(&self) -> Result<(), Error> {
        for place in &self.quaternions {
            let parts = &self.values[*place..][..4];
            let square: f64 = parts.iter().map(|part| part * part).sum();
            if square.is_normal() {
                continue;
            }
            let name = self.variables[*place].name.trim_end_matches("[1]");
            return Err(Error::Variable {
                name: name.into(),
                message: format!(
                    "expected an orientation (four parts, scalar first, of a length other than 0), found {parts:?}"
                ),
            });
        }
        Ok(())
    }

    /// Builds the error that refuses a variable.
    pub(super) fn refuse(&self, index: usize, message: &str) -> Error {
        let name = self.variables[index].name.clone();
        Error::Variable {
            name,
            message: message.into(),
        }
    }
}
