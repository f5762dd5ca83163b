//! What happens between the points of a table, of a load and of a motion.

use serde_json::{Value, json};

use super::times;
use crate::claims::specimen::Specimen;

/// Time of the start, s.
const T: f64 = 0.3;
/// Times and values of the points.
const POINTS: [[f64; 2]; 2] = [[0.1, 1.2], [0.9, 2.8]];

pub fn all() -> Vec<Specimen> {
    vec![forces(), ways()]
}

/// A table in all forms but the plain one.
fn tables() -> [Value; 3] {
    [
        json!({"table": POINTS, "interpolation": "linear"}),
        json!({"table": POINTS, "interpolation": "spline"}),
        json!({"table": POINTS, "interpolation": "spline", "slopes": [0.5, -1.0]}),
    ]
}

/// Value and rate of the cubic with these slopes at both points (Hermite).
fn cubic([first, last]: [f64; 2]) -> [f64; 2] {
    let [[t0, y0], [t1, y1]] = POINTS;
    let (h, s) = (t1 - t0, (T - t0) / (t1 - t0));
    let value = y0 * (1.0 - 3.0 * s * s + 2.0 * s.powi(3))
        + y1 * (3.0 * s * s - 2.0 * s.powi(3))
        + h * first * (s - 2.0 * s * s + s.powi(3))
        + h * last * (s.powi(3) - s * s);
    let rate = (y1 - y0) / h * (6.0 * s - 6.0 * s * s)
        + first * (1.0 - 4.0 * s + 3.0 * s * s)
        + last * (3.0 * s * s - 2.0 * s);
    [value, rate]
}

/// Value and rate of each of the tables at the start.
fn expected() -> [[f64; 2]; 3] {
    [[1.6, 2.0], cubic([0.0, 0.0]), cubic([0.5, -1.0])]
}

fn bead(name: &str, y: f64) -> Value {
    json!({"element": "rigid", "name": name, "mass": 1.6, "inertia": 0.0, "position": [1.0, y],
           "markers": {"c": [0.0, 0.0]}})
}

fn forces() -> Specimen {
    let names = ["a", "b", "d"];
    let loads = names.iter().zip(tables()).map(|(of, table)| {
        json!({"name": format!("pull_{of}"), "kind": "force", "marker": format!("{of}.c"), "value": [table, 0.0]})
    });
    let output = |of: &&str| json!({"kind": "acceleration", "marker": format!("{of}.c")});
    let scene = json!({
        "name": "listed_forces", "dimension": 2,
        "bodies": [bead("a", 0.0), bead("b", 1.0), bead("d", 2.0)],
        "loads": loads.collect::<Vec<_>>(), "outputs": names.iter().map(output).collect::<Vec<_>>()});
    let mut specimen = Specimen::new("listed_forces", scene).from(T);
    for (of, [force, _]) in names.iter().zip(expected()) {
        specimen = specimen.claim(&format!("{of}.c.acceleration[1]"), "m/s2", force / 1.6);
    }
    specimen
}

fn ways() -> Specimen {
    let names = ["a", "b", "d"];
    let joint = |of: &&str| {
        json!({"name": format!("guide_{of}"), "kind": "point_on_line", "markers": ["ground", format!("{of}.c")],
               "point": [0.0, 0.0], "direction": [0.6, 0.8]})
    };
    let motions = names.iter().zip(tables()).map(|(of, table)| {
        json!({"name": format!("drive_{of}"), "kind": "displacement", "joint": format!("guide_{of}"), "value": table})
    });
    let outputs = names.iter().flat_map(|of| {
        ["position", "velocity"].map(|kind| json!({"kind": kind, "marker": format!("{of}.c")}))
    });
    let scene = json!({
        "name": "listed_ways", "dimension": 2,
        "bodies": [bead("a", 0.0), bead("b", 1.0), bead("d", 2.0)],
        "joints": names.iter().map(joint).collect::<Vec<_>>(), "motions": motions.collect::<Vec<_>>(),
        "outputs": outputs.collect::<Vec<_>>()});
    let mut specimen = Specimen::new("listed_ways", scene).from(T);
    for (of, [way, rate]) in names.iter().zip(expected()) {
        specimen = specimen
            .vector(&format!("{of}.c.position"), "m", times(way, [0.6, 0.8]))
            .vector(&format!("{of}.c.velocity"), "m/s", times(rate, [0.6, 0.8]));
    }
    specimen
}
