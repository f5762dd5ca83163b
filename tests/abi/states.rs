//! Saved states: the same bits again, in this instance or another; foreign bytes are refused.

use std::ptr;

use flexbody::fmi2::state_name;

use crate::support::{Instance, InstanceState, SCENE, Status, Unit, call};

/// An instance at 0.1 s whose input has just jumped, with parameters of its own.
fn travelled(unit: &Unit) -> Instance<'_> {
    let instance = Instance::new(unit);
    assert_eq!(instance.set_elements(6), Status::Ok);
    assert_eq!(instance.set("rod.density", 4000.0), Status::Ok);
    instance.start();
    instance.run(0, 5);
    assert_eq!(instance.set("rod.tip.force[2]", 3.0), Status::Ok);
    instance
}

#[test]
fn rollback_reproduces_every_bit() {
    let unit = Unit::new();
    let instance = travelled(&unit);
    let undisturbed = travelled(&unit).run(5, 10);
    let state = instance.save();
    let outputs = instance.outputs();
    let expected = instance.run(5, 10);
    assert_eq!(expected, undisturbed, "saving has changed the run");
    for _ in 0..2 {
        assert_eq!(instance.restore(state), Status::Ok);
        assert_eq!(instance.outputs(), outputs);
        assert_eq!(instance.run(5, 10), expected);
    }
    instance.free(state);
}

#[test]
fn an_instance_that_did_nothing_else_goes_on_from_the_bytes() {
    let unit = Unit::new();
    let instance = travelled(&unit);
    let bytes = instance.fingerprint();
    let outputs = instance.outputs();
    let expected = instance.run(5, 10);
    let fresh = Instance::new(&unit);
    let state = fresh.deserialize(&bytes).expect("its own bytes");
    assert_eq!(fresh.restore(state), Status::Ok, "{}", fresh.record.last());
    fresh.free(state);
    assert_eq!(fresh.fingerprint(), bytes);
    assert_eq!(fresh.outputs(), outputs);
    assert_eq!(fresh.run(5, 10), expected);
}

#[test]
fn an_instance_without_resources_goes_on_from_the_bytes() {
    let unit = Unit::new();
    let instance = travelled(&unit);
    let bytes = instance.fingerprint();
    let expected = instance.run(5, 10);
    let bare = Instance::bare(&unit);
    // It has no model yet, and says so.
    assert_eq!(bare.step(0.1, 0.02), Status::Error);
    assert!(bare.record.last().contains("without fmuResourceLocation"));
    let state = bare.deserialize(&bytes).expect("bytes of the model");
    assert_eq!(bare.restore(state), Status::Ok, "{}", bare.record.last());
    assert_eq!(bare.run(5, 10), expected);
    bare.free(state);
    assert_eq!(call!(fmi2Reset, bare.component), Status::Ok);
    bare.start();
    // Of another model nothing is taken.
    let other = Unit::of(&SCENE.replace("9.81", "9.8"));
    let bare = Instance::bare(&other);
    assert!(bare.deserialize(&bytes).is_none());
}

#[test]
fn a_state_is_used_again_when_it_is_passed_in() {
    let unit = Unit::new();
    let instance = travelled(&unit);
    let mut state = instance.save();
    let first = state;
    instance.run(5, 7);
    assert_eq!(
        call!(fmi2GetFMUstate, instance.component, &mut state),
        Status::Ok
    );
    assert_eq!(state, first);
    assert_eq!(instance.serialize(state), instance.fingerprint());
    instance.free(state);
}

#[test]
fn states_carry_the_lifecycle_and_the_experiment() {
    let unit = Unit::new();
    let instance = Instance::new(&unit);
    let c = instance.component;
    let early = instance.save();
    assert_eq!(
        call!(fmi2SetupExperiment, c, 0, 0.0, 0.0, 1, 0.1),
        Status::Ok
    );
    assert_eq!(call!(fmi2EnterInitializationMode, c), Status::Ok);
    let initializing = instance.save();
    assert_eq!(call!(fmi2ExitInitializationMode, c), Status::Ok);
    let started = instance.save();
    let expected = instance.run(0, 5);
    assert_eq!(
        instance.step(0.1, 0.02),
        Status::Error,
        "past the stop time"
    );
    assert_eq!(instance.restore(initializing), Status::Ok);
    assert_eq!(instance.set("rod.density", 100.0), Status::Ok);
    assert_eq!(instance.set("rod.density", 5540.0), Status::Ok);
    assert_eq!(call!(fmi2ExitInitializationMode, c), Status::Ok);
    assert_eq!(instance.run(0, 5), expected);
    assert_eq!(call!(fmi2Terminate, c), Status::Ok);
    assert_eq!(instance.restore(started), Status::Ok);
    assert_eq!(instance.run(0, 5), expected);
    assert_eq!(
        instance.step(0.1, 0.02),
        Status::Error,
        "past the stop time"
    );
    assert_eq!(instance.restore(early), Status::Ok);
    instance.start();
    assert_eq!(instance.run(0, 6)[..5], expected[..]);
    for state in [early, initializing, started] {
        instance.free(state);
    }
}

#[test]
fn a_saved_state_leads_out_of_failure() {
    let unit = Unit::new();
    for failed in [InstanceState::StepFailed, InstanceState::Error] {
        let good = Instance::started(&unit);
        let bytes = good.fingerprint();
        let instance = Instance::in_state(&unit, failed);
        let state = instance
            .deserialize(&bytes)
            .expect("bytes of the same model");
        assert_eq!(instance.restore(state), Status::Ok);
        instance.free(state);
        assert_eq!(instance.run(0, 3), good.run(0, 3), "{}", state_name(failed));
    }
}

