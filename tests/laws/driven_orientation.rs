//! Orientations that are driven in space: the conditions and their derivatives in time, what a master gives through a port,
//! moments by Euler's equations, signs of quaternions, the start.

use std::f64::consts::{PI, TAU};

use flexbody::bodies::{Bodies, Marker, Node};
use flexbody::math::jet::{Jet, Number};
use flexbody::math::rotation::{product, rotation_vector};
use flexbody::scene::Scene;
use flexbody::simulation::Simulation;
use flexbody::system::joints::{Constraint, ConstraintKind, DrivenOrientation, View};
use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use crate::laws::chance::Chance;
use crate::laws::linkage::V;

/// Moments of inertia, kg m^2, along the axes of the frame.
const INERTIA: [f64; 3] = [0.5, 0.7, 1.1];
const MASS: f64 = 2.0;

/// A precession: tilted by an angle, about the vertical and about its own axis at two rates, rad/s.
const TILT: f64 = 0.4;
const TURNING: f64 = 3.0;
const SPINNING: f64 = 5.0;

fn about(k: usize, angle: f64) -> [f64; 4] {
    let (sin, cos) = (0.5 * angle).sin_cos();
    let mut q = [cos, 0.0, 0.0, 0.0];
    q[1 + k] = sin;
    q
}

/// Quaternion, angular velocity and angular acceleration of the precession.
fn precession(t: f64) -> ([f64; 4], V, V) {
    let standing = product(&about(2, TURNING * t), &about(0, TILT));
    let axis = axes(&standing)[2];
    let q = product(&standing, &about(2, SPINNING * t));
    let (turning, spinning) = (V::z() * TURNING, axis * SPINNING);
    (q, turning + spinning, turning.cross(&spinning))
}

fn axes(q: &[f64; 4]) -> [V; 3] {
    flexbody::math::rotation::axes(q)
}

/// Moment that Euler's equations ask for, N m.
fn moment(q: &[f64; 4], w: V, second: V) -> V {
    let r = Matrix3::from_columns(&axes(q));
    let inertia = r * Matrix3::from_diagonal(&INERTIA.into()) * r.transpose();
    inertia * second + w.cross(&(inertia * w))
}

/// One body with what drives it.
fn driven(more: Value) -> Simulation {
    let mut scene = json!({
        "name": "driven", "dimension": 3, "gravity": [0, 0, 0],
        "accuracy": {"relative_tolerance": 1e-8},
        "bodies": [{"name": "b", "element": "rigid", "mass": MASS, "inertia": INERTIA, "position": [0, 0, 0],
                    "markers": {"c": [0, 0, 0], "arm": [1, 0, 0]}}],
        "outputs": [{"kind": "orientation", "marker": "b.c"}, {"kind": "angular_velocity", "marker": "b.c"},
                    {"kind": "work"}, {"kind": "energy"}]});
    let entries = more.as_object().cloned().unwrap_or_default();
    for (key, value) in entries {
        match (scene[&key].as_array_mut(), value) {
            (Some(list), Value::Array(more)) => list.extend(more),
            (_, value) => scene[&key] = value,
        }
    }
    Simulation::new(Scene::from_json(&scene.to_string()).expect("a scene"))
}

fn port() -> Simulation {
    driven(json!({"ports": [{"name": "p", "marker": "b.c", "kind": "motion", "rotation": true}]}))
}

fn index(simulation: &Simulation, name: &str) -> usize {
    let mut variables = simulation.variables().iter();
    let found = variables.position(|variable| variable.name == name);
    found.unwrap_or_else(|| panic!("{name}"))
}

fn set(simulation: &mut Simulation, of: &str, values: &[f64]) {
    for (k, value) in values.iter().enumerate() {
        let at = index(simulation, &format!("{of}[{}]", k + 1));
        simulation.set_real(at, *value).expect("an input");
    }
}

