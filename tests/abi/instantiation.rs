//! What `fmi2Instantiate` refuses, and that it says why.

use flexbody::fmi2::abi;
use std::ffi::{c_char, c_int};
use std::ptr;

use crate::support::{CO_SIMULATION, Instance, Record, SCENE, Unit, call, text};

struct Arguments {
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    location: *const c_char,
}

impl Arguments {
    fn of(unit: &Unit) -> Self {
        let (guid, location) = (unit.guid.as_ptr(), unit.location.as_ptr());
        Self {
            name: c"instance".as_ptr(),
            kind: CO_SIMULATION,
            guid,
            location,
        }
    }

    /// The reason that is logged although logging is off.
    fn refusal(&self) -> String {
        let record = Record::default();
        let callbacks = record.callbacks();
        let Self {
            name,
            kind,
            guid,
            location,
        } = *self;
        let component = call!(
            fmi2Instantiate,
            name,
            kind,
            guid,
            location,
            &callbacks,
            0,
            0
        );
        assert!(component.is_null(), "instantiated");
        let lines = record.take();
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert_eq!(lines[0].2, "logStatusError");
        lines[0].3.clone()
    }
}

#[test]
fn arguments_that_are_missing_or_wrong_are_named() {
    let unit = Unit::new();
    let with = |change: &dyn Fn(&mut Arguments)| {
        let mut arguments = Arguments::of(&unit);
        change(&mut arguments);
        arguments.refusal()
    };
    assert!(with(&|a| a.name = ptr::null()).contains("instanceName"));
    assert!(with(&|a| a.name = c" ".as_ptr()).contains("instanceName"));
    assert!(with(&|a| a.kind = 0).contains("fmuType"));
    assert!(with(&|a| a.kind = 7).contains("fmuType"));
    assert!(with(&|a| a.guid = ptr::null()).contains("fmuGUID"));
    assert!(with(&|a| a.guid = c"{0}".as_ptr()).contains("fmuGUID"));
    assert!(with(&|a| a.location = c"\xff".as_ptr()).contains("fmuResourceLocation"));
    assert!(with(&|a| a.location = c"https://host/p".as_ptr()).contains("fmuResourceLocation"));
    assert!(with(&|a| a.location = c"file:///nowhere".as_ptr()).contains("scene.json"));
}

#[test]
fn scenes_that_are_broken_or_changed_are_refused() {
    let refusal = |scene: &[u8]| {
        let unit = Unit::new();
        unit.overwrite(scene);
        Arguments::of(&unit).refusal()
    };
    assert!(refusal(b"{").contains("scene.json"));
    assert!(refusal(b"\xff").contains("scene.json"));
    let negative = SCENE.replace("5540.0", "-1");
    assert!(refusal(negative.as_bytes()).contains("bodies[0].material.density"));
    let other = SCENE.replace("-9.81", "-1.62");
    assert!(refusal(other.as_bytes()).contains("fmuGUID"));
}

#[test]
fn without_callbacks_there_is_no_instance_and_without_a_logger_there_is() {
    let unit = Unit::new();
    let Arguments {
        name,
        kind,
        guid,
        location,
    } = Arguments::of(&unit);
    let none = call!(
        fmi2Instantiate,
        name,
        kind,
        guid,
        location,
        ptr::null(),
        0,
        1
    );
    assert!(none.is_null());
    let mut callbacks = Record::default().callbacks();
    callbacks.logger = None;
    callbacks.component_environment = ptr::null_mut();
    let silent = call!(
        fmi2Instantiate,
        name,
        kind,
        guid,
        location,
        &callbacks,
        1,
        1
    );
    assert!(!silent.is_null());
    assert_eq!(
        call!(fmi2DoStep, silent, 0.0, 0.1, 0),
        crate::support::Status::Error
    );
    call!(fmi2FreeInstance, silent);
    call!(fmi2FreeInstance, ptr::null_mut());
}

#[test]
fn the_forms_of_a_resource_location_are_understood() {
    let mut unit = Unit::new();
    let path = unit
        .location
        .to_str()
        .expect("UTF-8")
        .trim_start_matches("file://")
        .to_owned();
    let escaped = path.replace('-', "%2D");
    for location in [
        format!("file:{path}"),
        format!("file://localhost{path}/"),
        format!("file://{escaped}"),
    ] {
        unit.location = text(&location);
        drop(Instance::started(&unit));
    }
}

#[test]
fn versions_are_told() {
    let words = [abi::fmi2GetVersion(), abi::fmi2GetTypesPlatform()].map(|word| {
        // SAFETY: C strings that live forever.
        unsafe { std::ffi::CStr::from_ptr(word) }
    });
    assert_eq!(words, [c"2.0", c"default"]);
}
