//! What a simulation says and keeps where there are many bodies.

use super::*;

fn simulation(rest: &str) -> Simulation {
    let text = format!(r#"{{ "name": "test", "dimension": 2, {rest} }}"#);
    Simulation::new(Scene::from_json(&text).expect("a valid scene"))
}

fn index(simulation: &Simulation, name: &str) -> usize {
    let mut names = simulation.variables().iter();
    let found = names.position(|variable| variable.name == name);
    found.expect("a variable of this name")
}

fn get(simulation: &mut Simulation, name: &str) -> f64 {
    let index = index(simulation, name);
    simulation.real(index).expect("a real variable")
}

fn set(simulation: &mut Simulation, name: &str, value: f64) {
    let index = index(simulation, name);
    simulation
        .set_real(index, value)
        .expect("a settable variable");
}

/// A weight on a spring whose length at rest is an input.
const HOIST: &str = r#"
    "bodies": [ { "name": "ball", "element": "rigid", "mass": 2.0, "inertia": 0.0,
      "position": [1.0, 0.0], "markers": { "eye": [0.0, 0.0] } } ],
    "loads": [ { "name": "hoist", "kind": "spring_damper", "markers": ["ground", "ball.eye"],
      "point": [0.0, 0.0], "stiffness": 50.0, "damping": 1.0 } ],
    "inputs": [ { "kind": "rest_length", "load": "hoist" } ],
    "outputs": [ { "kind": "position", "marker": "ball.eye" }, { "kind": "energy" },
      { "kind": "work" } ],
    "accuracy": { "relative_tolerance": 1.0e-8 }"#;

#[test]
fn bodies_that_do_not_fit_are_refused_with_the_names_of_their_joints() {
    let mut apart = simulation(
        r#""bodies": [ { "name": "bar", "element": "rigid", "mass": 1.0, "inertia": 1.0,
             "position": [0.0, 0.0], "markers": { "a": [-0.5, 0.0], "b": [0.5, 0.0] } } ],
           "joints": [
             { "name": "left", "kind": "revolute", "markers": ["ground", "bar.a"] },
             { "name": "right", "kind": "revolute", "markers": ["ground", "bar.b"],
               "point": [0.8, 0.0] } ]"#,
    );
    let error = apart.initialize(0.0).expect_err("a bar that is too short");
    let text = error.to_string();
    let begins = "joints: expected bodies that fit together, found gaps: ";
    assert!(text.starts_with(begins), "{text}");
    assert!(
        text.contains("joint `left` 0.150 m") && text.contains("joint `right` 0.150 m"),
        "{text}"
    );
}

#[test]
fn gaps_of_angles_are_told_in_rad_and_absurd_ones_are_refused() {
    let told = |joints: &str| {
        let bar = r#""bodies": [ { "name": "bar", "element": "rigid", "mass": 1.0, "inertia": 1.0,
            "position": [0.5, 0.0], "markers": { "a": [-0.5, 0.0], "b": [0.5, 0.0] } } ], "joints": "#;
        let mut apart = simulation(&format!("{bar}[{joints}]"));
        let error = apart
            .initialize(0.0)
            .expect_err("joints that cannot be closed");
        error.to_string()
    };
    let twisted = told(
        r#"{ "name": "clamp", "kind": "weld", "markers": ["ground", "bar.a"] },
           { "name": "turn", "kind": "orientation", "markers": ["ground", "bar.b"], "angle": 0.5 }"#,
    );
    assert!(twisted.contains("joint `turn` 0.250 rad"), "{twisted}");
    let far = told(
        r#"{ "name": "pin", "kind": "revolute", "markers": ["ground", "bar.a"],
             "point": [1000.0, 0.0] }"#,
    );
    assert!(far.contains("joint `pin` 1000.000 m"), "{far}");
}

