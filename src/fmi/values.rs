//! Getting and setting variables by value reference.

use std::mem::MaybeUninit;

use super::instance::Instance;
use super::lifecycle::{InstanceState, rule, settable_states};
use super::status::Fault;
use crate::simulation::{Causality, Variable};

impl Instance {
    /// Reads real variables into `values`.
    ///
    /// # Errors
    /// A reference to no real variable, a state that cannot be computed, or a value that is not finite.
    pub fn get_real(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<f64>],
    ) -> Result<(), Fault> {
        for reference in references {
            self.variable(*reference, self.names.real)?;
        }
        for (reference, value) in references.iter().zip(values) {
            value.write(self.simulation.real(*reference as usize)?);
        }
        Ok(())
    }

    /// Reads integer variables into `values`.
    ///
    /// # Errors
    /// A reference to no integer variable.
    pub fn get_integer(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<i32>],
    ) -> Result<(), Fault> {
        for reference in references {
            self.variable(*reference, self.names.integer)?;
        }
        for (reference, value) in references.iter().zip(values) {
            value.write(self.simulation.integer(*reference as usize)?);
        }
        Ok(())
    }

    /// Sets real numbers: all or none.
    ///
    /// # Errors
    /// A reference to no real variable, one that cannot be set now, or a value out of range. No variable is changed
    /// then.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Result<(), Fault> {
        for (reference, value) in references.iter().zip(values) {
            let variable = self.settable(*reference, self.names.real)?;
            if !value.is_finite() {
                let reason = format!("expected a finite number, found {value}");
                return Err(Fault::Value {
                    name: variable.name.clone(),
                    reason,
                });
            }
        }
        let current = self.remember(references);
        for (done, (reference, value)) in references.iter().zip(values).enumerate() {
            let index = *reference as usize;
            if let Err(error) = self.simulation.set_real(index, *value) {
                self.take_back(&references[..done], current);
                return Err(error.into());
            }
        }
        Ok(())
    }

    /// Sets integers: all or none.
    ///
    /// # Errors
    /// A reference to no integer variable, one that cannot be set now, or a value out of range. No variable is changed
    /// then.
    pub fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Result<(), Fault> {
        for reference in references {
            self.settable(*reference, self.names.integer)?;
        }
        let current = self.remember(references);
        for (done, (reference, value)) in references.iter().zip(values).enumerate() {
            let index = *reference as usize;
            if let Err(error) = self.simulation.set_integer(index, *value) {
                self.take_back(&references[..done], current);
                return Err(error.into());
            }
        }
        Ok(())
    }

    /// Sets time derivatives of inputs: all or none.
    ///
    /// # Errors
    /// A reference to no input, an order other than 1 or 2, or a value that is not finite. No derivative is changed
    /// then.
    pub fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), Fault> {
        for ((reference, order), value) in references.iter().zip(orders).zip(values) {
            self.variable(*reference, self.names.real)?;
            let index = *reference as usize;
            self.simulation
                .check_input_derivative(index, *order, *value)?;
        }
        for ((reference, order), value) in references.iter().zip(orders).zip(values) {
            let index = *reference as usize;
            self.simulation
                .set_input_derivative(index, *order, *value)?;
        }
        Ok(())
    }

    /// Reads time derivatives of outputs into `values`.
    ///
    /// # Errors
    /// A reference to no output, an order that is not available, or a derivative that is not finite.
    pub fn get_output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [MaybeUninit<f64>],
    ) -> Result<(), Fault> {
        for (reference, order) in references.iter().zip(orders) {
            self.variable(*reference, self.names.real)?;
            self.simulation
                .check_output_derivative(*reference as usize, *order)?;
        }
        for ((reference, order), value) in references.iter().zip(orders).zip(values) {
            let index = *reference as usize;
            value.write(self.simulation.output_derivative(index, *order)?);
        }
        Ok(())
    }

    /// Computes the changes of unknowns for changes of knowns.
    ///
    /// # Errors
    /// A reference to no input or output, a seed that is not finite, or knowns that change the initial state in
    /// initialization mode.
    pub fn directional_derivative(
        &mut self,
        knowns: &[u32],
        seeds: &[f64],
        unknowns: &[u32],
        changes: &mut [MaybeUninit<f64>],
    ) -> Result<(), Fault> {
        for reference in knowns.iter().chain(unknowns) {
            self.variable(*reference, self.names.real)?;
        }
        if self.state == InstanceState::Initialization {
            let indices = knowns.iter().map(|reference| *reference as usize);
            if self.simulation.start_follows(indices) {
                return Err(Fault::NotNow(
                    "in initialization mode these inputs change the initial state: set them and read the \
                     outputs, or ask at a communication point",
                ));
            }
        }
        if let Some(found) = seeds.iter().copied().find(|seed| !seed.is_finite()) {
            return Err(Fault::Argument {
                name: self.names.seeds,
                expected: "finite numbers",
                found,
            });
        }
        let outputs = unknowns.iter().map(|reference| *reference as usize);
        let inputs = knowns.iter().map(|reference| *reference as usize);
        let inputs = inputs.zip(seeds.iter().copied());
        self.simulation.differentiate(outputs.clone(), inputs)?;
        for (index, change) in outputs.zip(changes) {
            change.write(self.simulation.change(index)?);
        }
        Ok(())
    }

    /// Answers a function for a type that no variable has. It succeeds without references.
    ///
    /// # Errors
    /// Any reference.
    pub fn no_such_type(&self, references: &[u32], asked: &'static str) -> Result<(), Fault> {
        references
            .iter()
            .try_for_each(|reference| self.variable(*reference, asked).map(drop))
    }

    /// The variable of a value reference, if it has the type that is asked for.
    fn variable(&self, reference: u32, asked: &'static str) -> Result<&Variable, Fault> {
        let variables = self.simulation.variables();
        let count = variables.len();
        let Some(variable) = variables.get(reference as usize) else {
            return Err(Fault::Reference { reference, count });
        };
        let actual = if variable.is_integer() {
            self.names.integer
        } else {
            self.names.real
        };
        if actual != asked {
            return Err(Fault::Type {
                name: variable.name.clone(),
                actual,
                asked,
            });
        }
        Ok(variable)
    }

    /// The variable of a value reference, if it may be set in the present state.
    fn settable(&self, reference: u32, asked: &'static str) -> Result<&Variable, Fault> {
        let variable = self.variable(reference, asked)?;
        let causality = Causality::of(variable);
        if settable_states(causality) & self.state as u8 != 0 {
            return Ok(variable);
        }
        let (name, reason, state) = (
            variable.name.clone(),
            rule(causality),
            (self.names.state)(self.state),
        );
        Err(Fault::NotSettable {
            name,
            reason,
            state,
        })
    }

    /// Keeps what variables are set to, for [`Self::take_back`]; whether the initial state belongs to it.
    fn remember(&mut self, references: &[u32]) -> bool {
        let settings = references
            .iter()
            .map(|r| self.simulation.setting(*r as usize));
        self.before.clear();
        self.before.extend(settings);
        self.simulation.is_current()
    }

    /// Sets variables back to the values before a call that was refused half-way. The simulation
    /// accepted these values before, so it accepts them again; an initial state that belonged to them
    /// does so again.
    fn take_back(&mut self, references: &[u32], current: bool) {
        // Backwards, through the settings that were accepted on the way.
        for (place, reference) in references.iter().enumerate().rev() {
            let (index, value) = (*reference as usize, self.before[place]);
            let accepted = if self.simulation.variables()[index].is_integer() {
                // Written from an i32 in the first place.
                self.simulation.set_integer(index, value as i32)
            } else {
                self.simulation.set_real(index, value)
            };
            assert!(
                accepted.is_ok(),
                "an accepted value is refused: {accepted:?}"
            );
        }
        if current {
            self.simulation.mark_current();
        }
    }
}
