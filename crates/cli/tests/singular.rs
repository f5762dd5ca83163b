//! What is told of constraints that do not count: those that others give exactly, those that they nearly give, and singular
//! positions along the way.

#[path = "../../../tests/abi/parallelogram.rs"]
mod parallelogram;

use std::process::Command;

use flexbody::scene::Scene;
use flexbody::simulation::{RedundantNames, Simulation, Singular};
use serde_json::{Value, json};

use parallelogram::{NEAR, flat, four_bars, three_cranks};

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
        "{}/../../tests/cases/{place}/scene.json",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(path).expect("a scene");
    started(&serde_json::from_str(&text).expect("JSON"))
}

#[test]
fn a_singular_position_on_the_way_is_told_once_by_name() {
    for (longer, off) in [(0.0, NEAR), (0.0, 0.0), (1e-9, NEAR)] {
        let mut simulation = started(&four_bars(0.25, longer));
        assert_eq!(
            simulation.redundant(),
            RedundantNames::default(),
            "{longer}"
        );
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
    for turned in [0.0, 1e-4] {
        let scene = three_cranks(turned);
        let RedundantNames { exactly, nearly } = started(&scene).redundant();
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
        let RedundantNames { exactly, nearly } = simulation.redundant();
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

/// What `flexbody simulate` prints beside its outputs, and its report.
fn simulated(scene: &Value, step: f64, stop_time: f64) -> (Vec<String>, Value) {
    let name = format!("flexbody-singular-{}-{step}", std::process::id());
    let folder = std::env::temp_dir().join(name);
    std::fs::create_dir_all(&folder).expect("a writable temporary directory");
    let [file, output, report] = ["scene.json", "run.csv", "report.json"].map(|f| folder.join(f));
    std::fs::write(&file, scene.to_string()).expect("a writable temporary directory");
    let run = Command::new(env!("CARGO_BIN_EXE_flexbody"))
        .arg("simulate")
        .arg(&file)
        .arg(format!("--step={step}"))
        .arg(format!("--stop-time={stop_time}"))
        .arg("--output")
        .arg(&output)
        .arg("--report")
        .arg(&report)
        .output()
        .expect("the program runs");
    let printed = String::from_utf8(run.stderr).expect("UTF-8");
    assert!(run.status.success(), "{printed}");
    let report = std::fs::read_to_string(&report).expect("a report");
    std::fs::remove_dir_all(&folder).expect("a writable temporary directory");
    let printed = printed.lines().map(str::to_owned).collect();
    (printed, serde_json::from_str(&report).expect("JSON"))
}

#[test]
fn what_repeats_others_is_printed_and_reported() {
    for (turned, step, lists, end) in [
        (0.0, 1e-3, [json!(["third"]), json!([])], "already"),
        (
            1e-4,
            2e-3,
            [json!([]), json!(["third"])],
            "from another position",
        ),
    ] {
        let (printed, report) = simulated(&three_cranks(turned), step, step);
        let [line] = &printed[..] else {
            panic!("expected one line, found {printed:?}");
        };
        assert!(line.starts_with("flexbody: third"), "{line}");
        assert_eq!(line.contains("nearly held by others"), turned > 0.0);
        assert!(line.ends_with(end), "{line}");
        let found = ["redundant", "nearly_redundant"].map(|key| report[key].clone());
        assert_eq!(found, lists, "{report}");
        assert_eq!(report["singular"], json!([]), "{report}");
    }
}

#[test]
fn a_singular_position_on_the_way_is_printed_and_reported() {
    let [first, _] = flat(0.25);
    let (printed, report) = simulated(&four_bars(0.25, 0.0), first, first + 0.05);
    let [line] = &printed[..] else {
        panic!("expected one line, found {printed:?}");
    };
    let [position] = &report["singular"].as_array().expect("a list")[..] else {
        panic!("expected one position: {report}");
    };
    let (time, names) = (&position["time"], &position["names"]);
    assert!((time.as_f64().expect("a time") - first).abs() < 1e-4);
    let name = names[0].as_str().expect("a name");
    assert_eq!(names, &json!([name]), "{report}");
    let expected = format!("flexbody: {name}: at {time} s at or near a singular position, ");
    assert!(line.starts_with(&expected), "{line}");
    for key in ["redundant", "nearly_redundant"] {
        assert_eq!(report[key], json!([]), "{report}");
    }
}

/// Two links that are stretched straight between two pins cannot move, though to first order constraints let their common pin fall: its velocity
/// grew by `g t`, with kinetic energy from nothing.
#[test]
fn what_is_held_at_a_dead_point_has_no_velocity() {
    for dimension in [2, 3] {
        let flat = |x: f64| match dimension {
            2 => json!([x, 0.0]),
            _ => json!([x, 0.0, 0.0]),
        };
        let (gravity, inertia, kind) = match dimension {
            2 => (json!([0.0, -9.81]), json!(0.1), "revolute"),
            _ => (
                json!([0.0, 0.0, -9.81]),
                json!([0.1, 0.1, 0.1]),
                "spherical",
            ),
        };
        let body = |name: &str, x: f64| {
            json!({"name": name, "element": "rigid", "mass": 1.0, "inertia": inertia, "position": flat(x),
                   "markers": {"i": flat(-0.5), "o": flat(0.5)}})
        };
        let joint = |name: &str, markers: [&str; 2]| json!({"name": name, "kind": kind, "markers": markers});
        let mut last = joint("last", ["ground", "m.o"]);
        last["point"] = flat(2.0);
        let mut simulation = started(&json!({
            "name": "dead_point", "dimension": dimension, "gravity": gravity,
            "bodies": [body("l", 0.5), body("m", 1.5)],
            "joints": [joint("first", ["ground", "l.i"]), joint("middle", ["l.o", "m.i"]), last],
            "outputs": [{"kind": "velocity", "marker": "l.o"}, {"kind": "energy"}],
            "experiment": {"stop_time": 2.0, "step": 0.01}
        }));
        let index = |simulation: &Simulation, name: &str| {
            let mut variables = simulation.variables().iter();
            variables.position(|v| v.name == name).expect(name)
        };
        for step in 1..=200 {
            simulation.step(f64::from(step) * 0.01).expect("a step");
            for (name, most) in [
                (format!("l.o.velocity[{dimension}]"), 1e-2),
                ("energy.kinetic".into(), 1e-4),
            ] {
                let index = index(&simulation, &name);
                let found = simulation.real(index).expect("a number");
                assert!(
                    found.abs() < most,
                    "{dimension}: {name} {found} at step {step}"
                );
            }
        }
        assert!(simulation.next_singular().is_some());
    }
}

/// A link without weight holds the end of a body along itself alone: the body begins to fall freely.
#[test]
fn a_link_of_hardly_any_mass_is_held_by_its_joints() {
    for mass in [1e-6, 1e-9, 1e-12] {
        let link = json!({"name": "link", "element": "rigid", "mass": mass, "inertia": vec![1e-2 * mass; 3],
            "position": [0.5, 0, 0], "markers": {"i": [-0.5, 0, 0], "o": [0.5, 0, 0]}});
        let bob = json!({"name": "bob", "element": "rigid", "mass": 1, "inertia": [0.1, 0.1, 0.1],
            "position": [1.5, 0, 0], "markers": {"i": [-0.5, 0, 0], "c": [0, 0, 0]}});
        let scene = json!({"name": "light", "dimension": 3, "gravity": [0, 0, -9.81], "bodies": [link, bob],
            "joints": [
                {"name": "j", "kind": "spherical", "markers": ["ground", "link.i"]},
                {"name": "k", "kind": "spherical", "markers": ["link.o", "bob.i"]}],
            "outputs": [{"kind": "position", "marker": "bob.c"}],
            "experiment": {"stop_time": 0.05, "step": 0.05}});
        let mut simulation = started(&scene);
        assert_eq!(simulation.redundant(), RedundantNames::default(), "{mass}");
        assert_eq!(told(&mut simulation, 0.05), [], "{mass}");
        let mut variables = simulation.variables().iter();
        let height = variables.position(|v| v.name == "bob.c.position[3]");
        let height = simulation.real(height.expect("a height")).expect("a value");
        let fallen = -0.5 * 9.81 * 0.05_f64.powi(2);
        assert!((height / fallen - 1.0).abs() < 1e-4, "{mass}: {height}");
    }
}

/// A joint in the plane that gives one body the direction of another makes nothing redundant that a person has said.
#[test]
fn joints_that_hold_directions_in_the_plane_hold_nothing_twice() {
    let body = |name: &str, x: f64| json!({"name": name, "element": "rigid", "mass": 1, "inertia": 0.1, "position": [x, 0], "markers": {"c": [0, 0]}});
    for (kind, direction) in [
        ("weld", None),
        ("orientation", None),
        ("prismatic", Some([1, 0])),
    ] {
        let mut joint = json!({"name": "tie", "kind": kind, "markers": ["a.c", "b.c"]});
        if let Some(direction) = direction {
            joint["direction"] = json!(direction);
        }
        let mut simulation = started(&json!({
            "name": "pair", "dimension": 2, "bodies": [body("a", 0.0), body("b", 0.4)], "joints": [joint]
        }));
        assert_eq!(simulation.redundant(), RedundantNames::default(), "{kind}");
        assert_eq!(told(&mut simulation, 0.1), [], "{kind}");
    }
}