fn read<const N: usize>(simulation: &mut Simulation, of: &str) -> [f64; N] {
    std::array::from_fn(|k| {
        let at = index(simulation, &format!("{of}[{}]", k + 1));
        simulation.real(at).expect("an output")
    })
}

/// Sets a port to a quaternion, angular velocity and angular acceleration.
fn give(simulation: &mut Simulation, (q, w, second): ([f64; 4], V, V)) {
    set(simulation, "p.quaternion", &q);
    set(simulation, "p.angular_velocity", w.as_slice());
    set(simulation, "p.angular_acceleration", second.as_slice());
}

/// The angle between the body and an orientation, rad.
fn away(simulation: &mut Simulation, q: &[f64; 4]) -> f64 {
    let found: [f64; 9] = read(simulation, "b.c.orientation");
    let found = Matrix3::from_row_slice(&found);
    let wanted = Matrix3::from_columns(&axes(q));
    let between = wanted.transpose() * found;
    let columns = [0, 1, 2].map(|k| between.column(k).into_owned());
    rotation_vector(&flexbody::math::rotation::quaternion(&columns)).norm()
}

#[test]
fn conditions_have_the_derivatives_of_their_values() {
    let mut chance = Chance(11);
    let mut vector = || chance.vector();
    for _ in 0..50 {
        // Everything moves as polynomials of order 2, whatever axes are.
        let mut node = || -> [[V; 3]; 2] { [0; 2].map(|_| [0; 3].map(|_| vector())) };
        let nodes = [node(), node()];
        let order = |k: usize| -> Vec<Node<3>> {
            nodes
                .iter()
                .map(|node| node.map(|of| of[k].into()))
                .collect()
        };
        let (x, v, a) = (order(0), order(1), order(2));
        let course: Vec<[f64; 3]> = (0..4).map(|_| vector().into()).collect();
        let jets = |of: [&[Node<3>]; 3]| -> Vec<Node<3, Jet>> {
            let jet = |n: usize, p: usize, k: usize| {
                Jet::new(of[0][n][p][k], of[1][n][p][k], of[2][n][p][k])
            };
            (0..2)
                .map(|n| [0, 1].map(|p| [0, 1, 2].map(|k| jet(n, p, k))))
                .collect()
        };
        let moving = jets([&x, &v, &a]);
        let still = jets([&v, &a, &a]);
        let drives: Vec<[Jet; 3]> = (course.iter())
            .map(|[p, v, a]| [Jet::new(*p, *v, *a), Jet::from_re(*v), Jet::from_re(*a)])
            .collect();
        let bodies = Bodies::default();
        for about in 0..3 {
            let axis = |k: usize| {
                let mut direction = [0.0; 3];
                direction[k] = 1.0;
                Marker::framed(0, 0, [0.3, -0.2, 0.1], direction)
            };
            let constraint = Constraint {
                joint: None,
                kind: ConstraintKind::DrivenOrientation(DrivenOrientation {
                    axes: [axis(0), axis(1), axis(2)],
                    drives: [0, 1, 2, 3],
                    about,
                }),
                offset: 0.0,
                release: None,
            };
            let value = constraint.value(&view(&moving, &still, &drives, &bodies));
            let view = view(&x, &v, &course, &bodies);
            let rate = constraint.rate(&view) + constraint.along(&view, &v);
            let second = constraint.bias(&view) + constraint.along(&view, &a);
            let size = value.largest().max(1.0);
            assert!((value.v1 - rate).abs() < 1e-12 * size, "{value} {rate}");
            assert!((value.v2 - second).abs() < 1e-11 * size, "{value} {second}");
        }
    }
}

fn view<'a, N: Number>(
    x: &'a [Node<3, N>],
    v: &'a [Node<3, N>],
    drives: &'a [[N; 3]],
    bodies: &'a Bodies<3>,
) -> View<'a, 3, N> {
    View {
        x,
        v,
        drives,
        bodies,
        travel: &[],
        angles: &[],
        released: &[],
    }
}

