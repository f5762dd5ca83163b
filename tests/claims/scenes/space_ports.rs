//! Ports in space with moments and orientations, orientations as outputs, and outputs along axes of bodies.

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::space::{array, vector};
use super::space_bodies::{Body, rotation};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        by_force(),
        coupled(),
        coupled_without(),
        turned_on(),
        along("global"),
        along("body"),
    ]
}

const GRAVITY: Vector3<f64> = Vector3::new(0.2, 0.5, -9.0);

/// The quaternion of a rotation vector, scalar first: half the angle.
pub fn quaternion(turn: Vector3<f64>) -> [f64; 4] {
    let (sin, cos) = (0.5 * turn.norm()).sin_cos();
    let [x, y, z] = array(turn.normalize() * sin);
    [cos, x, y, z]
}

fn four(mut specimen: Specimen, of: &str, value: [f64; 4]) -> Specimen {
    for (k, value) in value.iter().enumerate() {
        specimen = specimen.claim(&format!("{of}.quaternion[{}]", k + 1), "", *value);
    }
    specimen
}

pub fn set(mut specimen: Specimen, of: &str, values: &[f64]) -> Specimen {
    for (k, value) in values.iter().enumerate() {
        specimen = specimen.set(&format!("{of}[{}]", k + 1), *value);
    }
    specimen
}

/// How a body of [`Body::new`] stands.
const TURN: Vector3<f64> = Vector3::new(0.4, -0.3, 0.6);

pub fn moving(name: &'static str) -> Body {
    let mut body = Body::new(name, [0.5, 0.8, 1.0]);
    body.inertia = Matrix3::new(1.1, 0.2, -0.1, 0.2, 0.9, 0.3, -0.1, 0.3, 1.3);
    body.velocity = Vector3::new(0.3, -0.5, 0.1);
    body.spin = Vector3::new(0.9, 0.4, -0.7);
    body
}

/// A force and a moment come in; how the marker moves and how the body stands and rotates go out.
fn by_force() -> Specimen {
    let (body, other) = (moving("a"), moving("b"));
    let (force, moment) = (Vector3::new(1.2, -2.0, 0.7), Vector3::new(-0.6, 0.9, 1.4));
    let particle = json!({"element": "rigid", "name": "dot", "mass": 0.8, "position": [1.0, 2.0, 3.0],
                          "markers": {"c": [0.0, 0.0, 0.0]}});
    let scene = json!({
        "name": "by_force", "dimension": 3, "gravity": array(GRAVITY),
        "bodies": [body.described(Value::Null), other.described(Value::Null), particle],
        "ports": [{"name": "flange", "marker": "a.p", "kind": "force", "rotation": true},
                  {"name": "hook", "marker": "b.p", "kind": "force"},
                  {"name": "pull", "marker": "dot.c", "kind": "force"}]});
    let arm = body.arm();
    let mut specimen = Specimen::new("by_force in space", scene).fact("variables", 64);
    for (port, has_moment) in [("flange", true), ("hook", false)] {
        let moment = if has_moment { moment } else { Vector3::zeros() };
        let turning = body.turning(arm.cross(&force) + moment);
        let a = GRAVITY + force / body.mass + body.carried(turning, arm);
        specimen = set(specimen, &format!("{port}.force"), force.as_slice());
        for (of, unit, value) in [
            ("position", "m", body.place + arm),
            ("velocity", "m/s", body.velocity + body.spin.cross(&arm)),
            ("acceleration", "m/s2", a),
            ("force", "N", force),
        ] {
            specimen = vector(specimen, &format!("{port}.{of}"), unit, value);
        }
        if has_moment {
            specimen = set(specimen, "flange.moment", moment.as_slice());
            specimen = four(specimen, "flange", quaternion(TURN));
            for (of, unit, value) in [
                ("angular_velocity", "rad/s", body.spin),
                ("angular_acceleration", "rad/s2", turning),
                ("moment", "N.m", moment),
            ] {
                specimen = vector(specimen, &format!("flange.{of}"), unit, value);
            }
        }
    }
    specimen = set(specimen, "pull.force", force.as_slice());
    vector(specimen, "pull.acceleration", "m/s2", GRAVITY + force / 0.8)
}

/// What comes into a coupling: a point, its velocity, and how it is rotated against the body, and rotates.
const POINT: Vector3<f64> = Vector3::new(0.9, -0.2, 0.4);
const SPEED: Vector3<f64> = Vector3::new(-0.4, 0.8, 0.3);
const AWAY: Vector3<f64> = Vector3::new(-0.7, 0.5, 1.1);
const SPIN: Vector3<f64> = Vector3::new(0.3, 0.6, -0.5);

/// The quaternion of the rotation `a` after the rotation `b` (Rodrigues' formula for two turns).
fn after(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    let [v, w] = [a, b].map(|of| Vector3::new(of[1], of[2], of[3]));
    let [x, y, z] = array(w * a[0] + v * b[0] + v.cross(&w));
    [a[0] * b[0] - v.dot(&w), x, y, z]
}

