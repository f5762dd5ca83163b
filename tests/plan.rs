//! The planner: what it promises against closed forms, that it is told what it cannot promise, that it is the same every time.

use std::f64::consts::PI;

use flexbody::scene::{Axial, Scene};
use flexbody::simulation::{Plan, Settles, Signals, Simulation, courses, plan};
use serde_json::{Value, json};

/// A beam of one metre between two pins, on rollers at its end.
const BEAM: &str = r#"{
  "name": "beam", "dimension": 2,
  "bodies": [{"name": "rod", "element": "cable",
    "material": {"youngs_modulus": 2.0e11, "density": 7800.0},
    "section": {"area": 1.0e-4, "second_moment": 1.0e-9},
    "shape": {"line": {"from": [0, 0], "to": [1, 0]}},
    "markers": {"a": 0.0, "middle": 0.5, "b": 1.0}}],
  "joints": [
    {"name": "pin", "kind": "revolute", "markers": ["ground", "rod.a"]},
    {"name": "roller", "kind": "slider", "markers": ["ground", "rod.b"], "direction": [1, 0]}],
  "outputs": [{"kind": "natural_frequency", "count": 3}],
  "experiment": {"stop_time": 1e-3, "step": 1e-3}
}"#;

fn edited(text: &str, edit: impl Fn(&mut Value)) -> Result<Scene, String> {
    let mut scene: Value = serde_json::from_str(text).expect("JSON");
    edit(&mut scene);
    Scene::from_json(&scene.to_string()).map_err(|error| error.to_string())
}

fn planned(scene: &Scene) -> Result<(Scene, Option<Plan>), String> {
    plan(scene, &mut |_, _, _| ()).map_err(|error| error.to_string())
}

fn elements(scene: &Scene) -> u32 {
    scene.bodies[0]
        .cable()
        .and_then(|cable| cable.elements)
        .expect("a number")
}

