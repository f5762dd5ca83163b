//! What a scene with driven motions, springs and hinges lists.

use super::*;
use crate::scene::Spin;

/// A scene with driven motions of every kind, springs, hinges and masses.
fn scene() -> Scene {
    let text = r#"{ "name": "all", "dimension": 2,
      "bodies": [
        { "name": "crank", "element": "rigid", "mass": 0.1, "inertia": 1.0e-3, "position": [1.0, 2.0],
          "angle": 0.5, "markers": { "a": [0.0, 0.0], "b": [1.0, 0.0] } },
        { "name": "cart", "element": "rigid", "mass": 1.0, "inertia": 0.0, "position": [4.0, 0.0],
          "markers": { "centre": [0.0, 0.0] } },
        { "name": "rod", "element": "cable", "elements": 4,
          "material": { "youngs_modulus": 1.0e6, "density": 1000.0 },
          "section": { "area": 1.0e-3, "second_moment": 1.0e-8 },
          "shape": { "line": { "from": [0.0, 0.0], "to": [0.0, 1.0] } },
          "markers": { "root": 0.0, "tip": 1.0 } } ],
      "masses": [ { "marker": "rod.tip", "mass": 2.0 } ],
      "joints": [
        { "name": "elbow", "kind": "revolute", "markers": ["rod.tip", "crank.a"], "damping": 0.1 },
        { "name": "rail", "kind": "point_on_line", "markers": ["ground", "cart.centre"],
          "direction": [2.0, 0.0], "point": [1.0, 0.0] } ],
      "motions": [
        { "name": "turn", "kind": "angle", "joint": "elbow", "value": { "input": 2 } },
        { "name": "place", "kind": "position", "marker": "crank.b", "value": { "input": 1 } },
        { "name": "known", "kind": "angle", "marker": "rod.root", "value": "t" },
        { "name": "feed", "kind": "displacement", "joint": "rail", "value": { "input": 0 } } ],
      "loads": [
        { "name": "hoist", "kind": "spring_damper", "markers": ["rod.root", "cart.centre"],
          "stiffness": 50.0 } ],
      "inputs": [
        { "kind": "force", "marker": "rod.tip", "follower": true, "start": [1.0, -1.0] },
        { "kind": "distributed_force", "body": "rod" },
        { "kind": "rest_length", "load": "hoist" } ],
      "outputs": [
        { "kind": "angle", "joint": "elbow" }, { "kind": "reaction_moment", "motion": "turn" },
        { "kind": "energy" }, { "kind": "work" } ] }"#;
    Scene::from_json(text).expect("a valid scene")
}

fn inputs(list: &[Variable]) -> Vec<(&str, usize, f64)> {
    let found = list.iter().filter_map(|variable| match variable.source {
        Source::Input(place) => Some((&variable.name[..], place, variable.start.unwrap_or(-99.0))),
        _ => None,
    });
    found.collect()
}

#[test]
fn inputs_are_listed_by_derivative_and_placed_by_coordinate() {
    let list = variables(&scene());
    let angle = 0.5 - std::f64::consts::FRAC_PI_2;
    let expected = [
        ("rod.tip.follower_force[1]", 0, 1.0),
        ("rod.tip.follower_force[2]", 1, -1.0),
        ("rod.distributed_force[1]", 2, 0.0),
        ("rod.distributed_force[2]", 3, 0.0),
        ("hoist.rest_length", 4, 4.0),
        ("turn.angle", 5, angle),
        ("turn.angular_velocity", 6, 0.0),
        ("turn.angular_acceleration", 7, 0.0),
        ("place.position[1]", 8, 1.0 + 0.5_f64.cos()),
        ("place.position[2]", 10, 2.0 + 0.5_f64.sin()),
        ("place.velocity[1]", 9, 0.0),
        ("place.velocity[2]", 11, 0.0),
        ("feed.displacement", 12, 3.0),
    ];
    let found = inputs(&list);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!((found.0, found.1), (expected.0, expected.1));
        assert!((found.2 - expected.2).abs() < 1e-14, "{}", found.0);
    }
    let starts = start_inputs(&list);
    assert_eq!(starts.len(), scene().resolved().numbers);
    assert_eq!(starts[8..10], [1.0 + 0.5_f64.cos(), 0.0]);
}

