//! Getting and setting: wrong references, types, values and moments are refused as a whole.

use std::ffi::c_int;
use std::ptr;

use crate::support::{Instance, InstanceState, Status, Unit, call};

const FAR: u32 = 9999;

/// Checks that a call was refused for a reason and changed nothing.
fn refused(instance: &Instance<'_>, reason: &str, call: impl FnOnce() -> Status) {
    let before = instance.fingerprint();
    assert_eq!(call(), Status::Error, "{reason}");
    let message = instance.record.last();
    assert!(
        message.contains(reason),
        "expected {reason}, found {message}"
    );
    assert_eq!(instance.fingerprint(), before, "{reason}");
}

#[test]
fn value_references_of_nothing_and_of_another_type_are_refused() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    let c = instance.component;
    let elements = unit.reference("rod.elements");
    let force = unit.reference("rod.tip.force[1]");
    let (mut real, mut integer, mut word) = (0.0, 0, ptr::null());
    refused(&instance, "9999", || {
        call!(fmi2GetReal, c, &FAR, 1, &mut real)
    });
    refused(&instance, "9999", || call!(fmi2SetReal, c, &FAR, 1, &1.0));
    refused(&instance, "9999", || {
        call!(fmi2GetInteger, c, &FAR, 1, &mut integer)
    });
    refused(&instance, "9999", || {
        call!(fmi2SetString, c, &FAR, 1, &ptr::null())
    });
    refused(&instance, "rod.elements", || {
        call!(fmi2GetReal, c, &elements, 1, &mut real)
    });
    refused(&instance, "rod.tip.force[1]", || {
        call!(fmi2GetInteger, c, &force, 1, &mut integer)
    });
    refused(&instance, "rod.tip.force[1]", || {
        call!(fmi2SetInteger, c, &force, 1, &1)
    });
    refused(&instance, "Boolean", || {
        call!(fmi2GetBoolean, c, &force, 1, &mut integer)
    });
    refused(&instance, "Boolean", || {
        call!(fmi2SetBoolean, c, &force, 1, &1)
    });
    refused(&instance, "String", || {
        call!(fmi2GetString, c, &force, 1, &mut word)
    });
}

#[test]
fn null_arrays_and_impossible_lengths_are_refused() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    let c = instance.component;
    let force = unit.reference("rod.tip.force[1]");
    let mut real = 0.0;
    refused(&instance, "vr", || {
        call!(fmi2GetReal, c, ptr::null(), 1, &mut real)
    });
    refused(&instance, "value", || {
        call!(fmi2GetReal, c, &force, 1, ptr::null_mut())
    });
    refused(&instance, "vr", || {
        call!(fmi2SetReal, c, ptr::null(), 1, &0.0)
    });
    refused(&instance, "value", || {
        call!(fmi2SetReal, c, &force, 1, ptr::null())
    });
    refused(&instance, "vr", || {
        call!(fmi2GetReal, c, &force, usize::MAX, &mut real)
    });
    refused(&instance, "value", || {
        call!(fmi2GetRealStatus, c, 2, ptr::null_mut())
    });
    refused(&instance, "categories", || {
        call!(fmi2SetDebugLogging, c, 1, 1, ptr::null())
    });
    refused(&instance, "categories", || {
        call!(fmi2SetDebugLogging, c, 1, 1, &ptr::null())
    });
    refused(&instance, "FMUstate", || {
        call!(fmi2GetFMUstate, c, ptr::null_mut())
    });
    refused(&instance, "FMUstate", || {
        call!(fmi2SetFMUstate, c, ptr::null_mut())
    });
    let mut size = 0;
    let state = ptr::null_mut();
    refused(&instance, "FMUstate", || {
        call!(fmi2SerializedFMUstateSize, c, state, &mut size)
    });
    refused(&instance, "FMUstate", || {
        call!(fmi2SerializeFMUstate, c, state, ptr::null_mut(), 0)
    });
    refused(&instance, "FMUstate", || {
        call!(fmi2DeSerializeFMUstate, c, ptr::null(), 0, ptr::null_mut())
    });
    let mut place = ptr::null_mut();
    refused(&instance, "serializedState", || {
        call!(fmi2DeSerializeFMUstate, c, ptr::null(), 9, &mut place)
    });
    assert_eq!(call!(fmi2FreeFMUstate, c, ptr::null_mut()), Status::Ok);
    assert_eq!(call!(fmi2FreeFMUstate, c, &mut place), Status::Ok);
}

