//! Bushings in space between bodies that are rotated far, and ports whose orientation moves: energy along motions, moments in closed form.

use nalgebra::{Rotation3, Vector3};
use serde_json::{Value, json};

use crate::laws::chance::Chance;
use crate::laws::runs::Run;

type V = Vector3<f64>;

const STEP: f64 = 0.02;

fn body(name: &str, place: V, turn: V, [velocity, spin]: [V; 2]) -> Value {
    json!({"element": "rigid", "name": name, "mass": 1.5, "inertia": [0.4, 0.6, 0.9], "position": place.as_slice(),
           "orientation": {"rotation_vector": turn.as_slice()},
           "motion": {"velocity": velocity.as_slice(), "spin": spin.as_slice()}, "markers": {"c": [0.0, 0.0, 0.0]}})
}

/// Energy of a simulation, J: what is there, what came in, what was dissipated.
fn balance(run: &mut Run) -> [f64; 3] {
    let parts = ["kinetic", "strain", "gravity", "spring"];
    let sum = parts
        .iter()
        .map(|part| run.read(&format!("energy.{part}")))
        .sum();
    [sum, run.read("energy.input"), run.read("energy.dissipated")]
}

/// What is there changes by what comes in less what is dissipated.
fn keeps_energy(
    run: &mut Run,
    steps: u32,
    set: impl FnMut(&mut Run, u32),
    within: f64,
) -> [f64; 3] {
    let [start, ..] = balance(run);
    run.steps(0..steps, STEP, set);
    let [now, input, dissipated] = balance(run);
    let size = start.abs() + now.abs() + input.abs() + dissipated.abs();
    let missed = now - start - input + dissipated;
    assert!(
        missed.abs() < within * size,
        "{missed:e} of {size:e}: {start} {now} {input} {dissipated}"
    );
    [now - start, input, dissipated]
}

fn outputs() -> Value {
    json!([{"kind": "energy"}, {"kind": "work"}])
}

#[test]
fn bushings_between_bodies_that_are_turned_far_conserve_or_lose_what_they_say() {
    let mut chance = Chance(17);
    for run in 0..12 {
        let is_damped = run % 2 == 1;
        // Rotated against each other from the start on, where nothing acts, and further by their spins.
        let bodies = [
            body(
                "a",
                V::zeros(),
                chance.vector() * 2.0,
                [chance.vector(), chance.vector() * 2.0],
            ),
            body(
                "b",
                chance.vector(),
                chance.vector() * 2.0,
                [chance.vector(), chance.vector() * 2.0],
            ),
        ];
        let mut mount = json!({"name": "mount", "kind": "bushing", "markers": ["a.c", "b.c"],
            "translational_stiffness": [20.0, 50.0, 8.0], "rotational_stiffness": [6.0, 15.0, 40.0]});
        if is_damped {
            mount["translational_damping"] = json!([0.5, 1.0, 3.0]);
            mount["rotational_damping"] = json!([0.2, 1.1, 0.6]);
        }
        let scene = json!({"name": "mounted", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": bodies, "loads": [mount],
            "outputs": outputs(), "accuracy": {"relative_tolerance": 1e-9}});
        let mut run = Run::started(&scene);
        let [_, input, dissipated] = keeps_energy(&mut run, 40, |_, _| (), 1e-7);
        assert_eq!(input, 0.0);
        assert_eq!(dissipated > 0.0, is_damped, "{dissipated}");
    }
}

