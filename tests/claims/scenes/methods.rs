//! Initial states, integrators and natural frequencies.

use serde_json::{Value, json};

use super::times;
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    let mut all: Vec<Specimen> = ["radau", "rk4", "dopri853", "verlet", "rkn43", "rkn64"]
        .map(thrown)
        .into();
    all.extend([
        element(),
        automatic(),
        loose(),
        settled(),
        unsettled(),
        frequencies(),
        eigenvalues(),
        eigenvalues_of_a_body(),
        frequencies_of_a_body(),
    ]);
    all
}

fn stone(gravity: [f64; 2]) -> Value {
    json!({
        "name": "thrown", "dimension": 2, "gravity": gravity,
        "bodies": [{"element": "rigid", "name": "stone", "mass": 0.4, "inertia": 0.0, "position": [0.1, 0.2],
                    "motion": {"velocity": [2.0, 5.0]}, "markers": {"c": [0.0, 0.0]}}],
        "outputs": [{"kind": "position", "marker": "stone.c"}]})
}

/// Every method throws a stone exactly, and says its name.
fn thrown(integrator: &'static str) -> Specimen {
    let g = [0.3, -9.0];
    let mut scene = stone(g);
    scene["method"] = json!({"integrator": integrator});
    let t = 0.5;
    let place = super::sum([0.1 + 2.0 * t, 0.2 + 5.0 * t], times(0.5 * t * t, g));
    Specimen::new(integrator, scene)
        .at(t)
        .vector("stone.c.position", "m", place)
        .fact("method", integrator)
}

/// A stone is soft: of the methods that may be chosen it takes the one of order 4 without rates.
fn automatic() -> Specimen {
    let mut scene = stone([0.0, -9.0]);
    scene["method"] = json!({"integrator": "auto"});
    Specimen::new("automatic", scene)
        .at(0.5)
        .claim("stone.c.position[2]", "m", 0.2 + 2.5 - 9.0 * 0.125)
        .fact("method", "rkn43")
}

/// At a loose tolerance it takes the one of order 2.
fn loose() -> Specimen {
    let mut scene = stone([0.0, -9.0]);
    scene["accuracy"] = json!({"relative_tolerance": 0.01});
    Specimen::new("loose", scene)
        .at(0.5)
        .claim("stone.c.position[2]", "m", 0.2 + 2.5 - 9.0 * 0.125)
        .fact("method", "verlet")
}