#[test]
fn a_set_with_one_bad_value_sets_nothing() {
    let unit = Unit::new();
    let instance = Instance::new(&unit);
    let c = instance.component;
    let names = ["rod.youngs_modulus", "rod.tip.force[1]", "rod.density"];
    let references = names.map(|name| unit.reference(name));
    let before = instance.fingerprint();
    for (values, name) in [
        ([1e6, 2.0, f64::NAN], "rod.density"),
        ([1e6, f64::INFINITY, 4000.0], "rod.tip.force[1]"),
        ([1e6, 2.0, -1.0], "rod.density"),
        ([0.0, 2.0, 4000.0], "rod.youngs_modulus"),
    ] {
        let status = call!(fmi2SetReal, c, references.as_ptr(), 3, values.as_ptr());
        assert_eq!(status, Status::Error);
        assert!(instance.record.last().contains(name), "{name}");
        assert_eq!(instance.fingerprint(), before, "{name}");
    }
    let references = [references[0], FAR];
    assert_eq!(
        call!(fmi2SetReal, c, references.as_ptr(), 2, [1e6, 1.0].as_ptr()),
        Status::Error
    );
    assert_eq!(instance.fingerprint(), before);
}

#[test]
fn a_refused_set_leaves_the_initial_state_as_it_was() {
    let unit = Unit::new();
    let instance = Instance::in_state(&unit, InstanceState::Initialization);
    let elements = [unit.reference("rod.elements"); 2];
    let c = instance.component;
    refused(&instance, "rod.elements", || {
        call!(fmi2SetInteger, c, elements.as_ptr(), 2, [8, 0].as_ptr())
    });
    let density = [unit.reference("rod.density"); 2];
    refused(&instance, "rod.density", || {
        call!(fmi2SetReal, c, density.as_ptr(), 2, [1.0, -1.0].as_ptr())
    });
}

#[test]
fn an_output_that_is_no_number_is_not_answered() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    assert_eq!(instance.set("rod.middle.moment", f64::MAX), Status::Ok);
    let reference = unit.reference("rod.tip.acceleration[1]");
    let mut value = 0.0;
    refused(
        &instance,
        "rod.tip.acceleration[1]: expected a finite number",
        || call!(fmi2GetReal, instance.component, &reference, 1, &mut value),
    );
    assert_eq!(instance.set("rod.middle.moment", 0.0), Status::Ok);
    assert!(instance.get("rod.tip.acceleration[1]").is_finite());
}

#[test]
fn a_refused_set_goes_back_to_the_tolerance_of_the_experiment() {
    let unit = Unit::new();
    let instance = Instance::new(&unit);
    let c = instance.component;
    assert_eq!(
        call!(fmi2SetupExperiment, c, 1, 1e-6, 0.0, 0, 0.0),
        Status::Ok
    );
    let before = instance.fingerprint();
    let references = ["relative_tolerance", "rod.area"].map(|name| unit.reference(name));
    let values = [1e-3, -1.0];
    assert_eq!(
        call!(fmi2SetReal, c, references.as_ptr(), 2, values.as_ptr()),
        Status::Error
    );
    assert_eq!(instance.fingerprint(), before);
}

#[test]
fn impossible_numbers_of_elements_are_refused() {
    let unit = Unit::new();
    let instance = Instance::new(&unit);
    for value in [0, -1, c_int::MIN, c_int::MAX] {
        refused(&instance, "rod.elements", || instance.set_elements(value));
    }
    assert_eq!(instance.set_elements(6), Status::Ok);
}

#[test]
fn variables_are_set_only_when_they_may_be() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    for name in [
        "rod.density",
        "time",
        "rod.tip.position[1]",
        "rod.natural_frequency[1]",
    ] {
        refused(&instance, name, || instance.set(name, 1.0));
    }
    refused(&instance, "rod.elements", || instance.set_elements(5));
    assert_eq!(instance.set("rod.tip.force[1]", 1.0), Status::Ok);
    let early = Instance::in_state(&unit, InstanceState::Initialization);
    for name in ["rod.density", "rod.tip.force[1]"] {
        assert_eq!(early.set(name, 3000.0), Status::Ok);
        assert_eq!(early.get(name), 3000.0);
    }
    refused(&early, "time", || early.set("time", 1.0));
}

#[test]
fn outputs_follow_parameters_and_inputs_at_once() {
    let unit = Unit::new();
    let instance = Instance::in_state(&unit, InstanceState::Initialization);
    let (gravity, frequency) = ("energy.gravity", "rod.natural_frequency[1]");
    let reaction = "pivot.reaction[2]";
    let before = [reaction, frequency].map(|name| instance.get(name));
    assert_eq!(instance.get(gravity), 0.0);
    assert_eq!(instance.set("rod.density", 2.0 * 5540.0), Status::Ok);
    assert!((instance.get(reaction) / before[0] - 2.0).abs() < 1e-6);
    assert!(instance.get(frequency) != before[1] || before[1] == 0.0);
    assert_eq!(
        call!(fmi2ExitInitializationMode, instance.component),
        Status::Ok
    );
    let acceleration = instance.get("rod.tip.acceleration[2]");
    assert_eq!(instance.set("rod.tip.force[2]", 10.0), Status::Ok);
    assert!(instance.get("rod.tip.acceleration[2]") > acceleration);
    assert_eq!(instance.get("rod.tip.position[2]"), 0.0);
}
