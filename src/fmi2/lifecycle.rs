//! Which function may be called in which state: the table of the standard (FMI 2.0.5, section 4.2.4) for a
//! co-simulation unit that never runs a step in the background, so that `stepInProgress` and `stepCanceled` do not exist.

use crate::fmi::{Call, State};

/// Name of a state for messages, as in the standard.
pub fn state_name(state: State) -> &'static str {
    match state {
        State::Instantiated => "instantiated",
        State::Initialization => "initializationMode",
        State::StepComplete => "stepComplete",
        State::StepFailed => "stepFailed",
        State::Terminated => "terminated",
        State::Error => "error",
        State::Bare => "instantiated without fmuResourceLocation (only a saved state can follow)",
        State::Fatal => "fatal",
    }
}

const I: u8 = State::Instantiated as u8;
const M: u8 = State::Initialization as u8;
const C: u8 = State::StepComplete as u8;
const F: u8 = State::StepFailed as u8;
const T: u8 = State::Terminated as u8;
const E: u8 = State::Error as u8;
const B: u8 = State::Bare as u8;

/// Everywhere but in the fatal state and without resources.
const ALWAYS: u8 = I | M | C | F | T | E;
/// Values exist; in `stepFailed` and `error` they are for debugging, as the standard says.
const VALUES: u8 = M | C | F | T | E;

/// Declares the functions of an instance with the states in which each may be called.
macro_rules! functions {
    ($($name:ident: $states:expr,)*) => {
        /// Functions that take an instance; `fmi2FreeInstance` is always allowed.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Function {
            $(#[doc = concat!("`fmi2", stringify!($name), "`.")] $name,)*
        }

        impl Function {
            /// All functions.
            pub const ALL: &[Self] = &[$(Self::$name,)*];

            /// Its name, and the states in which it may be called.
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

impl Function {
    /// Name in the standard.
    pub fn name(self) -> &'static str {
        self.call().name
    }

    /// Whether the function may be called in `state`.
    pub fn allowed_in(self, state: State) -> bool {
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
        for function in Function::ALL {
            assert!(!function.allowed_in(State::Fatal), "{}", function.name());
        }
    }

    #[test]
    fn the_way_through_a_life_is_the_standard_one() {
        let allowed = |function: Function| -> Vec<State> {
            let states = State::ALL.into_iter();
            states.filter(|state| function.allowed_in(*state)).collect()
        };
        assert_eq!(allowed(Function::SetupExperiment), [State::Instantiated]);
        assert_eq!(
            allowed(Function::EnterInitializationMode),
            [State::Instantiated]
        );
        assert_eq!(
            allowed(Function::ExitInitializationMode),
            [State::Initialization]
        );
        assert_eq!(allowed(Function::DoStep), [State::StepComplete]);
        assert_eq!(
            allowed(Function::Terminate),
            [State::StepComplete, State::StepFailed]
        );
        assert_eq!(allowed(Function::CancelStep), []);
        assert_eq!(allowed(Function::Reset).len(), 6);
        assert!(!Function::GetReal.allowed_in(State::Instantiated));
    }

    #[test]
    fn setting_needs_a_state_in_which_the_function_is_allowed() {
        for causality in [Causality::Parameter, Causality::Input, Causality::Output] {
            assert_eq!(
                settable_states(causality) & !Function::SetReal.call().states,
                0
            );
        }
        assert!(settable_states(Causality::Parameter) & C == 0);
        assert!(settable_states(Causality::Input) & C != 0);
    }
}
