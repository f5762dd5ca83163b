//! Orientations that are driven in space: by a port, by a motion that the master sets, by functions of time.

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::space::{array, vector};
use super::space_bodies::{Body, rotation};
use super::space_ports::{moving, quaternion, set};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![by_port(), by_master(), by_time(), by_table()]
}

const GRAVITY: Vector3<f64> = Vector3::new(0.2, 0.5, -9.0);
/// What is given: a point, its velocity and acceleration, how the body stands, how it rotates and rotates faster.
const POINT: Vector3<f64> = Vector3::new(0.9, -0.2, 0.4);
const SPEED: Vector3<f64> = Vector3::new(-0.4, 0.8, 0.3);
const PUSH: Vector3<f64> = Vector3::new(1.5, -0.7, 2.1);
const STAND: Vector3<f64> = Vector3::new(-1.2, 0.7, 0.9);
const SPIN: Vector3<f64> = Vector3::new(0.3, 0.6, -0.5);
const TURNING: Vector3<f64> = Vector3::new(-0.8, 1.3, 0.4);

/// A body that stands and rotates as is given.
fn given(name: &'static str) -> Body {
    let mut body = moving(name);
    body.axes = rotation(STAND);
    body.spin = SPIN;
    body
}

/// Moment about the centre that the body takes to rotate so, N m.
fn needed(body: &Body, turning: Vector3<f64>) -> Vector3<f64> {
    body.tensor() * turning + body.gyroscopic()
}

/// Sets how a body is to stand, by a quaternion of some length and the other sign, and how it is to rotate.
fn stand(specimen: Specimen, of: &str, derivatives: usize) -> Specimen {
    let mut specimen = set(
        specimen,
        &format!("{of}.quaternion"),
        &quaternion(STAND).map(|part| -0.8 * part),
    );
    let rates = [
        ("angular_velocity", SPIN),
        ("angular_acceleration", TURNING),
    ];
    for (key, value) in rates.iter().take(derivatives) {
        specimen = set(specimen, &format!("{of}.{key}"), value.as_slice());
    }
    specimen
}

fn claims(mut specimen: Specimen, claims: &[(&str, &'static str, Vector3<f64>)]) -> Specimen {
    for (of, unit, value) in claims {
        specimen = vector(specimen, of, unit, *value);
    }
    specimen
}

/// Point and orientation come in at a marker beside the centre of mass; force and moment go out.
fn by_port() -> Specimen {
    let scene = json!({
        "name": "driven_port", "dimension": 3, "gravity": array(GRAVITY),
        "bodies": [moving("a").described(Value::Null)],
        "ports": [{"name": "flange", "marker": "a.p", "kind": "motion", "rotation": true}],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "angular_acceleration", "marker": "a.c"},
                    {"kind": "angular_velocity", "marker": "a.c"}, {"kind": "position", "marker": "a.c"}]});
    let mut specimen = Specimen::new("driven_port in space", scene);
    for (key, value) in [
        ("position", POINT),
        ("velocity", SPEED),
        ("acceleration", PUSH),
    ] {
        specimen = set(specimen, &format!("flange.{key}"), value.as_slice());
    }
    let body = given("a");
    let center = PUSH + body.carried(TURNING, -body.arm());
    let force = (center - GRAVITY) * body.mass;
    let moment = needed(&body, TURNING) - body.arm().cross(&force);
    claims(
        stand(specimen, "flange", 2),
        &[
            ("flange.force", "N", -force),
            ("flange.moment", "N.m", -moment),
            ("a.c.acceleration", "m/s2", center),
            ("a.c.angular_acceleration", "rad/s2", TURNING),
            ("a.c.angular_velocity", "rad/s", SPIN),
            ("a.c.position", "m", POINT - body.arm()),
        ],
    )
}

