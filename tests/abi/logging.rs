//! Messages: by category, as text and not as a format, and errors alone when logging is off.

use std::ffi::{CStr, c_char};
use std::ptr;

use crate::abi::parallelogram::{NEAR, flat, four_bars, three_cranks};
use crate::support::{Instance, Line, SCENE, Status, Unit, call};

fn enable(instance: &Instance<'_>, on: bool, categories: &[&CStr]) -> Status {
    let names: Vec<*const c_char> = categories.iter().map(|name| name.as_ptr()).collect();
    let c = instance.component;
    call!(
        fmi2SetDebugLogging,
        c,
        i32::from(on),
        names.len(),
        names.as_ptr()
    )
}

/// Something for every category but the warnings.
fn work(instance: &Instance<'_>) -> Vec<String> {
    assert_eq!(call!(fmi2Reset, instance.component), Status::Ok);
    instance.start();
    assert_eq!(instance.step(0.0, 0.01), Status::Ok);
    assert_eq!(instance.step(-1.0, 0.01), Status::Error);
    let mut categories: Vec<String> = instance
        .record
        .take()
        .into_iter()
        .map(|line| line.2)
        .collect();
    categories.dedup();
    categories
}

#[test]
fn categories_are_filtered() {
    let unit = Unit::new();
    let instance = Instance::new(&unit);
    assert_eq!(
        work(&instance),
        ["logEvents", "logSolver", "logStatusError"]
    );
    assert_eq!(enable(&instance, true, &[c"logSolver"]), Status::Ok);
    assert_eq!(work(&instance), ["logSolver"]);
    assert_eq!(
        enable(&instance, true, &[c"logEvents", c"logStatusError"]),
        Status::Ok
    );
    assert_eq!(work(&instance), ["logEvents", "logStatusError"]);
    assert_eq!(enable(&instance, false, &[]), Status::Ok);
    assert_eq!(work(&instance), ["logStatusError"]);
    assert_eq!(enable(&instance, true, &[]), Status::Ok);
    assert_eq!(work(&instance).len(), 3);
}

#[test]
fn unknown_categories_are_warned_of_and_the_others_count() {
    let unit = Unit::new();
    let instance = Instance::new(&unit);
    let told = |on: bool, names: &[&CStr]| {
        instance.record.take();
        let status = enable(&instance, on, names);
        let (_, logged, category, message) = instance.record.take().pop().expect("a message");
        assert_eq!((status, logged), (Status::Warning, Status::Warning));
        assert_eq!(category, "logStatusWarning");
        message
    };
    // Told although it is not among what is logged from then on.
    assert!(told(true, &[c"gossip", c"logSolver"]).contains("\"gossip\""));
    assert_eq!(work(&instance), ["logSolver"]);
    assert!(told(false, &[c"%s%n"]).contains("%s%n"));
    assert_eq!(work(&instance), ["logStatusError"]);
    assert_eq!(enable(&instance, true, &[c"logAll"]), Status::Ok);
    assert_eq!(work(&instance).len(), 3);
    assert_eq!(
        enable(&instance, true, &[c"logEvents", c"\xff"]),
        Status::Error
    );
    instance.record.take();
    assert_eq!(work(&instance).len(), 3);
}

/// FMI 2.0.4, sections 2.1.3 and 2.1.5: `loggingOn` is about debug messages, and the logger is called before `fmi2Error` is returned.
#[test]
fn logging_off_leaves_the_reasons_of_errors_alone() {
    let unit = Unit::new();
    let instance = Instance::with_logging(&unit, false);
    assert_eq!(work(&instance), ["logStatusError"]);
    assert_eq!(instance.set("rod.tip.force[1]", 1e300), Status::Ok);
    assert_eq!(instance.step(0.01, 0.01), Status::Discard);
    assert!(instance.record.take().is_empty());
    assert_eq!(
        call!(fmi2GetFMUstate, instance.component, ptr::null_mut()),
        Status::Error
    );
    assert_eq!(instance.record.take().len(), 1);
}

/// A marker lies between nodes that one element does not have.
#[test]
fn a_start_that_cannot_be_computed_says_why_when_logging_is_off() {
    let unit = Unit::new();
    let instance = Instance::with_logging(&unit, false);
    assert_eq!(instance.set_elements(1), Status::Ok);
    let answer = call!(fmi2EnterInitializationMode, instance.component);
    assert_eq!(answer, Status::Error);
    let lines = instance.record.take();
    assert_eq!(lines.len(), 1);
    assert!(lines[0].3.contains("elements"), "{lines:?}");
}

