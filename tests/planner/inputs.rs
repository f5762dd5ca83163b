//! What inputs do in the experiment that is planned for: courses of their own, and what is given for a plan in place of the scene's values.

use std::f64::consts::PI;

use flexbody::scene::{Interpolation, Scene};
use flexbody::simulation::{
    Budget, InputTable, Plan, Simulation, TrialConditions, courses, plan_for,
};
use serde_json::{Value, json};

use super::{BEAM, edited};

/// The beam with a force input at its middle, whose place is asked for, and further changes.
fn pushed(edit: impl Fn(&mut Value)) -> Result<Scene, String> {
    edited(BEAM, |scene| {
        scene["inputs"] = json!([{"kind": "force", "marker": "rod.middle"}]);
        scene["outputs"] = json!([{"kind": "position", "marker": "rod.middle"}]);
        scene["experiment"] = json!({"stop_time": 0.05, "step": 1e-3});
        scene["accuracy"] = json!({"error": 1e-4});
        edit(scene);
    })
}

fn planned_for(scene: &Scene, given: &TrialConditions) -> Result<(Scene, Plan), String> {
    let planned = plan_for(scene, given, &Budget::default(), &mut |_, _, _| ());
    let (scene, planned) = planned.map_err(|error| error.to_string())?;
    Ok((scene, planned.numbers.expect("a plan")))
}

fn planned(scene: &Scene) -> (Scene, Plan) {
    planned_for(scene, &TrialConditions::default()).expect("a plan")
}

/// The table of what inputs do: its names, and its rows of numbers.
fn rows(scene: &Scene) -> (Vec<String>, Vec<Vec<f64>>) {
    let table = courses(scene).expect("courses").expect("one that moves");
    let mut lines = table.text.lines();
    let names = lines.next().expect("names").split(',').map(str::to_owned);
    let numbers = |line: &str| {
        line.split(',')
            .map(|n| n.parse().expect("a number"))
            .collect()
    };
    (names.collect(), lines.map(numbers).collect())
}

#[test]
fn an_input_moves_in_the_experiment_that_is_planned_for() {
    let moved = |course: Option<&str>, gravity: f64| {
        pushed(|scene| {
            scene["gravity"] = json!([0.0, gravity]);
            if let Some(course) = course {
                scene["accuracy"]["input_profiles"] = json!([{"input": "rod.middle.force[2]", "from": 0, "to": -100, "course": course}]);
            }
        })
    };
    let (_, still) = planned(&moved(None, 0.0).expect("a scene"));
    assert_eq!(still.held, ["rod.middle.force[1]", "rod.middle.force[2]"]);
    assert!(still.outputs[0].error < 1e-9, "nothing moves");
    // What the force would do is known all the same.
    let answer = &still.answers[1];
    assert_eq!(answer.0, "answer to rod.middle.force[2]");
    assert!(answer.1 <= 1e-4, "{:?}", still.answers);
    // So are natural frequencies, but not about a start from which the beam is to fall far.
    let tells = |plan: &Plan| plan.answers.iter().any(|a| a.0 == "natural frequencies");
    assert!(tells(&still));
    let (_, falling) = planned(&moved(None, -9.81e3).expect("a scene"));
    assert!(!tells(&falling));
    for course in ["ramp", "step", "sine"] {
        let (_, plan) = planned(&moved(Some(course), 0.0).expect("a scene"));
        assert_eq!(plan.held, ["rod.middle.force[1]"]);
        assert!(plan.outputs[0].error > 0.0, "{course} moves nothing");
        assert!(plan.outputs[0].error < 1e-4, "{course}");
    }
}

