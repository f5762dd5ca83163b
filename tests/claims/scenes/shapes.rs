//! Rigid bodies of a shape and a density: mass and inertia follow.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::space::{array, vector};
use super::space_bodies::{ARM, Body};
use super::{cross, sum, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![in_space(), in_the_plane()]
}

/// Mass and inertia of a cylinder, from `int r^2 dV` about its axis and `int (x^2 + z^2) dV` across.
fn cylinder(density: f64, radius: f64, length: f64, axis: Vector3<f64>) -> (f64, Matrix3<f64>) {
    let along = 0.5 * PI * density * radius.powi(4) * length;
    let slices = PI * density * radius * radius * length.powi(3) / 12.0;
    let n = axis.normalize();
    let across = Matrix3::identity() - n * n.transpose();
    let inertia = n * n.transpose() * along + across * (0.5 * along + slices);
    (PI * density * radius * radius * length, inertia)
}

/// Name, shape, density, mass and inertia; a tube is a cylinder less another one.
fn shapes() -> Vec<(&'static str, Value, f64, f64, Matrix3<f64>)> {
    let [a, b, c] = [0.4, 0.7, 1.1];
    let box_mass = 13.0 * a * b * c;
    let squares = Vector3::new(b * b + c * c, c * c + a * a, a * a + b * b);
    let way = Vector3::new(1.0, 2.0, -2.0);
    let leaning = cylinder(31.0, 0.3, 0.9, way);
    let upright = cylinder(23.0, 0.35, 0.6, Vector3::z());
    let across = Vector3::new(-2.0, 0.5, 1.0);
    let (outer, inner) = (
        cylinder(47.0, 0.4, 0.8, across),
        cylinder(47.0, 0.25, 0.8, across),
    );
    let (pipe, hole) = (
        cylinder(29.0, 0.5, 0.3, Vector3::z()),
        cylinder(29.0, 0.4, 0.3, Vector3::z()),
    );
    let ball = 4.0 / 3.0 * PI * 17.0 * 0.3_f64.powi(3);
    vec![
        (
            "block",
            json!({"box": {"size": [a, b, c]}}),
            13.0,
            box_mass,
            Matrix3::from_diagonal(&(squares * (box_mass / 12.0))),
        ),
        (
            "roller",
            json!({"cylinder": {"radius": 0.3, "length": 0.9, "axis": array(way)}}),
            31.0,
            leaning.0,
            leaning.1,
        ),
        (
            "drum",
            json!({"cylinder": {"radius": 0.35, "length": 0.6}}),
            23.0,
            upright.0,
            upright.1,
        ),
        (
            "ball",
            json!({"sphere": {"radius": 0.3}}),
            17.0,
            ball,
            Matrix3::identity() * (0.4 * ball * 0.09),
        ),
        (
            "tube",
            json!({"tube": {"radius": 0.4, "inner_radius": 0.25, "length": 0.8, "axis": array(across)}}),
            47.0,
            outer.0 - inner.0,
            outer.1 - inner.1,
        ),
        (
            "pipe",
            json!({"tube": {"radius": 0.5, "inner_radius": 0.4, "length": 0.3}}),
            29.0,
            pipe.0 - hole.0,
            pipe.1 - hole.1,
        ),
    ]
}

/// A body of a shape in place of its mass and inertia.
fn shaped(mut body: Value, shape: Value, density: f64) -> Value {
    let keys = body.as_object_mut().expect("keys");
    keys.remove("mass");
    keys.remove("inertia");
    keys.insert("shape".into(), shape);
    keys.insert("density".into(), json!(density));
    body
}

/// Bodies that rotate, pushed off their centres: `m a = F`, `J w' + w x J w = r x F`. The density of one is a parameter that is set.
fn in_space() -> Specimen {
    let push = Vector3::new(1.4, -0.8, 2.1);
    let (mut bodies, mut loads, mut read, mut claims) = (vec![], vec![], vec![], vec![]);
    let mut momentum = Vector3::zeros();
    for (n, (name, shape, density, mass, inertia)) in shapes().into_iter().enumerate() {
        let mut body = Body::new(name, [0.0; 3]);
        (body.mass, body.inertia) = (mass, inertia);
        body.place = Vector3::new(2.0 * n as f64, 0.3, -0.4);
        body.velocity = Vector3::new(0.3, -0.5, 0.2);
        body.spin = Vector3::new(0.9, 0.4, -0.7);
        let is_set = if name == "drum" { 0.5 } else { 1.0 };
        bodies.push(shaped(body.described(Value::Null), shape, density * is_set));
        let marker = format!("{name}.p");
        loads.push(json!({"name": format!("on_{name}"), "kind": "force", "marker": marker, "value": array(push)}));
        for kind in ["acceleration", "angular_acceleration"] {
            read.push(json!({"kind": kind, "marker": marker}));
        }
        let arm = body.axes * ARM;
        let turning = body.turning(arm.cross(&push));
        let at = push / mass + body.carried(turning, arm);
        claims.push((format!("{marker}.acceleration"), "m/s2", at));
        claims.push((format!("{marker}.angular_acceleration"), "rad/s2", turning));
        momentum += body.velocity * mass;
    }
    read.push(json!({"kind": "momentum"}));
    let scene = json!({"name": "shaped", "dimension": 3, "bodies": bodies, "loads": loads, "outputs": read});
    let specimen = Specimen::new("shaped in space", scene).set("drum.density", 23.0);
    let specimen = vector(specimen, "momentum", "N.s", momentum);
    (claims.into_iter()).fold(specimen, |specimen, (of, unit, value)| {
        vector(specimen, &of, unit, value)
    })
}

/// In the plane what counts is the moment about the third axis.
fn in_the_plane() -> Specimen {
    let (push, arm, angle) = ([1.4, -0.8], [0.3, -0.2], 0.4);
    let (mut bodies, mut loads, mut read, mut claims) = (vec![], vec![], vec![], vec![]);
    for (n, (name, shape, density, mass, inertia)) in shapes().into_iter().enumerate() {
        let body = json!({"element": "rigid", "name": name, "position": [2.0 * n as f64, 0.3], "angle": angle,
                          "markers": {"p": arm}});
        let is_set = if name == "ball" { 0.5 } else { 1.0 };
        bodies.push(shaped(body, shape, density * is_set));
        let marker = format!("{name}.p");
        loads.push(
            json!({"name": format!("on_{name}"), "kind": "force", "marker": marker, "value": push}),
        );
        read.push(json!({"kind": "acceleration", "marker": marker}));
        let way = turned(angle, arm);
        let turning = cross(way, push) / inertia[(2, 2)];
        let at = sum(times(1.0 / mass, push), times(turning, [-way[1], way[0]]));
        claims.push((format!("{marker}.acceleration"), at));
    }
    let scene = json!({"name": "shaped", "dimension": 2, "bodies": bodies, "loads": loads, "outputs": read});
    let specimen = Specimen::new("shaped in the plane", scene).set("ball.density", 17.0);
    (claims.into_iter()).fold(specimen, |specimen, (of, value)| {
        specimen.vector(&of, "m/s2", value)
    })
}
