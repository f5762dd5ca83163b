//! Derivatives of every output of the ready scenes, against differences: in time along the motion, and
//! by every input at a point in time. Inputs move as polynomials whose derivatives the master knows.

use std::path::{Path, PathBuf};

use flexbody::scene::{Body, Initial, InitialState, Scene, beside};
use flexbody::simulation::{Budget, Simulation, Source, plan};

/// Steps before derivatives are taken, and their length, s.
const STEPS: usize = 20;
const STEP: f64 = 5e-3;
/// Elements of a cable at least: with fewer, the softened boom is shaken by its port faster than differences follow.
const LEAST: u32 = 8;
/// Distance of the points of a difference in time, s.
const NEAR: f64 = 2e-5;

/// Scenes of stiff plates and shells, and of stiff beams: their fastest membrane and axial vibrations are too quick for differences over `NEAR`, and they rule second derivatives
/// in time of stress and reactions, and what is zero by symmetry (docs/book/src/theory/limits.md).
const NOISY: [&str; 6] = [
    "brake.json",
    "cylinder_shell.json",
    "leaf_spring.json",
    "solar_array.json",
    "tower_crane.json",
    "unfolding_mast.json",
];

/// Every ready scene, and those of the tests with every kind of input and output.
fn scenes() -> Vec<PathBuf> {
    let mut found = crate::ready_scenes();
    // A belt that is pulled taut tears where it is as soft as these tests make it.
    found.retain(|path| !path.ends_with("belt_drive.json"));
    let others = [
        "docs/book/examples/bodies/reduced.json",
        "docs/book/examples/outputs/stress_tensor.json",
        "src/scene/example.json",
        "tests/cases/contact/rolling.json",
        "tests/cases/coupled_mass/driven.json",
        "tests/cases/coupled_mass/scene.json",
        "tests/cases/driven_orientation/scene.json",
        "tests/cases/falling_rod/scene.json",
        "tests/cases/planar_beam_statics/swing.json",
        "tests/fmpy/mechanism.json",
        "tests/fmpy/swing.json",
        "tests/masters/scenes/inner.json",
        "tests/masters/scenes/outer.json",
    ];
    found.extend(others.map(|name| crate::root().join(name)));
    found.sort();
    assert!(found.len() > 10, "{found:?}");
    found
}

/// Deflections of the first body along a line with two markers: of one of them, from the mean and from the other.
fn deflections(scene: &serde_json::Value) -> Vec<serde_json::Value> {
    let bodies = scene["bodies"].as_array().into_iter().flatten();
    let mut lines = bodies.filter(|body| {
        !["rigid", "auto", "reduced", "plate", "shell"]
            .contains(&body["element"].as_str().unwrap_or_default())
    });
    let found = lines.find_map(|body| {
        let mut names = body["markers"].as_object()?.keys();
        let (first, second) = (names.next()?, names.next()?);
        let name = |marker: &str| format!("{}.{marker}", body["name"].as_str().unwrap_or_default());
        Some([name(first), name(second)])
    });
    found.map_or_else(Vec::new, |[from, marker]| {
        vec![
            serde_json::json!({"kind": "deflection", "marker": &marker}),
            serde_json::json!({"kind": "deflection", "marker": &marker, "from": from}),
        ]
    })
}

/// A scene whose inputs move: `value + rate t + second t^2 / 2` for each.
struct Moving {
    simulation: Simulation,
    inputs: Vec<(usize, [f64; 3])>,
}

