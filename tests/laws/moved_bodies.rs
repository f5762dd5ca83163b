//! Mechanisms of rigid bodies in the plane, moved into any plane of space with joints about its normal, move there as they
//! do in the plane.

use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::laws::differences::{Outcome, check, within};
use crate::laws::moved::{Plane, agree, simulation, values};

const CASES: u32 = 8;

/// Differences, relative to the size of what is compared, that roundoff may make at the start: of positions and of the
/// rest; and after steps, which are others in space.
const AT_START: [f64; 2] = [1e-11, 1e-8];
const AT_END: [f64; 2] = [1e-9, 1e-7];

/// Inertia about the axes of the plane over that about its normal: nothing rotates about these.
const ACROSS: [f64; 2] = [0.6, 0.7];

fn body(name: &str, position: [f64; 2], spin: f64, markers: Value) -> Value {
    json!({"name": name, "element": "rigid", "mass": 1.3, "inertia": 0.4, "position": position,
           "motion": {"velocity": [0.1, -0.2], "spin": spin}, "markers": markers})
}

fn read(kinds: &[&str], key: &str, of: &[&str]) -> Vec<Value> {
    let of = of
        .iter()
        .flat_map(|of| kinds.iter().map(move |kind| (kind, of)));
    of.map(|(kind, of)| json!({"kind": kind, key: of}))
        .collect()
}

const MOVES: [&str; 5] = [
    "position",
    "velocity",
    "acceleration",
    "angular_velocity",
    "angular_acceleration",
];
const TURNS: [&str; 3] = ["angle", "angular_velocity", "angular_acceleration"];

fn scene(parts: Value, outputs: &[Vec<Value>]) -> Value {
    let mut scene = parts;
    let whole = ["energy", "momentum", "center_of_mass"].map(|kind| json!({"kind": kind}));
    scene["name"] = json!("mechanism");
    scene["dimension"] = json!(2);
    scene["gravity"] = json!([0.4, -9.81]);
    scene["outputs"] = outputs.iter().flatten().cloned().chain(whole).collect();
    scene["accuracy"] = json!({"relative_tolerance": 1e-11});
    scene
}

/// A double pendulum on a hinge, pushed and rotated; a sleeve on a moving rod, what is welded to it, a body that does not
/// rotate, one on a moving line, and one on a link.
fn open() -> Value {
    let parts = json!({
        "bodies": [
            body("a", [0.5, -0.3], 0.4, json!({"in": [-0.5, 0.3], "out": [0.4, -0.2], "c": [0.0, 0.0]})),
            body("b", [1.3, -0.9], -0.7, json!({"in": [-0.4, 0.4], "tip": [0.3, -0.5]})),
            body("sleeve", [0.7, -0.35], 0.0, json!({"c": [0.0, 0.0], "side": [0.1, 0.3]})),
            body("lamp", [0.8, -0.05], 0.0, json!({"foot": [0.0, 0.0], "top": [0.1, 0.2]})),
            body("table", [-1.0, 0.6], 0.0, json!({"c": [0.0, 0.0]})),
            body("bead", [0.2, -0.8], 1.1, json!({"c": [0.0, 0.0], "edge": [0.2, 0.1]})),
            body("bob", [2.0, 0.5], 0.3, json!({"eye": [0.1, 0.2]}))],
        "joints": [
            {"name": "pin", "kind": "revolute", "markers": ["ground", "a.in"]},
            {"name": "knee", "kind": "revolute", "markers": ["a.out", "b.in"], "stiffness": 3.0, "damping": 0.2, "angle": 0.15},
            {"name": "rail", "kind": "prismatic", "markers": ["a.c", "sleeve.c"], "direction": [0.2, -0.05]},
            {"name": "weld", "kind": "weld", "markers": ["sleeve.side", "lamp.foot"]},
            {"name": "guide", "kind": "orientation", "markers": ["ground", "table.c"]},
            {"name": "groove", "kind": "point_on_line", "markers": ["a.c", "bead.c"], "direction": [-0.3, -0.5]},
            {"name": "link", "kind": "distance", "markers": ["b.tip", "bob.eye"]}],
        "loads": [
            {"name": "motor", "kind": "torque", "joint": "knee", "value": "0.5*cos(3*t)"},
            {"name": "twist", "kind": "moment", "marker": "a.c", "value": "0.4+t"},
            {"name": "thrust", "kind": "force", "marker": "b.tip", "follower": true, "value": [0.8, "-1.2*t"]},
            {"name": "push", "kind": "force", "marker": "table.c", "value": [0.3, 0.9]},
            {"name": "stop", "kind": "spring_damper", "markers": ["a.in", "sleeve.c"], "stiffness": 40.0, "damping": 0.4},
            {"name": "stay", "kind": "spring_damper", "markers": ["ground", "bead.edge"], "point": [0.0, -1.5],
             "stiffness": 20.0, "damping": 0.3}]});
    let outputs = [
        read(
            &MOVES,
            "marker",
            &[
                "a.out",
                "b.tip",
                "lamp.top",
                "table.c",
                "bead.edge",
                "bob.eye",
            ],
        ),
        read(&TURNS, "joint", &["pin", "knee"]),
        read(
            &["reaction"],
            "joint",
            &["pin", "knee", "rail", "weld", "groove", "link"],
        ),
        read(&["reaction_moment"], "joint", &["rail", "weld", "guide"]),
    ];
    scene(parts, &outputs)
}

