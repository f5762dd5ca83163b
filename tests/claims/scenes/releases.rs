//! Joints that let go: what they held goes on by itself.

use serde_json::{Value, json};

use super::{extra, sum, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        flung("flung", json!({"release_time": 0.3}), 0.3, 0.3),
        flung("flung_by_input", json!({}), 0.5, 0.5),
        flung("flung_at_once", json!({}), 0.0, 0.0),
        spun_off(),
        all_go(),
        all_go_in_space(),
    ]
}

/// A bob that circles steadily without gravity flies along the tangent once it is let go, and goes on rotating.
fn flung(name: &'static str, keys: Value, due: f64, told: f64) -> Specimen {
    let (r, spin, mass) = (0.8, 1.7, 2.0);
    let mut joint = json!({"name": "pin", "kind": "revolute", "markers": ["ground", "bob.p"], "point": [0.2, 0.1]});
    let by_input = keys.get("release_time").is_none();
    if let Some(time) = keys.get("release_time") {
        joint["release_time"] = time.clone();
    }
    let start = json!([f64::from(u8::from(due == 0.0))]);
    let inputs = if by_input {
        json!([{"kind": "release", "joint": "pin", "start": start}])
    } else {
        json!([])
    };
    let scene = json!({
        "name": name, "dimension": 2,
        "bodies": [{"element": "rigid", "name": "bob", "mass": mass, "inertia": 0.3, "position": [1.0, 0.1],
                    "motion": {"velocity": [0.0, r * spin], "spin": spin},
                    "markers": {"c": [0.0, 0.0], "p": [-r, 0.0]}}, extra()],
        "joints": [joint, {"name": "other", "kind": "weld", "markers": ["ground", "extra.a"]}], "inputs": inputs,
        "outputs": [{"kind": "position", "marker": "bob.c"}, {"kind": "angular_velocity", "marker": "bob.c"},
                    {"kind": "reaction", "joint": "pin"}],
        "accuracy": {"relative_tolerance": 1e-10}});
    let arm = |t: f64| turned(spin * t, [r, 0.0]);
    let held = |t: f64| sum([0.2, 0.1], arm(t));
    let way = times(spin, turned(0.5 * std::f64::consts::PI, arm(due)));
    let free = |t: f64| sum(held(due), times(t - due, way));
    let pull = |t: f64| times(-mass * spin * spin, arm(t));
    let mut specimen = Specimen::new(name, scene);
    if due > 0.0 {
        specimen = specimen
            .vector("pin.reaction", "N", pull(0.0))
            .at(0.2)
            .vector_within("bob.c.position", "m", held(0.2), 1e-8)
            .vector_within("pin.reaction", "N", pull(0.2), 1e-6);
    }
    if by_input && due > 0.0 {
        specimen = specimen
            // It holds at 0 and below.
            .set("pin.release", -0.02)
            .at(told)
            .vector_within("bob.c.position", "m", held(told), 1e-8)
            .set("pin.release", 1.0);
    }
    specimen = specimen
        .at(0.7)
        .vector_within("bob.c.position", "m", free(0.7), 1e-8)
        .vector("pin.reaction", "N", [0.0, 0.0]);
    if by_input {
        specimen = specimen.at(0.9).set("pin.release", 0.0);
    }
    specimen
        .at(1.2)
        .vector_within("bob.c.position", "m", free(1.2), 1e-8)
        .claim_within("bob.c.angular_velocity", "rad/s", spin, 1e-8)
}

