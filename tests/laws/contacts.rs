//! Contacts with surfaces of moving bodies: momenta and energy of what collides, balls that roll, ropes on drums that turn, belts.

use serde_json::{Value, json};

use super::runs::{Run, is_near, settings, vector};

const G: f64 = 9.81;

/// A rigid body with a marker in its centre and one beside it, in the plane of a scene of either dimension.
fn body(dimension: usize, (name, mass, inertia): (&str, f64, f64), place: [f64; 2]) -> Value {
    json!({"element": "rigid", "name": name, "mass": mass, "inertia": about_z(dimension, inertia),
        "position": vector(dimension, place),
        "markers": {"c": vector(dimension, [0.0, 0.0]), "p": vector(dimension, [0.15, -0.05])}})
}

/// Inertia of a body whose motion in the plane has this one.
fn about_z(dimension: usize, inertia: f64) -> Value {
    match dimension {
        2 => json!(inertia),
        _ => json!([0.7 * inertia, 0.9 * inertia, inertia]),
    }
}

fn moving(mut body: Value, dimension: usize, velocity: [f64; 2], spin: f64) -> Value {
    body["motion"] =
        json!({"velocity": vector(dimension, velocity), "spin": about(dimension, spin)});
    body
}

fn about(dimension: usize, spin: f64) -> Value {
    match dimension {
        2 => json!(spin),
        _ => json!([0.0, 0.0, spin]),
    }
}

/// A circle in the plane; in space a sphere, or a cylinder about z.
fn round(dimension: usize, center: [f64; 2], radius: f64, is_cylinder: bool) -> Value {
    let center = vector(dimension, center);
    match (dimension, is_cylinder) {
        (2, _) => json!({"circle": {"center": center, "radius": radius}}),
        (_, false) => json!({"sphere": {"center": center, "radius": radius}}),
        _ => json!({"cylinder": {"point": center, "axis": [0.0, 0.0, 1.0], "radius": radius}}),
    }
}

fn plane(dimension: usize, point: [f64; 2], normal: [f64; 2]) -> Value {
    json!({"plane": {"point": vector(dimension, point), "normal": vector(dimension, normal)}})
}

