//! Communication steps: times, stop time, failure in the middle, many instances at once.

use std::sync::Barrier;
use std::thread;

use crate::support::{Instance, InstanceState, Status, Unit, call};

const LAST_SUCCESSFUL_TIME: i32 = 2;
const TERMINATED: i32 = 3;

#[test]
fn a_step_ends_exactly_where_it_should() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    let mut time = 0.0;
    for step in [0.1, 1e-9, 0.013, 0.3] {
        assert_eq!(instance.step(time, step), Status::Ok);
        time += step;
        assert_eq!(instance.get("time"), time);
    }
}

#[test]
fn impossible_times_and_steps_are_refused() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    instance.run(0, 1);
    let before = instance.fingerprint();
    for (time, step) in [
        (0.02, 0.0),
        (0.02, -0.1),
        (0.02, f64::NAN),
        (0.02, f64::INFINITY),
        (0.02, 1e-300),
        (f64::NAN, 0.1),
        (f64::INFINITY, 0.1),
        (0.0, 0.02),
        (0.04, 0.02),
        (0.03, 0.02),
    ] {
        assert_eq!(
            instance.step(time, step),
            Status::Error,
            "from {time} by {step}"
        );
        let message = instance.record.last();
        assert!(
            message.contains("communication") || message.contains("Communication"),
            "{message}"
        );
        assert_eq!(instance.fingerprint(), before);
    }
    assert_eq!(instance.step(0.02, 0.02), Status::Ok);
}

#[test]
fn the_stop_time_holds_but_for_rounding() {
    let unit = Unit::new();
    let instance = Instance::new(&unit);
    let c = instance.component;
    for (start, stop) in [(0.0, 0.0), (0.0, -1.0), (0.0, f64::NAN), (f64::NAN, 1.0)] {
        assert_eq!(
            call!(fmi2SetupExperiment, c, 0, 0.0, start, 1, stop),
            Status::Error
        );
    }
    for tolerance in [-1e-4, f64::NAN, 1.0] {
        assert_eq!(
            call!(fmi2SetupExperiment, c, 1, tolerance, 0.0, 0, 0.0),
            Status::Error
        );
        assert!(instance.record.last().contains("tolerance"));
    }
    assert_eq!(
        call!(fmi2SetupExperiment, c, 1, 1e-3, 0.0, 1, 0.3),
        Status::Ok
    );
    assert_eq!(call!(fmi2EnterInitializationMode, c), Status::Ok);
    assert_eq!(call!(fmi2ExitInitializationMode, c), Status::Ok);
    let mut time = 0.0;
    for _ in 0..3 {
        assert_eq!(instance.step(time, 0.1), Status::Ok);
        time += 0.1;
    }
    assert!(time > 0.3);
    assert_eq!(instance.step(time, 0.1), Status::Error);
    assert!(instance.record.last().contains("stop time"));
}

#[test]
fn a_start_time_is_kept() {
    let unit = Unit::new();
    let instance = Instance::new(&unit);
    let c = instance.component;
    assert_eq!(
        call!(fmi2SetupExperiment, c, 0, 0.0, -5.0, 0, 0.0),
        Status::Ok
    );
    assert_eq!(call!(fmi2EnterInitializationMode, c), Status::Ok);
    assert_eq!(instance.get("time"), -5.0);
    assert_eq!(instance.set("rod.density", 5000.0), Status::Ok);
    assert_eq!(call!(fmi2ExitInitializationMode, c), Status::Ok);
    assert_eq!(instance.get("time"), -5.0);
    assert_eq!(instance.step(0.0, 0.1), Status::Error);
    assert_eq!(instance.step(-5.0, 0.1), Status::Ok);
    assert_eq!(instance.get("time"), -5.0 + 0.1);
}

#[test]
fn a_step_that_fails_is_discarded_and_can_be_taken_again() {
    let unit = Unit::new();
    let instance = Instance::started(&unit);
    let c = instance.component;
    let expected = Instance::started(&unit).run(0, 4);
    instance.run(0, 2);
    let state = instance.save();
    assert_eq!(instance.set("rod.tip.force[1]", 1e300), Status::Ok);
    assert_eq!(instance.step(0.04, 0.02), Status::Discard);
    let (_, status, category, message) = instance.record.take().pop().expect("a message");
    assert_eq!(
        (status, category.as_str()),
        (Status::Discard, "logStatusWarning"),
        "{message}"
    );
    let (mut time, mut terminated) = (f64::NAN, 7);
    assert_eq!(
        call!(fmi2GetRealStatus, c, LAST_SUCCESSFUL_TIME, &mut time),
        Status::Ok
    );
    assert!((0.04..0.06).contains(&time), "{time}");
    assert_eq!(
        call!(fmi2GetBooleanStatus, c, TERMINATED, &mut terminated),
        Status::Ok
    );
    assert_eq!(terminated, 0);
    assert_eq!(
        call!(fmi2GetRealStatus, c, TERMINATED, &mut time),
        Status::Discard
    );
    assert_eq!(
        instance.step(0.04, 0.01),
        Status::Error,
        "before a state is restored"
    );
    assert_eq!(instance.restore(state), Status::Ok);
    instance.free(state);
    assert_eq!(instance.run(2, 4), expected[2..]);
}

#[test]
fn an_initialization_that_fails_says_why() {
    let unit = Unit::new();
    let instance = Instance::in_state(&unit, InstanceState::Instantiated);
    assert_eq!(instance.set_elements(1), Status::Ok);
    assert_eq!(
        call!(fmi2EnterInitializationMode, instance.component),
        Status::Error
    );
    let message = instance.record.last();
    assert!(message.contains("elements"), "{message}");
}

#[test]
fn instances_in_threads_do_what_one_does_alone() {
    const COUNT: usize = 64;
    let unit = Unit::new();
    let expected = Instance::started(&unit).run(0, 12);
    // Made in one thread, stepped in 64 others at once, and in other ones again.
    let mut instances: Vec<Instance<'_>> = (0..COUNT).map(|_| Instance::started(&unit)).collect();
    for round in 0..3 {
        let together = Barrier::new(COUNT);
        instances = thread::scope(|scope| {
            let threads = instances.into_iter().map(|instance| {
                let together = &together;
                scope.spawn(move || {
                    let step = |number| {
                        together.wait();
                        instance.run(number, number + 1).remove(0)
                    };
                    let run: Vec<_> = (4 * round..4 * (round + 1)).map(step).collect();
                    (instance, run)
                })
            });
            let threads: Vec<_> = threads.collect();
            let back = threads.into_iter().map(|thread| {
                let (instance, run) = thread.join().expect("no panic");
                assert_eq!(run, expected[4 * round as usize..][..4]);
                instance
            });
            back.collect()
        });
        instances.rotate_left(17);
    }
}

#[test]
fn interleaved_instances_do_not_meet() {
    let unit = Unit::new();
    let alone = Instance::started(&unit).run(0, 5);
    let (first, second) = (Instance::new(&unit), Instance::new(&unit));
    assert_eq!(second.set("gravity[2]", -1.62), Status::Ok);
    first.start();
    second.start();
    for number in 0..5 {
        assert_eq!(first.run(number, number + 1)[0], alone[number as usize]);
        assert_ne!(second.run(number, number + 1)[0], alone[number as usize]);
    }
}
