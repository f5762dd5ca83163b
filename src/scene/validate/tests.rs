//! What scenes may say, and refusals, one line each: where, what stands there instead, and how the
//! message begins.

mod airfoils;
mod contacts;
mod fluids;
mod patches;
mod planar_beams;
mod profiles;
mod reduced;
mod releases;
mod schema;
mod space;
mod stress;
mod winches;

use serde_json::{Value, json};

use crate::math::function::Function;
use crate::scene::{Body, BodyReference, Place, Scene};
use crate::system::Drive;

/// A scene with every kind of part.
fn scene() -> Value {
    let cable = |name: &str, from: [f64; 2], to: [f64; 2]| {
        json!({"name": name, "element": "cable", "elements": 8,
            "material": {"youngs_modulus": 7e5, "density": 5540},
            "section": {"area": 1.8e-3, "second_moment": 1.215e-8},
            "shape": {"line": {"from": from, "to": to}},
            "markers": {"root": 0, "low": 0.25, "mid": 0.5, "tip": 1}})
    };
    json!({
        "name": "everything", "dimension": 2, "gravity": [0, -9.81],
        "bodies": [
            cable("rod", [0.0, 0.0], [1.0, 0.0]),
            cable("rope", [0.0, 1.0], [3.0, 1.0]),
            {"name": "crank", "element": "rigid", "mass": 0.1, "inertia": 1e-3, "position": [1.5, 0],
                "markers": {"a": [-0.5, 0], "b": [0.5, 0]}},
            {"name": "load", "element": "rigid", "mass": 1, "inertia": 0, "position": [1, 1],
                "markers": {"eye": [0, 0]}},
            {"name": "cart", "element": "rigid", "mass": 1, "inertia": 1, "position": [0, -1],
                "angle": 0.5, "motion": {"velocity": [1, 0], "spin": 2}, "markers": {"top": [0, 0.1]}}
        ],
        "masses": [{"marker": "rod.mid", "mass": 2, "inertia": 0.1}, {"marker": "crank.b", "mass": 1}],
        "joints": [
            {"name": "pin", "kind": "revolute", "markers": ["ground", "rod.root"], "point": [0, 0]},
            {"name": "knee", "kind": "revolute", "markers": ["rod.tip", "crank.a"],
                "stiffness": 1, "damping": 0.1, "angle": 0},
            {"name": "rail", "kind": "point_on_line", "markers": ["ground", "cart.top"], "direction": [1, 0]},
            {"name": "ring", "kind": "point_on_cable", "markers": ["rope", "load.eye"]},
            {"name": "link", "kind": "distance", "markers": ["crank.b", "load.eye"], "length": 1.5},
            {"name": "clamp", "kind": "weld", "markers": ["ground", "rope.root"], "angle": 0.1},
            {"name": "guide", "kind": "orientation", "markers": ["cart.top", "rope.tip"]}
        ],
        "motions": [
            {"name": "drive", "kind": "angle", "joint": "pin", "value": "0.1*sin(2*PI*t)"},
            {"name": "feed", "kind": "displacement", "joint": "rail", "value": {"table": [[0, 0], [1, 2]]}},
            {"name": "lift", "kind": "position", "marker": "rope.tip", "value": {"input": 2}},
            {"name": "tilt", "kind": "angle", "marker": "crank.b", "value": {"input": 0}},
            {"name": "shift", "kind": "position", "marker": "crank.b", "value": [1, "t"]}
        ],
        "loads": [
            {"name": "push", "kind": "force", "marker": "rod.tip", "follower": true, "value": ["t", 1]},
            {"name": "twist", "kind": "moment", "marker": "rod.mid", "value": {"table": [[0, 1], [2, 3]]}},
            {"name": "motor", "kind": "torque", "joint": "knee", "value": 0.1},
            {"name": "wind", "kind": "distributed_force", "body": "rope", "value": [0, -1]},
            {"name": "hoist", "kind": "spring_damper", "markers": ["rope.mid", "load.eye"],
                "stiffness": 100, "damping": 1, "length": 0.3},
            {"name": "tie", "kind": "spring_damper", "markers": ["ground", "crank.b"], "point": [2, 1],
                "stiffness": 1}
        ],
        "inputs": [
            {"kind": "force", "marker": "rod.tip", "start": [1, 2]},
            {"kind": "force", "marker": "rod.tip", "follower": true},
            {"kind": "moment", "marker": "crank.a"},
            {"kind": "torque", "joint": "knee"},
            {"kind": "distributed_force", "body": "rod"},
            {"kind": "rest_length", "load": "tie"}
        ],
        "outputs": [
            {"kind": "position", "marker": "load.eye"}, {"kind": "angle", "joint": "knee"},
            {"kind": "angular_velocity", "marker": "crank.a"}, {"kind": "axial_force", "marker": "rod.mid"},
            {"kind": "bending_moment", "marker": "rod.mid"},
            {"kind": "connectivity_force", "marker": "rod.low"}, {"kind": "travel", "joint": "ring"},
            {"kind": "reaction", "joint": "ring"}, {"kind": "reaction", "motion": "feed"},
            {"kind": "reaction_moment", "motion": "drive"}, {"kind": "reaction_moment", "joint": "clamp"},
            {"kind": "energy"}, {"kind": "work"}, {"kind": "momentum"}, {"kind": "center_of_mass"},
            {"kind": "residual"}, {"kind": "natural_frequency", "count": 3}, {"kind": "eigenvalue", "count": 3}
        ],
        "ports": ports()
    })
}