/// What the planner ran can be run again: the largest speed, which it measures speeds by, comes out to the bit.
#[test]
fn the_course_of_inputs_makes_the_planned_experiment_again() {
    let scene = pushed(|scene| {
        scene["outputs"] = json!([{"kind": "velocity", "marker": "rod.middle"}]);
        scene["experiment"] = json!({"stop_time": 0.02, "step": 1e-3});
        let course =
            json!({"input": "rod.middle.force[2]", "from": 0, "to": -100, "course": "step"});
        scene["accuracy"] = json!({"error": 1e-2, "input_profiles": [course]});
    });
    let scene = scene.expect("a scene");
    let (chosen, plan) = planned(&scene);
    let table = courses(&scene).expect("courses").expect("one that moves");
    let mut simulation = Simulation::new(chosen);
    let signals = table.signals(simulation.variables()).expect("signals");
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
    let output = &plan.outputs[0];
    assert!(largest > 0.0 && !output.skips_start);
    assert_eq!(output.scale, largest);
}

/// Expressions and tables are followed at every communication point and at their kinks; a ramp takes the time it is given, and stays.
#[test]
fn an_input_follows_a_course_of_its_own() {
    let course = |course: Value| {
        let scene = pushed(|scene| scene["accuracy"]["input_profiles"] = json!([course]));
        rows(&scene.expect("a scene")).1
    };
    let name = "rod.middle.force[2]";
    for row in course(json!({"input": name, "value": "50*sin(200*t)"})) {
        assert_eq!(row[1], 50.0 * (200.0 * row[0]).sin());
    }
    // The kink is between two communication points.
    let table = json!({"table": [[0.0, 0.0], [0.0205, -100.0], [0.05, 0.0]]});
    let found = course(json!({"input": name, "value": table}));
    assert!(
        found.iter().any(|row| row[..] == [0.0205, -100.0]),
        "{found:?}"
    );
    assert!(
        found
            .iter()
            .any(|row| row[0] == 0.02 && (row[1] + 100.0 * 0.02 / 0.0205).abs() < 1e-12)
    );
    // What jumps has two values at the time.
    let found = course(json!({"input": name, "value": "-7*step(t - 0.0105)"}));
    let at = found.iter().filter(|row| (row[0] - 0.0105).abs() < 1e-12);
    assert_eq!(at.map(|row| row[1]).collect::<Vec<_>>(), [0.0, -7.0]);
    let ramp = json!({"input": name, "from": 1, "to": -3, "duration": 0.03});
    for row in course(ramp) {
        let way = 0.5 - 0.5 * (PI * (row[0] / 0.03).min(1.0)).cos();
        assert!((row[1] - (1.0 - 4.0 * way)).abs() < 1e-12, "{row:?}");
    }
}

/// The rates of a driven motion are those of its course.
#[test]
fn rates_of_a_driven_motion_follow_from_its_course() {
    let scene = pushed(|scene| {
        scene["motions"] =
            json!([{"name": "lift", "kind": "position", "marker": "rod.a", "value": {"input": 2}}]);
        scene["joints"] = json!([scene["joints"][1]]);
        scene["inputs"] = json!([]);
        let course = json!({"input": "lift.position[2]", "value": "0.1*t^3"});
        scene["accuracy"]["input_profiles"] = json!([course]);
    });
    let (names, rows) = rows(&scene.expect("a scene"));
    assert_eq!(
        names[1..],
        [
            "lift.position[2]",
            "lift.velocity[2]",
            "lift.acceleration[2]"
        ]
    );
    for row in rows {
        let t = row[0];
        for (found, expected) in row[1..].iter().zip([0.1 * t.powi(3), 0.3 * t * t, 0.6 * t]) {
            assert!((found - expected).abs() < 1e-14, "{row:?}");
        }
    }
}

