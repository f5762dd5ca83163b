//! Driven distances against closed forms: a mass on a rope that is hauled in, a boom on a cylinder, inputs.

use serde_json::{Value, json};

use super::runs::{METHODS, Run, is_near, settings, vector};

/// A body of 2 kg that moves around a point of the ground at a driven distance, 1 m at the start, with 3 m/s across.
fn swung((dimension, method): (usize, &str), value: Value) -> Value {
    let zero = vector(dimension, [0.0, 0.0]);
    let inertia = if dimension == 2 {
        json!(0.1)
    } else {
        json!([0.1, 0.1, 0.1])
    };
    json!({"name": "swung", "dimension": dimension,
        "bodies": [{"name": "body", "element": "rigid", "mass": 2, "inertia": inertia, "position": vector(dimension, [1.0, 0.0]),
            "motion": {"velocity": vector(dimension, [-0.5, 3.0])}, "markers": {"c": zero}}],
        "motions": [{"name": "rope", "kind": "distance", "markers": ["ground", "body.c"], "point": zero, "value": value}],
        "outputs": [{"kind": "position", "marker": "body.c"}, {"kind": "velocity", "marker": "body.c"}, {"kind": "reaction", "motion": "rope"},
            {"kind": "work"}, {"kind": "energy"}],
        "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-9}})
}

/// A mass that is hauled in at 0.5 m/s keeps its angular momentum: `r^2 w = 3 m^2/s`, so that it rotates by `6 t / r` and is pulled by
/// `m h^2 / r^3`. What the haul does is its kinetic energy.
#[test]
fn a_mass_that_is_hauled_in_keeps_its_angular_momentum() {
    for setting in settings() {
        let mut run = Run::started(&swung(setting, json!("1 - 0.5*t")));
        for t in [0.4, 1.2] {
            run.step(t);
            let r = 1.0 - 0.5 * t;
            let (sin, cos) = (3.0 * t / r).sin_cos();
            is_near(run.read("body.c.position[1]"), r * cos, 1e-6);
            is_near(run.read("body.c.position[2]"), r * sin, 1e-6);
            let (across, pull) = (3.0 / r, 2.0 * 9.0 / r.powi(3));
            is_near(
                run.read("body.c.velocity[1]"),
                -0.5 * cos - across * sin,
                1e-5,
            );
            is_near(run.read("rope.reaction[1]"), -pull * cos, 1e-4);
            is_near(run.read("rope.reaction[2]"), -pull * sin, 1e-4);
            is_near(run.read("energy.input"), across * across - 9.0, 1e-5);
        }
    }
}

/// The same by inputs, with as many derivatives as the master gives: it sets value and rates at the start of steps.
#[test]
fn a_master_hauls_it_in() {
    for setting in settings() {
        for derivatives in [1, 2] {
            let mut run = Run::ready(&swung(setting, json!({"input": derivatives})));
            run.set("rope.distance", 1.0);
            run.set("rope.velocity", -0.5);
            run.start();
            for k in 1..=40 {
                let before = 0.01 * f64::from(k - 1);
                run.set("rope.distance", 1.0 - 0.5 * before);
                run.set("rope.velocity", -0.5);
                run.step(before + 0.01);
            }
            let (sin, cos) = (1.2_f64 / 0.8).sin_cos();
            is_near(run.read("body.c.position[1]"), 0.8 * cos, 1e-6);
            is_near(run.read("body.c.position[2]"), 0.8 * sin, 1e-6);
        }
    }
}

/// A boom of 2 m on a pin, with a cylinder from 0.8 m below the pin to 0.6 m along it: its angle is that of the triangle, and the force of the
/// cylinder at rest bears the weight about the pin.
#[test]
fn a_cylinder_lifts_a_boom_to_the_angle_of_the_triangle() {
    for method in METHODS {
        let scene = json!({"name": "boom", "dimension": 2, "gravity": [0.0, -9.81],
            "bodies": [{"name": "boom", "element": "rigid", "mass": 60, "inertia": 20, "position": [1.0, 0.0],
                "markers": {"foot": [-1.0, 0.0], "lug": [-0.4, 0.0]}}],
            "joints": [{"name": "foot", "kind": "revolute", "markers": ["ground", "boom.foot"]}],
            "motions": [{"name": "cylinder", "kind": "distance", "markers": ["ground", "boom.lug"], "point": [0.0, -0.8],
                "value": "1 + 0.3*(min(t, 1)^2)*(3 - 2*min(t, 1))"}],
            "outputs": [{"kind": "angle", "joint": "foot"}, {"kind": "reaction", "motion": "cylinder"}],
            "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-9}});
        let mut run = Run::started(&scene);
        for t in [0.5, 2.0] {
            run.step(t);
            let length: f64 = if t < 1.0 { 1.15 } else { 1.3 };
            // Law of cosines, with the angle between the boom and the way down.
            let between = ((0.36 + 0.64 - length * length) / (2.0 * 0.6 * 0.8)).acos();
            let angle = between - std::f64::consts::FRAC_PI_2;
            is_near(run.read("foot.angle"), angle, 1e-8);
        }
        let angle = run.read("foot.angle");
        let arm = 0.8 * 0.6 * angle.cos() / 1.3;
        let force = 60.0 * 9.81 * angle.cos() / arm;
        let found: [f64; 2] = run.read_all("cylinder.reaction");
        is_near(found[0].hypot(found[1]), force, 1e-5 * force);
        assert!(found[1] > 0.0);
    }
}
