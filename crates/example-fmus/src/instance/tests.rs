//! Instances against closed forms.

use super::*;

/// A model ready for steps, with some of its variables set.
fn ready(name: &str, values: &[(&str, f64)]) -> Instance {
    let model = ALL.iter().find(|model| model.name == name);
    let mut instance = Instance::new(&model.expect("a model").guid()).expect("its instance");
    for (variable, value) in values {
        let reference = reference(&instance, variable);
        instance
            .set(reference, *value)
            .expect("a settable variable");
    }
    instance
        .advance(Phase::Instantiated, Phase::Initialization)
        .expect("finite equations");
    instance
        .advance(Phase::Initialization, Phase::Ready)
        .expect("finite equations");
    instance
}

fn reference(instance: &Instance, name: &str) -> u32 {
    let Model {
        inputs,
        outputs,
        parameters,
        ..
    } = instance.model;
    let mut all = inputs.iter().chain(*outputs).chain(*parameters);
    all.position(|quantity| quantity.name == name)
        .expect("a variable") as u32
}

fn close(found: Result<f64, Refusal>, expected: f64) {
    let found = found.expect("a value");
    let error = (found - expected).abs();
    assert!(
        error <= 1e-12 * expected.abs().max(1.0),
        "{found}, expected {expected}"
    );
}

#[test]
fn a_mass_under_a_quadratic_force_moves_along_a_quartic() {
    let mut mass = ready(
        "mass",
        &[("mass", 2.0), ("initial_velocity", 0.5), ("force", 3.0)],
    );
    mass.set_derivative(0, 1, 4.0).expect("an input");
    mass.set_derivative(0, 2, 5.0).expect("an input");
    let t: f64 = 0.7;
    mass.step(0.0, t).expect("a step");
    let force = 3.0 + 4.0 * t + 2.5 * t.powi(2);
    let velocity = 0.5 + (3.0 * t + 2.0 * t.powi(2) + 2.5 / 3.0 * t.powi(3)) / 2.0;
    let position =
        0.5 * t + (1.5 * t.powi(2) + 2.0 / 3.0 * t.powi(3) + 2.5 / 12.0 * t.powi(4)) / 2.0;
    let [x, v, a] = ["position", "velocity", "acceleration"].map(|name| reference(&mass, name));
    for (output, order, expected) in [
        (x, 0, position),
        (x, 1, velocity),
        (x, 2, force / 2.0),
        (v, 0, velocity),
        (v, 2, (4.0 + 5.0 * t) / 2.0),
        (a, 0, force / 2.0),
        (a, 2, 2.5),
        (a, 3, 0.0),
    ] {
        close(mass.output_derivative(output, order), expected);
    }
    // Derivatives hold for one step: the force stays now.
    mass.step(t, 1.0).expect("a step");
    close(mass.get(a), force / 2.0);
    close(mass.output_derivative(a, 1), 0.0);
}

#[test]
fn a_damped_oscillator_swings_as_it_should_with_any_steps() {
    let values = [
        ("stiffness", 10.0),
        ("damping", 1.0),
        ("initial_position", 1.0),
    ];
    let mut mass = ready("mass", &values);
    let position = reference(&mass, "position");
    let rate = f64::sqrt(10.0 - 0.25);
    let mut time = 0.0;
    for step in [0.01, 0.3, 1.7, 1e-6, 20.0] {
        mass.step(time, step).expect("a step");
        time += step;
        let (sin, cos) = (rate * time).sin_cos();
        close(
            mass.get(position),
            (-0.5 * time).exp() * (cos + 0.5 / rate * sin),
        );
    }
}

#[test]
fn a_blocked_cylinder_builds_up_pressure() {
    let mut cylinder = ready("hydraulic_cylinder", &[("valve", 1e-6)]);
    cylinder.step(0.0, 2e-2).expect("a step");
    let pressure = 0.5 * 1e-6 / 1e-11 * (1.0 - f64::exp(-4.0 * 7e8 / 1e-3 * 1e-11 * 2e-2));
    let force = reference(&cylinder, "force");
    close(cylinder.get(force), 1e-3 * pressure);
}

#[test]
fn a_controller_integrates_a_ramp() {
    let values = [
        ("proportional_gain", 2.0),
        ("integral_gain", 3.0),
        ("initial_command", 7.0),
        ("reference", 1.0),
    ];
    let mut controller = ready("pi_controller", &values);
    controller.set_derivative(0, 1, 0.5).expect("an input");
    controller.step(0.0, 2.0).expect("a step");
    close(
        controller.get(2),
        2.0 * 2.0 + 7.0 + 3.0 * (2.0 + 0.25 * 4.0),
    );
    close(controller.directional(2, &[0, 1], &[1.0, 10.0]), -18.0);
}

#[test]
fn dependencies_are_those_of_the_equations() {
    let of = |model: &Model| -> Vec<Vec<usize>> {
        (0..model.outputs.len())
            .map(|output| model.dependencies(output))
            .collect()
    };
    let [mass, spring, controller, cylinder] = ALL.each_ref().map(of);
    assert_eq!(mass, [vec![], vec![], vec![0, 1, 2], vec![1, 2]]);
    assert_eq!(spring, [[0, 1, 2, 3], [0, 1, 2, 3]]);
    assert_eq!(controller, [[0, 1]]);
    assert_eq!(cylinder, [[0; 0], [0; 0]]);
}

#[test]
fn a_serialized_state_resumes_bit_for_bit() {
    let values = [("stiffness", 10.0), ("force", 1.0)];
    let mut mass = ready("mass", &values);
    mass.set_derivative(0, 1, 4.0).expect("an input");
    let bytes = mass.save().bytes();
    let mut other = ready("mass", &[]);
    let saved = other.deserialize(&bytes).expect("a state");
    assert_eq!(saved, mass.save());
    other.restore(&saved).expect("a state of this model");
    for instance in [&mut mass, &mut other] {
        instance.step(0.0, 0.1).expect("a step");
    }
    assert_eq!(mass.save().bytes(), other.save().bytes());
    assert!(other.deserialize(&bytes[8..]).is_err());
    assert!(ready("spring_damper", &[]).restore(&saved).is_err());
}

#[test]
fn calls_out_of_place_are_refused() {
    let mut mass = ready("mass", &[]);
    assert!(mass.step(1.0, 0.1).is_err());
    assert!(mass.step(0.0, 0.0).is_err());
    assert!(mass.step(0.0, f64::NAN).is_err());
    assert!(mass.set(reference(&mass, "mass"), 2.0).is_err());
    assert!(mass.set(reference(&mass, "position"), 2.0).is_err());
    assert!(mass.get(99).is_err());
    let mut weightless = Instance::new(&ALL[0].guid()).expect("a mass");
    let parameter = reference(&weightless, "mass");
    weightless.set(parameter, 0.0).expect("a number");
    assert!(
        weightless
            .advance(Phase::Instantiated, Phase::Initialization)
            .is_err()
    );
    assert!(Instance::new("no such model").is_none());
}
