//! Contacts that stick, against closed forms: stops, rest without creep, stick and slip, and the books of energy.

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::runs::{Run, is_near, settings, vector};

const G: f64 = 9.81;
/// Mass of the block, kg.
const MASS: f64 = 2.0;
/// Stiffness of all contacts of the block together, along the normal and along the surface, N/m.
const STIFFNESS: f64 = 4e5;
/// Damping along the surface of all of them, N s/m.
const DAMPING: f64 = 1800.0;
/// Speed at which they stick, m/s.
const SLOW: f64 = 1e-3;

/// Names and places of the points on which a block stands, at the height of its centre of mass: all bear the same part of its weight.
fn feet(dimension: usize) -> Vec<(String, Value)> {
    let places = match dimension {
        2 => vec![json!([-0.5, 0]), json!([0.5, 0])],
        _ => vec![
            json!([-0.5, 0, -0.3]),
            json!([-0.5, 0, 0.3]),
            json!([0.5, 0, -0.3]),
            json!([0.5, 0, 0.3]),
        ],
    };
    let names = (0..places.len()).map(|k| format!("foot_{k}"));
    names.zip(places).collect()
}

/// A block that stands on the plane `y = 0`, at a speed along it, under gravity.
fn block(
    (dimension, method): (usize, &str),
    (speed, gravity): (f64, [f64; 2]),
    law: &Value,
) -> Value {
    let feet = feet(dimension);
    let count = feet.len() as f64;
    let depth = -MASS * gravity[1] / STIFFNESS;
    let mut markers = json!({"c": vector(dimension, [0.0, 0.0])});
    let mut loads = Vec::new();
    for (name, place) in &feet {
        markers[name] = place.clone();
        let mut load = json!({"name": name, "kind": "contact", "marker": format!("block.{name}"), "stiffness": STIFFNESS / count,
            "damping": 1.0, "surface": {"plane": {"point": vector(dimension, [0.0, 0.0]), "normal": vector(dimension, [0.0, 1.0])}},
            "slip_velocity": SLOW, "tangential_stiffness": STIFFNESS / count, "tangential_damping": DAMPING / count});
        for (key, value) in law.as_object().into_iter().flatten() {
            load[key] = value.clone();
        }
        loads.push(load);
    }
    let inertia = match dimension {
        2 => json!(0.1),
        _ => json!([0.1, 0.1, 0.1]),
    };
    let forces = feet
        .iter()
        .map(|(name, _)| json!({"kind": "load_force", "load": name}));
    let outputs = [
        json!({"kind": "position", "marker": "block.c"}),
        json!({"kind": "velocity", "marker": "block.c"}),
        json!({"kind": "energy"}),
        json!({"kind": "work"}),
    ];
    json!({"name": "block", "dimension": dimension, "gravity": vector(dimension, gravity),
        "bodies": [{"name": "block", "element": "rigid", "mass": MASS, "inertia": inertia, "position": vector(dimension, [0.0, -depth]),
            "motion": {"velocity": vector(dimension, [speed, 0.0])}, "markers": markers}],
        "loads": loads, "outputs": outputs.into_iter().chain(forces).collect::<Vec<_>>(),
        "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-8}})
}

fn add(scene: &mut Value, list: &str, of: Value) {
    if scene[list].is_null() {
        scene[list] = json!([]);
    }
    scene[list].as_array_mut().expect("a list").push(of);
}

/// Force of all contacts along the plane, N.
fn friction(run: &mut Run) -> f64 {
    let names = run.names().into_iter();
    let forces = names.filter(|name| name.starts_with("foot_") && name.ends_with(".force[1]"));
    forces.map(|name| run.read(&name)).sum()
}

/// A block that is thrown up an incline stops after `v^2 / (2 (mu N + W) / m)`. It rests where the springs along the surface, which held
/// it downwards, hold it upwards: not an atom further after an hour.
#[test]
fn a_block_rests_on_an_incline_without_creep() {
    let (speed, mu) = (2.0, 1.2);
    let [down, across] = [0.6, 0.8].map(|part| part * MASS * G);
    for setting in settings() {
        let law = json!({"friction": mu});
        let mut run = Run::started(&block(setting, (speed, [-0.6 * G, -0.8 * G]), &law));
        let energy = run.balance();
        is_near(friction(&mut run), -mu * across, 1e-4);
        run.step(2.0);
        let stops = MASS * speed * speed / (2.0 * (mu * across + down));
        let place = run.read("block.c.position[1]");
        is_near(place, stops - (mu * across + down) / STIFFNESS, 2e-7);
        is_near(friction(&mut run), down, 1e-6);
        is_near(run.balance(), energy, 1e-6);
        run.step(if setting.1 == "radau" { 3600.0 } else { 4.0 });
        is_near(run.read("block.c.position[1]"), place, 1e-10);
    }
}

/// A block that stands on an incline which is too steep for it slides from the start; one that stands on a flatter one does not.
#[test]
fn what_friction_cannot_hold_slides_from_the_start() {
    for setting in settings() {
        for (mu, slides) in [(0.5, true), (0.9, false)] {
            let law = json!({"friction": mu});
            let mut run = Run::started(&block(setting, (0.0, [-0.6 * G, -0.8 * G]), &law));
            run.step(1.0);
            let way = if slides {
                -0.5 * G * (0.6 - 0.8 * mu)
            } else {
                -0.6 * MASS * G / STIFFNESS
            };
            // Until the springs along the surface have been stretched to the largest friction nothing slides.
            let off = if slides { 2e-2 } else { 1e-7 };
            is_near(run.read("block.c.position[1]"), way, off);
        }
    }
}

/// A force that grows evenly in a direction of the plane moves a block once it overcomes the largest friction.
#[test]
fn a_force_that_grows_overcomes_friction() {
    let (mu, ratio) = (0.15, 1.4);
    let push = MASS * G * mu;
    for setting in settings() {
        for ratio in [1.0, ratio] {
            let law = json!({"friction": mu, "static_ratio": ratio});
            let mut scene = block(setting, (0.0, [0.0, -G]), &law);
            let value = match setting.0 {
                2 => json!(["2*t", 0]),
                _ => json!(["1.2*t", 0, "1.6*t"]),
            };
            let force =
                json!({"name": "push", "kind": "force", "marker": "block.c", "value": value});
            add(&mut scene, "loads", force);
            let mut run = Run::started(&scene);
            let starts = ratio * push / 2.0;
            run.step(0.9 * starts);
            let way = |run: &mut Run| match setting.0 {
                2 => run.read("block.c.position[1]"),
                _ => {
                    let [x, _, z] = run.read_all("block.c.position");
                    is_near(z, 4.0 / 3.0 * x, 1e-6);
                    0.6 * x + 0.8 * z
                }
            };
            is_near(way(&mut run), 0.9 * ratio * push / STIFFNESS, 1e-6);
            run.step(starts + 1.0);
            let first = ratio * push / STIFFNESS;
            let slid = 2.0 / 6.0 + (ratio - 1.0) * push / 2.0;
            is_near(way(&mut run), first + slid / MASS, 2e-5);
        }
    }
}

/// A block on an incline that is too steep for it stands while a load presses it down. It slides from the instant on at which the load is too
/// small, with the friction that there was.
#[test]
fn a_load_that_is_taken_off_lets_a_block_slide() {
    let mu = 0.5;
    let [down, across] = [0.6, 0.8].map(|part| part * MASS * G);
    for setting in settings() {
        let mut scene = block(
            setting,
            (0.0, [-0.6 * G, -0.8 * G]),
            &json!({"friction": mu}),
        );
        let depth = (across + 20.0) / STIFFNESS;
        scene["bodies"][0]["position"] = vector(setting.0, [0.0, -depth]);
        let value = match setting.0 {
            2 => json!([0, "8*t - 20"]),
            _ => json!([0, "8*t - 20", 0]),
        };
        let load = json!({"name": "load", "kind": "force", "marker": "block.c", "value": value});
        add(&mut scene, "loads", load);
        let mut run = Run::started(&scene);
        let starts = (20.0 - (down / mu - across)) / 8.0;
        run.step(0.9 * starts);
        is_near(friction(&mut run), down, 1e-6);
        is_near(run.read("block.c.position[1]"), -down / STIFFNESS, 1e-7);
        run.step(starts + 1.0);
        is_near(
            friction(&mut run),
            mu * (across + 20.0 - 8.0 * (starts + 1.0)),
            1e-4,
        );
        let slid = mu * 8.0 / (6.0 * MASS);
        is_near(
            run.read("block.c.position[1]"),
            -down / STIFFNESS - slid,
            1e-5,
        );
    }
}

/// A block that a spring pulls at a constant speed sticks until the spring overcomes the larger force, and slips for
/// `2 (pi - atan(A w / v)) / w`, where `A = (F_s - F) / k`. A state that is restored goes on to the last bit.
#[test]
fn a_block_that_is_pulled_sticks_and_slips() {
    let (stiffness, force, ratio, pull) = (40.0_f64, 2.0, 1.6, 0.05);
    let rate = (stiffness / MASS).sqrt();
    let excess = (ratio - 1.0) * force / stiffness;
    let slip = 2.0 * (PI - (excess * rate / pull).atan()) / rate;
    let stick = 2.0 * excess / pull;
    for (dimension, method) in settings() {
        let law = json!({"friction": force / (MASS * G), "static_ratio": ratio});
        let mut scene = block((dimension, method), (0.0, [0.0, -G]), &law);
        let inertia = scene["bodies"][0]["inertia"].clone();
        let place = vector(dimension, [1.0, 0.0]);
        let hand = json!({"name": "hand", "element": "rigid", "mass": 1, "inertia": inertia, "position": place, "markers": {"c": place}});
        add(&mut scene, "bodies", hand);
        let direction = vector(dimension, [1.0, 0.0]);
        let way = json!({"name": "way", "kind": "prismatic", "markers": ["ground", "hand.c"], "direction": direction});
        add(&mut scene, "joints", way);
        let drawn =
            json!({"name": "pull", "kind": "displacement", "joint": "way", "value": "0.05*t"});
        add(&mut scene, "motions", drawn);
        let spring = json!({"name": "spring", "kind": "spring_damper", "markers": ["block.c", "hand.c"], "stiffness": stiffness});
        add(&mut scene, "loads", spring);
        let mut run = Run::started(&scene);
        let energy = run.balance();
        let first = ratio * force / (stiffness * pull);
        let slipped = pull * slip + 2.0 * excess;
        let mut place = |time: f64| {
            run.step(time);
            run.read("block.c.position[1]")
        };
        // The springs along the surface stretch by 8e-6 m.
        is_near(place(0.999 * first), 0.0, 1e-5);
        for period in 0..3 {
            let begins = first + f64::from(period) * (slip + stick);
            let before = f64::from(period) * slipped;
            if period > 0 {
                is_near(place(begins - 0.01 * stick), before, 3e-5);
            }
            let after = begins + slip + 0.01 * stick;
            is_near(place(after), before + slipped, 3e-5);
        }
        is_near(run.balance(), energy, 1e-6);
        let saved = run.snapshot();
        let mut ends = Vec::new();
        let last = first + 3.5 * (slip + stick);
        for _ in 0..2 {
            run.restore(&saved);
            run.step(last);
            ends.push(run.outputs());
        }
        assert_eq!(ends[0], ends[1]);
    }
}

/// A block slides along a plank, which slides without friction, until both have the speed `m v / (m + M)`; then it sticks to it, and both
/// keep that speed.
#[test]
fn a_block_and_a_plank_that_slides_end_together() {
    let (speed, mu, plank) = (3.0, 0.4, 3.0);
    for setting in settings() {
        let dimension = setting.0;
        let mut scene = block(setting, (speed, [0.0, -G]), &json!({"friction": mu}));
        let feet = scene["loads"].as_array_mut().expect("loads");
        for foot in feet {
            foot["surface_of"] = json!("plank");
            let down = vector(dimension, [0.0, 0.1]);
            foot["surface"]["plane"]["point"] = down;
        }
        let inertia = scene["bodies"][0]["inertia"].clone();
        let place = vector(dimension, [0.0, -0.1]);
        add(
            &mut scene,
            "bodies",
            json!({"name": "plank", "element": "rigid", "mass": plank, "inertia": inertia, "position": place,
                "markers": {"c": vector(dimension, [0.0, 0.0])}}),
        );
        add(
            &mut scene,
            "joints",
            json!({"name": "guide", "kind": "prismatic", "markers": ["ground", "plank.c"], "direction": vector(dimension, [1.0, 0.0])}),
        );
        add(
            &mut scene,
            "outputs",
            json!({"kind": "position", "marker": "plank.c"}),
        );
        let mut run = Run::started(&scene);
        let energy = run.balance();
        let common = MASS * speed / (MASS + plank);
        let slows = mu * G * (1.0 + MASS / plank);
        run.step(0.5 * speed / slows);
        is_near(
            run.read("block.c.velocity[1]"),
            speed - 0.5 * mu * G * speed / slows,
            1e-5,
        );
        for until in [1.0, 3.0] {
            run.step(until);
            is_near(run.read("block.c.velocity[1]"), common, 1e-6);
            let apart = run.read("block.c.position[1]") - run.read("plank.c.position[1]");
            let stops = speed * speed / (2.0 * slows);
            is_near(apart, stops - mu * MASS * G / STIFFNESS, 2e-7);
            is_near(run.balance(), energy, 1e-6);
        }
    }
}

/// A block that falls askew bounces, slides, sticks and lifts off again; what is lost of its energy has been dissipated.
#[test]
fn a_block_that_bounces_keeps_the_books_of_energy() {
    for setting in settings() {
        let law = json!({"friction": 0.6, "static_ratio": 1.2, "slip_velocity": 0.02});
        let mut scene = block(setting, (1.5, [0.0, -G]), &law);
        let body = &mut scene["bodies"][0];
        body["position"] = vector(setting.0, [0.0, 0.2]);
        body["motion"]["spin"] = match setting.0 {
            2 => json!(-1.0),
            _ => json!([0.3, 0.2, -1.0]),
        };
        let mut run = Run::started(&scene);
        let energy = run.balance();
        let mut lost = 0.0;
        for k in 1..=20 {
            run.step(0.05 * f64::from(k));
            is_near(run.balance(), energy, 1e-5);
            let now = run.read("energy.dissipated");
            assert!(now >= lost - 0.1, "{now} after {lost}");
            lost = now;
        }
        assert!(lost > 1.0, "{lost}");
    }
}