impl Moving {
    fn new(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).expect("a readable scene");
        let mut scene: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        // No ready scene asks for them.
        let mut asked = vec![serde_json::json!({"kind": "resolution"})];
        asked.extend(deflections(&scene));
        match scene["outputs"].as_array_mut() {
            Some(outputs) => outputs.extend(asked),
            None => scene["outputs"] = asked.into(),
        }
        if touches(path) {
            // Radau has no order where what lies on a surface begins to press on it.
            scene["method"] = serde_json::json!({"integrator": "dopri853"});
        }
        let files = beside(path.parent().expect("a folder"));
        let scene = Scene::from_json_with(&scene.to_string(), &files).expect("a valid scene");
        // Any mesh does.
        let budget = Budget {
            seconds: 0.1,
            ..Budget::default()
        };
        let (mut scene, _) = plan(&scene, &budget, &mut |_, _, _| ()).expect("a plan");
        scene.accuracy.relative_tolerance = Some(1e-10);
        // Soft enough for differences over a time that rounding does not notice.
        scene.initial = Initial::State(InitialState::Undeformed);
        for body in &mut scene.bodies {
            if let Body::Cable(cable) = body {
                cable.material.youngs_modulus = Some(1e-4 * cable.material.young());
                cable.elements = cable.elements.map(|count| count.max(LEAST));
            }
        }
        let mut simulation = Simulation::new(scene);
        let inputs = courses(&simulation);
        for (index, [value, ..]) in &inputs {
            simulation.set_real(*index, *value).expect("an input");
        }
        simulation.initialize(0.0).expect("an initial state");
        simulation.start().expect("a start");
        let mut moving = Self { simulation, inputs };
        (1..=STEPS).for_each(|k| moving.advance(STEP * k as f64));
        moving
    }

    fn set(&mut self) {
        let t = self.simulation.time();
        for (index, [value, rate, second]) in &self.inputs {
            let simulation = &mut self.simulation;
            let now = value + t * (rate + 0.5 * t * second);
            let set = simulation.set_real(*index, now);
            set.expect("an input");
            let slopes = [rate + t * second, *second];
            for (order, slope) in slopes.into_iter().enumerate() {
                let set = simulation.set_input_derivative(*index, order as i32 + 1, slope);
                set.expect("an input");
            }
        }
    }

    fn advance(&mut self, until: f64) {
        self.set();
        self.simulation.step(until).expect("a step");
    }

    fn outputs(&self) -> Vec<usize> {
        let variables = self.simulation.variables().iter().enumerate();
        variables
            .filter(|(_, v)| {
                matches!(v.source, Source::Output(_)) && !v.name.starts_with("residual")
            })
            .map(|(index, _)| index)
            .collect()
    }

    fn values(&mut self, outputs: &[usize]) -> Vec<f64> {
        let value = |index: &usize| self.simulation.real(*index).expect("an output");
        outputs.iter().map(value).collect()
    }

    /// Whether inputs drive motions.
    fn is_driven(&self) -> bool {
        let variables = self.simulation.variables();
        self.inputs
            .iter()
            .any(|(index, _)| !variables[*index].acts_at_once())
    }

    fn name(&self, index: usize) -> &str {
        &self.simulation.variables()[index].name
    }
}

/// How inputs move. Motions go on from where they are, with derivatives that fit.
fn courses(simulation: &Simulation) -> Vec<(usize, [f64; 3])> {
    let variables = simulation.variables();
    let mut number = 0.0;
    let mut found = Vec::new();
    for (index, variable) in variables.iter().enumerate() {
        if !matches!(variable.source, Source::Input(_)) {
            continue;
        }
        number += 1.0;
        let start = variable.start.unwrap_or(0.0);
        let size = if start == 0.0 { 0.3 } else { 0.02 * start };
        let course = [start, size * (1.0 + 0.1 * number), -size * number];
        let (stem, axis) = variable
            .name
            .split_once('[')
            .unwrap_or((&variable.name, ""));
        // Rates and accelerations of motions are those of the position, angle or displacement.
        let below = [
            (".velocity", ".position", 1),
            (".velocity", ".displacement", 1),
            (".velocity", ".travel", 1),
            (".angular_velocity", ".angle", 1),
            (".acceleration", ".position", 2),
            (".acceleration", ".displacement", 2),
            (".acceleration", ".travel", 2),
            (".angular_acceleration", ".angle", 2),
        ];
        let of = below.into_iter().find_map(|(suffix, below, order)| {
            let name = format!("{}{below}", stem.strip_suffix(suffix)?);
            let full = if axis.is_empty() {
                name
            } else {
                format!("{name}[{axis}")
            };
            let place = found
                .iter()
                .find(|(i, _): &&(usize, _)| variables[*i].name == full)?;
            let [_, rate, second]: [f64; 3] = place.1;
            Some(if order == 1 {
                [rate, second, 0.0]
            } else {
                [second, 0.0, 0.0]
            })
        });
        found.push((index, of.unwrap_or(course)));
    }
    found
}