/// The sag of a beam between pins is `5 w L^4 / (384 EI)`: the largest change that errors are measured by follows a modulus that is set, and
/// half of the force of a table is half of the deflection `F L^3 / (48 EI)`.
#[test]
fn a_plan_is_for_what_is_given() {
    let heavy = pushed(|scene| {
        scene["gravity"] = json!([0.0, -9.81]);
        scene["initial"] = json!("static_equilibrium");
    });
    let heavy = heavy.expect("a scene");
    let sag = |modulus: f64| 5.0 * 0.78 * 9.81 / (384.0 * modulus * 1e-9);
    for modulus in [2e11, 5e10] {
        let set = vec![("rod.youngs_modulus".to_owned(), modulus)];
        let given = TrialConditions { set, inputs: None };
        let (scene, plan) = planned_for(&heavy, &given).expect("a plan");
        assert!(
            (plan.outputs[0].scale / sag(modulus) - 1.0).abs() < 1e-3,
            "{:?}",
            plan.outputs
        );
        assert_eq!(
            scene.bodies[0]
                .cable()
                .expect("a cable")
                .material
                .youngs_modulus,
            Some(2e11)
        );
    }
    let still = pushed(|scene| scene["initial"] = json!("static_equilibrium"));
    let still = still.expect("a scene");
    for force in [-10.0, -20.0] {
        let text = format!("time,rod.middle.force[2]\n0,{force}\n0.05,{force}\n");
        let curve = Interpolation::Linear;
        let inputs = Some(InputTable { text, curve });
        let given = TrialConditions {
            inputs,
            ..TrialConditions::default()
        };
        let (_, plan) = planned_for(&still, &given).expect("a plan");
        assert_eq!(plan.held, ["rod.middle.force[1]"]);
        let exact = force / (48.0 * 200.0_f64);
        assert!(
            (plan.outputs[0].scale / exact.abs() - 1.0).abs() < 1e-3,
            "{:?}",
            plan.outputs
        );
    }
}

#[test]
fn what_cannot_be_given_is_refused_with_its_place() {
    let input = "rod.middle.force[2]";
    for (course, expected) in [
        (
            json!({"input": input, "from": 0}),
            "accuracy.input_profiles[0]: expected `value`, or `from` and `to`",
        ),
        (
            json!({"input": input, "value": 1, "to": 2}),
            "accuracy.input_profiles[0].value: expected no `from`, `to`",
        ),
        (
            json!({"input": input, "value": "sin(x)"}),
            "accuracy.input_profiles[0].value: ",
        ),
        (
            json!({"input": input, "from": 0, "to": 1, "duration": 0.1}),
            "accuracy.input_profiles[0].duration: expected more than 0 and at most 0.05 s",
        ),
        (
            json!({"input": input, "from": 0, "to": 1, "course": "sine", "duration": 0.01}),
            "accuracy.input_profiles[0].duration: expected nothing, but of a ramp",
        ),
        (
            json!({"input": input, "value": "sign(sin(1e9*t))"}),
            "accuracy.input_profiles[0].value: expected at most 100000 kinks and jumps",
        ),
    ] {
        let scene = pushed(|scene| scene["accuracy"]["input_profiles"] = json!([course]));
        let told = scene.and_then(|scene| courses(&scene).map_err(|error| error.to_string()));
        let told = told.expect_err(expected);
        assert!(told.starts_with(expected), "{told}");
    }
    let scene = pushed(|_| ()).expect("a scene");
    let set = |name: &str| TrialConditions {
        set: vec![(name.to_owned(), 1.0)],
        inputs: None,
    };
    for (given, expected) in [
        (
            set("rod.densty"),
            "rod.densty: expected a parameter or an input; did you mean `rod.density`?",
        ),
        (
            set("rod.elements"),
            "rod.elements: expected a parameter that is not planned",
        ),
        (
            set("relative_tolerance"),
            "relative_tolerance: expected a parameter that is not planned",
        ),
    ] {
        let told = planned_for(&scene, &given).expect_err(expected);
        assert_eq!(told, expected);
    }
    let text = "time,rod.middle.force[2]\n0,0\n0.04,1\n".to_owned();
    let curve = Interpolation::Linear;
    let given = TrialConditions {
        inputs: Some(InputTable { text, curve }),
        ..TrialConditions::default()
    };
    let told = planned_for(&scene, &given).expect_err("too short");
    assert!(
        told.starts_with("input: expected rows from 0 s to the stop time 0.05 s"),
        "{told}"
    );
}