fn scene((dimension, method): (usize, &str), bodies: &Value, loads: &Value) -> Value {
    json!({"name": "touching", "dimension": dimension, "bodies": bodies, "loads": loads,
        "outputs": [{"kind": "energy"}, {"kind": "work"}, {"kind": "momentum"}],
        "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-9}})
}

fn read(scene: &mut Value, kind: &str, marker: &str) {
    let outputs = scene["outputs"].as_array_mut().expect("outputs");
    outputs.push(json!({"kind": kind, "marker": marker}));
}

/// Angular velocity about the axis across the plane.
fn spin(run: &mut Run, marker: &str) -> f64 {
    let name = format!("{marker}.angular_velocity");
    let is_plane = run.names().contains(&name);
    run.read(&if is_plane { name } else { name + "[3]" })
}

/// Bodies that nothing holds collide, with damping and friction: a ball hits another one beside its middle, a corner hits a face. All of
/// them keep linear and angular momentum, and what is lost of the energy has been dissipated.
#[test]
fn what_collides_keeps_momenta_and_the_books_of_energy() {
    for setting in settings() {
        let dimension = setting.0;
        let law = json!({"kind": "contact", "stiffness": 2e4, "damping": 0.3, "friction": 0.4, "slip_velocity": 0.05});
        let contact = |name: &str, more: Value| {
            let mut load = law.clone();
            load["name"] = json!(name);
            for (key, value) in more.as_object().into_iter().flatten() {
                load[key] = value.clone();
            }
            load
        };
        let mut turned = body(dimension, ("struck", 2.0, 0.03), [0.0, 0.0]);
        turned["angle"] = json!(0.4);
        if dimension == 3 {
            turned.as_object_mut().expect("a body").remove("angle");
            let (sin, cos) = 0.4_f64.sin_cos();
            turned["orientation"] =
                json!({"matrix": [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]});
        }
        let bodies = json!([
            moving(turned, dimension, [0.3, -0.1], 2.0),
            moving(
                body(dimension, ("ball", 1.5, 0.01), [0.62, 0.18]),
                dimension,
                [-3.0, 0.2],
                -4.0
            ),
            moving(
                body(dimension, ("corner", 0.8, 0.02), [-0.6, 0.05]),
                dimension,
                [2.5, -0.3],
                1.0
            ),
        ]);
        let loads = json!([
            contact(
                "balls",
                json!({"marker": "ball.c", "radius": 0.1, "surface_of": "struck",
                "surface": round(dimension, [0.05, 0.03], 0.3, false)})
            ),
            contact(
                "face",
                json!({"marker": "corner.p", "surface_of": "struck",
                "surface": plane(dimension, [-0.2, 0.0], [-0.96, 0.28])})
            ),
        ]);
        let mut run = Run::started(&scene(setting, &bodies, &loads));
        let (momenta, energy) = (run.momenta(), run.balance());
        let mut touched = 0.0_f64;
        for k in 1..=30 {
            run.step(0.01 * f64::from(k));
            touched = touched.max(run.read("energy.spring"));
            for (before, now) in momenta.iter().zip(run.momenta()) {
                is_near(now, *before, 1e-9);
            }
            is_near(run.balance(), energy, 1e-6);
        }
        let lost = run.read("energy.dissipated");
        assert!(touched > 1.0 && lost > 1.0, "{touched} {lost}");
    }
}

/// A ball is thrown along a floor, or along a plank that slides freely, and slides until it rolls. The speed then follows from the angular
/// momentum about the point of touch: `v / (1 + J / m r^2)` over the floor; on the plank of mass `M` the same with the ball's mass `m M / (m + M)`.
#[test]
fn a_ball_that_slides_comes_to_roll() {
    let (mass, inertia, radius, speed, plank) = (2.0, 0.05, 0.2, 2.0, 3.0);
    for setting in settings() {
        for moves in [false, true] {
            let dimension = setting.0;
            let ball = body(dimension, ("ball", mass, inertia), [0.0, radius - 2e-4]);
            let ball = moving(ball, dimension, [speed, 0.0], 0.0);
            let bodies = json!([ball, body(dimension, ("plank", plank, 1.0), [0.0, -0.1])]);
            let (owner, height) = if moves {
                (Some("plank"), 0.1)
            } else {
                (None, 0.0)
            };
            let mut load = json!({"name": "floor", "kind": "contact", "marker": "ball.c", "radius": radius, "stiffness": 1e5,
                "damping": 1.0, "friction": 0.5, "slip_velocity": 1e-3, "surface": plane(dimension, [0.0, height], [0.0, 1.0])});
            if let Some(owner) = owner {
                load["surface_of"] = json!(owner);
            }
            let mut scene = scene(setting, &bodies, &json!([load]));
            scene["gravity"] = vector(dimension, [0.0, -G]);
            scene["joints"] = json!([
                {"name": "slide", "kind": "point_on_line", "markers": ["ground", "plank.c"], "point": vector(dimension, [0.0, -0.1]),
                 "direction": vector(dimension, [1.0, 0.0])},
                {"name": "upright", "kind": "orientation", "markers": ["ground", "plank.c"]}]);
            for of in ["ball.c", "plank.c"] {
                read(&mut scene, "velocity", of);
            }
            read(&mut scene, "angular_velocity", "ball.c");
            let mut run = Run::started(&scene);
            run.step(0.6);
            let acting = if moves {
                mass * plank / (mass + plank)
            } else {
                mass
            };
            let against = speed / (1.0 + inertia / (acting * radius * radius));
            let [ball, plank_speed] =
                ["ball", "plank"].map(|of| run.read(&format!("{of}.c.velocity[1]")));
            is_near(ball - plank_speed, against, 1e-6);
            is_near(spin(&mut run, "ball.c"), -against / radius, 1e-5);
            let shared = if moves {
                mass * (speed - ball) / plank
            } else {
                0.0
            };
            is_near(plank_speed, shared, 1e-7);
        }
    }
}