/// Whether something in a scene touches a surface.
fn touches(path: &Path) -> bool {
    let text = std::fs::read_to_string(path).expect("a readable scene");
    text.contains("\"contact\"")
}

#[test]
fn derivatives_in_time_are_those_of_the_motion() {
    let mut kinks = 0;
    let is_noisy = |path: &PathBuf| NOISY.iter().any(|name| path.ends_with(name));
    for path in scenes().into_iter().filter(|path| !is_noisy(path)) {
        let mut moving = Moving::new(&path);
        let outputs = moving.outputs();
        let start = moving.simulation.time();
        let touches = touches(&path);
        let mut rows = Vec::new();
        for k in 1..=5 {
            moving.advance(start + NEAR * f64::from(k));
            let values = moving.values(&outputs);
            let mut derivatives = |order| -> Vec<f64> {
                let simulation = &mut moving.simulation;
                let of = |index: &usize| simulation.output_derivative(*index, order);
                let of = outputs.iter().map(of);
                of.collect::<Result<_, _>>().expect("outputs")
            };
            rows.push([values, derivatives(1), derivatives(2), derivatives(3)]);
        }
        // A course that is made anew in every one of so short steps amplifies rounding, most of all in
        // its fourth derivative.
        let (share, coarse) = if moving.is_driven() {
            (5e-3, [1e4, 1e10])
        } else {
            (1e-3, [1.0; 2])
        };
        for (i, index) in outputs.iter().enumerate() {
            let name = moving.name(*index);
            let place = format!("{} {name}", path.display());
            // It has a kink where the largest jump of curvature changes place, and where contact begins.
            let bend = rows[4][1][i] - rows[0][1][i] - 4.0 * NEAR * rows[2][2][i];
            let bends = touches || bend.abs() > share * rows[2][1][i].abs();
            if name == "resolution" && bends {
                kinks += 1;
                continue;
            }
            for order in 1..=2 {
                let y = |k: usize| rows[k][order - 1][i];
                let difference = (y(0) - 8.0 * y(1) + 8.0 * y(3) - y(4)) / (12.0 * NEAR);
                let found = rows[2][order][i];
                // An axial force is a balance of forces whose roundoff is that of the axial stiffness.
                let floor = if place.ends_with("axial_force") {
                    1.0
                } else {
                    1e-1
                };
                let noise = 1e-12 * (floor + y(2).abs()) / NEAR;
                let limit = share * difference.abs() + coarse[order - 1] * noise;
                let error = (found - difference).abs();
                assert!(
                    error <= limit,
                    "{place}, order {order}: {found}, {difference}"
                );
            }
            assert_eq!(rows[2][3][i], 0.0);
        }
    }
    assert!(kinks <= 3, "{kinks} kinks");
}

#[test]
fn derivatives_by_inputs_are_what_outputs_do_when_inputs_jump() {
    for path in scenes() {
        let mut moving = Moving::new(&path);
        moving.set();
        let outputs = moving.outputs();
        let before = moving.simulation.snapshot();
        for (index, [value, ..]) in moving.inputs.clone() {
            let variable = moving.simulation.variables()[index].clone();
            let (known, unknown) = (std::iter::once((index, 1.0)), outputs.iter().copied());
            let done = moving.simulation.differentiate(unknown, known);
            done.expect("inputs and outputs");
            let change = |output: &usize| moving.simulation.change(*output);
            let found: Result<Vec<f64>, _> = outputs.iter().map(change).collect();
            let found = found.expect("outputs");
            assert_eq!(
                moving.simulation.snapshot(),
                before,
                "the state is disturbed"
            );
            let way = 1e-3 * value.abs().max(1.0);
            let now = moving.simulation.real(index).expect("an input");
            let mut side = |sign: f64| {
                let set = moving.simulation.set_real(index, now + sign * way);
                set.expect("an input");
                let values = moving.values(&outputs);
                moving.simulation.restore(&before).expect("its own state");
                values
            };
            // Of order 4: outputs follow quaternions by more than squares.
            let [lower, low, high, higher] = [-2.0, -1.0, 1.0, 2.0].map(&mut side);
            for (i, output) in outputs.iter().enumerate() {
                let slope = (8.0 * (high[i] - low[i]) - (higher[i] - lower[i])) / (12.0 * way);
                let size = (high[i].abs() + 1.0) / way;
                let place = format!(
                    "{} {} by {}",
                    path.display(),
                    moving.name(*output),
                    variable.name
                );
                let error = (slope - found[i]).abs();
                assert!(
                    error <= 1e-9 * slope.abs() + 3e-12 * size,
                    "{place}: {} {slope}",
                    found[i]
                );
                let listed = &moving.simulation.variables()[*output];
                assert!(
                    found[i] == 0.0 || listed.depends_on(&variable),
                    "{place} is not listed"
                );
            }
        }
    }
}