#[test]
fn a_body_that_is_driven_through_a_precession_takes_eulers_moment() {
    let [c, s] = [(0.5 * TILT).cos(), (0.5 * TILT).sin()];
    let [sum, less] = [0.5 * (TURNING + SPINNING), 0.5 * (TURNING - SPINNING)];
    let value = [
        format!("{c:?} * cos({sum:?} * t)"),
        format!("{s:?} * cos({less:?} * t)"),
        format!("{s:?} * sin({less:?} * t)"),
        format!("{c:?} * sin({sum:?} * t)"),
    ];
    for integrator in ["rk4", "radau", "auto"] {
        let mut simulation = driven(json!({
            "method": {"integrator": integrator},
            "motions": [{"name": "m", "kind": "orientation", "marker": "b.c", "value": value}],
            "outputs": [{"kind": "reaction_moment", "motion": "m"}]}));
        simulation.initialize(0.0).expect("a start");
        simulation.start().expect("a start");
        for k in 0..=40 {
            let t = 0.25 * f64::from(k);
            if k > 0 {
                simulation.step(t).expect("a step");
            }
            let (q, w, second) = precession(t);
            assert!(away(&mut simulation, &q) < 1e-13, "{integrator} at {t}");
            let found = V::from(read::<3>(&mut simulation, "m.reaction_moment"));
            let missed = (found - moment(&q, w, second)).norm();
            assert!(missed < 1e-11, "{integrator} at {t}: {missed}");
            let rate = V::from(read::<3>(&mut simulation, "b.c.angular_velocity"));
            assert!((rate - w).norm() < 1e-12, "{integrator} at {t}");
        }
    }
}

#[test]
fn what_a_port_gives_is_met_at_the_third_order_of_its_steps() {
    let mut errors = Vec::new();
    for steps in [80, 160] {
        let mut simulation = port();
        give(&mut simulation, precession(0.0));
        simulation.initialize(0.0).expect("a start");
        simulation.start().expect("a start");
        let mut largest = 0.0_f64;
        for k in 0..steps {
            let [now, then] = [0, 1].map(|more| 2.0 * f64::from(k + more) / f64::from(steps));
            give(&mut simulation, precession(now));
            simulation.step(then).expect("a step");
            largest = largest.max(away(&mut simulation, &precession(then).0));
        }
        errors.push(largest);
    }
    let order = (errors[0] / errors[1]).log2();
    assert!((order - 3.0).abs() < 0.1, "{errors:?}");
}

#[test]
fn a_steady_turn_is_met_over_many_turns_whatever_the_sign() {
    // Nearly a quarter of a turn a step, five hundred turns.
    let (rate, h) = (30.0, 0.05);
    let way = Vector3::new(0.48, -0.6, 0.64);
    let at = |t: f64| {
        let (sin, cos) = (0.5 * rate * t).sin_cos();
        let [x, y, z]: [f64; 3] = (way * sin).into();
        ([cos, x, y, z], way * rate, V::zeros())
    };
    let mut runs = Vec::new();
    for sign in [1.0, -3.0] {
        let mut simulation = port();
        give(&mut simulation, at(0.0));
        simulation.initialize(0.0).expect("a start");
        simulation.start().expect("a start");
        let mut moments = Vec::new();
        for k in 0..(500.0 * TAU / rate / h) as u32 {
            let t = h * f64::from(k);
            let (q, w, second) = at(t);
            let factor = if k % 3 == 1 { sign } else { 1.0 };
            give(&mut simulation, (q.map(|part| factor * part), w, second));
            let found = V::from(read::<3>(&mut simulation, "p.moment"));
            let missed = (found + moment(&q, w, second)).norm();
            assert!(missed < 1e-8, "at {t}: {missed}");
            simulation.step(t + h).expect("a step");
            let missed = away(&mut simulation, &at(t + h).0);
            assert!(missed < 1e-11, "at {t}: {missed}");
            moments.push(found);
        }
        runs.push(moments);
    }
    for (a, b) in runs[0].iter().zip(&runs[1]) {
        assert!((a - b).norm() < 1e-9);
    }
}

