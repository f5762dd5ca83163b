//! Which function may be called in which state: the table of the standard (FMI 2.0.5, section 4.2.4) for a
//! co-simulation unit that never runs a step in the background, so that `stepInProgress` and `stepCanceled` do not exist.

use crate::fmi::{Call, InstanceState};

/// Name of a state for messages, as in the standard.
pub fn state_name(state: InstanceState) -> &'static str {
    match state {
        InstanceState::Instantiated => "instantiated",
        InstanceState::Initialization => "initializationMode",
        InstanceState::StepComplete => "stepComplete",
        InstanceState::StepFailed => "stepFailed",
        InstanceState::Terminated => "terminated",
        InstanceState::Error => "error",
        InstanceState::Bare => {
            "instantiated without fmuResourceLocation (only a saved state can follow)"
        }
        InstanceState::Fatal => "fatal",
    }
}

const I: u8 = InstanceState::Instantiated as u8;
const M: u8 = InstanceState::Initialization as u8;
const C: u8 = InstanceState::StepComplete as u8;
const F: u8 = InstanceState::StepFailed as u8;
const T: u8 = InstanceState::Terminated as u8;
const E: u8 = InstanceState::Error as u8;
const B: u8 = InstanceState::Bare as u8;

/// Everywhere but in the fatal state and without resources.
const ALWAYS: u8 = I | M | C | F | T | E;
/// Values exist; in `stepFailed` and `error` they are for debugging, as the standard says.
const VALUES: u8 = M | C | F | T | E;

/// Declares the functions of an instance with the states in which each may be called.
macro_rules! functions {
    ($($name:ident: $states:expr,)*) => {
        /// Functions that take an instance; `fmi2FreeInstance` is always allowed.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum InterfaceFunction {
            $(#[doc = concat!("`fmi2", stringify!($name), "`.")] $name,)*
        }

        impl InterfaceFunction {
            /// All functions.
            pub const ALL: &[Self] = &[$(Self::$name,)*];

            /// Returns the name of the function, and the states in which it may be called.
            pub fn call(self) -> Call {
                match self {
                    $(Self::$name => Call { name: concat!("fmi2", stringify!($name)), states: $states },)*
                }
            }
        }
    };
}

functions! {
    SetDebugLogging: ALWAYS | B,
    SetupExperiment: I,
    EnterInitializationMode: I,
    ExitInitializationMode: M,
    Terminate: C | F,
    Reset: ALWAYS,
    GetReal: VALUES,
    GetInteger: VALUES,
    GetBoolean: VALUES,
    GetString: VALUES,
    SetReal: I | M | C,
    SetInteger: I | M | C,
    SetBoolean: I | M | C,
    SetString: I | M | C,
    GetFMUstate: ALWAYS,
    SetFMUstate: ALWAYS | B,
    FreeFMUstate: ALWAYS | B,
    SerializedFMUstateSize: ALWAYS | B,
    SerializeFMUstate: ALWAYS | B,
    DeSerializeFMUstate: ALWAYS | B,
    GetDirectionalDerivative: M | C,
    SetRealInputDerivatives: I | M | C,
    GetRealOutputDerivatives: C | T,
    DoStep: C,
    CancelStep: 0, // no step is ever in progress when a call comes
    GetStatus: C | F | T,
    GetRealStatus: C | F | T,
    GetIntegerStatus: C | F | T,
    GetBooleanStatus: C | F | T,
    GetStringStatus: C | F | T,
}

impl InterfaceFunction {
    /// Name in the standard.
    pub fn name(self) -> &'static str {
        self.call().name
    }

    /// Whether the function may be called in `state`.
    pub fn allowed_in(self, state: InstanceState) -> bool {
        self.call().allowed_in(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi::settable_states;
    use crate::simulation::Causality;

    #[test]
    fn nothing_is_allowed_after_a_fatal_error() {
        for function in InterfaceFunction::ALL {
            assert!(
                !function.allowed_in(InstanceState::Fatal),
                "{}",
                function.name()
            );
        }
    }

    #[test]
    fn the_way_through_a_life_is_the_standard_one() {
        let allowed = |function: InterfaceFunction| -> Vec<InstanceState> {
            let states = InstanceState::ALL.into_iter();
            states.filter(|state| function.allowed_in(*state)).collect()
        };
        assert_eq!(
            allowed(InterfaceFunction::SetupExperiment),
            [InstanceState::Instantiated]
        );
        assert_eq!(
            allowed(InterfaceFunction::EnterInitializationMode),
            [InstanceState::Instantiated]
        );
        assert_eq!(
            allowed(InterfaceFunction::ExitInitializationMode),
            [InstanceState::Initialization]
        );
        assert_eq!(
            allowed(InterfaceFunction::DoStep),
            [InstanceState::StepComplete]
        );
        assert_eq!(
            allowed(InterfaceFunction::Terminate),
            [InstanceState::StepComplete, InstanceState::StepFailed]
        );
        assert_eq!(allowed(InterfaceFunction::CancelStep), []);
        assert_eq!(allowed(InterfaceFunction::Reset).len(), 6);
        assert!(!InterfaceFunction::GetReal.allowed_in(InstanceState::Instantiated));
    }

    #[test]
    fn setting_needs_a_state_in_which_the_function_is_allowed() {
        for causality in [Causality::Parameter, Causality::Input, Causality::Output] {
            assert_eq!(
                settable_states(causality) & !InterfaceFunction::SetReal.call().states,
                0
            );
        }
        assert!(settable_states(Causality::Parameter) & C == 0);
        assert!(settable_states(Causality::Input) & C != 0);
    }
}
