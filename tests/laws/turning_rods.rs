//! Rods and beams seen from a frame that rotates: the same motion, the same forces in their sections.

use nalgebra::{Rotation3, Vector3};
use proptest::array::uniform3;
use serde_json::{Value, json};

use crate::laws::differences::{Outcome, check, within};
use crate::laws::moved::{simulation, values};
use flexbody::simulation::Simulation;

const CASES: u32 = 4;
const TOLERANCE: f64 = 1e-9;
/// What the tolerance allows of what is read, relative to its size.
const AT_END: f64 = 2e-6;
/// The same of axial forces, N: a strain of 3e-9.
const AXIAL: f64 = 1e-4;
const STEPS: usize = 5;
const STEP: f64 = 0.01;
/// Rate of steady motions, rad/s.
const RATE: f64 = 6.0;

/// A body with coupled sections on a ball at the origin, which spins; in space where the frame does not rotate.
fn scene(element: &str, rotation: Vector3<f64>, spin: Vector3<f64>, initial: &str) -> Value {
    let mut body = json!({"name": "body", "element": element, "elements": 4,
        "material": {"youngs_modulus": 2e7, "shear_modulus": 8e6, "density": 1100.0},
        "section": {"shape": {"rectangle": {"width": 0.06, "height": 0.03}}},
        "shape": {"arc": {"from": [0.0, 0.0, 0.0], "to": [0.5, 0.2, 0.1], "length": 0.6}}, "axis": [0.1, 0.3, 1.0],
        "markers": {"root": 0.0, "mid": 0.5, "tip": 1.0}});
    body["motion"] = json!({"spin": (spin - rotation).as_slice()});
    let at = |kind: &str| json!({"kind": kind, "marker": "body.mid"});
    json!({"name": "turning", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "rotation": rotation.as_slice(),
        "initial": initial, "bodies": [body],
        "joints": [{"name": "ball", "kind": "spherical", "markers": ["ground", "body.root"]}],
        "outputs": [at("torque"), at("bending_moment"), at("axial_force"), at("position"),
            {"kind": "position", "marker": "body.tip"}, {"kind": "energy"}],
        "accuracy": {"relative_tolerance": TOLERANCE}})
}

/// Both say the same at a time, the second in the axes of a frame that has rotated.
fn agree(space: &mut Simulation, seen: &mut Simulation, turn: Rotation3<f64>) -> Outcome {
    for name in ["mid.position", "tip.position", "mid.bending_moment"] {
        let name = format!("body.{name}");
        let both = [&mut *space, &mut *seen].map(|of| values(of, &name));
        let [space, seen] = both.map(|of| Vector3::from_column_slice(&of));
        let error = (turn * seen - space).norm();
        within(&name, error, AT_END * (1.0 + space.norm()))?;
    }
    for (name, limit) in [("body.mid.torque", AT_END), ("body.mid.axial_force", AXIAL)] {
        let [space, seen] = [&mut *space, &mut *seen].map(|of| values(of, name)[0]);
        within(name, (space - seen).abs(), limit * (1.0 + space.abs()))?;
    }
    Ok(())
}

/// Kinetic energy and that of strain and of the centrifugal force, J.
fn energy_of(simulation: &mut Simulation) -> f64 {
    let parts = ["kinetic", "strain", "gravity"];
    parts
        .iter()
        .map(|part| values(simulation, &format!("energy.{part}"))[0])
        .sum()
}

#[test]
fn a_rod_or_beam_moves_alike_seen_from_a_frame_that_turns() {
    for element in ["rod", "beam"] {
        let vectors = (uniform3(-8.0..8.0_f64), uniform3(-8.0..8.0_f64));
        check(CASES, vectors, |(rotation, spin)| {
            let (rotation, spin) = (Vector3::from(rotation), Vector3::from(spin));
            let mut space = simulation(&scene(element, Vector3::zeros(), spin, "undeformed"));
            let mut seen = simulation(&scene(element, rotation, spin, "undeformed"));
            space.start().expect("a start");
            seen.start().expect("a start");
            let energy = energy_of(&mut seen);
            for step in 1..=STEPS {
                let time = STEP * step as f64;
                space.step(time).expect("a step");
                seen.step(time).expect("a step");
                agree(&mut space, &mut seen, Rotation3::new(rotation * time))?;
            }
            let error = energy_of(&mut seen) - energy;
            within("energy", error.abs(), AT_END * energy.abs())
        });
    }
}

