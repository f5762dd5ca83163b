//! Reduced bodies of files in the plane, against the same bodies in space, rigid bodies, closed forms and differences.
//!
//! The strip of the book lies along x, bends across the plane in four modes and in it in two. The bracket of a case hangs from faces at
//! `z = -/+ 0.02 m`.

use std::path::Path;

use flexbody::scene::{Error, Scene, beside};
use flexbody::simulation::Simulation;
use serde_json::{Value, json};

use super::runs::{Run, vector};

const STRIP: &str = "docs/book/examples/bodies";
const BRACKET: &str = "tests/cases/reduced_bracket";

fn read(folder: &str, scene: &Value) -> Result<Scene, Error> {
    let folder = crate::root().join(Path::new(folder));
    Scene::from_json_with(&scene.to_string(), &beside(&folder))
}

fn started(folder: &str, scene: &Value) -> Run {
    let scene = read(folder, scene).unwrap_or_else(|error| panic!("{error}: {scene}"));
    let mut run = Run(Simulation::new(scene));
    run.start();
    run
}

/// The strip, with these keys more; what it is told of the plane holds in space too.
fn strip(dimension: usize, keys: &Value) -> Value {
    let mut body = json!({"name": "strip", "element": "reduced", "file": "strip.safetensors",
        "position": vector(dimension, [0.1, -0.05]), "orientation": {"rotation_vector": [0, 0, 0.3]},
        "markers": {"root": "root", "tip": "tip"}});
    for (key, value) in keys.as_object().into_iter().flatten() {
        body[key] = value.clone();
    }
    json!({"name": "strip", "dimension": dimension, "gravity": vector(dimension, [0.0, -9.81]),
        "bodies": [body], "accuracy": {"relative_tolerance": 1e-9}})
}

/// A strip whose root rotates as a motion says, with a force and a force of a port at its tip, and a bob that hangs there.
fn driven(dimension: usize, keys: &Value) -> Value {
    let mut scene = strip(dimension, keys);
    let at = [0.1 + 0.5 * 0.3_f64.cos(), -0.05 + 0.5 * 0.3_f64.sin()];
    let inertia = if dimension == 2 {
        json!(2e-3)
    } else {
        json!([2e-3, 2e-3, 2e-3])
    };
    scene["bodies"].as_array_mut().expect("bodies").push(json!({"name": "bob", "element": "rigid", "mass": 0.5,
        "inertia": inertia, "position": vector(dimension, [at[0], at[1] - 0.1]), "markers": {"top": vector(dimension, [0.0, 0.1])}}));
    let axis = |mut joint: Value| {
        if dimension == 3 {
            joint["direction"] = json!([0, 0, 1]);
        }
        joint
    };
    scene["joints"] = json!([
        axis(json!({"name": "hub", "kind": "revolute", "markers": ["ground", "strip.root"]})),
        axis(json!({"name": "pin", "kind": "revolute", "markers": ["strip.tip", "bob.top"]}))
    ]);
    scene["motions"] = json!([{"name": "drive", "kind": "angle", "joint": "hub", "value": if dimension == 2 { "0.3 + 20*t^2" } else { "20*t^2" }}]);
    scene["loads"] = json!([{"name": "pull", "kind": "force", "marker": "strip.tip", "follower": true,
        "value": match dimension { 2 => json!(["10", "200*sin(90*t)"]), _ => json!(["10", "200*sin(90*t)", "0"]) }}]);
    scene["ports"] = json!([{"name": "port", "marker": "strip.tip", "kind": "force"}]);
    scene["outputs"] = json!([{"kind": "position", "marker": "strip.tip"}, {"kind": "velocity", "marker": "strip.tip"},
        {"kind": "acceleration", "marker": "strip.tip"}, {"kind": "position", "marker": "bob.top"},
        {"kind": "reaction", "joint": "hub"}, {"kind": "reaction", "joint": "pin"}, {"kind": "energy"},
        {"kind": "center_of_mass"}, {"kind": "deflection", "marker": "strip.tip"}]);
    scene
}

