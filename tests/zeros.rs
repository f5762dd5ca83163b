//! The table of zeros and signs in the book (`docs/book/src/theory/signs.md`): a test for each of its rows.

use flexbody::scene::Scene;
use flexbody::simulation::Simulation;
use serde_json::{Value, json};

/// Angle at which bodies are drawn, rad; rate of their rotation, rad/s; time over which signs are looked at, s.
const DRAWN: f64 = 0.3;
const RATE: f64 = 0.8;
const LATER: f64 = 1e-3;

/// A scene without gravity.
fn scene(dimension: u32, bodies: &Value, parts: &Value) -> Value {
    let mut scene = json!({"name": "zeros", "dimension": dimension, "bodies": bodies, "outputs": [],
        "accuracy": {"relative_tolerance": 1e-9}, "experiment": {"stop_time": 1.0, "step": LATER}});
    for (key, value) in parts.as_object().expect("parts") {
        scene[key] = value.clone();
    }
    scene
}

/// A body of 1 m that is drawn at an angle about z and rotates; its marker `a` stands at the origin, `b` at its other end.
fn arm(dimension: u32, name: &str, angle: f64, rate: f64) -> Value {
    let half = [0.5 * angle.cos(), 0.5 * angle.sin(), 0.0];
    let mut body = json!({"name": name, "element": "rigid", "mass": 2.0});
    let vector = |v: [f64; 3]| v[..dimension as usize].to_vec();
    body["position"] = json!(vector(half));
    body["markers"] = json!({"a": vector([-0.5, 0.0, 0.0]), "b": vector([0.5, 0.0, 0.0])});
    let velocity = vector([-half[1] * rate, half[0] * rate, 0.0]);
    if dimension == 2 {
        body["inertia"] = json!(0.5);
        body["angle"] = json!(angle);
        body["motion"] = json!({"velocity": velocity, "spin": rate});
    } else {
        body["inertia"] = json!([0.5, 0.6, 0.7]);
        body["orientation"] = json!({"cardan": [0.0, 0.0, angle]});
        body["motion"] = json!({"velocity": velocity, "spin": [0.0, 0.0, rate]});
    }
    body
}

/// A revolute joint about z.
fn pivot(dimension: u32, name: &str, markers: [&str; 2]) -> Value {
    let mut joint = json!({"name": name, "kind": "revolute", "markers": markers});
    if dimension == 3 {
        joint["direction"] = json!([0, 0, 1]);
    }
    joint
}

/// The values of variables at the start and a moment later.
fn values<const N: usize>(scene: &Value, names: [&str; N]) -> [[f64; N]; 2] {
    let read = Scene::from_json(&scene.to_string()).unwrap_or_else(|error| panic!("{error}"));
    let mut simulation = Simulation::new(read);
    simulation
        .initialize(0.0)
        .unwrap_or_else(|error| panic!("{error}"));
    let get = |simulation: &mut Simulation| {
        names.map(|name| {
            let place = simulation.variables().iter().position(|v| v.name == name);
            simulation.real(place.expect(name)).expect("a number")
        })
    };
    let first = get(&mut simulation);
    simulation.start().expect("a start");
    simulation.step(LATER).expect("a step");
    [first, get(&mut simulation)]
}

fn assert_near(found: f64, right: f64, what: &str) {
    assert!((found - right).abs() < 1e-6, "{what}: {found} for {right}");
}

#[test]
fn places_and_angles_of_markers_are_absolute() {
    let of = |kind: &str| json!({"kind": kind, "marker": "arm.b"});
    for dimension in [2, 3] {
        let parts = json!({"joints": [pivot(dimension, "pin", ["ground", "arm.a"])], "outputs": [of("position")]});
        let scene = scene(
            dimension,
            &json!([arm(dimension, "arm", DRAWN, RATE)]),
            &parts,
        );
        let [[x, y], later] = values(&scene, ["arm.b.position[1]", "arm.b.position[2]"]);
        assert_near(x, DRAWN.cos(), "x");
        assert_near(y, DRAWN.sin(), "y");
        assert!(later[1] > y, "counter-clockwise");
    }
    let mut plane = scene(
        2,
        &json!([arm(2, "arm", DRAWN, RATE)]),
        &json!({"outputs": [of("angle")]}),
    );
    let [[angle], [later]] = values(&plane, ["arm.b.angle"]);
    assert_near(angle, DRAWN, "angle of a marker");
    assert_near(later, DRAWN + RATE * LATER, "angle of a marker, later");
    // A motion of a marker prescribes that angle.
    plane["motions"] = json!([{"name": "drive", "kind": "angle", "marker": "arm.b", "value": format!("{DRAWN} + t")}]);
    let [[driven], _] = values(&plane, ["arm.b.angle"]);
    assert_near(driven, DRAWN, "driven angle of a marker");
    let space = scene(
        3,
        &json!([arm(3, "arm", DRAWN, RATE)]),
        &json!({"outputs": [of("rotation_vector")]}),
    );
    let [[vector], [later]] = values(&space, ["arm.b.rotation_vector[3]"]);
    assert_near(vector, DRAWN, "orientation");
    assert_near(later, DRAWN + RATE * LATER, "orientation, later");
}

