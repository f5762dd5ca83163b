//! Orders of all methods, and what conserves what, on smooth scenes of a few elements.

use std::sync::{Arc, Mutex};

use flexbody::integrators::{Attempt, StateView, Tolerance};
use flexbody::scene::Scene;
use flexbody::system::{DrivenSystem, Dynamics, Evaluation, State};

use super::{Build, Probe, build};
use crate::scene::Start;

const PENDULUM: &str = r#"{
  "name": "rod", "dimension": 2, "gravity": [0.0, -9.81],
  "bodies": [{"name": "rod", "element": "cable", "elements": 2,
    "material": {"youngs_modulus": 2.0e4, "density": 1000.0},
    "section": {"area": 1.0e-2, "second_moment": 1.0e-4},
    "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.0]}},
    "markers": {"root": 0.0, "tip": 1.0}}],
  "joints": [{"name": "pivot", "kind": "revolute", "markers": ["ground", "rod.root"]}],
  "outputs": [{"kind": "position", "marker": "rod.tip"}]
}"#;

/// A curved rod that flies, rotates and stretches.
const FREE: &str = r#"{
  "name": "rod", "dimension": 2, "gravity": [0.0, 0.0],
  "bodies": [{"name": "rod", "element": "cable", "elements": 3, "strain": "STRAIN",
    "material": {"youngs_modulus": 2.0e4, "density": 1000.0},
    "section": {"area": 1.0e-2, "second_moment": 1.0e-4},
    "shape": {"arc": {"from": [0.0, 0.0], "to": [1.0, 0.0], "length": 1.2}},
    "motion": {"velocity": [0.3, -0.2], "spin": 3.0},
    "markers": {"root": 0.0, "tip": 1.0}}],
  "outputs": [{"kind": "position", "marker": "rod.tip"}]
}"#;

/// Steps of equal length up to a time.
fn run(start: &Start, name: &str, stop: f64, steps: u32) -> State {
    let system = &start.assembled.system;
    let nodes = Arc::new(Mutex::new(start.assembled.nodes.clone()));
    let plan = Build {
        start,
        nodes: nodes.clone(),
        fixed: true,
    };
    let mut method = build(name, &plan).expect("a method");
    let (mut state, mut work) = (start.state.clone(), start.work.clone());
    let model = DrivenSystem::new(system, &start.inputs, &mut work, &start.state);
    let mut probe = Probe::new(model, Some(nodes));
    let tolerance = Tolerance {
        relative: 1e-13,
        position: system.scale(),
        time: 0.1,
    };
    let h = stop / f64::from(steps);
    method.begin(&mut probe, 0.0, &state.coordinates, &state.rates);
    for step in 0..steps {
        let from = StateView::of(&state);
        let attempt = method.attempt(&mut probe, from, h, &tolerance);
        assert!(matches!(attempt, Attempt::Done(_)), "{name}: {attempt:?}");
        method.accept(&mut state.coordinates, &mut state.rates);
        state.time = f64::from(step + 1) * h;
        probe.accepted(&mut state);
    }
    state
}

fn distance(a: &State, b: &State) -> f64 {
    let of = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum() };
    (of(&a.coordinates, &b.coordinates) + of(&a.rates, &b.rates)).sqrt()
}

#[test]
fn errors_shrink_with_the_order_of_the_method() {
    let start = Start::new(Scene::from_json(PENDULUM).expect("a scene")).expect("a start");
    let stop = 0.3;
    // Two methods of different families agree on the reference.
    let reference = run(&start, "rkn64", stop, 2400);
    let other = distance(&reference, &run(&start, "gauss6", stop, 300));
    assert!(other < 1e-10, "references differ by {other:e}");
    let methods = [
        ("verlet", 2.0, 300),
        ("rk4", 4.0, 400),
        ("dopri5", 5.0, 200),
        ("rkn43", 4.0, 300),
        ("rkn64", 6.0, 75),
        ("gauss6", 6.0, 20),
        ("radau", 5.0, 40),
        ("alpha_1.0", 2.0, 300),
        ("alpha_0.8", 2.0, 300),
        ("alpha_0.6", 2.0, 300),
        ("trapezoid", 2.0, 300),
        ("midpoint", 2.0, 300),
        ("energy_momentum", 2.0, 300),
    ];
    let mut wrong = Vec::new();
    for (name, order, steps) in methods {
        let [coarse, fine] =
            [steps, 2 * steps].map(|n| distance(&reference, &run(&start, name, stop, n)));
        let observed = (coarse / fine).log2();
        println!("{name}: {coarse:.1e} {fine:.1e}, order {observed:.2}");
        if (observed - order).abs() > 0.2 {
            wrong.push(format!("{name}: order {observed}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn energy_and_momenta_stay_with_the_energy_momentum_scheme() {
    for strain in [
        "thetaPrime",
        "GreenLagrange_FrenetKappa",
        "engStrain_FrenetKappa",
    ] {
        let text = FREE.replace("STRAIN", strain);
        let start = Start::new(Scene::from_json(&text).expect("a scene")).expect("a start");
        let system = &start.assembled.system;
        let mut work = start.work.clone();
        let mut measure = |state: &State| {
            let mut values = Evaluation::new(system);
            values.kinematics(system, state, &mut work);
            let (momentum, [.., angular]) = values.momentum(system);
            let energies = (values.kinetic_energy(system), values.strain_energy(system));
            (
                [energies.0 + energies.1, momentum[0], momentum[1], angular],
                energies.1,
            )
        };
        let (before, _) = measure(&start.state);
        // A step that is far too long to be accurate.
        let end = run(&start, "energy_momentum", 2.0, 100);
        let (after, strained) = measure(&end);
        assert!(
            strained > 1e-3 * before[0],
            "nothing is strained: {strained}"
        );
        for (a, b) in before.iter().zip(after) {
            assert!(
                (a - b).abs() < 1e-10 * a.abs(),
                "{strain}: {before:?} {after:?}"
            );
        }
        // Those of another method do not stay.
        let (other, _) = measure(&run(&start, "trapezoid", 2.0, 100));
        assert!(
            (other[0] - before[0]).abs() > 1e-6 * before[0],
            "{strain}: {other:?}"
        );
    }
}
