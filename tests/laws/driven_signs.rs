//! Orientations that a master drives, beyond what is read at communication points: a quaternion and its opposite are one orientation all the
//! way through a step, and second derivatives of outputs follow from those of the angular acceleration.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use serde_json::{Value, json};

use crate::laws::runs::Run;

type V = Vector3<f64>;

const INERTIA: [f64; 3] = [0.5, 0.7, 1.1];
const STEP: f64 = 0.02;

fn scene(motion: Value) -> Value {
    json!({"name": "driven", "dimension": 3, "gravity": [0.0, 0.0, -9.81],
        "accuracy": {"relative_tolerance": 1e-8},
        "bodies": [{"element": "rigid", "name": "b", "mass": 2.0, "inertia": INERTIA, "position": [0.0, 0.0, 0.0],
                    "markers": {"c": [0.0, 0.0, 0.0], "arm": [0.4, 0.1, 0.0]}},
                   {"element": "rigid", "name": "hung", "mass": 1.0, "inertia": [0.1, 0.2, 0.2], "position": [0.9, 0.1, 0.0],
                    "markers": {"hook": [-0.5, 0.0, 0.0], "c": [0.0, 0.0, 0.0]}}],
        "joints": [{"name": "ball", "kind": "spherical", "markers": ["b.arm", "hung.hook"]}],
        "motions": [{"name": "p", "kind": "position", "marker": "b.c", "value": [0.0, 0.0, 0.0]}, motion],
        "outputs": [{"kind": "position", "marker": "hung.c"}, {"kind": "velocity", "marker": "hung.c"},
                    {"kind": "acceleration", "marker": "hung.c"}, {"kind": "angular_velocity", "marker": "b.c"},
                    {"kind": "reaction_moment", "motion": "m"}, {"kind": "energy"}, {"kind": "work"}]})
}

fn quaternion(turn: Rotation3<f64>) -> [f64; 4] {
    let q = UnitQuaternion::from_rotation_matrix(&turn);
    [q.w, q.i, q.j, q.k]
}

/// What hangs on the body feels the way that it takes between communication points.
#[test]
fn a_quaternion_and_its_opposite_drive_the_same_motion() {
    let rate = V::new(1.0, -2.0, 1.5);
    for derivatives in 0..=2 {
        let scene = scene(
            json!({"name": "m", "kind": "orientation", "marker": "b.c", "value": {"input": derivatives}}),
        );
        let mut found = Vec::new();
        for (start, sign) in [(1.0, 1.0), (1.0, -3.0), (-1.0, 1.0), (-2.0, -2.0)] {
            let set = |run: &mut Run, k: u32| {
                // Without a rate the value is where the step leads.
                let t = f64::from(if derivatives == 0 { k + 1 } else { k }) * STEP;
                let factor = match k {
                    0 => start,
                    _ if k % 3 == 1 => sign,
                    _ => 1.0,
                };
                let q = quaternion(Rotation3::new(rate * t)).map(|part| factor * part);
                run.set_all("m.quaternion", &q);
                if derivatives > 0 {
                    run.set_all("m.angular_velocity", rate.as_slice());
                }
            };
            let mut run = Run::ready(&scene);
            set(&mut run, 0);
            run.start();
            found.push(run.steps(0..25, STEP, set));
        }
        let largest = found[0]
            .iter()
            .flatten()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        for other in &found[1..] {
            for (k, (a, b)) in found[0].iter().zip(other).enumerate() {
                let off = a
                    .iter()
                    .zip(b)
                    .fold(0.0_f64, |off, (a, b)| off.max((a - b).abs()));
                assert!(
                    off < 1e-7 * largest,
                    "{derivatives} derivatives, step {k}: {off:e}"
                );
            }
        }
    }
}

/// Angular acceleration and its two derivatives.
const GIVEN: [V; 3] = [
    V::new(0.3, -0.8, 0.5),
    V::new(-2.0, 1.0, 4.0),
    V::new(3.0, -5.0, 2.0),
];

/// Orientation and angular velocity after a time, by Runge and Kutta in steps that leave only roundoff.
fn course(mut turn: UnitQuaternion<f64>, start: V, t: f64) -> (Matrix3<f64>, V) {
    let w = |s: f64| start + GIVEN[0] * s + GIVEN[1] * (s * s / 2.0) + GIVEN[2] * (s * s * s / 6.0);
    let count = 8;
    let h = t / f64::from(count);
    for k in 0..count {
        let s = f64::from(k) * h;
        // Magnus, with Gauss's two points: order four.
        let root = 3.0_f64.sqrt() / 6.0;
        let [a, b] = [0.5 - root, 0.5 + root].map(|part| w(s + part * h));
        let way = (a + b) * (0.5 * h) + b.cross(&a) * (3.0_f64.sqrt() * h * h / 12.0);
        turn = UnitQuaternion::from_scaled_axis(way) * turn;
    }
    (*turn.to_rotation_matrix().matrix(), w(t))
}

