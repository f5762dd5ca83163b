//! Stress at points of sections.

use std::f64::consts::PI;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::space::array;
use super::{cross, dot, sum, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![plane(), solids("rod"), solids("beam"), stepped()]
}

/// So stiff that bodies keep their shape, to 2e-6.
const YOUNG: f64 = 4.0e14;
const LENGTH: f64 = 0.8;
const DENSITY: f64 = 700.0;
/// How closely stresses are claimed.
const WITHIN: f64 = 2e-6;

fn claim(specimen: Specimen, of: &str, value: f64) -> Specimen {
    specimen.claim_within(of, "Pa", value, WITHIN * value.abs())
}

/// A cantilever in the plane under a force and a moment at its tip, of a height that falls along it: `N / A - M y / I`.
fn plane() -> Specimen {
    let (from, angle) = ([0.2, -0.3], 0.6);
    let along = turned(angle, [1.0, 0.0]);
    let (force, moment) = ([3.0, 1.7], 0.9);
    let (width, heights) = (0.02, [0.05, 0.03]);
    let section = |height: f64| json!({"shape": {"rectangle": {"width": width, "height": height}}});
    let body = json!({"name": "boom", "element": "cable", "elements": 4, "model": "flexible",
        "material": {"youngs_modulus": YOUNG, "density": DENSITY},
        "stations": [{"at": 0.0, "section": section(heights[0])}, {"at": 1.0, "section": section(heights[1])}],
        "shape": {"line": {"from": from, "to": sum(from, times(LENGTH, along))}},
        "markers": {"root": 0.0, "mid": 0.4, "tip": 1.0}});
    let points = [[0.02], [-0.013]];
    let outputs = ["root", "mid", "tip"].map(
        |marker| json!({"kind": "stress", "marker": format!("boom.{marker}"), "points": points}),
    );
    let scene = json!({"name": "stress", "dimension": 2, "bodies": [body], "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-9},
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "boom.root"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "boom.tip", "value": force},
                  {"name": "turn", "kind": "moment", "marker": "boom.tip", "value": moment}],
        "outputs": outputs});
    let mut specimen = Specimen::new("stress in a cable", scene);
    for (marker, s) in [("root", 0.0), ("mid", 0.4), ("tip", 1.0)] {
        let height = heights[0] + s * (heights[1] - heights[0]);
        let (area, second) = (width * height, width * height.powi(3) / 12.0);
        let arm = times((1.0 - s) * LENGTH, along);
        let bending = moment + cross(arm, force);
        for (k, [left]) in points.iter().enumerate() {
            let stress = dot(force, along) / area - bending * left / second;
            specimen = claim(
                specimen,
                &format!("boom.{marker}.stress[{}]", k + 1),
                stress,
            );
        }
    }
    specimen
}

/// A section of these lengths: area, second moments about the first and the second axis, and stress by torque of the points below.
type Claimed = (f64, [f64; 2], [f64; 2]);

const POINTS: [[f64; 2]; 2] = [[0.012, 0.0], [0.004, -0.009]];

