//! The choice between an explicit and the implicit method while a simulation runs: it finds the cheaper one, and a restored
//! state goes on with the same bits in the middle of a trial and after a change.

use std::f64::consts::PI;

use flexbody::scene::{Integrator, Scene};
use flexbody::simulation::{Simulation, Snapshot};

/// A soft pendulum without damping: what holds its explicit steps back is their error.
const PENDULUM: &str = include_str!("cases/soft_pendulum/scene.json");
/// Driven slowly from rest: the rule that begins takes it for soft.
const SPIN_UP: &str = include_str!("../scenes/spin_up_beam.json");
/// A body that rotates fast.
const GYROSCOPE: &str = include_str!("../scenes/gyroscope.json");
/// Solved implicitly but for trials of either explicit tableau.
const LOAD: &str = include_str!("../scenes/travelling_load.json");
/// Communication points of a run.
const POINTS: u32 = 120;

fn scene(integrator: Integrator) -> Scene {
    of(SPIN_UP, 2, 1e-4, integrator)
}

fn of(text: &str, elements: u32, tolerance: f64, integrator: Integrator) -> Scene {
    let mut scene = Scene::from_json(text).expect("a scene");
    scene.bodies[0].cable_mut().expect("a cable").elements = Some(elements);
    scene.accuracy = Default::default();
    scene.accuracy.relative_tolerance = Some(tolerance);
    scene.method.integrator = integrator;
    scene
}

/// Snapshots at the start and at every communication point, methods and work, in steps of a length, s.
fn run(integrator: Integrator, step: f64) -> (Vec<Snapshot>, Vec<&'static str>, f64) {
    run_of(scene(integrator), step)
}

fn run_of(scene: Scene, step: f64) -> (Vec<Snapshot>, Vec<&'static str>, f64) {
    let mut simulation = Simulation::new(scene);
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
    restores(scene(Integrator::Auto), step, (&states, &methods));
}

/// Every snapshot of a run leads to the same bits as the run.
fn restores(scene: Scene, step: f64, (states, methods): (&[Snapshot], &[&str])) {
    let mut other = Simulation::new(scene);
    other.initialize(0.0).expect("a start");
    // Backwards, so that what was in use later must not count.
    for first in (0..states.len() - 3).rev() {
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

#[test]
fn the_order_follows_what_holds_steps_back() {
    let pendulum = |tolerance, integrator| of(PENDULUM, 12, tolerance, integrator);
    for (tolerance, gain) in [(1e-3, 0.1), (1e-4, 0.1), (1e-5, 0.1), (1e-7, 0.3)] {
        let named = [Integrator::Auto, Integrator::Rkn43, Integrator::Rkn64];
        let [auto, low, high] =
            named.map(|integrator| run_of(pendulum(tolerance, integrator), 0.01).2);
        println!("{tolerance:e}: {auto} with the choice, {low} of order 4, {high} of order 6");
        assert!(
            auto < 1.05 * low.min(high),
            "{tolerance:e}: {auto}, {low}, {high}"
        );
        assert!(
            auto < (1.0 - gain) * low * 1.05,
            "{tolerance:e}: {auto}, {low}"
        );
    }
}

/// Bodies in space: accelerations read rates.
#[test]
fn the_order_with_rates_follows_what_holds_steps_back() {
    for (tolerance, step, gain) in [
        (1e-4, 0.01, 0.0),
        (1e-6, 0.01, 0.4),
        (1e-8, 0.01, 0.6),
        (1e-6, 1e-3, 0.0),
    ] {
        let named = [Integrator::Auto, Integrator::Rk4, Integrator::Dopri853];
        let [auto, low, high] =
            named.map(|integrator| run_of(gyroscope(tolerance, integrator), step).2);
        println!("{tolerance:e}: {auto} with the choice, {low} of order 4, {high} of order 8");
        assert!(
            auto < 1.1 * low.min(high),
            "{tolerance:e}: {auto}, {low}, {high}"
        );
        assert!(
            auto < (1.0 - gain) * low * 1.1,
            "{tolerance:e}: {auto}, {low}"
        );
    }
}

fn gyroscope(tolerance: f64, integrator: Integrator) -> Scene {
    let mut scene = Scene::from_json(GYROSCOPE).expect("a scene");
    scene.accuracy = Default::default();
    scene.accuracy.relative_tolerance = Some(tolerance);
    scene.method.integrator = integrator;
    scene
}

#[test]
fn a_restored_state_goes_on_with_the_same_order() {
    let scene = || of(PENDULUM, 12, 1e-5, Integrator::Auto);
    let step = 5e-3;
    let (states, methods, _) = run_of(scene(), step);
    for name in ["rkn43", "rkn64"] {
        let points = methods.iter().filter(|method| **method == name).count();
        assert!(points > 2, "{name} at {points} points");
    }
    restores(scene(), step, (&states, &methods));
}

#[test]
fn a_restored_state_tries_the_same_order() {
    let scene = || of(LOAD, 4, 1e-5, Integrator::Auto);
    let step = 0.02;
    let (states, methods, _) = run_of(scene(), step);
    restores(scene(), step, (&states, &methods));
}

/// A bar on two pins without damping under `q sin(W t)` along it: `EI = 91.234 N m^2`, `m = 0.33766 kg/m`, 2.35 m.
const BAR: &str = r#"{
    "name": "bar", "dimension": 2, "gravity": [0, 0],
    "bodies": [{"name": "line", "element": "cable", "elements": 4,
                "material": {"youngs_modulus": 7e10, "density": 2700},
                "section": {"area": 1.2506e-4, "second_moment": 1.30334e-9},
                "shape": {"line": {"from": [0, 0], "to": [2.35, 0]}}, "markers": {"root": 0, "middle": 0.5, "tip": 1}}],
    "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "line.root"]},
               {"name": "roller", "kind": "point_on_line", "markers": ["ground", "line.tip"], "direction": [1, 0]}],
    "loads": [{"name": "load", "kind": "distributed_force", "body": "line", "value": [0, "3.8e-6*sin(8.8*t)"]}],
    "outputs": [{"kind": "position", "marker": "line.middle"}],
    "accuracy": {"relative_tolerance": 1e-11}
}"#;

