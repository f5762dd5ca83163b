//! What was planned, and why.

/// Where the numbers of a planned scene come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Error wanted.
    pub error: f64,
    /// Bodies in the order of the scene.
    pub bodies: Vec<PlannedBody>,
    /// Tolerance chosen.
    pub tolerance: f64,
    /// Integrator at the end of the experiment.
    pub method: String,
    /// Inputs that kept their start values.
    pub held: Vec<String>,
    /// Outputs that count.
    pub outputs: Vec<PlannedOutput>,
    /// The choice, and the next cheaper and dearer ones, where they were run.
    pub chosen: Option<Price>,
    /// See `chosen`.
    pub cheaper: Option<Price>,
    /// See `chosen`.
    pub dearer: Option<Price>,
    /// Runs that were made, and what they cost together, in runs with the choice.
    pub runs: usize,
    /// See `runs`.
    pub runs_cost: f64,
}

/// What a body became.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedBody {
    /// Its name.
    pub name: String,
    /// `cable` or `rigid`.
    pub kind: String,
    /// Number of elements of a cable.
    pub elements: Option<u32>,
    /// The fewest that a cable can have, or is given.
    pub fewest: Option<u32>,
    /// Why.
    pub why: String,
}

/// What is known of an output.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedOutput {
    /// Its name, without an index.
    pub name: String,
    /// Error estimated over the experiment, relative.
    pub error: f64,
    /// What errors are relative to, in the unit of the output.
    pub scale: f64,
    /// Whether the first instant is left out.
    pub skips_start: bool,
    /// Whether the error wanted is kept.
    pub settles: Settles,
}

/// Whether an output keeps the error wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Settles {
    /// Over the whole experiment.
    Yes,
    /// Up to this time, s.
    Until(f64),
    /// Not at all.
    No,
}

/// What a choice costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Price {
    /// Elements of every cable.
    pub elements: Vec<u32>,
    /// Tolerance.
    pub tolerance: f64,
    /// Work (operations times parts) in a second of simulated time.
    pub work: f64,
    /// Largest error estimated; nothing where it is not known.
    pub error: Option<f64>,
}

/// Time of an operation on a part, s: an explicit evaluation of an element on a processor of 2024.
const OPERATION: f64 = 36e-9;

impl Price {
    /// What a second of simulated time costs, about, ms: counted, not measured.
    pub fn milliseconds(&self) -> f64 {
        1e3 * OPERATION * self.work
    }
}

/// An estimated error in words.
pub fn estimate(error: f64) -> String {
    match error.is_finite() {
        true => format!("{error:.1e}"),
        false => "not known".into(),
    }
}
