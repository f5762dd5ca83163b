//! Where a simulation starts from: loads that act only while an equilibrium is looked for, steady rotations,
//! velocities of deformation.

use serde_json::{Value, json};

use super::{cross, sum, times, turned as turned_by};
use crate::claims::specimen::Specimen;

/// Time of the start, s.
const T: f64 = 0.3;

pub fn all() -> Vec<Specimen> {
    vec![
        levers(),
        beads(),
        bars(),
        turning(),
        turning_loaded(),
        let_go_turning(),
        deforming(),
    ]
}

/// A number, an expression and a table, and what they are at the start.
fn forms(number: f64) -> [(Value, f64); 3] {
    [
        (json!(number), number),
        (json!(format!("{number}+0.4*t")), number + 0.4 * T),
        (
            json!({"table": [[0.1, number], [0.9, number + 1.6]]}),
            number + 0.4,
        ),
    ]
}

const STIFFNESS: f64 = 4.0;
const REST: f64 = 0.1;
const INERTIA: f64 = 0.5;

/// Levers on springs of their own, rotated by moments, torques and a follower force, and let go.
fn levers() -> Specimen {
    let (mut bodies, mut joints, mut loads, mut outputs) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut expected = Vec::new();
    let mut lever = |name: &str, y: f64| {
        bodies.push(json!({"element": "rigid", "name": name, "mass": 2.0, "inertia": INERTIA, "position": [0.0, y],
                           "angle": 0.2, "markers": {"c": [0.0, 0.0], "p": [0.5, -0.2]}}));
        joints.push(json!({"name": format!("{name}_hinge"), "kind": "revolute", "markers": ["ground", format!("{name}.c")],
                           "stiffness": STIFFNESS, "angle": REST}));
        outputs.push(json!({"kind": "angle", "marker": format!("{name}.c")}));
        outputs.push(json!({"kind": "angular_acceleration", "marker": format!("{name}.c")}));
    };
    for (n, (value, size)) in forms(0.9).into_iter().enumerate() {
        let (m, t) = (format!("m{n}"), format!("t{n}"));
        lever(&m, n as f64);
        lever(&t, 5.0 + n as f64);
        loads.push(json!({"name": format!("twist{n}"), "kind": "moment", "marker": format!("{m}.c"), "value": value}));
        loads.push(json!({"name": format!("turn{n}"), "kind": "torque", "joint": format!("{t}_hinge"), "value": value}));
        expected.extend([(m, size), (t, size)]);
    }
    lever("f", 10.0);
    lever("free", 12.0);
    // A force that keeps its direction, of the size that holds the lever at this angle.
    let (angle, arm) = (0.25, [0.5, -0.2]);
    lever("d", 14.0);
    let dead = STIFFNESS * (angle - REST) / turned_by(angle, arm)[0];
    loads.push(json!({"name": "weight", "kind": "force", "marker": "d.p", "value": [0.0, dead]}));
    expected.push(("d".into(), STIFFNESS * (angle - REST)));
    let push = [0.6, 1.1];
    loads.push(
        json!({"name": "push", "kind": "force", "marker": "f.p", "follower": true, "value": push}),
    );
    expected.extend([("f".into(), cross([0.5, -0.2], push)), ("free".into(), 0.0)]);
    let scene = json!({"name": "levers", "dimension": 2, "bodies": bodies, "joints": joints, "outputs": outputs,
                       "initial": {"state": "static_equilibrium", "loads": loads}});
    let mut specimen = Specimen::new("levers", scene).from(T);
    for (name, moment) in expected {
        specimen = specimen
            .claim(&format!("{name}.c.angle"), "rad", REST + moment / STIFFNESS)
            .claim(
                &format!("{name}.c.angular_acceleration"),
                "rad/s2",
                -moment / INERTIA,
            );
    }
    specimen
}

/// Beads on springs without length, pulled aside and let go.
fn beads() -> Specimen {
    let k = 20.0;
    let (mut bodies, mut springs, mut loads, mut outputs) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut expected = Vec::new();
    let [x, y] = [forms(1.3), forms(-0.7)];
    for n in 0..3 {
        let point = [n as f64, 0.0];
        bodies.push(
            json!({"element": "rigid", "name": format!("b{n}"), "mass": 1.6, "inertia": 0.0,
                           "position": [n as f64 + 0.1, 0.1], "markers": {"c": [0.0, 0.0]}}),
        );
        springs.push(json!({"name": format!("s{n}"), "kind": "spring_damper", "markers": ["ground", format!("b{n}.c")],
                            "point": point, "stiffness": k, "length": 0.0}));
        loads.push(
            json!({"name": format!("pull{n}"), "kind": "force", "marker": format!("b{n}.c"),
                          "value": [x[n].0, y[n].0]}),
        );
        outputs.push(json!({"kind": "position", "marker": format!("b{n}.c")}));
        expected.push(sum(point, times(1.0 / k, [x[n].1, y[n].1])));
    }
    let scene = json!({"name": "beads", "dimension": 2, "bodies": bodies, "loads": springs, "outputs": outputs,
                       "initial": {"state": "static_equilibrium", "loads": loads}});
    let mut specimen = Specimen::new("beads", scene).from(T);
    for (n, place) in expected.into_iter().enumerate() {
        specimen = specimen.vector(&format!("b{n}.c.position"), "m", place);
    }
    specimen
}

/// Length of a bar, m, and its axial stiffness, N.
pub const LENGTH: f64 = 0.8;
pub const AXIAL: f64 = 200.0;