#[test]
fn messages_carry_the_name_the_status_and_the_work_of_the_solver() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    instance.record.take();
    assert_eq!(instance.step(0.0, 0.05), Status::Ok);
    let lines = instance.record.take();
    let (name, status, category, message) = lines.into_iter().next().expect("a message");
    assert_eq!(
        (name.as_str(), status, category.as_str()),
        ("instance", Status::Ok, "logSolver")
    );
    for word in ["0.05", "steps", "rejected", "Newton"] {
        assert!(message.contains(word), "{message}");
    }
}

#[test]
fn a_step_that_fails_tells_the_work_it_took() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    assert_eq!(instance.set("rod.tip.force[1]", 1e300), Status::Ok);
    instance.record.take();
    assert_eq!(instance.step(0.0, 0.05), Status::Discard);
    let lines = instance.record.take();
    let (_, status, _, message) = &lines[0];
    assert_eq!((lines.len(), *status), (2, Status::Ok));
    let words: Vec<&str> = message.split([' ', ',']).collect();
    let before = |word| words[words.iter().position(|w| *w == word).expect(word) - 1];
    assert!(
        message.starts_with("to time 0 s: r"),
        "no method: {message}"
    );
    assert_eq!(before("steps"), "0", "{message}");
    assert_ne!(before("rejected"), "0", "{message}");
}

/// The rod of rubber has 4 elements: too few for its shape once it swings.
#[test]
fn a_mesh_that_is_too_coarse_is_warned_of_once() {
    let asked = SCENE.replace(
        "\"outputs\": [",
        "\"outputs\": [{ \"kind\": \"resolution\" },",
    );
    for scene in [&asked[..], SCENE] {
        let unit = Unit::of(scene);
        let instance = Instance::started(&unit);
        instance.record.take();
        instance.run(0, 25);
        let lines = instance.record.take().into_iter();
        let told = lines.filter(|line| line.3.starts_with("resolution"));
        let told: Vec<_> = told.collect();
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(
            told.iter()
                .all(|line| (line.1, &line.2[..]) == (Status::Warning, "logStatusWarning")),
            "{told:?}"
        );
    }
}

/// What was said since the last time of joints that hold what others hold already.
fn said_of_joints(instance: &Instance<'_>) -> Vec<Line> {
    let mut lines = instance.record.take();
    lines.retain(|line| line.3.contains("others hold"));
    lines
}

#[test]
fn joints_that_repeat_others_are_told_of_and_those_that_nearly_do_are_warned_of() {
    for (turned, status, start, end) in [
        (0.0, Status::Ok, "joints that hold ", "already: third"),
        (
            1e-4,
            Status::Warning,
            "joints that nearly hold ",
            "from another position",
        ),
    ] {
        let unit = Unit::of(&three_cranks(turned).to_string());
        let instance = Instance::started(&unit);
        let [(_, found, category, message)] = &said_of_joints(&instance)[..] else {
            panic!("expected one message, turned by {turned}");
        };
        assert_eq!((*found, &category[..]), (status, "logStatusWarning"));
        assert!(message.starts_with(start), "{message}");
        assert!(message.contains(""), "{message}");
        assert!(message.ends_with(end), "{message}");
        assert_eq!(instance.step(0.0, 1e-3), Status::Ok);
        assert_eq!(said_of_joints(&instance), [], "again");
    }
}

#[test]
fn a_singular_position_on_the_way_is_warned_of_once() {
    let unit = Unit::of(&four_bars(0.25, 0.0).to_string());
    let instance = Instance::started(&unit);
    let (mut now, mut said) = (0.0, Vec::new());
    let [first, second] = flat(0.25);
    for until in [first - 0.05, first - NEAR, first + 0.05, second - NEAR] {
        assert_eq!(instance.step(now, until - now), Status::Ok);
        said.push(said_of_joints(&instance));
        now = until;
    }
    let [before, at, after, again] = &said[..] else {
        unreachable!("four steps");
    };
    assert_eq!([before, after, again], [&vec![]; 3]);
    let [(_, status, category, message)] = &at[..] else {
        panic!("expected one message, found {at:?}");
    };
    let found = (*status, &category[..]);
    assert_eq!(found, (Status::Warning, "logStatusWarning"));
    assert!(message.starts_with("rocker: at 0.289"), "{message}");
    assert!(
        message.contains("at or near a singular position"),
        "{message}"
    );
}