/// A four-bar whose crank is driven, and a slider-crank that a torque rotates: in space their joints hold some things twice.
fn closed() -> Value {
    let crank = json!({"in": [-0.2, -0.1], "out": [0.2, 0.1], "c": [0.0, 0.0]});
    let parts = json!({
        "bodies": [
            body("crank", [0.2, 0.1], 0.0, crank),
            body("coupler", [0.9, 0.6], 0.0, json!({"in": [-0.5, -0.4], "out": [0.5, 0.3], "c": [0.0, 0.2]})),
            body("rocker", [1.3, 0.4], 0.0, json!({"in": [0.2, -0.5], "out": [0.1, 0.5]})),
            body("wheel", [0.0, 3.0], 0.9, json!({"c": [0.0, 0.0], "out": [0.2, 0.3]})),
            body("rod", [0.7, 3.1], 0.0, json!({"in": [-0.5, 0.2], "out": [0.5, -0.1]})),
            body("piston", [1.2, 3.0], 0.0, json!({"c": [0.0, 0.0], "face": [0.1, 0.0]}))],
        "joints": [
            {"name": "p1", "kind": "revolute", "markers": ["ground", "crank.in"]},
            {"name": "p2", "kind": "revolute", "markers": ["crank.out", "coupler.in"]},
            {"name": "p3", "kind": "revolute", "markers": ["coupler.out", "rocker.out"]},
            {"name": "p4", "kind": "revolute", "markers": ["ground", "rocker.in"], "stiffness": 2.0, "damping": 0.1},
            {"name": "s1", "kind": "revolute", "markers": ["ground", "wheel.c"]},
            {"name": "s2", "kind": "revolute", "markers": ["wheel.out", "rod.in"]},
            {"name": "s3", "kind": "revolute", "markers": ["rod.out", "piston.c"]},
            {"name": "s4", "kind": "prismatic", "markers": ["ground", "piston.c"], "direction": [1.0, 0.1]}],
        "motions": [{"name": "drive", "kind": "angle", "joint": "p1", "value": "1.5*t+2*t^2"}],
        "loads": [
            {"name": "motor", "kind": "torque", "joint": "s1", "value": "2-3*t"},
            {"name": "gas", "kind": "force", "marker": "piston.face", "value": [-1.5, 0.4]},
            {"name": "spring", "kind": "spring_damper", "markers": ["wheel.out", "piston.c"], "stiffness": 15.0,
             "damping": 0.2}]});
    let outputs = [
        read(
            &MOVES,
            "marker",
            &["coupler.c", "rocker.out", "rod.out", "piston.face"],
        ),
        read(&TURNS, "joint", &["p1", "p2", "p3", "p4", "s1", "s2", "s3"]),
    ];
    scene(parts, &outputs)
}

fn pair(of: &Value) -> [f64; 2] {
    [0, 1].map(|k| of[k].as_f64().expect("a number"))
}

/// In the axes of a body, which are those of the plane.
fn along_axes(of: &Value) -> Value {
    json!([of[0], of[1], 0.0])
}

fn moved_body(plane: &Plane, flat: &Value) -> Value {
    let mut body = flat.clone();
    let inertia = flat["inertia"].as_f64().expect("a number");
    let spin = flat["motion"]["spin"].as_f64().expect("a number");
    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| plane.axes[(i, j)]));
    body["inertia"] = json!([ACROSS[0] * inertia, ACROSS[1] * inertia, inertia]);
    body["orientation"] = json!({"matrix": rows});
    body["position"] = json!(plane.point(pair(&flat["position"])));
    body["motion"]["velocity"] = json!(plane.vector(pair(&flat["motion"]["velocity"])));
    body["motion"]["spin"] = json!(plane.normal().map(|n| n * spin));
    let markers = flat["markers"].as_object().expect("markers");
    let moved = markers
        .iter()
        .map(|(name, at)| (name.clone(), along_axes(at)));
    body["markers"] = Value::Object(moved.collect());
    body
}

