//! What a variable is to who simulates: given, set, read or computed.

use super::{Parameter, Source, Variable};
use crate::scene::{ELEMENTS, TOLERANCE};

/// Causality of a variable: what the XML states and what decides when it may be set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    /// Time.
    Independent,
    /// Fixed when initialization ends.
    Parameter,
    /// Set by the master at every communication point.
    Input,
    /// Read by the master.
    Output,
    /// Follows from parameters.
    CalculatedParameter,
}

impl Causality {
    /// The causality of a variable.
    pub fn of(variable: &Variable) -> Self {
        match variable.source {
            Source::Time => Self::Independent,
            Source::Parameter(_) => Self::Parameter,
            Source::Input(..) => Self::Input,
            Source::Output(_) => Self::Output,
            Source::NaturalFrequency(_) | Source::Eigenvalue(..) => Self::CalculatedParameter,
        }
    }
}

impl Variable {
    /// Whether it is computed: an output or a calculated parameter.
    pub fn is_computed(&self) -> bool {
        matches!(
            Causality::of(self),
            Causality::Output | Causality::CalculatedParameter
        )
    }

    /// Least and greatest value of a parameter, as far as bounds can say it: where zero itself is
    /// refused, setting the parameter says so.
    pub fn limits(&self) -> (Option<f64>, Option<f64>) {
        let Source::Parameter(parameter) = self.source else {
            return (None, None);
        };
        match parameter {
            Parameter::Gravity(_) | Parameter::Rotation(_) => (None, None),
            Parameter::Elements(_) => (
                Some(f64::from(*ELEMENTS.start())),
                Some(f64::from(*ELEMENTS.end())),
            ),
            Parameter::RelativeTolerance => (Some(*TOLERANCE.start()), Some(*TOLERANCE.end())),
            _ => (Some(0.0), None),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::example;
    use crate::simulation::variables;

    #[test]
    fn limits_admit_every_start_value() {
        for variable in variables(&example()) {
            let (min, max) = variable.limits();
            let start = variable.start.unwrap_or(0.0);
            assert!(min.is_none_or(|min| min <= start), "{}", variable.name);
            assert!(max.is_none_or(|max| start <= max), "{}", variable.name);
        }
    }
}
