//! Dry friction on coordinates of joints against closed forms: stops, rest, oscillations that die out, stick and slip.

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::runs::{METHODS, Run, is_near};

const GRAVITY: f64 = 9.81;

/// A block of 2 kg on a guide along a direction, with friction and other loads.
fn block(
    (dimension, method): (usize, &str),
    (direction, speed): ([f64; 2], f64),
    friction: Value,
    loads: &[Value],
) -> Value {
    let point = |x: [f64; 2]| match dimension {
        2 => json!(x),
        _ => json!([x[0], x[1], 0.0]),
    };
    let mut friction = friction;
    friction["name"] = json!("brake");
    friction["kind"] = json!("joint_friction");
    friction["joint"] = json!("guide");
    let mut all = vec![friction];
    all.extend_from_slice(loads);
    let inertia = if dimension == 2 {
        json!(0.1)
    } else {
        json!([0.1, 0.1, 0.1])
    };
    json!({"name": "block", "dimension": dimension, "gravity": point([0.0, -GRAVITY]),
        "bodies": [{"name": "block", "element": "rigid", "mass": 2, "inertia": inertia, "position": point([0.0, 0.0]),
            "motion": {"velocity": point(direction.map(|part| part * speed))}, "markers": {"c": point([0.0, 0.0])}}],
        "joints": [{"name": "guide", "kind": "prismatic", "markers": ["ground", "block.c"], "direction": point(direction)}],
        "loads": all,
        "outputs": [{"kind": "displacement", "joint": "guide"}, {"kind": "velocity", "joint": "guide"}, {"kind": "acceleration", "joint": "guide"},
                    {"kind": "load_force", "load": "brake"}, {"kind": "energy"}, {"kind": "work"}],
        "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-8}})
}

/// A spring on the displacement of the block, without force where it starts from.
fn spring(stiffness: f64, rest: f64) -> Value {
    json!({"name": "spring", "kind": "joint_spring", "joint": "guide", "stiffness": stiffness, "rest": rest})
}

/// A block that slides on a level guide stops after `m v / F` and `m v^2 / (2 F)`, either way, and stands.
#[test]
fn a_block_stops_and_stands() {
    for dimension in [2, 3] {
        for method in METHODS {
            for speed in [3.0, -3.0] {
                let setting = (dimension, method);
                let scene = block(setting, ([1.0, 0.0], speed), json!({"force": 4.0}), &[]);
                let mut run = Run::started(&scene);
                let sign = f64::signum(speed);
                is_near(run.read("guide.acceleration"), -2.0 * sign, 1e-12);
                is_near(run.read("brake.force[1]"), -4.0 * sign, 1e-12);
                run.step(1.0);
                is_near(run.read("guide.displacement"), 2.0 * sign, 1e-8);
                is_near(run.read("energy.dissipated"), 8.0, 1e-7);
                for until in [2.0, 1000.0] {
                    run.step(until);
                    is_near(run.read("guide.displacement"), 2.25 * sign, 1e-8);
                    is_near(run.read("guide.velocity"), 0.0, 1e-12);
                    is_near(run.read("brake.force[1]"), 0.0, 1e-12);
                    is_near(run.read("energy.dissipated"), 9.0, 1e-6);
                }
            }
        }
    }
}

/// The ready scene of a brake on a beam: the disc slows evenly, sticks to the caliper, and both swing on.
#[test]
fn a_disc_sticks_to_its_caliper() {
    let text = include_str!("../../scenes/brake.json");
    let mut scene: Value = serde_json::from_str(text).expect("a scene");
    scene["bodies"][2]["elements"] = json!(2);
    scene["accuracy"] = json!({"relative_tolerance": 1e-8});
    let mut run = Run::started(&scene);
    // From half of the rise of the torque on; what Stribeck's fall adds is less than 1e-8 there.
    run.step(0.1);
    is_near(
        run.read("bearing.angular_velocity"),
        40.0 - 25.0 / 0.06 * 0.075,
        1e-5,
    );
    run.step(0.13);
    let mut fastest = 0.0_f64;
    for k in 0..60 {
        run.step(0.13 + 0.002 * f64::from(k + 1));
        is_near(run.read("pivot.angular_velocity"), 0.0, 1e-9);
        assert!(run.read("pads.moment").abs() < 1.3 * 25.0);
        fastest = fastest.max(run.read("bearing.angular_velocity").abs());
    }
    assert!(fastest > 0.5, "{fastest}");
}

/// Friction that holds more than the weight along an incline keeps a block where it came to rest, for an hour and to the last bit;
/// friction that holds less lets it slide down again.
#[test]
fn a_block_rests_on_an_incline() {
    let (sin, cos, speed) = (0.6, 0.8, 2.0);
    let weight = 2.0 * GRAVITY * sin;
    for method in METHODS {
        let up = |force: f64| {
            let friction = json!({"force": force});
            Run::started(&block((2, method), ([cos, sin], speed), friction, &[]))
        };
        let mut run = up(13.0);
        let way = 2.0 * speed * speed / (2.0 * (13.0 + weight));
        run.step(1.0);
        is_near(run.read("guide.displacement"), way, 1e-8);
        is_near(run.read("brake.force[1]"), weight * cos, 1e-9);
        let place = run.read("guide.displacement");
        run.step(3600.0);
        is_near(run.read("guide.displacement"), place, 1e-14);

        let mut run = up(5.0);
        let way = 2.0 * speed * speed / (2.0 * (5.0 + weight));
        let stops = 2.0 * speed / (5.0 + weight);
        run.step(1.0);
        let fallen = 0.5 * (weight - 5.0) / 2.0 * (1.0 - stops).powi(2);
        is_near(run.read("guide.displacement"), way - fallen, 1e-8);
        is_near(run.read("brake.force[1]"), 5.0 * cos, 1e-9);
    }
}

/// The amplitude of a spring with friction falls by `2 F / k` in each half period until the spring no longer overcomes friction.
#[test]
fn an_oscillation_dies_out_by_steps() {
    let (stiffness, force) = (50.0_f64, 3.0);
    let band = force / stiffness;
    let half = PI / (stiffness / 2.0).sqrt();
    for method in METHODS {
        let first = 10.3 * band;
        let scene = block(
            (2, method),
            ([1.0, 0.0], 0.0),
            json!({"force": force}),
            &[spring(stiffness, -first)],
        );
        let mut run = Run::started(&scene);
        for k in 1..=7 {
            run.step(f64::from(k) * half);
            // From the fifth half period on the spring is too weak.
            let last = k.min(5);
            let left = (first - 2.0 * band * f64::from(last)) * (-1.0_f64).powi(last);
            is_near(run.read("guide.displacement") + first, left, 1e-7);
        }
    }
}

/// A block that a spring pulls at a constant speed sticks until the spring overcomes the larger force, and slips for
/// `2 (pi - atan(A w / v)) / w`, where `A = (F_s - F) / k`.
#[test]
fn a_block_that_is_pulled_sticks_and_slips() {
    let (stiffness, force, ratio, pull) = (40.0_f64, 2.0, 1.6, 0.05);
    let rate = (stiffness / 2.0).sqrt();
    let excess = (ratio - 1.0) * force / stiffness;
    let slip = 2.0 * (PI - (excess * rate / pull).atan()) / rate;
    let stick = 2.0 * excess / pull;
    for method in METHODS {
        let mut scene = block(
            (2, method),
            ([1.0, 0.0], 0.0),
            json!({"force": force, "static_ratio": ratio}),
            &[],
        );
        scene["bodies"].as_array_mut().expect("a list").push(
            json!({"name": "hand", "element": "rigid", "mass": 1, "inertia": 0.1, "position": [1, 0], "markers": {"c": [1, 0]}}),
        );
        scene["joints"].as_array_mut().expect("a list").push(
            json!({"name": "way", "kind": "prismatic", "markers": ["ground", "hand.c"], "direction": [1, 0]}),
        );
        scene["motions"] =
            json!([{"name": "pull", "kind": "displacement", "joint": "way", "value": "0.05*t"}]);
        scene["loads"].as_array_mut().expect("a list").push(
            json!({"name": "spring", "kind": "spring_damper", "markers": ["block.c", "hand.c"], "stiffness": stiffness}),
        );
        let mut run = Run::started(&scene);
        let first = ratio * force / (stiffness * pull);
        let place = |run: &mut Run, time: f64| {
            run.step(time);
            run.read("guide.displacement")
        };
        is_near(place(&mut run, 0.999 * first), 0.0, 1e-12);
        // During the first slip the stretch is `F / k + A cos w t + (v / w) sin w t`.
        let t = 0.4 * slip;
        let stretch =
            force / stiffness + excess * (rate * t).cos() + pull / rate * (rate * t).sin();
        is_near(
            place(&mut run, first + t),
            pull * (first + t) - stretch,
            1e-6,
        );
        let slipped = pull * slip + 2.0 * excess;
        for period in 0..4 {
            let begins = first + f64::from(period) * (slip + stick);
            let before = f64::from(period) * slipped;
            if period > 0 {
                is_near(place(&mut run, begins - 0.01 * stick), before, 1e-6);
            }
            is_near(
                place(&mut run, begins + slip + 0.01 * stick),
                before + slipped,
                1e-6,
            );
        }
    }
}

/// A force that grows evenly moves a block once it overcomes the force at rest; with Stribeck's fall over a speed that is never reached
/// the force stays the larger one.
#[test]
fn a_force_that_grows_overcomes_friction() {
    for method in METHODS {
        for (speed, kinetic) in [(0.0, 3.0), (1e9, 4.5)] {
            let friction = json!({"force": 3.0, "static_ratio": 1.5, "stribeck_speed": speed});
            let push =
                json!({"name": "push", "kind": "force", "marker": "block.c", "value": ["2*t", 0]});
            let mut run = Run::started(&block((2, method), ([1.0, 0.0], 0.0), friction, &[push]));
            run.step(2.0);
            is_near(run.read("guide.displacement"), 0.0, 1e-14);
            is_near(run.read("brake.force[1]"), -4.0, 1e-10);
            run.step(4.0);
            let t = 4.0 - 2.25;
            let way = (2.0 * t * t * t / 6.0 + (4.5 - kinetic) * t * t / 2.0) / 2.0;
            is_near(run.read("guide.displacement"), way, 1e-7);
        }
    }
}

/// A wheel that a brake stops: its torque is an input, a time and a table, in the plane and in space, either way round.
#[test]
fn a_brake_stops_a_wheel() {
    for dimension in [2, 3] {
        for spin in [6.0, -6.0] {
            for method in METHODS {
                let (place, inertia, motion) = match dimension {
                    2 => (json!([0, 0]), json!(0.5), json!(spin)),
                    _ => (
                        json!([0, 0, 0]),
                        json!([0.4, 0.4, 0.5]),
                        json!([0, 0, spin]),
                    ),
                };
                let mut axle =
                    json!({"name": "axle", "kind": "revolute", "markers": ["ground", "wheel.c"]});
                if dimension == 3 {
                    axle["direction"] = json!([0, 0, 1]);
                }
                let scene = json!({"name": "braked", "dimension": dimension, "gravity": place,
                    "bodies": [{"name": "wheel", "element": "rigid", "mass": 1, "inertia": inertia, "position": place,
                        "motion": {"spin": motion}, "markers": {"c": place}}],
                    "joints": [axle],
                    "loads": [{"name": "brake", "kind": "joint_friction", "joint": "axle", "force": 0.0}],
                    "inputs": [{"kind": "friction", "load": "brake"}, {"kind": "torque", "joint": "axle"}],
                    "outputs": [{"kind": "angle", "joint": "axle"}, {"kind": "angular_velocity", "joint": "axle"},
                                {"kind": "load_moment", "load": "brake"}, {"kind": "energy"}, {"kind": "work"}],
                    "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-8}});
                let mut run = Run::started(&scene);
                let sign = f64::signum(spin);
                run.step(1.0);
                is_near(run.read("axle.angle"), 6.0 * sign, 1e-7);
                let saved = run.snapshot();
                let mut ends = Vec::new();
                for _ in 0..2 {
                    run.restore(&saved);
                    run.set("brake.friction_torque", 2.0);
                    run.step(1.5);
                    is_near(run.read("axle.angular_velocity"), 4.0 * sign, 1e-7);
                    run.step(4.0);
                    is_near(run.read("axle.angle"), (6.0 + 4.5) * sign, 1e-7);
                    // A torque below that of the brake does nothing, one above rotates the wheel.
                    run.set("axle.torque", 1.9 * sign);
                    run.step(5.0);
                    is_near(run.read("axle.angle"), 10.5 * sign, 1e-7);
                    let moment = ["brake.moment", "brake.moment[3]"][dimension - 2];
                    is_near(run.read(moment), -1.9 * sign, 1e-9);
                    run.set("axle.torque", -3.0 * sign);
                    run.step(6.0);
                    is_near(run.read("axle.angle"), 9.5 * sign, 1e-7);
                    is_near(run.read("axle.angular_velocity"), -2.0 * sign, 1e-7);
                    ends.push(run.outputs());
                }
                assert_eq!(ends[0], ends[1]);
            }
        }
    }
}
