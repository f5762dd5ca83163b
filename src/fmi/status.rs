//! Answers of FMI functions: the status for the master, and the reason for a person.

use crate::simulation::{self, StepFailure};

/// Status of a call, with the numbers that FMI 2.0 and 3.0 give to it. Another one of 2.0, `fmi2Pending`, is never
/// answered, because no step runs in the background.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum Status {
    /// Done.
    Ok,
    /// Done, with a remark in the log.
    Warning,
    /// Done in part; the instance says how far.
    Discard,
    /// Refused.
    Error,
    /// The instance is of no more use.
    Fatal,
}

/// Why a call was not answered with [`Status::Ok`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// A pointer that must not be NULL was NULL, or its count was impossibly large.
    #[error("{0}: expected an array of the stated length, found NULL or an impossible length")]
    Pointer(&'static str),
    /// A text that is not UTF-8.
    #[error("{0}: expected a text in UTF-8")]
    Text(&'static str),
    /// An argument out of range.
    #[error("{name}: expected {expected}, found {found}")]
    Argument {
        /// Name of the argument in the standard.
        name: &'static str,
        /// Expected range of the argument, in words.
        expected: &'static str,
        /// Argument that was passed.
        found: f64,
    },
    /// A value reference that no variable has.
    #[error("value reference {reference}: expected a number below {count}")]
    Reference {
        /// The value reference.
        reference: u32,
        /// How many variables there are.
        count: usize,
    },
    /// A variable of another type.
    #[error("{name}: is of type {actual}, not {asked}")]
    Type {
        /// Name of the variable.
        name: String,
        /// Type of the variable.
        actual: &'static str,
        /// The type that the function is for.
        asked: &'static str,
    },
    /// A variable that may not be set now, or never.
    #[error("{name}: {reason}, and this call came in state {state}")]
    NotSettable {
        /// Name of the variable.
        name: String,
        /// When it may be set.
        reason: &'static str,
        /// The state of the instance.
        state: &'static str,
    },
    /// A value out of range.
    #[error("{name}: {reason}")]
    Value {
        /// Name of the variable.
        name: String,
        /// Expectation and finding, in words.
        reason: String,
    },
    /// A communication point that is not where the instance is.
    #[error(
        "currentCommunicationPoint: expected {expected} (where the last step ended), found {found}"
    )]
    CommunicationPoint {
        /// Time of the instance.
        expected: f64,
        /// Time that the master stated.
        found: f64,
    },
    /// A step past the stop time.
    #[error("the step would end at {until}, past the stop time {stop} of {experiment}")]
    StopTime {
        /// End of the step.
        until: f64,
        /// Stop time.
        stop: f64,
        /// The function that it was given to.
        experiment: &'static str,
    },
    /// A category that the model description does not list.
    #[error(
        "log category \"{0}\": expected logAll or some of logStatusError, logStatusWarning, logEvents, logSolver; logging goes on with \
         those of them that were named"
    )]
    Category(String),
    /// Derivatives that are not to be had now.
    #[error("{0}")]
    NotNow(&'static str),
    /// A question that has no answer.
    #[error("{0}")]
    NoAnswer(&'static str),
    /// A saved state that cannot be used.
    #[error("saved state: {0}")]
    SavedState(String),
    /// A step that could be done only in part.
    #[error(transparent)]
    Step(#[from] StepFailure),
    /// Done, but there is something to know.
    #[error("{0}")]
    Remark(&'static str),
    /// A computation that failed.
    #[error(transparent)]
    Computation(#[from] simulation::Error),
}

impl Fault {
    /// The status that the master gets.
    pub fn status(&self) -> Status {
        match self {
            Self::Remark(_) | Self::Category(_) => Status::Warning,
            Self::Step(_) | Self::NoAnswer(_) => Status::Discard,
            _ => Status::Error,
        }
    }
}
