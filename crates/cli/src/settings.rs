//! Variables by name: those that are set, and those that were meant.

use anyhow::{Result, anyhow};
use flexbody::scene::{Scene, did_you_mean};
use flexbody::simulation::{Causality, Simulation, Variable, variables};

/// The name and the value that an option says.
fn parsed(assignment: &str) -> Result<(&str, f64)> {
    let wrong = |found: &str| anyhow!("--set {assignment}: {found}");
    let (name, value) = assignment
        .split_once('=')
        .ok_or_else(|| wrong("expected NAME=VALUE"))?;
    let value = value.trim().parse();
    let value = value.map_err(|_| wrong("expected a number"))?;
    Ok((name.trim(), value))
}

/// Sets the variable that an option names. Returns its index.
///
/// # Errors
/// An option of another form, a name that cannot be set, or a value that is refused.
pub fn assign(simulation: &mut Simulation, assignment: &str) -> Result<usize> {
    let wrong = |found: &str| anyhow!("--set {assignment}: {found}");
    let (name, value) = parsed(assignment)?;
    let index = settable(simulation.variables(), name).map_err(|found| wrong(&found))?;
    set(simulation, index, value).map_err(|found| wrong(&found))?;
    Ok(index)
}

/// Reads names and values of options, each of a parameter or input of the scene.
///
/// # Errors
/// An option of another form, or a name that cannot be set.
pub fn assignments(scene: &Scene, options: &[String]) -> Result<Vec<(String, f64)>> {
    let variables = variables(scene);
    let checked = options.iter().map(|option| {
        let (name, value) = parsed(option)?;
        settable(&variables, name).map_err(|found| anyhow!("--set {option}: {found}"))?;
        Ok((name.to_owned(), value))
    });
    checked.collect()
}

/// Finds the parameter or input with a name.
///
/// # Errors
/// No such variable, in words with similar names.
pub fn settable(variables: &[Variable], name: &str) -> Result<usize, String> {
    let place = variables.iter().position(|variable| variable.name == name);
    place.ok_or_else(|| {
        let kinds = |kind| matches!(kind, Causality::Parameter | Causality::Input);
        let alike = did_you_mean(name, names(variables, kinds));
        format!("no variable of this name{alike}")
    })
}

/// Sets a variable, or says what is wrong.
///
/// # Errors
/// A value that the simulation refuses, in words.
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
pub fn names(variables: &[Variable], is_wanted: impl Fn(Causality) -> bool) -> Vec<&str> {
    let wanted = (variables.iter()).filter(|variable| is_wanted(Causality::of(variable)));
    wanted.map(|variable| variable.name.as_str()).collect()
}