/// Ports of every kind.
fn ports() -> Value {
    json!([
        {"name": "plug", "marker": "rod.tip", "kind": "force", "rotation": true},
        {"name": "socket", "marker": "cart.top", "kind": "motion", "rotation": true},
        {"name": "mount", "marker": "rope.mid", "kind": "motion", "stiffness": 1e4, "damping": 10,
            "rotational_stiffness": 5, "rotational_damping": 0.1}
    ])
}

/// The message about a scene with one value changed.
fn told(mut scene: Value, pointer: &str, value: Value) -> String {
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
    match scene.pointer_mut(parent).expect("a place in the scene") {
        Value::Array(list) => list[key.parse::<usize>().expect("an index")] = value,
        place => place[key] = value,
    }
    match Scene::from_json(&scene.to_string()) {
        Ok(_) => "accepted".into(),
        Err(error) => error.to_string(),
    }
}

/// Lines of `pointer | value | message`.
fn check(scene: impl Fn() -> Value, cases: &str) {
    let mut complaints = Vec::new();
    for line in cases.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let cells: Vec<&str> = line.splitn(3, " | ").collect();
        let (pointer, value, expected) = (cells[0], cells[1], cells[2]);
        let value = serde_json::from_str(value).expect(value);
        let told = told(scene(), pointer, value);
        if !told.starts_with(expected) {
            complaints.push(format!("{pointer}: {told}"));
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn a_scene_with_everything_is_valid_and_survives_being_written() {
    let read = Scene::from_json(&scene().to_string()).expect("a valid scene");
    assert_eq!(Scene::from_json(&read.to_json()), Ok(read));
}

#[test]
fn types_and_keys_keep_their_places() {
    check(
        scene,
        r#"
        /bodies | [] | bodies: expected at least one body, found none
        /bodies/0/element | "brick" | bodies[0].element: expected "cable", "rod", "beam", "auto", "rigid", "reduced", "plate" or "shell", found "brick"
        /bodies/0 | {"name": "rod"} | bodies[0].element: expected "cable", "rod", "beam", "auto", "rigid", "reduced", "plate" or "shell", found nothing
        /bodies/0 | 3 | bodies[0]: expected a body { ... }, found 3
        /bodies/0/section | [1e-3, 1e-8] | bodies[0].section: expected an object { ... }, found a list
        /bodies/0/shape | {"line": {}, "arc": {}} | bodies[0].shape: expected an object with one of "line" or "arc" or "helix", found {"arc", "line"}
        /bodies/0/section/area | "wide" | bodies[0].section.area: expected a number, found "wide"
        /bodies/0/material/damping_ratio | -1 | bodies[0].material.damping_ratio: expected zero or a positive number (1), found -1
        /bodies/0/material | {"youngs_modulus": 7e5, "density": 5540, "damping_time": 0.1, "damping_ratio": 0.02} | bodies[0].material.damping_ratio: expected nothing beside a `damping_time`, found 0.02
        /bodies/0/material/colour | 1 | bodies[0].material.colour: expected one of the keys youngs_modulus, shear_modulus, density, damping_time, damping_ratio, found "colour"
        /bodies/0/section | {"area": 1} | bodies[0].section.second_moment: expected a value, found nothing
        /bodies/2/elements | 3 | bodies[2].elements: expected one of the keys name, mass
        /bodies/2/markers/a | [1, 2, 3] | bodies[2].markers.a
        /bodies/2/position | [1] | bodies[2].position
        /loads/0/value | true | loads[0].value: expected a number, an expression
        /loads/0/value | [1, true] | loads[0].value[1]: expected a number, an expression
        /loads/0/value | [1] | loads[0].value
        /loads/0/value | {"input": 1} | loads[0].value.input: expected one of the keys table, interpolation, slopes, found "input"
        /loads/1/value | {"table": [[0, 1], [1]]} | loads[1].value.table[1]: expected a list of 2, found
        /loads/4 | {"name": "hoist", "kind": "table_spring", "markers": ["rope.mid", "load.eye"], "spring": [[0, 1]]} | loads[4].spring: expected two points or more, found 1
        /loads/4 | {"name": "hoist", "kind": "table_spring", "markers": ["rope.mid", "load.eye"], "spring": [[0, 1], [0, 2]]} | loads[4].spring: expected points in increasing order, found 0 after 0
        /loads/4 | {"name": "hoist", "kind": "table_spring", "markers": ["rope.mid", "load.eye"], "spring": [[0, 1], [1, 2]], "damper": [[-1, -1], [1, 1]]} | loads[4].damper: expected a point [0, 0], since a damper at rest has no force
        /loads/4 | {"name": "hoist", "kind": "table_spring", "spring": [[0, 1], [1, 2]]} | loads[4]: expected `markers` or `joint`, found neither
        /loads/4 | {"name": "hoist", "kind": "table_spring", "markers": ["rope.mid", "load.eye"], "joint": "knee", "spring": [[0, 1], [1, 2]]} | loads[4]: expected `markers` or `joint`, found both
        /loads/4 | {"name": "hoist", "kind": "table_spring", "joint": "knee", "point": [0, 0], "spring": [[0, 1], [1, 2]]} | loads[4].point: expected nothing beside a joint
        /loads/4 | {"name": "hoist", "kind": "table_spring", "markers": ["rope.mid", "load.eye"], "coordinate": "angle", "spring": [[0, 1], [1, 2]]} | loads[4].coordinate: expected nothing between markers
        /loads/4 | {"name": "hoist", "kind": "force_law", "joint": "knee", "force": "2*y"} | loads[4].force: expected one of the names t, x, v, u, PI
        /loads/4 | {"name": "hoist", "kind": "force_law", "joint": "knee", "force": "3*sign(v)"} | loads[4].force: expected a force that does not jump where `v` changes its sign
        /loads/4 | {"name": "hoist", "kind": "force_law", "joint": "knee", "force": "2*u"} | loads[4].force: expected an input of kind `control` for this load, which sets `u`, found none
        /loads/4 | {"name": "hoist", "kind": "force_law", "joint": "knee", "coordinate": "displacement", "force": "2*x"} | loads[4].joint: expected a joint along a line
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid", "load.eye"], "axial_stiffness": 1e4} | accepted
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["ground", "rope.mid", "ground"], "points": [[0, 1], [1, 1]], "axial_stiffness": 1e4, "length": "1+t", "damping_time": 0.1, "drum": "knee", "drum_radius": -0.2} | accepted
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid"], "axial_stiffness": 1e4} | loads[4].markers: expected from 2 to 30 of them, found 1
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid", "rope.end"], "axial_stiffness": 1e4} | loads[4].markers[1]: expected
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["load.eye", "load.eye"], "axial_stiffness": 1e4} | loads[4].markers: expected points of two bodies or more, of which the ground is one, found points of one
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["ground", "load.eye"], "axial_stiffness": 1e4} | loads[4].points: expected a point for each `ground` among `markers`, found 0 of them
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["ground", "load.eye"], "points": [[0, 1], [1, 1]], "axial_stiffness": 1e4} | loads[4].points: expected no more points than `ground` is among `markers`, found
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["ground", "load.eye"], "points": [[0, 1, 2]], "axial_stiffness": 1e4} | loads[4].points[0]: expected
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid", "load.eye"], "axial_stiffness": 0} | loads[4].axial_stiffness: expected a positive
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid", "load.eye"], "axial_stiffness": 1, "length": 0} | loads[4].length: expected a positive
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid", "load.eye"], "axial_stiffness": 1, "damping_time": -1} | loads[4].damping_time: expected
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid", "load.eye"], "axial_stiffness": 1, "drum_radius": 1} | loads[4].drum_radius: expected nothing without a `drum`
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid", "load.eye"], "axial_stiffness": 1, "drum": "knee"} | loads[4].drum_radius: expected a radius, m, found nothing
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid", "load.eye"], "axial_stiffness": 1, "drum": "knee", "drum_radius": 0} | loads[4].drum_radius: expected a radius other than 0, m
        /loads/4 | {"name": "hoist", "kind": "reeving", "markers": ["rope.mid", "load.eye"], "axial_stiffness": 1, "drum": "none", "drum_radius": 1} | loads[4].drum: expected
        /loads/4 | {"name": "hoist", "kind": "airfoil", "marker": "crank.a", "chord_direction": [1, 0], "chord": 0.1, "span": 1, "density": 1.2, "lift": "2*PI*sin(a)", "drag": {"table": [[-1, 1], [1, 1]]}, "moment": "-q", "wind": [1, "t"]} | accepted
        /loads/4 | {"name": "hoist", "kind": "airfoil", "marker": "crank.a", "chord_direction": [1, 0], "chord": 0.1, "span": 1, "density": 1.2} | loads[4].lift: expected
        /loads/4 | {"name": "hoist", "kind": "airfoil", "marker": "crank.a", "chord_direction": [1, 0], "chord": 0.1, "span": 1, "density": 1.2, "lift": "2*x"} | loads[4].lift: expected
        /loads/4 | {"name": "hoist", "kind": "airfoil", "marker": "crank.a", "chord_direction": [1, 0], "chord": 0.1, "span": 1, "density": 1.2, "lift": 1, "lift_direction": [0, 1]} | loads[4].lift_direction: expected nothing in the plane
        /loads/4 | {"name": "hoist", "kind": "airfoil", "marker": "crank.a", "chord_direction": [1, 0], "chord": 0.1, "span": 1, "density": 1.2, "lift": 1, "wind": [1]} | loads[4].wind: expected 2 values
        /loads/4 | {"name": "hoist", "kind": "airfoil", "marker": "crank.a", "chord_direction": [1, 0], "chord": 0, "span": 1, "density": 1.2, "lift": 1} | loads[4].chord: expected a positive
        /loads/4 | {"name": "hoist", "kind": "airfoil", "marker": "crank.a", "chord_direction": [0, 0], "chord": 0.1, "span": 1, "density": 1.2, "lift": 1} | loads[4].chord_direction: expected a direction that is not zero
        /loads/4 | {"name": "hoist", "kind": "airfoil", "marker": "load.eye", "chord_direction": [1, 0], "chord": 0.1, "span": 1, "density": 1.2, "lift": 1} | loads[4].marker: expected a marker that can rotate
        /outputs/0 | {"kind": "tension", "load": "tie"} | accepted
        /outputs/0 | {"kind": "tension", "load": "wind"} | outputs[0].load: expected a reeving or a spring_damper, or a table_spring or a force_law between markers, found "wind"
        /inputs/5 | {"kind": "control", "load": "tie"} | inputs[5].load: expected a force_law of this scene
        /loads/4/length | [1, 2] | loads[4].length: expected a number
        /motions/0 | {"name": "leg", "kind": "distance", "markers": ["rope.mid", "rope.mid"], "value": 1} | motions[0].markers: expected markers of two bodies
        /motions/0 | {"name": "leg", "kind": "distance", "markers": ["ground", "rope.mid"], "value": 1} | motions[0].markers: expected markers that are not at the same place
        /motions/0 | {"name": "leg", "kind": "distance", "markers": ["rope.mid", "load.eye"], "value": "t - 1"} | motions[0].value: expected a distance above 0 m, found -1
        /motions/0/value | {"table": 1} | motions[0].value.table: expected a list, found 1
        /motions/0/value | {"table": [[0, 1]], "input": 1} | motions[0].value: expected a number
        /motions/0/value | {"spline": 1} | motions[0].value.spline: expected one of the keys table, interpolation, slopes, input
        /motions/2/value | {"input": -1} | motions[2].value.input: expected zero or a positive integer, found -1
        /method | {"constraints": "partitioning"} | method.constraints: expected one of the keys integrator, work_limit, found "constraints"
        /method | {"formulation": "as_printed"} | method.formulation: expected one of the keys integrator, work_limit, found "formulation"
    "#,
    );
    let twice = scene()
        .to_string()
        .replacen("\"area\":0.0018", "\"area\":1,\"area\":2", 1);
    let error = Scene::from_json(&twice).expect_err("a key twice");
    assert!(
        error.to_string().starts_with("bodies[0].section"),
        "{error}"
    );
    assert!(
        error
            .to_string()
            .contains("expected every key once, found \"area\" twice"),
        "{error}"
    );
}