/// Shapes by their names, with what follows from them.
fn shapes() -> [(&'static str, Value, Claimed); 4] {
    let round = |a: f64, b: f64| {
        let (outer, inner) = (a.powi(4), b.powi(4));
        let polar = 0.5 * PI * (outer - inner);
        let stresses = POINTS.map(|[y, z]| y.hypot(z) / polar);
        (PI * (a * a - b * b), [0.5 * polar; 2], stresses)
    };
    let ellipse = || {
        let (a, b) = (0.013_f64, 0.02_f64);
        let area = PI * a * b;
        // Timoshenko and Goodier, section 107.
        let stress = |[y, z]: [f64; 2]| {
            let polar = [
                2.0 * z / (PI * a * b.powi(3)),
                2.0 * y / (PI * a.powi(3) * b),
            ];
            polar[0].hypot(polar[1])
        };
        (
            area,
            [b, a].map(|half| 0.25 * area * half * half),
            POINTS.map(stress),
        )
    };
    let rectangle = || {
        // Section 109, by sums of 200 terms; the first point is in the middle of a longer edge.
        let (a, b) = (0.012_f64, 0.03_f64);
        let odd = || (0..200).map(|k| (f64::from(2 * k + 1), f64::from(1 - 2 * (k % 2))));
        let ratio = 0.5 * PI / a;
        let lost: f64 = odd().map(|(n, _)| (n * ratio * b).tanh() / n.powi(5)).sum();
        let constant = 16.0 * a.powi(3) * b / 3.0 * (1.0 - 192.0 / PI.powi(5) * a / b * lost);
        let stress = |[y, z]: [f64; 2]| {
            let series = |of: &dyn Fn(f64) -> f64| -> f64 {
                odd().map(|(n, sign)| sign * of(n * ratio) / (n * n)).sum()
            };
            let along = series(&|n| (n * z).cosh() / (n * b).cosh().min(1e300) * (n * y).sin());
            let across = series(&|n| (n * z).sinh() / (n * b).cosh().min(1e300) * (n * y).cos());
            let size = 16.0 * a / (PI * PI);
            (2.0 * y - size * along).hypot(size * across) / constant
        };
        let area = 4.0 * a * b;
        (
            area,
            [b, a].map(|half| area * half * half / 3.0),
            POINTS.map(stress),
        )
    };
    [
        ("circle", json!({"radius": 0.016}), round(0.016, 0.0)),
        (
            "tube",
            json!({"radius": 0.02, "inner_radius": 0.008}),
            round(0.02, 0.008),
        ),
        (
            "ellipse",
            json!({"width": 0.026, "height": 0.04}),
            ellipse(),
        ),
        (
            "rectangle",
            json!({"width": 0.024, "height": 0.06}),
            rectangle(),
        ),
    ]
}

/// The axes of a section along a way: tangent, first axis, second.
fn axes(way: Vector3<f64>, axis: Vector3<f64>) -> [Vector3<f64>; 3] {
    let tangent = way.normalize();
    let first = (axis - tangent * tangent.dot(&axis)).normalize();
    [tangent, first, tangent.cross(&first)]
}

/// Cantilevers in space under a force and a moment at their tips: `N / A + M1 z / I1 - M2 y / I2`, and by torque.
fn solids(element: &'static str) -> Specimen {
    let way = Vector3::new(0.6, 0.3, -0.4);
    let axis = Vector3::new(0.2, 0.9, 0.3);
    let (force, moment) = (Vector3::new(12.0, -7.0, 9.0), Vector3::new(2.0, 3.0, -4.0));
    let (mut bodies, mut joints, mut loads, mut outputs) = (vec![], vec![], vec![], vec![]);
    for (k, (shape, lengths, _)) in shapes().into_iter().enumerate() {
        let from = Vector3::new(0.0, k as f64, 0.0);
        let tip = format!("{shape}.tip");
        bodies.push(
            json!({"name": shape, "element": element, "elements": 2, "axial": "waves",
            "material": {"youngs_modulus": YOUNG, "shear_modulus": 0.4 * YOUNG, "density": DENSITY},
            "section": {"shape": {shape: lengths}}, "axis": array(axis),
            "shape": {"line": {"from": array(from), "to": array(from + way)}},
            "markers": {"root": 0.0, "mid": 0.4, "tip": 1.0}}),
        );
        joints.push(json!({"name": format!("wall_{shape}"), "kind": "weld",
            "markers": ["ground", format!("{shape}.root")]}));
        loads.push(json!({"name": format!("pull_{shape}"), "kind": "force", "marker": tip, "value": array(force)}));
        loads.push(json!({"name": format!("turn_{shape}"), "kind": "moment", "marker": tip, "value": array(moment)}));
        for marker in ["root", "mid"] {
            let marker = format!("{shape}.{marker}");
            outputs.push(json!({"kind": "stress", "marker": marker, "points": POINTS}));
            outputs.push(json!({"kind": "torsion_stress", "marker": marker, "points": POINTS}));
        }
    }
    let scene = json!({"name": "stress", "dimension": 3, "bodies": bodies, "joints": joints, "loads": loads,
        "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-9}, "outputs": outputs});
    let title = match element {
        "rod" => "stress in rods",
        _ => "stress in beams",
    };
    let mut specimen = Specimen::new(title, scene);
    let [tangent, first, second] = axes(way, axis);
    for (shape, _, (area, moments, by_torque)) in shapes() {
        for (marker, s) in [("root", 0.0), ("mid", 0.4)] {
            let bending = moment + (way * (1.0 - s)).cross(&force);
            let [about_first, about_second] = [first, second].map(|axis| axis.dot(&bending));
            for (k, [y, z]) in POINTS.into_iter().enumerate() {
                let stress = tangent.dot(&force) / area + about_first * z / moments[0]
                    - about_second * y / moments[1];
                let of = |kind: &str| format!("{shape}.{marker}.{kind}[{}]", k + 1);
                specimen = claim(specimen, &of("stress"), stress);
                let torque = tangent.dot(&moment);
                specimen = claim(specimen, &of("torsion_stress"), torque * by_torque[k]);
            }
        }
    }
    specimen
}

/// At a step of the section stress is that after it; sections by numbers, and a force along the line and a moment across it.
fn stepped() -> Specimen {
    let (force, moment) = (40.0, 3.0);
    let section = |area: f64, second: f64| json!({"area": area, "second_moments": [second, 2.0 * second], "torsion_constant": 2e-8});
    let body = json!({"name": "rod", "element": "rod", "elements": 3, "axial": "waves",
        "material": {"youngs_modulus": YOUNG, "shear_modulus": 0.4 * YOUNG, "density": DENSITY},
        "stations": [{"at": 0.0, "section": section(4e-4, 4e-8)}, {"at": 0.5, "section": section(4e-4, 4e-8)},
                     {"at": 0.5, "section": section(2e-4, 1e-8)}, {"at": 1.0, "section": section(2e-4, 1e-8)}],
        "axis": [0.0, 0.0, 1.0], "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [LENGTH, 0.0, 0.0]}},
        "markers": {"root": 0.0, "step": 0.5, "tip": 1.0}});
    let scene = json!({"name": "stress", "dimension": 3, "bodies": [body], "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-9},
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.root"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "rod.tip", "value": [force, 0.0, 0.0]},
                  {"name": "turn", "kind": "moment", "marker": "rod.tip", "value": [0.0, moment, moment]}],
        "outputs": [{"kind": "stress", "marker": "rod.root", "points": [[0.01, 0.02]]},
                    {"kind": "stress", "marker": "rod.step", "points": [[0.01, 0.02]]}]});
    // The first axis is z, the second -y.
    let stress = |area: f64, second: f64| {
        force / area + moment * 0.02 / second + moment * 0.01 / (2.0 * second)
    };
    let specimen = Specimen::new("stress at a step", scene);
    let specimen = claim(specimen, "rod.root.stress[1]", stress(4e-4, 4e-8));
    claim(specimen, "rod.step.stress[1]", stress(2e-4, 1e-8))
}
