//! One instance: its life, its values, its exact steps.

use crate::linear::{Matrix, apply, columns, exponential};
use crate::model::Model;
use crate::models::ALL;

/// Why a call was refused.
pub type Refusal = String;

/// Where in its life an instance is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd)]
#[repr(u8)]
pub enum Phase {
    /// After `fmi2Instantiate` or `fmi2Reset`.
    Instantiated,
    /// In initialization mode.
    Initialization,
    /// At a communication point.
    Ready,
    /// After `fmi2Terminate`.
    Terminated,
}

const PHASES: [Phase; 4] = [
    Phase::Instantiated,
    Phase::Initialization,
    Phase::Ready,
    Phase::Terminated,
];

/// All that changes in an instance: the FMU state.
#[derive(Clone, Debug, PartialEq)]
pub struct Saved {
    fingerprint: u64,
    phase: Phase,
    time: f64,
    /// Whether the derivatives of inputs were used by a step; the next step begins without them.
    spent: bool,
    parameters: Vec<f64>,
    /// States, inputs, their first and their second derivatives, one after the other.
    z: Vec<f64>,
}

/// The equations for given parameters, as `z' = M z`, `y = W z`.
struct Equations {
    generator: Matrix,
    readout: Matrix,
    /// The last step size with its exponential.
    step: Option<(f64, Matrix)>,
}

/// An instance of a model.
pub struct Instance {
    model: &'static Model,
    state: Saved,
    equations: Equations,
}

impl Instance {
    /// An instance of the model with this GUID.
    pub fn new(guid: &str) -> Option<Self> {
        let model = ALL.iter().find(|model| model.guid() == guid)?;
        let parameters = model.start();
        let state = Saved {
            fingerprint: model.fingerprint(),
            phase: Phase::Instantiated,
            time: 0.0,
            spent: false,
            z: start(model, &parameters),
            parameters,
        };
        let equations = equations(model, &state.parameters);
        Some(Self {
            model,
            state,
            equations,
        })
    }

    /// Refuses a call outside its phases.
    ///
    /// # Errors
    /// The present phase is none of `phases`.
    pub fn expect(&self, phases: &[Phase]) -> Result<(), Refusal> {
        let found = self.state.phase;
        let message = || format!("not allowed when {found:?}, only when {phases:?}");
        phases.contains(&found).then_some(()).ok_or_else(message)
    }

    /// Changes from one phase to the next.
    ///
    /// # Errors
    /// Another present phase, or parameters with which the equations are not finite.
    pub fn advance(&mut self, from: Phase, to: Phase) -> Result<(), Refusal> {
        self.expect(&[from])?;
        let mut entries = self.equations.generator.iter().flatten();
        if !entries.all(|entry| entry.is_finite()) {
            return Err("parameters: the equations are not finite".into());
        }
        self.state.phase = to;
        Ok(())
    }

    /// Handles `fmi2SetupExperiment`.
    ///
    /// # Errors
    /// Another phase than that after instantiation, or a time that is not finite.
    pub fn set_up(&mut self, time: f64) -> Result<(), Refusal> {
        self.expect(&[Phase::Instantiated])?;
        self.state.time = finite(time)?;
        Ok(())
    }

    /// `fmi2Reset`.
    pub fn reset(&mut self) {
        let fresh = Self::new(&self.model.guid());
        *self = fresh.expect("the GUID of a model names it");
    }

    fn input(&self, reference: u32) -> Result<usize, Refusal> {
        let index = reference as usize;
        let known = index < self.model.inputs.len();
        known
            .then_some(index)
            .ok_or_else(|| format!("value reference {reference}: not an input"))
    }

    fn output(&self, reference: u32) -> Result<usize, Refusal> {
        let index = (reference as usize).wrapping_sub(self.model.inputs.len());
        let known = index < self.model.outputs.len();
        known
            .then_some(index)
            .ok_or_else(|| format!("value reference {reference}: not an output"))
    }

    /// Place in `z` of the derivative of an input, the input itself for order 0.
    fn place(&self, input: usize, order: usize) -> usize {
        let inputs = self.model.inputs.len();
        self.state.z.len() - (3 - order) * inputs + input
    }