#[test]
fn a_steady_motion_is_an_equilibrium_seen_from_its_frame() {
    for element in ["rod", "beam"] {
        let spin = Vector3::new(0.0, 0.0, RATE);
        let mut space = scene(element, Vector3::zeros(), spin, "steady");
        space["joints"][0]["kind"] = json!("revolute");
        space["joints"][0]["direction"] = json!([0.0, 0.0, 1.0]);
        space["motions"] = json!([{"name": "drive", "joint": "ball", "kind": "angle", "value": format!("{RATE}*t")}]);
        let mut seen = scene(element, spin, spin, "static_equilibrium");
        seen["joints"][0]["kind"] = json!("weld");
        let (mut space, mut seen) = (simulation(&space), simulation(&seen));
        space.start().expect("a start");
        seen.start().expect("a start");
        let shape = values(&mut seen, "body.tip.position");
        for step in 0..=STEPS {
            let time = STEP * step as f64;
            if step > 0 {
                space.step(time).expect("a step");
                seen.step(time).expect("a step");
            }
            agree(&mut space, &mut seen, Rotation3::new(spin * time)).expect("the same motion");
        }
        for (now, then) in values(&mut seen, "body.tip.position").iter().zip(&shape) {
            within("rest", (now - then).abs(), AT_END).expect("an equilibrium");
        }
    }
}

/// A planar beam on a hub.
fn on_hub(rotation: f64, initial: &str, angle: &str) -> Value {
    json!({"name": "hub", "dimension": 2, "gravity": [0.0, 0.0], "rotation": rotation, "initial": initial,
        "bodies": [{"name": "hub", "element": "rigid", "mass": 1.0, "inertia": 0.1, "position": [0.0, 0.0],
                "markers": {"centre": [0.0, 0.0], "rim": [0.1, 0.0]}},
            {"name": "beam", "element": "beam", "elements": 4,
                "material": {"youngs_modulus": 2e6, "shear_modulus": 8e5, "density": 1100.0},
                "section": {"shape": {"rectangle": {"width": 0.06, "height": 0.05}}},
                "shape": {"line": {"from": [0.1, 0.0], "to": [0.7, 0.1]}}, "markers": {"root": 0.0, "tip": 1.0}}],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "hub.centre"]},
            {"name": "weld", "kind": "weld", "markers": ["hub.rim", "beam.root"]}],
        "motions": [{"name": "drive", "joint": "pin", "kind": "angle", "value": angle}],
        "outputs": [{"kind": "position", "marker": "beam.tip"}, {"kind": "bending_moment", "marker": "beam.root"}],
        "accuracy": {"relative_tolerance": TOLERANCE}})
}

#[test]
fn a_planar_beam_turns_steadily_as_it_rests_in_its_frame() {
    let mut space = simulation(&on_hub(0.0, "steady", &format!("{RATE}*t")));
    let mut seen = simulation(&on_hub(RATE, "static_equilibrium", "0"));
    space.start().expect("a start");
    seen.start().expect("a start");
    for step in 0..=STEPS {
        let time = STEP * step as f64;
        if step > 0 {
            space.step(time).expect("a step");
            seen.step(time).expect("a step");
        }
        let [at, rest] = [&mut space, &mut seen].map(|of| values(of, "beam.tip.position"));
        let (sin, cos) = (RATE * time).sin_cos();
        let turned = [cos * rest[0] - sin * rest[1], sin * rest[0] + cos * rest[1]];
        for (found, expected) in at.iter().zip(turned) {
            within("tip", (found - expected).abs(), AT_END).expect("the same motion");
        }
        let [a, b] = [&mut space, &mut seen].map(|of| values(of, "beam.root.bending_moment")[0]);
        within("moment", (a - b).abs(), AT_END).expect("the same moment");
    }
}
