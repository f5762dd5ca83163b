//! What ends a run: functions of time without a value, linkages at the end of their reach, too much work; how
//! it is told, and that a run goes on from a state restored.

use flexbody::scene::{Scene, assemble};
use flexbody::simulation::{Simulation, StepFailure};
use serde_json::{Value, json};

/// A free particle, 1 kg.
fn particle(changes: Value) -> Value {
    let mut scene = json!({
        "name": "particle", "dimension": 2,
        "bodies": [{"name": "p", "element": "rigid", "mass": 1, "position": [0, 0], "markers": {"c": [0, 0]}}],
        "outputs": [{"kind": "position", "marker": "p.c"}]
    });
    for (key, value) in changes.as_object().expect("keys") {
        scene[key] = value.clone();
    }
    scene
}

fn started(scene: &Value) -> Result<Simulation, String> {
    let scene = Scene::from_json(&scene.to_string()).map_err(|error| error.to_string())?;
    let mut simulation = Simulation::new(scene);
    let told = simulation.initialize(0.0);
    told.map_err(|error| error.to_string())?;
    simulation.start().map_err(|error| error.to_string())?;
    Ok(simulation)
}

/// What a run to 2 s by steps of 0.1 s is ended by.
fn told(scene: &Value) -> String {
    let mut simulation = match started(scene) {
        Ok(simulation) => simulation,
        Err(told) => return told,
    };
    let mut steps = (1..=20).map(|k| simulation.step(0.1 * f64::from(k)));
    match steps.find_map(Result::err) {
        Some(failure) => failure.to_string(),
        None => "nothing".into(),
    }
}

#[test]
fn a_function_of_time_without_a_value_is_named_with_its_place() {
    let force = |x: &str| json!({"loads": [{"name": "push", "kind": "force", "marker": "p.c", "value": [x, 0]}]});
    let drive = |x: &str| json!({"motions": [{"name": "drive", "kind": "position", "marker": "p.c", "value": [0, x]}]});
    let cases = [
        (
            force("1/t"),
            "loads[0].value[0]: expected a finite value of `push` at t = 0 s, found inf",
        ),
        (force("1/(t-0.5)"), "loads[0].value[0]: expected a "),
        (force("1/(t-0.5123)^2"), "loads[0].value[0]: expected a "),
        (
            force("ln(0.7-t)"),
            "loads[0].value[0]: expected a finite value of `push` at t = 0.",
        ),
        (force("if(t < 3, t, 1/(t-t))"), "nothing"),
        (
            drive("1/t"),
            "motions[0].value[1]: expected a finite value of `drive` at t = 0 s, found inf",
        ),
        (
            drive("sqrt(t)"),
            "motions[0].value[1]: expected a finite first derivative of `drive` at t = 0 s",
        ),
        (
            drive("tan(3*t)"),
            "expected a motion without jumps, found one of `drive`",
        ),
        (
            drive("1/(t-0.77)"),
            "expected a motion without jumps, found one of `drive`",
        ),
        (
            drive("sqrt(0.75-t)"),
            "motions[0].value[1]: expected a finite value of `drive` at t = 0.8",
        ),
        (
            drive("step(t-0.31)"),
            "expected a motion without jumps, found one of `drive`",
        ),
        (drive("min(t, 0.5)"), "nothing"),
    ];
    for (changes, wanted) in cases {
        let mut scene = particle(changes.clone());
        scene["method"] = json!({"work_limit": 3e6});
        scene["accuracy"] = json!({"relative_tolerance": 1e-4});
        let told = told(&scene);
        assert!(told.starts_with(wanted), "{changes}: {told}");
    }
}

/// A crank and a rod of 1 m each, whose end is driven along a rail away from the pivot: 2 m is all they reach.
#[test]
fn a_linkage_at_the_end_of_its_reach_is_told() {
    let bar = |name: &str, x: f64, angle: f64| {
        json!({"name": name, "element": "rigid", "mass": 1, "inertia": 0.1, "position": [x, 0.4], "angle": angle,
            "markers": {"a": [-0.5, 0], "b": [0.5, 0]}})
    };
    let angle = 0.8_f64.asin();
    let scene = json!({
        "name": "reach", "dimension": 2, "method": {"work_limit": 1e6},
        "accuracy": {"relative_tolerance": 1e-4},
        "bodies": [bar("crank", 0.3, angle), bar("rod", 0.9, -angle),
            {"name": "block", "element": "rigid", "mass": 1, "inertia": 1, "position": [1.2, 0], "markers": {"c": [0, 0]}}],
        "joints": [
            {"name": "pin", "kind": "revolute", "markers": ["ground", "crank.a"]},
            {"name": "knee", "kind": "revolute", "markers": ["crank.b", "rod.a"]},
            {"name": "wrist", "kind": "revolute", "markers": ["rod.b", "block.c"]},
            {"name": "rail", "kind": "point_on_line", "markers": ["ground", "block.c"], "direction": [1, 0]}],
        "motions": [{"name": "drive", "kind": "displacement", "joint": "rail", "value": "t"}],
        "outputs": [{"kind": "position", "marker": "block.c"}]
    });
    let told = told(&scene);
    let is_told = told.contains("dead point") || told.contains("end of its reach");
    assert!(is_told, "{told}");
}

