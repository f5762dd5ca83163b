//! The page of a unit in the words of FMI 2.0.

use crate::fmi::Category;
use crate::page::{self, Interface};
use crate::scene::Scene;
use crate::simulation::Planned;

/// How an input moves during a step.
const INPUTS: &str = "With derivatives of order 1 and 2 (<code>fmi2SetRealInputDerivatives</code>; they belong to the \
    beginning of the step) it moves along the line or parabola in the next step, in that one only, and stands \
    where it ended until it is set again.";

/// Failures of a call: status, meaning, remedy.
const FAILURES: [[&str; 3]; 4] = [
    [
        "<code>fmi2Discard</code> from <code>fmi2DoStep</code>",
        "the solver could do only a part of the step",
        "ask <code>fmi2GetRealStatus(fmi2LastSuccessfulTime)</code>, restore a saved state and take a shorter step, \
         or terminate",
    ],
    [
        "<code>fmi2Error</code>",
        "a call out of order, an unknown variable, a value out of range, a step past the stop time; the instance is \
         as before",
        "read the log, correct the call",
    ],
    [
        "<code>fmi2Error</code> from initialization",
        "there is no initial state, for instance no equilibrium, or bodies that do not fit together",
        "<code>fmi2Reset</code>, or restore a saved state; then other values",
    ],
    [
        "<code>fmi2Fatal</code>",
        "a defect of the library",
        "free the instance; please report the message",
    ],
];

/// The documentation of a scene, of how it was planned, and of it in motion (nothing where it stands still), as one HTML page. The same
/// gives the same bytes.
pub fn documentation(scene: &Scene, planned: &Planned, motion: &str) -> String {
    let of = |category: Category| {
        let name = category.name().to_str().unwrap_or_default();
        [name, category.description()]
    };
    let interface = Interface {
        standard: "FMI 2.0",
        inputs: INPUTS,
        tolerance: "fmi2SetupExperiment",
        failures: &FAILURES,
        categories: &Category::ALL.map(of),
    };
    page::documentation(scene, planned, motion, &interface)
}