/// The same in space, about an axis, of the second of two bodies on hinges that rotate as one.
fn spun_off() -> Specimen {
    let (r, spin, due) = (1.2, 1.7, 0.4);
    let body = |name: &str, x: f64| {
        json!({"element": "rigid", "name": name, "mass": 1.5, "inertia": [0.1, 0.2, 0.25], "position": [x, 0.0, 0.0],
               "motion": {"velocity": [0.0, x * spin, 0.0], "spin": [0.0, 0.0, spin]},
               "markers": {"c": [0.0, 0.0, 0.0], "in": [-0.4, 0.0, 0.0], "out": [0.4, 0.0, 0.0]}})
    };
    let scene = json!({
        "name": "spun_off", "dimension": 3,
        "bodies": [body("a", 0.4), body("b", r)],
        "joints": [{"name": "hub", "kind": "revolute", "markers": ["ground", "a.in"], "direction": [0.0, 0.0, 1.0]},
                   {"name": "knee", "kind": "weld", "markers": ["a.out", "b.in"], "release_time": due}],
        "outputs": [{"kind": "position", "marker": "b.c"}, {"kind": "angular_velocity", "marker": "b.c"},
                    {"kind": "angular_velocity", "marker": "a.c"}],
        "accuracy": {"relative_tolerance": 1e-10}});
    let at = |t: f64| turned(spin * t, [r, 0.0]);
    let way = times(spin, turned(0.5 * std::f64::consts::PI, at(due)));
    Specimen::new("spun_off", scene)
        .at(0.3)
        .vector_within("b.c.position", "m", at(0.3), 1e-8)
        .at(1.0)
        .vector_within(
            "b.c.position",
            "m",
            sum(at(due), times(1.0 - due, way)),
            1e-8,
        )
        .claim_within("b.c.angular_velocity[3]", "rad/s", spin, 1e-8)
        .claim_within("a.c.angular_velocity[3]", "rad/s", spin, 1e-8)
}

/// A joint of a kind on the ground at the centre of mass of a body at a place, with more keys.
fn on_ground(name: &str, kind: &str, keys: &Value) -> Value {
    let marker = format!("{name}_body.c");
    let mut joint = json!({"name": name, "kind": kind, "markers": ["ground", marker]});
    for (key, value) in keys.as_object().into_iter().flatten() {
        joint[key] = value.clone();
    }
    joint
}

/// Joints of all kinds in the plane: some let go at once, and what they would hold falls and rotates; others hold.
fn all_go() -> Specimen {
    let (g, moment, mass, inertia) = (9.81, 0.7, 1.4, 0.3);
    let kinds = [
        ("weld", json!({})),
        ("point_on_line", json!({"direction": [1.0, 0.0]})),
        ("prismatic", json!({"direction": [1.0, 0.0]})),
        ("orientation", json!({})),
        ("distance", json!({})),
        (
            "point_on_cable",
            json!({"markers": ["rope", "point_on_cable_body.c"]}),
        ),
    ];
    let mut bodies = vec![
        json!({"element": "cable", "name": "rope", "elements": 2, "material": {"youngs_modulus": 1e7, "density": 1000.0},
               "section": {"area": 1e-3, "second_moment": 1e-7},
               "shape": {"line": {"from": [9.5, 0.0], "to": [10.5, 0.0]}}, "markers": {"left": 0.0, "right": 1.0}}),
    ];
    let fix = |name: &str, marker: &str| json!({"name": name, "kind": "weld", "markers": ["ground", marker]});
    let mut joints = vec![fix("left", "rope.left"), fix("right", "rope.right")];
    let (mut loads, mut outputs) = (Vec::new(), Vec::new());
    let mut put = |name: &str, kind: &str, keys: &Value, place: [f64; 2]| {
        let (body, marker) = (format!("{name}_body"), format!("{name}_body.c"));
        bodies.push(json!({"element": "rigid", "name": body, "mass": mass, "inertia": inertia, "position": place,
                           "motion": {"velocity": [0.0, 0.0]}, "markers": {"c": [0.0, 0.0]}}));
        joints.push(on_ground(name, kind, keys));
        loads.push(json!({"name": format!("{name}_moment"), "kind": "moment", "marker": marker, "value": moment}));
        for output in ["acceleration", "angular_acceleration", "position", "angle"] {
            outputs.push(json!({"kind": output, "marker": marker}));
        }
    };
    for (k, (kind, keys)) in kinds.iter().enumerate() {
        let mut at_once = keys.clone();
        at_once["release_time"] = json!(0.0);
        if *kind == "distance" {
            at_once["point"] = json!([2.0 * k as f64, 1.0]);
        }
        put(kind, kind, &at_once, [2.0 * k as f64, 0.0]);
        if *kind != "point_on_cable" {
            let mut keys = keys.clone();
            if *kind == "distance" {
                keys["point"] = json!([2.0 * k as f64, 5.0]);
            }
            put(&format!("{kind}_stays"), kind, &keys, [2.0 * k as f64, 4.0]);
        }
    }
    let scene = json!({"name": "all_go", "dimension": 2, "gravity": [0.0, -g], "bodies": bodies, "joints": joints,
                       "loads": loads, "outputs": outputs});
    let mut specimen = Specimen::new("all_go", scene);
    for (kind, _) in &kinds {
        let of = format!("{kind}_body.c");
        specimen = specimen
            .vector(&format!("{of}.acceleration"), "m/s2", [0.0, -g])
            .claim(
                &format!("{of}.angular_acceleration"),
                "rad/s2",
                moment / inertia,
            );
    }
    specimen = specimen.at(0.5);
    for (kind, _) in kinds.iter().filter(|(kind, _)| *kind != "point_on_cable") {
        let of = format!("{kind}_stays_body.c");
        specimen = match *kind {
            "orientation" => specimen.claim_within(&format!("{of}.angle"), "rad", 0.0, 1e-8),
            _ => specimen.claim_within(&format!("{of}.position[2]"), "m", 4.0, 1e-8),
        };
    }
    specimen
}

