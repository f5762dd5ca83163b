//! Rods and beams that bend or twist more than their elements hold say which element it is and what to do.

use flexbody::scene::Scene;
use flexbody::simulation::Simulation;
use serde_json::{Value, json};

/// What is said of a line of elements that stands along x, clamped, when it is let go under a moment at its tip that grows.
fn told(element: &str, elements: usize, moment: [&str; 3]) -> String {
    let mut section =
        json!({"area": 1e-4, "second_moments": [1e-9, 1e-9], "torsion_constant": 2e-9});
    if element == "beam" {
        section["shear_factors"] = json!([0.9, 0.9]);
    }
    let body: Value = json!({"name": "line", "element": element, "elements": elements,
        "material": {"youngs_modulus": 1e6, "shear_modulus": 4e5, "density": 1000.0, "damping_time": 0.02},
        "section": section, "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [0.4, 0.0, 0.0]}}, "markers": {"root": 0.0, "tip": 1.0}});
    let scene = json!({"name": "overbent", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": [body],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "line.root"]}],
        "loads": [{"name": "turn", "kind": "moment", "marker": "line.tip", "follower": true, "value": moment}],
        "accuracy": {"relative_tolerance": 1e-4}});
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("an initial state");
    let failure = simulation.step(1.0).expect_err("a step too far");
    failure.to_string()
}

/// Under a torque `M` a rod twists by `M L / (G J)`: half a turn an element at `pi G J / L` times their number. A moment that follows
/// bends it to an arc of `M L / (E I)`; angles from the middle of an element are half of what it turns.
#[test]
fn elements_that_bend_or_twist_too_much_are_named() {
    let what = "expected elements of `line` that bend by less than a right angle from the middle to an end and twist by less \
                than half a turn, found more in element ";
    for element in ["rod", "beam"] {
        for (elements, moment) in [
            (1, ["0.02*t", "0", "0"]),
            (1, ["0", "0", "0.02*t"]),
            (3, ["0.06*t", "0", "0"]),
        ] {
            let told = told(element, elements, moment);
            let named =
                (1..=elements).any(|k| told.contains(&format!("{what}{k}: take more elements")));
            assert!(
                named,
                "{element}, {elements} elements under {moment:?}: {told}"
            );
        }
    }
}