#[test]
fn parameters_are_those_of_bodies_masses_hinges_and_springs() {
    let list = variables(&scene());
    let of = |name: &str| {
        let found = list.iter().find(|variable| variable.name == name);
        found.map(|variable| (variable.start, variable.unit.map_or("", |unit| unit.name)))
    };
    for (name, start, unit) in [
        ("crank.mass", 0.1, "kg"),
        ("crank.inertia", 1e-3, "kg.m2"),
        ("cart.inertia", 0.0, "kg.m2"),
        ("rod.elements", 4.0, ""),
        ("rod.tip.mass", 2.0, "kg"),
        ("elbow.stiffness", 0.0, "N.m/rad"),
        ("elbow.damping", 0.1, "N.m.s/rad"),
        ("hoist.stiffness", 50.0, "N/m"),
        ("hoist.damping", 0.0, "N.s/m"),
    ] {
        assert_eq!(of(name), Some((Some(start), unit)), "{name}");
    }
    assert_eq!(of("rotation"), None);
    let mut turning = scene();
    turning.rotation = Spin::Number(3.0);
    assert!(variables(&turning).iter().any(|v| v.name == "rotation"));
}

/// Bodies of every shape, one of them on a bushing.
const SIZES: &str = r#"{ "name": "sizes", "dimension": 3,
      "bodies": [
        { "name": "block", "element": "rigid", "position": [0.0, 0.0, 0.0], "density": 1.0, "shape": { "box": { "size": [0.4, 0.7, 1.1] } },
          "markers": { "c": [0.0, 0.0, 0.0] } },
        { "name": "roller", "element": "rigid", "position": [0.0, 0.0, 0.0], "density": 1.0,
          "shape": { "cylinder": { "radius": 0.3, "length": 0.9 } } },
        { "name": "ball", "element": "rigid", "position": [0.0, 0.0, 0.0], "density": 1.0, "shape": { "sphere": { "radius": 0.2 } } },
        { "name": "pipe", "element": "rigid", "position": [0.0, 0.0, 0.0], "density": 1.0,
          "shape": { "tube": { "radius": 0.5, "inner_radius": 0.45, "length": 0.8 } } } ],
      "loads": [ { "name": "mount", "kind": "bushing", "markers": ["ground", "block.c"],
                   "translational_stiffness": [3.0, 5.0, 8.0], "rotational_damping": [0.1, 0.2, 0.3] } ] }"#;

#[test]
fn sizes_of_shapes_and_of_bushings_are_parameters() {
    let list = variables(&Scene::from_json(SIZES).expect("a valid scene"));
    for (name, start, unit, meaning) in [
        (
            "block.size[1]",
            0.4,
            "m",
            "Length of the edge of block along the x axis of its frame",
        ),
        (
            "block.size[3]",
            1.1,
            "m",
            "Length of the edge of block along the z axis of its frame",
        ),
        ("roller.radius", 0.3, "m", "Radius of roller"),
        ("roller.length", 0.9, "m", "Length of roller along its axis"),
        ("ball.radius", 0.2, "m", "Radius of ball"),
        ("pipe.radius", 0.5, "m", "Radius of pipe"),
        ("pipe.inner_radius", 0.45, "m", "Radius of the hole in pipe"),
        ("pipe.length", 0.8, "m", "Length of pipe along its axis"),
        (
            "mount.translational_stiffness[2]",
            5.0,
            "N/m",
            "Stiffness along the y axis of mount",
        ),
        (
            "mount.translational_damping[1]",
            0.0,
            "N.s/m",
            "Damping along the x axis of mount",
        ),
        (
            "mount.rotational_stiffness[3]",
            0.0,
            "N.m/rad",
            "Stiffness about the z axis of mount",
        ),
        (
            "mount.rotational_damping[3]",
            0.3,
            "N.m.s/rad",
            "Damping about the z axis of mount",
        ),
    ] {
        let found = list.iter().find(|variable| variable.name == name);
        let found = found.unwrap_or_else(|| panic!("no {name}"));
        assert_eq!(found.start, Some(start), "{name}");
        assert_eq!(found.unit.map(|unit| unit.name), Some(unit), "{name}");
        assert_eq!(found.description, meaning);
        assert_eq!(found.limits(), (Some(0.0), None), "{name}");
    }
    assert_eq!(
        list.iter().filter(|v| v.name.starts_with("mount.")).count(),
        12
    );
    let sizes = |v: &&Variable| matches!(v.source, Source::Parameter(Parameter::SolidLength(..)));
    assert_eq!(list.iter().filter(sizes).count(), 3 + 2 + 1 + 3);
}

