//! The tolerance of a master: the tighter one of it and the scene's holds.

use crate::support::{Instance, Line, Status, Unit, call};

/// The tolerance of [`crate::support::SCENE`].
const OF_SCENE: f64 = 1e-4;

/// Sets an experiment up with a tolerance; what the log says.
fn set_up(instance: &Instance<'_>, tolerance: f64) -> Vec<Line> {
    instance.record.take();
    let c = instance.component;
    let status = call!(fmi2SetupExperiment, c, 1, tolerance, 0.0, 0, 0.0);
    assert_eq!(status, Status::Ok, "{tolerance}");
    instance.record.take()
}

fn start(instance: &Instance<'_>) {
    let c = instance.component;
    assert_eq!(call!(fmi2EnterInitializationMode, c), Status::Ok);
    assert_eq!(call!(fmi2ExitInitializationMode, c), Status::Ok);
}

#[test]
fn the_tighter_tolerance_holds_and_that_is_said_once() {
    let unit = Unit::new();
    let usual = Instance::started(&unit).run(0, 5);
    let instance = Instance::new(&unit);
    let lines = set_up(&instance, 1e-2);
    assert_eq!(lines.len(), 1, "{lines:?}");
    let (_, status, category, message) = &lines[0];
    assert_eq!(
        (*status, &category[..]),
        (Status::Warning, "logStatusWarning")
    );
    assert!(
        message.contains("at most 1e-4") && message.contains("found 1e-2"),
        "{message}"
    );
    start(&instance);
    assert_eq!(instance.get("relative_tolerance"), OF_SCENE);
    assert_eq!(instance.run(0, 5), usual);
    assert_eq!(call!(fmi2Reset, instance.component), Status::Ok);
    assert!(set_up(&instance, 1e-2).is_empty());
    start(&instance);
    assert_eq!(instance.get("relative_tolerance"), OF_SCENE);
    assert_eq!(call!(fmi2Reset, instance.component), Status::Ok);
    assert!(set_up(&instance, 1e-6).is_empty());
    start(&instance);
    assert_eq!(instance.get("relative_tolerance"), 1e-6);
    assert_ne!(instance.run(0, 5), usual);
}

#[test]
fn a_tolerance_of_zero_or_as_it_is_says_nothing() {
    let unit = Unit::new();
    let usual = Instance::started(&unit).run(0, 5);
    for tolerance in [0.0, OF_SCENE] {
        let instance = Instance::new(&unit);
        assert!(set_up(&instance, tolerance).is_empty());
        start(&instance);
        assert_eq!(instance.get("relative_tolerance"), OF_SCENE);
        assert_eq!(instance.run(0, 5), usual);
    }
}

/// Who wants a looser one sets the parameter.
#[test]
fn the_parameter_takes_a_looser_tolerance() {
    let unit = Unit::new();
    let instance = Instance::new(&unit);
    set_up(&instance, 1e-2);
    assert_eq!(instance.set("relative_tolerance", 1e-3), Status::Ok);
    start(&instance);
    assert_eq!(instance.get("relative_tolerance"), 1e-3);
}
