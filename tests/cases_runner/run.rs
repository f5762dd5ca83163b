//! A scene in simulation, driven the way the tests of the packaged FMU drive theirs.
//!
//! What takes the steps is given: the product, or a method of the studies whose states the product reads.

use std::fs;
use std::path::Path;

use flexbody::scene::{Scene, beside};
use flexbody::simulation::{Simulation, Source};

use super::claim::{Change, Given};

/// Two times nearer than this, relative to the later, are the same communication point.
pub const SAME_TIME: f64 = 1e-9;

/// Steps a simulation to a time.
pub type Step = Box<dyn FnMut(&mut Simulation, f64) -> Result<(), String>>;
/// Makes what steps a simulation of the scene in a file, once it has started.
pub type Method = dyn Fn(&Path, &Simulation) -> Result<Step, String> + Sync;

/// A simulation by variable names.
pub struct Run {
    simulation: Simulation,
    step: Step,
    /// Inputs that will change.
    changes: Vec<Change>,
}

impl Run {
    /// Builds a simulation that is ready for steps. Parameters are set before initialization, inputs during it.
    ///
    /// # Errors
    /// A scene, a name or a value that is refused, in words.
    pub fn start(path: &Path, given: &Given, method: &Method) -> Result<Self, String> {
        let at = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let text = fs::read_to_string(path).map_err(|error| at(&error))?;
        let files = beside(path.parent().unwrap_or(Path::new("")));
        let scene = Scene::from_json_with(&text, &files).map_err(|error| at(&error))?;
        let mut run = Self {
            simulation: Simulation::new(scene),
            step: Box::new(|_, _| Ok(())),
            changes: given.changes.clone(),
        };
        let mut inputs = Vec::new();
        for (name, value) in &given.set {
            let index = run.index(name)?;
            if matches!(run.simulation.variables()[index].source, Source::Input(..)) {
                inputs.push((index, *value));
            } else {
                run.set(index, *value)?;
            }
        }
        run.simulation.initialize(0.0).map_err(|error| at(&error))?;
        for (index, value) in inputs {
            run.set(index, value)?;
        }
        run.simulation.start().map_err(|error| at(&error))?;
        run.step = method(path, &run.simulation)?;
        Ok(run)
    }

    fn index(&self, name: &str) -> Result<usize, String> {
        let variables = self.simulation.variables();
        variables
            .iter()
            .position(|v| v.name == name)
            .ok_or_else(|| {
                let known: Vec<&str> = variables.iter().map(|v| v.name.as_str()).collect();
                format!(
                    "{name}: expected a variable; there are {}",
                    known.join(", ")
                )
            })
    }

    fn set(&mut self, index: usize, value: f64) -> Result<(), String> {
        let variable = &self.simulation.variables()[index];
        if !variable.is_integer() {
            return self
                .simulation
                .set_real(index, value)
                .map_err(|e| e.to_string());
        }
        let integer = value as i32;
        if f64::from(integer) != value {
            return Err(format!(
                "{}: expected an integer, found {value}",
                variable.name
            ));
        }
        self.simulation
            .set_integer(index, integer)
            .map_err(|e| e.to_string())
    }

    /// Returns the values of real variables, in order.
    ///
    /// # Errors
    /// A variable that does not exist or cannot be computed, in words.
    pub fn get<'a>(
        &mut self,
        names: impl IntoIterator<Item = &'a String>,
    ) -> Result<Vec<f64>, String> {
        let value = |name: &String| {
            let index = self.index(name)?;
            self.simulation
                .real(index)
                .map_err(|error| error.to_string())
        };
        names.into_iter().map(value).collect()
    }

    /// Steps to `stop_time` and passes the time of every communication point to `visit`.
    ///
    /// # Errors
    /// A step that fails, or an error of `visit`, in words.
    pub fn steps(
        &mut self,
        stop_time: f64,
        step: f64,
        mut visit: impl FnMut(&mut Self, f64) -> Result<(), String>,
    ) -> Result<(), String> {
        if !(step.is_finite() && step > 0.0 && stop_time.is_finite()) {
            return Err(format!(
                "expected a finite stop_time and a positive step, found {stop_time} and {step}"
            ));
        }
        let (mut time, mut count) = (0.0, 0_u32);
        // The last communication point may be nearer than a step, but never by roundoff alone.
        while time < stop_time - 1e-9 * step {
            count += 1;
            let mut following = (f64::from(count) * step).min(stop_time);
            if stop_time - following < 1e-9 * step {
                following = stop_time;
            }
            (self.step)(&mut self.simulation, following)?;
            time = following;
            visit(self, time)?;
            self.change(time)?;
        }
        Ok(())
    }

    /// Changes the inputs that are due at a communication point.
    fn change(&mut self, time: f64) -> Result<(), String> {
        let due = |change: &Change| change.time <= time + SAME_TIME * time.max(1.0);
        while self.changes.first().is_some_and(due) {
            for (name, value) in self.changes.remove(0).set {
                let index = self.index(&name)?;
                self.set(index, value)?;
            }
        }
        Ok(())
    }
}
