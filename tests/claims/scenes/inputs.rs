//! Loads that the master sets: by their start values, by what is set before the start, and later.

use serde_json::{Value, json};

use super::{cross, extra, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![started(), unset(), set_later(), rest_lengths()]
}

fn body(name: &str, place: [f64; 2], angle: f64) -> Value {
    json!({"element": "rigid", "name": name, "mass": 1.6, "inertia": 0.4, "position": place, "angle": angle,
           "markers": {"c": [0.0, 0.0], "p": [0.5, -0.2]}})
}

fn rod(name: &str, y: f64) -> Value {
    json!({"element": "cable", "name": name, "elements": 2,
           "material": {"youngs_modulus": 1e6, "density": 1250.0},
           "section": {"area": 2e-3, "second_moment": 1e-7},
           "shape": {"line": {"from": [0.0, y], "to": [0.6, y + 0.8]}}, "markers": {"p": 0.3}})
}

/// A scene of all that inputs act on, each with a twin that none acts on.
fn scene(name: &str, starts: [Value; 5]) -> Value {
    let [dead, follower, moment, torque, line] = starts;
    let with = |mut input: Value, start: Value| {
        if !start.is_null() {
            input["start"] = start;
        }
        input
    };
    let accelerations = ["a.c", "b.c", "r.p"].map(|m| json!({"kind": "acceleration", "marker": m}));
    let turns = ["a.c", "b.c", "m.c", "u.c", "v.c"]
        .map(|m| json!({"kind": "angular_acceleration", "marker": m}));
    json!({
        "name": name, "dimension": 2,
        "bodies": [body("a", [0.0, 0.0], 0.5), body("b", [2.0, 0.0], 0.5), body("m", [4.0, 0.0], 0.1),
                   body("u", [0.0, 3.0], 0.1), body("v", [0.0, 3.0], 0.6), body("w", [0.0, 5.0], 0.1),
                   body("x", [0.0, 5.0], 0.3), rod("r", 6.0), rod("s", 8.0), extra()],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["u.c", "v.c"]},
                   {"name": "twin", "kind": "revolute", "markers": ["w.c", "x.c"]}],
        "inputs": [with(json!({"kind": "force", "marker": "a.p"}), dead),
                   with(json!({"kind": "force", "marker": "b.p", "follower": true}), follower),
                   with(json!({"kind": "moment", "marker": "m.c"}), moment),
                   with(json!({"kind": "torque", "joint": "pin"}), torque),
                   with(json!({"kind": "distributed_force", "body": "r"}), line)],
        "outputs": accelerations.into_iter().chain(turns).collect::<Vec<_>>()})
}

const DEAD: [f64; 2] = [1.3, -0.7];
const FOLLOWER: [f64; 2] = [0.9, 1.1];
const MOMENT: f64 = 0.8;
const TORQUE: f64 = -0.6;
const LINE: [f64; 2] = [2.1, -1.7];

fn claimed(specimen: Specimen) -> Specimen {
    let arm = [0.5, -0.2];
    specimen
        .vector("a.c.acceleration", "m/s2", times(1.0 / 1.6, DEAD))
        .claim(
            "a.c.angular_acceleration",
            "rad/s2",
            cross(turned(0.5, arm), DEAD) / 0.4,
        )
        .vector(
            "b.c.acceleration",
            "m/s2",
            times(1.0 / 1.6, turned(0.5, FOLLOWER)),
        )
        .claim(
            "b.c.angular_acceleration",
            "rad/s2",
            cross(arm, FOLLOWER) / 0.4,
        )
        .claim("m.c.angular_acceleration", "rad/s2", MOMENT / 0.4)
        .claim("u.c.angular_acceleration", "rad/s2", -TORQUE / 0.4)
        .claim("v.c.angular_acceleration", "rad/s2", TORQUE / 0.4)
        .vector("r.p.acceleration", "m/s2", times(1.0 / 2.5, LINE))
}

fn started() -> Specimen {
    let starts = [
        json!(DEAD),
        json!(FOLLOWER),
        json!([MOMENT]),
        json!([TORQUE]),
        json!(LINE),
    ];
    claimed(Specimen::new(
        "inputs_started",
        scene("inputs_started", starts),
    ))
}

/// Before the master sets one, nothing acts.
fn unset() -> Specimen {
    let scene = scene("inputs_unset", [const { Value::Null }; 5]);
    let mut specimen = Specimen::new("inputs_unset", scene);
    for of in ["a.c", "b.c", "r.p"] {
        specimen = specimen.vector(&format!("{of}.acceleration"), "m/s2", [0.0, 0.0]);
    }
    for of in ["a.c", "b.c", "m.c", "u.c", "v.c"] {
        specimen = specimen.claim(&format!("{of}.angular_acceleration"), "rad/s2", 0.0);
    }
    specimen
}

/// The master sets all of them before the start.
fn set_later() -> Specimen {
    let specimen = Specimen::new(
        "inputs_set",
        scene("inputs_set", [const { Value::Null }; 5]),
    )
    .set("a.p.force[1]", DEAD[0])
    .set("a.p.force[2]", DEAD[1])
    .set("b.p.follower_force[1]", FOLLOWER[0])
    .set("b.p.follower_force[2]", FOLLOWER[1])
    .set("m.c.moment", MOMENT)
    .set("pin.torque", TORQUE)
    .set("r.distributed_force[1]", LINE[0])
    .set("r.distributed_force[2]", LINE[1]);
    claimed(specimen)
}

/// Lengths at rest: with a start value, with that of the spring, with the distance at the start.
fn rest_lengths() -> Specimen {
    let spring = |name: &str, x: f64, length: Value| {
        let mut spring = json!({"name": name, "kind": "spring_damper", "markers": ["ground", format!("{name}_end.c")],
                                "point": [x, 0.0], "stiffness": 30.0});
        if !length.is_null() {
            spring["length"] = length;
        }
        spring
    };
    let bodies: Vec<Value> = [("a", 0.0), ("b", 1.0), ("d", 2.0), ("e", 3.0)]
        .map(|(name, x)| body(&format!("{name}_end"), [x + 0.6, 0.8], 0.0))
        .to_vec();
    let outputs: Vec<Value> = ["a", "b", "d", "e"]
        .map(|name| json!({"kind": "acceleration", "marker": format!("{name}_end.c")}))
        .to_vec();
    let scene = json!({
        "name": "rest_lengths", "dimension": 2, "bodies": bodies,
        "loads": [spring("a", 0.0, json!(0.9)), spring("b", 1.0, json!(0.9)), spring("d", 2.0, Value::Null),
                  spring("e", 3.0, json!(0.9))],
        "inputs": [{"kind": "rest_length", "load": "a", "start": [0.7]}, {"kind": "rest_length", "load": "b"},
                   {"kind": "rest_length", "load": "d"}],
        "outputs": outputs});
    let pull = |rest: f64| times(-30.0 * (1.0 - rest) / 1.6, [0.6, 0.8]);
    Specimen::new("rest_lengths", scene)
        .vector("a_end.c.acceleration", "m/s2", pull(0.7))
        .vector("b_end.c.acceleration", "m/s2", pull(0.9))
        .vector("d_end.c.acceleration", "m/s2", pull(1.0))
        .vector("e_end.c.acceleration", "m/s2", pull(0.9))
        .claim("a.rest_length", "m", 0.7)
        .claim("b.rest_length", "m", 0.9)
        .claim("d.rest_length", "m", 1.0)
}
