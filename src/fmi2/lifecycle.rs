//! Which function may be called in which state, and which variable may be set: the tables of the
//! standard (FMI 2.0.5, section 4.2.4) for a co-simulation unit that never runs a step in the
//! background, so that `stepInProgress` and `stepCanceled` do not exist.

use crate::simulation::Causality;

/// State of an instance, one bit each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum State {
    /// After `fmi2Instantiate` or `fmi2Reset`: parameters are set here.
    Instantiated = 1,
    /// Between `fmi2EnterInitializationMode` and `fmi2ExitInitializationMode`.
    Initialization = 2,
    /// At a communication point, ready for a step.
    StepComplete = 4,
    /// After a step that could be done only in part.
    StepFailed = 8,
    /// After `fmi2Terminate`.
    Terminated = 16,
    /// After a computation that failed; a saved state or `fmi2Reset` leads out.
    Error = 32,
    /// After `fmi2Instantiate` without resources: only a saved state, which brings its scene, leads out.
    Bare = 64,
    /// After a defect of the library; nothing leads out.
    Fatal = 128,
}

impl State {
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

    /// Name for messages, as in the standard.
    pub fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::Initialization => "initializationMode",
            Self::StepComplete => "stepComplete",
            Self::StepFailed => "stepFailed",
            Self::Terminated => "terminated",
            Self::Error => "error",
            Self::Bare => {
                "instantiated without fmuResourceLocation (only a saved state can follow)"
            }
            Self::Fatal => "fatal",
        }
    }

    /// The state with this bit.
    pub fn from_bit(bit: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|state| *state as u8 == bit)
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

            /// Name in the standard.
            pub fn name(self) -> &'static str {
                match self { $(Self::$name => concat!("fmi2", stringify!($name)),)* }
            }

            /// Bits of the states in which the function may be called.
            pub fn states(self) -> u8 {
                match self { $(Self::$name => $states,)* }
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
    /// Whether the function may be called in `state`.
    pub fn allowed_in(self, state: State) -> bool {
        self.states() & state as u8 != 0
    }
}

/// States in which a variable may be set. Inputs are open before initialization too: the
/// standard's table leaves them out there, yet masters, FMPy among them, set their start
/// values at that moment, and refusing would help nobody.
pub fn settable_states(causality: Causality) -> u8 {
    match causality {
        Causality::Parameter => I | M,
        Causality::Input => I | M | C,
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
            assert_eq!(settable_states(causality) & !Function::SetReal.states(), 0);
        }
        assert!(settable_states(Causality::Parameter) & C == 0);
        assert!(settable_states(Causality::Input) & C != 0);
    }

    #[test]
    fn a_state_survives_as_its_bit() {
        for state in State::ALL {
            assert_eq!(State::from_bit(state as u8), Some(state));
        }
        assert_eq!(State::from_bit(0), None);
        assert_eq!(State::from_bit(3), None);
    }
}