#[test]
fn a_shape_beside_a_mass_is_drawn_only() {
    let body = |shape: &str| {
        let text = format!(
            r#"{{ "name": "measured", "dimension": 3, "bodies": [ {{ "name": "part", "element": "rigid", "mass": 2.0,
              "inertia": [0.3, 0.4, 0.5], "position": [0.0, 0.0, 0.0]{shape} }} ] }}"#
        );
        let list = variables(&Scene::from_json(&text).expect("a valid scene"));
        let start = |v: &Variable| (v.name.clone(), v.start);
        list.iter().map(start).collect::<Vec<_>>()
    };
    let drawn = body(r#", "shape": { "sphere": { "radius": 0.2 } }"#);
    assert_eq!(drawn, body(""));
    assert!(drawn.contains(&("part.inertia[2]".into(), Some(0.4))));
}

/// Radii of a tube are set one after another, through values that fit together only in the end.
#[test]
fn radii_of_a_tube_are_checked_together() {
    let text = r#"{ "name": "tube", "dimension": 2,
      "bodies": [ { "name": "pipe", "element": "rigid", "position": [0.0, 0.0], "density": 1.0,
        "shape": { "tube": { "radius": 0.5, "inner_radius": 0.4, "length": 0.8 } } } ] }"#;
    let scene = Scene::from_json(text).expect("a valid scene");
    let place = |name: &str| variables(&scene).iter().position(|v| v.name == name);
    let [outer, inner] =
        ["pipe.radius", "pipe.inner_radius"].map(|name| place(name).expect("a parameter"));
    let mut pipe = crate::simulation::Simulation::new(scene.clone());
    let negative = pipe.set_real(inner, -0.1).expect_err("a negative radius");
    assert!(
        negative
            .to_string()
            .contains("pipe.inner_radius: expected zero or a positive number")
    );
    pipe.set_real(inner, 0.6).expect("what a larger tube has");
    let error = pipe.initialize(0.0).expect_err("a hole beyond its tube");
    let wanted =
        "bodies[0].shape.tube.inner_radius: expected less than the outer radius (0.5 m), found 0.6";
    assert_eq!(error.to_string(), wanted);
    pipe.set_real(outer, 0.7).expect("a larger tube");
    pipe.start().expect("a tube");
    let late = pipe.set_real(outer, 0.8).expect_err("parameters are fixed");
    assert!(
        late.to_string().contains("until initialization ends"),
        "{late}"
    );
}

#[test]
fn what_jumps_with_an_input_is_direct() {
    let list = variables(&scene());
    let direct = |name: &str| {
        let found = list.iter().find(|variable| variable.name == name);
        let depends = |v: &Variable| list.iter().any(|input| v.depends_on(input));
        found.map(|variable| (variable.acts_at_once(), depends(variable)))
    };
    for (name, acts, depends) in [
        ("hoist.rest_length", true, false),
        ("rod.tip.follower_force[2]", true, false),
        ("turn.angle", false, false),
        ("place.velocity[2]", false, false),
        ("elbow.angle", false, false),
        ("turn.reaction_moment", false, true),
        ("energy.kinetic", false, false),
        ("energy.spring", false, true),
        ("energy.input", false, true),
        ("energy.dissipated", false, false),
    ] {
        assert_eq!(direct(name), Some((acts, depends)), "{name}");
    }
    let mut without = scene();
    without.inputs.pop();
    let list = variables(&without);
    let spring = list
        .iter()
        .find(|variable| variable.name == "energy.spring");
    assert!(spring.is_some_and(|v| !list.iter().any(|input| v.depends_on(input))));
}

/// Ports of every kind.
fn with_ports() -> Scene {
    let scene = scene();
    let ports = r#"[
      { "name": "plug", "marker": "crank.a", "kind": "force", "rotation": true },
      { "name": "hook", "marker": "rod.tip", "kind": "motion", "rotation": true },
      { "name": "mount", "marker": "cart.centre", "kind": "motion", "stiffness": 5.0, "damping": 0.5 },
      { "name": "shaft", "marker": "rod.tip", "kind": "motion", "damping": 1.0,
        "rotational_stiffness": 2.0 } ]"#;
    let text = scene
        .to_json()
        .replace("\"ports\": []", &format!("\"ports\": {ports}"));
    Scene::from_json(&text).expect("a valid scene")
}

