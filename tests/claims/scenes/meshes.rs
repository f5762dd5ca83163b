//! How well meshes carry shapes. A cubic element between nodes that are exact takes the mean of a curvature that a
//! uniform load makes quadratic, and is off by `q l^2 / (12 EI)` at both of its ends.

use serde_json::{Value, json};

use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![one_element(), two_elements(), paid_out()]
}

const LOAD: f64 = 1e-4;
/// What of a curvature times a length squared is taken for an error in position (decision 36).
const OFF: f64 = 0.2;

/// A beam of unit length and bending stiffness on a pin and a slide, under a small uniform load.
fn beam(name: &str, elements: u32, accuracy: Value) -> Value {
    json!({
        "name": name, "dimension": 2, "initial": "static_equilibrium", "accuracy": accuracy,
        "bodies": [{"element": "cable", "name": "beam", "elements": elements,
                    "material": {"youngs_modulus": 1e6, "density": 1000.0},
                    "section": {"area": 1e-3, "second_moment": 1e-6},
                    "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.0]}},
                    "markers": {"root": 0.0, "third": 1.0 / 3.0, "tip": 1.0}}],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "beam.root"]},
                   {"name": "slide", "kind": "point_on_line", "markers": ["ground", "beam.tip"], "direction": [1.0, 0.0]}],
        "loads": [{"name": "snow", "kind": "distributed_force", "body": "beam", "value": [0.0, -LOAD]}],
        "outputs": [{"kind": "resolution"}]})
}

/// One element has no node inside: at its pinned ends, curvature should vanish. The error wanted is ten tolerances.
fn one_element() -> Specimen {
    let tolerance = 1e-6;
    let scene = beam("one_element", 1, json!({"relative_tolerance": tolerance}));
    let resolution = OFF * LOAD / 12.0 / (10.0 * tolerance);
    Specimen::new("one_element", scene).claim_within(
        "resolution",
        "",
        resolution,
        1e-5 * resolution,
    )
}

/// Elements of a third and two thirds meet at a support: both are off there, by different amounts. At the clamp, which
/// exerts a moment, nothing is known.
fn two_elements() -> Specimen {
    let error = 1e-5;
    let accuracy = json!({"error": error, "relative_tolerance": 1e-7});
    let mut scene = beam("two_elements", 2, accuracy);
    scene["joints"][0] = super::clamp("clamp", "beam.root");
    let support = json!({"name": "support", "kind": "point_on_line", "markers": ["ground", "beam.third"],
                         "direction": [1.0, 0.0]});
    scene["joints"]
        .as_array_mut()
        .expect("joints")
        .push(support);
    let [short, long] = [1.0_f64 / 3.0, 2.0 / 3.0].map(|length| length * length);
    let half_a_jump = 0.5 * LOAD * (long - short) / 12.0;
    let resolution = OFF * half_a_jump * long / error;
    Specimen::new("two_elements", scene).claim_within(
        "resolution",
        "",
        resolution,
        1e-5 * resolution,
    )
}

/// A beam that was paid out to twice its length, and is at rest again: `q L^4 / (12 EI)` by the length now.
fn paid_out() -> Specimen {
    let (error, length) = (1e-5, 2.0_f64);
    let accuracy = json!({"error": error, "relative_tolerance": 1e-9});
    let mut scene = beam("paid_out_beam", 1, accuracy);
    let material = &mut scene["bodies"][0]["material"];
    (material["density"], material["damping_time"]) = (json!(1.0), json!(0.02));
    scene["motions"] = json!([{"name": "drum", "kind": "winch", "marker": "beam.root",
                              "value": {"table": [[0.0, 0.0], [0.5, length - 1.0]]}}]);
    let resolution = OFF * LOAD * length.powi(4) / 12.0 / error;
    let specimen = Specimen::new("paid_out_beam", scene).at(1.5);
    specimen.claim_within("resolution", "", resolution, 1e-3 * resolution)
}