fn moved_joint(plane: &Plane, flat: &Value) -> Value {
    let mut joint = flat.clone();
    let on_ground = flat["markers"][0] == "ground";
    if flat["kind"] == "revolute" {
        joint["direction"] = if on_ground {
            json!(plane.normal())
        } else {
            json!([0.0, 0.0, 1.0])
        };
    } else if !flat["direction"].is_null() {
        joint["direction"] = if on_ground {
            json!(plane.vector(pair(&flat["direction"])))
        } else {
            along_axes(&flat["direction"])
        };
    }
    joint
}

fn moved_load(plane: &Plane, flat: &Value) -> Value {
    let mut load = plane.moved("", flat);
    let follows = flat["follower"] == true;
    match flat["kind"].as_str() {
        Some("force") if follows => load["value"] = along_axes(&flat["value"]),
        Some("moment") => {
            let value = flat["value"].as_str().expect("an expression");
            load["value"] = json!(plane.normal().map(|n| format!("{n:?}*({value})")));
        }
        _ => {}
    }
    load
}

fn moved(plane: &Plane, flat: &Value) -> Value {
    let each = |list: &str, of: fn(&Plane, &Value) -> Value| -> Value {
        let parts = flat[list].as_array().into_iter().flatten();
        parts.map(|part| of(plane, part)).collect()
    };
    let mut scene = flat.clone();
    scene["dimension"] = json!(3);
    scene["gravity"] = json!(plane.vector(pair(&flat["gravity"])));
    scene["bodies"] = each("bodies", moved_body);
    scene["joints"] = each("joints", moved_joint);
    scene["loads"] = each("loads", moved_load);
    scene
}

fn runs_alike(flat: &Value, (axis, distance): ([f64; 3], f64)) -> Outcome {
    let plane = Plane {
        axes: Rotation3::new(Vector3::from(axis)),
        distance,
    };
    let there = moved(&plane, flat);
    let (mut flat, mut moved) = (simulation(flat), simulation(&there));
    let told = |when: &'static str| move |e| TestCaseError::fail(format!("{when}: {e}"));
    agree(&mut flat, &mut moved, &plane, AT_START).map_err(told("start"))?;
    for part in 1..=4 {
        let until = 0.05 * f64::from(part);
        flat.step(until).expect("a step in the plane");
        moved.step(until).expect("a step in space");
    }
    agree(&mut flat, &mut moved, &plane, AT_END).map_err(told("end"))
}

#[test]
fn planar_mechanisms_of_rigid_bodies_move_alike_in_any_plane_of_space() {
    let planes = || (prop::array::uniform3(-2.0..2.0), -1.0..1.0);
    check(CASES, planes(), |plane| runs_alike(&open(), plane));
    check(CASES, planes(), |plane| runs_alike(&closed(), plane));
}

/// Bars that hang on hinges one below the other, along the second axis of the plane.
fn hanging(count: usize) -> Value {
    let name = |k: usize| format!("bar{k}");
    let bars = (0..count).map(|k| {
        let markers = json!({"top": [0.0, 0.25], "low": [0.0, -0.25]});
        let mut bar = body(&name(k), [0.3, -0.25 - 0.5 * k as f64], 0.0, markers);
        bar["motion"]["velocity"] = json!([0.0, 0.0]);
        bar
    });
    let hinges = (0..count).map(|k| {
        let above = match k {
            0 => "ground".into(),
            _ => format!("{}.low", name(k - 1)),
        };
        json!({"name": format!("hinge{k}"), "kind": "revolute", "markers": [above, format!("{}.top", name(k))],
               "stiffness": 2.0 + 0.1 * k as f64})
    });
    json!({"name": "hanging", "dimension": 2, "gravity": [0.0, -9.81], "bodies": bars.collect::<Vec<_>>(),
           "joints": hinges.collect::<Vec<_>>(),
           "outputs": [{"kind": "natural_frequency", "count": 3}, {"kind": "eigenvalue", "count": 3}]})
}

/// In the plane by iteration where bodies are many.
#[test]
fn chains_of_rigid_bodies_swing_alike_in_any_plane_of_space() {
    let planes = || (prop::array::uniform3(-2.0..2.0), -1.0..1.0);
    check(4, planes(), |(axis, distance): ([f64; 3], f64)| {
        for count in [3, 15] {
            let flat = hanging(count);
            let plane = Plane {
                axes: Rotation3::new(Vector3::from(axis)),
                distance,
            };
            let there = moved(&plane, &flat);
            let (mut flat, mut moved) = (simulation(&flat), simulation(&there));
            for word in ["natural_frequency", "eigenvalue.frequency"] {
                for (a, b) in values(&mut flat, word).iter().zip(values(&mut moved, word)) {
                    within(word, (a - b).abs(), 1e-7 * a)?;
                }
            }
        }
        Ok(())
    });
}