#[test]
fn a_port_has_one_set_of_variables() {
    let list = variables(&with_ports());
    let of = |port: &str| -> Vec<&str> {
        let names = list.iter().map(|variable| variable.name.as_str());
        let keys = names.filter_map(|name| name.split_once('.'));
        let keys = keys.filter(|(of, _)| *of == port);
        keys.map(|(_, key)| key.split('[').next().unwrap_or(key))
            .collect()
    };
    let set = |port: &str| -> std::collections::BTreeSet<&str> { of(port).into_iter().collect() };
    let full = [
        "acceleration",
        "angle",
        "angular_acceleration",
        "angular_velocity",
        "force",
        "moment",
        "position",
        "velocity",
    ];
    for port in ["plug", "hook"] {
        assert_eq!(set(port), full.into(), "{port}");
        assert_eq!(of(port).len(), 12, "{port}");
    }
    let expected = ["damping", "force", "position", "stiffness", "velocity"];
    assert_eq!(set("mount"), expected.into());
    assert_eq!(of("shaft").len(), 4 + 3 * 2 + 3);
    let found = inputs(&list);
    let starts = |name: &str| found.iter().find(|input| input.0 == name).map(|i| i.2);
    let near = |name: &str, value: f64| starts(name).is_some_and(|s| (s - value).abs() < 1e-14);
    assert!(near("hook.angle", std::f64::consts::FRAC_PI_2) && near("hook.position[2]", 1.0));
    assert!(near("mount.position[1]", 4.0) && near("mount.velocity[1]", 0.0));
    assert_eq!(start_inputs(&list).len(), with_ports().resolved().numbers);
}

#[test]
fn what_comes_into_a_coupling_acts_at_once() {
    let list = variables(&with_ports());
    for (name, is_direct) in [
        ("plug.force[1]", true),
        ("plug.moment", true),
        ("plug.position[1]", false),
        ("plug.angular_velocity", false),
        ("plug.acceleration[2]", true),
        ("plug.angular_acceleration", true),
        ("hook.position[1]", false),
        ("hook.force[2]", true),
        ("hook.moment", true),
        ("shaft.position[2]", true),
        ("shaft.angular_velocity", true),
        ("mount.force[1]", true),
        ("shaft.moment", true),
        ("energy.spring", true),
    ] {
        let found = list.iter().find(|variable| variable.name == name);
        assert_eq!(found.map(|v| v.is_direct), Some(is_direct), "{name}");
    }
}

#[test]
fn forces_of_couplings_follow_from_what_comes_in_through_them() {
    let list = variables(&with_ports());
    let on = |name: &str| -> Vec<&str> {
        let output = list.iter().find(|variable| variable.name == name);
        let output = output.expect("an output of this name");
        let inputs = list.iter().filter(|input| output.depends_on(input));
        inputs.map(|input| input.name.as_str()).collect()
    };
    let mount = [
        "mount.position[1]",
        "mount.position[2]",
        "mount.velocity[1]",
        "mount.velocity[2]",
    ];
    assert_eq!(on("mount.force[2]"), mount);
    let shaft = ["shaft.angle", "shaft.angular_velocity"];
    assert_eq!(on("shaft.moment"), shaft);
    let energy = on("energy.spring");
    let set = [
        "hoist.rest_length",
        "mount.position[1]",
        "mount.position[2]",
        "shaft.position[1]",
        "shaft.position[2]",
        "shaft.angle",
    ];
    assert_eq!(energy, set);
    assert!(on("plug.acceleration[1]").contains(&"mount.velocity[2]"));
    assert!(on("plug.velocity[1]").is_empty());
    assert!(on("hook.force[1]").contains(&"hook.acceleration[1]"));
}

#[test]
fn names_are_unique() {
    let list = variables(&with_ports());
    let names: std::collections::BTreeSet<_> = list.iter().map(|v| &v.name).collect();
    assert_eq!(names.len(), list.len());
}
