//! Laws of motion of whole systems: rigid motion, momentum, energy, free fall.

use flexbody::elements::Element;
use flexbody::scene::{Scene, assemble};
use flexbody::simulation::Simulation;
use flexbody::system::{Evaluation, State, System, Workspace};
use nalgebra::{Matrix2, Vector2};

/// A free sagging cable, spinning and thrown, by integrator and tolerance.
fn scene(integrator: &str, tolerance: f64, gravity: f64) -> Scene {
    let text = format!(
        r#"{{ "name": "free", "dimension": 2, "gravity": [0.0, {gravity}],
          "bodies": [ {{ "name": "rod", "element": "cable", "elements": 7,
            "material": {{ "youngs_modulus": 7.0e5, "density": 5540.0 }},
            "section": {{ "area": 1.8e-3, "second_moment": 1.215e-8 }},
            "shape": {{ "arc": {{ "from": [0.2, -0.1], "to": [1.2, 0.3], "length": 1.3 }} }},
            "motion": {{ "velocity": [0.7, -0.4], "spin": 3.0 }},
            "markers": {{ "tip": 1.0 }} }} ],
          "inputs": [ {{ "kind": "force", "marker": "rod.tip" }} ],
          "outputs": [ {{ "kind": "energy" }} ],
          "accuracy": {{ "relative_tolerance": {tolerance:e} }},
          "method": {{ "integrator": "{integrator}" }} }}"#
    );
    Scene::from_json(&text).expect("a valid scene")
}

/// Mass, and centre of mass, linear and angular momentum about the origin, and energy of a state.
struct Bulk {
    mass: f64,
    centre: Vector2<f64>,
    linear: Vector2<f64>,
    angular: f64,
    energy: f64,
}

fn bulk(system: &System, state: &State) -> Bulk {
    let mut values = Evaluation::new(system);
    values.kinematics(system, state, &mut Workspace::new(system));
    let mut bulk = Bulk {
        mass: 0.0,
        centre: Vector2::zeros(),
        linear: Vector2::zeros(),
        angular: 0.0,
        energy: values.strain_energy(system) + values.kinetic_energy(system),
    };
    let chain = &system.bodies().lines()[0];
    for (j, element) in chain.elements().iter().enumerate() {
        let (e, rate) = (chain.element(j, &values.x), chain.element(j, &values.v));
        let weight = element.weight();
        bulk.mass += weight[0] + weight[2];
        bulk.centre += e * weight;
        bulk.linear += rate * weight;
        let momenta = rate * element.mass();
        for k in 0..4 {
            bulk.angular += e.column(k).perp(&momenta.column(k));
        }
    }
    bulk.centre /= bulk.mass;
    // The same by what is given out.
    let (linear, [.., angular]) = values.momentum(system);
    assert!((linear - bulk.linear).norm() < 1e-12 * (1.0 + bulk.linear.norm()));
    assert!((angular - bulk.angular).abs() < 1e-12 * (1.0 + bulk.angular.abs()));
    assert!((values.center_of_mass(system) - bulk.centre).norm() < 1e-12);
    bulk
}

/// A started simulation with its system.
fn start(integrator: &str, tolerance: f64, gravity: f64) -> (Simulation, System) {
    let scene = scene(integrator, tolerance, gravity);
    let system = assemble::<2>(&scene).expect("a fine enough mesh").system;
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("a valid scene");
    simulation.start().expect("a valid scene");
    (simulation, system)
}

#[test]
fn rigid_rates_of_a_free_body_are_exactly_rigid() {
    let (simulation, system) = start("auto", 1e-4, 0.0);
    let state = simulation.snapshot().state;
    let mut values = Evaluation::new(&system);
    values.kinematics(&system, &state, &mut Workspace::new(&system));
    let (velocity, spin) = (Vector2::new(0.7, -0.4), Matrix2::new(0.0, -3.0, 3.0, 0.0));
    let origin = Vector2::new(0.2, -0.1);
    for (x, rate) in values.x.iter().zip(&values.v) {
        let [p, s] = x.map(Vector2::from);
        let [moving, turning] = rate.map(Vector2::from);
        let exact = velocity + spin * (p - origin);
        assert!((moving - exact).norm() < 1e-13);
        let turn = (turning - spin * s).norm();
        assert!(turn < 1e-12, "{turn:e}");
    }
}

/// Relative errors of linear and angular momentum and of energy after 1.5 s of free flight.
fn lost(integrator: &str, tolerance: f64) -> [f64; 3] {
    let (mut simulation, system) = start(integrator, tolerance, 0.0);
    let before = bulk(&system, &simulation.snapshot().state);
    for step in 1..=30 {
        simulation
            .step(0.05 * f64::from(step))
            .expect("a free flight");
    }
    let after = bulk(&system, &simulation.snapshot().state);
    [
        (after.linear - before.linear).norm() / before.linear.norm(),
        (after.angular - before.angular).abs() / before.angular.abs(),
        (after.energy - before.energy).abs() / before.energy,
    ]
}

#[test]
fn a_free_flight_keeps_momentum_and_energy() {
    for integrator in ["radau", "rk4"] {
        for tolerance in [1e-4, 1e-8] {
            let [linear, angular, energy] = lost(integrator, tolerance);
            let lost = format!(
                "{integrator} at {tolerance:e} loses {linear:.1e} of linear momentum, {angular:.1e} of angular momentum, {energy:.1e} of energy"
            );
            println!("{lost}");
            // Every Runge-Kutta method keeps linear invariants, also where stages are not solved exactly.
            assert!(linear < 1e-12, "{lost}");
            assert!(
                angular < 10.0 * tolerance && energy < 10.0 * tolerance,
                "{lost}"
            );
        }
    }
}

#[test]
fn a_falling_body_has_its_centre_of_mass_on_the_parabola() {
    for integrator in ["radau", "rk4"] {
        let (mut simulation, system) = start(integrator, 1e-4, -9.81);
        let before = bulk(&system, &simulation.snapshot().state);
        for step in 1..=20 {
            let t = 0.05 * f64::from(step);
            simulation.step(t).expect("a free fall");
            let now = bulk(&system, &simulation.snapshot().state);
            let fall = Vector2::new(0.0, -0.5 * 9.81 * t * t);
            let exact = before.centre + before.linear / before.mass * t + fall;
            let off = (now.centre - exact).norm();
            assert!(off < 1e-10, "{integrator} at {t} s: {off:e} m");
        }
    }
}

#[test]
fn a_held_force_accelerates_the_centre_of_mass() {
    for integrator in ["radau", "rk4"] {
        let (mut simulation, system) = start(integrator, 1e-5, 0.0);
        let input = |name: &str, simulation: &Simulation| {
            let variables = simulation.variables();
            variables
                .iter()
                .position(|v| v.name == name)
                .expect("an input")
        };
        let (x, y) = (
            input("rod.tip.force[1]", &simulation),
            input("rod.tip.force[2]", &simulation),
        );
        let mut linear = bulk(&system, &simulation.snapshot().state).linear;
        for (step, force) in [(1, [3.0, -2.0]), (2, [-1.0, 0.5]), (3, [0.0, 4.0])] {
            simulation.set_real(x, force[0]).expect("an input");
            simulation.set_real(y, force[1]).expect("an input");
            simulation.step(0.1 * f64::from(step)).expect("a flight");
            linear += Vector2::from(force) * 0.1;
            let now = bulk(&system, &simulation.snapshot().state).linear;
            let off = (now - linear).norm() / linear.norm();
            assert!(off < 1e-12, "{integrator}: {off:e}");
        }
    }
}