/// A motion that stays in the plane is the same in the plane and in space, whatever modes are taken.
#[test]
fn a_strip_moves_in_the_plane_as_in_space() {
    // Which pairs of modes have second-order displacements depends on all modes that are taken.
    for (modes, in_space, part) in [
        (json!(1), json!(4), 2e-5),
        (json!(0), json!(0), 2e-5),
        (json!("all"), json!("all"), 1e-2),
        (
            json!({"fixed_interface": 0}),
            json!({"fixed_interface": 0}),
            1e-2,
        ),
    ] {
        let mut flat = started(
            STRIP,
            &driven(2, &json!({"modes": modes, "damping_ratio": 0.01})),
        );
        let mut space = started(
            STRIP,
            &driven(3, &json!({"modes": in_space, "damping_ratio": 0.01})),
        );
        let names = flat.names();
        assert!(names.len() > 15, "{names:?}");
        for k in 1..=5_u32 {
            let until = 0.02 * f64::from(k);
            for run in [&mut flat, &mut space] {
                run.set_all("port.force", &[3.0 * f64::from(k), -2.0]);
                run.step(until);
            }
            for name in &names {
                let (found, wanted) = (flat.read(name), space.read(name));
                let off = (found - wanted).abs();
                let least = if name.contains("acceleration") {
                    10.0
                } else {
                    0.1
                };
                assert!(
                    off < part * wanted.abs().max(least),
                    "{modes} {name} at {until}: {found}, in space {wanted}"
                );
            }
        }
        if modes != json!(0) {
            assert!(flat.read("energy.strain") > 1e-3);
        }
    }
}

/// Without modes it is the rigid body with its mass and its moment of inertia about the third axis, to the last bit.
#[test]
fn a_strip_without_modes_is_a_rigid_body_of_the_plane() {
    let line = 7850.0 * 0.03 * 0.003;
    let (mass, length): (f64, f64) = (line * 0.5, 0.5);
    let inertia = mass * (length * length + 0.03 * 0.03) / 12.0;
    let mut scene = driven(2, &json!({"modes": 0}));
    let mut reduced = started(STRIP, &scene);
    let (sin, cos) = 0.3_f64.sin_cos();
    scene["bodies"][0] = json!({"name": "strip", "element": "rigid", "mass": mass, "inertia": inertia, "angle": 0.3,
        "position": [0.1 + 0.25 * cos, -0.05 + 0.25 * sin], "markers": {"root": [-0.25, 0], "tip": [0.25, 0]}});
    scene["outputs"].as_array_mut().map(Vec::pop);
    let mut rigid = started(STRIP, &scene);
    for run in [&mut reduced, &mut rigid] {
        run.step(0.1);
    }
    for name in rigid.names() {
        let (found, wanted) = (reduced.read(&name), rigid.read(&name));
        assert!(
            (found - wanted).abs() < 1e-9 * wanted.abs().max(1.0),
            "{name}: {found}, {wanted}"
        );
    }
}

/// Of six modes the plane takes two: polynomials of degree 2 and 3, by Ritz `sqrt(720 E I / (rho A L^4))` and `sqrt(8400 E I / (rho A L^4))`.
#[test]
fn modes_across_the_plane_are_left_out() {
    let mut scene = strip(2, &json!({}));
    scene["outputs"] = json!([{"kind": "natural_frequency", "count": 5}]);
    let mut run = started(STRIP, &scene);
    let unit = (2.1e11 * 0.03_f64.powi(2) / 12.0 / 7850.0).sqrt() / 0.25;
    for (name, exact) in [
        ("natural_frequency[4]", 720.0_f64),
        ("natural_frequency[5]", 8400.0),
    ] {
        let (found, exact) = (run.read(name), exact.sqrt() * unit);
        assert!((found / exact - 1.0).abs() < 1e-9, "{found}, {exact}");
    }
    scene["outputs"][0]["count"] = json!(6);
    let error = {
        let mut run = Run(Simulation::new(read(STRIP, &scene).expect("a scene")));
        run.0.initialize(0.0).and_then(|()| run.0.start())
    };
    assert!(error.is_err(), "more modes than the plane excites");
    scene["bodies"][0]["modes"] = json!(3);
    let error = read(STRIP, &scene).expect_err("too many").to_string();
    assert!(
        error.contains("bodies[0].modes: expected a number of modes from 0 to 2"),
        "{error}"
    );
}

/// The bracket hangs from faces on both sides of the plane: of each its way in the plane is held.
#[test]
fn interfaces_beside_the_plane_are_held_in_it() {
    let scene = |dimension: usize| {
        let mut scene = json!({"name": "bracket", "dimension": dimension, "gravity": vector(dimension, [0.0, -9.81]),
            "bodies": [{"name": "bracket", "element": "reduced", "file": "bracket.safetensors",
                "position": vector(dimension, [0.0, 0.0]), "markers": {"left": "A1", "right": "A2", "tip": "B"}}],
            "joints": [{"name": "left", "kind": "spherical", "markers": ["ground", "bracket.left"]},
                {"name": "right", "kind": "spherical", "markers": ["ground", "bracket.right"]}],
            "outputs": [{"kind": "position", "marker": "bracket.tip"}, {"kind": "energy"}],
            "accuracy": {"relative_tolerance": 1e-8}});
        if dimension == 3 {
            // Faces are free to move along the third axis against each other.
            scene["joints"][1] = json!({"name": "right", "kind": "point_on_line", "direction": [0, 0, 1], "markers": ["ground", "bracket.right"]});
        } else {
            for joint in scene["joints"].as_array_mut().into_iter().flatten() {
                joint["kind"] = json!("revolute");
            }
        }
        scene
    };
    let [mut flat, mut space] = [2, 3].map(|dimension| started(BRACKET, &scene(dimension)));
    for k in 1..=2_u32 {
        let until = 0.1 * f64::from(k);
        for run in [&mut flat, &mut space] {
            run.step(until);
        }
        for name in flat.names() {
            let (found, wanted) = (flat.read(&name), space.read(&name));
            assert!(
                (found - wanted).abs() < 1e-5,
                "{name} at {until}: {found}, in space {wanted}"
            );
        }
    }
    assert!(flat.read("energy.strain") > 1e-5);
}

