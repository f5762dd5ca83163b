//! Parameters and inputs that a plan is made for, in place of what the scene says.

use super::courses::courses;
use crate::scene::{Error, Scene, did_you_mean};
use crate::simulation::{Causality, Error as Refusal, InputTable, Simulation, Variable, variables};

/// The name of the tolerance among parameters.
const TOLERANCE: &str = "relative_tolerance";

/// Parameters and inputs given for the runs of a plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrialConditions {
    /// Values of parameters and inputs, by their names.
    pub set: Vec<(String, f64)>,
    /// Table of inputs that replaces `accuracy.input_profiles`.
    pub inputs: Option<InputTable>,
}

/// Whether a variable is what is planned: a number of elements, or the tolerance.
fn is_planned(variable: &Variable) -> bool {
    variable.is_integer() || variable.name == TOLERANCE
}

impl TrialConditions {
    /// Refuses a name that is no parameter or input of a scene, and a number of elements or the tolerance, which are what is planned.
    ///
    /// # Errors
    /// A name that is no parameter or input of the scene, or that of a planned number.
    pub(super) fn check(&self, scene: &Scene) -> Result<(), Error> {
        let variables = variables(scene);
        let settable = || {
            let is_settable = |kind| matches!(kind, Causality::Parameter | Causality::Input);
            (variables.iter()).filter(move |variable| is_settable(Causality::of(variable)))
        };
        for (name, _) in &self.set {
            let refused = |message: String| Err(Error::new(name.clone(), message));
            match settable().find(|variable| variable.name == *name) {
                Some(variable) if is_planned(variable) => {
                    return refused("expected a parameter that is not planned".into());
                }
                Some(_) => (),
                None => {
                    let meant = did_you_mean(name, settable().map(|v| v.name.as_str()));
                    return refused(format!("expected a parameter or an input{meant}"));
                }
            }
        }
        Ok(())
    }

    /// Removes numbers of elements and the tolerance, which a run may set to other values than planned.
    #[must_use]
    pub fn without_planned(mut self, scene: &Scene) -> Self {
        let variables = variables(scene);
        self.set.retain(|(name, _)| {
            let variable = variables.iter().find(|variable| variable.name == *name);
            !variable.is_some_and(is_planned)
        });
        self
    }

    /// Sets parameters and inputs. Parameters that the planned bodies no longer have are left out.
    ///
    /// # Errors
    /// A value that the simulation refuses.
    pub(in crate::simulation) fn set(&self, simulation: &mut Simulation) -> Result<(), Refusal> {
        for (name, value) in &self.set {
            let place = simulation.variables().iter().position(|v| v.name == *name);
            if let Some(place) = place {
                simulation.set_real(place, *value)?;
            }
        }
        Ok(())
    }

    /// Returns the table of inputs for a scene: the given one, or that of `accuracy.input_profiles`. `None` if all
    /// inputs keep their values.
    ///
    /// # Errors
    /// A profile of something other than an input, or a table that does not cover the experiment.
    pub(super) fn moved(&self, scene: &Scene) -> Result<Option<InputTable>, Error> {
        let (table, place) = match &self.inputs {
            Some(table) => (Some(table.clone()), "input"),
            None => (courses(scene)?, "accuracy.input_profiles"),
        };
        if let Some(table) = &table {
            let signals = table.signals(&variables(scene));
            let covers = signals.and_then(|s| s.check_covers(0.0, scene.experiment.stop_time));
            covers.map_err(|error| Error::new(place, error.to_string()))?;
        }
        Ok(table)
    }
}