/// A force that swings ten thousand times in a second.
fn laborious(limit: f64) -> Value {
    particle(json!({
        "loads": [{"name": "push", "kind": "force", "marker": "p.c", "value": ["1e8*sin(62832*t)", 0]}],
        "method": {"work_limit": limit}
    }))
}

#[test]
fn work_is_bounded_and_the_way_on_is_open() {
    let scene = laborious(1e5);
    let mut simulation = started(&scene).expect("a start");
    let start = simulation.snapshot();
    let StepFailure { time, reason } = simulation.step(1.0).expect_err("too much");
    assert!(
        time > 0.0 && time < 1.0 && time == simulation.time(),
        "{time}"
    );
    assert!(
        reason.contains("within work_limit = 1e5 (evaluations times 5 parts)"),
        "{reason}"
    );
    assert!(
        reason.contains("take shorter communication steps"),
        "{reason}"
    );
    // What was done is proportional to the limit, by count and not by clock.
    let done = simulation.report();
    assert!((1e5..1.01e5).contains(&done.work), "{}", done.work);
    let mut again = started(&scene).expect("a start");
    again.step(1.0).expect_err("too much");
    assert_eq!((again.time(), again.report()), (time, done));
    // From where it stands, and from a state restored, shorter steps go on.
    simulation.step(1.5 * time).expect("half as much again");
    simulation.restore(&start).expect("a state");
    simulation.step(0.5 * time).expect("half as much");
    // A higher limit takes the whole way.
    let mut patient = started(&laborious(1e9)).expect("a start");
    patient.step(1.1 * time).expect("little of a billion");
}

#[test]
fn a_restored_state_meets_the_same_kinks_with_the_same_bits() {
    let text = include_str!("cases/switched_loads/scene.json");
    let scene: Value = serde_json::from_str(text).expect("JSON");
    let mut simulation = started(&scene).expect("a start");
    simulation.step(0.42).expect("a step");
    let middle = simulation.snapshot();
    let run = |simulation: &mut Simulation| {
        for until in [0.5, 0.503, 0.7, 1.3] {
            simulation.step(until).expect("a step");
        }
        let count = simulation.variables().len();
        let values = (0..count).map(|i| simulation.real(i).unwrap_or(0.0).to_bits());
        values.collect::<Vec<_>>()
    };
    let first = run(&mut simulation);
    simulation.restore(&middle).expect("a state");
    assert_eq!(run(&mut simulation), first);
    let mut other = started(&scene).expect("a start");
    other.restore(&middle).expect("a state");
    assert_eq!(run(&mut other), first);
}

#[test]
fn a_port_that_drives_what_a_joint_holds_is_refused_before_a_start() {
    let scene = particle(json!({
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "p.c"]}],
        "ports": [{"name": "plug", "marker": "p.c", "kind": "motion"}]
    }));
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let told = assemble::<2>(&scene).expect_err("held already").to_string();
    assert!(
        told.starts_with("ports[0]: expected a motion of what joints"),
        "{told}"
    );
}

#[test]
fn more_elements_than_memory_holds_are_refused() {
    let cable = |i: usize| {
        json!({"name": format!("c{i}"), "element": "cable", "elements": 100_000,
            "material": {"youngs_modulus": 7e5, "density": 5540},
            "section": {"area": 1.8e-3, "second_moment": 1.215e-8},
            "shape": {"line": {"from": [0, i], "to": [1, i]}}})
    };
    let bodies: Vec<Value> = (0..11).map(cable).collect();
    let scene = particle(json!({"bodies": bodies, "outputs": []}));
    let told = Scene::from_json(&scene.to_string())
        .expect_err("too many")
        .to_string();
    assert_eq!(
        told,
        "bodies: expected at most 1000000 elements in all bodies together, found 1100000"
    );
}