/// Deflection of the middle of that bar at a time, m: the sum of odd modes
/// `4 q / (n pi m) sin(n pi / 2) (sin(W t) - W / w sin(w t)) / (w^2 - W^2)` with `w = (n pi / L)^2 sqrt(EI / m)`.
///
/// Source: S. S. Rao, Mechanical Vibrations, section 8.5.
fn deflection(t: f64) -> f64 {
    let (bending, mass) = (7e10_f64 * 1.30334e-9, 2700.0 * 1.2506e-4);
    let (length, load, driven) = (2.35, 3.8e-6, 8.8_f64);
    let modes = [1.0_f64, 3.0, 5.0, 7.0]
        .into_iter()
        .zip([1.0, -1.0, 1.0, -1.0]);
    let parts = modes.map(|(n, sign)| {
        let w = (n * PI / length).powi(2) * (bending / mass).sqrt();
        let swing = (driven * t).sin() - driven / w * (w * t).sin();
        sign * 4.0 * load / (n * PI * mass) * swing / (w * w - driven * driven)
    });
    parts.sum()
}

/// A vibration that the tolerance resolves is there after a change of methods, whose first step nothing has set.
#[test]
fn a_change_of_methods_loses_no_vibration() {
    let mut simulation = Simulation::new(Scene::from_json(BAR).expect("a scene"));
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    let mut variables = simulation.variables().iter();
    let middle = variables.position(|v| v.name == "line.middle.position[2]");
    let middle = middle.expect("an output");
    let (mut largest, mut error) = (0.0_f64, 0.0_f64);
    for point in 1..=POINTS {
        let t = 0.00716 * f64::from(point);
        simulation.step(t).expect("a step");
        let found = simulation.real(middle).expect("a number");
        largest = largest.max(deflection(t).abs());
        error = error.max((found - deflection(t)).abs());
    }
    assert!(error < 0.01 * largest, "{error:e} of {largest:e}");
}

/// A square plate of so many elements a side, clamped at an edge or free and thrown with a twist, without damping.
fn plate(elements: u32, [modulus, density]: [f64; 2], is_clamped: bool) -> Scene {
    let mut scene = serde_json::json!({"name": "sheet", "dimension": 3, "gravity": [0, 0, -9.81],
        "bodies": [{"name": "p", "element": "plate", "mesh": [elements, elements], "thickness": 0.01,
            "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[1, 0, 0], [0, 1, 0]]}},
            "material": {"youngs_modulus": modulus, "poisson_ratio": 0.3, "density": density},
            "markers": {"last": [1, 1]}}],
        "joints": [], "outputs": [{"kind": "position", "marker": "p.last"}],
        "loads": [{"name": "pull", "kind": "force", "marker": "p.last", "value": ["0", "0", "4*sin(20*t)"]}],
        "accuracy": {"relative_tolerance": 1e-4}, "method": {"integrator": "auto"}});
    if is_clamped {
        scene["joints"] =
            serde_json::json!([{"name": "edge", "kind": "clamped", "edges": ["ground", "p.s1=0"]}]);
    }
    Scene::from_json(&scene.to_string()).expect("a scene")
}

/// A free soft sheet is followed wave by wave, a panel of steel is not: what factors of its mesh cost is less than that.
#[test]
fn sheets_go_explicitly_and_panels_implicitly() {
    let method = |scene: Scene, step: f64| {
        let mut simulation = Simulation::new(scene);
        simulation.initialize(0.0).expect("a start");
        simulation.start().expect("a start");
        for point in 1..=10 {
            simulation.step(step * f64::from(point)).expect("a step");
        }
        simulation.report().method
    };
    let sheet = method(plate(6, [1e6, 1000.0], false), 5e-3);
    assert!(sheet.starts_with("rkn"), "{sheet}");
    assert_eq!(method(plate(6, [2.1e11, 7800.0], true), 5e-3), "radau");
}
