//! Variables by name: those that are set, and those that were meant.

use anyhow::{Result, anyhow};
use flexbody::scene::did_you_mean;
use flexbody::simulation::{Causality, Simulation};

/// Sets what an option says, and returns the place of the variable.
pub fn assign(simulation: &mut Simulation, assignment: &str) -> Result<usize> {
    let wrong = |found: &str| anyhow!("--set {assignment}: {found}");
    let (name, value) = assignment
        .split_once('=')
        .ok_or_else(|| wrong("expected NAME=VALUE"))?;
    let index = settable(simulation, name.trim()).map_err(|found| wrong(&found))?;
    let value = value.trim().parse();
    let value = value.map_err(|_| wrong("expected a number"))?;
    set(simulation, index, value).map_err(|found| wrong(&found))?;
    Ok(index)
}

/// The parameter or input of a name; without one, what to say.
pub fn settable(simulation: &Simulation, name: &str) -> Result<usize, String> {
    let mut variables = simulation.variables().iter();
    variables
        .position(|variable| variable.name == name)
        .ok_or_else(|| {
            let kinds = |kind| matches!(kind, Causality::Parameter | Causality::Input);
            let alike = did_you_mean(name, names(simulation, kinds));
            format!("no variable of this name{alike}")
        })
}

/// Sets a variable, or says what is wrong.
pub fn set(simulation: &mut Simulation, index: usize, value: f64) -> Result<(), String> {
    let outcome = if simulation.variables()[index].is_integer() {
        let whole = value as i32;
        if f64::from(whole) != value {
            return Err("expected an integer".into());
        }
        simulation.set_integer(index, whole)
    } else {
        simulation.set_real(index, value)
    };
    outcome.map_err(|error| error.to_string())
}

/// Places of the outputs.
pub fn outputs(simulation: &Simulation) -> Vec<usize> {
    let all = simulation.variables().iter().enumerate();
    let outputs = all.filter(|(_, variable)| Causality::of(variable) == Causality::Output);
    outputs.map(|(index, _)| index).collect()
}

/// Names of the variables of some kinds.
pub fn names(simulation: &Simulation, is_wanted: impl Fn(Causality) -> bool) -> Vec<&str> {
    let variables = simulation.variables().iter();
    let wanted = variables.filter(|variable| is_wanted(Causality::of(variable)));
    wanted.map(|variable| variable.name.as_str()).collect()
}