/// Motions of orientation with no, one and two derivatives that the master sets; their bodies are free to go.
fn by_master() -> Specimen {
    let names = ["a", "b", "e"];
    let bodies = names.map(|name| moving(name).described(Value::Null));
    let motions = [0, 1, 2].map(|k| {
        json!({"name": format!("turn{k}"), "kind": "orientation", "marker": format!("{}.p", names[k]),
               "value": {"input": k}})
    });
    let read = |kind: &str| names.map(|name| json!({"kind": kind, "marker": format!("{name}.c")}));
    let moment = json!({"kind": "reaction_moment", "motion": "turn2"});
    let read = [read("angular_velocity"), read("orientation")].concat();
    let outputs = [read, vec![moment]].concat();
    let scene = json!({"name": "driven_by_master", "dimension": 3, "bodies": bodies, "motions": motions,
                       "outputs": outputs});
    let mut specimen = Specimen::new("driven_by_master in space", scene);
    for (k, name) in names.iter().enumerate() {
        specimen = stand(specimen, &format!("turn{k}"), k);
        let spin = if k == 0 { Vector3::zeros() } else { SPIN };
        specimen = vector(
            specimen,
            &format!("{name}.c.angular_velocity"),
            "rad/s",
            spin,
        );
        for (i, value) in rotation(STAND).transpose().iter().enumerate() {
            let of = format!("{name}.c.orientation[{}]", i + 1);
            specimen = specimen.claim(&of, "", *value);
        }
    }
    let moment = needed(&given("e"), TURNING);
    claims(specimen, &[("turn2.reaction_moment", "N.m", moment)])
}

/// A quaternion of functions of time: a steady rotation about an axis of space, of growing length.
fn by_time() -> Specimen {
    const RATE: f64 = 1.6;
    let way = Vector3::new(0.6, 0.0, 0.8);
    let [sine, cosine] = ["sin", "cos"].map(|of| format!("(1 + t^2) * {of}({:?} * t)", 0.5 * RATE));
    let value = json!([cosine, format!("0.6 * {sine}"), 0, format!("0.8 * {sine}")]);
    let scene = json!({
        "name": "driven_by_time", "dimension": 3,
        "bodies": [moving("a").described(Value::Null)],
        "motions": [{"name": "turn", "kind": "orientation", "marker": "a.p", "value": value}],
        "outputs": [{"kind": "quaternion", "marker": "a.c"}, {"kind": "reaction_moment", "motion": "turn"}]});
    let mut specimen = Specimen::new("driven_by_time in space", scene);
    for time in [0.0, 1.5] {
        specimen = specimen.at(time);
        let (sin, cos) = (0.5 * RATE * time).sin_cos();
        let q = [cos, 0.6 * sin, 0.0, 0.8 * sin];
        for (k, value) in q.iter().enumerate() {
            let of = format!("a.c.quaternion[{}]", k + 1);
            specimen = specimen.claim_within(&of, "", *value, 1e-10);
        }
        let mut body = moving("a");
        (body.axes, body.spin) = (rotation(way * (RATE * time).max(1e-12)), way * RATE);
        let moment = needed(&body, Vector3::zeros());
        for (k, value) in moment.iter().enumerate() {
            let of = format!("turn.reaction_moment[{}]", k + 1);
            specimen = specimen.claim_within(&of, "N.m", *value, 1e-9);
        }
    }
    specimen
}

/// A quaternion `(1, p, 0, 0)` whose second part is a table: a rotation about the first axis of space by `2 atan(p)`.
fn by_table() -> Specimen {
    let rows = [[0.0, 0.2], [1.0, 0.5], [2.0, 1.2]];
    let table = json!({"table": rows, "interpolation": "linear"});
    let scene = json!({
        "name": "driven_by_table", "dimension": 3,
        "bodies": [moving("a").described(Value::Null)],
        "motions": [{"name": "turn", "kind": "orientation", "marker": "a.c", "value": [1, table, 0, 0]}],
        "outputs": [{"kind": "quaternion", "marker": "a.c"}, {"kind": "angular_velocity", "marker": "a.c"}]});
    let mut specimen = Specimen::new("driven_by_table in space", scene);
    for (time, part, rate) in [(0.0, 0.2, 0.3), (0.5, 0.35, 0.3), (1.5, 0.85, 0.7)] {
        specimen = specimen.at(time);
        let square = 1.0 + part * part;
        let q = [1.0, part, 0.0, 0.0].map(|of| of / f64::sqrt(square));
        for (k, value) in q.iter().enumerate() {
            let of = format!("a.c.quaternion[{}]", k + 1);
            specimen = specimen.claim_within(&of, "", *value, 1e-10);
        }
        let rates = [2.0 * rate / square, 0.0, 0.0];
        for (k, value) in rates.iter().enumerate() {
            let of = format!("a.c.angular_velocity[{}]", k + 1);
            specimen = specimen.claim_within(&of, "rad/s", *value, 1e-9);
        }
    }
    specimen
}
