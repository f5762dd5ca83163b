//! Latches: when they close and open, and what velocities are after that, against closed forms.

use serde_json::{Value, json};

use super::runs::{METHODS, Run, is_near};

const GRAVITY: f64 = 9.81;

/// Energies of all kinds with what was dissipated, J.
fn balance(run: &mut Run) -> f64 {
    let names = run.names().into_iter();
    let kept = names.filter(|name| name.starts_with("energy.") && name != "energy.input");
    let kept: Vec<String> = kept.collect();
    kept.iter().map(|name| run.read(name)).sum()
}

/// Two flywheels on one axis, the second of which rotates relative to the first.
fn flywheels(dimension: usize, method: &str) -> Value {
    let [place, inertia, spins] = match dimension {
        2 => [json!([0, 0]), json!(1.5), json!([1.0, 3.0])],
        _ => [
            json!([0, 0, 0]),
            json!([1.1, 1.2, 1.5]),
            json!([[0, 0, 1.0], [0, 0, 3.0]]),
        ],
    };
    let mut second = inertia.clone();
    match dimension {
        2 => second = json!(0.5),
        _ => second[2] = json!(0.5),
    }
    let wheel = |name: &str, inertia: &Value, spin: &Value| {
        json!({"name": name, "element": "rigid", "mass": 1, "inertia": inertia, "position": place,
            "motion": {"spin": spin}, "markers": {"axle": place}})
    };
    let axis = |joint: Value| {
        let mut joint = joint;
        if dimension == 3 {
            joint["direction"] = json!([0, 0, 1]);
        }
        joint
    };
    json!({"name": "wheels", "dimension": dimension, "gravity": place,
        "bodies": [wheel("a", &inertia, &spins[0]), wheel("b", &second, &spins[1])],
        "joints": [axis(json!({"name": "bearing", "kind": "revolute", "markers": ["ground", "a.axle"]})),
                   axis(json!({"name": "between", "kind": "revolute", "markers": ["a.axle", "b.axle"]}))],
        "latches": [{"name": "lock", "joint": "between", "at": 1.0}],
        "outputs": [{"kind": "angle", "joint": "bearing"}, {"kind": "angle", "joint": "between"}, {"kind": "angular_velocity", "joint": "bearing"},
                    {"kind": "angular_velocity", "joint": "between"}, {"kind": "latch_state", "latch": "lock"},
                    {"kind": "latch_torque", "latch": "lock"}, {"kind": "energy"}, {"kind": "work"}],
        "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-10}})
}

/// Wheels that lock at `1 rad / (3 - 1) rad/s` rotate on together with their angular momentum; the rest of the energy is lost.
#[test]
fn flywheels_lock_with_their_momentum() {
    for dimension in [2, 3] {
        for method in METHODS {
            let mut run = Run::started(&flywheels(dimension, method));
            let before = balance(&mut run);
            run.step(0.49);
            is_near(run.read("lock.latch_state"), 0.0, 0.0);
            is_near(run.read("between.angle"), 0.98, 1e-9);
            run.step(0.79);
            is_near(run.read("lock.latch_state"), 1.0, 0.0);
            let rate = (1.5 * 1.0 + 0.5 * 3.0) / 2.0;
            is_near(run.read("between.angle"), 1.0, 1e-12);
            is_near(run.read("between.angular_velocity"), 0.0, 1e-12);
            is_near(run.read("bearing.angular_velocity"), rate, 1e-9);
            is_near(run.read("bearing.angle"), 0.5 + rate * 0.29, 1e-8);
            // The reduced moment of inertia at the relative rate of 2 rad/s.
            let lost = 0.5 * (1.5 * 0.5 / 2.0) * 4.0;
            is_near(run.read("energy.dissipated"), lost, 1e-8);
            is_near(balance(&mut run), before, 1e-8);
        }
    }
}

/// A block on a vertical guide; a latch on its displacement with more keys.
fn falling(latch: Value, speed: f64, method: &str) -> Value {
    let mut latch = latch;
    latch["name"] = json!("catch");
    latch["joint"] = json!("guide");
    json!({"name": "falling", "dimension": 2, "gravity": [0, -GRAVITY],
        "bodies": [{"name": "block", "element": "rigid", "mass": 2, "inertia": 0.1, "position": [0, 0],
            "motion": {"velocity": [0, speed]}, "markers": {"c": [0, 0]}}],
        "joints": [{"name": "guide", "kind": "prismatic", "markers": ["ground", "block.c"], "direction": [0, 1]}],
        "latches": [latch],
        "inputs": [{"kind": "latch", "latch": "catch"}],
        "outputs": [{"kind": "displacement", "joint": "guide"}, {"kind": "velocity", "joint": "guide"}, {"kind": "latch_state", "latch": "catch"},
                    {"kind": "latch_force", "latch": "catch"}, {"kind": "energy"}, {"kind": "work"}],
        "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-8}})
}

/// A block is caught where it passes, bears its weight there, falls on once its input lets it, and is not caught again where it stands.
#[test]
fn a_falling_block_is_caught_and_let_go() {
    for method in METHODS {
        let mut run = Run::started(&falling(json!({"at": -0.5}), 0.0, method));
        run.step(0.3);
        is_near(run.read("guide.displacement"), -0.5 * GRAVITY * 0.09, 1e-8);
        run.step(0.4);
        is_near(run.read("guide.displacement"), -0.5, 1e-12);
        is_near(run.read("catch.latch_force"), 2.0 * GRAVITY, 1e-9);
        is_near(run.read("energy.dissipated"), 2.0 * GRAVITY * 0.5, 1e-7);
        for (armed, until) in [(0.0, 0.5), (1.0, 0.6)] {
            run.set("catch.armed", armed);
            run.step(until);
            is_near(run.read("catch.latch_state"), 0.0, 0.0);
            let falls = 0.5 * GRAVITY * (until - 0.4_f64).powi(2);
            is_near(run.read("guide.displacement"), -0.5 - falls, 1e-8);
        }
    }
}

/// A throw whose summit is a little above the latch, within one communication step: it is caught on its way up.
#[test]
fn a_throw_is_caught_on_its_way_up() {
    let (speed, top) = (2.0_f64, 2.0 * 2.0 / (2.0 * GRAVITY));
    for method in METHODS {
        for share in [0.5, 0.9, 0.999] {
            let at = share * top;
            let mut run = Run::started(&falling(json!({"at": at}), speed, method));
            run.step(0.4);
            is_near(run.read("guide.displacement"), at, 1e-12);
            let kinetic = 0.5 * 2.0 * speed * speed - 2.0 * GRAVITY * at;
            is_near(run.read("energy.dissipated"), kinetic, 1e-6);
        }
        // Above the summit there is nothing to catch.
        let mut run = Run::started(&falling(json!({"at": 1.001 * top}), speed, method));
        run.step(0.4);
        is_near(
            run.read("guide.displacement"),
            speed * 0.4 - 0.5 * GRAVITY * 0.16,
            1e-8,
        );
    }
}

/// A latch that is armed from a time on lets pass what comes before; one with `release_time` opens for good.
#[test]
fn times_arm_and_open_a_latch() {
    for method in METHODS {
        let passing = json!({"at": -0.5, "from_time": 0.35});
        let mut run = Run::started(&falling(passing, 0.0, method));
        run.step(0.5);
        is_near(run.read("guide.displacement"), -0.5 * GRAVITY * 0.25, 1e-8);
        let held = json!({"closed": true, "release_time": 0.2});
        let mut run = Run::started(&falling(held, 0.0, method));
        run.step(0.1);
        is_near(run.read("guide.displacement"), 0.0, 1e-12);
        is_near(run.read("catch.latch_state"), 1.0, 0.0);
        run.step(0.5);
        is_near(run.read("guide.displacement"), -0.5 * GRAVITY * 0.09, 1e-8);
    }
}

/// An arrow is pushed by a string, and leaves it where the string is straight: `v = x sqrt(k / (m_string + m_arrow))`.
#[test]
fn an_arrow_leaves_the_string_that_pushes_it() {
    let (string, arrow, stiffness, draw) = (0.01, 0.03, 800.0, 0.5);
    for method in METHODS {
        let block = |name: &str, mass: f64| {
            json!({"name": name, "element": "rigid", "mass": mass, "inertia": 1e-4, "position": [-draw, 0],
                "markers": {"c": [0, 0]}})
        };
        let scene = json!({"name": "archery", "dimension": 2, "gravity": [0, 0],
            "bodies": [block("string", string), block("arrow", arrow)],
            "joints": [{"name": "bow", "kind": "prismatic", "markers": ["ground", "string.c"], "point": [0, 0], "direction": [1, 0]},
                       {"name": "nock", "kind": "prismatic", "markers": ["string.c", "arrow.c"], "direction": [1, 0]}],
            "loads": [{"name": "limbs", "kind": "joint_spring", "joint": "bow", "coordinate": "displacement", "stiffness": stiffness, "rest": 0}],
            "latches": [{"name": "grip", "joint": "nock", "closed": true, "least_force": 0}],
            "outputs": [{"kind": "velocity", "marker": "arrow.c"}, {"kind": "position", "marker": "arrow.c"}, {"kind": "displacement", "joint": "bow"},
                        {"kind": "latch_state", "latch": "grip"}, {"kind": "latch_force", "latch": "grip"}, {"kind": "energy"}, {"kind": "work"}],
            "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-9}});
        let mut run = Run::started(&scene);
        let before = balance(&mut run);
        is_near(before, 0.5 * stiffness * draw * draw, 1e-9);
        // The string and the arrow share the force by their masses.
        let share = arrow / (string + arrow);
        is_near(run.read("grip.latch_force"), share * stiffness * draw, 1e-6);
        let rate = (stiffness / (string + arrow)).sqrt();
        let (leaves, after) = (0.5 * std::f64::consts::PI / rate, 0.005);
        run.step(leaves + after);
        is_near(run.read("grip.latch_state"), 0.0, 0.0);
        is_near(
            run.read("arrow.c.velocity[1]"),
            draw * rate,
            1e-5 * draw * rate,
        );
        is_near(run.read("arrow.c.position[1]"), draw * rate * after, 1e-5);
        let own = (stiffness / string).sqrt();
        let swing = draw * rate / own * (own * after).sin();
        is_near(run.read("bow.displacement"), swing, 1e-4);
        is_near(balance(&mut run), before, 1e-6 * before);
    }
}

/// Panels of a free hub that unfold and lock one after the other: momenta stay zero through three impacts, angles stay where they locked.
#[test]
fn panels_that_lock_keep_their_momenta() {
    let text = include_str!("../../scenes/solar_array.json");
    let mut run = Run::started(&serde_json::from_str(text).expect("a scene"));
    let mut closed = 0.0;
    for k in 1..=100 {
        run.step(0.1 * f64::from(k));
        let latches = ["inner", "middle", "outer"].map(|of| format!("{of}_latch.latch_state"));
        let now = latches.iter().map(|name| run.read(name)).sum();
        assert!(now >= closed, "{now} {closed}");
        closed = now;
        let largest = run
            .momenta()
            .into_iter()
            .fold(0.0, |most: f64, of| most.max(of.abs()));
        // Panels of 5 kg move with 1 m/s over some metres, at a tolerance of 1e-3.
        assert!(largest < 5e-3, "{largest}");
    }
    is_near(closed, 3.0, 0.0);
    let angles = [("inner", 0.5), ("middle", -1.0), ("outer", 1.0)];
    for (panel, half_turns) in angles {
        let angle = run.read(&format!("{panel}_hinge.angle"));
        is_near(angle, half_turns * std::f64::consts::PI, 1e-12);
    }
}

/// A mast of stiff tubes that springs unfold from a free satellite moves as slowly as those springs: steps hold its velocities over that time,
/// and it keeps the angular momentum that it has, none. Weighed by its vibrations it had 0.41 N m s after three seconds, and its end was
/// 0.34 m off.
#[test]
fn a_stiff_mast_that_springs_unfold_keeps_its_momentum() {
    let text = include_str!("../../scenes/unfolding_mast.json");
    let mut scene: Value = serde_json::from_str(text).expect("a scene");
    scene["accuracy"] = json!({"relative_tolerance": 1e-4});
    let mut run = Run::started(&scene);
    for k in 1..=240 {
        run.step(0.0125 * f64::from(k));
    }
    is_near(run.read("angular_momentum"), 0.0, 0.01);
    is_near(run.read("momentum[1]"), 0.0, 0.01);
}