#[test]
fn second_derivatives_of_a_moment_follow_those_of_a_driven_angular_acceleration() {
    let scene = json!({"name": "driven", "dimension": 3, "gravity": [0.0, 0.0, 0.0],
        "bodies": [{"element": "rigid", "name": "b", "mass": 2.0, "inertia": INERTIA, "position": [0.0, 0.0, 0.0],
                    "markers": {"c": [0.0, 0.0, 0.0]}}],
        "ports": [{"name": "p", "marker": "b.c", "kind": "motion", "rotation": true}]});
    let stands = Rotation3::new(V::new(0.4, -0.9, 0.7));
    let spin = V::new(1.2, 0.7, -1.6);
    let mut run = Run::ready(&scene);
    run.set_all("p.quaternion", &quaternion(stands));
    run.set_all("p.angular_velocity", spin.as_slice());
    run.set_all("p.angular_acceleration", GIVEN[0].as_slice());
    run.start();
    run.step(1e-6);
    let turn = UnitQuaternion::from_matrix(&Matrix3::from_row_slice(&{
        // The body's axes at the end of the step, from the quaternion that goes out.
        let stood = course(UnitQuaternion::from_rotation_matrix(&stands), spin, 1e-6).0;
        std::array::from_fn::<f64, 9, _>(|k| stood[(k / 3, k % 3)])
    }));
    run.set_all("p.angular_acceleration", GIVEN[0].as_slice());
    for k in 0..3 {
        let index = run.index(&format!("p.angular_acceleration[{}]", k + 1));
        for (order, slope) in [GIVEN[1], GIVEN[2]].into_iter().enumerate() {
            let set = run
                .0
                .set_input_derivative(index, order as i32 + 1, slope[k]);
            set.expect("a derivative");
        }
    }
    let moment = |t: f64| -> V {
        let (r, w) = course(turn, spin, t);
        let second = GIVEN[0] + GIVEN[1] * t + GIVEN[2] * (t * t / 2.0);
        let inertia = r * Matrix3::from_diagonal(&INERTIA.into()) * r.transpose();
        -(inertia * second + w.cross(&(inertia * w)))
    };
    let h = 1e-2;
    let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| moment(k * h));
    let firsts = (a - b * 8.0 + d * 8.0 - e) / (12.0 * h);
    let seconds = (b * 16.0 + d * 16.0 - a - e - c * 30.0) / (12.0 * h * h);
    for k in 0..3 {
        let output = run.index(&format!("p.moment[{}]", k + 1));
        for (order, wanted) in [(1, firsts[k]), (2, seconds[k])] {
            let found = run
                .0
                .output_derivative(output, order)
                .expect("a derivative");
            assert!(
                (found - wanted).abs() < 1e-4 * (1.0 + wanted.abs()),
                "{k}, order {order}: {found} {wanted}"
            );
        }
    }
}

/// Quaternions that go out begin with a scalar part that is not negative, however bodies come to stand as they do.
#[test]
fn quaternions_go_out_with_a_scalar_that_is_not_negative_at_the_start() {
    for (k, turn) in [0.5_f64, 2.0, 3.0, 3.3, 4.5, 6.0].into_iter().enumerate() {
        let vector = V::new(0.6, -0.48, 0.64) * turn;
        let rotation = Rotation3::new(vector);
        let line = rotation * V::x();
        let outputs = ["free.c", "driven.c", "rod.tip"]
            .map(|marker| json!({"kind": "quaternion", "marker": marker}));
        let scene = json!({"name": "stands", "dimension": 3, "gravity": [0.0, 0.0, 0.0],
            "bodies": [
                {"element": "rigid", "name": "free", "mass": 1.0, "inertia": INERTIA, "position": [0.0, 0.0, 0.0],
                 "orientation": {"rotation_vector": vector.as_slice()}, "markers": {"c": [0.0, 0.0, 0.0]}},
                {"element": "rigid", "name": "driven", "mass": 1.0, "inertia": INERTIA, "position": [0.0, 3.0, 0.0],
                 "markers": {"c": [0.0, 0.0, 0.0]}},
                {"element": "rod", "name": "rod", "elements": 2,
                 "material": {"youngs_modulus": 1e7, "shear_modulus": 4e6, "density": 1000.0},
                 "section": {"shape": {"rectangle": {"width": 0.02, "height": 0.03}}},
                 "axis": (rotation * V::y()).as_slice(),
                 "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": line.as_slice()}}, "markers": {"tip": 1.0}}],
            "motions": [{"name": "m", "kind": "orientation", "marker": "driven.c", "value": {"input": 0}}],
            "outputs": outputs});
        let mut run = Run::ready(&scene);
        let given = quaternion(rotation);
        run.set_all(
            "m.quaternion",
            &given.map(|part| if k % 2 == 0 { part } else { -2.0 * part }),
        );
        run.start();
        let sign = if given[0] < 0.0 { -1.0 } else { 1.0 };
        for marker in ["free.c", "driven.c", "rod.tip"] {
            let found = run.read_all::<4>(&format!("{marker}.quaternion"));
            let off = (found.iter().zip(given)).map(|(a, b)| (a - sign * b).abs());
            let off = off.fold(0.0, f64::max);
            assert!(
                found[0] >= 0.0 && off < 1e-9,
                "{marker} turned by {turn}: {found:?} {given:?}"
            );
        }
    }
}
