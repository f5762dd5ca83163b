//! Small motions of rigid bodies in space.

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::space::array;
use super::space_joints::{AXIS, axis, body};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![torsion(), swinging(), damped(), moored()]
}

/// A body on a spring about an axis of no symmetry swings at `sqrt(k / n.J n)`.
fn torsion() -> Specimen {
    let (body, n, stiffness) = (body("plate"), axis(), 12.0);
    let point = body.place + Vector3::new(0.02, 0.05, -0.03);
    let scene = json!({"name": "torsion", "dimension": 3, "bodies": [body.described(Value::Null)],
        "joints": [{"name": "wire", "kind": "revolute", "markers": ["ground", "plate.c"], "direction": AXIS,
                    "stiffness": stiffness, "point": array(point)}],
        "outputs": [{"kind": "natural_frequency", "count": 1}]});
    let frequency = (stiffness / n.dot(&(body.tensor() * n))).sqrt();
    Specimen::new("torsion", scene).claim("natural_frequency[1]", "rad/s", frequency)
}

/// A physical pendulum at rest swings at `sqrt(m g l / J)`, with the inertia about its axis.
fn swinging() -> Specimen {
    let (mut bar, n) = (body("bar"), Vector3::new(0.0, 0.6, 0.8));
    // Below its axis.
    bar.axes = Matrix3::identity();
    bar.place = Vector3::zeros();
    let r = n.cross(&Vector3::new(0.7, 0.0, 0.0));
    let down = r - n * n.dot(&r);
    let gravity = down * (9.0 / down.norm());
    let (mut described, arm) = (bar.described(Value::Null), down);
    described["markers"]["p"] = json!(array(-arm));
    let scene = json!({"name": "swinging", "dimension": 3, "gravity": array(gravity), "bodies": [described],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "bar.p"], "direction": array(n)}],
        "outputs": [{"kind": "natural_frequency", "count": 1}]});
    let inertia = n.dot(&(bar.tensor() * n)) + bar.mass * arm.norm_squared();
    let frequency = (bar.mass * 9.0 * arm.norm() / inertia).sqrt();
    Specimen::new("swinging", scene).claim("natural_frequency[1]", "rad/s", frequency)
}

/// The body on a spring with a damper about an axis of no symmetry: `s^2 J + s d + k = 0`.
fn damped() -> Specimen {
    let (body, n, [stiffness, damping]) = (body("plate"), axis(), [12.0, 0.5]);
    let scene = json!({"name": "damped", "dimension": 3, "bodies": [body.described(Value::Null)],
        "joints": [{"name": "wire", "kind": "revolute", "markers": ["ground", "plate.c"], "direction": AXIS,
                    "stiffness": stiffness, "damping": damping}],
        "outputs": [{"kind": "eigenvalue", "count": 1}]});
    let inertia = n.dot(&(body.tensor() * n));
    let decay = 0.5 * damping / inertia;
    Specimen::new("damped in space", scene)
        .claim("eigenvalue.decay_rate[1]", "1/s", decay)
        .claim(
            "eigenvalue.frequency[1]",
            "rad/s",
            (stiffness / inertia - decay * decay).sqrt(),
        )
}

/// A free body at the middle between two springs along its first axis, pulled by `f` from points `a` away on either side:
/// across the axis each is a string of stiffness `f / l` with the length `l`, so that the body swings sideways at
/// `sqrt(2 f / (m l))`, along it at `sqrt(2 k / m)`, and about the axes across at `sqrt(2 f a (a + l) / (l J))`. About the
/// axis itself nothing holds it.
fn moored() -> Specimen {
    let (mut body, [arm, length, stiffness, rest]) = (body("buoy"), [0.4, 0.5, 60.0, 0.35]);
    body.inertia = Matrix3::from_diagonal(&Vector3::new(0.5, 0.8, 1.0));
    let along = body.axes.column(0).into_owned();
    let mut described = body.described(Value::Null);
    described["markers"] = json!({"left": [-arm, 0.0, 0.0], "right": [arm, 0.0, 0.0]});
    let spring = |name: &str, sign: f64| {
        let point = body.place + along * (sign * (arm + length));
        json!({"name": format!("spring_{name}"), "kind": "spring_damper",
               "markers": ["ground", format!("buoy.{name}")], "point": array(point), "stiffness": stiffness,
               "length": rest})
    };
    let scene = json!({"name": "moored", "dimension": 3, "bodies": [described],
        "loads": [spring("left", -1.0), spring("right", 1.0)],
        "outputs": [{"kind": "natural_frequency", "count": 6}]});
    let force = stiffness * (length - rest);
    let turning = 2.0 * force * arm * (arm + length) / length;
    let sideways = 2.0 * force / (length * body.mass);
    let mut squares = [
        0.0,
        sideways,
        sideways,
        2.0 * stiffness / body.mass,
        turning / 0.8,
        turning / 1.0,
    ];
    squares.sort_by(f64::total_cmp);
    let mut specimen = Specimen::new("moored", scene);
    for (k, square) in squares.into_iter().enumerate() {
        let within = if square == 0.0 { 1e-6 } else { 1e-8 };
        let of = format!("natural_frequency[{}]", k + 1);
        specimen = specimen.claim_within(&of, "rad/s", square.sqrt(), within);
    }
    specimen
}