#[test]
fn bodies_that_were_moved_far_are_told() {
    let bar = |x: f64| {
        let mut bar = simulation(&format!(
            r#""bodies": [ {{ "name": "bar", "element": "rigid", "mass": 1.0, "inertia": 1.0,
               "position": [0.5, 0.0], "markers": {{ "a": [-0.5, 0.0] }} }} ],
             "joints": [ {{ "name": "pin", "kind": "revolute", "markers": ["ground", "bar.a"],
               "point": [{x}, 0.0] }} ]"#
        ));
        bar.initialize(0.0).expect("a bar that can be moved");
        bar.initial_gaps().map(str::to_owned)
    };
    assert_eq!(bar(0.1), None);
    assert_eq!(bar(2.0).as_deref(), Some("joint `pin` 2.000 m"));
}

#[test]
fn what_nothing_holds_has_no_equilibrium() {
    for body in [
        r#""element": "rigid", "mass": 1.0, "inertia": 0.0, "position": [0.0, 0.0]"#,
        r#""element": "cable", "elements": 4, "material": { "youngs_modulus": 1e6, "density": 1e3 },
           "section": { "area": 1e-4, "second_moment": 1e-9 }, "shape": { "line": { "from": [0.0, 0.0], "to": [1.0, 0.0] } }"#,
    ] {
        let mut free = simulation(&format!(
            r#""gravity": [0.0, -9.81], "bodies": [ {{ "name": "it", {body} }} ], "initial": "static_equilibrium""#
        ));
        let error = free.initialize(0.0).expect_err("nothing holds it");
        assert!(
            error.to_string().contains("no static equilibrium"),
            "{error}"
        );
    }
}

#[test]
fn steady_motion_needs_bodies_that_move_as_one_at_a_constant_rate() {
    let started = |motion: &str, spin: f64| {
        let mut rod = simulation(&format!(
            r#""bodies": [ {{ "name": "rod", "element": "rigid", "mass": 1.0, "inertia": 1.0,
                 "position": [0.5, 0.0], "motion": {{ "velocity": [0.0, {}], "spin": {spin} }}, "markers": {{ "a": [-0.5, 0.0], "b": [0.5, 0.0] }} }} ],
               "joints": [ {{ "name": "pin", "kind": "revolute", "markers": ["ground", "rod.a"] }}{motion} ],
               "initial": "steady", "outputs": [ {{ "kind": "angular_velocity", "marker": "rod.b" }} ]"#,
            0.5 * spin
        ));
        rod.initialize(0.0)
            .map(|()| get(&mut rod, "rod.b.angular_velocity"))
    };
    assert!((started("", 3.0).expect("it turns") - 3.0).abs() < 1e-12);
    let drive = |value: &str| {
        format!(
            r#" ], "motions": [ {{ "name": "m", "kind": "angle", "joint": "pin", "value": "{value}" }}"#
        )
    };
    assert!((started(&drive("2*t"), 0.0).expect("it turns") - 2.0).abs() < 1e-12);
    let error = started(&drive("2*t+t^2"), 0.0).expect_err("it accelerates");
    assert!(
        error.to_string().contains("one that accelerates"),
        "{error}"
    );
}

#[test]
fn work_of_a_rest_length_that_jumps_is_counted() {
    let mut hoist = simulation(HOIST);
    hoist.initialize(0.0).expect("a valid scene");
    hoist.start().expect("a valid scene");
    assert_eq!(get(&mut hoist, "energy.input"), 0.0);
    set(&mut hoist, "hoist.rest_length", 0.8);
    let jump = get(&mut hoist, "energy.input");
    assert!((jump - 0.5 * 50.0 * 0.2 * 0.2).abs() < 1e-12);
    for step in 1..=20 {
        hoist.step(0.05 * f64::from(step)).expect("a step");
        let length = 0.8 + 0.02 * f64::from(step % 3);
        set(&mut hoist, "hoist.rest_length", length);
        let [kinetic, spring, input, lost] = ["kinetic", "spring", "input", "dissipated"]
            .map(|of| get(&mut hoist, &format!("energy.{of}")));
        let balance = kinetic + spring + lost - input;
        assert!(balance.abs() < 1e-6, "{step}: {balance}");
        assert!(lost > 0.0);
    }
}

