//! What a scene may not say, and how it is told: the place, what was expected, what was found.

use flexbody::scene::{Scene, beside};
use flexbody::simulation::{RedundantNames, Simulation, courses};
use serde_json::{Value, json};

const SCENE: &str = include_str!("../scenes/cantilever.json");
const FOUR_BAR: &str = include_str!("../scenes/four_bar.json");

/// Where, what stands there instead, and how the message begins.
const BAD: [(&str, &str, &str); 28] = [
    (
        "/dimension",
        "2.0",
        "dimension: expected 2 (the plane) or 3 (space), found 2.0",
    ),
    (
        "/experiment",
        "5",
        "experiment: expected an object { ... }, found 5",
    ),
    ("/bodies", "{}", "bodies: expected a list, found an object"),
    (
        "/initial",
        "\"rest\"",
        "initial: expected \"undeformed\" or \"static_equilibrium\" or \"steady\", found \"rest\"",
    ),
    (
        "/initial",
        "3",
        "initial: expected a state or {\"state\": ..., \"loads\": [...]}, found 3",
    ),
    (
        "/joints/0/markers",
        "\"beam.root\"",
        "joints[0].markers: expected a list of 2, found \"beam.root\"",
    ),
    (
        "/bodies/0/shape",
        "\"line\"",
        "bodies[0].shape.line: expected an object { ... }, found null",
    ),
    (
        "/inputs/0/follower",
        "\"yes\"",
        "inputs[0].follower: expected a boolean, found \"yes\"",
    ),
    (
        "/bodies/0/material/density",
        "-1",
        "bodies[0].material.density: expected a positive number (kg/m^3), found -1",
    ),
    (
        "/bodies/0/section/second_moment",
        "-1e-9",
        "bodies[0].section.second_moment: expected zero or a positive number",
    ),
    (
        "/bodies/0/markers/tip",
        "1.5",
        "bodies[0].markers.tip: expected a number from 0 to 1, found 1.5",
    ),
    (
        "/bodies/0/elements",
        "0",
        "bodies[0].elements: expected an integer from 1 to 100000, found 0",
    ),
    (
        "/bodies/0/elements",
        "2.5",
        "bodies[0].elements: expected zero or a positive integer, found 2.5",
    ),
    (
        "/bodies/0/colour",
        "\"red\"",
        "bodies[0].colour: expected one of the keys name, elements",
    ),
    (
        "/bodies/0/shape",
        "{\"arc\": {\"from\": [0, 0], \"to\": [1, 0], \"length\": 0.5}}",
        "bodies[0].shape.arc.length: expected more than the distance",
    ),
    (
        "/joints/0/kind",
        "\"ball\"",
        "joints[0].kind: expected \"revolute\" or",
    ),
    (
        "/joints/0/markers",
        "[\"ground\", \"beam.top\"]",
        "joints[0].markers[1]: expected a marker of this scene (beam.root, beam.tip), found \"beam.top\"",
    ),
    (
        "/joints/0/direction",
        "[1, 0]",
        "joints[0].direction: expected a key of the kind ",
    ),
    (
        "/joints/0/name",
        "\"beam\"",
        "joints[0].name: expected a name not used yet",
    ),
    (
        "/inputs/0/start",
        "[1.0]",
        "inputs[0].start: expected 2 component(s), found 1",
    ),
    (
        "/outputs/0",
        "{\"kind\": \"position\"}",
        "outputs[0].marker: expected a name, found nothing",
    ),
    (
        "/outputs/4/joint",
        "\"hinge\"",
        "outputs[4].joint: expected a joint of this scene",
    ),
    (
        "/gravity",
        "[0, 0, -9.81]",
        "gravity: expected 2 components [x, y], found 3",
    ),
    (
        "/dimension",
        "4",
        "dimension: expected 2 (the plane) or 3 (space), found 4",
    ),
    (
        "/dimension",
        "3",
        "gravity: expected 3 components [x, y, z], found 2",
    ),
    (
        "/accuracy/relative_tolerance",
        "0",
        "accuracy.relative_tolerance: expected a number from",
    ),
    (
        "/method",
        "{\"formulation\": \"as_printed\"}",
        "method.formulation: expected one of the keys integrator, work_limit, found \"formulation\"",
    ),
    ("/name", "\"a/b\"", "name: expected letters"),
];

