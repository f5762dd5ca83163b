//! Steps that lead beyond communication points: what is read within them, what takes them back, and states restored there.

use std::f64::consts::TAU;

use flexbody::scene::Scene;
use flexbody::simulation::{Simulation, Snapshot};
use serde_json::{Value, json};

fn started(scene: &Value) -> Simulation {
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    simulation
}

fn get(simulation: &mut Simulation, name: &str) -> f64 {
    let variables = simulation.variables();
    let index = variables.iter().position(|v| v.name == name);
    simulation.real(index.expect(name)).expect("a number")
}

fn set(simulation: &mut Simulation, name: &str, value: f64) {
    let variables = simulation.variables();
    let index = variables.iter().position(|v| v.name == name);
    simulation
        .set_real(index.expect(name), value)
        .expect("an input");
}

/// A particle that is pulled.
fn particle(load: Value, inputs: Value) -> Value {
    json!({
        "name": "particle", "dimension": 2, "gravity": [0.0, 0.0],
        "bodies": [{"name": "ball", "element": "rigid", "mass": 1.0, "position": [2.0, 0.0],
            "markers": {"c": [0.0, 0.0]}}],
        "loads": load,
        "inputs": inputs,
        "outputs": [{"kind": "position", "marker": "ball.c"}, {"kind": "velocity", "marker": "ball.c"},
            {"kind": "work"}],
        "accuracy": {"relative_tolerance": 1e-6},
        "method": {"integrator": "radau"},
    })
}

/// A stiff rod that rotates about its end without gravity, one revolution a second.
fn turning_rod() -> Value {
    json!({
        "name": "turning", "dimension": 2,
        "gravity": [0.0, 0.0],
        "bodies": [{"name": "rod", "element": "cable", "elements": 2,
            "material": {"youngs_modulus": 2e11, "density": 8000.0},
            "section": {"area": 1e-4, "second_moment": 8e-10},
            "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.0]}},
            "motion": {"spin": TAU},
            "markers": {"root": 0.0, "middle": 0.5, "tip": 1.0}}],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "rod.root"]}],
        "initial": "steady",
        "inputs": [{"kind": "force", "marker": "rod.tip"}],
        "outputs": [{"kind": "reaction", "joint": "pin"}, {"kind": "axial_force", "marker": "rod.middle"},
            {"kind": "position", "marker": "rod.tip"}],
        "accuracy": {"relative_tolerance": 1e-4},
        "method": {"integrator": "radau"},
    })
}

#[test]
fn points_within_a_step_are_as_accurate_as_its_end_and_cost_none() {
    let load =
        json!([{"name": "push", "kind": "force", "marker": "ball.c", "value": ["cos(t)", 0.0]}]);
    let mut simulation = started(&particle(load, json!([])));
    let (points, mut steps) = (2000, 0);
    for point in 1..=points {
        let time = 3.0 * TAU * f64::from(point) / f64::from(points);
        simulation.step(time).expect("a step");
        steps += simulation.report().steps;
        let found = ["ball.c.position[1]", "ball.c.velocity[1]", "energy.input"]
            .map(|name| get(&mut simulation, name));
        let wanted = [3.0 - time.cos(), time.sin(), 0.5 * time.sin().powi(2)];
        for (found, wanted) in found.into_iter().zip(wanted) {
            let off = (found - wanted).abs();
            assert!(off < 2e-5, "{found} for {wanted} at {time}");
        }
    }
    assert!(steps < 200, "{steps} steps");
}

#[test]
fn forces_within_a_step_are_those_of_the_motion() {
    let mut simulation = started(&turning_rod());
    let (points, mut steps) = (1000, 0);
    for point in 1..=points {
        simulation.step(2e-3 * f64::from(point)).expect("a step");
        steps += simulation.report().steps;
        let reaction =
            ["pin.reaction[1]", "pin.reaction[2]"].map(|name| get(&mut simulation, name));
        // A rigid rod: rho A w^2 L^2 / 2 at the pin, three quarters of it in the middle.
        let pull = 0.8 * TAU * TAU / 2.0;
        let off = (reaction[0].hypot(reaction[1]) / pull - 1.0).abs();
        assert!(off < 5e-3, "{off} of the reaction at point {point}");
        let off = (get(&mut simulation, "rod.middle.axial_force") / (0.75 * pull) - 1.0).abs();
        assert!(off < 5e-3, "{off} of the axial force at point {point}");
    }
    assert!(steps < 100, "{steps} steps");
}

#[test]
fn an_input_that_changes_takes_the_step_back() {
    let pulled = particle(json!([]), json!([{"kind": "force", "marker": "ball.c"}]));
    let mut simulation = started(&pulled);
    set(&mut simulation, "ball.c.force[1]", 3.0);
    let (mut x, mut v, mut force, mut work, step) = (2.0, 0.0, 3.0, 0.0, 0.01);
    let mut within = 0;
    for point in 1..=400 {
        if point % 57 == 0 {
            force = -force;
            set(&mut simulation, "ball.c.force[1]", force);
        }
        simulation.step(step * f64::from(point)).expect("a step");
        let moved = v * step + 0.5 * force * step * step;
        (x, v, work) = (x + moved, v + force * step, work + force * moved);
        within += usize::from(simulation.report().steps == 0);
        let found = ["ball.c.position[1]", "ball.c.velocity[1]", "energy.input"]
            .map(|name| get(&mut simulation, name));
        for (found, wanted) in found.into_iter().zip([x, v, work]) {
            assert!(
                (found - wanted).abs() < 1e-10,
                "{found} for {wanted} at {point}"
            );
        }
    }
    assert!(within > 200, "{within} points within a step");
}

/// As from its bytes: what a step that is over has left is not kept.
fn copied(snapshot: &Snapshot) -> Snapshot {
    let mut copy = snapshot.clone();
    if copy.state.dense.length == 0.0 {
        copy.state.dense.vectors.fill(0.0);
    }
    copy
}

#[test]
fn a_restored_state_goes_on_with_the_same_bits() {
    let scene = turning_rod();
    let mut simulation = started(&scene);
    let mut states = vec![simulation.snapshot()];
    for point in 1..=300 {
        if point % 41 == 0 {
            set(&mut simulation, "rod.tip.force[2]", 1e-6 * f64::from(point));
        }
        simulation.step(2e-3 * f64::from(point)).expect("a step");
        states.push(simulation.snapshot());
    }
    let within = states.iter().filter(|s| s.state.dense.is_under_way());
    assert!(within.count() > 150, "few points within a step");
    let mut other = started(&scene);
    for first in (0..states.len() - 4).rev() {
        other.restore(&copied(&states[first])).expect("a state");
        for next in first + 1..first + 4 {
            if next % 41 == 0 {
                set(&mut other, "rod.tip.force[2]", 1e-6 * next as f64);
            }
            other.step(2e-3 * next as f64).expect("a step");
            let (found, wanted) = (copied(&other.snapshot()), copied(&states[next]));
            assert_eq!(found, wanted, "from point {first} to {next}");
        }
    }
}