/// Two bodies on axles: their joint's angle is the difference of directions in the plane, and 0 in space.
#[test]
fn angles_of_joints_are_absolute_in_the_plane_and_from_the_description_in_space() {
    for dimension in [2, 3] {
        let bodies = json!([
            arm(dimension, "first", 0.1, 0.0),
            arm(dimension, "second", DRAWN, RATE)
        ]);
        let parts = json!({"joints": [pivot(dimension, "ground_pin", ["ground", "second.a"]),
                pivot(dimension, "between", ["first.a", "second.a"])],
            "outputs": [{"kind": "angle", "joint": "ground_pin"}, {"kind": "angle", "joint": "between"}]});
        let scene = scene(dimension, &bodies, &parts);
        let [[ground, between], later] = values(&scene, ["ground_pin.angle", "between.angle"]);
        let (right, difference) = if dimension == 2 {
            (DRAWN, DRAWN - 0.1)
        } else {
            (0.0, 0.0)
        };
        assert_near(ground, right, "angle from the ground");
        assert_near(between, difference, "angle between bodies");
        assert_near(
            later[0],
            right + RATE * LATER,
            "the second marker rotates counter-clockwise",
        );
        assert!(
            later[1] > difference,
            "of the second less that of the first"
        );
    }
}

/// An arm in space that a link moves by 0.1 rad before the start has that angle then.
#[test]
fn bodies_that_are_moved_until_joints_close_count_from_their_description() {
    let (tip, anchor) = ([0.1_f64.cos(), 0.1_f64.sin()], [1.0, 1.0]);
    let length = (tip[0] - anchor[0]).hypot(tip[1] - anchor[1]);
    let parts = json!({"joints": [pivot(3, "pin", ["ground", "arm.a"]),
            {"name": "link", "kind": "distance", "markers": ["ground", "arm.b"], "point": [anchor[0], anchor[1], 0.0], "length": length}],
        "outputs": [{"kind": "angle", "joint": "pin"}]});
    let [[angle], _] = values(
        &scene(3, &json!([arm(3, "arm", 0.0, 0.0)]), &parts),
        ["pin.angle"],
    );
    assert_near(angle, 0.1, "angle after placement");
}

/// Masses on a rail along (1, 1): displacements are distances along it.
#[test]
fn displacements_of_joints_are_distances_along_the_direction() {
    for dimension in [2_usize, 3] {
        let vector = |v: [f64; 3]| v[..dimension].to_vec();
        let at = |name: &str, far: f64, speed: f64| {
            let root = std::f64::consts::FRAC_1_SQRT_2;
            json!({"name": name, "element": "rigid", "mass": 1.0, "position": vector([far * root, far * root, 0.0]),
                "markers": {"c": vector([0.0; 3])}, "motion": {"velocity": vector([speed * root, speed * root, 0.0])}})
        };
        let direction = vector([1.0, 1.0, 0.0]);
        let rail = |name: &str, markers: [&str; 2]| json!({"name": name, "kind": "point_on_line", "markers": markers, "direction": direction});
        let mut with_point = rail("with_point", ["ground", "near.c"]);
        with_point["point"] = json!(vector([0.0; 3]));
        let frame = json!({"name": "frame", "element": "rigid", "mass": 1.0, "position": vector([0.0; 3]),
            "inertia": if dimension == 2 { json!(1.0) } else { json!([1.0, 1.0, 1.0]) }, "markers": {"c": vector([0.0; 3])}});
        let read = |joint: &str| json!({"kind": "displacement", "joint": joint});
        let parts = json!({"joints": [with_point, rail("without", ["ground", "far.c"]), rail("between", ["frame.c", "on.c"])],
            "outputs": [read("with_point"), read("without"), read("between")]});
        let bodies = json!([
            at("near", 2.0, RATE),
            at("far", 3.0, RATE),
            at("on", 4.0, RATE),
            frame
        ]);
        let names = [
            "with_point.displacement",
            "without.displacement",
            "between.displacement",
        ];
        let [start, later] = values(&scene(dimension as u32, &bodies, &parts), names);
        for (index, right) in [2.0, 0.0, 4.0].into_iter().enumerate() {
            assert_near(start[index], right, names[index]);
            assert!(later[index] > start[index], "along the direction");
        }
    }
}