#[test]
fn another_instance_goes_on_bit_for_bit() {
    let cart = r#""gravity": [0.0, -9.81],
        "bodies": [
          { "name": "cart", "element": "rigid", "mass": 1.0, "inertia": 0.0, "position": [0.0, 0.0],
            "markers": { "pin": [0.0, 0.0] } },
          { "name": "bar", "element": "rigid", "mass": 1.0, "inertia": 0.1, "position": [0.3, -0.4],
            "markers": { "top": [-0.3, 0.4] } } ],
        "joints": [
          { "name": "rail", "kind": "point_on_line", "markers": ["ground", "cart.pin"],
            "direction": [1.0, 0.0] },
          { "name": "pin", "kind": "revolute", "markers": ["cart.pin", "bar.top"] } ],
        "motions": [ { "name": "feed", "kind": "displacement", "joint": "rail",
          "value": { "input": 0 } } ],
        "outputs": [ { "kind": "angle", "marker": "bar.top" }, { "kind": "reaction", "motion": "feed" },
          { "kind": "work" } ]"#;
    let run = |simulation: &mut Simulation, from: i32, to: i32| {
        let mut seen = Vec::new();
        for step in from..to {
            let way = 0.1 * (1.0 - (0.3 * f64::from(step)).cos());
            set(simulation, "feed.displacement", way);
            simulation.step(0.05 * f64::from(step + 1)).expect("a step");
            let names = ["bar.top.angle", "feed.reaction[1]", "energy.input"];
            seen.push(names.map(|name| get(simulation, name).to_bits()));
        }
        seen
    };
    let mut first = simulation(cart);
    first.start().expect("a valid scene");
    run(&mut first, 0, 5);
    let snapshot = first.snapshot();
    let expected = run(&mut first, 5, 10);
    let mut second = simulation(cart);
    second
        .restore(&snapshot)
        .expect("a snapshot of the same scene");
    assert_eq!(second.snapshot(), snapshot);
    assert_eq!(run(&mut second, 5, 10), expected);
    let mut broken = snapshot;
    broken.state.driven.clear();
    let error = second
        .restore(&broken)
        .expect_err("a state of another scene");
    assert!(error.to_string().contains("expected a state of this scene"));
    broken.state.work[1] = f64::NAN;
    let error = second.restore(&broken).expect_err("no finite numbers");
    assert!(error.to_string().contains("finite"));
    broken.state.work[1] = 0.0;
    broken.spectra.frequencies.push(1.0);
    let error = second
        .restore(&broken)
        .expect_err("a spectrum of another scene");
    let words = "expected 0 natural frequencies, 0 eigenvalues, found 1 natural frequencies";
    assert!(error.to_string().contains(words), "{error}");
}

/// A demand that cannot be met is an error that names what can be.
#[test]
fn spectra_that_there_are_not_are_refused() {
    let rotor = |outputs: &str, spin: &str| {
        let jet = r#"{ "name": "jet", "kind": "force", "marker": "rope.b", "follower": true, "value": [-1.0, 0.0] }"#;
        let jet = if spin.is_empty() { jet } else { "" };
        simulation(&format!(
            r#""gravity": [0.0, 0.0], "bodies": [
                 {{ "name": "rope", "element": "cable", "elements": 2,
                   "material": {{ "youngs_modulus": 1.0e6, "density": 1000.0 }},
                   "section": {{ "area": 1.0e-3, "second_moment": 1.0e-8 }},
                   "shape": {{ "line": {{ "from": [0.0, 0.0], "to": [1.0, 0.0] }} }},{spin}
                   "markers": {{ "a": 0.0, "b": 1.0 }} }} ],
               "loads": [ {jet} ],
               "outputs": [ {outputs} ]"#
        ))
    };
    let refused = |outputs: &str, spin: &str, words: &str| {
        let error = rotor(outputs, spin).start().expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    };
    let eigenvalue = |count: usize| format!(r#"{{ "kind": "eigenvalue", "count": {count} }}"#);
    refused(
        &eigenvalue(90),
        "",
        "outputs: eigenvalue: expected no more than the ",
    );
    let natural = r#"{ "kind": "natural_frequency", "count": 2 }"#;
    refused(
        natural,
        "",
        r#"natural_frequency: expected forces with a potential, found one that follows "rope""#,
    );
    let spin = r#" "motion": { "spin": 2.0 },"#;
    refused(&eigenvalue(3), spin, "that do not turn as a whole");
    rotor(&eigenvalue(3), "").start().expect("a spectrum");
}