/// Largest relative error of the frequencies of a beam between pins, `(n pi)^2 sqrt(EI / (rho A L^4))`.
fn frequency_error(scene: Scene) -> f64 {
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("a start");
    let unit = (2.0e11 * 1.0e-9 / (7800.0 * 1.0e-4_f64)).sqrt();
    let exact = |n: usize| (n as f64 * PI).powi(2) * unit;
    let errors = (1..=3).map(|n| {
        let name = format!("natural_frequency[{n}]");
        let index = simulation.variables().iter().position(|v| v.name == name);
        let found = simulation.real(index.expect(&name)).expect("a frequency");
        // The planner measures a vector by its largest value.
        (found - exact(n)).abs() / exact(3)
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn as_many_elements_as_the_error_asks_for() {
    for error in [1e-2, 1e-3, 1e-4, 1e-5] {
        let scene = edited(BEAM, |scene| scene["accuracy"] = json!({"error": error}));
        let (chosen, plan) = planned(&scene.expect("a scene")).expect("a plan");
        let plan = plan.expect("a plan");
        assert!(
            plan.outputs
                .iter()
                .all(|output| output.settles == Settles::Yes)
        );
        let found = frequency_error(chosen.clone());
        assert!(
            found <= error,
            "{error:e}: {found:e} with {}",
            elements(&chosen)
        );
        // Order 4: a quarter of the elements is 256 times worse, and must not do.
        let mut coarse = chosen.clone();
        if elements(&chosen) >= 4 {
            let count = elements(&chosen) / 4;
            coarse.bodies[0].cable_mut().expect("a cable").elements = Some(count);
            assert!(
                frequency_error(coarse) > error,
                "{error:e}: {count} elements would do"
            );
        }
    }
}

#[test]
fn the_same_plan_every_time() {
    let scene = edited(BEAM, |_| ()).expect("a scene");
    let first = planned(&scene).expect("a plan");
    assert_eq!(first, planned(&scene).expect("a plan"));
    let text = first.0.to_json();
    let again = Scene::from_json(&text).expect("its own text");
    assert_eq!(again, first.0, "a planned scene is one of plain numbers");
    assert_eq!(
        planned(&again),
        Ok((again.clone(), None)),
        "nothing is left to plan"
    );
}

#[test]
fn an_input_moves_in_the_experiment_that_is_planned_for() {
    let moved = |course: Option<&str>| {
        edited(BEAM, |scene| {
            scene["inputs"] = json!([{"kind": "force", "marker": "rod.middle"}]);
            scene["outputs"] = json!([{"kind": "position", "marker": "rod.middle"}]);
            scene["experiment"] = json!({"stop_time": 0.05, "step": 1e-3});
            scene["accuracy"] = json!({"error": 1e-4});
            if let Some(course) = course {
                scene["accuracy"]["for"] = json!([{"input": "rod.middle.force[2]", "from": 0, "to": -100, "course": course}]);
            }
        })
    };
    let still = planned(&moved(None).expect("a scene"))
        .expect("a plan")
        .1
        .expect("a plan");
    assert_eq!(still.held, ["rod.middle.force[1]", "rod.middle.force[2]"]);
    assert_eq!(still.outputs[0].error, 0.0, "nothing moves");
    for course in ["ramp", "step", "sine"] {
        let (_, plan) = planned(&moved(Some(course)).expect("a scene")).expect("a plan");
        let plan = plan.expect("a plan");
        assert_eq!(plan.held, ["rod.middle.force[1]"]);
        assert!(plan.outputs[0].error > 0.0, "{course} moves nothing");
        assert!(plan.outputs[0].error < 1e-4, "{course}");
    }
}

/// What the planner ran can be run again: the largest speed, which it measures speeds by, comes out to the bit.
#[test]
fn the_course_of_inputs_makes_the_planned_experiment_again() {
    let scene = edited(BEAM, |scene| {
        scene["inputs"] = json!([{"kind": "force", "marker": "rod.middle"}]);
        scene["outputs"] = json!([{"kind": "velocity", "marker": "rod.middle"}]);
        scene["experiment"] = json!({"stop_time": 0.02, "step": 1e-3});
        let course =
            json!({"input": "rod.middle.force[2]", "from": 0, "to": -100, "course": "step"});
        scene["accuracy"] = json!({"error": 1e-2, "for": [course]});
    });
    let scene = scene.expect("a scene");
    let (chosen, plan) = planned(&scene).expect("a plan");
    let text = courses(&scene).expect("courses").expect("one that moves");
    let mut simulation = Simulation::new(chosen);
    let signals = Signals::from_csv(&text, simulation.variables()).expect("signals");
    simulation.set_inputs(&signals).expect("inputs");
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    let names = ["rod.middle.velocity[1]", "rod.middle.velocity[2]"];
    let indices = names.map(|name| {
        let mut variables = simulation.variables().iter();
        variables.position(|v| v.name == name).expect(name)
    });
    let mut largest = 0.0_f64;
    for number in 1..=20 {
        let until = (f64::from(number) * 1e-3).min(0.02);
        while simulation.time() < until {
            simulation.step_along(&signals, until).expect("a step");
        }
        let [x, y] = indices.map(|index| simulation.real(index).expect("a speed"));
        largest = largest.max((x * x + y * y).sqrt());
    }
    let output = &plan.expect("a plan").outputs[0];
    assert!(largest > 0.0 && !output.skips_start);
    assert_eq!(output.scale, largest);
}

/// Two rigid pendulums in one, let go from high up: chaotic.
#[test]
fn what_does_not_settle_is_named_with_how_long_it_is_good() {
    let body = |name: &str, y: f64| {
        json!({"name": name, "element": "rigid", "mass": 1.0, "inertia": 0.083, "position": [y, 0.0],
               "markers": {"a": [-0.5, 0.0], "b": [0.5, 0.0]}})
    };
    let scene = json!({
        "name": "double", "dimension": 2, "gravity": [0.0, -9.81],
        "bodies": [body("upper", 0.5), body("lower", 1.5)],
        "joints": [{"name": "p", "kind": "revolute", "markers": ["ground", "upper.a"]},
                   {"name": "e", "kind": "revolute", "markers": ["upper.b", "lower.a"]}],
        "outputs": [{"kind": "position", "marker": "lower.b"}],
        "accuracy": {"error": 1e-3},
        "experiment": {"stop_time": 60.0, "step": 0.05}
    });
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let plan = planned(&scene).expect("a plan").1.expect("a plan");
    let Settles::Until(time) = plan.outputs[0].settles else {
        panic!("{:?}", plan.outputs);
    };
    assert!((1.0..59.0).contains(&time), "{time}");
}

#[test]
fn what_cannot_be_asked_for_is_refused_with_its_place() {
    let told = |accuracy: Value| {
        let scene = edited(BEAM, |scene| scene["accuracy"] = accuracy.clone())?;
        planned(&scene)
    };
    let refused = [
        (
            json!({"error": 1e-3, "relative_tolerance": 1e-4}),
            "accuracy.error: expected nothing beside `relative_tolerance`",
        ),
        (
            json!({"error": 0.5}),
            "accuracy.error: expected a number from 1e-8 to 1e-1, found 0.5",
        ),
        (
            json!({"of": ["rod.tip.position"]}),
            "accuracy.of[0]: expected the name of an output, without an index, found \"rod.tip.position\"",
        ),
        (
            json!({"for": [{"input": "wind", "from": 0, "to": 1}]}),
            "accuracy.for[0].input: expected the name of an input, found \"wind\"",
        ),
    ];
    for (accuracy, expected) in refused {
        let found = told(accuracy).expect_err(expected);
        assert!(found.starts_with(expected), "{found}");
    }
    let wrong = edited(BEAM, |scene| scene["bodies"][0]["elements"] = json!("many"));
    let wrong = wrong.expect_err("no number");
    let expected = "bodies[0].elements: expected \"auto\" or a positive integer, found \"many\"";
    assert_eq!(wrong, expected);
    // A scene that was not planned does not run with a number that nobody chose.
    let mut simulation = Simulation::new(edited(BEAM, |_| ()).expect("a scene"));
    let told = simulation
        .initialize(0.0)
        .expect_err("not planned")
        .to_string();
    assert!(told.contains("left to the planner"), "{told}");
}

/// A steel rod that swings from the horizontal on a pin.
fn swinging(model: &str, outputs: Value) -> Result<Scene, String> {
    edited(BEAM, |scene| {
        scene["gravity"] = json!([0.0, -9.81]);
        scene["joints"].as_array_mut().expect("joints").pop();
        scene["bodies"][0]["section"]["second_moment"] = json!(1e-7);
        scene["bodies"][0]["model"] = json!(model);
        scene["bodies"][0]["motion"] = json!({"velocity": [0.0, 0.0], "spin": -1.0});
        scene["outputs"] = outputs.clone();
        scene["accuracy"] = json!({"error": 1e-4, "of": ["rod.b.position", "rod.b.angle"]});
        scene["experiment"] = json!({"stop_time": 0.5, "step": 0.01});
    })
}

/// Position of the tip and energies.
fn seen() -> Value {
    json!([{"kind": "position", "marker": "rod.b"}, {"kind": "angle", "marker": "rod.b"},
           {"kind": "energy"}, {"kind": "momentum"}])
}

fn at_the_end(scene: Scene, names: &[&str]) -> Vec<f64> {
    let stop = scene.experiment.stop_time;
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("a start");
    simulation.step(stop).expect("a step");
    let index = |name: &&str| simulation.variables().iter().position(|v| v.name == **name);
    let indices: Option<Vec<usize>> = names.iter().map(index).collect();
    let values = indices.expect("outputs").into_iter();
    values
        .map(|index| simulation.real(index).expect("a number"))
        .collect()
}

#[test]
fn a_cable_that_need_not_bend_is_rigid_and_keeps_its_names() {
    let (rigid, plan) = planned(&swinging("auto", seen()).expect("a scene")).expect("a plan");
    assert!(rigid.bodies[0].rigid().is_some(), "{plan:?}");
    assert_eq!(plan.expect("a plan").bodies[0].kind, "rigid");
    let (bends, _) = planned(&swinging("flexible", seen()).expect("a scene")).expect("a plan");
    assert!(bends.bodies[0].cable().is_some(), "a named model is kept");
    // Mass, inertia, motion and markers are those of the rod.
    let names = [
        "rod.b.position[1]",
        "rod.b.position[2]",
        "rod.b.angle",
        "energy.kinetic",
        "energy.gravity",
        "momentum[1]",
        "momentum[2]",
        "angular_momentum",
    ];
    let [a, b] = [rigid, bends].map(|scene| at_the_end(scene, &names));
    for ((name, a), b) in names.iter().zip(&a).zip(&b) {
        assert!(
            (a - b).abs() < 1e-2 * b.abs().max(0.1),
            "{name}: {a} rigid, {b} flexible"
        );
    }
}

#[test]
fn what_a_rigid_body_has_not_keeps_a_cable_flexible_or_is_refused() {
    let mut outputs = seen();
    outputs
        .as_array_mut()
        .expect("a list")
        .push(json!({"kind": "curvature", "marker": "rod.middle"}));
    let (bends, _) = planned(&swinging("auto", outputs.clone()).expect("a scene")).expect("a plan");
    assert!(bends.bodies[0].cable().is_some());
    let told = planned(&swinging("rigid", outputs).expect("a scene")).expect_err("no curvature");
    assert!(
        told.starts_with(
            "bodies[0].model: expected a cable that can be rigid, found outputs[4].marker: "
        ),
        "{told}"
    );
    let (rigid, _) = planned(&swinging("rigid", seen()).expect("a scene")).expect("a plan");
    assert!(rigid.bodies[0].rigid().is_some());
}

#[test]
fn an_experiment_too_long_to_be_planned_promises_nothing() {
    let scene = swinging("flexible", seen()).expect("a scene");
    let long = edited(&scene.to_json(), |scene| {
        scene["experiment"]["stop_time"] = json!(1e7)
    });
    let (chosen, plan) = planned(&long.expect("a scene")).expect("a plan");
    assert!(elements(&chosen) > 0);
    let outputs = plan.expect("a plan").outputs;
    assert!(
        outputs.iter().all(|output| output.settles == Settles::No),
        "{outputs:?}"
    );
}

/// A bar that is pulled at its end from the first instant on: its reaction rings between nothing and twice the force.
fn pulled(axial: &str) -> Result<Scene, String> {
    edited(BEAM, |scene| {
        scene["joints"].as_array_mut().expect("joints").pop();
        scene["bodies"][0]["axial"] = json!(axial);
        scene["loads"] =
            json!([{"name": "pull", "kind": "force", "marker": "rod.b", "value": [1000.0, 0.0]}]);
        scene["outputs"] =
            json!([{"kind": "position", "marker": "rod.b"}, {"kind": "reaction", "joint": "pin"}]);
        scene["experiment"] = json!({"stop_time": 5e-3, "step": 5e-5});
        scene["accuracy"] = json!({"error": 1e-3});
    })
}

#[test]
fn settled_waves_are_proposed_where_forces_ring_and_never_chosen() {
    let (chosen, plan) = planned(&pulled("waves").expect("a scene")).expect("a plan");
    let cable = chosen.bodies[0].cable().expect("a cable");
    assert_eq!(cable.axial, Axial::Waves, "never chosen");
    let plan = plan.expect("a plan");
    let settled = plan.settled.as_ref().expect("a proposal");
    assert_eq!(settled.bodies, ["rod"]);
    let (name, change, error) = &settled.forces[0];
    assert_eq!(name, "pin.reaction");
    // It would come to rest at the force; the ringing is as large.
    assert!(*change > 0.5, "{settled:?}");
    assert!(error.is_some_and(|error| error < 1e-2), "{settled:?}");
    assert!(settled.in_words().contains("rod"));
    let (_, plan) = planned(&pulled("settled").expect("a scene")).expect("a plan");
    assert_eq!(plan.expect("a plan").settled, None, "settled already");
}
