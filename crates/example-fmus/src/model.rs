//! What a model is: quantities and linear equations.

/// Numbers from parameters `p`, states `x` and inputs `u`.
pub type Equation = fn(p: &[f64], x: &[f64], u: &[f64]) -> Vec<f64>;

/// A variable of a model.
pub struct Quantity {
    /// Name in the model description.
    pub name: &'static str,
    /// Unit, one of those that the model description knows; empty for a plain number.
    pub unit: &'static str,
    /// Start value; outputs have none.
    pub start: f64,
    /// Meaning.
    pub description: &'static str,
}

/// A linear model `x' = A x + B u`, `y = C x + D u`, written as functions that are linear in `x`
/// and `u`. The value reference of a variable is its place in inputs, outputs, parameters.
pub struct Model {
    /// Name in the model description.
    pub name: &'static str,
    /// Meaning, with its source.
    pub description: &'static str,
    /// Inputs `u`.
    pub inputs: &'static [Quantity],
    /// Outputs `y`.
    pub outputs: &'static [Quantity],
    /// Parameters `p`.
    pub parameters: &'static [Quantity],
    /// States `x` at the start, from `p`.
    pub initial: fn(p: &[f64]) -> Vec<f64>,
    /// Rates `x'` from `p`, `x`, `u`.
    pub rates: Equation,
    /// Outputs `y` from `p`, `x`, `u`.
    pub read: Equation,
}

impl Model {
    /// Start values of the parameters.
    pub fn start(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.start).collect()
    }

    /// Identity of the model: changes with its name and its variables.
    pub fn guid(&self) -> String {
        format!("{}-{:016x}", self.name, self.fingerprint())
    }

    /// FNV-1a of names, units and start values in order.
    pub fn fingerprint(&self) -> u64 {
        let mut text = self.name.to_owned();
        for (kind, list) in [self.inputs, self.outputs, self.parameters]
            .iter()
            .enumerate()
        {
            for quantity in *list {
                let Quantity {
                    name, unit, start, ..
                } = quantity;
                text.push_str(&format!("\n{kind} {name} {unit} {start}"));
            }
        }
        text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        })
    }

    /// Feedthrough `D` of one output: its change with each input.
    pub fn feedthrough(&self, p: &[f64], output: usize) -> Vec<f64> {
        let x = vec![0.0; (self.initial)(p).len()];
        let unit = |input| {
            let mut u = vec![0.0; self.inputs.len()];
            u[input] = 1.0;
            (self.read)(p, &x, &u)[output]
        };
        (0..self.inputs.len()).map(unit).collect()
    }

    /// Inputs that an output depends on directly for some parameters.
    pub fn dependencies(&self, output: usize) -> Vec<usize> {
        // Parameters in no relation to each other: nothing cancels.
        let p: Vec<f64> = (2..2 + self.parameters.len())
            .map(|i| (i as f64).sqrt())
            .collect();
        let row = self.feedthrough(&p, output);
        (0..row.len()).filter(|input| row[*input] != 0.0).collect()
    }
}