#[test]
fn a_ring_that_leaves_its_rope_stops_the_step() {
    let mut ring = simulation(
        r#""bodies": [
             { "name": "rope", "element": "cable", "elements": 4,
               "material": { "youngs_modulus": 1.0e6, "density": 1000.0 },
               "section": { "area": 1.0e-3, "second_moment": 1.0e-8 },
               "shape": { "line": { "from": [0.0, 0.0], "to": [1.0, 0.0] } },
               "markers": { "a": 0.0, "b": 1.0 } },
             { "name": "ring", "element": "rigid", "mass": 0.1, "inertia": 0.0,
               "position": [0.5, 0.0], "motion": { "velocity": [1.0, 0.0] },
               "markers": { "eye": [0.0, 0.0] } } ],
           "joints": [
             { "name": "left", "kind": "weld", "markers": ["ground", "rope.a"] },
             { "name": "right", "kind": "weld", "markers": ["ground", "rope.b"] },
             { "name": "slide", "kind": "point_on_cable", "markers": ["rope", "ring.eye"] } ],
           "outputs": [ { "kind": "travel", "joint": "slide" } ]"#,
    );
    ring.step(0.25).expect("a step along the rope");
    assert!((get(&mut ring, "slide.travel") - 0.75).abs() < 1e-6);
    let failure = ring.step(1.0).expect_err("the rope ends");
    assert!(failure.reason.contains("`slide` has left its cable"));
    // It stands at its last sub-step on the rope.
    assert!(failure.time < 1.0);
}

/// A pinned rod with these stiffness, damping, method and tolerance.
fn rod(modulus: f64, damping: f64, integrator: &str, tolerance: f64) -> Simulation {
    simulation(&format!(
        r#""gravity": [0.0, -9.81],
           "bodies": [ {{ "name": "rod", "element": "cable", "elements": 8,
             "material": {{ "youngs_modulus": {modulus:?}, "density": 5540.0, "damping_time": {damping:?} }},
             "section": {{ "area": 1.8e-3, "second_moment": 1.215e-8 }},
             "shape": {{ "line": {{ "from": [0.0, 0.0], "to": [1.2, 0.0] }} }},
             "markers": {{ "root": 0.0 }} }} ],
           "joints": [ {{ "name": "pin", "kind": "revolute", "markers": ["ground", "rod.root"] }} ],
           "method": {{ "integrator": "{integrator}" }},
           "accuracy": {{ "relative_tolerance": {tolerance:?} }}"#
    ))
}

#[test]
fn the_integrator_follows_stiffness_damping_and_tolerance() {
    let table = [
        (0.7e6, 0.0, 1e-2, "verlet"),
        (0.7e6, 0.0, 1e-4, "rkn43"),
        (0.7e6, 1e-4, 1e-4, "rk4"),
        (2.07e11, 0.0, 1e-2, "radau"),
        (2.07e11, 1e-4, 1e-6, "radau"),
    ];
    for (modulus, damping, tolerance, expected) in table {
        let mut rod = rod(modulus, damping, "auto", tolerance);
        let started = rod.initialize(0.0).and_then(|()| rod.start());
        started.expect("a rod that starts");
        rod.step(0.01).expect("a step");
        let found = rod.report().method;
        assert_eq!(found, expected, "{modulus:e}, {damping}, {tolerance:e}");
    }
}

