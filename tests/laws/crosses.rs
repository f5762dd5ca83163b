//! Joints with two rotations in space: which of two axes is fixed in which body. The rule is read from the orientations that come out,
//! after bodies have rotated far.

use nalgebra::{Matrix3, Rotation3, Vector3};
use serde_json::{Value, json};

use crate::laws::chance::Chance;
use crate::laws::runs::Run;

type V = Vector3<f64>;

const AXES: [&str; 3] = ["rotation_x", "rotation_y", "rotation_z"];

/// How the first body stands at the start.
const STANDS: V = V::new(0.4, -0.7, 0.5);

fn body(name: &str, place: [f64; 3], stands: V, spin: V) -> Value {
    json!({"element": "rigid", "name": name, "mass": 1.0, "inertia": [0.3, 0.5, 0.6], "position": place,
           "orientation": {"rotation_vector": stands.as_slice()}, "motion": {"spin": spin.as_slice()},
           "markers": {"c": [0.0, 0.0, 0.0]}})
}

/// The orientation of a body now.
fn standing(run: &mut Run, name: &str) -> Matrix3<f64> {
    Matrix3::from_row_slice(&run.read_all::<9>(&format!("{name}.c.orientation")))
}

/// Two axes in global components at the start stay across each other, the one with the first body, the other with the second.
fn stay_across(joint: Value, [first, second]: [V; 2], is_grounded: bool, chance: &mut Chance) {
    let (base, own) = (
        Rotation3::new(STANDS),
        Rotation3::new(V::new(0.2, 0.6, -0.3)),
    );
    let spins = [chance.vector() * 2.0, chance.vector() * 3.0];
    let mut bodies = vec![body("b", [0.0; 3], own.scaled_axis(), spins[1])];
    if !is_grounded {
        bodies.push(body("a", [0.0; 3], STANDS, spins[0]));
    }
    let outputs: Vec<Value> = (bodies.iter())
        .map(|of| json!({"kind": "orientation", "marker": format!("{}.c", of["name"].as_str().expect("a name"))}))
        .collect();
    let scene = json!({"name": "cross", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": bodies, "joints": [joint],
                       "outputs": outputs, "accuracy": {"relative_tolerance": 1e-8}});
    let mut run = Run::started(&scene);
    let mut seen = 0.0_f64;
    let starts = [(base.matrix(), first), (own.matrix(), second)];
    for k in 1..=10 {
        run.step(0.1 * f64::from(k));
        let first_now = if is_grounded {
            *base.matrix()
        } else {
            standing(&mut run, "a")
        };
        let now = [first_now, standing(&mut run, "b")];
        let [a, b] = [0, 1].map(|k| now[k] * starts[k].0.transpose() * starts[k].1);
        assert!(a.dot(&b).abs() < 1e-9, "{joint}: {}", a.dot(&b));
        // The other way round would be seen.
        let [c, d] = [0, 1].map(|k| now[k] * starts[k].0.transpose() * starts[1 - k].1);
        seen = seen.max(c.dot(&d).abs());
    }
    assert!(seen > 0.05, "{joint}: {seen}");
}

fn ends(is_grounded: bool) -> [&'static str; 2] {
    if is_grounded {
        ["ground", "b.c"]
    } else {
        ["a.c", "b.c"]
    }
}

#[test]
fn the_first_of_two_free_rotations_turns_about_an_axis_of_the_first_body() {
    let mut chance = Chance(7);
    for is_grounded in [true, false] {
        let base = if is_grounded {
            Rotation3::identity()
        } else {
            Rotation3::new(STANDS)
        };
        for i in 0..3 {
            for j in (0..3).filter(|j| *j != i) {
                let joint = json!({"name": "j", "kind": "generic", "markers": ends(is_grounded), "free": [AXES[i], AXES[j]]});
                let axes = [i, j].map(|k| base * V::ith(k, 1.0));
                stay_across(joint, axes, is_grounded, &mut chance);
            }
        }
    }
}

#[test]
fn the_direction_of_a_cross_is_fixed_in_the_first_body_and_the_second_in_the_second() {
    let mut chance = Chance(8);
    for is_grounded in [true, false] {
        let base = if is_grounded {
            Rotation3::identity()
        } else {
            Rotation3::new(STANDS)
        };
        for _ in 0..3 {
            let first = chance.vector().normalize();
            let second = first.cross(&chance.vector()).normalize();
            let joint = json!({"name": "j", "kind": "universal", "markers": ends(is_grounded), "direction": first.as_slice(),
                               "second_direction": second.as_slice()});
            stay_across(
                joint,
                [base * first, base * second],
                is_grounded,
                &mut chance,
            );
        }
    }
}