/// The slowest bending of one free element, in which the curvature is uniform and the velocity a Legendre
/// polynomial of degree 2: `w^2 = 720 EI / (rho A L^4)` with the consistent mass, half of it with the
/// corrected one, in which this part counts twice (docs/decisions/0012-mass-against-dispersion.md).
fn element() -> Specimen {
    let scene = json!({
        "name": "element", "dimension": 2,
        "bodies": [{"element": "cable", "name": "rod", "elements": 1,
                    "material": {"youngs_modulus": 1e6, "density": 500.0},
                    "section": {"area": 4e-3, "second_moment": 1e-6},
                    "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.0]}}}],
        "outputs": [{"kind": "natural_frequency", "count": 4}],
        "method": {"integrator": "rk4"}});
    // After three rigid motions.
    let exact: f64 = 360.0 * 1.0 / 2.0;
    Specimen::new("element", scene).claim("natural_frequency[4]", "rad/s", exact.sqrt())
}

fn lever(initial: &str) -> Value {
    json!({
        "name": "lever", "dimension": 2, "initial": initial,
        "bodies": [{"element": "rigid", "name": "arm", "mass": 2.0, "inertia": 0.5, "position": [0.0, 0.0],
                    "angle": 0.2, "markers": {"c": [0.0, 0.0]}}],
        "joints": [{"name": "hinge", "kind": "revolute", "markers": ["ground", "arm.c"], "stiffness": 4.0, "angle": 0.1}],
        "loads": [{"name": "twist", "kind": "moment", "marker": "arm.c", "value": 3.2}],
        "outputs": [{"kind": "angle", "marker": "arm.c"}]})
}

/// A lever on a spring comes to rest where the spring holds the moment; or starts where it is.
fn settled() -> Specimen {
    Specimen::new("settled", lever("static_equilibrium")).claim(
        "arm.c.angle",
        "rad",
        0.1 + 3.2 / 4.0,
    )
}

fn unsettled() -> Specimen {
    Specimen::new("unsettled", lever("undeformed")).claim("arm.c.angle", "rad", 0.2)
}

/// Two levers on springs of their own.
fn frequencies() -> Specimen {
    let arm = |name: &str, y: f64, inertia: f64| {
        json!({"element": "rigid", "name": name, "mass": 2.0, "inertia": inertia, "position": [0.0, y],
               "markers": {"c": [0.0, 0.0]}})
    };
    let hinge = |name: &str, of: &str, stiffness: f64| json!({"name": name, "kind": "revolute", "markers": ["ground", of], "stiffness": stiffness});
    let scene = json!({
        "name": "frequencies", "dimension": 2, "bodies": [arm("a", 0.0, 0.5), arm("b", 1.0, 0.2)],
        "joints": [hinge("stiff", "b.c", 20.0), hinge("soft", "a.c", 4.5)],
        "outputs": [{"kind": "natural_frequency", "count": 2}]});
    Specimen::new("frequencies", scene)
        .fact("variables", 15)
        .claim("natural_frequency[1]", "rad/s", 3.0)
        .claim("natural_frequency[2]", "rad/s", 10.0)
}

/// A lever on a spring with a damper: `J s^2 + d s + k = 0`.
fn damped(name: &str, y: f64, [inertia, stiffness, damping]: [f64; 3]) -> [Value; 2] {
    [
        json!({"element": "rigid", "name": name, "mass": 2.0, "inertia": inertia, "position": [0.0, y],
               "markers": {"c": [0.0, 0.0]}}),
        json!({"name": format!("{name}_hinge"), "kind": "revolute", "markers": ["ground", format!("{name}.c")],
               "stiffness": stiffness, "damping": damping}),
    ]
}

/// Decay rate and frequency of such a lever.
fn root([inertia, stiffness, damping]: [f64; 3]) -> [f64; 2] {
    let decay = 0.5 * damping / inertia;
    [decay, (stiffness / inertia - decay * decay).sqrt()]
}

fn eigenvalues() -> Specimen {
    let (slow, fast, faster) = ([0.5, 4.5, 0.3], [0.2, 20.0, 1.0], [0.1, 40.0, 0.2]);
    let [[a, of_a], [b, of_b], [c, of_c]] = [
        damped("a", 0.0, fast),
        damped("b", 1.0, slow),
        damped("c", 2.0, faster),
    ];
    let scene = json!({
        "name": "eigenvalues", "dimension": 2, "bodies": [a, b, c], "joints": [of_a, of_b, of_c],
        "outputs": [{"kind": "eigenvalue", "count": 2}]});
    let [first, second] = [root(slow), root(fast)];
    Specimen::new("eigenvalues", scene)
        .fact("variables", 21)
        .claim("eigenvalue.decay_rate[1]", "1/s", first[0])
        .claim("eigenvalue.frequency[1]", "rad/s", first[1])
        .claim("eigenvalue.decay_rate[2]", "1/s", second[0])
        .claim("eigenvalue.frequency[2]", "rad/s", second[1])
}

/// The same of one body, by its name.
fn eigenvalues_of_a_body() -> Specimen {
    let of = [0.5, 4.5, 0.3];
    let [body, joint] = damped("arm", 0.0, of);
    let scene = json!({
        "name": "eigenvalue", "dimension": 2, "bodies": [body], "joints": [joint],
        "outputs": [{"kind": "eigenvalue", "count": 1, "body": "arm"}]});
    let [decay, frequency] = root(of);
    Specimen::new("eigenvalue", scene)
        .claim("arm.eigenvalue.decay_rate[1]", "1/s", decay)
        .claim("arm.eigenvalue.frequency[1]", "rad/s", frequency)
}

/// Of a scene with one body, by its name: a pendulum that hangs.
fn frequencies_of_a_body() -> Specimen {
    let (m, j, l, g) = (2.0, 0.5, 0.6, 9.0);
    let scene = json!({
        "name": "hanging", "dimension": 2, "gravity": [0.0, -g],
        "bodies": [{"element": "rigid", "name": "bob", "mass": m, "inertia": j, "position": [0.0, -l],
                    "markers": {"pin": [0.0, l]}}],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "bob.pin"]}],
        "outputs": [{"kind": "natural_frequency", "count": 1, "body": "bob"}]});
    let square: f64 = m * g * l / (j + m * l * l);
    Specimen::new("hanging", scene).claim("bob.natural_frequency[1]", "rad/s", square.sqrt())
}
