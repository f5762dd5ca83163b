//! Whole runs that are hard: a master that takes steps too long and tries shorter ones, and a million
//! steps of a microsecond.

use crate::support::{Instance, SCENE, Status, Unit, call};

const LAST_SUCCESSFUL_TIME: i32 = 2;

/// A ring of 0.1 kg that slides along a clamped beam of 1 m.
const RING: &str = r#"{
  "name": "ring", "dimension": 2,
  "bodies": [
    { "name": "beam", "element": "cable", "elements": 4,
      "material": { "youngs_modulus": 7.0e10, "density": 2700.0 },
      "section": { "area": 1.0e-4, "second_moment": 1.0e-9 },
      "shape": { "line": { "from": [0.0, 0.0], "to": [1.0, 0.0] } },
      "markers": { "root": 0.0, "tip": 1.0 } },
    { "name": "ring", "element": "rigid", "mass": 0.1, "inertia": 0.0, "position": [0.9, 0.0],
      "markers": { "eye": [0.0, 0.0] } }
  ],
  "joints": [
    { "name": "clamp", "kind": "weld", "markers": ["ground", "beam.root"] },
    { "name": "sliding", "kind": "point_on_cable", "markers": ["beam", "ring.eye"] }
  ],
  "inputs": [{ "kind": "force", "marker": "ring.eye" }],
  "outputs": [{ "kind": "travel", "joint": "sliding" }, { "kind": "velocity", "marker": "ring.eye" }]
}"#;

/// Force of a controller that the master holds over a step: 40 N/m towards the middle, 2.8 N s/m.
fn control(instance: &Instance<'_>) -> Status {
    let (way, speed) = (
        instance.get("sliding.travel"),
        instance.get("ring.eye.velocity[1]"),
    );
    instance.set("ring.eye.force[1]", -40.0 * (way - 0.5) - 2.8 * speed)
}

/// Tries to advance by a number of steps; where one is discarded, says when the last good time was.
fn advance(instance: &Instance<'_>, from: f64, step: f64, count: u32) -> Result<(), f64> {
    for number in 0..count {
        let time = from + f64::from(number) * step;
        assert_eq!(control(instance), Status::Ok);
        match instance.step(time, step) {
            Status::Ok => {}
            Status::Discard => {
                let (c, mut last) = (instance.component, f64::NAN);
                let status = call!(fmi2GetRealStatus, c, LAST_SUCCESSFUL_TIME, &mut last);
                assert_eq!(status, Status::Ok);
                assert!((time..time + step).contains(&last), "{last}");
                assert_eq!(instance.get("time"), last);
                assert_eq!(instance.step(last, step), Status::Error);
                return Err(last);
            }
            other => panic!("{other:?}: {}", instance.record.last()),
        }
    }
    Ok(())
}

#[test]
fn a_master_that_tries_shorter_steps_finishes() {
    let unit = Unit::of(RING);
    let instance = Instance::started(&unit);
    let (interval, mut count, mut discarded) = (0.5, 1, Vec::new());
    for number in 0..6 {
        let from = interval * f64::from(number);
        let state = instance.save();
        let before = instance.fingerprint();
        while let Err(last) = advance(&instance, from, interval / f64::from(count), count) {
            discarded.push(last);
            assert_eq!(instance.restore(state), Status::Ok);
            assert_eq!(instance.fingerprint(), before);
            count *= 2;
        }
        instance.free(state);
    }
    assert!(
        discarded.len() >= 2 && count <= 32,
        "{discarded:?}, {count}"
    );
    let way = instance.get("sliding.travel");
    assert!((way - 0.5).abs() < 1e-3, "{way}");
    assert_eq!(call!(fmi2Terminate, instance.component), Status::Ok);
}

#[test]
fn a_million_steps_of_a_microsecond() {
    let scene = SCENE.replace("\"damping_time\": 1.0e-4", "\"damping_time\": 0.0");
    let unit = Unit::of(&scene);
    let energy = |instance: &Instance<'_>| -> f64 {
        let names = ["energy.kinetic", "energy.strain", "energy.gravity"];
        names.map(|name| instance.get(name)).iter().sum()
    };
    let time = |number: u32| f64::from(number) * 1e-6;
    let instance = Instance::with_logging(&unit, false);
    instance.start();
    for number in 0..1_000_000 {
        let now = time(number);
        // An input that changes, though by nothing that matters, ends every step at the communication point.
        instance.set("rod.tip.force[1]", 1e-60 * f64::from(number));
        assert_eq!(instance.step(now, 1e-6), Status::Ok);
        if number % 1000 == 999 {
            assert_eq!(instance.get("time"), now + 1e-6);
        }
    }
    let coarse = Instance::with_logging(&unit, false);
    coarse.start();
    coarse.run(0, 50);
    let [short, long] = [&instance, &coarse].map(energy);
    assert!(instance.get("energy.kinetic") > 10.0);
    // It starts with none, and steps that are far too short for the tolerance lose none.
    assert!(
        short.abs() < 1e-10 && short.abs() < long.abs(),
        "{short} {long} J"
    );
    for name in ["rod.tip.position[1]", "rod.tip.position[2]"] {
        let [short, long] = [&instance, &coarse].map(|instance| instance.get(name));
        assert!((short - long).abs() < 1e-4, "{name}: {short} {long}");
    }
}
