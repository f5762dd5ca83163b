//! What is told of constraints that do not count: those that others give exactly, those that they nearly give, and singular
//! positions along the way.

use std::f64::consts::PI;

use flexbody::scene::Scene;
use flexbody::simulation::{Redundant, Simulation, Singular};
use serde_json::{Value, json};

/// Length of the cranks of the parallelogram, and of its coupler and ground, m.
const CRANK: f64 = 0.2;
const COUPLER: f64 = 0.5;
/// Rate of the cranks, rad/s.
const SPIN: f64 = 10.0;

/// A bar along the first axis at an angle, by its lower end.
fn bar(name: &str, length: f64, [x, y]: [f64; 2], angle: f64) -> Value {
    let half = length / 2.0;
    json!({
        "name": name, "element": "rigid", "mass": 0.3, "inertia": 1e-3, "angle": angle,
        "position": [x + half * angle.cos(), y + half * angle.sin()],
        "markers": {"root": [-half, 0.0], "pin": [half, 0.0], "middle": [0.0, 0.0]}
    })
}

/// A parallelogram at an angle whose cranks turn freely, without gravity, the rocker longer by so much (m).
fn four_bars(angle: f64, longer: f64) -> Value {
    let (sin, cos) = angle.sin_cos();
    let mut bodies = [
        bar("crank", CRANK, [0.0, 0.0], angle),
        bar("coupler", COUPLER, [CRANK * cos, CRANK * sin], 0.0),
        bar("rocker", CRANK + longer, [COUPLER, 0.0], angle),
    ];
    for (body, part) in bodies.iter_mut().zip([0.5, 1.0, 0.5]) {
        let velocity = [-sin, cos].map(|v| v * part * CRANK * SPIN);
        let spin = if part == 1.0 { 0.0 } else { SPIN };
        body["motion"] = json!({"velocity": velocity, "spin": spin});
    }
    let ground = |name: &str, marker: &str, x: f64| json!({"name": name, "kind": "revolute", "markers": ["ground", marker], "point": [x, 0.0]});
    let pin = |name: &str, markers: [&str; 2]| json!({"name": name, "kind": "revolute", "markers": markers});
    json!({
        "name": "four_bars", "dimension": 2, "gravity": [0.0, 0.0], "bodies": bodies,
        "joints": [
            ground("pivot", "crank.root", 0.0),
            pin("crank_pin", ["crank.pin", "coupler.root"]),
            pin("rocker_pin", ["coupler.pin", "rocker.pin"]),
            ground("rocker_pivot", "rocker.root", COUPLER),
        ],
        "outputs": [{"kind": "reaction", "joint": "rocker_pivot"}],
        "accuracy": {"relative_tolerance": 1e-9},
        "experiment": {"stop_time": 2.0, "step": 0.05}
    })
}

/// When it is flat for the first time, and the second, s.
fn flat(angle: f64) -> [f64; 2] {
    [1.0, 2.0].map(|turns| (turns * PI - angle) / SPIN)
}

fn started(scene: &Value) -> Simulation {
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("an initial state");
    simulation.start().expect("a start");
    simulation
}

/// What is told on the way to a time.
fn told(simulation: &mut Simulation, until: f64) -> Vec<Singular> {
    simulation.step(until).expect("a step");
    simulation.next_singular().into_iter().collect()
}

fn shipped(place: &str) -> Simulation {
    let path = format!(
        "{}/tests/cases/{place}/scene.json",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(path).expect("a scene");
    started(&serde_json::from_str(&text).expect("JSON"))
}

/// Time from the flat position at which a condition leaves a few ten-thousandths of itself, s.
const NEAR: f64 = 3e-5;

#[test]
fn a_singular_position_on_the_way_is_told_once_by_name() {
    for (longer, off) in [(0.0, NEAR), (0.0, 0.0), (1e-9, NEAR)] {
        let mut simulation = started(&four_bars(0.25, longer));
        assert_eq!(simulation.redundant(), Redundant::default(), "{longer}");
        let [first, second] = flat(0.25);
        assert_eq!(told(&mut simulation, first - 0.05), [], "{longer}");
        let [near] = &told(&mut simulation, first + off)[..] else {
            panic!("expected one message, {longer} m longer and {off} s off");
        };
        assert!((near.time - first).abs() < 1e-4, "{near}");
        assert_eq!(near.names.len(), 1, "{near}");
        assert!(near.to_string().starts_with(&near.names[0]), "{near}");
        assert_eq!(told(&mut simulation, first + 0.05), [], "{longer}");
        assert_eq!(told(&mut simulation, second + off), [], "{longer}");
    }
}

#[test]
fn steps_that_stay_off_singular_positions_are_told_of_by_nothing() {
    let mut simulation = started(&four_bars(0.25, 0.0));
    for step in 1..5 {
        assert_eq!(told(&mut simulation, f64::from(step) * 0.05), []);
    }
}

#[test]
fn a_restored_state_is_told_of_where_nobody_was() {
    let [first, _] = flat(0.25);
    let scene = four_bars(0.25, 0.0);
    let mut simulation = started(&scene);
    assert_eq!(told(&mut simulation, first - 0.01), []);
    let before = simulation.snapshot();
    assert_eq!(told(&mut simulation, first - NEAR).len(), 1);
    let within = simulation.snapshot();
    simulation.restore(&before).expect("a state of this scene");
    assert_eq!(told(&mut simulation, first + NEAR), []);
    let mut other = started(&scene);
    other.restore(&within).expect("a state of this scene");
    assert_eq!(told(&mut other, first - NEAR / 2.0).len(), 1);
}

#[test]
fn what_nearly_repeats_others_is_told_apart_at_the_start() {
    // A third crank between the others, along them or not quite.
    for turned in [0.0, 1e-4] {
        let mut scene = four_bars(0.5, 0.0);
        let [(sin, cos), (s, c)] = [0.5, 0.5 + turned].map(f64::sin_cos);
        let root = [COUPLER / 2.0 + CRANK * (cos - c), CRANK * (sin - s)];
        let third = bar("third", CRANK, root, 0.5 + turned);
        scene["bodies"].as_array_mut().expect("a list").push(third);
        let joints = scene["joints"].as_array_mut().expect("a list");
        joints.push(json!({"name": "third_pivot", "kind": "revolute", "markers": ["ground", "third.root"], "point": root}));
        joints.push(json!({"name": "third_pin", "kind": "revolute", "markers": ["coupler.middle", "third.pin"]}));
        let Redundant { exactly, nearly } = started(&scene).redundant();
        let is_near = turned > 0.0;
        let expected = [usize::from(!is_near), usize::from(is_near)];
        assert_eq!(
            [exactly.len(), nearly.len()],
            expected,
            "{exactly:?} {nearly:?}"
        );
    }
}

#[test]
fn linkages_that_hold_what_they_hold_exactly_are_not_told_of() {
    for (place, points, step) in [
        ("bricard", 40, 0.05),
        ("andrews_in_space", 30, 0.001),
        ("four_bars_in_space", 40, 0.01),
    ] {
        let mut simulation = shipped(place);
        let Redundant { exactly, nearly } = simulation.redundant();
        assert!(!exactly.is_empty(), "{place}");
        assert_eq!(nearly, [""; 0], "{place}");
        for point in 1..=points {
            assert_eq!(
                told(&mut simulation, f64::from(point) * step),
                [],
                "{place}"
            );
        }
    }
}