#[test]
fn a_method_that_cannot_take_rates_is_refused_where_they_are_read() {
    for integrator in ["verlet", "rkn43", "rkn64"] {
        let error = rod(0.7e6, 1e-4, integrator, 1e-4).initialize(0.0);
        let text = error.expect_err("damping").to_string();
        let begins = r#"method.integrator: expected "auto", "radau", "rk4" or "dopri853""#;
        assert!(text.starts_with(begins), "{text}");
        assert!(text.ends_with(&format!("found \"{integrator}\"")), "{text}");
        let undamped = rod(0.7e6, 0.0, integrator, 1e-4).initialize(0.0);
        undamped.expect("no rates are read");
    }
}

/// A pendulum of a rope and a wheel, with what is put in between.
fn pendulum(rest: &str) -> Simulation {
    simulation(&format!(
        r#""gravity": [0.0, -9.81],
        "bodies": [
          {{ "name": "rope", "element": "cable", "elements": 3,
            "material": {{ "youngs_modulus": 1.0e6, "density": 1000.0 }},
            "section": {{ "area": 1.0e-3, "second_moment": 1.0e-8 }},
            "shape": {{ "line": {{ "from": [0.0, 0.0], "to": [1.0, 0.0] }} }},
            "markers": {{ "root": 0.0, "inside": 0.4, "tip": 1.0 }} }},
          {{ "name": "wheel", "element": "rigid", "mass": 0.5, "inertia": 0.02, "position": [1.2, 0.1],
            "angle": 0.3, "markers": {{ "rim": [-0.2, -0.1], "far": [0.2, 0.1] }} }} ],
        "joints": [ {{ "name": "pin", "kind": "revolute", "markers": ["rope.tip", "wheel.rim"] }} ],
        "accuracy": {{ "relative_tolerance": 1.0e-7 }}, {rest}"#
    ))
}

#[test]
fn a_force_port_is_a_force_and_outputs_at_its_marker() {
    let kinds = ["position", "velocity", "acceleration", "angle"];
    let kinds = kinds.map(|kind| format!(r#"{{ "kind": "{kind}", "marker": "wheel.far" }}"#));
    let mut plain = pendulum(&format!(
        r#""inputs": [ {{ "kind": "force", "marker": "wheel.far" }},
             {{ "kind": "moment", "marker": "wheel.far" }} ], "outputs": [ {} ]"#,
        kinds.join(", ")
    ));
    let mut port = pendulum(
        r#""ports": [ { "name": "plug", "marker": "wheel.far", "kind": "force", "rotation": true } ]"#,
    );
    for step in 1..=10 {
        let values = [0.3 * f64::from(step), -2.0, 0.05];
        for (key, value) in ["force[1]", "force[2]", "moment"].into_iter().zip(values) {
            set(&mut plain, &format!("wheel.far.{key}"), value);
            set(&mut port, &format!("plug.{key}"), value);
        }
        for simulation in [&mut plain, &mut port] {
            simulation.step(0.02 * f64::from(step)).expect("a step");
        }
        for key in ["position[1]", "velocity[2]", "acceleration[1]", "angle"] {
            let expected = get(&mut plain, &format!("wheel.far.{key}"));
            assert_eq!(get(&mut port, &format!("plug.{key}")), expected, "{key}");
        }
    }
}

#[test]
fn angular_acceleration_is_the_rate_of_angular_velocity() {
    let mut port = pendulum(
        r#""outputs": [ { "kind": "angular_velocity", "marker": "rope.inside" },
             { "kind": "angular_acceleration", "marker": "rope.inside" },
             { "kind": "angular_velocity", "joint": "pin" },
             { "kind": "angular_acceleration", "joint": "pin" } ]"#,
    );
    let h = 1e-4;
    port.step(0.3).expect("a step");
    for of in ["rope.inside", "pin"] {
        let (velocity, acceleration) = (
            format!("{of}.angular_velocity"),
            format!("{of}.angular_acceleration"),
        );
        let before = get(&mut port, &velocity);
        let first = get(&mut port, &acceleration);
        let time = port.time();
        port.step(time + h).expect("a step");
        let change = (get(&mut port, &velocity) - before) / h;
        let mean = 0.5 * (first + get(&mut port, &acceleration));
        assert!(
            (change - mean).abs() < 1e-3 * (1.0 + mean.abs()),
            "{of}: {change}, {mean}"
        );
    }
}