#[test]
fn values_out_of_range_are_refused() {
    check(
        scene,
        r#"
        /bodies/0/material/density | -1 | bodies[0].material.density: expected a positive number (kg/m^3), found -1
        /bodies/0/markers/mid | 1.5 | bodies[0].markers.mid: expected a number from 0 to 1
        /bodies/0/elements | 2000000000 | bodies[0].elements: expected an integer from 1 to 100000, found 2000000000
        /bodies/3 | {"name": "load", "element": "rigid", "mass": 1, "position": [1, 1], "markers": {"eye": [0, 0]}} | accepted
        /method | {"work_limit": 0} | method.work_limit: expected a positive number (evaluations times parts), found 0
        /bodies/2/mass | 0 | bodies[2].mass: expected a positive number (kg), found 0
        /bodies/2/inertia | -1 | bodies[2].inertia: expected zero or a positive number (kg m^2)
        /bodies/3/markers/eye | [0, 1] | bodies[3].markers.eye: expected [0, 0] in a body without inertia
        /bodies/2/inertia | [1, 1, 1] | bodies[2].inertia: expected a number in the plane, found [1.0, 1.0, 1.0]
        /bodies/2/inertia | [[1, 0, 0], [0, 1, 0], [0, 0, 1]] | bodies[2].inertia: expected a number in the plane
        /bodies/2/orientation | {"cardan": [0, 0, 1]} | bodies[2].orientation: expected nothing beside `angle` in the plane
        /bodies/3/motion | {"spin": 1} | bodies[3].motion.spin: expected 0 in a body without inertia
        /bodies/2/markers/2x | [0, 0] | bodies[2].markers.2x: expected a letter or _
        /initial | 3 | initial: expected a state or {"state": ..., "loads": [...]}, found 3
        /initial | "resting" | initial: expected "undeformed" or "static_equilibrium" or "steady", found "resting"
        /initial | {"state": "undeformed", "loads": [{"name": "f", "kind": "force", "marker": "rod.tip", "value": [0, 1]}]} | initial.state: expected a state that loads act on
        /bodies/2/motion | {"deformation": ["0", "s"]} | bodies[2].motion.deformation: expected none of a rigid body
        /masses/0/mass | -1 | masses[0].mass: expected zero or a positive number (kg)
        /masses/1/mass | 0 | masses[1].mass: expected a positive number (kg)
        /masses/1/inertia | 1 | masses[1].inertia: expected 0 at a marker of a rigid body
        /masses/1/marker | "rod.mid" | masses[1].marker: expected a marker without a mass so far
        /masses/1/marker | "rod.top" | masses[1].marker: expected a marker of this scene, found "rod.top"; did you mean `rod.tip`
    "#,
    );
}

