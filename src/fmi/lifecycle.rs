//! The states of an instance, and which variable may be set in which. No step ever runs in the background, so that
//! there is no state for it.

use crate::simulation::Causality;

/// State of an instance, one bit each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum InstanceState {
    /// Made, or reset: parameters are set here.
    Instantiated = 1,
    /// In initialization mode.
    Initialization = 2,
    /// At a communication point, ready for a step.
    StepComplete = 4,
    /// After a step that could be done only in part.
    StepFailed = 8,
    /// After the end.
    Terminated = 16,
    /// After a computation that failed; a saved state or a reset leads out.
    Error = 32,
    /// Made without resources: only a saved state, which brings its scene, leads out.
    Bare = 64,
    /// After a defect of the library; nothing leads out.
    Fatal = 128,
}

impl InstanceState {
    /// All states.
    pub const ALL: [Self; 8] = [
        Self::Instantiated,
        Self::Initialization,
        Self::StepComplete,
        Self::StepFailed,
        Self::Terminated,
        Self::Error,
        Self::Bare,
        Self::Fatal,
    ];

    /// The state with this bit.
    pub fn from_bit(bit: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|state| *state as u8 == bit)
    }
}

/// Name of a function and the states in which it may be called, for the guard.
#[derive(Clone, Copy, Debug)]
pub struct Call {
    /// Name in the standard.
    pub name: &'static str,
    /// Bits of the states.
    pub states: u8,
}

impl Call {
    /// Whether the function may be called in `state`.
    pub fn allowed_in(self, state: InstanceState) -> bool {
        self.states & state as u8 != 0
    }
}

/// States in which a variable may be set. Inputs are open before initialization too: the
/// table of FMI 2.0 leaves them out there, yet masters, FMPy among them, set their start
/// values at that moment, and refusing would help nobody.
pub fn settable_states(causality: Causality) -> u8 {
    let before = InstanceState::Instantiated as u8 | InstanceState::Initialization as u8;
    match causality {
        Causality::Parameter => before,
        Causality::Input => before | InstanceState::StepComplete as u8,
        Causality::Independent | Causality::Output | Causality::CalculatedParameter => 0,
    }
}

/// When a variable may be set, for messages.
pub fn rule(causality: Causality) -> &'static str {
    match causality {
        Causality::Parameter => "a parameter may be set until initialization ends",
        Causality::Input => "an input may be set until the unit is terminated",
        Causality::Independent => "time may not be set",
        Causality::Output => "an output may not be set",
        Causality::CalculatedParameter => "a calculated parameter may not be set",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_survives_as_its_bit() {
        for state in InstanceState::ALL {
            assert_eq!(InstanceState::from_bit(state as u8), Some(state));
        }
        assert_eq!(InstanceState::from_bit(0), None);
        assert_eq!(InstanceState::from_bit(3), None);
    }
}