/// The same of joints of space.
fn all_go_in_space() -> Specimen {
    let (g, moment, inertia) = (9.81, [0.6, -0.4, 0.5], [0.3, 0.4, 0.5]);
    let kinds = [
        ("spherical", json!({})),
        (
            "universal",
            json!({"direction": [1.0, 0.0, 0.0], "second_direction": [0.0, 1.0, 0.0]}),
        ),
        ("constant_velocity", json!({"direction": [1.0, 0.0, 0.0]})),
        ("cylindrical", json!({"direction": [1.0, 0.0, 0.0]})),
        ("screw", json!({"direction": [1.0, 0.0, 0.0], "pitch": 0.2})),
        ("planar", json!({"direction": [0.0, 0.0, 1.0]})),
        ("generic", json!({"free": ["x"]})),
    ];
    let (mut bodies, mut joints, mut outputs, mut loads) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut put = |name: &str, kind: &str, keys: &Value, place: [f64; 3]| {
        let (body, marker) = (format!("{name}_body"), format!("{name}_body.c"));
        bodies.push(json!({"element": "rigid", "name": body, "mass": 1.4, "inertia": inertia, "position": place,
                           "motion": {"velocity": [0.0, 0.0, 0.0]}, "markers": {"c": [0.0, 0.0, 0.0]}}));
        joints.push(on_ground(name, kind, keys));
        for output in ["acceleration", "angular_acceleration", "position"] {
            outputs.push(json!({"kind": output, "marker": marker}));
        }
        marker
    };
    for (k, (kind, keys)) in kinds.iter().enumerate() {
        let x = 2.0 * k as f64;
        let mut at_once = keys.clone();
        at_once["release_time"] = json!(0.0);
        let marker = put(kind, kind, &at_once, [x, 0.0, 0.0]);
        loads.push(json!({"name": format!("{kind}_moment"), "kind": "moment", "marker": marker, "value": moment}));
        put(&format!("{kind}_stays"), kind, keys, [x, 4.0, 0.0]);
    }
    let scene = json!({"name": "all_go_in_space", "dimension": 3, "gravity": [0.0, 0.0, -g], "bodies": bodies,
                       "joints": joints, "loads": loads, "outputs": outputs});
    let mut specimen = Specimen::new("all_go_in_space", scene);
    for (kind, _) in &kinds {
        let of = format!("{kind}_body.c");
        for (axis, free) in [0.0, 0.0, -g].into_iter().enumerate() {
            let (turn, k) = (moment[axis] / inertia[axis], axis + 1);
            specimen = specimen
                .claim(&format!("{of}.acceleration[{k}]"), "m/s2", free)
                .claim(&format!("{of}.angular_acceleration[{k}]"), "rad/s2", turn);
        }
    }
    specimen = specimen.at(0.5);
    for (kind, _) in &kinds {
        let of = format!("{kind}_stays_body.c.position[3]");
        specimen = specimen.claim_within(&of, "m", 0.0, 1e-8);
    }
    specimen
}