#[test]
fn damaged_cut_and_foreign_bytes_are_refused() {
    let unit = Unit::new();
    let instance = travelled(&unit);
    let bytes = instance.fingerprint();
    for at in 0..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x10;
        assert_eq!(instance.deserialize(&damaged), None, "byte {at}");
        assert!(instance.record.last().contains("saved state"));
        assert_eq!(instance.deserialize(&bytes[..at]), None, "{at} bytes");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert_eq!(instance.deserialize(&longer), None);
    let other = Unit::of(&SCENE.replace("-9.81", "-1.62"));
    let foreign = Instance::started(&other);
    assert_eq!(instance.deserialize(&foreign.fingerprint()), None);
    assert!(instance.record.last().contains("model"));
    let state = foreign.save();
    assert_eq!(instance.restore(state), Status::Error);
    foreign.free(state);
    assert_eq!(instance.fingerprint(), bytes);
}

#[test]
fn room_of_the_wrong_size_is_refused() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    let state = instance.save();
    let mut size = 0;
    let c = instance.component;
    assert_eq!(
        call!(
            fmi2SerializedFMUstateSize,
            c,
            state,
            ptr::from_mut(&mut size)
        ),
        Status::Ok
    );
    let mut room = vec![7_u8; size + 1];
    for wrong in [0, size - 1, size + 1] {
        let target = room.as_mut_ptr().cast();
        assert_eq!(
            call!(fmi2SerializeFMUstate, c, state, target, wrong),
            Status::Error
        );
        assert!(
            room.iter().all(|byte| *byte == 7),
            "written although refused"
        );
    }
    instance.free(state);
}

/// The stop time of a state holds where it is restored: in an instance that has another, and in one that has none.
#[test]
fn the_stop_time_of_a_state_holds_in_another_instance() {
    let unit = Unit::new();
    let begun = |stop: Option<f64>| {
        let instance = Instance::new(&unit);
        let (is_there, stop) = (i32::from(stop.is_some()), stop.unwrap_or(0.0));
        let c = instance.component;
        assert_eq!(
            call!(fmi2SetupExperiment, c, 0, 0.0, 0.0, is_there, stop),
            Status::Ok
        );
        assert_eq!(call!(fmi2EnterInitializationMode, c), Status::Ok);
        assert_eq!(call!(fmi2ExitInitializationMode, c), Status::Ok);
        instance
    };
    for stop in [Some(0.06), None] {
        let bytes = {
            let instance = begun(stop);
            instance.run(0, 2);
            instance.fingerprint()
        };
        for other in [Some(0.04), Some(0.2), None] {
            let instance = begun(other);
            let state = instance.deserialize(&bytes).expect("its own bytes");
            assert_eq!(instance.restore(state), Status::Ok);
            instance.free(state);
            assert_eq!(instance.fingerprint(), bytes);
            assert_eq!(instance.step(0.04, 0.02), Status::Ok);
            let beyond = instance.step(0.06, 0.02);
            assert_eq!(beyond == Status::Ok, stop.is_none(), "{stop:?} {other:?}");
        }
    }
}

/// A ball that is pulled slowly under Radau, whose steps lead beyond communication points, and a bar that lets go on the way.
const ON_THE_WAY: [&str; 2] = [
    r#"{"name": "dense", "dimension": 2, "gravity": [0, 0],
        "bodies": [{"element": "rigid", "name": "ball", "mass": 1, "position": [2, 0], "markers": {"c": [0, 0]}}],
        "loads": [{"name": "pull", "kind": "force", "marker": "ball.c", "value": ["cos(0.5*t)", 0.1]},
                  {"name": "rope", "kind": "spring_damper", "markers": ["ground", "ball.c"], "point": [0, 0],
                   "stiffness": 2, "damping": 0.5, "length": 1.9}],
        "outputs": [{"kind": "position", "marker": "ball.c"}, {"kind": "energy"}, {"kind": "work"}],
        "method": {"integrator": "radau"}, "accuracy": {"relative_tolerance": 1e-4}}"#,
    r#"{"name": "loose", "dimension": 3, "gravity": [0, 0, -9.81],
        "bodies": [{"element": "rigid", "name": "bar", "mass": 2, "inertia": [0.1, 0.2, 0.2], "position": [0.5, 0, 0],
            "markers": {"end": [-0.5, 0, 0], "tip": [0.5, 0, 0]}}],
        "joints": [{"name": "ball", "kind": "spherical", "markers": ["ground", "bar.end"], "release_time": 0.3}],
        "outputs": [{"kind": "position", "marker": "bar.tip"}, {"kind": "reaction", "joint": "ball"},
            {"kind": "energy"}, {"kind": "work"}]}"#,
];

/// Bytes of any point lead on as the run did, in an instance that has gone on to the end and in a new one.
#[test]
fn bytes_from_the_middle_of_a_step_or_from_before_a_release_go_on_everywhere() {
    for scene in ON_THE_WAY {
        let unit = Unit::of(scene);
        let gone_on = Instance::started(&unit);
        let expected = gone_on.run(0, 30);
        let saving = Instance::started(&unit);
        for first in 1..30 {
            saving.run(first - 1, first);
            let bytes = saving.fingerprint();
            for instance in [&gone_on, &Instance::new(&unit)] {
                let state = instance.deserialize(&bytes).expect("its own bytes");
                assert_eq!(instance.restore(state), Status::Ok);
                instance.free(state);
                let found = instance.run(first, 30);
                assert_eq!(found, expected[first as usize..], "from point {first}");
            }
        }
    }
}