#[test]
fn names_are_shared_by_bodies_joints_motions_loads_and_ports() {
    let new = ": expected a name not used yet";
    for (pointer, name) in [
        ("/bodies/1/name", "rod"),
        ("/joints/1/name", "rope"),
        ("/motions/0/name", "pin"),
        ("/loads/0/name", "drive"),
        ("/loads/1/name", "push"),
        ("/loads/1/name", "momentum"),
        ("/ports/0/name", "hoist"),
        ("/ports/1/name", "plug"),
        ("/ports/2/name", "energy"),
        ("/bodies/3/name", "ground"),
    ] {
        let told = told(scene(), pointer, json!(name));
        assert!(told.contains(new), "{pointer}: {told}");
    }
}

#[test]
fn joints_take_what_is_theirs_and_no_more() {
    check(
        scene,
        r#"
        /joints/0/direction | [1, 0] | joints[0].direction: expected nothing in the plane, found a direction
        /joints/1/direction | [1, 0] | joints[1].direction: expected nothing in the plane, found a direction
        /joints/4/direction | [1, 0] | joints[4].direction: expected a key of the kind
        /joints/2/second_direction | [0, 1] | joints[2].second_direction: expected a key of the kind
        /joints/0/stiffness | 1 | accepted
        /joints/5/stiffness | 1 | joints[5].stiffness: expected a key of the kind
        /joints/0/angle | 1 | joints[0].angle: expected a stiffness or a damping beside the angle of a revolute joint
        /joints/4/angle | 1 | joints[4].angle: expected a key of the kind
        /joints/6/point | [1, 0] | joints[6].point: expected a key of the kind
        /joints/5/length | 1 | joints[5].length: expected a key of the kind
        /joints/2/direction | null | joints[2].direction: expected a direction [x, y], found nothing
        /joints/2/direction | [0, 0] | joints[2].direction: expected a direction that is not zero
        /joints/2/markers | ["load.eye", "cart.top"] | joints[2].markers[0]: expected a marker that can rotate
        /joints/1/point | [1, 0] | joints[1].point: expected nothing between two bodies
        /joints/1/markers | ["rod.top", "crank.a"] | joints[1].markers[0]: expected a marker of this scene
        /joints/1/markers | ["rod.tip", "ground"] | joints[1].markers[1]: expected a marker of this scene
        /joints/1/markers | ["rod.tip", "rod.root"] | joints[1].markers: expected markers of two bodies, found "rod" twice
        /joints/1/markers | ["rod.tip", "load.eye"] | joints[1].markers[1]: expected a marker that can rotate
        /joints/6/markers | ["load.eye", "rope.tip"] | joints[6].markers[0]: expected a marker that can rotate
        /joints/1/stiffness | -1 | joints[1].stiffness: expected zero or a positive number (N m/rad)
        /joints/1 | {"name": "knee", "kind": "revolute", "markers": ["rod.tip", "crank.a"]} | accepted
        /joints/1 | {"name": "knee", "kind": "revolute", "markers": ["rod.tip", "crank.a"], "angle": 1} | joints[1].angle: expected a stiffness or a damping beside the angle of a revolute joint, found neither
        /joints/1/kind | "hinge" | joints[1].kind: expected `revolute` with `stiffness` or `damping`, found "hinge", its former name
        /joints/2/kind | "slider" | joints[2].kind: expected `point_on_line`, found "slider", its former name
        /loads/0/kind | "stop" | loads[0].kind: expected `joint_limit`, found "stop", its former name
        /inputs/0/kind | "distributed" | inputs[0].kind: expected `distributed_force`, found "distributed", its former name
        /bodies/0/axial | "settled" | bodies[0].axial: expected `critically_damped`, found "settled", its former name
        /initial | "as_shaped" | initial: expected `undeformed`, found "as_shaped", its former name
        /initial | {"state": "as_shaped"} | initial.state: expected `undeformed`, found "as_shaped", its former name
        /accuracy | {"for": []} | accuracy.for: expected the key `input_profiles`, found `for`, its former name
        /joints/3/markers | ["crank", "load.eye"] | joints[3].markers[0]: expected the name of a cable
        /joints/3/markers | ["rope.mid", "load.eye"] | joints[3].markers[0]: expected the name of a cable
        /joints/3/markers | ["rope", "rope.tip"] | joints[3].markers: expected markers of two bodies
        /joints/3/markers | ["rope", "ground"] | joints[3].markers[1]: expected a marker of this scene
        /joints/3/point | [0, 0] | joints[3].point: expected a key of the kind
        /joints/4/length | 0 | joints[4].length: expected a positive number (m)
        /joints/4 | {"name": "link", "kind": "distance", "markers": ["ground", "rod.tip"]} | joints[4].length: expected a length, since
        /joints/4 | {"name": "link", "kind": "distance", "markers": ["rod.tip", "crank.a"]} | joints[4].length: expected a length, since
        /joints/4 | {"name": "link", "kind": "distance", "markers": ["ground", "rod.tip"], "point": [1, 1]} | accepted
        /joints/0/kind | "ball" | joints[0].kind: expected "revolute" or
        /joints/0/kind | "spherical" | joints[0].kind: expected revolute, weld, point_on_line, prismatic, orientation, distance or point_on_cable in the plane, found spherical
        /joints/2/kind | "cylindrical" | joints[2].kind: expected revolute, weld
        /joints/2/kind | "planar" | joints[2].kind: expected revolute, weld
        /joints/0 | {"name": "cross", "kind": "universal", "markers": ["ground", "rod.root"], "direction": [1, 0], "second_direction": [0, 1]} | joints[0].kind: expected revolute, weld
        /joints/0 | {"name": "cross", "kind": "constant_velocity", "markers": ["ground", "rod.root"], "direction": [1, 0]} | joints[0].kind: expected revolute, weld
        /joints/0 | {"name": "cross", "kind": "universal", "markers": ["ground", "rod.root"], "direction": [1, 0]} | joints[0].second_direction: expected a direction [x, y, z], found nothing
    "#,
    );
}

