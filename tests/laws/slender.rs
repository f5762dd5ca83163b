//! What lines of one element have that those of another lack, and how it goes where they are slender.

use nalgebra::Vector3;
use serde_json::json;

use crate::laws::moved::{simulation, values};
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

/// So do shear and the inertia of sections that rotate across the line.
#[test]
fn a_slender_beam_moves_as_a_rod_does() {
    come_together(["beam", "rod"], &[1.0, 4.0], (0.06, 1e-7));
}

/// EA L^2/EI of lines that are rolled up and let go.
const SLENDERNESS: [f64; 3] = [1e2, 1e5, 1e8];

/// A line of unit length and bending stiffness along x, clamped.
fn unit_line(element: &str, elements: usize, slenderness: f64) -> serde_json::Value {
    let mut section = json!({"area": 1e-6 * slenderness, "second_moments": [1e-6, 1e-6], "torsion_constant": 1.875e-6});
    if element == "beam" {
        section["shear_factors"] = json!([1.0, 1.0]);
    }
    json!({"name": "rod", "element": element, "elements": elements, "axis": [0.0, 1.0, 0.0],
        "material": {"youngs_modulus": 1e6, "shear_modulus": 4e5, "density": 1e6 / slenderness}, "section": section,
        "shape": line([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]), "markers": {"root": 0.0, "tip": 1.0}})
}

fn held(body: serde_json::Value) -> serde_json::Value {
    json!({"name": "slender", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": [body],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.root"]}],
        "outputs": [{"kind": "position", "marker": "rod.tip"}], "accuracy": {"relative_tolerance": 1e-6}})
}

/// A dead moment `M` at the tip rotates the tangent about itself at the rate `M / EI`, however stiff the line is against stretching and
/// shear: it bears no force. Source: closed form of the helix (case `rod_statics`).
#[test]
fn slender_rods_and_beams_do_not_lock() {
    let moment = Vector3::<f64>::new(1.5, 2.0, 4.0);
    let (axis, rate) = (moment.normalize(), moment.norm());
    let along = axis * axis.x;
    let exact = along
        + (Vector3::x() - along) * (rate.sin() / rate)
        + axis.cross(&Vector3::x()) * ((1.0 - rate.cos()) / rate);
    for element in ["rod", "beam"] {
        let found = SLENDERNESS.map(|slenderness| {
            [8, 16].map(|elements| {
                let mut scene = held(unit_line(element, elements, slenderness));
                scene["initial"] = json!("static_equilibrium");
                scene["loads"] = json!([{"name": "end", "kind": "moment", "marker": "rod.tip", "value": moment.as_slice()}]);
                let tip = values(&mut simulation(&scene), "rod.tip.position");
                (Vector3::from_vec(tip) - exact).norm()
            })
        });
        for [coarse, fine] in found {
            assert!(
                fine < 4.5e-5 && coarse / fine > 12.0,
                "{element}: {found:?}"
            );
        }
    }
}

/// Iterations of Newton's method that a step of the implicit method tries.
fn iterations(element: &str, elements: usize, slenderness: f64) -> f64 {
    let mut scene = held(unit_line(element, elements, slenderness));
    scene["method"] = json!({"integrator": "radau"});
    scene["loads"] = json!([{"name": "pull", "kind": "force", "marker": "rod.tip", "value": [0.0, "2*min(t,1)", "3*min(t,1)^2"]}]);
    let mut simulation = simulation(&scene);
    simulation.step(1.0).expect("a step");
    let report = simulation.report();
    report.newton_iterations as f64 / (report.steps + report.rejected) as f64
}

/// In equilibrium they are the same at all meshes (`src/elements/rod/statics.rs`, `src/elements/beam/statics.rs`).
#[test]
fn newton_iterations_stay_few_whatever_mesh_and_stiffness() {
    for element in ["rod", "beam"] {
        for slenderness in SLENDERNESS {
            let found = [4, 16].map(|elements| iterations(element, elements, slenderness));
            assert!(
                found.iter().all(|count| *count < 6.5),
                "{element}, {slenderness:e}: {found:?}"
            );
        }
    }
}