/// Sets a port to a point and, if it rotates, to an orientation from which [`AWAY`] leads to the body.
fn towards(specimen: Specimen, port: &str, turns: bool) -> Specimen {
    let specimen = set(specimen, &format!("{port}.position"), POINT.as_slice());
    let specimen = set(specimen, &format!("{port}.velocity"), SPEED.as_slice());
    if !turns {
        return specimen;
    }
    let stands = after(quaternion(-AWAY), quaternion(TURN)).map(|part| -0.8 * part);
    let specimen = set(specimen, &format!("{port}.quaternion"), &stands);
    set(
        specimen,
        &format!("{port}.angular_velocity"),
        SPIN.as_slice(),
    )
}

/// Six springs and dampers to what comes in.
fn coupled() -> Specimen {
    let (k, d, kr, dr) = (20.0, 1.5, 4.0, 0.3);
    let body = moving("a");
    let scene = json!({
        "name": "coupled", "dimension": 3, "gravity": array(GRAVITY),
        "bodies": [body.described(Value::Null)],
        "ports": [{"name": "flange", "marker": "a.p", "kind": "motion", "stiffness": k, "damping": d,
                   "rotational_stiffness": kr, "rotational_damping": dr}],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "angular_acceleration", "marker": "a.c"},
                    {"kind": "energy"}]});
    let arm = body.arm();
    let stretch = body.place + arm - POINT;
    let force = stretch * k + (body.velocity + body.spin.cross(&arm) - SPEED) * d;
    let moment = AWAY * kr + (body.spin - SPIN) * dr;
    let specimen = towards(Specimen::new("coupled in space", scene), "flange", true)
        .fact("variables", 43)
        .claim(
            "energy.spring",
            "J",
            0.5 * k * stretch.norm_squared() + 0.5 * kr * AWAY.norm_squared(),
        );
    let turning = body.turning(-arm.cross(&force) - moment);
    let claims = [
        ("flange.force", "N", force),
        ("flange.moment", "N.m", moment),
        ("a.c.acceleration", "m/s2", GRAVITY - force / body.mass),
        ("a.c.angular_acceleration", "rad/s2", turning),
        ("flange.position", "m", POINT),
        ("flange.velocity", "m/s", SPEED),
        ("flange.angular_velocity", "rad/s", SPIN),
    ];
    let claim = |sum, (of, unit, value): (&str, _, _)| vector(sum, of, unit, value);
    claims.into_iter().fold(specimen, claim)
}

/// The same without one or the other.
fn coupled_without() -> Specimen {
    let (k, d, kr, dr) = (20.0, 1.5, 4.0, 0.3);
    let bodies = ["a", "b", "e"].map(moving);
    let port = |name: &str, of: &str, mut keys: Value| {
        keys["name"] = json!(name);
        keys["marker"] = json!(of);
        keys["kind"] = json!("motion");
        keys
    };
    let outputs = ["a.c", "b.c", "e.c"].map(|of| {
        ["acceleration", "angular_acceleration"].map(|kind| json!({"kind": kind, "marker": of}))
    });
    let scene = json!({
        "name": "coupled_without", "dimension": 3,
        "bodies": bodies.each_ref().map(|body| body.described(Value::Null)),
        "ports": [port("soft", "a.c", json!({"damping": d, "rotational_damping": dr})),
                  port("undamped", "b.c", json!({"stiffness": k, "rotational_stiffness": kr})),
                  port("straight", "e.c", json!({"stiffness": k, "damping": d}))],
        "outputs": outputs.concat()});
    let body = &bodies[0];
    let (stretch, rate) = (body.place - POINT, body.velocity - SPEED);
    let mut specimen = Specimen::new("coupled_without in space", scene).fact("variables", 93);
    for (port, of, turns, force, moment) in [
        ("soft", "a", true, rate * d, (body.spin - SPIN) * dr),
        ("undamped", "b", true, stretch * k, AWAY * kr),
        (
            "straight",
            "e",
            false,
            stretch * k + rate * d,
            Vector3::zeros(),
        ),
    ] {
        specimen = towards(specimen, port, turns);
        let turning = body.turning(-moment);
        specimen = vector(
            specimen,
            &format!("{of}.c.acceleration"),
            "m/s2",
            -force / body.mass,
        );
        specimen = vector(
            specimen,
            &format!("{of}.c.angular_acceleration"),
            "rad/s2",
            turning,
        );
    }
    specimen
}