/// A free strip that bends keeps energy, momentum and angular momentum.
#[test]
fn a_free_strip_keeps_energy_and_momenta() {
    let mut scene = strip(
        2,
        &json!({"motion": {"velocity": [1.0, 2.0], "spin": 150.0}}),
    );
    scene["gravity"] = json!([0, 0]);
    scene["loads"] = json!([{"name": "blow", "kind": "force", "marker": "strip.tip", "value": ["0", "max(0, 4e6*(0.0005 - t))"]}]);
    scene["outputs"] = json!([{"kind": "energy"}, {"kind": "momentum"}]);
    let mut run = started(STRIP, &scene);
    let read = |run: &mut Run| {
        let momenta = ["momentum[1]", "momentum[2]", "angular_momentum"].map(|name| run.read(name));
        let energy = run.read("energy.kinetic") + run.read("energy.strain");
        [momenta[0], momenta[1], momenta[2], energy]
    };
    run.step(0.001);
    let before = read(&mut run);
    run.step(0.1);
    for (now, before) in read(&mut run).into_iter().zip(before) {
        assert!((now / before - 1.0).abs() < 1e-6, "{before} {now}");
    }
    assert!(run.read("energy.strain") > 1e-4 * before[3]);
}

/// Derivatives of outputs are those of the motion.
#[test]
fn derivatives_are_those_of_the_motion() {
    let mut scene = driven(2, &json!({"damping_ratio": 0.05}));
    scene["accuracy"] = json!({"relative_tolerance": 1e-11});
    scene["method"] = json!({"integrator": "dopri853"});
    let mut run = started(STRIP, &scene);
    run.step(0.05);
    let (names, near) = (run.names(), 1e-5);
    let mut rows = Vec::new();
    for k in 1..=5_u32 {
        run.step(0.05 + near * f64::from(k));
        let row: Vec<[f64; 3]> = (names.iter())
            .map(|name| {
                let index = run.index(name);
                let derivative =
                    |order| run.0.output_derivative(index, order).expect("a derivative");
                let [first, second] = [1, 2].map(derivative);
                [run.read(name), first, second]
            })
            .collect();
        rows.push(row);
    }
    for (i, name) in names.iter().enumerate() {
        for order in 1..=2 {
            let y = |k: usize| rows[k][i][order - 1];
            let part = [1e-3, 1e-2][order - 1];
            let difference = (y(0) - 8.0 * y(1) + 8.0 * y(3) - y(4)) / (12.0 * near);
            let found = rows[2][i][order];
            let size = rows
                .iter()
                .map(|row| row[i][order].abs())
                .fold(1.0, f64::max);
            let noise = 1e-9 * y(2).abs() / near;
            assert!(
                (found - difference).abs() < part * size + noise,
                "{name}, order {order}: {found}, {difference}"
            );
        }
    }
}

/// A state is set back with all its numbers.
#[test]
fn a_state_is_set_back() {
    let mut run = started(STRIP, &driven(2, &json!({})));
    run.step(0.03);
    let snapshot = run.snapshot();
    let names = run.names();
    let path = |run: &mut Run| {
        run.step(0.06);
        names
            .iter()
            .map(|name| run.read(name).to_bits())
            .collect::<Vec<_>>()
    };
    let first = path(&mut run);
    run.restore(&snapshot);
    assert_eq!(first, path(&mut run));
}

/// The third axis of a body stays across the plane.
#[test]
fn a_tilted_body_is_refused() {
    let scene = strip(2, &json!({"orientation": {"cardan": [0.1, 0, 0]}}));
    let error = read(STRIP, &scene).expect_err("tilted").to_string();
    assert_eq!(
        error,
        "bodies[0].orientation: expected a rotation about the third axis in the plane, found another one"
    );
}