/// Rotated about one axis, with the same stiffness and damping about all, a bushing has the moment `k angle + c rate` about it, however far
/// that is, between axes that are rotated by any start.
#[test]
fn the_moment_of_a_bushing_is_along_the_axis_about_which_bodies_turn() {
    let (k, c) = (3.0, 0.7);
    let mut chance = Chance(19);
    for _ in 0..6 {
        let (axis, start) = (chance.vector().normalize(), chance.vector());
        let scene = json!({"name": "turned", "dimension": 3, "gravity": [0.0, 0.0, 0.0],
            "bodies": [body("b", V::zeros(), start, [V::zeros(); 2])],
            "motions": [{"name": "m", "kind": "orientation", "marker": "b.c", "value": {"input": 2}},
                        {"name": "p", "kind": "position", "marker": "b.c", "value": [0.0, 0.0, 0.0]}],
            "loads": [{"name": "mount", "kind": "bushing", "markers": ["ground", "b.c"],
                       "rotational_stiffness": [k, k, k], "rotational_damping": [c, c, c]}],
            "outputs": [{"kind": "load_moment", "load": "mount"}, {"kind": "orientation", "marker": "b.c"}]});
        for angle in [0.3_f64, 1.2, 2.4] {
            let rate = 1.7;
            let turn = Rotation3::new(axis * angle) * Rotation3::new(start);
            let q = nalgebra::UnitQuaternion::from_rotation_matrix(&turn);
            let mut run = Run::ready(&scene);
            run.set_all("m.quaternion", &[q.w, q.i, q.j, q.k]);
            run.set_all("m.angular_velocity", (axis * rate).as_slice());
            run.start();
            let found = V::from(run.read_all::<3>("mount.moment"));
            let wanted = -axis * (k * angle + c * rate);
            assert!((found - wanted).norm() < 1e-9, "{angle}: {found} {wanted}");
        }
    }
}

/// A port that pulls through springs and dampers, whose orientation and place move: the work that the master does.
#[test]
fn what_comes_in_through_a_port_that_turns_and_moves_is_the_change_of_energy() {
    let mut chance = Chance(23);
    for (stiffness, damping) in [(40.0, 0.0), (40.0, 1.2), (0.0, 2.0)] {
        let turn = chance.vector();
        let scene = json!({"name": "coupled", "dimension": 3, "gravity": [0.0, 0.0, -2.0],
            "bodies": [body("b", V::zeros(), turn, [chance.vector(), chance.vector()])],
            "ports": [{"name": "p", "marker": "b.c", "kind": "motion", "stiffness": 30.0, "damping": 0.5,
                       "rotational_stiffness": stiffness, "rotational_damping": damping}],
            "outputs": outputs(), "accuracy": {"relative_tolerance": 1e-8}});
        let rate = V::new(0.8, -1.1, 0.9);
        let set = |run: &mut Run, k: u32| {
            let t = f64::from(k) * STEP;
            let at = |t: f64| {
                let q = nalgebra::UnitQuaternion::from_rotation_matrix(
                    &(Rotation3::new(rate * t) * Rotation3::new(turn)),
                );
                [q.w, q.i, q.j, q.k]
            };
            run.set_all("p.quaternion", &at(t));
            run.set_all("p.angular_velocity", rate.as_slice());
            run.set_all("p.position", &[0.2 * t, -0.1 * t, 0.0]);
            run.set_all("p.velocity", &[0.2, -0.1, 0.0]);
            let half = V::new(rate[0], rate[1], rate[2]) * 0.5;
            let [w, x, y, z] = at(t);
            let v = V::new(x, y, z);
            let moved = half * w + half.cross(&v);
            let rates = [-half.dot(&v), moved[0], moved[1], moved[2]];
            let bend = -half.norm_squared();
            for (part, (slope, now)) in rates.into_iter().zip(at(t)).enumerate() {
                let index = run.index(&format!("p.quaternion[{}]", part + 1));
                run.0.set_input_derivative(index, 1, slope).expect("a rate");
                run.0
                    .set_input_derivative(index, 2, bend * now)
                    .expect("a rate");
            }
            for (axis, slope) in [0.2, -0.1].into_iter().enumerate() {
                let index = run.index(&format!("p.position[{}]", axis + 1));
                run.0.set_input_derivative(index, 1, slope).expect("a rate");
            }
        };
        let mut run = Run::ready(&scene);
        set(&mut run, 0);
        run.start();
        // Between communication points quaternions are parabolas: that leaves the third order of a step.
        keeps_energy(&mut run, 60, set, 2e-5);
    }
}