#[test]
fn motions_drive_what_can_be_driven_once() {
    check(
        scene,
        r#"
        /motions/0/joint | "clamp" | motions[0].joint: expected a revolute joint
        /motions/0/joint | "gone" | motions[0].joint: expected a joint of this scene
        /motions/0/marker | "rod.root" | motions[0]: expected either a marker or a joint, found both
        /motions/0/joint | null | motions[0]: expected either a marker or a joint, found neither
        /motions/1/joint | "pin" | motions[1].joint: expected a joint along a line of the ground or of a rigid body, found "pin"
        /motions/1/marker | "rod.tip" | motions[1].marker: expected a key of the kind
        /motions/2/marker | null | motions[2].marker: expected a name, found nothing
        /motions/2/joint | "pin" | motions[2].joint: expected a key of the kind
        /motions/3/marker | "load.eye" | motions[3].marker: expected a marker that can rotate
        /motions/2/value | {"input": 3} | motions[2].value.input: expected 0, 1 or 2, found 3
        /motions/2/value | 1 | motions[2].value: expected 2 values [x, y] or
        /motions/0/value | [1, 2] | motions[0].value: expected one value, found 2
        /motions/0/value | "sin(x)" | motions[0].value: expected one of the names t,
        /motions/4/value | ["t", "2 t"] | motions[4].value[1]: expected an operator, found "t"
        /motions/1/value | {"table": [[1, 0], [0, 2]]} | motions[1].value.table: expected increasing times
        /motions/1/value | {"table": [[0, 0], [1, 2]], "interpolation": "linear"} | accepted
        /motions/1/value | {"table": [[0, 0], [1, 2]], "slopes": [0, 2]} | accepted
        /motions/1/value | {"table": [[0, 0], [1, 2]], "interpolation": "linear", "slopes": [0, 2]} | motions[1].value.table: expected slopes of a spline only
        /motions/1/value | {"table": [[0, 0], [1, 2]], "interpolation": "cubic"} | motions[1].value.interpolation: expected "linear" or "spline", found "cubic"
        /motions/1/value | {"table": []} | motions[1].value.table: expected at least one point
        /motions/4/marker | "rope.tip" | motions[4]: expected a motion of what is not driven yet, found "rope.tip"
    "#,
    );
}

