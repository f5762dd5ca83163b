//! Joints that let go: what they held goes on by itself.

use serde_json::{Value, json};

use super::{extra, sum, times, turned};
use crate::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        flung("flung", json!({"release_time": 0.3}), 0.3, 0.3),
        flung("flung_by_input", json!({}), 0.5, 0.5),
        flung("flung_at_once", json!({}), 0.0, 0.0),
        spun_off(),
        dropped(),
    ]
}

/// A bob that circles steadily without gravity flies along the tangent once it is let go, and goes on turning.
fn flung(name: &'static str, keys: Value, due: f64, told: f64) -> Specimen {
    let (r, spin, mass) = (0.8, 1.7, 2.0);
    let mut joint = json!({"name": "pin", "kind": "revolute", "markers": ["ground", "bob.p"], "point": [0.2, 0.1]});
    let by_input = keys.get("release_time").is_none();
    if let Some(time) = keys.get("release_time") {
        joint["release_time"] = time.clone();
    }
    let start = json!([f64::from(u8::from(due == 0.0))]);
    let inputs = match by_input {
        true => json!([{"kind": "release", "joint": "pin", "start": start}]),
        false => json!([]),
    };
    let scene = json!({
        "name": name, "dimension": 2,
        "bodies": [{"element": "rigid", "name": "bob", "mass": mass, "inertia": 0.3, "position": [1.0, 0.1],
                    "motion": {"velocity": [0.0, r * spin], "spin": spin},
                    "markers": {"c": [0.0, 0.0], "p": [-r, 0.0]}}, extra()],
        "joints": [joint], "inputs": inputs,
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

/// The same in space, about an axis, of the second of two bodies on hinges that turn as one.
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

/// A stiff rod that hangs from a weld falls freely once that has let go.
fn dropped() -> Specimen {
    let (g, due, weight) = (9.81, 0.1, 1000.0 * 1e-4 * 0.5 * 9.81);
    let scene = json!({
        "name": "dropped", "dimension": 3, "gravity": [0.0, 0.0, -g], "initial": "static_equilibrium",
        "bodies": [{"element": "rod", "name": "rod", "elements": 2,
                    "material": {"youngs_modulus": 1e11, "shear_modulus": 4e10, "density": 1000.0},
                    "section": {"area": 1e-4, "second_moments": [1e-9, 1e-9], "torsion_constant": 2e-9},
                    "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [0.0, 0.0, -0.5]}},
                    "markers": {"top": 0.0, "end": 1.0}}],
        "joints": [{"name": "grip", "kind": "weld", "markers": ["ground", "rod.top"], "release_time": due}],
        "outputs": [{"kind": "position", "marker": "rod.end"}, {"kind": "reaction", "joint": "grip"}]});
    let fall = 0.5 * g * (0.4_f64 - due).powi(2);
    Specimen::new("dropped", scene)
        .claim_within("grip.reaction[3]", "N", weight, 1e-6)
        .at(0.05)
        .claim_within("rod.end.position[3]", "m", -0.5, 1e-6)
        .at(0.4)
        .claim_within("rod.end.position[3]", "m", -0.5 - fall, 1e-6)
        .claim("grip.reaction[3]", "N", 0.0)
}