/// Two arms with different angles at the start keep `second - ratio first`; a nut keeps `displacement - pitch angle / 2 pi`.
#[test]
fn gears_and_screws_relate_changes() {
    for dimension in [2, 3] {
        let bodies = json!([
            arm(dimension, "first", DRAWN, RATE),
            arm(dimension, "second", -0.2, -0.5 * RATE)
        ]);
        let parts = json!({"joints": [pivot(dimension, "one", ["ground", "first.a"]), pivot(dimension, "two", ["ground", "second.a"])],
            "gears": [{"name": "mesh", "joints": ["one", "two"], "ratio": -0.5}],
            "outputs": [{"kind": "angle", "joint": "one"}, {"kind": "angle", "joint": "two"}]});
        let [start, later] = values(
            &scene(dimension, &bodies, &parts),
            ["one.angle", "two.angle"],
        );
        let right = if dimension == 2 {
            [DRAWN, -0.2]
        } else {
            [0.0; 2]
        };
        assert_near(start[0], right[0], "angle of the first joint");
        assert_near(start[1], right[1], "angle of the second joint");
        let [first, second] = [0, 1].map(|k| later[k] - start[k]);
        assert!(first > 0.0, "the first rotates");
        assert!(
            (second + 0.5 * first).abs() < 1e-9,
            "changes: {first} {second}"
        );
    }
    let mut nut = arm(3, "nut", DRAWN, RATE);
    nut["motion"] = json!({"spin": [0.0, 0.0, RATE], "velocity": [-0.5 * DRAWN.sin() * RATE, 0.5 * DRAWN.cos() * RATE, 0.02 * RATE / std::f64::consts::TAU]});
    let parts = json!({"joints": [{"name": "thread", "kind": "screw", "markers": ["ground", "nut.a"], "direction": [0, 0, 1],
            "pitch": 0.02, "point": [0, 0, -1]}],
        "outputs": [{"kind": "displacement", "joint": "thread"}, {"kind": "angle", "joint": "thread"}]});
    let [start, later] = values(
        &scene(3, &json!([nut]), &parts),
        ["thread.displacement", "thread.angle"],
    );
    assert_near(start[0], 1.0, "displacement of the nut");
    assert_near(start[1], 0.0, "angle of the nut");
    let [along, about] = [0, 1].map(|k| later[k] - start[k]);
    assert!(
        about > 0.0 && (along - 0.02 * about / std::f64::consts::TAU).abs() < 1e-9,
        "{along} {about}"
    );
}

/// A motion and a joint limit take the value of a coordinate; a spring without `rest` is unloaded at the start.
#[test]
fn what_acts_on_a_coordinate_takes_its_value() {
    let k = 10.0;
    for dimension in [2, 3] {
        let drawn = if dimension == 2 { DRAWN } else { 0.0 };
        let moment = if dimension == 2 {
            "moment"
        } else {
            "moment[3]"
        };
        let parts = json!({"joints": [pivot(dimension, "pin", ["ground", "arm.a"])],
            "loads": [
                {"name": "limit", "kind": "joint_limit", "joint": "pin", "upper": drawn - 0.1, "stiffness": k, "damping": 0.0},
                {"name": "unloaded", "kind": "joint_spring", "joint": "pin", "stiffness": k},
                {"name": "loaded", "kind": "joint_spring", "joint": "pin", "stiffness": k, "rest": drawn + 0.2}],
            "outputs": [{"kind": "load_moment", "load": "limit"}, {"kind": "load_moment", "load": "unloaded"},
                {"kind": "load_moment", "load": "loaded"}]});
        let scene = scene(
            dimension,
            &json!([arm(dimension, "arm", DRAWN, 0.0)]),
            &parts,
        );
        let names = ["limit", "unloaded", "loaded"].map(|load| format!("{load}.{moment}"));
        let [[limit, unloaded, loaded], _] = values(&scene, [&names[0], &names[1], &names[2]]);
        assert_near(limit, -0.1 * k, "limit");
        assert_near(unloaded, 0.0, "spring without a rest");
        assert_near(loaded, 0.2 * k, "spring with a rest");
        let mut sprung = scene.clone();
        sprung["loads"] = json!([]);
        sprung["joints"][0]["stiffness"] = json!(k);
        sprung["joints"][0]["angle"] = json!(drawn + 0.2);
        sprung["outputs"] = json!([{"kind": "energy"}]);
        let [[energy], _] = values(&sprung, ["energy.spring"]);
        assert_near(energy, 0.02 * k, "sprung joint");
        let mut driven = scene.clone();
        driven["loads"] = json!([]);
        driven["outputs"] =
            json!([{"kind": "angle", "joint": "pin"}, {"kind": "position", "marker": "arm.b"}]);
        driven["motions"] = json!([{"name": "drive", "kind": "angle", "joint": "pin", "value": format!("{drawn} + {RATE}*t")}]);
        let [[angle, y], [later, _]] = values(&driven, ["pin.angle", "arm.b.position[2]"]);
        assert_near(angle, drawn, "driven angle");
        assert_near(y, DRAWN.sin(), "the arm starts where it is drawn");
        assert_near(later, drawn + RATE * LATER, "driven angle, later");
    }
}

