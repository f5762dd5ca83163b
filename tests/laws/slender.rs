//! What lines of one element have that those of another lack, and how it goes where they are slender.

use nalgebra::Vector3;
use serde_json::json;

use crate::laws::moved::simulation;
use crate::laws::moved_rods::{line, outputs};

/// Positions of the tip of a clamped cable, rod or beam that falls and is pulled aside, `slender` times less thick in inertia of
/// spin over that of the line, and as many times as stiff in shear; bending stiffness and weight stay.
fn falling(element: &str, slender: f64, (until, tolerance): (f64, f64)) -> Vec<[f64; 3]> {
    let area = 1e-4 * slender;
    let mut material = json!({"youngs_modulus": 1e7, "density": 0.1 / area});
    let mut section = json!({"area": area});
    if element != "cable" {
        material["shear_modulus"] = json!(4e6);
        section["second_moments"] = json!([1e-9, 1e-9]);
        section["torsion_constant"] = json!(2e-9);
    } else {
        section["second_moment"] = json!(1e-9);
    }
    if element == "beam" {
        section["shear_factors"] = json!([0.8, 0.6]);
    }
    let scene = json!({"name": "falling", "dimension": 3, "gravity": [0.0, 3.0, -9.81],
        "bodies": [{"name": "rod", "element": element, "elements": 6,
            "material": material, "section": section, "shape": line([0.0, 0.0, 0.0], [0.8, 0.0, 0.0]), "markers": {"root": 0.0, "tip": 1.0}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.root"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "rod.tip", "value": ["0.2*t", "0.3*sin(20*t)", "0.1"]}],
        "outputs": [{"kind": "position", "marker": "rod.tip"}], "accuracy": {"relative_tolerance": tolerance}});
    let mut simulation = simulation(&scene);
    let mut places = Vec::new();
    for part in 1..=6 {
        simulation
            .step(until * f64::from(part) / 6.0)
            .expect("a step");
        let (_, place) = outputs(&mut simulation).remove(0);
        places.push([place[0], place[1], place[2]]);
    }
    places
}

/// What tells two elements apart is as many times less as lines are slender, to first order.
fn come_together(elements: [&str; 2], slender: &[f64], run: (f64, f64)) {
    let apart = |slender: &f64| {
        let [a, b] = elements.map(|element| falling(element, *slender, run));
        let pairs = a.into_iter().zip(b);
        pairs
            .map(|(a, b)| (Vector3::from(a) - Vector3::from(b)).norm())
            .fold(0.0, f64::max)
    };
    let found: Vec<f64> = slender.iter().map(apart).collect();
    for (pair, ratio) in found.windows(2).zip(slender.windows(2)) {
        let expected = pair[0] * ratio[0] / ratio[1];
        assert!(
            (pair[1] / expected - 1.0).abs() < 0.33,
            "{elements:?} apart by {found:?}"
        );
    }
}

/// Torque comes of inertia of spin alone, and goes with it.
#[test]
fn a_rod_without_torque_moves_as_a_cable_does() {
    come_together(["rod", "cable"], &[1.0, 4.0, 16.0], (0.3, 1e-10));
}

/// So do shear and the inertia of sections that turn across the line.
#[test]
fn a_slender_beam_moves_as_a_rod_does() {
    come_together(["beam", "rod"], &[1.0, 4.0], (0.06, 1e-7));
}