#[test]
fn a_motion_port_exerts_the_opposite_of_what_drives_its_marker() {
    let motions = ["position", "angle"].map(|kind| {
        format!(
            r#"{{ "name": "{kind}", "kind": "{kind}", "marker": "rope.root", "value": {{ "input": 2 }} }}"#
        )
    });
    let mut plain = pendulum(&format!(
        r#""motions": [ {} ], "outputs": [ {{ "kind": "reaction", "motion": "position" }},
             {{ "kind": "reaction_moment", "motion": "angle" }} ]"#,
        motions.join(", ")
    ));
    let mut port = pendulum(
        r#""ports": [ { "name": "hook", "marker": "rope.root", "kind": "motion", "rotation": true } ]"#,
    );
    for step in 1..=10 {
        let t = 0.02 * f64::from(step - 1);
        for (of, key, value) in [
            ("position", "position[1]", 0.5 * t * t),
            ("position", "velocity[1]", t),
            ("position", "acceleration[1]", 1.0),
            ("angle", "angle", -t * t),
            ("angle", "angular_velocity", -2.0 * t),
            ("angle", "angular_acceleration", -2.0),
        ] {
            set(&mut plain, &format!("{of}.{key}"), value);
            set(&mut port, &format!("hook.{key}"), value);
        }
        for simulation in [&mut plain, &mut port] {
            simulation.step(t + 0.02).expect("a step");
        }
        for (of, key) in [
            ("position.reaction[1]", "force[1]"),
            ("position.reaction[2]", "force[2]"),
            ("angle.reaction_moment", "moment"),
        ] {
            let expected = -get(&mut plain, of);
            assert_eq!(get(&mut port, &format!("hook.{key}")), expected, "{key}");
            assert!(expected != 0.0);
        }
    }
}

#[test]
fn work_through_a_coupling_is_counted_while_its_point_moves() {
    let mut port = pendulum(
        r#""ports": [ { "name": "mount", "marker": "rope.inside", "kind": "motion", "stiffness": 200.0,
             "damping": 3.0, "rotational_stiffness": 1.0, "rotational_damping": 0.02 } ],
           "outputs": [ { "kind": "energy" }, { "kind": "work" } ]"#,
    );
    port.initialize(0.0).expect("a valid scene");
    let kept = ["kinetic", "strain", "gravity", "spring", "dissipated"];
    let balance = |port: &mut Simulation| -> f64 {
        let sum: f64 = kept
            .iter()
            .map(|of| get(port, &format!("energy.{of}")))
            .sum();
        sum - get(port, "energy.input")
    };
    let start = balance(&mut port);
    for step in 0..100 {
        let t = 0.005 * f64::from(step);
        for (key, value) in [
            ("position[1]", 0.4 + 0.1 * (4.0 * t).sin()),
            ("velocity[1]", 0.4 * (4.0 * t).cos()),
            ("velocity[2]", -0.3),
            ("position[2]", -0.3 * t),
            ("angle", 2.0 * t),
            ("angular_velocity", 2.0),
        ] {
            set(&mut port, &format!("mount.{key}"), value);
        }
        port.step(t + 0.005).expect("a step");
    }
    let off = balance(&mut port) - start;
    assert!(off.abs() < 1e-4, "{off}");
    assert!(get(&mut port, "energy.dissipated") > 0.1);
    assert!(get(&mut port, "energy.input").abs() > 0.1);
}

#[test]
fn a_port_that_contradicts_a_joint_is_named() {
    let mut port = pendulum(
        r#""ports": [ { "name": "plug", "marker": "wheel.far", "kind": "force" },
             { "name": "hook", "marker": "rope.root", "kind": "motion", "rotation": true },
             { "name": "other", "marker": "rope.tip", "kind": "motion" },
             { "name": "third", "marker": "wheel.rim", "kind": "motion" } ]"#,
    );
    let error = port.initialize(0.0).expect_err("one point driven twice");
    let begins = "ports[3]: expected a motion of what joints and other motions leave free";
    assert!(error.to_string().starts_with(begins), "{error}");
}
