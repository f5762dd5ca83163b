//! The choice between an explicit and the implicit method while a simulation runs: it finds the cheaper one, and a restored
//! state goes on with the same bits in the middle of a trial and after a change.

use flexbody::scene::{Integrator, Scene};
use flexbody::simulation::{Simulation, Snapshot};

/// Driven slowly from rest: the rule that begins takes it for soft.
const SPIN_UP: &str = include_str!("../scenes/spin_up_beam.json");
/// Communication points of a run.
const POINTS: u32 = 120;

fn scene(integrator: Integrator) -> Scene {
    let mut scene = Scene::from_json(SPIN_UP).expect("a scene");
    scene.bodies[0].cable_mut().expect("a cable").elements = Some(2);
    scene.accuracy = Default::default();
    scene.accuracy.relative_tolerance = Some(1e-4);
    scene.method.integrator = integrator;
    scene
}

/// Snapshots at the start and at every communication point, methods and work, in steps of a length, s.
fn run(integrator: Integrator, step: f64) -> (Vec<Snapshot>, Vec<&'static str>, f64) {
    let mut simulation = Simulation::new(scene(integrator));
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    let (mut states, mut methods, mut work) = (vec![simulation.snapshot()], Vec::new(), 0.0);
    for point in 1..=POINTS {
        simulation.step(step * f64::from(point)).expect("a step");
        states.push(simulation.snapshot());
        methods.push(simulation.report().method);
        work += simulation.report().work;
    }
    (states, methods, work)
}

#[test]
fn the_cheaper_method_goes_on() {
    let (_, methods, work) = run(Integrator::Auto, 0.05);
    let named = [Integrator::Rk4, Integrator::Radau];
    let [(.., explicit), (.., implicit)] = named.map(|method| run(method, 0.05));
    assert_eq!(methods.last(), Some(&"radau"));
    assert!(
        explicit > 10.0 * implicit,
        "{explicit} explicitly, {implicit} implicitly"
    );
    assert!(
        work < 1.5 * implicit,
        "{work} with the choice, {implicit} without"
    );
}

#[test]
fn a_restored_state_goes_on_with_the_same_bits() {
    // So short that trials go on over several points.
    let step = 1e-3;
    let (states, methods, _) = run(Integrator::Auto, step);
    let trials = states
        .iter()
        .filter(|snapshot| snapshot.state.pace.trial > 0.0);
    assert!(trials.count() > 0, "no point within a trial");
    assert!(
        methods.windows(2).any(|pair| pair[0] != pair[1]),
        "no change"
    );
    let mut other = Simulation::new(scene(Integrator::Auto));
    other.initialize(0.0).expect("a start");
    for first in 0..states.len() - 3 {
        other.restore(&states[first]).expect("a state");
        for next in first + 1..first + 4 {
            other.step(step * next as f64).expect("a step");
            assert_eq!(
                other.snapshot(),
                states[next],
                "from point {first} to {next}"
            );
            assert_eq!(other.report().method, methods[next - 1]);
        }
    }
}
