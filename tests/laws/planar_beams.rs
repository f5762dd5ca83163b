//! Scenes with beams in the plane: beside those of space, beside cables, and alone.

use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::laws::differences::{Outcome, check, within};
use crate::laws::moved::{Plane, agree, simulation, values};
use crate::laws::moved_rods::{flat, in_space};

const CASES: u32 = 3;
/// What roundoff makes of accelerations in equilibrium, m/s^2, by stiffness.
const ROUNDOFF: f64 = 1e-6;
/// So small that shear is a percent of bending.
const FACTOR: f64 = 0.01;

/// A scene of the plane whose cables are beams.
fn of_beams(initial: &str) -> Value {
    let mut scene = flat();
    scene["initial"] = json!(initial);
    scene["accuracy"] = json!({"relative_tolerance": 1e-7});
    for body in scene["bodies"].as_array_mut().expect("bodies") {
        if body["element"] == "cable" {
            body["element"] = json!("beam");
            body["material"]["shear_modulus"] = json!(4e8);
            body["section"]["shear_factor"] = json!(FACTOR);
        }
    }
    scene
}

/// The same in a plane of space.
fn of_spatial_beams(plane: &Plane, flat: &Value) -> Value {
    in_space(plane, flat, |body| {
        body["section"] = json!({"area": 1e-4, "second_moments": [1e-9, 4e-9], "torsion_constant": 3e-9,
                                 "shear_factors": [0.9, FACTOR]});
    })
}

/// In equilibrium they are the same to roundoff; moving, as far as the inertia of sections inside elements is.
fn bends_alike((axis, distance): ([f64; 3], f64)) -> Outcome {
    let plane = Plane {
        axes: Rotation3::new(Vector3::from(axis)),
        distance,
    };
    let (at_rest, moving) = (of_beams("static_equilibrium"), of_beams("undeformed"));
    let mut both = [&at_rest, &moving].map(|scene| {
        [
            simulation(scene),
            simulation(&of_spatial_beams(&plane, scene)),
        ]
    });
    let [[flat, there], [planar, spatial]] = &mut both;
    agree(flat, there, &plane, [1e-9, ROUNDOFF])?;
    planar.step(0.05).expect("a step in the plane");
    spatial.step(0.05).expect("a step in space");
    for name in [
        "arm.tip.position",
        "elbow.tip.position",
        "bob.edge.position",
    ] {
        let place = values(planar, name);
        let expected = plane.point([place[0], place[1]]);
        for (a, b) in expected.iter().zip(values(spatial, name)) {
            within(name, (a - b).abs(), 2e-5)?;
        }
    }
    Ok(())
}

#[test]
fn beams_of_the_plane_and_of_space_bend_alike() {
    let planes = || (prop::array::uniform3(-2.0..2.0), -1.0..1.0);
    check(CASES, planes(), bends_alike);
}

/// Places of the tip of a clamped cable or beam that falls and is pulled aside, `slender` times as stiff against shear and as little thick
/// in rotary inertia; bending stiffness and weight stay.
fn falling(element: &str, slender: f64) -> Vec<[f64; 2]> {
    let area = 1e-4 * slender;
    let mut material = json!({"youngs_modulus": 1e7, "density": 0.1 / area});
    let mut section = json!({"area": area, "second_moment": 1e-9});
    if element == "beam" {
        material["shear_modulus"] = json!(4e6);
        section["shear_factor"] = json!(0.8);
    }
    let scene = json!({"name": "falling", "dimension": 2, "gravity": [0.0, -9.81],
        "bodies": [{"name": "line", "element": element, "elements": 6, "material": material, "section": section,
                    "shape": {"line": {"from": [0.0, 0.0], "to": [0.8, 0.0]}}, "markers": {"root": 0.0, "tip": 1.0}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "line.root"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "line.tip", "value": ["0.2*t", "0.3*sin(20*t)"]}],
        "outputs": [{"kind": "position", "marker": "line.tip"}], "accuracy": {"relative_tolerance": 1e-8}});
    let mut simulation = simulation(&scene);
    let mut places = Vec::new();
    for part in 1..=3 {
        simulation.step(0.05 * f64::from(part)).expect("a step");
        let place = values(&mut simulation, "line.tip.position");
        places.push([place[0], place[1]]);
    }
    places
}