/// A particle of 2 kg pushed by a force input, and one that a motion input drives along x and y.
const PARTICLE: &str = r#"{ "name": "particle", "dimension": 2,
  "bodies": [ { "name": "ball", "element": "rigid", "mass": 2.0, "inertia": 0.0, "position": [0.0, 0.0],
                "markers": { "centre": [0.0, 0.0] } } ],
  "ACTS": [ WHAT ],
  "outputs": [ { "kind": "position", "marker": "ball.centre" }, { "kind": "velocity", "marker": "ball.centre" },
               { "kind": "acceleration", "marker": "ball.centre" } MORE ] }"#;

fn particle(acts: &str, what: &str, more: &str) -> Simulation {
    let text = PARTICLE
        .replace("ACTS", acts)
        .replace("WHAT", what)
        .replace("MORE", more);
    let mut simulation = Simulation::new(Scene::from_json(&text).expect("a valid scene"));
    simulation.initialize(0.0).expect("an initial state");
    simulation.start().expect("a start");
    simulation
}

fn index(simulation: &Simulation, name: &str) -> usize {
    let found = simulation.variables().iter().position(|v| v.name == name);
    found.expect(name)
}

#[test]
fn inputs_move_in_the_next_step_and_in_that_one_only() {
    let force = r#"{ "kind": "force", "marker": "ball.centre" }"#;
    for (rate, second) in [(0.0, 0.0), (3.0, 0.0), (3.0, -8.0)] {
        let mut ball = particle("inputs", force, "");
        let [push, place, speed, kick] = ["force", "position", "velocity", "acceleration"]
            .map(|what| index(&ball, &format!("ball.centre.{what}[1]")));
        ball.set_real(push, 1.0).expect("an input");
        for (order, slope) in [(1, rate), (2, second)] {
            ball.set_input_derivative(push, order, slope)
                .expect("an input");
        }
        let h = 0.5;
        ball.step(h).expect("a step");
        let mut get = |index: usize| ball.real(index).expect("a real variable");
        // Newton's law for the polynomial f = 1 + rate t + second t^2 / 2.
        let (a, b, c) = (1.0 / 2.0, rate / 2.0, second / 2.0);
        let v = h * (a + h * (b / 2.0 + h * c / 6.0));
        let x = h * h * (a / 2.0 + h * (b / 6.0 + h * c / 24.0));
        let end = 1.0 + h * (rate + 0.5 * h * second);
        let found = [get(place), get(speed), get(kick), get(push)];
        for (found, wanted) in found.into_iter().zip([x, v, end / 2.0, end]) {
            assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
        }
        let jerk = ball.output_derivative(kick, 1).expect("an output");
        assert!((jerk - (rate + h * second) / 2.0).abs() < 1e-12, "{jerk}");
        // Afterwards it stands where it ended.
        ball.step(2.0 * h).expect("a step");
        let after = ball.real(speed).expect("an output");
        assert!((after - v - h * end / 2.0).abs() < 1e-12, "{after}");
        assert_eq!(ball.real(push).expect("an input"), end);
        assert_eq!(ball.output_derivative(kick, 1).expect("an output"), 0.0);
    }
}

