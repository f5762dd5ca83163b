//! Ports: what comes in and what goes out.

use serde_json::{Value, json};

use super::{cross, extra, sum, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![by_force(), by_motion(), coupled(), coupled_without()]
}

const MASS: f64 = 1.6;
const INERTIA: f64 = 0.4;
const GRAVITY: [f64; 2] = [0.6, -9.0];

fn body(name: &str, place: [f64; 2], angle: f64, speed: [f64; 2], spin: f64) -> Value {
    json!({"element": "rigid", "name": name, "mass": MASS, "inertia": INERTIA, "position": place, "angle": angle,
           "motion": {"velocity": speed, "spin": spin}, "markers": {"c": [0.0, 0.0], "p": [0.5, -0.2]}})
}

fn accelerations(of: &[&str]) -> Vec<Value> {
    let both = |m: &&str| {
        [
            json!({"kind": "acceleration", "marker": m}),
            json!({"kind": "angular_acceleration", "marker": m}),
        ]
    };
    of.iter().flat_map(both).collect()
}

/// Forces come in; the motion of the marker goes out.
fn by_force() -> Specimen {
    let (force, moment, angle, spin, speed) = ([1.2, -2.0], 0.7, 0.5, 0.9, [0.3, 0.2]);
    let scene = json!({
        "name": "by_force", "dimension": 2, "gravity": GRAVITY,
        "bodies": [body("a", [0.1, 0.2], angle, speed, spin), body("b", [2.0, 0.0], angle, speed, spin), extra()],
        "ports": [{"name": "flange", "marker": "a.p", "kind": "force", "rotation": true},
                  {"name": "hook", "marker": "b.p", "kind": "force"}]});
    let arm = turned(angle, [0.5, -0.2]);
    let alpha = |moment: f64| (cross(arm, force) + moment) / INERTIA;
    let a = |moment: f64| {
        let centre = sum(GRAVITY, times(1.0 / MASS, force));
        let turn = sum(
            times(alpha(moment), super::left(arm)),
            times(-spin * spin, arm),
        );
        sum(centre, turn)
    };
    Specimen::new("by_force", scene)
        .fact("variables", 31)
        .set("flange.force[1]", force[0])
        .set("flange.force[2]", force[1])
        .set("flange.moment", moment)
        .set("hook.force[1]", force[0])
        .set("hook.force[2]", force[1])
        .vector("flange.position", "m", sum([0.1, 0.2], arm))
        .vector(
            "flange.velocity",
            "m/s",
            sum(speed, times(spin, super::left(arm))),
        )
        .vector("flange.acceleration", "m/s2", a(moment))
        .claim("flange.angle", "rad", angle)
        .claim("flange.angular_velocity", "rad/s", spin)
        .claim("flange.angular_acceleration", "rad/s2", alpha(moment))
        .vector("hook.position", "m", sum([2.0, 0.0], arm))
        .vector("hook.acceleration", "m/s2", a(0.0))
        .claim("flange.force[1]", "N", force[0])
        .claim("flange.moment", "N.m", moment)
        .claim("hook.force[2]", "N", force[1])
}

/// A motion comes in and is followed; the force that it takes goes out, with the other sign.
fn by_motion() -> Specimen {
    let (place, speed, a) = ([0.3, 0.1], [0.4, -0.2], [2.0, 1.1]);
    let (angle, spin, alpha) = (0.6, 0.8, -1.7);
    let mut outputs = accelerations(&["a.c", "b.c"]);
    for kind in ["position", "velocity", "angle", "angular_velocity"] {
        outputs.push(json!({"kind": kind, "marker": "a.c"}));
    }
    let scene = json!({
        "name": "by_motion", "dimension": 2, "gravity": GRAVITY,
        "bodies": [body("a", [0.1, 0.2], 0.5, [0.0, 0.0], 0.0), body("b", [2.0, 0.0], 0.5, [0.0, 0.0], 0.0), extra()],
        "ports": [{"name": "flange", "marker": "a.c", "kind": "motion", "rotation": true},
                  {"name": "hook", "marker": "b.c", "kind": "motion"}],
        "outputs": outputs});
    let mut specimen = Specimen::new("by_motion", scene).fact("variables", 43);
    for port in ["flange", "hook"] {
        for k in 0..2 {
            specimen = specimen
                .set(&format!("{port}.position[{}]", k + 1), place[k])
                .set(&format!("{port}.velocity[{}]", k + 1), speed[k])
                .set(&format!("{port}.acceleration[{}]", k + 1), a[k]);
        }
        specimen = specimen.vector(
            &format!("{port}.force"),
            "N",
            times(-MASS, sum(a, times(-1.0, GRAVITY))),
        );
    }
    specimen
        .set("flange.angle", angle)
        .set("flange.angular_velocity", spin)
        .set("flange.angular_acceleration", alpha)
        .claim("flange.moment", "N.m", -INERTIA * alpha)
        .vector("a.c.acceleration", "m/s2", a)
        .claim("a.c.angular_acceleration", "rad/s2", alpha)
        .vector("b.c.acceleration", "m/s2", a)
        .claim("b.c.angular_acceleration", "rad/s2", 0.0)
        .vector("a.c.position", "m", place)
        .vector("a.c.velocity", "m/s", speed)
        .claim("a.c.angle", "rad", angle)
        .claim("a.c.angular_velocity", "rad/s", spin)
        .vector("flange.position", "m", place)
        .vector("flange.velocity", "m/s", speed)
        .claim("flange.angle", "rad", angle)
        .claim("flange.angular_velocity", "rad/s", spin)
}

