//! Every function in every state: allowed as the table says, refused without a change otherwise.

use std::ffi::{c_char, c_int};
use std::ptr;

use flexbody::fmi2::{InterfaceFunction, state_name};

use crate::support::{Instance, InstanceState, Status, Unit, call};

/// The states that a master can bring about.
const STATES: [InstanceState; 6] = [
    InstanceState::Instantiated,
    InstanceState::Initialization,
    InstanceState::StepComplete,
    InstanceState::StepFailed,
    InstanceState::Terminated,
    InstanceState::Error,
];

/// Calls a function with arguments that are harmless.
fn answer(instance: &Instance<'_>, function: InterfaceFunction) -> Status {
    use InterfaceFunction::*;
    let c = instance.component;
    let (mut real, mut integer, mut status) = (0.0, 0, Status::Ok);
    let mut word: *const c_char = ptr::null();
    let (none, orders): (*const u32, *const c_int) = (ptr::null(), ptr::null());
    match function {
        SetDebugLogging => call!(fmi2SetDebugLogging, c, 1, 0, ptr::null()),
        SetupExperiment => call!(fmi2SetupExperiment, c, 0, 0.0, 0.0, 0, 0.0),
        EnterInitializationMode => call!(fmi2EnterInitializationMode, c),
        ExitInitializationMode => call!(fmi2ExitInitializationMode, c),
        Terminate => call!(fmi2Terminate, c),
        Reset => call!(fmi2Reset, c),
        GetReal => call!(fmi2GetReal, c, none, 0, ptr::null_mut()),
        GetInteger => call!(fmi2GetInteger, c, none, 0, ptr::null_mut()),
        GetBoolean => call!(fmi2GetBoolean, c, none, 0, ptr::null_mut()),
        GetString => call!(fmi2GetString, c, none, 0, ptr::null_mut()),
        SetReal => call!(fmi2SetReal, c, none, 0, ptr::null()),
        SetInteger => call!(fmi2SetInteger, c, none, 0, ptr::null()),
        SetBoolean => call!(fmi2SetBoolean, c, none, 0, ptr::null()),
        SetString => call!(fmi2SetString, c, none, 0, ptr::null()),
        GetFMUstate
        | SetFMUstate
        | FreeFMUstate
        | SerializedFMUstateSize
        | SerializeFMUstate
        | DeSerializeFMUstate => saved_state(instance, function),
        GetDirectionalDerivative => {
            let (seed, result) = (ptr::null(), ptr::null_mut());
            call!(
                fmi2GetDirectionalDerivative,
                c,
                none,
                0,
                none,
                0,
                seed,
                result
            )
        }
        SetRealInputDerivatives => {
            call!(fmi2SetRealInputDerivatives, c, none, 0, orders, ptr::null())
        }
        GetRealOutputDerivatives => {
            call!(
                fmi2GetRealOutputDerivatives,
                c,
                none,
                0,
                orders,
                ptr::null_mut()
            )
        }
        DoStep => call!(fmi2DoStep, c, 0.0, 0.01, 0),
        CancelStep => call!(fmi2CancelStep, c),
        GetStatus => call!(fmi2GetStatus, c, 0, &mut status),
        GetRealStatus => call!(fmi2GetRealStatus, c, 2, &mut real),
        GetIntegerStatus => call!(fmi2GetIntegerStatus, c, 2, &mut integer),
        GetBooleanStatus => call!(fmi2GetBooleanStatus, c, 3, &mut integer),
        GetStringStatus => call!(fmi2GetStringStatus, c, 1, &mut word),
    }
}

/// The functions of saved states on a state of the instance itself.
fn saved_state(instance: &Instance<'_>, function: InterfaceFunction) -> Status {
    let c = instance.component;
    let mut state = instance.save();
    let bytes = instance.serialize(state);
    let mut copy = vec![0_u8; bytes.len()];
    let (mut size, mut second) = (0, ptr::null_mut());
    let status = match function {
        InterfaceFunction::GetFMUstate => call!(fmi2GetFMUstate, c, &mut state),
        InterfaceFunction::SetFMUstate => call!(fmi2SetFMUstate, c, state),
        InterfaceFunction::FreeFMUstate => call!(fmi2FreeFMUstate, c, &mut state),
        InterfaceFunction::SerializedFMUstateSize => {
            call!(fmi2SerializedFMUstateSize, c, state, &mut size)
        }
        InterfaceFunction::SerializeFMUstate => {
            call!(
                fmi2SerializeFMUstate,
                c,
                state,
                copy.as_mut_ptr().cast(),
                copy.len()
            )
        }
        _ => {
            let data = bytes.as_ptr().cast();
            call!(fmi2DeSerializeFMUstate, c, data, bytes.len(), &mut second)
        }
    };
    instance.free(state);
    instance.free(second);
    status
}

#[test]
fn what_the_table_forbids_is_refused_and_changes_nothing() {
    let unit = Unit::new();
    for state in STATES {
        let instance = Instance::in_state(&unit, state);
        let before = instance.fingerprint();
        for function in InterfaceFunction::ALL
            .iter()
            .filter(|f| !f.allowed_in(state))
        {
            let (function, name) = (*function, function.name());
            assert_eq!(
                answer(&instance, function),
                Status::Error,
                "{name} in {}",
                state_name(state)
            );
            let message = instance.record.last();
            assert!(
                message.contains(name) && message.contains(state_name(state)),
                "{message}"
            );
            assert_eq!(
                instance.fingerprint(),
                before,
                "{name} in {}",
                state_name(state)
            );
        }
    }
}

#[test]
fn what_the_table_allows_is_answered() {
    let unit = Unit::new();
    for state in STATES {
        for function in InterfaceFunction::ALL
            .iter()
            .filter(|f| f.allowed_in(state))
        {
            let instance = Instance::in_state(&unit, state);
            let expected = match function {
                InterfaceFunction::GetStatus
                | InterfaceFunction::GetIntegerStatus
                | InterfaceFunction::GetStringStatus => Status::Discard,
                _ => Status::Ok,
            };
            let found = answer(&instance, *function);
            let message = instance.record.last();
            let place = format!("{} in {}: {message}", function.name(), state_name(state));
            assert_eq!(found, expected, "{place}");
            assert!(!message.contains("not allowed"), "{place}");
        }
    }
}

#[test]
fn a_call_without_an_instance_is_an_error() {
    assert_eq!(
        call!(fmi2DoStep, ptr::null_mut(), 0.0, 0.1, 0),
        Status::Error
    );
    assert_eq!(call!(fmi2Reset, ptr::null_mut()), Status::Error);
    assert_eq!(
        call!(
            fmi2GetReal,
            ptr::null_mut(),
            ptr::null(),
            0,
            ptr::null_mut()
        ),
        Status::Error
    );
}

#[test]
fn reset_leads_from_every_state_to_a_life_as_new() {
    let unit = Unit::new();
    let expected = Instance::started(&unit).run(0, 3);
    for state in STATES {
        let instance = Instance::in_state(&unit, state);
        assert_eq!(call!(fmi2Reset, instance.component), Status::Ok);
        instance.start();
        assert_eq!(instance.run(0, 3), expected, "{}", state_name(state));
    }
}
