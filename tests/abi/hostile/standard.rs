//! The lifecycle as the standard prints it, written down apart from the product's: FMI 2.0.5, section
//! 4.2.4, the table below the state machine, without the states of steps in the background.

/// Where an instance is in its life.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    Instantiated,
    Initialization,
    StepComplete,
    StepFailed,
    Terminated,
    Error,
    /// Not of the standard: made without resources, waiting for a saved state that brings its scene.
    Bare,
}

impl Mode {
    pub const ALL: [Self; 7] = [
        Self::Instantiated,
        Self::Initialization,
        Self::StepComplete,
        Self::StepFailed,
        Self::Terminated,
        Self::Error,
        Self::Bare,
    ];
}

/// Rows in the order of [`Mode::ALL`]. `x`: allowed. `-`: not allowed. `o`: for outputs. `e`: for what has
/// an exact or approximate start, and inputs. `i`: for inputs. `d`: allowed, values for debugging only.
const TABLE: [(&str, &str); 30] = [
    ("fmi2SetDebugLogging", "xxxxxxx"),
    ("fmi2SetupExperiment", "x------"),
    ("fmi2EnterInitializationMode", "x------"),
    ("fmi2ExitInitializationMode", "-x-----"),
    ("fmi2Terminate", "--xx---"),
    ("fmi2Reset", "xxxxxx-"),
    ("fmi2GetReal", "-oxddd-"),
    ("fmi2GetInteger", "-oxddd-"),
    ("fmi2GetBoolean", "-oxddd-"),
    ("fmi2GetString", "-oxddd-"),
    ("fmi2SetReal", "eei----"),
    ("fmi2SetInteger", "eei----"),
    ("fmi2SetBoolean", "eei----"),
    ("fmi2SetString", "eei----"),
    ("fmi2GetFMUstate", "xxxddd-"),
    ("fmi2SetFMUstate", "xxxxxxx"),
    ("fmi2FreeFMUstate", "xxxxxxx"),
    ("fmi2SerializedFMUstateSize", "xxxxxxx"),
    ("fmi2SerializeFMUstate", "xxxxxxx"),
    ("fmi2DeSerializeFMUstate", "xxxxxxx"),
    ("fmi2GetDirectionalDerivative", "-xx----"),
    ("fmi2SetRealInputDerivatives", "xxx----"),
    ("fmi2GetRealOutputDerivatives", "--x-x--"),
    ("fmi2DoStep", "--x----"),
    ("fmi2CancelStep", "-------"),
    ("fmi2GetStatus", "--xxx--"),
    ("fmi2GetRealStatus", "--xxx--"),
    ("fmi2GetIntegerStatus", "--xxx--"),
    ("fmi2GetBooleanStatus", "--xxx--"),
    ("fmi2GetStringStatus", "--xxx--"),
];

/// Names of all functions of an instance.
pub fn functions() -> impl Iterator<Item = &'static str> {
    TABLE.into_iter().map(|(name, _)| name)
}

/// The mark of the table for a function in a mode.
pub fn mark(function: &str, mode: Mode) -> char {
    let row = TABLE.into_iter().find(|(name, _)| *name == function);
    let column = Mode::ALL.into_iter().position(|other| other == mode);
    let marks = row.expect(function).1.chars();
    { marks }.nth(column.unwrap_or(0)).expect("a mark a mode")
}

/// Whether a function may be called in a mode, whatever it is called with.
pub fn allows(function: &str, mode: Mode) -> bool {
    mark(function, mode) != '-'
}
