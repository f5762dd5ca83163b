//! Files of a run for other programs and other masters, read as their standards say.

use flexbody::fmi::terminals;
use flexbody::scene::Scene;
use flexbody::view::{Limits, Recording, gltf};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

use crate::laws::runs::Run;

/// Numbers of an accessor.
fn numbers(document: &Value, bytes: &[u8], accessor: &Value) -> Vec<f64> {
    let view =
        document["accessors"][accessor.as_u64().expect("an index") as usize]["bufferView"].clone();
    let view = &document["bufferViews"][view.as_u64().expect("an index") as usize];
    let [at, length] =
        ["byteOffset", "byteLength"].map(|key| view[key].as_u64().expect("a number") as usize);
    let singles = bytes[at..at + length].chunks_exact(4);
    singles
        .map(|four| f64::from(f32::from_le_bytes([four[0], four[1], four[2], four[3]])))
        .collect()
}

fn rotation(parts: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(parts[3], parts[0], parts[1], parts[2]))
}

/// Bodies that tumble: where nodes of the file take points of their frames is where outputs say that markers are, with up along y.
#[test]
fn nodes_take_points_of_bodies_where_outputs_say() {
    // Half a revolution from the axes is as near to them as its opposite.
    for stance in [[0.5, -0.3, 0.8], [0.0, 0.0, std::f64::consts::PI]] {
        check_nodes(stance);
    }
}

fn check_nodes(stance: [f64; 3]) {
    let local = [0.3, -0.2, 0.4];
    let text = format!(
        r#"{{ "name": "tumbles", "dimension": 3, "gravity": [0.0, 0.0, -9.81],
          "bodies": [ {{ "name": "top", "element": "rigid", "shape": {{ "box": {{ "size": [0.4, 0.6, 0.8] }} }}, "density": 300.0,
            "position": [0.2, 0.1, 0.5], "orientation": {{ "rotation_vector": {stance:?} }},
            "motion": {{ "spin": [2.0, 3.0, -1.0], "velocity": [0.1, 0.4, 2.0] }},
            "markers": {{ "o": [0.0, 0.0, 0.0], "p": {local:?} }} }} ],
          "masses": [ {{ "marker": "top.p", "mass": 30.0 }} ],
          "outputs": [ {{ "kind": "position", "marker": "top.o" }}, {{ "kind": "position", "marker": "top.p" }} ],
          "experiment": {{ "stop_time": 1.0, "step": 0.05 }} }}"#
    );
    let scene = Scene::from_json(&text).unwrap_or_else(|error| panic!("{error}"));
    let run = Recording::new(&scene, None, &Limits::PAGE, &mut |_, _| ()).expect("a run");
    let file = gltf(&run);
    let length = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    let document: Value = serde_json::from_slice(&file[20..20 + length]).expect("JSON");
    let bytes = &file[28 + length..];
    let animation = &document["animations"][0];
    let course = |path: &str| {
        let channels = animation["channels"].as_array().expect("channels").iter();
        let mut of = channels.filter(|channel| channel["target"]["path"] == path);
        let sampler = of.next().expect("a channel")["sampler"]
            .as_u64()
            .expect("an index") as usize;
        let output = &animation["samplers"][sampler]["output"];
        numbers(&document, bytes, output)
    };
    let (ways, turns) = (course("translation"), course("rotation"));
    let root = document["nodes"]
        .as_array()
        .expect("nodes")
        .last()
        .expect("a root");
    let root = rotation(
        &serde_json::from_value::<Vec<f64>>(root["rotation"].clone()).expect("four numbers"),
    );
    assert!((root * Vector3::z() - Vector3::y()).norm() < 1e-6);
    assert_eq!(run.times().len(), 21);
    let mut same = Run::started(&serde_json::from_str(&text).expect("JSON"));
    for (frame, time) in run.times().iter().enumerate() {
        if frame > 0 {
            same.step(*time);
        }
        let row = same.outputs();
        let way = Vector3::from_column_slice(&ways[3 * frame..3 * frame + 3]);
        let turn = rotation(&turns[4 * frame..4 * frame + 4]);
        for (point, wanted) in [([0.0; 3], &row[..3]), (local, &row[3..6])] {
            let found = way + turn * Vector3::from(point);
            let missed = (found - Vector3::from_column_slice(wanted)).norm();
            assert!(missed < 1e-6, "frame {frame}: {found} {wanted:?}");
        }
    }
}

/// Every number of a port that rotates has a name that says which it is: axes by their letters, of a quaternion the scalar first.
#[test]
fn members_in_space_say_which_number_they_are() {
    let body = |name: &str| {
        format!(
            r#"{{ "name": "{name}", "element": "rigid", "mass": 1, "inertia": [1, 1, 1], "position": [0, 0, 0],
                  "markers": {{ "c": [0, 0, 0] }} }}"#
        )
    };
    let port = |name: &str, more: &str| {
        format!(r#"{{ "name": "{name}", "marker": "{name}_body.c", "rotation": true, {more} }}"#)
    };
    let scene = Scene::from_json(&format!(
        r#"{{ "name": "ports", "dimension": 3, "bodies": [{}, {}, {}], "ports": [{}, {}, {}] }}"#,
        body("plug_body"),
        body("socket_body"),
        body("mount_body"),
        port("plug", r#""kind": "force""#),
        port("socket", r#""kind": "motion""#),
        port(
            "mount",
            r#""kind": "motion", "stiffness": 1, "rotational_stiffness": 1"#
        ),
    ))
    .unwrap_or_else(|error| panic!("{error}"));
    let text = terminals(&scene).expect("terminals");
    for name in ["plug", "socket", "mount"] {
        for (key, letters) in [
            ("quaternion", "wxyz"),
            ("angular_velocity", "xyz"),
            ("moment", "xyz"),
            ("force", "xyz"),
            ("position", "xyz"),
            ("velocity", "xyz"),
        ] {
            for (k, letter) in letters.chars().enumerate() {
                let member = format!(
                    "variableName=\"{name}.{key}[{}]\" memberName=\"{key}_{letter}\"",
                    k + 1
                );
                assert!(text.contains(&member), "{member}: {text}");
            }
        }
    }
}
