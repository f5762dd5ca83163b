//! Reduced bodies: files, and what asks for axes of interfaces that have none.

use serde_json::{Value, json};

use crate::scene::container::tests::example;
use crate::scene::{Error, Scene, remarks};

/// A reduced body and a box. The interface `A1` has rotations, `B` has none.
fn scene() -> Value {
    json!({
        "name": "reduced", "dimension": 3,
        "bodies": [
            {"name": "bracket", "element": "reduced", "file": "parts/bracket.safetensors", "damping_ratio": 0.01,
                "position": [1, 2, 3], "orientation": {"cardan": [0.1, 0.2, 0.3]},
                "motion": {"velocity": [1, 0, 0], "spin": [0, 0, 1]},
                "markers": {"left": "A1", "tip": "B"}, "gauges": {"corner": "fillet"}},
            {"name": "box", "element": "rigid", "mass": 1, "inertia": [1, 1, 1], "position": [0, 0, 0],
                "markers": {"eye": [0, 0, 0.1]}}
        ],
        "joints": [
            {"name": "foot", "kind": "weld", "markers": ["ground", "bracket.left"]},
            {"name": "ball", "kind": "spherical", "markers": ["bracket.tip", "box.eye"]}
        ],
        "motions": [],
        "loads": [
            {"name": "push", "kind": "force", "marker": "bracket.tip", "value": [1, 0, 0]},
            {"name": "twist", "kind": "moment", "marker": "bracket.left", "value": [1, 0, 0]},
            {"name": "tie", "kind": "spring_damper", "markers": ["ground", "bracket.tip"], "point": [0, 0, 0], "stiffness": 1}
        ],
        "outputs": [
            {"kind": "position", "marker": "bracket.tip"},
            {"kind": "velocity", "marker": "bracket.tip"},
            {"kind": "orientation", "marker": "bracket.left"},
            {"kind": "reaction", "joint": "foot"}
        ],
        "ports": []
    })
}

fn files(name: &str) -> Result<Vec<u8>, String> {
    match name {
        "parts/bracket.safetensors" => Ok(example().bytes()),
        "broken.safetensors" => Ok(vec![1, 2, 3]),
        _ => Err("no such file".into()),
    }
}

fn read(scene: &Value) -> Result<Scene, Error> {
    Scene::from_json_with(&scene.to_string(), &files)
}

/// The message about a scene with one value changed, or put at the end of a list (`/-`).
fn told(pointer: &str, value: Value) -> String {
    let mut scene = scene();
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
    match scene.pointer_mut(parent).expect("a place in the scene") {
        Value::Array(list) if key == "-" => list.push(value),
        Value::Array(list) => list[key.parse::<usize>().expect("an index")] = value,
        place => place[key] = value,
    }
    read(&scene).map_or_else(|error| error.to_string(), |_| "accepted".into())
}

#[test]
fn a_scene_with_a_reduced_body_is_valid_and_survives_being_written() -> Result<(), Error> {
    let first = read(&scene())?;
    let written = first.to_json();
    assert_eq!(read(&serde_json::from_str(&written).expect("JSON"))?, first);
    let body = first.bodies[0].reduced().expect("a reduced body");
    let container = body.contained();
    assert!(written.contains(&format!("\"sha256\": \"{}\"", container.digest())));
    assert_eq!(
        first
            .files()
            .into_iter()
            .map(|(name, bytes)| (name, bytes.to_vec()))
            .collect::<Vec<_>>(),
        [("parts/bracket.safetensors", example().bytes())]
    );
    assert_eq!(body.first_modes(), 3);
    // Another file is another scene.
    let mut other = example();
    other.numbers("mass", &[1], &[3.0]);
    let bytes = other.bytes();
    let text = scene().to_string();
    let second = Scene::from_json_with(&text, &|_| Ok(bytes.clone()))?;
    assert_ne!(second.to_json(), written);
    Ok(())
}

#[test]
fn markers_stand_at_interfaces() -> Result<(), Error> {
    let scene = read(&scene())?;
    let body = scene.bodies[0].reduced().expect("a reduced body");
    let resolved = scene.resolved();
    let tip = resolved.marker("bracket.tip").expect("a marker");
    let place = body.contained().place(1);
    let way = body.axes() * place;
    for k in 0..3 {
        assert!(
            (tip.position[k] - scene.bodies[0].reduced().expect("it").position[k] - way[k]).abs()
                < 1e-15
        );
        assert!((tip.direction[k] - body.axes()[(k, 0)]).abs() < 1e-15);
    }
    Ok(())
}