/// A strip on a hinge at the origin, with a force that follows its tip and bends it.
fn hinged() -> Value {
    let mut scene = strip(2, &json!({"position": [0, 0], "damping_ratio": 0.01}));
    scene["gravity"] = json!([0, 0]);
    scene["joints"] =
        json!([{"name": "pin", "kind": "revolute", "markers": ["ground", "strip.root"]}]);
    scene["outputs"] = json!([{"kind": "position", "marker": "strip.tip"}, {"kind": "velocity", "marker": "strip.tip"},
        {"kind": "energy"}]);
    scene
}

/// A scene described in a frame that rotates: the strip moves as it does at rest, seen from there.
#[test]
fn a_strip_moves_in_a_frame_that_rotates() {
    let rotation = 40.0;
    let of = |rotation: f64, spin: f64| {
        let mut scene = hinged();
        scene["rotation"] = json!(rotation);
        scene["bodies"][0]["motion"] = json!({"spin": spin});
        scene["loads"] = json!([{"name": "push", "kind": "force", "marker": "strip.tip", "follower": true, "value": [5.0, 60.0]}]);
        started(STRIP, &scene)
    };
    let mut resting = of(0.0, 90.0);
    let mut rotating = of(rotation, 90.0 - rotation);
    for k in 1..=10_u32 {
        let time = 0.01 * f64::from(k);
        for run in [&mut resting, &mut rotating] {
            run.step(time);
        }
        let (sin, cos) = (rotation * time).sin_cos();
        let seen = |[x, y]: [f64; 2]| [cos * x + sin * y, cos * y - sin * x];
        let place = seen(resting.read_all("strip.tip.position"));
        let velocity = seen(resting.read_all("strip.tip.velocity"));
        let wanted = [
            place[0],
            place[1],
            velocity[0] + rotation * place[1],
            velocity[1] - rotation * place[0],
        ];
        let [x, y]: [f64; 2] = rotating.read_all("strip.tip.position");
        let [u, v]: [f64; 2] = rotating.read_all("strip.tip.velocity");
        for (found, wanted) in [x, y, u, v].into_iter().zip(wanted) {
            assert!(
                (found - wanted).abs() < 1e-5 * wanted.abs().max(1.0),
                "{time}: {found}, {wanted}"
            );
        }
    }
    assert!(resting.read("energy.strain") > 1e-4);
}

/// A steady start is in balance with centrifugal forces: the strip is bent as it begins, and rotates without change.
#[test]
fn a_strip_rotates_steadily() {
    let mut scene = hinged();
    scene["bodies"][0]["position"] = json!([0.1, 0.0]);
    scene["bodies"][0]["orientation"] = json!({"rotation_vector": [0, 0, 1.2]});
    scene["bodies"].as_array_mut().expect("bodies").push(
        json!({"name": "hub", "element": "rigid", "mass": 1, "inertia": 1,
        "position": [0, 0], "markers": {"axle": [0, 0], "rim": [0.1, 0]}}),
    );
    scene["joints"] = json!([{"name": "axle", "kind": "revolute", "markers": ["ground", "hub.axle"]},
        {"name": "foot", "kind": "weld", "markers": ["hub.rim", "strip.root"]}]);
    scene["motions"] =
        json!([{"name": "drive", "kind": "angle", "joint": "axle", "value": "100*t"}]);
    scene["initial"] = json!("steady");
    let mut run = started(STRIP, &scene);
    assert!(run.read("energy.strain") > 1e-4);
    let [x, y]: [f64; 2] = run.read_all("strip.tip.position");
    for k in 1..=10_u32 {
        let time = 0.005 * f64::from(k);
        run.step(time);
        let (sin, cos) = (100.0 * time).sin_cos();
        let found: [f64; 2] = run.read_all("strip.tip.position");
        let off = (found[0] - (cos * x - sin * y)).hypot(found[1] - (sin * x + cos * y));
        assert!(off < 1e-6, "{time}: {off}");
    }
}

/// Full turns in either direction, by implicit steps: a strip that spins about its hinge without loads keeps its energy.
#[test]
fn implicit_steps_take_full_turns() {
    for spin in [30.0, -30.0] {
        let mut scene = hinged();
        scene["bodies"][0]["motion"] = json!({"spin": spin});
        scene["method"] = json!({"integrator": "radau"});
        scene["accuracy"] = json!({"relative_tolerance": 1e-5});
        let mut run = started(STRIP, &scene);
        let before = run.read("energy.kinetic") + run.read("energy.strain");
        run.step(1.0);
        let after = run.read("energy.kinetic") + run.read("energy.strain");
        assert!(
            (after / before - 1.0).abs() < 1e-3,
            "{spin}: {before}, {after}"
        );
    }
}