/// A bar from a point along a unit vector.
pub fn bar(name: &str, from: [f64; 2], along: [f64; 2], elements: u32) -> Value {
    json!({"element": "cable", "name": name, "elements": elements,
           "material": {"youngs_modulus": 4000.0, "density": 30.0},
           "section": {"area": AXIAL / 4000.0, "second_moment": 1e-3},
           "shape": {"line": {"from": from, "to": sum(from, times(LENGTH, along))}},
           "markers": {"root": 0.0, "quarter": 0.25, "middle": 0.5, "tip": 1.0}})
}

/// Bars that are pinned at one end and drawn along their line by a uniform load: the tip is `q L^2 / (2 EA)`
/// further out.
fn bars() -> Specimen {
    let along = [0.6, 0.8];
    let [x, y] = [forms(6.0), forms(8.0)];
    let (mut bodies, mut joints, mut loads, mut outputs) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut expected = Vec::new();
    for n in 0..3 {
        let from = [2.0 * n as f64, 0.0];
        bodies.push(bar(&format!("b{n}"), from, along, 2));
        joints.push(json!({"name": format!("pin{n}"), "kind": "revolute", "markers": ["ground", format!("b{n}.root")]}));
        loads.push(
            json!({"name": format!("wind{n}"), "kind": "distributed_force", "body": format!("b{n}"),
                          "value": [x[n].0, y[n].0]}),
        );
        outputs.push(json!({"kind": "position", "marker": format!("b{n}.tip")}));
        let q = x[n].1.hypot(y[n].1);
        let reach = LENGTH + 0.5 * q * LENGTH * LENGTH / AXIAL;
        expected.push(sum(from, times(reach / q, [x[n].1, y[n].1])));
    }
    let scene = json!({"name": "bars", "dimension": 2, "bodies": bodies, "joints": joints, "outputs": outputs,
                       "initial": {"state": "static_equilibrium", "loads": loads}});
    let mut specimen = Specimen::new("bars", scene).from(T);
    for (n, place) in expected.into_iter().enumerate() {
        specimen = specimen.vector_within(&format!("b{n}.tip.position"), "m", place, 1e-8);
    }
    specimen
}

/// A bar that is rotated about its end: `r = A sin(a s)`, `a = w sqrt(rho/E)`, and at the tip `EA (r' - 1) = F`.
fn turned(name: &'static str, initial: Value, force: f64) -> Specimen {
    let rate = 3.0;
    let mut body = bar("bar", [0.0, 0.0], [1.0, 0.0], 4);
    body["motion"] = json!({"spin": rate});
    let scene = json!({
        "name": name, "dimension": 2, "bodies": [body], "initial": initial,
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "bar.root"]}],
        "motions": [{"name": "drive", "kind": "angle", "marker": "bar.root", "value": format!("{rate}*t")}],
        "outputs": [{"kind": "position", "marker": "bar.tip"}, {"kind": "velocity", "marker": "bar.tip"}]});
    let a = rate * (30.0_f64 / 4000.0).sqrt();
    let reach = (1.0 + force / AXIAL) / (a * (a * LENGTH).cos()) * (a * LENGTH).sin();
    Specimen::new(name, scene)
        .vector_within("bar.tip.position", "m", [reach, 0.0], 1e-6)
        .vector_within("bar.tip.velocity", "m/s", [0.0, rate * reach], 1e-5)
}

fn turning() -> Specimen {
    turned("turning_bar", json!("steady"), 0.0)
}

fn turning_loaded() -> Specimen {
    let pull = json!({"name": "pull", "kind": "force", "marker": "bar.tip", "value": [12.0, 0.0]});
    turned(
        "turning_loaded",
        json!({"state": "steady", "loads": [pull]}),
        12.0,
    )
}

/// The same at the equilibrium at rest, from which it is let go with its spin: drawn by the force alone.
fn let_go_turning() -> Specimen {
    let pull = json!({"name": "pull", "kind": "force", "marker": "bar.tip", "value": [12.0, 0.0]});
    let initial = json!({"state": "static_equilibrium", "loads": [pull]});
    let mut specimen = turned("let_go_turning", initial, 12.0);
    specimen.claims.clear();
    let reach = LENGTH * (1.0 + 12.0 / AXIAL);
    specimen
        .vector_within("bar.tip.position", "m", [reach, 0.0], 1e-8)
        .claim_within("bar.tip.velocity[2]", "m/s", 3.0 * reach, 1e-7)
}

/// A velocity of deformation beside that of the body as a whole.
fn deforming() -> Specimen {
    let mut body = bar("bar", [0.2, 0.1], [1.0, 0.0], 2);
    body["motion"] =
        json!({"velocity": [0.1, 0.2], "spin": 0.5, "deformation": ["0.3*s^2", "0.2*s^2-0.1"]});
    let scene = json!({
        "name": "deforming", "dimension": 2, "bodies": [body],
        "outputs": [{"kind": "velocity", "marker": "bar.middle"}, {"kind": "velocity", "marker": "bar.tip"},
                    {"kind": "velocity", "marker": "bar.quarter"}]});
    // Between nodes the field goes on, a polynomial of degree 2.
    let quarter = [
        0.1 + 0.3 * 0.25 * 0.25,
        0.2 + 0.5 * 0.2 + 0.2 * 0.25 * 0.25 - 0.1,
    ];
    Specimen::new("deforming", scene)
        .vector("bar.quarter.velocity", "m/s", quarter)
        .vector("bar.middle.velocity", "m/s", [0.175, 0.2 + 0.2 - 0.05])
        .vector("bar.tip.velocity", "m/s", [0.4, 0.2 + 0.4 + 0.1])
}