#[test]
fn files_are_named_and_checked() {
    #[rustfmt::skip] // a table
    let cases = [
        (
            "/bodies/0/file",
            json!("../a.safetensors"),
            "bodies[0].file: expected the name of a file beside the scene",
        ),
        (
            "/bodies/0/file",
            json!("/a.safetensors"),
            "bodies[0].file: expected the name of a file beside the scene",
        ),
        (
            "/bodies/0/file",
            json!("C:a.safetensors"),
            "bodies[0].file: expected the name of a file beside the scene",
        ),
        (
            "/bodies/0/file",
            json!("scene.json"),
            "bodies[0].file: expected the name of a file beside the scene",
        ),
        (
            "/bodies/0/file",
            json!("a.safetensors"),
            "bodies[0].file: \"a.safetensors\": no such file",
        ),
        (
            "/bodies/0/file",
            json!("broken.safetensors"),
            "bodies[0].file: \"broken.safetensors\": header: expected the length",
        ),
        (
            "/bodies/0/sha256",
            json!("00"),
            "bodies[0].sha256: expected the digest of \"parts/bracket.safetensors\", ",
        ),
        (
            "/bodies/0/fil",
            json!("a"),
            "bodies[0].fil: expected one of the keys name, file, sha256, modes, critically_damped, damping_ratio, position, orientation, motion, markers, gauges, found \"fil\"; did you mean `file`",
        ),
    ];
    for (pointer, value, expected) in cases {
        let told = told(pointer, value);
        assert!(told.starts_with(expected), "{told}");
    }
    let error = Scene::from_json(&scene().to_string()).expect_err("no files");
    assert!(
        error
            .message
            .contains("has no folder that files are read from"),
        "{error}"
    );
}

#[test]
fn values_of_reduced_bodies_are_checked() {
    #[rustfmt::skip] // a table
    let cases = [
        (
            "/dimension",
            json!(2),
            "bodies[0].position: expected 2 components",
        ),
        (
            "/rotation",
            json!([0, 0, 1]),
            "accepted",
        ),
        (
            "/bodies/0/modes",
            json!("automatic"),
            "bodies[0].modes: expected a number of modes, {\"up_to\": a frequency in Hz}, {\"fixed_interface\": a number of modes}, \"all\" or \"auto\", found \"automatic\"",
        ),
        (
            "/bodies/0/modes",
            json!("al"),
            "bodies[0].modes: expected a number of modes",
        ),
        (
            "/bodies/0/modes",
            json!({"fixed_interface": 4}),
            "bodies[0].modes.fixed_interface: expected a number of modes from 0 to 3, which the file has, found 4",
        ),
        (
            "/bodies/0/modes",
            json!(4),
            "bodies[0].modes: expected a number of modes from 0 to 3, which the file has, found 4",
        ),
        ("/bodies/0/modes", json!(-1), "bodies[0].modes: expected"),
        ("/bodies/0/modes", json!(2), "accepted"),
        ("/bodies/0/modes", json!("all"), "accepted"),
        (
            "/bodies/0/modes",
            json!(0),
            "bodies[0].gauges: expected none of a body without modes, found 1",
        ),
        ("/bodies/0/modes", json!({"fixed_interface": 0}), "accepted"),
        ("/bodies/0/modes", json!({"fixed_interface": 3}), "accepted"),
        ("/bodies/0/modes", json!("auto"), "accepted"),
        ("/bodies/0/modes", json!({"up_to": 40}), "accepted"),
        (
            "/bodies/0/modes",
            json!({"up_to": 30}),
            "bodies[0].modes.up_to: expected at least the first natural frequency (31.8",
        ),
        (
            "/bodies/0/modes",
            json!({"upto": 30}),
            "bodies[0].modes.upto: expected one of the keys up_to, found \"upto\"; did you mean `up_to`",
        ),
    ];
    for (pointer, value, expected) in cases {
        let told = told(pointer, value);
        assert!(told.starts_with(expected), "{told}\nnot {expected}");
    }
}