/// Where the point and the direction are that come in, and how they move.
const POINT: [[f64; 2]; 2] = [[0.3, 0.1], [0.4, -0.2]];
const TURN: [f64; 2] = [0.6, 0.8];

fn set(mut specimen: Specimen, port: &str, turns: bool) -> Specimen {
    for (k, of) in ["position", "velocity"].into_iter().enumerate() {
        for axis in 0..2 {
            specimen = specimen.set(&format!("{port}.{of}[{}]", axis + 1), POINT[k][axis]);
        }
    }
    if turns {
        specimen = specimen
            .set(&format!("{port}.angle"), TURN[0])
            .set(&format!("{port}.angular_velocity"), TURN[1]);
    }
    specimen
}

/// A motion comes in through springs and dampers.
fn coupled() -> Specimen {
    let (k, d, kr, dr) = (20.0, 1.5, 4.0, 0.3);
    let (place, angle, speed, spin) = ([0.1, 0.2], 0.5, [0.3, 0.6], -0.4);
    let scene = json!({
        "name": "coupled", "dimension": 2, "gravity": GRAVITY,
        "bodies": [body("a", place, angle, speed, spin), extra()],
        "ports": [{"name": "flange", "marker": "a.c", "kind": "motion", "stiffness": k, "damping": d,
                   "rotational_stiffness": kr, "rotational_damping": dr}],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "angular_acceleration", "marker": "a.c"},
                    {"kind": "energy"}]});
    let stretch = sum(place, times(-1.0, POINT[0]));
    let rate = sum(speed, times(-1.0, POINT[1]));
    let force = sum(times(k, stretch), times(d, rate));
    let moment = kr * (angle - TURN[0]) + dr * (spin - TURN[1]);
    set(Specimen::new("coupled", scene), "flange", true)
        .vector("flange.force", "N", force)
        .claim("flange.moment", "N.m", moment)
        .vector(
            "a.c.acceleration",
            "m/s2",
            sum(GRAVITY, times(-1.0 / MASS, force)),
        )
        .claim("a.c.angular_acceleration", "rad/s2", -moment / INERTIA)
        .claim(
            "energy.spring",
            "J",
            0.5 * k * super::dot(stretch, stretch) + 0.5 * kr * (angle - TURN[0]).powi(2),
        )
        .vector("flange.position", "m", POINT[0])
        .vector("flange.velocity", "m/s", POINT[1])
        .claim("flange.angle", "rad", TURN[0])
        .claim("flange.angular_velocity", "rad/s", TURN[1])
}

/// The same without one or the other.
fn coupled_without() -> Specimen {
    let (k, d, kr, dr) = (20.0, 1.5, 4.0, 0.3);
    let (angle, speed, spin) = (0.5, [0.3, 0.6], -0.4);
    let place = [0.1, 0.2];
    let at = |name: &str| body(name, place, angle, speed, spin);
    let port = |name: &str, of: &str, mut keys: Value| {
        keys["name"] = json!(name);
        keys["marker"] = json!(of);
        keys["kind"] = json!("motion");
        keys
    };
    let scene = json!({
        "name": "coupled_without", "dimension": 2,
        "bodies": [at("a"), at("b"), at("e")],
        "ports": [port("soft", "a.c", json!({"damping": d, "rotational_damping": dr})),
                  port("undamped", "b.c", json!({"stiffness": k, "rotational_stiffness": kr})),
                  port("straight", "e.c", json!({"stiffness": k, "damping": d}))],
        "outputs": accelerations(&["a.c", "b.c", "e.c"])});
    let stretch = sum(place, times(-1.0, POINT[0]));
    let rate = sum(speed, times(-1.0, POINT[1]));
    let mut specimen = Specimen::new("coupled_without", scene).fact("variables", 54);
    for (port, turns) in [("soft", true), ("undamped", true), ("straight", false)] {
        specimen = set(specimen, port, turns);
    }
    let (pull, brake) = (times(-k / MASS, stretch), times(-d / MASS, rate));
    specimen
        .vector("a.c.acceleration", "m/s2", brake)
        .claim(
            "a.c.angular_acceleration",
            "rad/s2",
            -dr * (spin - TURN[1]) / INERTIA,
        )
        .vector("b.c.acceleration", "m/s2", pull)
        .claim(
            "b.c.angular_acceleration",
            "rad/s2",
            -kr * (angle - TURN[0]) / INERTIA,
        )
        .vector("e.c.acceleration", "m/s2", sum(pull, brake))
        .claim("e.c.angular_acceleration", "rad/s2", 0.0)
        .vector("undamped.force", "N", times(-MASS, pull))
        .vector("soft.force", "N", times(-MASS, brake))
        .claim("undamped.moment", "N.m", kr * (angle - TURN[0]))
        .claim("soft.moment", "N.m", dr * (spin - TURN[1]))
}
