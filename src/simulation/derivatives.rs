//! Derivatives: of inputs, which the master knows; of outputs in time; of outputs by inputs.

use super::{ENGINE, Error, Simulation, Source};
use crate::scene::InitialState;

impl Simulation {
    /// Sets the derivative of order 1 or 2 of an input at the present time. It moves the input in the
    /// next step, and in that one only.
    ///
    /// # Errors
    /// No input, another order, or not finite; nothing has changed then.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let mut simulation = Simulation::new(scene.clone());
    /// // The force grows from 4 N by 6 N/s.
    /// simulation.set_input_derivative(place("stone.centre.force[1]"), 1, 6.0)?;
    /// simulation.step(1.0)?;
    /// assert!((simulation.real(place("stone.centre.velocity[1]"))? - 3.5).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_input_derivative(
        &mut self,
        index: usize,
        order: i32,
        value: f64,
    ) -> Result<(), Error> {
        self.check_input_derivative(index, order, value)?;
        self.inputs.drop_slopes();
        self.inputs.moving = true;
        self.unset_rates.set(index, false);
        if let Source::Input(place) = self.variables[index].source {
            self.inputs.slopes[place][order as usize - 1] = value;
        }
        if let Some(engine) = &mut self.engine {
            engine.inputs_changed(&self.inputs);
        }
        Ok(())
    }

    /// Whether [`Self::set_input_derivative`] would take this.
    ///
    /// # Errors
    /// Its errors.
    pub fn check_input_derivative(
        &self,
        index: usize,
        order: i32,
        value: f64,
    ) -> Result<(), Error> {
        if !matches!(self.variable(index)?.source, Source::Input(_)) {
            return Err(self.refuse(index, "expected an input"));
        }
        if !(1..=2).contains(&order) {
            let found = format!("expected a derivative of order 1 or 2, found {order}");
            return Err(self.refuse(index, &found));
        }
        if !value.is_finite() {
            return Err(self.refuse(index, &format!("expected a finite number, found {value}")));
        }
        Ok(())
    }

    /// Derivative in time of an output now: exact up to order 2, zero of higher ones. Inputs go on as
    /// their derivatives say: those that are set, else those of the step before.
    ///
    /// # Errors
    /// No output, an order below 1, or not finite.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let mut simulation = Simulation::new(scene.clone());
    /// simulation.start()?;
    /// let acceleration = simulation.output_derivative(place("stone.centre.velocity[1]"), 1)?;
    /// assert!((acceleration - 2.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn output_derivative(&mut self, index: usize, order: i32) -> Result<f64, Error> {
        self.check_output_derivative(index, order)?;
        let (state, inputs) = (&self.state, &self.inputs);
        let (Source::Output(quantity), Some(engine), 1..=2) =
            (self.variables[index].source, &mut self.engine, order)
        else {
            return Ok(0.0);
        };
        let found = engine.derivative(quantity, order as usize, state, inputs);
        self.finite(index, found)
    }

    /// Whether [`Self::output_derivative`] would answer this.
    ///
    /// # Errors
    /// Its errors.
    pub fn check_output_derivative(&self, index: usize, order: i32) -> Result<(), Error> {
        if !matches!(self.variable(index)?.source, Source::Output(_)) {
            return Err(self.refuse(index, "expected an output"));
        }
        if order < 1 {
            let found = format!("expected a derivative of order 1 or more, found {order}");
            return Err(self.refuse(index, &found));
        }
        Ok(())
    }

    /// Whether the initial state depends on one of these inputs: by static equilibrium, or by motions that
    /// inputs drive.
    pub fn start_follows(&self, mut inputs: impl Iterator<Item = usize>) -> bool {
        let equilibrium = self.scene.initial.state() != InitialState::Undeformed;
        inputs.any(|index| {
            let variable = self.variables.get(index);
            variable.is_some_and(|input| equilibrium || !input.acts_at_once())
        })
    }

    /// Prepares [`Self::change`] of `outputs` with inputs (index, change) at the present time.
    ///
    /// # Errors
    /// What is no output or no input; no initial state.
    pub fn differentiate(
        &mut self,
        mut outputs: impl Iterator<Item = usize>,
        inputs: impl Iterator<Item = (usize, f64)>,
    ) -> Result<(), Error> {
        self.direction.fill(0.0);
        for (index, change) in inputs {
            match self.variable(index)?.source {
                Source::Input(place) => self.direction[place] += change,
                _ => return Err(self.refuse(index, "expected an input as a known")),
            }
        }
        outputs.try_for_each(|index| match self.variable(index)?.source {
            Source::Output(_) => Ok(()),
            _ => Err(self.refuse(index, "expected an output as an unknown")),
        })?;
        self.refresh()?;
        let engine = self.engine.as_mut().expect(ENGINE);
        engine.differentiate(&self.state, &self.inputs, &self.direction);
        Ok(())
    }

    /// How an output changes along the direction of the last [`Self::differentiate`]: exact, to first
    /// order. Nothing else may be asked in between.
    ///
    /// # Errors
    /// No output, or not finite.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::{Simulation, variables}};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let place = |name: &str| variables(&scene).iter().position(|v| v.name == name).expect("a variable");
    /// # let mut simulation = Simulation::new(scene.clone());
    /// let (velocity, force) = (place("stone.centre.velocity[1]"), place("stone.centre.force[1]"));
    /// simulation.differentiate([velocity].into_iter(), [(force, 1.0)].into_iter())?;
    /// // A velocity does not depend on the force at the same time.
    /// assert_eq!(simulation.change(velocity)?, 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn change(&mut self, index: usize) -> Result<f64, Error> {
        let Source::Output(quantity) = self.variable(index)?.source else {
            return Err(self.refuse(index, "expected an output as an unknown"));
        };
        let Some(engine) = &mut self.engine else {
            return Err(self.refuse(index, "expected a call of `differentiate` before"));
        };
        let change = engine.change(quantity, &self.state);
        self.finite(index, change)
    }
}