#[test]
fn moments_follow_angular_accelerations_at_once() {
    let mut simulation = port();
    let (q, w, second) = precession(0.3);
    give(&mut simulation, (q, w, second));
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    simulation.step(0.01).expect("a step");
    let standing: [f64; 9] = read(&mut simulation, "b.c.orientation");
    let r = Matrix3::from_row_slice(&standing);
    let inertia = r * Matrix3::from_diagonal(&INERTIA.into()) * r.transpose();
    let w = V::from(read::<3>(&mut simulation, "b.c.angular_velocity"));
    // The angular acceleration rises at a rate: so does the moment, and with the body it rotates.
    let (given, jerk) = (V::new(0.3, -0.8, 0.5), V::new(-2.0, 1.0, 4.0));
    set(&mut simulation, "p.angular_acceleration", given.as_slice());
    for k in 0..3 {
        let input = index(&simulation, &format!("p.angular_acceleration[{}]", k + 1));
        simulation
            .set_input_derivative(input, 1, jerk[k])
            .expect("an input");
    }
    let found = V::from(read::<3>(&mut simulation, "p.moment"));
    let momentum = inertia * w;
    let wanted = -(inertia * given + w.cross(&momentum));
    assert!((found - wanted).norm() < 1e-11, "{found} {wanted}");
    for k in 0..3 {
        let input = index(&simulation, &format!("p.angular_acceleration[{}]", k + 1));
        let outputs = [0, 1, 2].map(|i| index(&simulation, &format!("p.moment[{}]", i + 1)));
        let moved = (outputs.into_iter(), std::iter::once((input, 1.0)));
        simulation
            .differentiate(moved.0, moved.1)
            .expect("derivatives");
        for (i, output) in outputs.into_iter().enumerate() {
            let change = simulation.change(output).expect("an output");
            assert!((change + inertia[(i, k)]).abs() < 1e-12, "{i} {k}");
        }
    }
    // I' = [w] I - I [w].
    let turn = w.cross_matrix();
    let change = turn * inertia - inertia * turn;
    let rate = change * given
        + inertia * jerk
        + given.cross(&momentum)
        + w.cross(&(change * w + inertia * given));
    for k in 0..3 {
        let output = index(&simulation, &format!("p.moment[{}]", k + 1));
        let found = simulation.output_derivative(output, 1).expect("an output");
        assert!((found + rate[k]).abs() < 1e-9, "{found} {}", rate[k]);
    }
}

#[test]
fn the_start_is_found_from_any_orientation_with_what_hangs_on_the_body() {
    for angle in [0.05, 1.0, 2.0, 3.1, PI] {
        let (sin, cos) = (0.5 * angle).sin_cos();
        let q = [cos, 0.6 * sin, 0.0, 0.8 * sin];
        let mut simulation = driven(json!({
            "bodies": [{"name": "hung", "element": "rigid", "mass": 1, "inertia": [0.1, 0.1, 0.1],
                        "position": [1.5, 0, 0], "markers": {"hook": [-0.5, 0, 0]}}],
            "joints": [{"name": "ball", "kind": "spherical", "markers": ["b.arm", "hung.hook"]}],
            "motions": [{"name": "m", "kind": "orientation", "marker": "b.c", "value": q}]}));
        simulation.initialize(0.0).expect("a start");
        simulation.start().expect("a start");
        simulation.step(0.1).expect("a step");
        assert!(away(&mut simulation, &q) < 1e-13, "{angle}");
    }
}

#[test]
fn a_quaternion_of_zeros_is_refused() {
    let mut simulation = port();
    give(&mut simulation, precession(0.0));
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    simulation.step(0.01).expect("a step");
    set(&mut simulation, "p.quaternion", &[0.0; 4]);
    assert!(simulation.step(0.02).is_err());
    set(&mut simulation, "p.quaternion", &precession(0.01).0);
    simulation.step(0.02).expect("a step after one that failed");
}
