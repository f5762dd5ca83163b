//! Equilibria that are not there, not stable, or too far for the work that is allowed: none is answered in silence.

use flexbody::scene::Scene;
use flexbody::simulation::{Budget, Simulation, plan};
use serde_json::{Value, json};

/// What is told when a scene is to start; nothing where it starts from a stable equilibrium.
fn told(scene: &Value) -> Option<String> {
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let mut simulation = Simulation::new(scene);
    match simulation.initialize(0.0) {
        Err(error) => Some(error.to_string()),
        Ok(_) => simulation.is_unstable().then(|| "not stable".into()),
    }
}

/// A body drawn where a surface begins, on top of it.
fn on_top(surface: Value, friction: f64) -> Value {
    let mut contact = json!({"name": "touch", "kind": "contact", "marker": "it.c", "surface": surface, "stiffness": 1e5});
    if friction > 0.0 {
        contact["friction"] = json!(friction);
        contact["slip_velocity"] = json!(1e-3);
    }
    json!({"name": "on_top", "dimension": 3, "gravity": [0.0, 0.0, -9.81],
        "bodies": [{"name": "it", "element": "rigid", "mass": 1.0, "inertia": [0.1, 0.1, 0.1],
                    "position": [0.0, 0.0, 1.0], "markers": {"c": [0.0, 0.0, 0.0]}}],
        "loads": [contact], "initial": "static_equilibrium"})
}

/// On top of what is round a point stands, but not stably, and beside it there is no other place: it rolls down. Friction holds nothing
/// that rests. On a plane it stays.
#[test]
fn what_stands_on_top_of_what_is_round_is_told_of() {
    let sphere = json!({"sphere": {"center": [0.0, 0.0, 0.0], "radius": 1.0}});
    let cylinder =
        json!({"cylinder": {"point": [0.0, 0.0, 0.0], "axis": [0.0, 1.0, 0.0], "radius": 1.0}});
    for surface in [sphere, cylinder] {
        for friction in [0.0, 0.3] {
            let told = told(&on_top(surface.clone(), friction));
            let told = told.unwrap_or_else(|| panic!("no word: {surface}, {friction}"));
            assert!(
                told.contains("moves away without end") && told.contains("`it`"),
                "{surface}, {friction}: {told}"
            );
        }
    }
}

/// A line of 1 m drawn straight between pins nearer than that.
fn slack(work_limit: f64) -> Value {
    json!({"name": "slack", "dimension": 2, "gravity": [0.0, -9.81],
        "bodies": [{"name": "line", "element": "cable", "elements": 16,
                    "material": {"youngs_modulus": 7.7e10, "density": 7850.0}, "section": {"area": 1.3e-5, "second_moment": 0.0},
                    "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.0]}}, "markers": {"a": 0.0, "b": 1.0}}],
        "joints": [{"name": "a", "kind": "revolute", "markers": ["ground", "line.a"], "point": [0.0, 0.0]},
                   {"name": "b", "kind": "revolute", "markers": ["ground", "line.b"], "point": [0.8, 0.1]}],
        "method": {"work_limit": work_limit}, "initial": "static_equilibrium"})
}

#[test]
fn the_search_obeys_the_work_limit_and_says_so() {
    let told = told(&slack(50.0)).expect("a limit below any work");
    assert!(
        told.contains("the work limit is reached") && told.contains("work_limit = 5e1"),
        "{told}"
    );
    assert_eq!(self::told(&slack(1e8)), None);
}

/// A beam that an end moment winds to ten turns, beside a force: it is wound by little and little, and steps that do not succeed are given up
/// before they take more than all the others. Moments and forces balance.
#[test]
fn a_beam_is_wound_to_ten_turns_within_little_work() {
    const MOMENT: f64 = 200.0 * std::f64::consts::PI;
    let scene = json!({"name": "wound", "dimension": 3,
        "bodies": [{"name": "beam", "element": "beam", "elements": 40,
                    "material": {"youngs_modulus": 1e4, "shear_modulus": 1e4, "density": 1.0},
                    "section": {"area": 1.0, "second_moments": [0.01, 0.01], "torsion_constant": 0.01, "shear_factors": [1.0, 1.0]},
                    "axis": [0.0, 1.0, 0.0], "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [10.0, 0.0, 0.0]}},
                    "markers": {"root": 0.0, "tip": 1.0}}],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "beam.root"]}],
        "loads": [{"name": "turn", "kind": "moment", "marker": "beam.tip", "value": [0.0, 0.0, MOMENT]},
                  {"name": "side", "kind": "force", "marker": "beam.tip", "value": [0.0, 0.0, 50.0]}],
        "outputs": [{"kind": "reaction", "joint": "clamp"}, {"kind": "reaction_moment", "joint": "clamp"},
                    {"kind": "position", "marker": "beam.tip"}],
        "method": {"work_limit": 1.6e6}, "initial": "static_equilibrium"});
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("an equilibrium");
    let variables = simulation.variables().iter().enumerate();
    let outputs = variables.filter(|(_, it)| it.start.is_none() && it.name != "time");
    let outputs: Vec<usize> = outputs.map(|(index, _)| index).collect();
    let values = outputs.into_iter().map(|index| simulation.real(index));
    let values: Vec<f64> = values.map(|value| value.expect("a number")).collect();
    let [x, y, _] = [values[6], values[7], values[8]];
    let right = [0.0, 0.0, 50.0, 50.0 * y, -50.0 * x, MOMENT];
    for (value, right) in values.iter().zip(right) {
        assert!(
            (value.abs() - right.abs()).abs() < 1e-6,
            "{values:?}, {right}"
        );
    }
    assert!(
        x.abs().max(y.abs()) < 0.1,
        "ten turns end near their beginning: {values:?}"
    );
}

