//! Directions of joints in the axes of the section of a rod or beam.

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::space::{array, vector};
use crate::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![joined("rod"), joined("beam")]
}

/// Half the angle of the arc, and twist at its end, rad.
const HALF: f64 = 0.7;
const TWIST: f64 = 0.4;
const AXIS: [f64; 3] = [0.3, 0.8, 0.5];

/// An arc of the upright plane that begins at a place, twisted along it.
fn arc(name: &str, element: &str, place: f64) -> Value {
    let section = json!({"area": 2e-3, "second_moments": [3e-7, 7e-7], "torsion_constant": 5e-7});
    let mut section = section;
    if element == "beam" {
        section["shear_factors"] = json!([0.8, 0.8]);
    }
    let station = |at: f64| json!({"at": at, "section": section, "twist": at * TWIST});
    json!({"name": name, "element": element, "elements": 2, "axial": "waves",
        "material": {"youngs_modulus": 3e9, "shear_modulus": 1e9, "density": 700.0},
        "stations": [station(0.0), station(1.0)], "axis": AXIS,
        "shape": {"arc": {"from": [0.0, place, 1.0], "to": [2.0, place, 1.0], "length": 2.0 * HALF / HALF.sin()}},
        "markers": {"root": 0.0, "tip": 1.0}})
}

/// Axes of the section at the end of the arc: the tangent, carried from the first end and twisted.
fn axes() -> Matrix3<f64> {
    let (sin, cos) = HALF.sin_cos();
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let (start, end) = (x * cos - z * sin, x * cos + z * sin);
    let given = Vector3::from(AXIS);
    let first = (given - start * start.dot(&given)).normalize();
    // Across the plane as it was, in the plane turned with the tangent.
    let carried = y * first.dot(&y) + end.cross(&y) * first.dot(&start.cross(&y));
    let axis = carried * TWIST.cos() + end.cross(&carried) * TWIST.sin();
    Matrix3::from_columns(&[end, axis, end.cross(&axis)])
}

/// Bodies at the ends of clamped rods move as their joints let them, from the start on, and the rods stay at rest.
fn joined(element: &'static str) -> Specimen {
    let (given, second) = (Vector3::new(0.4, -0.7, 0.6), Vector3::new(0.7, 0.4, 0.0));
    let axes = axes();
    let (along, beside) = ((axes * given).normalize(), (axes * second).normalize());
    let none = Vector3::zeros();
    let joints = [
        (
            "revolute",
            json!({"direction": array(given)}),
            none,
            along * 1.3,
        ),
        (
            "slider",
            json!({"direction": array(given)}),
            along * -0.9,
            none,
        ),
        (
            "universal",
            json!({"direction": array(given), "second_direction": array(second)}),
            none,
            along * 1.1 - beside * 0.8,
        ),
        (
            "planar",
            json!({"direction": array(given)}),
            beside * 0.6,
            along * -0.7,
        ),
        (
            "generic",
            json!({"free": ["rotation_y", "x"]}),
            axes.column(0) * 0.5,
            axes.column(1) * 1.2,
        ),
    ];
    let (mut bodies, mut held, mut outputs) = (vec![], vec![], vec![]);
    for (k, (kind, keys, velocity, spin)) in joints.iter().enumerate() {
        let (rod, body, place) = (format!("arm_{kind}"), format!("body_{kind}"), k as f64);
        bodies.push(arc(&rod, element, place));
        bodies.push(
            json!({"name": body, "element": "rigid", "mass": 0.7, "inertia": [0.03, 0.02, 0.04],
            "position": [2.0, place, 1.0], "markers": {"c": [0.0, 0.0, 0.0]},
            "motion": {"velocity": array(*velocity), "spin": array(*spin)}}),
        );
        held.push(json!({"name": format!("wall_{kind}"), "kind": "weld", "markers": ["ground", format!("{rod}.root")]}));
        let mut joint = json!({"name": kind, "kind": kind, "markers": [format!("{rod}.tip"), format!("{body}.c")]});
        for (key, value) in keys.as_object().into_iter().flatten() {
            joint[key] = value.clone();
        }
        held.push(joint);
        outputs.push(json!({"kind": "velocity", "marker": format!("{body}.c")}));
        outputs.push(json!({"kind": "angular_velocity", "marker": format!("{body}.c")}));
    }
    let scene = json!({"name": "joined", "dimension": 3, "bodies": bodies, "joints": held, "outputs": outputs});
    let title = match element {
        "rod" => "joints in the axes of rods",
        _ => "joints in the axes of beams",
    };
    let mut specimen = Specimen::new(title, scene);
    for (kind, _, velocity, spin) in joints {
        specimen = vector(
            specimen,
            &format!("body_{kind}.c.velocity"),
            "m/s",
            velocity,
        );
        specimen = vector(
            specimen,
            &format!("body_{kind}.c.angular_velocity"),
            "rad/s",
            spin,
        );
    }
    specimen
}