#[test]
fn loads_take_what_is_theirs_and_no_more() {
    check(
        scene,
        r#"
        /loads/0/marker | null | loads[0].marker: expected a name, found nothing
        /loads/0/value | null | loads[0].value: expected a value, found nothing
        /loads/0/value | 1 | loads[0].value: expected 2 values [x, y], found 1
        /loads/0/marker | "load.eye" | loads[0].marker: expected a marker that can rotate
        /loads/0/joint | "pin" | loads[0].joint: expected a key of the kind
        /loads/1/follower | true | loads[1].follower: expected nothing for a moment in the plane, found true
        /loads/2/follower | true | loads[2].follower: expected a key of the kind
        /loads/1/marker | "load.eye" | loads[1].marker: expected a marker that can rotate
        /loads/1/value | [1, 2] | loads[1].value: expected one value, found 2
        /loads/1/value | "1 +" | loads[1].value: expected a number, t, a function
        /loads/2/joint | "rail" | loads[2].joint: expected a revolute joint
        /loads/2/stiffness | 1 | loads[2].stiffness: expected a key of the kind
        /loads/2/stiffness | null | accepted
        /loads/2/moment | 1 | loads[2].moment: expected a key of the kind torque (joint, value), found
        /loads/2/kind | "torqe" | loads[2].kind: expected "force" or "moment" or "torque" or
        /loads/2/kind | null | loads[2].kind: expected "force" or
        /loads/2 | [] | loads[2]: expected an object { ... }, found a list
        /loads/2 | {"name": "motor"} | loads[2].kind: expected a value, found nothing
        /loads/3/body | "crank" | loads[3].body: expected the name of a cable of this scene
        /loads/4/value | 1 | loads[4].value: expected a key of the kind
        /loads/4/markers | null | loads[4].markers: expected two names, found nothing
        /loads/4/markers | ["rope.mid", "rope.tip"] | loads[4].markers: expected markers of two bodies
        /loads/4/point | [1, 1] | loads[4].point: expected nothing between two bodies
        /loads/4/length | -1 | loads[4].length: expected zero or a positive number (m)
        /loads/4/length | "y" | loads[4].length: expected one of the names
        /loads/4/damping | -1 | loads[4].damping: expected zero or a positive number (N s/m)
        /loads/5/stiffness | null | loads[5]: expected a stiffness or a damping, found neither
    "#,
    );
}

