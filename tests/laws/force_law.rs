//! Forces by expressions against closed forms: drag, Duffing's oscillator, orbits, bump stops, actuators.

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::runs::{Run, is_near, settings, vector};

/// A body of 2 kg and 0.5 kg m^2 that moves at a velocity and spins, with a load and an input that sets its `u`, if it has one.
fn scene(
    (dimension, method): (usize, &str),
    joint: Value,
    ([velocity, spin], force): ([f64; 2], &str),
) -> Value {
    let (inertia, spin) = match dimension {
        2 => (json!(0.5), json!(spin)),
        _ => (json!([0.5, 0.5, 0.5]), json!([0.0, 0.0, spin])),
    };
    let zero = vector(dimension, [0.0, 0.0]);
    let inputs = if force.contains('u') {
        json!([{"kind": "control", "load": "law"}])
    } else {
        json!([])
    };
    let outputs = if joint["kind"] == "revolute" {
        json!([{"kind": "angle", "joint": "joint"}, {"kind": "angular_velocity", "joint": "joint"}, {"kind": "work"}])
    } else {
        json!([{"kind": "displacement", "joint": "joint"}, {"kind": "velocity", "joint": "joint"}, {"kind": "work"}])
    };
    let mut joint = joint;
    joint["name"] = json!("joint");
    joint["markers"] = json!(["ground", "body.c"]);
    json!({"name": "law", "dimension": dimension,
        "bodies": [{"name": "body", "element": "rigid", "mass": 2, "inertia": inertia, "position": zero,
            "motion": {"velocity": vector(dimension, [velocity, 0.0]), "spin": spin}, "markers": {"c": zero}}],
        "joints": [joint],
        "loads": [{"name": "law", "kind": "force_law", "joint": "joint", "force": force}],
        "inputs": inputs, "outputs": outputs,
        "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-9}})
}

fn axle(dimension: usize) -> Value {
    match dimension {
        2 => json!({"kind": "revolute"}),
        _ => json!({"kind": "revolute", "direction": [0, 0, 1]}),
    }
}

fn guide(dimension: usize) -> Value {
    json!({"kind": "prismatic", "direction": vector(dimension, [1.0, 0.0])})
}

/// A rotor under a torque `c w^2` against it: `w = w0 / (1 + c w0 t / J)`; what it loses is dissipated.
#[test]
fn drag_stops_a_rotor_as_it_should() {
    for setting in settings() {
        for spin in [40.0, -40.0] {
            let mut run = Run::started(&scene(
                setting,
                axle(setting.0),
                ([0.0, spin], "0.02*v*abs(v)"),
            ));
            run.step(3.0);
            let growth = 1.0 + 0.02 * 40.0 * 3.0 / 0.5;
            is_near(run.read("joint.angular_velocity"), spin / growth, 1e-6);
            is_near(
                run.read("joint.angle"),
                spin.signum() * 25.0 * growth.ln(),
                1e-5,
            );
            let lost = 0.25 * (spin * spin - (spin / growth).powi(2));
            is_near(run.read("energy.dissipated"), lost, 1e-4);
            is_near(run.read("energy.input"), 0.0, 1e-9);
        }
    }
}

/// Duffing's oscillator `2 x'' + 6 x + 16 x^3 = 0` through `x = 0` at the speed for an amplitude of 0.5: a quarter of its period is
/// `K(m) / w` with `w^2 = 3 + 8 A^2` and `m = 8 A^2 / (2 w^2)` (Abramowitz and Stegun 16.23), by the arithmetic-geometric mean.
#[test]
fn a_cubic_spring_is_duffings() {
    let (a, b, most) = (3.0_f64, 8.0_f64, 0.5_f64);
    let speed = (a * most * most + 0.5 * b * most.powi(4)).sqrt();
    let rate = (a + b * most * most).sqrt();
    let modulus = b * most * most / (2.0 * rate * rate);
    let (mut x, mut y) = (1.0, (1.0 - modulus).sqrt());
    for _ in 0..8 {
        (x, y) = (0.5 * (x + y), (x * y).sqrt());
    }
    let quarter = PI / (2.0 * x) / rate;
    for setting in settings() {
        let mut run = Run::started(&scene(
            setting,
            guide(setting.0),
            ([speed, 0.0], "6*x + 16*x^3"),
        ));
        run.step(quarter);
        is_near(run.read("joint.displacement"), most, 1e-7);
        is_near(run.read("joint.velocity"), 0.0, 1e-6);
        is_near(run.read("energy.input"), -speed * speed, 1e-6);
        run.step(6.0 * quarter);
        is_near(run.read("joint.displacement"), 0.0, 1e-6);
        is_near(run.read("joint.velocity"), -speed, 1e-6);
        is_near(run.read("energy.input"), 0.0, 1e-6);
    }
}

/// A body that a force `k / r^2` pulls to a point goes around it on an ellipse, in `2 pi sqrt(a^3 m / k)`.
#[test]
fn a_force_by_the_square_of_distance_makes_an_orbit() {
    let (pull, near, far) = (3.0_f64, 1.0_f64, 2.0_f64);
    let axis = 0.5 * (near + far);
    let speed = (pull / 2.0 * (2.0 / near - 1.0 / axis)).sqrt();
    let period = 2.0 * PI * (axis.powi(3) * 2.0 / pull).sqrt();
    for (dimension, method) in settings() {
        let inertia = if dimension == 2 {
            json!(0.1)
        } else {
            json!([0.1, 0.1, 0.1])
        };
        let scene = json!({"name": "orbit", "dimension": dimension,
            "bodies": [{"name": "body", "element": "rigid", "mass": 2, "inertia": inertia, "position": vector(dimension, [near, 0.0]),
                "motion": {"velocity": vector(dimension, [0.0, speed])}, "markers": {"c": vector(dimension, [0.0, 0.0])}}],
            "loads": [{"name": "sun", "kind": "force_law", "markers": ["ground", "body.c"], "point": vector(dimension, [0.0, 0.0]),
                "force": "3/x^2"}],
            "outputs": [{"kind": "position", "marker": "body.c"}, {"kind": "velocity", "marker": "body.c"}],
            "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-10}});
        let mut run = Run::started(&scene);
        run.step(0.5 * period);
        is_near(run.read("body.c.position[1]"), -far, 1e-6);
        is_near(run.read("body.c.position[2]"), 0.0, 1e-6);
        run.step(2.0 * period);
        is_near(run.read("body.c.position[1]"), near, 1e-5);
        is_near(run.read("body.c.position[2]"), 0.0, 1e-5);
        is_near(run.read("body.c.velocity[2]"), speed, 1e-5);
    }
}

/// A stop that pushes back from `x = 0.1` on rotates a body around after half a period of the mass on its spring.
#[test]
fn a_bump_stop_turns_a_body_around() {
    let (speed, stiffness) = (2.0_f64, 5e3_f64);
    let text = "5e3*max(0, x - 0.1)";
    for setting in settings() {
        let mut run = Run::started(&scene(setting, guide(setting.0), ([speed, 0.0], text)));
        let (met, half) = (0.1 / speed, PI * (2.0 / stiffness).sqrt());
        run.step(met + 0.5 * half);
        let deepest = speed * (2.0 / stiffness).sqrt();
        is_near(run.read("joint.displacement"), 0.1 + deepest, 1e-6);
        run.step(met + half + 0.1);
        is_near(run.read("joint.velocity"), -speed, 1e-5);
        is_near(run.read("joint.displacement"), 0.1 - 0.1 * speed, 1e-6);
    }
}

/// A force that changes its sign at a time, in steps that do not end there; and one that an input sets.
#[test]
fn forces_change_at_times_and_by_inputs() {
    for setting in settings() {
        let mut run = Run::started(&scene(
            setting,
            guide(setting.0),
            ([0.0, 0.0], "if(t < 0.77, -4, 6)"),
        ));
        run.step(2.0);
        is_near(run.read("joint.velocity"), 2.0 * 0.77 - 3.0 * 1.23, 1e-9);
        let mut run = Run::started(&scene(
            setting,
            guide(setting.0),
            ([0.0, 0.0], "-2*u + 0*v"),
        ));
        run.step(1.0);
        is_near(run.read("joint.velocity"), 0.0, 0.0);
        run.set("law.control", 3.0);
        run.step(2.0);
        is_near(run.read("joint.velocity"), 3.0, 1e-9);
        is_near(run.read("joint.displacement"), 1.5, 1e-9);
        is_near(run.read("energy.input"), 9.0, 1e-8);
    }
}

/// The ready scene of a quarter of a car on a bump, with a tyre that lifts off, bump stops and a damper with a knee. Places of wheel and car, m, are those
/// of `scipy.integrate.solve_ivp` (DOP853, relative tolerance 1e-12, steps of 1e-4 s) for the two equations.
#[test]
fn a_wheel_lifts_off_behind_a_bump() {
    let text = include_str!("../../scenes/quarter_car_bump.json");
    let mut scene: Value = serde_json::from_str(text).expect("a scene");
    scene["accuracy"] = json!({"relative_tolerance": 1e-9});
    let mut run = Run::started(&scene);
    is_near(run.read("tyre.force[2]"), 390.0 * 9.81, 1e-6);
    for (t, wheel, car) in [
        (0.5, 0.30260954545454544, 0.7795470454545455),
        (0.55, 0.34897959745424495, 0.7820630320315775),
        (0.6, 0.3823435018423816, 0.8070210281123997),
        (0.65, 0.32577434693420665, 0.8267776701081614),
        (0.75, 0.30475281113899, 0.8139340301947913),
        (1.05, 0.29998152293364766, 0.7535035415887141),
        (2.0, 0.30253845401912005, 0.7770431704754072),
    ] {
        run.step(t);
        is_near(run.read("wheel.hub.position[2]"), wheel, 1e-6);
        is_near(run.read("car.strut.position[2]"), car, 1e-6);
        if t == 0.65 {
            is_near(run.read("tyre.force[2]"), 0.0, 0.0);
        }
    }
}

/// A weight that hangs on a cubic spring from the start, `k x^3 = m g`, and one on a table over the coordinate of its guide.
#[test]
fn weights_hang_where_laws_bear_them() {
    let down = |load: Value| {
        let scene = json!({"name": "weight", "dimension": 2, "gravity": [0.0, -9.81], "initial": "static_equilibrium",
            "bodies": [{"name": "body", "element": "rigid", "mass": 2, "inertia": 0.1, "position": [0.0, 0.0], "markers": {"c": [0.0, 0.0]}}],
            "joints": [{"name": "joint", "kind": "prismatic", "markers": ["ground", "body.c"], "direction": [0.0, -1.0]}],
            "loads": [load], "outputs": [{"kind": "displacement", "joint": "joint"}]});
        Run::started(&scene).read("joint.displacement")
    };
    let law =
        json!({"name": "law", "kind": "force_law", "joint": "joint", "force": "500*x^3 + 10*x"});
    let found = down(law);
    is_near(500.0 * found.powi(3) + 10.0 * found, 19.62, 1e-8);
    let table = json!({"name": "law", "kind": "table_spring", "joint": "joint", "spring": [[0, 0], [1, 50]]});
    is_near(down(table), 19.62 / 50.0, 1e-10);
}

/// A body that leaves the place where the root of its law is a number: the load and the place are named.
#[test]
fn a_law_without_a_value_is_named() {
    for setting in settings() {
        let scene = scene(setting, guide(setting.0), ([-1.0, 0.0], "0.1*sqrt(x+0.5)"));
        let mut run = Run::started(&scene);
        let failure = run.0.step(2.0).expect_err("no root of a negative number");
        assert!(
            failure.reason.contains("the force of `law`"),
            "{}",
            failure.reason
        );
        let (_, place) = failure.reason.split_once("x = ").expect("a place");
        let (place, _) = place.split_once(',').expect("a rate too");
        let place: f64 = place.parse().expect("a number");
        assert!((-0.52..=-0.5).contains(&place), "{place}");
    }
}