    /// Handles `fmi2GetReal` for one variable.
    ///
    /// # Errors
    /// A reference to no variable, or a phase without values.
    pub fn get(&self, reference: u32) -> Result<f64, Refusal> {
        if let Ok(input) = self.input(reference) {
            return Ok(self.state.z[self.place(input, 0)]);
        }
        if self.output(reference).is_ok() {
            return self.output_derivative(reference, 0);
        }
        let index = reference as usize - self.model.inputs.len() - self.model.outputs.len();
        let value = self.state.parameters.get(index).copied();
        value.ok_or_else(|| format!("value reference {reference}: unknown"))
    }

    /// Handles `fmi2SetReal` for one variable.
    ///
    /// # Errors
    /// A reference to no variable, a variable that cannot be set now, or a value that is not finite.
    pub fn set(&mut self, reference: u32, value: f64) -> Result<(), Refusal> {
        let value = finite(value)?;
        if let Ok(input) = self.input(reference) {
            self.expect(&PHASES[..3])?;
            let place = self.place(input, 0);
            self.state.z[place] = value;
            return Ok(());
        }
        let fixed = self.model.inputs.len() + self.model.outputs.len();
        let index = (reference as usize).wrapping_sub(fixed);
        if index >= self.state.parameters.len() {
            return Err(format!("value reference {reference}: cannot be set"));
        }
        self.expect(&PHASES[..2])?;
        self.state.parameters[index] = value;
        let initial = (self.model.initial)(&self.state.parameters);
        self.state.z[..initial.len()].copy_from_slice(&initial);
        self.equations = equations(self.model, &self.state.parameters);
        Ok(())
    }

    /// Handles `fmi2SetRealInputDerivatives` for one input. The derivative holds for the next step only, from its
    /// start.
    ///
    /// # Errors
    /// A reference to no input, an order out of range, or a value that is not finite.
    pub fn set_derivative(
        &mut self,
        reference: u32,
        order: i32,
        value: f64,
    ) -> Result<(), Refusal> {
        self.expect(&PHASES[..3])?;
        let input = self.input(reference)?;
        if !(1..=2).contains(&order) {
            return Err(format!("order {order}: expected 1 or 2"));
        }
        let value = finite(value)?;
        self.forget_spent_derivatives();
        let place = self.place(input, order as usize);
        self.state.z[place] = value;
        Ok(())
    }

    fn forget_spent_derivatives(&mut self) {
        if self.state.spent {
            let first = self.place(0, 1);
            self.state.z[first..].fill(0.0);
            self.state.spent = false;
        }
    }

    /// Handles `fmi2GetRealOutputDerivatives` for one output. Order 0 is the output itself, orders above 2 are zero.
    ///
    /// # Errors
    /// A reference to no output, or an order out of range.
    pub fn output_derivative(&self, reference: u32, order: i32) -> Result<f64, Refusal> {
        let output = self.output(reference)?;
        if order > 2 {
            return Ok(0.0);
        }
        let mut z = self.state.z.clone();
        for _ in 0..order {
            z = apply(&self.equations.generator, &z);
        }
        let row = &self.equations.readout[output];
        Ok(row.iter().zip(z).map(|(w, z)| w * z).sum())
    }

    /// Handles `fmi2GetDirectionalDerivative` for one output.
    ///
    /// # Errors
    /// A reference to no output or input.
    pub fn directional(&self, output: u32, inputs: &[u32], seed: &[f64]) -> Result<f64, Refusal> {
        let output = self.output(output)?;
        let row = &self.equations.readout[output];
        let terms = inputs.iter().zip(seed).map(|(input, seed)| {
            let place = self.place(self.input(*input)?, 0);
            Ok(row[place] * seed)
        });
        terms.sum()
    }