#[test]
fn damping_and_places_of_reduced_bodies_are_checked() {
    #[rustfmt::skip] // a table
    let cases = [
        (
            "/bodies/0/damping_ratio",
            json!(-0.1),
            "bodies[0].damping_ratio: expected zero or a positive number (1), found -0.1",
        ),
        (
            "/bodies/0/damping_ratio",
            json!([[1, 0.1], [3, 0.2]]),
            "accepted",
        ),
        (
            "/bodies/0/damping_ratio",
            json!([]),
            "bodies[0].damping_ratio: expected at least one pair",
        ),
        (
            "/bodies/0/damping_ratio",
            json!([[1, 0.1], [1, 0.2]]),
            "bodies[0].damping_ratio[1][0]: expected frequencies (Hz) that ascend, found 1",
        ),
        (
            "/bodies/0/damping_ratio",
            json!([[1, -0.1]]),
            "bodies[0].damping_ratio[0][1]: expected zero or a positive",
        ),
        (
            "/bodies/0/damping_ratio",
            json!([[1]]),
            "bodies[0].damping_ratio[0]: expected a list of 2, found 1",
        ),
        (
            "/bodies/0/position",
            json!([1, 2]),
            "bodies[0].position: expected 3 components",
        ),
        (
            "/bodies/0/orientation",
            json!({"quaternion": [0, 0, 0, 0]}),
            "bodies[0].orientation: expected finite numbers",
        ),
        (
            "/bodies/0/motion",
            json!({"deformation": ["0", "0", "s"]}),
            "bodies[0].motion.deformation: expected none of a reduced body",
        ),
        (
            "/bodies/0/markers/tip",
            json!("A11"),
            "bodies[0].markers.tip: expected the name of an interface in \"parts/bracket.safetensors\" (A1, B), found \"A11\"; did you mean `A1`",
        ),
        (
            "/bodies/0/markers/tip",
            json!([0, 0, 0]),
            "bodies[0].markers.tip: expected a string, found a list",
        ),
    ];
    for (pointer, value, expected) in cases {
        let told = told(pointer, value);
        assert!(told.starts_with(expected), "{told}\nnot {expected}");
    }
}

#[test]
fn gauges_of_reduced_bodies_are_checked() {
    #[rustfmt::skip] // a table
    let cases = [
        (
            "/bodies/0/gauges",
            json!({"tip": "filet"}),
            "bodies[0].gauges.tip: expected the name of a stress in \"parts/bracket.safetensors\" (fillet), found \"filet\"; did you mean `fillet`",
        ),
        (
            "/bodies/0/gauges",
            json!({"the tip": "fillet"}),
            "bodies[0].gauges.the tip: expected a letter or _, then letters, digits and _, found \"the tip\"",
        ),
        (
            "/bodies/0/gauges",
            json!({"tip": 1}),
            "bodies[0].gauges.tip: expected a string, found 1",
        ),
        (
            "/outputs/-",
            json!({"kind": "stress_tensor", "gauge": "bracket.corner"}),
            "accepted",
        ),
        (
            "/outputs/-",
            json!({"kind": "stress_tensor", "gauge": "bracket.corners"}),
            "outputs[4].gauge: expected a gauge of a reduced body of this scene (bracket.corner), found \"bracket.corners\"; did you mean `bracket.corner`",
        ),
        (
            "/outputs/-",
            json!({"kind": "stress_tensor", "marker": "bracket.corner"}),
            "outputs[4].marker: ",
        ),
    ];
    for (pointer, value, expected) in cases {
        let told = told(pointer, value);
        assert!(told.starts_with(expected), "{told}\nnot {expected}");
    }
}

#[test]
fn what_needs_axes_is_refused_at_points() {
    let point = "expected an interface with rotations (reduce the model with rotations there, NAME.rotation), found \
                 \"bracket.tip\", whose interface \"B\" has none";
    let pair = json!(["ground", "bracket.tip"]);
    #[rustfmt::skip] // a table
    let cases = [
        (
            "/joints/-",
            json!({"name": "a", "kind": "weld", "markers": pair}),
            "joints[2].markers[1]",
        ),
        (
            "/joints/-",
            json!({"name": "a", "kind": "revolute", "markers": pair, "direction": [0, 0, 1]}),
            "joints[2].markers[1]",
        ),
        (
            "/joints/-",
            json!({"name": "a", "kind": "prismatic", "markers": pair, "direction": [0, 0, 1]}),
            "joints[2].markers[1]",
        ),
        (
            "/joints/-",
            json!({"name": "a", "kind": "orientation", "markers": pair}),
            "joints[2].markers[1]",
        ),
        (
            "/joints/-",
            json!({"name": "a", "kind": "point_on_line", "markers": ["bracket.tip", "box.eye"], "direction": [0, 0, 1]}),
            "joints[2].markers[0]",
        ),
        (
            "/joints/-",
            json!({"name": "a", "kind": "generic", "markers": pair, "free": ["x"]}),
            "joints[2].markers[1]",
        ),
        (
            "/loads/-",
            json!({"name": "a", "kind": "moment", "marker": "bracket.tip", "value": [1, 0, 0]}),
            "loads[3].marker",
        ),
        (
            "/loads/-",
            json!({"name": "a", "kind": "force", "marker": "bracket.tip", "follower": true, "value": [1, 0, 0]}),
            "loads[3].marker",
        ),
        (
            "/loads/-",
            json!({"name": "a", "kind": "bushing", "markers": pair, "translational_stiffness": [1, 1, 1]}),
            "loads[3].markers[1]",
        ),
        (
            "/outputs/-",
            json!({"kind": "orientation", "marker": "bracket.tip"}),
            "outputs[4].marker",
        ),
        (
            "/outputs/-",
            json!({"kind": "quaternion", "marker": "bracket.tip"}),
            "outputs[4].marker",
        ),
        (
            "/outputs/-",
            json!({"kind": "angular_velocity", "marker": "bracket.tip"}),
            "outputs[4].marker",
        ),
        (
            "/outputs/-",
            json!({"kind": "direction", "marker": "bracket.tip"}),
            "outputs[4].marker",
        ),
        (
            "/outputs/-",
            json!({"kind": "reaction", "joint": "ball", "axes": "body"}),
            "outputs[4].axes",
        ),
        (
            "/ports/-",
            json!({"name": "a", "kind": "force", "marker": "bracket.tip", "rotation": true}),
            "ports[0].marker",
        ),
    ];
    for (pointer, value, place) in cases {
        assert_eq!(told(pointer, value), format!("{place}: {point}"));
    }
}