#[test]
fn inputs_and_outputs_refer_to_what_has_them() {
    check(
        scene,
        r#"
        /inputs/0/follower | true | inputs[1]: expected an input not declared before, found "rod.tip"
        /inputs/2/follower | true | inputs[2].follower: expected nothing for a moment in the plane
        /inputs/0/joint | "pin" | inputs[0].joint: expected a key of the kind
        /inputs/0/start | [1] | inputs[0].start: expected 2 component(s), found 1
        /inputs/2/marker | "load.eye" | inputs[2].marker: expected a marker that can rotate
        /inputs/3/joint | "link" | inputs[3].joint: expected a revolute joint
        /inputs/4/body | "load" | inputs[4].body: expected the name of a cable
        /inputs/5/loads | "tie" | inputs[5].loads: expected one of the keys kind, load, start, found "loads"; did you mean `load`
        /inputs/5/load | null | inputs[5].load: expected a name, found nothing
        /inputs/5/load | "wind" | inputs[5].load: expected a spring_damper or a reeving of this scene
        /inputs/5/start | [-1] | inputs[5].start[0]: expected zero or a positive number (m)
        /loads/5/length | "1+t" | inputs[5].load: expected a load whose length is a number
        /outputs/0 | {"kind": "position"} | outputs[0].marker: expected a name, found nothing
        /outputs/0 | {"kind": "strain", "marker": "crank.a"} | outputs[0].marker: expected a marker of a cable
        /outputs/0 | {"kind": "angle", "marker": "load.eye"} | outputs[0].marker: expected a marker that can rotate
        /outputs/0 | {"kind": "direction", "marker": "load.eye"} | outputs[0].marker: expected a marker that can rotate
        /outputs/0 | {"kind": "angular_velocity", "marker": "crank.a", "axes": "body"} | outputs[0].axes: expected nothing in the plane, found axes of a body
        /outputs/0 | {"kind": "torque", "marker": "rod.tip"} | outputs[0].marker: expected a marker of a rod or beam in space: nothing is twisted in the plane
        /outputs/0 | {"kind": "direction", "joint": "knee"} | outputs[0].joint: expected a key of the kind direction
        /outputs/0 | {"kind": "direction", "marker": "crank.a"} | accepted
        /outputs/0 | {"kind": "orientation", "marker": "crank.a"} | outputs[0].marker: expected nothing in the plane, where "angle" says how a body stands
        /outputs/0 | {"kind": "angle", "joint": "clamp"} | outputs[0].joint: expected a revolute joint
        /outputs/0 | {"kind": "angle", "joint": "pin", "marker": "rod.tip"} | outputs[0]: expected one name of what is read, found two
        /outputs/0 | {"kind": "travel", "joint": "rail"} | outputs[0].joint: expected a joint of kind point_on_cable
        /outputs/0 | {"kind": "reaction", "joint": "guide"} | outputs[0].joint: expected a joint that transmits a force
        /outputs/0 | {"kind": "reaction_moment", "joint": "pin"} | outputs[0].joint: expected a joint that transmits a moment
        /outputs/0 | {"kind": "reaction", "motion": "drive"} | outputs[0].motion: expected a motion driven by a force
        /outputs/0 | {"kind": "reaction_moment", "motion": "feed"} | outputs[0].motion: expected a motion driven by a moment
        /outputs/0 | {"kind": "reaction", "motion": "pin"} | outputs[0].motion: expected a motion of this scene
        /outputs/0 | {"kind": "momentum", "body": "rod"} | outputs[0].body: expected a key of the kind
        /outputs/0 | {"kind": "natural_frequency", "count": 1, "body": "rod"} | outputs[0].body: expected nothing in a scene of several bodies
        /outputs/0 | {"kind": "natural_frequency"} | outputs[0].count: expected an integer from 1 to 100, found nothing
        /outputs/0 | {"kind": "eigenvalue", "count": 0} | outputs[0].count: expected an integer from 1 to 100, found 0
        /outputs/0 | {"kind": "eigenvalue", "count": 1, "body": "rod"} | outputs[0].body: expected nothing in a scene of several bodies
        /outputs/0 | {"kind": "energy"} | outputs[11]: expected an output not declared before
        /outputs/0 | {"kind": "energy", "count": 1} | outputs[0].count: expected a key of the kind
    "#,
    );
}