    /// Handles `fmi2DoStep`.
    ///
    /// # Errors
    /// Another phase, another current time, or a step that is not positive and finite.
    pub fn step(&mut self, current: f64, size: f64) -> Result<(), Refusal> {
        self.expect(&[Phase::Ready])?;
        let end = finite(current)? + finite(size)?;
        let apart = (current - self.state.time).abs();
        if apart > 1e-9 * current.abs().max(size) || end <= current {
            let now = self.state.time;
            return Err(format!(
                "cannot step from {current} by {size} at time {now}"
            ));
        }
        self.forget_spent_derivatives();
        let states = self.state.z.len() - 3 * self.model.inputs.len();
        let equations = &mut self.equations;
        let fresh = || (size, exponential(&equations.generator, size, states));
        let known = equations.step.take().filter(|(known, _)| *known == size);
        let (_, flow) = equations.step.insert(known.unwrap_or_else(fresh));
        self.state.z = apply(flow, &self.state.z);
        self.state.time = end;
        self.state.spent = true;
        Ok(())
    }

    /// Time that the last step reached, s.
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// `fmi2GetFMUstate`.
    pub fn save(&self) -> Saved {
        self.state.clone()
    }

    /// Handles `fmi2SetFMUstate`.
    ///
    /// # Errors
    /// A state of another model.
    pub fn restore(&mut self, saved: &Saved) -> Result<(), Refusal> {
        if saved.fingerprint != self.state.fingerprint {
            return Err("saved state: of another model".into());
        }
        if saved.parameters != self.state.parameters {
            self.equations = equations(self.model, &saved.parameters);
        }
        self.state.clone_from(saved);
        Ok(())
    }

    /// Handles `fmi2DeSerializeFMUstate`.
    ///
    /// # Errors
    /// Bytes that are no state of this model.
    pub fn deserialize(&self, bytes: &[u8]) -> Result<Saved, Refusal> {
        let refused = || "serialized state: damaged or of another model".to_owned();
        if bytes.len() != self.state.size() {
            return Err(refused());
        }
        let words = bytes.chunks_exact(8).map(|chunk| {
            let bytes = chunk.try_into().expect("chunks of 8 bytes");
            u64::from_le_bytes(bytes)
        });
        let words: Vec<u64> = words.collect();
        let phase = PHASES.get(usize::try_from(words[1]).map_err(|_| refused())?);
        if words[0] != self.state.fingerprint || words[3] > 1 {
            return Err(refused());
        }
        let numbers = |words: &[u64]| words.iter().map(|w| f64::from_bits(*w)).collect();
        let split = 4 + self.state.parameters.len();
        Ok(Saved {
            fingerprint: words[0],
            phase: *phase.ok_or_else(refused)?,
            time: f64::from_bits(words[2]),
            spent: words[3] == 1,
            parameters: numbers(&words[4..split]),
            z: numbers(&words[split..]),
        })
    }
}

impl Saved {
    /// Bytes when serialized.
    pub fn size(&self) -> usize {
        8 * (4 + self.parameters.len() + self.z.len())
    }

    /// `fmi2SerializeFMUstate`.
    pub fn bytes(&self) -> Vec<u8> {
        let head = [
            self.fingerprint,
            self.phase as u64,
            self.time.to_bits(),
            u64::from(self.spent),
        ];
        let numbers = self.parameters.iter().chain(&self.z);
        let words = head.into_iter().chain(numbers.map(|x| x.to_bits()));
        words.flat_map(u64::to_le_bytes).collect()
    }
}

/// The `z` that an instance starts with.
fn start(model: &Model, parameters: &[f64]) -> Vec<f64> {
    let mut z = (model.initial)(parameters);
    z.extend(model.inputs.iter().map(|input| input.start));
    z.resize(z.len() + 2 * model.inputs.len(), 0.0);
    z
}

fn equations(model: &Model, p: &[f64]) -> Equations {
    let (states, inputs) = ((model.initial)(p).len(), model.inputs.len());
    let size = states + 3 * inputs;
    let generator = columns(size, |z| {
        let (x, u) = (&z[..states], &z[states..states + inputs]);
        let mut rates = (model.rates)(p, x, u);
        rates.extend(&z[states + inputs..]);
        rates.resize(size, 0.0);
        rates
    });
    let readout = columns(size, |z| {
        (model.read)(p, &z[..states], &z[states..states + inputs])
    });
    Equations {
        generator,
        readout,
        step: None,
    }
}

fn finite(value: f64) -> Result<f64, Refusal> {
    let message = || format!("expected a finite number, found {value}");
    value.is_finite().then_some(value).ok_or_else(message)
}

#[cfg(test)]
mod tests;
