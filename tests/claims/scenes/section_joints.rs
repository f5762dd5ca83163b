//! Joints of rods and beams: directions in the axes of the section, and clamps on the ground.

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::space::{array, vector};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        joined("rod"),
        joined("beam"),
        clamped("rod"),
        clamped("beam"),
    ]
}

/// Half the angle of the arc, and twist at its end, rad.
const HALF: f64 = 0.7;
const TWIST: f64 = 0.4;
const AXIS: [f64; 3] = [0.3, 0.8, 0.5];

/// An arc of the upright plane that begins at a place, twisted along it.
fn arc(name: &str, element: &str, place: f64) -> Value {
    let mut section =
        json!({"area": 2e-3, "second_moments": [3e-7, 7e-7], "torsion_constant": 5e-7});
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

/// Axes of the section at the end of the arc: the tangent, transported from the first end and twisted.
fn axes() -> Matrix3<f64> {
    let (sin, cos) = HALF.sin_cos();
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let (start, end) = (x * cos - z * sin, x * cos + z * sin);
    let given = Vector3::from(AXIS);
    let first = (given - start * start.dot(&given)).normalize();
    // Across the plane as it was, in the plane rotated with the tangent.
    let carried = y * first.dot(&y) + end.cross(&y) * first.dot(&start.cross(&y));
    let axis = carried * TWIST.cos() + end.cross(&carried) * TWIST.sin();
    Matrix3::from_columns(&[end, axis, end.cross(&axis)])
}

/// Kind of a joint, its keys, and velocity and angular velocity that it lets a body at the end have.
type Motion = (&'static str, Value, Vector3<f64>, Vector3<f64>);

fn motions() -> [Motion; 6] {
    let (given, second) = (Vector3::new(0.4, -0.7, 0.6), Vector3::new(0.7, 0.4, 0.0));
    let bent = Vector3::new(0.5, -0.6, 0.9);
    let axes = axes();
    let (along, beside) = ((axes * given).normalize(), (axes * second).normalize());
    let none = Vector3::zeros();
    [
        (
            "revolute",
            json!({"direction": array(given)}),
            none,
            along * 1.3,
        ),
        (
            "point_on_line",
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
            "constant_velocity",
            json!({"direction": array(given), "second_direction": array(bent)}),
            none,
            (along + (axes * bent).normalize()).cross(&beside) * 0.9,
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
            axes.column(0).into_owned() * 0.5,
            axes.column(1).into_owned() * 1.2,
        ),
    ]
}

/// Bodies at the ends of clamped rods move as their joints let them, from the start on, and the rods stay at rest.
fn joined(element: &'static str) -> Specimen {
    let joints = motions();
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

/// What a clamp holds is all that acts, on the section that it holds too: weight, a mass with its weight, forces and moments there and at
/// the tip. Rods are so stiff that they keep their shape, to 3e-6 m.
fn clamped(element: &'static str) -> Specimen {
    let (root, way) = (Vector3::new(0.3, -0.2, 0.5), Vector3::new(0.6, 0.3, -0.4));
    let gravity = Vector3::new(0.4, -1.1, -3.0);
    let (area, density, lump) = (2e-3, 700.0, 0.35);
    let mut section =
        json!({"area": area, "second_moments": [3e-7, 7e-7], "torsion_constant": 5e-7});
    if element == "beam" {
        section["shear_factors"] = json!([0.8, 0.8]);
    }
    let rod = json!({"name": "rod", "element": element, "elements": 2, "axial": "waves",
        "material": {"youngs_modulus": 4e11, "shear_modulus": 1e11, "density": density}, "section": section,
        "axis": AXIS, "shape": {"line": {"from": array(root), "to": array(root + way)}},
        "markers": {"root": 0.0, "tip": 1.0}});
    let forces = [Vector3::new(1.3, 0.4, -0.9), Vector3::new(-0.7, 2.1, 0.8)];
    let moments = [Vector3::new(0.2, -0.5, 0.3), Vector3::new(0.6, 0.1, -0.4)];
    let mut loads = Vec::new();
    for (k, marker) in ["rod.root", "rod.tip"].into_iter().enumerate() {
        loads.push(json!({"name": format!("push{k}"), "kind": "force", "marker": marker, "value": array(forces[k])}));
        loads.push(json!({"name": format!("turn{k}"), "kind": "moment", "marker": marker, "value": array(moments[k])}));
    }
    let scene = json!({"name": "clamped", "dimension": 3, "gravity": array(gravity), "bodies": [rod], "loads": loads,
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.root"]}],
        "masses": [{"marker": "rod.root", "mass": lump}],
        "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-9},
        "outputs": [{"kind": "reaction", "joint": "wall"}, {"kind": "reaction_moment", "joint": "wall"}]});
    let weight = gravity * (density * area * way.norm());
    let force = forces[0] + forces[1] + weight + gravity * lump;
    let moment = moments[0] + moments[1] + way.cross(&forces[1]) + (way * 0.5).cross(&weight);
    let title = match element {
        "rod" => "clamped rod",
        _ => "clamped beam",
    };
    let mut specimen = Specimen::new(title, scene);
    for k in 0..3 {
        let of = |key: &str| format!("wall.{key}[{}]", k + 1);
        specimen = specimen
            .claim_within(&of("reaction"), "N", -force[k], 2e-5)
            .claim_within(&of("reaction_moment"), "N.m", -moment[k], 2e-5);
    }
    specimen
}
