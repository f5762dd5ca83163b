//! Free rods that spin: energy and angular momentum are kept as the step allows, with the order of the method. Without the gyroscopic
//! force of spin energy alone would be.

use flexbody::integrators::{Attempt, OneStepMethod, RK4, RungeKutta, StateView, Tolerance};
use flexbody::scene::{Assembled, Scene};
use flexbody::system::{DrivenSystem, Dynamics, Evaluation, State, System, Workspace};
use nalgebra::Vector3;
use serde_json::json;

const ELEMENTS: usize = 4;
const END: f64 = 0.2;

/// A strip thrown with bending and fast spin about its axis.
fn thrown(element: &str) -> Assembled<3> {
    let mut section = json!({"area": 2e-4, "second_moments": [1.6667e-9, 6.6667e-9], "torsion_constant": 4.58e-9});
    if element == "beam" {
        section["shear_factors"] = json!([0.8, 0.6]);
    }
    let scene = json!({"name": "thrown", "dimension": 3, "gravity": [0.0, 0.0, 0.0],
        "bodies": [{"name": "rod", "element": element, "elements": ELEMENTS, "axis": [0.0, 1.0, 0.0],
            "material": {"youngs_modulus": 5e6, "shear_modulus": 2e6, "density": 1e3}, "section": section,
            "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [1.0, 0.0, 0.0]}},
            "motion": {"spin": [200.0, 3.0, 5.0], "deformation": ["0", "0.5*sin(PI*s)", "0.3*cos(2*PI*s)"]}}]});
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let resolved = scene.resolve().expect("names that are there");
    resolved.assemble().expect("a system")
}

/// Energy and angular momentum.
fn invariants(
    system: &System<3>,
    values: &mut Evaluation<3>,
    state: &State,
    work: &mut Workspace<3>,
) -> (f64, Vector3<f64>) {
    values.kinematics(system, state, work);
    let energy = values.kinetic_energy(system) + values.strain_energy(system);
    (energy, values.momentum(system).1.into())
}

/// Largest changes of both, relative to their sizes, with so many steps.
fn changes(element: &str, steps: u32) -> [f64; 2] {
    let assembled = thrown(element);
    let (system, h) = (&assembled.system, END / f64::from(steps));
    let mut work = Workspace::new(system);
    let described = (&assembled.nodes[..], &assembled.rates[..]);
    let state = system.initial_state(0.0, &[], described, &mut work);
    let mut state = state.expect("a state");
    let mut values = Evaluation::new(system);
    let (energy, momentum) = invariants(system, &mut values, &state, &mut work);
    let mut method = RungeKutta::new(&RK4, system.coordinates(), 1.0, 0.0);
    let tolerance = Tolerance {
        relative: 1.0,
        position: 1.0,
        time: 1.0,
    };
    let mut most = [0.0_f64; 2];
    for step in 0..steps {
        let time = h * f64::from(step);
        let mut model = DrivenSystem::new(system, &[], &mut work, &state);
        method.begin(&mut model, time, &state.coordinates, &state.rates);
        let from = StateView {
            time,
            ..StateView::of(&state)
        };
        let attempt = method.attempt(&mut model, from, h, &tolerance);
        assert!(
            matches!(attempt, Attempt::Done(_)),
            "{element}, {steps} steps"
        );
        method.accept(&mut state.coordinates, &mut state.rates);
        state.time = time + h;
        model.accepted(&mut state);
        let (now, turning) = invariants(system, &mut values, &state, &mut work);
        most[0] = most[0].max((now / energy - 1.0).abs());
        most[1] = most[1].max((turning - momentum).norm() / momentum.norm());
    }
    most
}

/// Runge and Kutta's method is of order 4, in the energy of 5; the angular momentum is conserved by the equations, not by the method.
#[test]
fn energy_and_angular_momentum_are_kept_with_the_order_of_the_method() {
    for (element, steps) in [("rod", 500), ("beam", 4000)] {
        let found = [2, 4].map(|times| changes(element, times * steps));
        for (k, (of, order)) in [("energy", 4.5), ("angular momentum", 3.8)]
            .iter()
            .enumerate()
        {
            let [coarse, fine] = found.map(|changes| changes[k]);
            assert!(
                fine < 1e-10 && (coarse / fine).log2() > *order,
                "{of} of a {element}: {found:?}"
            );
        }
    }
}
