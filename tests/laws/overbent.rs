//! Rods and beams that bend or twist more than their elements hold say which element it is and what to do.

use std::f64::consts::PI;

use flexbody::scene::Scene;
use flexbody::simulation::Simulation;
use serde_json::{Value, json};

/// A line of elements that stands along x, clamped, with a moment at its tip that follows.
fn clamped(element: &str, elements: usize, moment: &[Value; 3]) -> Value {
    let mut section =
        json!({"area": 1e-4, "second_moments": [1e-9, 1e-9], "torsion_constant": 2e-9});
    if element == "beam" {
        section["shear_factors"] = json!([0.9, 0.9]);
    }
    let body: Value = json!({"name": "line", "element": element, "elements": elements,
        "material": {"youngs_modulus": 1e6, "shear_modulus": 4e5, "density": 1000.0, "damping_time": 0.02},
        "section": section, "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [0.4, 0.0, 0.0]}}, "markers": {"root": 0.0, "tip": 1.0}});
    json!({"name": "overbent", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": [body],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "line.root"]}],
        "loads": [{"name": "turn", "kind": "moment", "marker": "line.tip", "follower": true, "value": moment}],
        "accuracy": {"relative_tolerance": 1e-4}})
}

/// What is said when the initial state is looked for.
fn told_at_start(scene: &Value) -> String {
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let started = Simulation::new(scene).initialize(0.0);
    started
        .err()
        .map(|error| error.to_string())
        .unwrap_or_default()
}

/// What is said of a line that is let go under a moment that grows.
fn told(element: &str, elements: usize, moment: [&str; 3]) -> String {
    let scene = clamped(element, elements, &moment.map(|part| json!(part)));
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("an initial state");
    let failure = simulation.step(1.0).expect_err("a step too far");
    failure.to_string()
}

const WHAT: &str = "expected elements of `line` that bend by less than a right angle from the middle to an end and twist by less \
                    than half a turn, found more in element ";

/// Whether one of the elements is named, with where it is and what to do.
fn is_named(told: &str, elements: usize, place: &str) -> bool {
    (1..=elements).any(|k| {
        let rest = told.strip_prefix(&format!("initial: {WHAT}{k}{place}"));
        rest.is_some_and(|rest| rest.ends_with(": take more elements"))
            || told.contains(&format!("{WHAT}{k}: take more elements"))
    })
}

/// Under a torque `M` a rod twists by `M L / (G J)`: half a turn an element at `pi G J / L` times their number. A moment that follows
/// bends it to an arc of `M L / (E I)`; angles from the middle of an element are half of what it rotates.
#[test]
fn elements_that_bend_or_twist_too_much_are_named() {
    for element in ["rod", "beam"] {
        for (elements, moment) in [
            (1, ["0.02*t", "0", "0"]),
            (1, ["0", "0", "0.02*t"]),
            (3, ["0.06*t", "0", "0"]),
        ] {
            let told = told(element, elements, moment);
            assert!(
                is_named(&told, elements, ""),
                "{element}, {elements} elements under {moment:?}: {told}"
            );
        }
    }
}

/// The same in equilibrium: parts of half a turn of twist, and of a revolution of bending, an element. Where no way is open, corrections that
/// shrink to nothing are no equilibrium.
#[test]
fn an_equilibrium_beyond_what_elements_hold_is_refused() {
    let [torsion, bending] = [4e5 * 2e-9 / 0.4, 1e6 * 1e-9 / 0.4].map(|stiffness| stiffness * PI);
    for element in ["rod", "beam"] {
        for (elements, follower) in [(1, true), (2, false)] {
            for (axis, size) in [(0, 1.1 * torsion), (2, 2.0 * bending)] {
                let mut moment = [0.0; 3];
                moment[axis] = size * elements as f64;
                let mut scene = clamped(element, elements, &moment.map(|part| json!(part)));
                scene["initial"] = json!("static_equilibrium");
                scene["loads"][0]["follower"] = json!(follower);
                let told = told_at_start(&scene);
                let place = " on the way to equilibrium beyond ";
                assert!(
                    is_named(&told, elements, place),
                    "{element}, {elements} elements, {size} about {axis}: {told}"
                );
            }
        }
        // Less is found.
        for (axis, size) in [(0, 0.9 * torsion), (2, 0.9 * bending)] {
            let mut moment = [0.0; 3];
            moment[axis] = 3.0 * size;
            let mut scene = clamped(element, 3, &moment.map(|part| json!(part)));
            scene["initial"] = json!("static_equilibrium");
            assert_eq!(told_at_start(&scene), "", "{element}");
        }
    }
}

/// An arc of more than half a turn in one element has no unstressed shape.
#[test]
fn a_shape_beyond_what_elements_hold_is_refused() {
    for element in ["rod", "beam"] {
        let mut scene = clamped(element, 1, &[0.0; 3].map(|part| json!(part)));
        for (length, is_held) in [(0.5, true), (2.0, false)] {
            let arc = json!({"from": [0.0, 0.0, 0.0], "to": [0.4, 0.0, 0.0], "length": length});
            scene["bodies"][0]["shape"] = json!({"arc": arc});
            let told = told_at_start(&scene);
            if is_held {
                assert_eq!(told, "", "{element}")
            } else {
                assert!(is_named(&told, 1, " at the start"), "{element}: {told}")
            }
        }
    }
}