/// The message about the cantilever with one value changed.
fn told(pointer: &str, value: Value) -> String {
    let mut scene: Value = serde_json::from_str(SCENE).expect("a shipped scene");
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
    match scene.pointer_mut(parent).expect("a place in the scene") {
        Value::Array(list) => list[key.parse::<usize>().expect("an index")] = value,
        place => place[key] = value,
    }
    match Scene::from_json(&scene.to_string()) {
        Ok(_) => "accepted".into(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn every_bad_value_is_named_with_its_place() {
    for (pointer, value, expected) in BAD {
        let value = serde_json::from_str(value).expect("JSON");
        let told = told(pointer, value);
        assert!(told.starts_with(expected), "{pointer}: {told}");
    }
    assert_eq!(told("/bodies/0/elements", json!(20)), "accepted");
}

#[test]
fn broken_json_is_a_message() {
    for text in ["", "{", "[]", "{\"name\": \"a\"} x", "nul"] {
        let error = Scene::from_json(text).expect_err("no scene");
        assert!(error.to_string().starts_with("scene: "), "{text}: {error}");
    }
    let list = Scene::from_json("[1, 2]").expect_err("a list").to_string();
    assert_eq!(list, "scene: expected an object { ... }, found a list");
    let comma = Scene::from_json("{\"name\": \"a\",}").expect_err("a comma");
    assert!(
        comma
            .to_string()
            .contains("expected JSON: trailing comma at line 1"),
        "{comma}"
    );
}

#[test]
fn a_mark_of_the_encoding_is_no_part_of_a_scene() {
    let marked = format!("\u{feff}{SCENE}");
    assert_eq!(Scene::from_json(&marked), Scene::from_json(SCENE));
}

#[test]
fn what_is_held_twice_is_reported_and_held_once() {
    let mut scene: Value = serde_json::from_str(SCENE).expect("a shipped scene");
    let again = json!({"name": "again", "kind": "revolute", "markers": ["ground", "beam.root"]});
    scene["joints"].as_array_mut().expect("joints").push(again);
    let mut simulation = Simulation::new(crate::planned(&scene.to_string()).expect("a scene"));
    simulation.initialize(0.0).expect("an equilibrium");
    let told = simulation.redundant();
    assert_eq!((told.exactly, told.nearly), (vec!["again".into()], vec![]));
}

/// What becomes of the four-bar linkage with a value changed: the message, or the redundant joints.
fn started(change: impl Fn(&mut Value)) -> Result<Vec<String>, String> {
    let mut scene: Value = serde_json::from_str(FOUR_BAR).expect("a shipped scene");
    change(&mut scene);
    let mut simulation = Simulation::new(crate::planned(&scene.to_string())?);
    let told = simulation
        .initialize(0.0)
        .map_err(|error| error.to_string());
    told.map(|_| simulation.redundant().exactly)
}

fn push(list: &mut Value, item: Value) {
    list.as_array_mut().expect("a list").push(item);
}

#[test]
fn a_linkage_as_shipped_holds_nothing_twice() {
    assert_eq!(started(|_| ()), Ok(Vec::new()));
}

#[test]
fn bodies_too_far_apart_are_named_with_the_gap() {
    // The far pivot out of reach of crank, coupler and rocker together.
    let told = started(|scene| scene["joints"][3]["point"] = json!([0.9, 0.0]));
    let told = told.expect_err("no linkage");
    assert!(
        told.contains("expected bodies that fit together, found gaps: "),
        "{told}"
    );
    assert!(told.contains("joint `rocker_pivot` 0."), "{told}");
}

#[test]
fn bodies_nearly_in_place_are_moved() {
    let told = started(|scene| {
        scene["bodies"][2]["position"] = json!([0.27, 0.15]);
        scene["bodies"][2]["angle"] = json!(1.5);
    });
    assert_eq!(told, Ok(Vec::new()));
}

#[test]
fn a_motion_of_what_is_held_is_refused_with_its_place() {
    let told = started(|scene| {
        let weld = json!({"name": "held", "kind": "weld", "markers": ["ground", "crank.root"]});
        push(&mut scene["joints"], weld);
        scene["motions"] = json!([{
            "name": "drive", "kind": "angle", "marker": "crank.root", "value": "t"
        }]);
    });
    let told = told.expect_err("no motion");
    assert!(
        told.starts_with("motions[0]: expected a motion of what joints"),
        "{told}"
    );
}

#[test]
fn a_link_that_others_make_needless_is_reported() {
    // As far apart as two points of one body are anyway.
    let told = started(|scene| {
        let link = json!({"name": "needless", "kind": "distance",
                          "markers": ["ground", "crank.pin"], "point": [0.0, 0.0]});
        push(&mut scene["joints"], link);
    });
    assert_eq!(told.map(|names| names.len()), Ok(1));
}

/// Runs a shipped scene as it proposes, under the inputs that it is planned for, and returns accepted and rejected sub-steps.
fn experiment(path: &std::path::Path) -> (u64, u64) {
    let text = std::fs::read_to_string(path).expect("a readable scene");
    let value: Value = serde_json::from_str(&text).expect("JSON");
    let proposed = |key: &str| value["experiment"][key].as_f64().expect("a proposal");
    let (stop, step) = (proposed("stop_time"), proposed("step"));
    let folder = path.parent().expect("a folder");
    let scene = Scene::from_json_with(&text, &beside(folder)).expect("a scene");
    let courses = courses(&scene).expect("courses of inputs");
    let mut simulation = Simulation::new(crate::planned_beside(&text, folder).expect("a scene"));
    let signals = courses.map(|table| table.signals(simulation.variables()));
    let signals = signals.transpose().expect("signals");
    if let Some(signals) = &signals {
        simulation.set_inputs(signals).expect("start values");
    }
    simulation.initialize(0.0).expect("an initial state");
    let (mut accepted, mut rejected, mut number) = (0, 0, 0_u32);
    while simulation.time() < stop {
        number += 1;
        let until = (f64::from(number) * step).min(stop);
        while simulation.time() < until {
            match &signals {
                Some(signals) => simulation.step_along(signals, until).expect("a step"),
                None => simulation.step(until).expect("a step"),
            }
            accepted += simulation.report().steps;
            rejected += simulation.report().rejected;
        }
    }
    assert_eq!(simulation.redundant(), RedundantNames::default());
    assert_eq!(simulation.next_singular(), None);
    for index in 0..simulation.variables().len() {
        let variable = &simulation.variables()[index];
        if !variable.is_integer() {
            let name = variable.name.clone();
            let value = simulation.real(index).expect("a number");
            assert!(value.is_finite(), "{name}: {value}");
        }
    }
    (accepted, rejected)
}

#[test]
fn shipped_scenes_run_without_a_struggle() {
    let scenes = crate::ready_scenes();
    assert!(scenes.len() >= 11, "{scenes:?}");
    for path in scenes {
        let (accepted, rejected) = experiment(&path);
        let place = path.display();
        assert!(
            2 * rejected < accepted,
            "{place}: {rejected} rejected, {accepted} accepted"
        );
        assert!(accepted < 100_000, "{place}: {accepted} steps");
    }
}

/// A rope on its own with a winch at one end.
fn wound(value: &str) -> Simulation {
    let scene = json!({"name": "wound", "dimension": 2, "accuracy": {"relative_tolerance": 1e-6},
        "bodies": [{"name": "rope", "element": "cable", "elements": 2, "material": {"youngs_modulus": 1e6, "density": 1e3},
                    "section": {"area": 1e-3, "second_moment": 0}, "shape": {"line": {"from": [0, 0], "to": [1.5, 0]}},
                    "markers": {"drum": 0}}],
        "motions": [{"name": "winch", "kind": "winch", "marker": "rope.drum", "value": value}],
        "outputs": [{"kind": "position", "marker": "rope.drum"}, {"kind": "natural_frequency", "count": 1}]});
    Simulation::new(Scene::from_json(&scene.to_string()).expect("a scene"))
}

#[test]
fn a_winch_begins_at_nothing_and_ends_with_its_cable() {
    let told = wound("0.1+t")
        .initialize(0.0)
        .expect_err("begun")
        .to_string();
    let wanted =
        "motions: expected a winch `winch` that has paid out nothing at the start, found 0.1 m";
    assert!(told.starts_with(wanted), "{told}");
    let mut simulation = wound("-t");
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    simulation.step(1.4).expect("a step");
    let failure = simulation.step(2.0).expect_err("the end of the cable");
    let wanted = "expected cable left to take in, found winch `winch` at its end";
    assert!(failure.reason.contains(wanted), "{failure}");
    assert!((1.4..1.5).contains(&failure.time), "{failure}");
}
