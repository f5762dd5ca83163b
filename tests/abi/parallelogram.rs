//! A scene with singular positions: a parallelogram, which is one when it is flat.

use std::f64::consts::PI;

use serde_json::{Value, json};

/// Length of the cranks of the parallelogram, and of its coupler and ground, m.
const CRANK: f64 = 0.2;
const COUPLER: f64 = 0.5;
/// Rate of the cranks, rad/s.
const SPIN: f64 = 10.0;

/// Time from the flat position at which a condition leaves a few ten-thousandths of itself, s.
pub const NEAR: f64 = 3e-5;

/// A bar along the first axis at an angle, by its lower end.
fn bar(name: &str, length: f64, [x, y]: [f64; 2], angle: f64) -> Value {
    let half = length / 2.0;
    json!({
        "name": name, "element": "rigid", "mass": 0.3, "inertia": 1e-3, "angle": angle,
        "position": [x + half * angle.cos(), y + half * angle.sin()],
        "markers": {"root": [-half, 0.0], "pin": [half, 0.0], "middle": [0.0, 0.0]}
    })
}

/// A parallelogram at an angle whose cranks rotate freely, without gravity, the rocker longer by so much (m).
pub fn four_bars(angle: f64, longer: f64) -> Value {
    let (sin, cos) = angle.sin_cos();
    let mut bodies = [
        bar("crank", CRANK, [0.0, 0.0], angle),
        bar("coupler", COUPLER, [CRANK * cos, CRANK * sin], 0.0),
        bar("rocker", CRANK + longer, [COUPLER, 0.0], angle),
    ];
    for (body, part) in bodies.iter_mut().zip([0.5, 1.0, 0.5]) {
        let velocity = [-sin, cos].map(|v| v * part * CRANK * SPIN);
        let spin = if part == 1.0 { 0.0 } else { SPIN };
        body["motion"] = json!({"velocity": velocity, "spin": spin});
    }
    let ground = |name: &str, marker: &str, x: f64| json!({"name": name, "kind": "revolute", "markers": ["ground", marker], "point": [x, 0.0]});
    let pin = |name: &str, markers: [&str; 2]| json!({"name": name, "kind": "revolute", "markers": markers});
    json!({
        "name": "four_bars", "dimension": 2, "gravity": [0.0, 0.0], "bodies": bodies,
        "joints": [
            ground("pivot", "crank.root", 0.0),
            pin("crank_pin", ["crank.pin", "coupler.root"]),
            pin("rocker_pin", ["coupler.pin", "rocker.pin"]),
            ground("rocker_pivot", "rocker.root", COUPLER),
        ],
        "outputs": [{"kind": "reaction", "joint": "rocker_pivot"}],
        "accuracy": {"relative_tolerance": 1e-9},
        "experiment": {"stop_time": 2.0, "step": 0.05}
    })
}

/// When it is flat for the first time, and the second, s.
pub fn flat(angle: f64) -> [f64; 2] {
    [1.0, 2.0].map(|turns| (turns * PI - angle) / SPIN)
}

/// The parallelogram with a third crank between the others, along them but for an angle (rad).
pub fn three_cranks(turned: f64) -> Value {
    let mut scene = four_bars(0.5, 0.0);
    let [(sin, cos), (s, c)] = [0.5, 0.5 + turned].map(f64::sin_cos);
    let root = [COUPLER / 2.0 + CRANK * (cos - c), CRANK * (sin - s)];
    let third = bar("third", CRANK, root, 0.5 + turned);
    scene["bodies"].as_array_mut().expect("a list").push(third);
    let joints = scene["joints"].as_array_mut().expect("a list");
    joints.push(json!({"name": "third_pivot", "kind": "revolute", "markers": ["ground", "third.root"], "point": root}));
    joints.push(json!({"name": "third_pin", "kind": "revolute", "markers": ["coupler.middle", "third.pin"]}));
    scene
}