#[test]
fn ports_take_what_is_theirs_and_no_more() {
    check(
        scene,
        r#"
        /ports/0/name | "2nd" | ports[0].name: expected a letter or _, then
        /ports/0/kind | "flow" | ports[0].kind: expected "
        /ports/0/stiff | 1 | ports[0].stiff: expected one of the keys name, marker
        /ports/0/marker | "rod.top" | ports[0].marker: expected a marker of this scene, found "rod.top"; did you mean `rod.tip`
        /ports/0/marker | "load.eye" | ports[0].marker: expected a marker that can rotate
        /ports/0 | {"name": "plug", "marker": "load.eye", "kind": "force"} | accepted
        /ports/0/stiffness | 1 | ports[0].stiffness: expected a key of the kind
        /ports/0/rotational_damping | 1 | ports[0].rotational_damping: expected a key of the kind
        /ports/1/marker | "rope.tip" | ports[1].marker: expected a marker that is not driven yet, found "rope.tip"
        /ports/1 | {"name": "socket", "marker": "crank.a", "kind": "motion"} | accepted
        /ports/1 | {"name": "socket", "marker": "rope.mid", "kind": "motion", "rotational_damping": 1} | ports[1]: expected a stiffness or a damping, found neither
        /ports/1/stiffness | 1 | ports[1]: expected a rotational stiffness or a rotational damping, found neither
        /ports/2 | {"name": "mount", "marker": "cart.top", "kind": "motion", "rotation": true} | ports[2].marker: expected a marker that is not driven yet, found "cart.top"
        /ports/2/stiffness | -1 | ports[2].stiffness: expected zero or a positive number (N/m), found -1
        /ports/2/rotational_damping | -1 | ports[2].rotational_damping: expected zero or a positive number (N m s/rad)
        /ports/2/rotation | true | accepted
    "#,
    );
}

#[test]
fn markers_are_found_on_cables_and_rigid_bodies() {
    let scene = Scene::from_json(&scene().to_string()).expect("a valid scene");
    let resolved = scene.resolved();
    let mid = resolved.marker("rod.mid").expect("a marker");
    let top = resolved.marker("cart.top").expect("a marker");
    assert!(matches!(mid.place, Place::Along(cable, 0.5) if cable.body.name == "rod"));
    assert!(matches!(top.place, Place::Point(rigid, [0.0, 0.1, _]) if rigid.body.name == "cart"));
    assert_eq!((mid.place.body_index(), top.place.body_index()), (0, 4));
    assert_eq!(mid.position, [0.5, 0.0, 0.0]);
    let (sin, cos) = 0.5_f64.sin_cos();
    assert_eq!(top.position, [-sin * 0.1, -1.0 + cos * 0.1, 0.0]);
    assert_eq!(
        (mid.direction, top.direction),
        ([1.0, 0.0, 0.0], [cos, sin, 0.0])
    );
    for name in ["ground", "rod", "rod.top", "rode.tip", "rod.mid.x"] {
        assert!(resolved.marker(name).is_none());
    }
    assert_eq!(
        scene.bodies.iter().map(Body::name).collect::<Vec<_>>(),
        ["rod", "rope", "crank", "load", "cart"]
    );
}

#[test]
fn nodes_are_where_something_acts_or_is_cut() {
    let scene = Scene::from_json(&scene().to_string()).expect("a valid scene");
    let resolved = scene.resolved();
    let cables: Vec<_> = (resolved.bodies.iter())
        .filter_map(|body| match body {
            BodyReference::Cable(cable) => Some(*cable),
            BodyReference::Rigid(_) | BodyReference::Reduced(_) | BodyReference::Plate(_) => None,
        })
        .collect();
    assert_eq!(
        resolved.loaded_coordinates(cables[0]),
        [0.0, 0.25, 0.5, 1.0]
    );
    // The joint along the rope slides; what acts are the clamp, the motion and the spring.
    assert_eq!(resolved.loaded_coordinates(cables[1]), [0.0, 0.5, 1.0]);
    assert_eq!(resolved.nodes(cables[0]).map(|nodes| nodes.len()), Ok(9));
}

#[test]
fn values_become_functions_and_inputs_have_their_starts() {
    let scene = Scene::from_json(&scene().to_string()).expect("a valid scene");
    let resolved = scene.resolved();
    let starts: Vec<_> = resolved.inputs.iter().map(|input| &input.start).collect();
    assert_eq!(starts[0][..], [1.0, 2.0]);
    assert_eq!(starts[1][..], [0.0, 0.0]);
    assert_eq!(starts[2][..], [0.0]);
    assert_eq!(starts[5][..], [1.0]);
    let table = &scene.motions[1].kind.value().components()[0];
    let smooth = table.motion_function().expect("a spline");
    let straight = table.function().expect("a table");
    assert!(matches!(smooth, Function::Spline(_)) && matches!(straight, Function::Linear(_)));
    assert_eq!((smooth.value(0.25), straight.value(0.25)), (0.3125, 0.5));
    let [Drive::Function(Function::Spline(_))] = resolved.motions[1].driven.drives[..] else {
        panic!("a spline");
    };
    assert_eq!(resolved.motions[2].values, []);
    let force = resolved.loads[0].kind.action().expect("a force");
    assert_eq!(force.given.len(), 2);
}