/// Springs between points and bushings are unloaded as described; `length` is a distance.
#[test]
fn springs_between_points_are_unloaded_as_described() {
    for dimension in [2_usize, 3] {
        let point = &[0.0; 3][..dimension];
        let spring = |name: &str| json!({"name": name, "kind": "spring_damper", "markers": ["ground", "arm.b"], "point": point, "stiffness": 10.0});
        let mut longer = spring("longer");
        longer["length"] = json!(0.9);
        let read = |load: &str| json!({"kind": "load_force", "load": load});
        let parts =
            json!({"loads": [spring("plain"), longer], "outputs": [read("plain"), read("longer")]});
        let scene = scene(
            dimension as u32,
            &json!([arm(dimension as u32, "arm", DRAWN, 0.0)]),
            &parts,
        );
        let [[plain, longer], _] = values(&scene, ["plain.force[1]", "longer.force[1]"]);
        assert_near(plain, 0.0, "spring without a length");
        assert_near(longer, -DRAWN.cos(), "spring with a length");
    }
    let mount = json!({"name": "mount", "kind": "bushing", "markers": ["ground", "arm.a"],
        "translational_stiffness": [1e3, 1e3, 1e3], "rotational_stiffness": [1e3, 1e3, 1e3]});
    let parts = json!({"loads": [mount],
        "outputs": [{"kind": "load_force", "load": "mount"}, {"kind": "load_moment", "load": "mount"}]});
    let scene = scene(3, &json!([arm(3, "arm", DRAWN, RATE)]), &parts);
    let [start, later] = values(&scene, ["mount.force[1]", "mount.moment[3]"]);
    assert_near(start[0], 0.0, "force of a bushing");
    assert_near(start[1], 0.0, "moment of a bushing");
    assert!(later[1] < 0.0, "against a positive rotation");
}

/// A weld in the plane holds the direction of the second marker less that of the first at `angle`.
#[test]
fn angles_of_welds_are_differences_of_directions() {
    let bodies = json!([arm(2, "first", 0.1, 0.0), arm(2, "second", 0.2, 0.0)]);
    let parts = json!({"joints": [
            {"name": "pin", "kind": "weld", "markers": ["ground", "first.a"], "angle": 0.1},
            {"name": "hold", "kind": "weld", "markers": ["first.a", "second.a"], "angle": 0.25}],
        "outputs": [{"kind": "angle", "marker": "first.b"}, {"kind": "angle", "marker": "second.b"}]});
    let [[first, second], _] = values(
        &scene(2, &bodies, &parts),
        ["first.b.angle", "second.b.angle"],
    );
    assert_near(first, 0.1, "first");
    assert_near(second, 0.35, "second");
}

/// A bead on a straight wire of 2 m, in the plane and in space, counts from the first end on.
#[test]
fn travel_counts_from_the_first_end() {
    for dimension in [2_usize, 3] {
        let vector = |x: f64| [x, 0.0, 0.0][..dimension].to_vec();
        let section = json!({"area": 1e-4, "second_moment": 0.0});
        let bodies = json!([
            {"name": "wire", "element": "cable", "elements": 4, "material": {"youngs_modulus": 1e9, "density": 5000.0}, "section": section,
             "shape": {"line": {"from": vector(0.0), "to": vector(2.0)}}, "markers": {"left": 0.0, "right": 1.0}},
            {"name": "bead", "element": "rigid", "mass": 0.1, "position": vector(0.5), "markers": {"eye": vector(0.0)},
             "motion": {"velocity": vector(RATE)}}]);
        let pin = |name: &str, marker: &str| {
            let kind = if dimension == 2 {
                "revolute"
            } else {
                "spherical"
            };
            json!({"name": name, "kind": kind, "markers": ["ground", marker]})
        };
        let parts = json!({"joints": [pin("left", "wire.left"), pin("right", "wire.right"),
                {"name": "ring", "kind": "point_on_cable", "markers": ["wire", "bead.eye"]}],
            "outputs": [{"kind": "travel", "joint": "ring"}]});
        let [[travel], [later]] =
            values(&scene(dimension as u32, &bodies, &parts), ["ring.travel"]);
        assert_near(travel, 0.5, "travel");
        assert_near(later, 0.5 + RATE * LATER, "travel, later");
    }
}
