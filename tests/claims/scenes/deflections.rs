//! Deflections: those of a cantilever under a small force across its end and along it, `F L^3 / 3EI` and `F L / EA` from the frame at its
//! root. From the mean of the body, its best straight line and half of its lengthening are taken away: of `F (3 L s^2 - s^3) / 6EI` the
//! line `F L^2 (2.1 s - 0.3 L) / 6EI` leaves `F L^3 / 30EI` at the end. Rotation as a rigid body makes none.

use std::f64::consts::PI;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::space::array;
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    let mut all: Vec<Specimen> = ["cable", "rod", "beam"].map(loaded).into();
    all.extend(["cable", "beam"].map(carried));
    all
}

const YOUNG: f64 = 1.0e6;
/// So small that lengthening counts beside bending.
const AREA: f64 = 1.0e-5;
const MOMENTS: [f64; 2] = [2.0e-6, 1.0e-6];
const LENGTH: f64 = 1.2;
/// Along the body and along both axes of its section, N: so small that deflections are linear in them, to 1e-4.
const FORCES: [f64; 3] = [2.0e-4, 3.0e-4, -5.0e-4];

/// A straight body on axes of its own, in space.
fn line(element: &str, [along, first, _]: [Vector3<f64>; 3], from: Vector3<f64>) -> Value {
    let section = match element {
        "cable" => json!({"area": AREA, "second_moment": MOMENTS[1]}),
        "rod" => json!({"area": AREA, "second_moments": MOMENTS, "torsion_constant": 3e-6}),
        _ => {
            json!({"area": AREA, "second_moments": MOMENTS, "torsion_constant": 3e-6, "shear_factors": [1e4, 1e4]})
        }
    };
    let mut body = json!({"name": "line", "element": element, "elements": 8, "axial": "waves",
        "material": {"youngs_modulus": YOUNG, "density": 700.0}, "section": section,
        "shape": {"line": {"from": array(from), "to": array(from + along * LENGTH)}},
        "markers": {"root": 0.0, "middle": 0.5, "tip": 1.0}});
    if element != "cable" {
        body["material"]["shear_modulus"] = json!(4.0e5);
        body["axis"] = json!(array(first));
    }
    body
}

/// Axes: along a body, and of its section.
fn axes() -> [Vector3<f64>; 3] {
    let along = Vector3::new(2.0, -1.0, 2.0) / 3.0;
    let first = Vector3::new(2.0, 2.0, -1.0) / 3.0;
    [along, first, along.cross(&first)]
}

fn read() -> Value {
    json!([{"kind": "deflection", "marker": "line.tip", "from": "line.root"}, {"kind": "deflection", "marker": "line.tip"}])
}

fn loaded(element: &str) -> Specimen {
    let [along, first, second] = axes();
    let sum = |parts: [f64; 3]| along * parts[0] + first * parts[1] + second * parts[2];
    let scene = json!({"name": "deflection", "dimension": 3, "gravity": [0.0, 0.0, 0.0],
        "bodies": [line(element, axes(), Vector3::new(0.3, 0.1, -0.2))],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "line.root"]}],
        "loads": [{"name": "push", "kind": "force", "marker": "line.tip", "value": array(sum(FORCES))}],
        "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-10}, "outputs": read()});
    // Along the first axis a body bends about the second.
    let moments = if element == "cable" {
        [MOMENTS[1]; 2]
    } else {
        [MOMENTS[1], MOMENTS[0]]
    };
    let bent = |k: usize| FORCES[k + 1] * LENGTH.powi(3) / (YOUNG * moments[k]);
    let longer = FORCES[0] * LENGTH / (YOUNG * AREA);
    let from_root = sum([longer, bent(0) / 3.0, bent(1) / 3.0]);
    let from_mean = sum([0.5 * longer, bent(0) / 30.0, bent(1) / 30.0]);
    let name = Box::leak(format!("deflected {element}").into_boxed_str());
    let mut specimen = Specimen::new(name, scene);
    for (of, value) in [
        ("deflection_from_root", from_root),
        ("deflection", from_mean),
    ] {
        for k in 0..3 {
            let within = 2e-3 * value.norm();
            specimen =
                specimen.claim_within(&format!("line.tip.{of}[{}]", k + 1), "m", value[k], within);
        }
    }
    specimen
}

/// A body in the plane that is driven around by its root so slowly that it stays as it was drawn, and so stiff.
fn carried(element: &str) -> Specimen {
    let mut body = line(
        element,
        [Vector3::new(0.6, 0.8, 0.0), Vector3::z(), Vector3::x()],
        Vector3::zeros(),
    );
    if let Some(keys) = body.as_object_mut() {
        keys.remove("axis");
    }
    let plane = |v: [f64; 3]| json!([v[0], v[1]]);
    body["shape"]["line"] =
        json!({"from": plane([0.0; 3]), "to": plane([0.6 * LENGTH, 0.8 * LENGTH, 0.0])});
    body["section"] = json!({"area": 1e-3, "second_moment": MOMENTS[1]});
    if element == "beam" {
        body["section"]["shear_factor"] = json!(1.0);
    }
    body["material"]["damping_time"] = json!(0.1);
    let scene = json!({"name": "carried", "dimension": 2, "gravity": [0.0, 0.0], "bodies": [body],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "line.root"]}],
        "motions": [{"name": "drive", "kind": "angle", "joint": "pin",
                     "value": {"table": [[0.0, 0.0], [20.0, 0.75 * PI]]}}],
        "accuracy": {"relative_tolerance": 1e-9}, "outputs": read()});
    let name = Box::leak(format!("carried {element}").into_boxed_str());
    let mut specimen = Specimen::new(name, scene).at(60.0);
    for of in ["deflection_from_root", "deflection"] {
        for k in 1..=2 {
            specimen = specimen.claim_within(&format!("line.tip.{of}[{k}]"), "m", 0.0, 1e-6);
        }
    }
    specimen
}