/// A body that rotates about an axis of its inertia, beyond a full turn: its quaternion goes on, its rotation vector is the short
/// way.
fn turned_on() -> Specimen {
    let mut body = Body::new("a", [0.5, 0.8, 1.0]);
    // About the second axis of the frame.
    const RATE: f64 = 4.0;
    body.spin = body.axes.column(1) * RATE;
    let kinds = ["quaternion", "rotation_vector", "orientation"];
    let outputs = kinds.map(|kind| json!({"kind": kind, "marker": "a.p"}));
    let mut other = moving("b");
    other.axes = rotation(Vector3::new(-0.5, 0.9, 0.2));
    let bodies = [&body, &other].map(|body| body.described(Value::Null));
    let scene = json!({"name": "turned_on", "dimension": 3, "bodies": bodies,
                       "outputs": outputs, "accuracy": {"relative_tolerance": 1e-8}});
    let mut specimen = Specimen::new("turned_on", scene).fact("variables", 30);
    for time in [0.0, 0.9, 2.0] {
        // Eight radians are more than a revolution: the sign has changed.
        let (sin, cos) = (0.5 * RATE * time).sin_cos();
        let q = after(quaternion(TURN), [cos, 0.0, sin, 0.0]);
        specimen = specimen.at(time);
        for (k, value) in q.iter().enumerate() {
            let name = format!("a.p.quaternion[{}]", k + 1);
            specimen = specimen.claim_within(&name, "", *value, 1e-6);
        }
        let (sign, part) = (q[0].signum(), Vector3::new(q[1], q[2], q[3]));
        let angle = 2.0 * part.norm().atan2(q[0].abs());
        let turn = part.normalize() * (sign * angle);
        for (k, value) in turn.iter().enumerate() {
            let name = format!("a.p.rotation_vector[{}]", k + 1);
            specimen = specimen.claim_within(&name, "rad", *value, 1e-6);
        }
    }
    specimen
}

/// Two bodies welded together under a moment and a force on the second; angular velocities and what the weld transmits along
/// the axes of the first.
fn along(axes: &'static str) -> Specimen {
    let (first, mut second) = (
        Body::new("a", [0.5, 0.8, 1.0]),
        Body::new("b", [0.9, 0.7, 0.4]),
    );
    second.axes = rotation(Vector3::new(-0.5, 0.9, 0.2));
    second.place = first.place + first.arm() - second.arm();
    let (force, moment) = (Vector3::new(1.2, -2.0, 0.7), Vector3::new(-0.6, 0.9, 1.4));
    let spinning = moving("c");
    let mut kept = Body::new("d", [0.6, 0.8, 0.9]);
    kept.place = Vector3::new(5.0, 0.0, 0.0);
    let outputs = [
        ("reaction", "joint", "weld"),
        ("reaction_moment", "joint", "weld"),
        ("reaction", "joint", "wall"),
        ("angular_velocity", "marker", "c.p"),
        ("angular_acceleration", "marker", "c.p"),
    ];
    let outputs = outputs.map(|(kind, key, of)| json!({"kind": kind, key: of, "axes": axes}));
    let load = |name: &str, kind: &str, of: &str, value: Vector3<f64>| json!({"name": name, "kind": kind, "marker": of, "value": array(value)});
    let bodies = [&first, &second, &spinning, &kept].map(|body| body.described(Value::Null));
    let scene = json!({"name": "along", "dimension": 3, "gravity": array(GRAVITY), "bodies": bodies,
                       "joints": [{"name": "weld", "kind": "weld", "markers": ["a.p", "b.p"]},
                                  {"name": "wall", "kind": "weld", "markers": ["ground", "d.c"]}],
                       "loads": [load("push", "force", "b.c", force), load("turn", "moment", "b.c", moment)],
                       "outputs": outputs});
    // The whole about its centre of mass, at rest.
    let mass = first.mass + second.mass;
    let center = (first.place * first.mass + second.place * second.mass) / mass;
    let parts = [&first, &second].map(|body| {
        let way = body.place - center;
        let away = Matrix3::identity() * way.norm_squared() - way * way.transpose();
        body.tensor() + away * body.mass
    });
    let tensor = parts[0] + parts[1];
    let turned = moment + (second.place - center).cross(&force);
    let turning = tensor.try_inverse().expect("inertia") * turned;
    let a = GRAVITY + force / mass + turning.cross(&(second.place - center));
    // What the second body takes beside its loads, at its marker.
    let reaction = (a - GRAVITY) * second.mass - force;
    let at = second.arm();
    let twist = second.tensor() * turning - moment - at.cross(&reaction);
    let mut specimen = Specimen::new(axes, scene);
    let turns = spinning.turning(Vector3::zeros());
    let held = -GRAVITY * kept.mass;
    for (of, unit, along, value) in [
        ("weld.reaction", "N", first.axes, reaction),
        ("weld.reaction_moment", "N.m", first.axes, twist),
        ("wall.reaction", "N", Matrix3::identity(), held),
        (
            "c.p.angular_velocity",
            "rad/s",
            spinning.axes,
            spinning.spin,
        ),
        ("c.p.angular_acceleration", "rad/s2", spinning.axes, turns),
    ] {
        let (name, value) = match axes {
            "global" => (of.to_owned(), value),
            _ => (format!("{of}_body"), along.transpose() * value),
        };
        specimen = vector(specimen, &name, unit, value);
    }
    specimen
}