#[test]
fn a_prescribed_acceleration_acts_on_its_reaction_at_once() {
    let motion = r#"{ "name": "hand", "kind": "position", "marker": "ball.centre",
                      "value": { "input": 2 } }"#;
    let reaction = r#", { "kind": "reaction", "motion": "hand" }"#;
    let mut ball = particle("motions", motion, reaction);
    let [speed, kick, force] = [
        "hand.velocity[1]",
        "hand.acceleration[1]",
        "hand.reaction[1]",
    ]
    .map(|name| index(&ball, name));
    ball.set_real(kick, 3.0).expect("an input");
    assert_eq!(ball.real(force).expect("an output"), 6.0);
    for (input, mass) in [(kick, 2.0), (speed, 0.0)] {
        let (outputs, inputs) = (std::iter::once(force), std::iter::once((input, 1.0)));
        ball.differentiate(outputs, inputs)
            .expect("an output by an input");
        assert_eq!(ball.change(force).expect("an output"), mass);
    }
    // Force m a, with a = 3 + 2 t: its rate is m 2.
    ball.set_input_derivative(kick, 1, 2.0).expect("an input");
    ball.step(0.25).expect("a step");
    let found = ball.real(force).expect("an output");
    assert!((found - 2.0 * 3.5).abs() < 1e-10, "{found}");
    let rate = ball.output_derivative(force, 1).expect("an output");
    assert!((rate - 4.0).abs() < 1e-10, "{rate}");
}

/// Water that is accelerated takes along what it displaces, as the master says in the next step and as outputs have it at once.
#[test]
fn a_current_whose_rate_the_master_gives_pushes() {
    let text = r#"{ "name": "bar_in_current", "dimension": 2, "accuracy": { "relative_tolerance": 1e-10 },
      "bodies": [ { "name": "bar", "element": "cable", "elements": 2, "material": { "youngs_modulus": 1e6, "density": 1500 },
                    "section": { "shape": { "circle": { "radius": 0.02 } } },
                    "shape": { "line": { "from": [0, 0], "to": [1, 0] } }, "markers": { "end": 1 } } ],
      "loads": [ { "name": "sea", "kind": "fluid", "body": "bar", "density": 1000, "added_mass": 0.8 } ],
      "inputs": [ { "kind": "current", "load": "sea" } ],
      "outputs": [ { "kind": "velocity", "marker": "bar.end" }, { "kind": "acceleration", "marker": "bar.end" } ] }"#;
    let mut simulation = Simulation::new(Scene::from_json(text).expect("a valid scene"));
    simulation.initialize(0.0).expect("an initial state");
    simulation.start().expect("a start");
    let [current, speed, kick] = [
        "sea.current[2]",
        "bar.end.velocity[2]",
        "bar.end.acceleration[2]",
    ]
    .map(|name| index(&simulation, name));
    let get = |simulation: &mut Simulation, at: usize| simulation.real(at).expect("a variable");
    assert_eq!(get(&mut simulation, kick), 0.0);
    // Mass of the water per mass of what moves.
    let (ratio, rate, second, h) = (1.8 / (1.5 + 0.8), 0.6, -0.9, 0.4);
    for (order, slope) in [(1, rate), (2, second)] {
        let set = simulation.set_input_derivative(current, order, slope);
        set.expect("an input");
    }
    let at_once = get(&mut simulation, kick);
    assert!((at_once - ratio * rate).abs() < 1e-9, "{at_once}");
    simulation.step(h).expect("a step");
    let water = h * (rate + 0.5 * h * second);
    let found = [current, speed, kick].map(|at| get(&mut simulation, at));
    let wanted = [water, ratio * water, ratio * (rate + h * second)];
    for (found, wanted) in found.into_iter().zip(wanted) {
        assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
    }
    // It goes on as it was left, in water that no longer speeds up.
    simulation.step(2.0 * h).expect("a step");
    let found = [speed, kick].map(|at| get(&mut simulation, at));
    assert!((found[0] - ratio * water).abs() < 1e-9 && found[1].abs() < 1e-9);
}
