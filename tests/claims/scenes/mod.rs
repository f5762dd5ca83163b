//! The specimens: scenes of a body or a few, and what must come of them in closed form. Numbers of the
//! closed forms are those of the scene, written once more where a test must not compute them.

mod airfoils;
mod bushings;
mod cables;
mod contacts;
mod coordinates;
mod coupled;
mod damping;
mod deflections;
mod fluids;
mod frames;
mod initial;
mod inputs;
mod joints;
mod loads;
mod meshes;
mod methods;
mod motions;
mod planar_beams;
mod ports;
mod profiles;
mod reeving;
mod releases;
mod rigid;
mod rods;
mod section_joints;
mod sections;
mod shapes;
mod slides;
mod space;
mod space_beams;
mod space_bodies;
mod space_driven;
mod space_joints;
mod space_modes;
mod space_ports;
mod space_rods;
mod spread;
mod stress;
mod tables;
mod tapers;
mod winches;

use serde_json::{Value, json};

use crate::claims::specimen::Specimen;

/// All of them.
pub fn all() -> Vec<Specimen> {
    let parts = [
        rigid::all(),
        rods::all(),
        frames::all(),
        cables::all(),
        meshes::all(),
        sections::all(),
        joints::all(),
        slides::all(),
        motions::all(),
        planar_beams::all(),
        loads::all(),
        fluids::all(),
        airfoils::all(),
        inputs::all(),
        ports::all(),
        profiles::all(),
        reeving::all(),
        releases::all(),
        methods::all(),
        tables::all(),
        initial::all(),
        space::all(),
        space_bodies::all(),
        space_joints::all(),
        space_modes::all(),
        contacts::all(),
        coordinates::all(),
        damping::all(),
        deflections::all(),
        bushings::all(),
        space_ports::all(),
        space_driven::all(),
        space_rods::all(),
        space_beams::all(),
        spread::all(),
        stress::all(),
        section_joints::all(),
        shapes::all(),
        tapers::all(),
        winches::all(),
    ];
    parts.into_iter().flatten().collect()
}

/// A free rigid body that takes no part: what refers to something else by mistake finds it.
pub fn extra() -> Value {
    json!({"element": "rigid", "name": "extra", "mass": 0.7, "inertia": 0.2,
           "position": [3.1, -2.3], "angle": 1.1,
           "motion": {"velocity": [0.4, 0.9], "spin": -0.6},
           "markers": {"a": [0.1, 0.05], "b": [-0.2, 0.1]}})
}

/// Returns the extra body at rest, for scenes that start at rest.
pub fn resting() -> Value {
    let mut body = extra();
    body["motion"] = json!({});
    body
}

/// A weld to the ground.
pub fn clamp(name: &str, marker: &str) -> Value {
    json!({"name": name, "kind": "weld", "markers": ["ground", marker]})
}

/// A vector rotated counter-clockwise.
pub fn turned(angle: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

pub fn sum(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

pub fn times(factor: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    [factor * x, factor * y]
}

/// A quarter turn to the left: what an angular velocity of 1 makes of a way.
pub fn left([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

pub fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Component of a moment of force: `a x b`.
pub fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