#[test]
fn what_needs_no_axes_is_taken_at_points() {
    let pair = json!(["ground", "bracket.tip"]);
    let allowed = [
        ("/joints/1/kind", json!("spherical")),
        (
            "/joints/-",
            json!({"name": "a", "kind": "point_on_line", "markers": pair, "direction": [0, 0, 1]}),
        ),
        (
            "/joints/-",
            json!({"name": "a", "kind": "revolute", "markers": ["bracket.left", "box.eye"], "direction": [0, 0, 1]}),
        ),
        (
            "/motions/-",
            json!({"name": "a", "kind": "position", "marker": "bracket.tip", "value": [0, 0, "t"]}),
        ),
        (
            "/outputs/-",
            json!({"kind": "angular_velocity", "marker": "bracket.left", "axes": "body"}),
        ),
        (
            "/ports/-",
            json!({"name": "a", "kind": "force", "marker": "bracket.tip"}),
        ),
        (
            "/outputs/-",
            json!({"kind": "deflection", "marker": "bracket.tip", "from": "bracket.left"}),
        ),
    ];
    for (pointer, value) in allowed {
        assert_eq!(told(pointer, value), "accepted");
    }
}

#[test]
fn what_belongs_to_lines_and_rigid_bodies_is_refused() {
    #[rustfmt::skip] // a table
    let cases = [
        (
            "/masses",
            json!([{"marker": "bracket.tip", "mass": 1}]),
            "masses[0].marker: expected a marker of another body than a reduced one",
        ),
        (
            "/motions/-",
            json!({"name": "a", "kind": "orientation", "marker": "bracket.left", "value": [1, 0, 0, 0]}),
            "motions[0].marker: expected a rigid body; drive one that is welded to the interface",
        ),
        (
            "/joints/-",
            json!({"name": "a", "kind": "point_on_cable", "markers": ["bracket", "box.eye"]}),
            "joints[2].markers[0]: expected the name of a cable of this scene",
        ),
        (
            "/loads/-",
            json!({"name": "a", "kind": "distributed_force", "body": "bracket", "value": [0, 0, 1]}),
            "loads[3].body: expected the name of a cable of this scene",
        ),
        (
            "/loads/-",
            json!({"name": "a", "kind": "fluid", "body": "bracket", "density": 1}),
            "loads[3].body: expected the name of a cable, rod, beam, plate or shell of this scene",
        ),
        (
            "/outputs/-",
            json!({"kind": "axial_force", "marker": "bracket.left"}),
            "outputs[4].marker: expected a marker of a cable",
        ),
        (
            "/outputs/-",
            json!({"kind": "deflection", "marker": "bracket.left", "from": "bracket.tip"}),
            "outputs[4].from: expected an interface with rotations",
        ),
    ];
    for (pointer, value, expected) in cases {
        let told = told(pointer, value);
        assert!(told.starts_with(expected), "{told}\nnot {expected}");
    }
}

/// The file has pairs of the first two of its three modes.
#[test]
fn pairs_that_the_modes_of_a_body_lack_are_told() -> Result<(), Error> {
    let told = |modes: Value| -> Result<bool, Error> {
        let mut scene = scene();
        scene["bodies"][0]["modes"] = modes;
        if scene["bodies"][0]["modes"] == 0 {
            let body = scene["bodies"][0].as_object_mut().expect("a body");
            body.remove("gauges");
        }
        let told = remarks(&read(&scene)?);
        let wanted = "bodies[0].file: found second-order displacements of pairs of the first 2 of 3 modes only, where the modes of \"bracket\" \
            combine others: ";
        Ok(told.iter().any(|remark| remark.starts_with(wanted)))
    };
    for (modes, is_told) in [
        (json!("all"), true),
        (json!("auto"), true),
        (json!({"fixed_interface": 1}), true),
        (json!(2), false),
        (json!(0), false),
    ] {
        assert_eq!(told(modes.clone())?, is_told, "{modes}");
    }
    Ok(())
}