/// A rigid body at the end of a beam has no stiffness of its own. It hangs where linear theory has it, up to what the deflection changes:
/// `P L^3 / 3 E I + M L^2 / 2 E I + q L^4 / 8 E I` (S. P. Timoshenko, Strength of materials I, section 40), and for its own length the slope.
#[test]
fn a_body_at_the_end_of_a_beam_hangs() -> Result<(), String> {
    let (length, arm, mass) = (0.4, 0.25, 0.353_f64);
    for (width, height, modulus, elements) in [
        (0.03, 0.006, 2e10, 1),
        (0.03, 0.006, 2e10, 4),
        (0.03, 0.006, 2e10, 16),
        (0.006, 0.03, 2e10, 4),
        (0.03, 0.02, 1e9, 4),
    ] {
        let line = 7850.0 * width * height * 9.81;
        let weight = mass * 9.81;
        let scene = json!({"name": "hung", "dimension": 3, "gravity": [0, 0, -9.81],
            "bodies": [{"name": "beam", "element": "beam", "elements": elements,
                        "material": {"youngs_modulus": modulus, "shear_modulus": 0.4 * modulus, "density": 7850},
                        "section": {"shape": {"rectangle": {"width": width, "height": height}}},
                        "shape": {"line": {"from": [0, 0, 0], "to": [length, 0, 0]}}, "markers": {"clamp": 0, "end": 1}},
                       {"name": "body", "element": "rigid", "mass": mass, "inertia": [2.7e-5, 7.4e-3, 7.4e-3],
                        "position": [length + arm, 0, 0], "markers": {"root": [-arm, 0, 0], "tip": [arm, 0, 0]}}],
            "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "beam.clamp"]},
                       {"name": "seam", "kind": "weld", "markers": ["beam.end", "body.root"]}],
            "outputs": [{"kind": "position", "marker": "body.tip"}, {"kind": "reaction_moment", "joint": "wall"}],
            "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-6}});
        let scene = Scene::from_json(&scene.to_string()).map_err(|error| error.to_string())?;
        let mut simulation = Simulation::new(scene);
        simulation
            .initialize(0.0)
            .map_err(|error| error.to_string())?;
        simulation.start().map_err(|error| error.to_string())?;
        let mut value = |name: &str| {
            let index = simulation.variables().iter().position(|v| v.name == name);
            let index = index.ok_or_else(|| format!("{name}: no such variable"))?;
            simulation.real(index).map_err(|error| error.to_string())
        };
        let case = format!("{width} x {height}, {elements}");
        let moment = weight * (length + arm) + line * length * length / 2.0;
        let found = value("wall.reaction_moment[2]")?.abs();
        assert!(
            (found / moment - 1.0).abs() < 0.01,
            "{case}: {found} {moment}"
        );
        let stiffness = modulus * width * f64::powi(height, 3) / 12.0;
        let at_end = weight * arm;
        let fall = weight * length.powi(3) / 3.0
            + at_end * length.powi(2) / 2.0
            + line * length.powi(4) / 8.0;
        let slope = weight * length.powi(2) / 2.0 + at_end * length + line * length.powi(3) / 6.0;
        let expected = (fall + slope * 2.0 * arm) / stiffness;
        let found = -value("body.tip.position[3]")?;
        assert!(
            (found / expected - 1.0).abs() < 0.02,
            "{case}: {found} {expected}"
        );
    }
    Ok(())
}

/// A mesh that is too fine to be started within the work limit does not end a plan: the best of those before is taken, and that it does not
/// keep the error is told.
#[test]
fn a_mesh_without_a_start_does_not_end_a_plan() {
    let mut scene = slack(3e3);
    let line = scene["bodies"][0].as_object_mut().expect("a body");
    line.remove("elements");
    line["markers"]["m"] = json!(0.37);
    scene["outputs"] = json!([{"kind": "position", "marker": "line.m"}]);
    scene["accuracy"] = json!({"error": 1e-8});
    scene["experiment"] = json!({"stop_time": 0.01, "step": 0.01});
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let planned = plan(&scene, &Budget::default(), &mut |_, _, _| ());
    let (_, planned) = planned.expect("a plan of the meshes that start");
    let told = planned.numbers.expect("numbers of elements").missed();
    assert!(
        told.iter().any(|told| told.contains("line.m.position")),
        "{told:?}"
    );
}

/// A body that nothing holds falls, so there is no equilibrium: that is told before any run, with the meshes that were tried.
#[test]
fn a_start_without_equilibrium_is_told_before_any_run() {
    let scene = json!({
        "name": "free", "dimension": 2, "gravity": [0.0, -9.81], "initial": "static_equilibrium",
        "bodies": [{"name": "cable", "element": "cable", "material": {"youngs_modulus": 1e10, "density": 5000.0},
                    "section": {"area": 1e-4, "second_moment": 1e-9},
                    "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.0]}}, "markers": {"b": 1.0}}],
        "outputs": [{"kind": "position", "marker": "cable.b"}],
        "experiment": {"stop_time": 1.0, "step": 0.1}});
    let scene = Scene::from_json(&scene.to_string()).unwrap_or_else(|error| panic!("{error}"));
    let mut runs = 0;
    let found = plan(&scene, &Budget::default(), &mut |_, _, _| runs += 1);
    let error = found.expect_err("no start").to_string();
    assert_eq!(runs, 0);
    assert!(error.starts_with("initial: "), "{error}");
}