/// What shear and rotary inertia do goes with them.
#[test]
fn a_slender_beam_moves_as_a_cable_does() {
    let apart = |slender: f64| {
        let pairs = falling("beam", slender).into_iter();
        let pairs = pairs.zip(falling("cable", slender));
        let apart = pairs.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
        apart.fold(0.0, f64::max)
    };
    let found = [1.0, 4.0].map(apart);
    assert!(found[0] > 1e-5, "{found:?}");
    for pair in found.windows(2) {
        // A fourth to first order.
        let ratio = pair[0] / pair[1];
        assert!((3.0..5.5).contains(&ratio), "{found:?}");
    }
}

/// A thick beam that flies, rotates, bends and shears keeps its energy and its momenta, by explicit and implicit steps.
#[test]
fn a_free_beam_keeps_energy_and_momenta() {
    for integrator in ["dopri853", "radau"] {
        let scene = json!({"name": "free", "dimension": 2, "gravity": [0.0, 0.0], "method": {"integrator": integrator},
            "bodies": [{"name": "beam", "element": "beam", "elements": 4,
                "material": {"youngs_modulus": 2e6, "shear_modulus": 8e5, "density": 1000.0},
                "section": {"shape": {"rectangle": {"width": 0.1, "height": 0.2}}},
                "shape": {"arc": {"from": [0.1, 0.2], "to": [1.0, 0.3], "length": 1.0}},
                "motion": {"velocity": [0.5, -0.3], "spin": 6.0, "deformation": ["0", "2*sin(PI*s)"]},
                "markers": {"root": 0.0, "tip": 1.0}}],
            "outputs": [{"kind": "energy"}, {"kind": "momentum"}], "accuracy": {"relative_tolerance": 1e-9}});
        let mut simulation = simulation(&scene);
        let mut read = || {
            let energy =
                ["energy.kinetic", "energy.strain"].map(|name| values(&mut simulation, name)[0]);
            let momentum = values(&mut simulation, "momentum");
            let angular = values(&mut simulation, "angular_momentum")[0];
            let bent = energy[1];
            simulation.step(0.3).expect("a step");
            (
                [energy[0] + energy[1], momentum[0], momentum[1], angular],
                bent,
            )
        };
        let (before, _) = read();
        let (after, bent) = read();
        assert!(bent > 1.0, "{bent}");
        for (k, (a, b)) in before.iter().zip(after).enumerate() {
            let off = (a - b).abs() / before[0];
            assert!(off < 1e-6, "{integrator}, {k}: {before:?} {after:?}");
        }
    }
}

/// How the tip of two beams that are welded to each other moves, over their length: lengths and times `scale` as large, `away` from the
/// origin, m.
fn welded(scale: f64, away: f64) -> Vec<f64> {
    let at = |x: f64, y: f64| json!([away + scale * x, scale * y]);
    let beam = |name: &str, from: Value, to: Value| {
        json!({"name": name, "element": "beam", "elements": 2,
            "material": {"youngs_modulus": 1e9, "shear_modulus": 4e8, "density": 1000.0},
            "section": {"area": 1e-4 * scale.powi(2), "second_moment": 1e-9 * scale.powi(4), "shear_factor": 0.8},
            "shape": {"line": {"from": from, "to": to}}, "markers": {"root": 0.0, "tip": 1.0}})
    };
    let scene = json!({"name": "welded", "dimension": 2,
        "bodies": [beam("mast", at(0.0, 0.0), at(0.0, 1.0)), beam("arm", at(0.0, 1.0), at(-1.0, 1.5))],
        "joints": [{"name": "foot", "kind": "weld", "markers": ["ground", "mast.root"]},
                   {"name": "knee", "kind": "weld", "markers": ["mast.tip", "arm.root"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "arm.tip", "value": [0.0, 0.02 * scale.powi(2)]}],
        "outputs": [{"kind": "position", "marker": "arm.tip"}], "accuracy": {"relative_tolerance": 1e-3}});
    let mut simulation = simulation(&scene);
    let mut places = Vec::new();
    for part in 1..=4 {
        simulation
            .step(0.25 * scale * f64::from(part))
            .expect("a step");
        let place = values(&mut simulation, "arm.tip.position");
        places.extend([(place[0] - away) / scale + 1.0, place[1] / scale - 1.5]);
    }
    places
}

/// Errors of steps are relative to the size of a scene, which is neither where it stands nor an angle of its sections.
#[test]
fn steps_are_the_same_at_any_size_and_place() {
    let right = welded(1.0, 0.0);
    let largest = right.iter().fold(0.0_f64, |most, way| most.max(way.abs()));
    for (scale, away) in [(1e-3, 0.0), (1.0, 100.0)] {
        for (found, right) in welded(scale, away).iter().zip(&right) {
            assert!(
                (found - right).abs() < 1e-4 * largest,
                "{scale}, {away}: {found} for {right}"
            );
        }
    }
}
