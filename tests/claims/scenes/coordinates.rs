//! Coordinates of joints: read, driven between bodies, sprung, stopped, coupled by screws and gears; joints by what they let go.

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::space::{array, vector};
use super::space_bodies::Body;
use super::space_joints::{AXIS, axis, body};
use super::{extra, times};
use crate::claims::specimen::Specimen;

const FORCE: Vector3<f64> = Vector3::new(1.9, -0.8, 2.7);
const MOMENT: Vector3<f64> = Vector3::new(0.6, 1.3, -0.9);
const WAY: [(&str, &str); 3] = [
    ("displacement", "m"),
    ("velocity", "m/s"),
    ("acceleration", "m/s2"),
];
const TURN: [(&str, &str); 3] = [
    ("angle", "rad"),
    ("angular_velocity", "rad/s"),
    ("angular_acceleration", "rad/s2"),
];

pub fn all() -> Vec<Specimen> {
    vec![
        sprung(false),
        sprung(true),
        stopped(false),
        stopped(true),
        planar(),
        driven_in_the_plane(),
        driven_in_space(),
        screw(),
        screw_between(),
        gears(),
        latched(),
        sticking(),
        sticking_in_the_plane(),
        sliding(),
        laws(false),
        laws(true),
        rack(),
        let_go(),
        let_go_between(),
    ]
}

fn joined<const N: usize>(parts: [Vec<Value>; N]) -> Vec<Value> {
    parts.concat()
}

/// What is read of a coordinate, value and two derivatives.
fn read(names: [(&str, &str); 3], joint: &str) -> Vec<Value> {
    let output = |(kind, _)| json!({"kind": kind, "joint": joint});
    names.map(output).to_vec()
}

fn claimed(
    mut specimen: Specimen,
    names: [(&'static str, &'static str); 3],
    joint: &str,
    values: [f64; 3],
) -> Specimen {
    for ((kind, unit), value) in names.into_iter().zip(values) {
        specimen = specimen.claim(&format!("{joint}.{kind}"), unit, value);
    }
    specimen
}

/// What two loads exert: a force and a moment.
fn exerted(force: &str, moment: &str) -> Vec<Value> {
    vec![
        json!({"kind": "load_force", "load": force}),
        json!({"kind": "load_moment", "load": moment}),
    ]
}

/// Reads these too. A scene that does is refused, not wrong, where the coordinate of one changes.
fn read_too(scene: &mut Value, force: &str, moment: &str) {
    let outputs = scene["outputs"].as_array_mut().expect("a list");
    outputs.extend(exerted(force, moment));
}

/// A body that moves along and about an axis of no symmetry through its centre of mass, from a point 0.3 m before it.
fn on_axis(speed: f64, rate: f64) -> (Body, [f64; 3]) {
    let (mut bar, n) = (body("bar"), axis());
    bar.velocity = n * speed;
    bar.spin = n * rate;
    let point = array(bar.place - n * 0.3);
    (bar, point)
}

/// Springs and dampers along and about the axis of a cylindrical joint.
fn sprung(is_read: bool) -> Specimen {
    let ([speed, rate], n) = ([0.7, -1.2], axis());
    let (bar, point) = on_axis(speed, rate);
    let [k, c, rest] = [5.0, 0.4, 0.1];
    let [turning_k, turning_c, turning_rest] = [2.0, 0.3, -0.2];
    // Of its joint nothing is read.
    let idle = body("idle");
    let mut scene = json!({"name": "sprung", "dimension": 3, "bodies": [bar.described(Value::Null), idle.described(Value::Null)],
        "joints": [{"name": "guide", "kind": "cylindrical", "markers": ["ground", "bar.c"], "direction": AXIS, "point": point},
                   {"name": "other", "kind": "cylindrical", "markers": ["ground", "idle.c"], "direction": AXIS,
                    "point": array(idle.place)}],
        "loads": [{"name": "spring", "kind": "joint_spring", "joint": "guide", "coordinate": "displacement",
                   "stiffness": k, "damping": c, "rest": rest},
                  {"name": "as_it_starts", "kind": "joint_spring", "joint": "guide", "stiffness": 3.0},
                  {"name": "torsion", "kind": "joint_spring", "joint": "guide", "coordinate": "angle",
                   "stiffness": turning_k, "damping": turning_c, "rest": turning_rest},
                  {"name": "plain", "kind": "joint_spring", "joint": "guide", "stiffness": 2.0, "rest": 0.2},
                  {"name": "damper", "kind": "joint_spring", "joint": "guide", "coordinate": "angle", "damping": 0.2, "rest": 0.5}],
        "outputs": joined([read(WAY, "guide"), read(TURN, "guide"), vec![json!({"kind": "energy"})]])});
    let force = -k * (0.3 - rest) - c * speed - 2.0 * (0.3 - 0.2);
    let torque = turning_k * turning_rest - (turning_c + 0.2) * rate;
    let inertia = n.dot(&(bar.tensor() * n));
    if is_read {
        read_too(&mut scene, "spring", "torsion");
    }
    let mut specimen = Specimen::new(if is_read { "sprung, read" } else { "sprung" }, scene);
    specimen = claimed(specimen, WAY, "guide", [0.3, speed, force / bar.mass]);
    specimen = claimed(specimen, TURN, "guide", [0.0, rate, torque / inertia]);
    let on_bar = n * (-k * (0.3 - rest) - c * speed);
    let turning = n * (turning_k * turning_rest - turning_c * rate);
    if is_read {
        specimen = vector(specimen, "spring.force", "N", on_bar);
        specimen = vector(specimen, "torsion.moment", "N.m", turning);
    }
    let stored =
        k * (0.3 - rest) * (0.3 - rest) + 2.0 * 0.01 + turning_k * turning_rest * turning_rest;
    specimen.claim("energy.spring", "J", 0.5 * stored)
}

/// Forces by expressions and by tables along and about the axis of a cylindrical joint.
fn laws(is_read: bool) -> Specimen {
    let ([speed, rate], n) = ([0.7, -1.2], axis());
    let (bar, point) = on_axis(speed, rate);
    // Of its joint nothing is read.
    let idle = body("idle");
    let (spring, damper) = (
        json!([[-1.0, -6.0], [1.0, 8.0]]),
        json!([[-2.0, -6.0], [0.0, 0.0], [2.0, 6.0]]),
    );
    let law = |name: &str, coordinate: &str| json!({"name": name, "kind": "force_law", "joint": "guide", "coordinate": coordinate, "force": "1 + 4*x + 2*v^2"});
    let table = |name: &str, coordinate: &str| json!({"name": name, "kind": "table_spring", "joint": "guide", "coordinate": coordinate, "spring": spring, "damper": damper});
    let mut scene = json!({"name": "laws", "dimension": 3, "bodies": [bar.described(Value::Null), idle.described(Value::Null)],
        "joints": [{"name": "guide", "kind": "cylindrical", "markers": ["ground", "bar.c"], "direction": AXIS, "point": point},
                   {"name": "other", "kind": "cylindrical", "markers": ["ground", "idle.c"], "direction": AXIS,
                    "point": array(idle.place)}],
        "loads": [law("pull", "displacement"), law("twist", "angle"), table("coil", "displacement"), table("spiral", "angle"),
                  {"name": "by_default", "kind": "force_law", "joint": "guide", "force": "2 + x"}],
        "outputs": joined([read(WAY, "guide"), read(TURN, "guide")])});
    let (pull, twist) = (1.0 + 1.2 + 2.0 * speed * speed, 1.0 + 2.0 * rate * rate);
    let (coil, spiral) = (1.0 + 7.0 * 0.3 + 3.0 * speed, 1.0 + 3.0 * rate);
    let inertia = n.dot(&(bar.tensor() * n));
    if is_read {
        read_too(&mut scene, "pull", "twist");
        read_too(&mut scene, "coil", "spiral");
    }
    let mut specimen = Specimen::new(if is_read { "laws, read" } else { "laws" }, scene);
    specimen = claimed(
        specimen,
        WAY,
        "guide",
        [0.3, speed, -(pull + coil + 2.3) / bar.mass],
    );
    specimen = claimed(
        specimen,
        TURN,
        "guide",
        [0.0, rate, -(twist + spiral) / inertia],
    );
    if is_read {
        specimen = vector(specimen, "pull.force", "N", -n * pull);
        specimen = vector(specimen, "twist.moment", "N.m", -n * twist);
        specimen = vector(specimen, "coil.force", "N", -n * coil);
        specimen = vector(specimen, "spiral.moment", "N.m", -n * spiral);
    }
    specimen
}

/// Limits of both coordinates: `k d (1 + a d')`, two on each side; and one that is left too fast to push.
fn stopped(is_read: bool) -> Specimen {
    let ([speed, rate], n) = ([0.7, -1.2], axis());
    let (bar, point) = on_axis(speed, rate);
    let ([upper, k, a], [lower, turning_k, turning_a]) = ([0.2, 50.0, 0.6], [0.25, 3.0, 0.5]);
    let stop = |name: &str, keys: Value| {
        let mut stop = json!({"name": name, "kind": "joint_limit", "joint": "guide"});
        let given = keys.as_object().expect("keys").clone();
        stop.as_object_mut().expect("keys").extend(given);
        stop
    };
    // It rests between two limits.
    let idle = body("idle");
    let mut far = stop("far", json!({"lower": 0.1, "stiffness": 7.0}));
    far["joint"] = json!("other");
    let mut scene = json!({"name": "stopped", "dimension": 3, "bodies": [bar.described(Value::Null), idle.described(Value::Null)],
        "joints": [{"name": "guide", "kind": "cylindrical", "markers": ["ground", "bar.c"], "direction": AXIS, "point": point},
                   {"name": "other", "kind": "cylindrical", "markers": ["ground", "idle.c"], "direction": AXIS,
                    "point": array(idle.place - n * 0.6)}],
        "loads": [stop("above", json!({"upper": upper, "stiffness": k, "damping": a, "coordinate": "displacement"})),
                  stop("open", json!({"lower": 0.1, "stiffness": 7.0})),
                  stop("left", json!({"lower": 0.4, "stiffness": 9.0, "damping": 2.0})),
                  stop("pressed", json!({"lower": 0.45, "stiffness": 4.0})),
                  stop("about", json!({"coordinate": "angle", "lower": lower, "stiffness": turning_k, "damping": turning_a})),
                  stop("wide", json!({"coordinate": "angle", "upper": 1.0, "stiffness": turning_k})), far],
        "outputs": joined([read(WAY, "other"), read(WAY, "guide"), read(TURN, "guide"), vec![json!({"kind": "energy"})]])});
    let force = -k * (0.3 - upper) * (1.0 + a * speed) + 4.0 * 0.15;
    let torque = turning_k * lower * (1.0 - turning_a * rate);
    let inertia = n.dot(&(bar.tensor() * n));
    if is_read {
        read_too(&mut scene, "above", "about");
    }
    let mut specimen = Specimen::new(if is_read { "stopped, read" } else { "stopped" }, scene);
    specimen = claimed(specimen, WAY, "other", [0.6, 0.0, 0.0]);
    specimen = claimed(specimen, WAY, "guide", [0.3, speed, force / bar.mass]);
    specimen = claimed(specimen, TURN, "guide", [0.0, rate, torque / inertia]);
    let on_bar = n * (-k * (0.3 - upper) * (1.0 + a * speed));
    if is_read {
        specimen = vector(specimen, "above.force", "N", on_bar);
        specimen = vector(specimen, "about.moment", "N.m", n * torque);
    }
    let stored = k * 0.01 + 9.0 * 0.01 + 4.0 * 0.15 * 0.15 + turning_k * lower * lower;
    specimen.claim("energy.spring", "J", 0.5 * stored)
}

/// A block of the plane and the bar that it slides along, both at rest, the bar rotated and shifted.
fn bar_and_block(masses: [f64; 2]) -> (Value, [f64; 2]) {
    let turned: f64 = 0.4;
    let along = [turned.cos(), turned.sin()];
    let body = |name: &str, mass: f64, way: f64, angle: f64| {
        json!({"element": "rigid", "name": name, "mass": mass, "inertia": 0.3, "angle": angle,
               "position": [0.5 + way * along[0], -0.2 + way * along[1]], "markers": {"c": [0.0, 0.0]}})
    };
    let bodies = json!([
        body("bar", masses[0], 0.0, 0.1),
        body("block", masses[1], 0.4, 0.4),
        extra()
    ]);
    (bodies, along)
}

/// The direction of that line in the axes of the bar.
fn in_bar() -> [f64; 2] {
    [2.0 * 0.3_f64.cos(), 2.0 * 0.3_f64.sin()]
}

/// In the plane: springs between two free bodies, along a line of the first, and about a revolute joint.
fn planar() -> Specimen {
    let masses = [0.8, 1.3];
    let (mut bodies, along) = bar_and_block(masses);
    let rotor = json!({"element": "rigid", "name": "rotor", "mass": 0.7, "inertia": 0.2, "position": [3.1, 2.3],
                       "angle": 1.1, "markers": {"a": [0.1, 0.05]}});
    bodies.as_array_mut().expect("a list").push(rotor);
    let [k, rest] = [6.0, 0.15];
    let scene = json!({"name": "flat", "dimension": 2, "bodies": bodies,
        "joints": [{"name": "rail", "kind": "prismatic", "markers": ["bar.c", "block.c"], "direction": in_bar()},
                   {"name": "pin", "kind": "revolute", "markers": ["ground", "rotor.a"]}],
        "loads": [{"name": "spring", "kind": "joint_spring", "joint": "rail", "stiffness": k, "rest": rest},
                  {"name": "torsion", "kind": "joint_spring", "joint": "pin", "stiffness": 2.0, "rest": 0.3}],
        "outputs": joined([read(WAY, "rail"), read(TURN, "pin"), exerted("spring", "torsion")])});
    let force = -k * (0.4 - rest);
    let relative = force / masses[0] + force / masses[1];
    let specimen = Specimen::new("springs in the plane", scene)
        .vector("spring.force", "N", times(force, along))
        .claim("torsion.moment", "N.m", -2.0 * (1.1 - 0.3));
    let specimen = claimed(specimen, WAY, "rail", [0.4, 0.0, relative]);
    let inertia = 0.2 + 0.7 * (0.01 + 0.0025);
    claimed(
        specimen,
        TURN,
        "pin",
        [1.1, 0.0, -2.0 * (1.1 - 0.3) / inertia],
    )
}

/// In the plane: a block is driven along a bar that is free.
fn driven_in_the_plane() -> Specimen {
    let masses = [0.8, 1.3];
    let (bodies, along) = bar_and_block(masses);
    let scene = json!({"name": "moved", "dimension": 2, "bodies": bodies,
        "joints": [{"name": "rail", "kind": "prismatic", "markers": ["bar.c", "block.c"], "direction": in_bar()}],
        "motions": [{"name": "drive", "kind": "displacement", "joint": "rail", "value": "0.4+0.9*t^2"}],
        "outputs": joined([read(WAY, "rail"), vec![json!({"kind": "reaction", "motion": "drive"})]])});
    // Both about their centre of mass, which rests.
    let force = 1.8 * masses[0] * masses[1] / (masses[0] + masses[1]);
    let specimen = Specimen::new("driven between bodies", scene);
    let specimen = claimed(specimen, WAY, "rail", [0.4, 0.0, 1.8]);
    let specimen = specimen.vector("drive.reaction", "N", along.map(|part| part * force));
    let specimen = specimen.at(0.2);
    let done = [0.4 + 0.9 * 0.04, 0.36, 1.8];
    claimed(specimen, WAY, "rail", done)
}

/// In space: the same along an axis of no symmetry; the bodies rotate together.
fn driven_in_space() -> Specimen {
    let direction = [0.3, -0.9, 0.6];
    let [first, mut second] = ["u", "v"].map(body);
    let n = (first.axes * Vector3::from(direction)).normalize();
    second.mass = 0.6;
    second.place = first.place + n * 0.4;
    let scene = json!({"name": "moved", "dimension": 3,
        "bodies": [first.described(Value::Null), second.described(Value::Null)],
        "joints": [{"name": "rail", "kind": "cylindrical", "markers": ["u.c", "v.c"], "direction": direction}],
        "motions": [{"name": "drive", "kind": "displacement", "joint": "rail", "value": "0.4+0.9*t^2"}],
        "outputs": joined([read(WAY, "rail"), vec![json!({"kind": "reaction", "motion": "drive"})]])});
    let force = 1.8 * first.mass * second.mass / (first.mass + second.mass);
    let specimen = Specimen::new("driven between bodies in space", scene);
    let specimen = claimed(specimen, WAY, "rail", [0.4, 0.0, 1.8]);
    vector(specimen, "drive.reaction", "N", n * force)
}

/// A nut on a screw, under a force and a moment: `(m + J (2 pi / p)^2) s'' = F.n + (2 pi / p) M.n`.
fn screw() -> Specimen {
    let (pitch, speed, n) = (-0.9, 0.7, axis());
    let turns = std::f64::consts::TAU / pitch;
    let (bar, point) = on_axis(speed, speed * turns);
    let load = |kind: &str, value: Vector3<f64>| json!({"name": kind, "kind": kind, "marker": "bar.c", "value": array(value)});
    let scene = json!({"name": "screw", "dimension": 3, "bodies": [bar.described(Value::Null)],
        "joints": [{"name": "thread", "kind": "screw", "markers": ["ground", "bar.c"], "direction": AXIS, "point": point,
                    "pitch": pitch}],
        "loads": [{"name": "push", "kind": "force", "marker": "bar.c", "value": array(FORCE)}, load("moment", MOMENT)],
        "outputs": joined([read(WAY, "thread"), read(TURN, "thread"),
                    ["reaction", "reaction_moment"].map(|kind| json!({"kind": kind, "joint": "thread"})).to_vec()])});
    let inertia = n.dot(&(bar.tensor() * n));
    let second = (FORCE.dot(&n) + turns * MOMENT.dot(&n)) / (bar.mass + inertia * turns * turns);
    let mut specimen = Specimen::new("screw", scene);
    specimen = claimed(specimen, WAY, "thread", [0.3, speed, second]);
    specimen = claimed(
        specimen,
        TURN,
        "thread",
        [0.0, speed * turns, second * turns],
    );
    specimen = vector(
        specimen,
        "thread.reaction",
        "N",
        n * (second * bar.mass) - FORCE,
    );
    let needed = bar.tensor() * n * (second * turns) + bar.gyroscopic();
    vector(specimen, "thread.reaction_moment", "N.m", needed - MOMENT)
}

/// A screw between two free bodies, along a principal axis of both, a moment on one: the force `f` along it comes with the moment
/// `-k f` about it, `k` the way per angle.
fn screw_between() -> Specimen {
    let (k, moment) = (0.2, 1.3);
    let (first, mut second) = (body("u"), Body::new("v", [0.7, 0.6, 0.9]));
    (second.mass, second.axes) = (0.6, first.axes);
    let n = first.axes.column(1).into_owned();
    let scene = json!({"name": "screws", "dimension": 3,
        "bodies": [first.described(Value::Null), second.described(Value::Null)],
        "joints": [{"name": "thread", "kind": "screw", "markers": ["u.c", "v.c"], "direction": [0.0, 3.0, 0.0],
                    "pitch": k * std::f64::consts::TAU}],
        "loads": [{"name": "moment", "kind": "moment", "marker": "v.c", "value": array(n * moment)}],
        "outputs": read(WAY, "thread")});
    let by_force = 1.0 / first.mass + 1.0 / second.mass;
    let force = k * moment / 0.6 / (by_force + k * k * (1.0 / 0.8 + 1.0 / 0.6));
    let specimen = Specimen::new("screw between bodies", scene);
    claimed(specimen, WAY, "thread", [0.0, 0.0, force * by_force])
}

/// Two rotors on axes of no symmetry and a torque on the first: `(J1 + r^2 J2) a = M`.
fn gears() -> Specimen {
    let (ratio, torque, rate, n) = (-1.7, 0.9, 0.4, axis());
    let (mut first, mut second) = (body("u"), Body::new("v", [0.7, 0.6, 0.9]));
    let other = Vector3::new(0.6, 0.0, -0.8);
    second.place = Vector3::new(2.0, 0.1, 0.3);
    (first.spin, second.spin) = (n * rate, other * (ratio * rate));
    // Another pair at rest.
    let [mut third, mut fourth] = ["w", "x"].map(|name| Body::new(name, [0.4, 0.6, 0.7]));
    (third.place.y, fourth.place.y) = (3.0, 5.0);
    let bodies = [&first, &second, &third, &fourth].map(|body| body.described(Value::Null));
    let scene = json!({"name": "gears", "dimension": 3, "bodies": bodies,
        "joints": [{"name": "a", "kind": "revolute", "markers": ["ground", "u.c"], "direction": AXIS},
                   {"name": "b", "kind": "revolute", "markers": ["ground", "v.c"], "direction": array(other)},
                   {"name": "d", "kind": "revolute", "markers": ["ground", "w.c"], "direction": AXIS},
                   {"name": "e", "kind": "revolute", "markers": ["ground", "x.c"], "direction": AXIS}],
        "gears": [{"name": "pair", "joints": ["a", "b"], "ratio": ratio}, {"name": "idle", "joints": ["d", "e"], "ratio": 2.0}],
        "loads": [{"name": "motor", "kind": "torque", "joint": "a", "value": torque}],
        "outputs": joined([read(TURN, "a"), read(TURN, "b"), vec![json!({"kind": "gear_torque", "gear": "pair"})]])});
    let about = |body: &Body, n: Vector3<f64>| n.dot(&(body.tensor() * n));
    let [j1, j2] = [about(&first, n), about(&second, other)];
    let turning = torque / (j1 + ratio * ratio * j2);
    let specimen = Specimen::new("gears", scene);
    let specimen = claimed(specimen, TURN, "a", [0.0, rate, turning]);
    let specimen = claimed(specimen, TURN, "b", [0.0, ratio * rate, ratio * turning]);
    specimen.claim("pair.gear_torque", "N.m", j2 * ratio * turning)
}

/// A pinion and its rack, in the plane; the pinion rotates past full turns.
fn rack() -> Specimen {
    let (ratio, weight, rate) = (0.35, 9.0, 8.0);
    let [inertia, mass] = [0.2, 1.4];
    let scene = json!({"name": "rack", "dimension": 2, "gravity": [0.0, -weight],
        "accuracy": {"relative_tolerance": 1e-11},
        "bodies": [{"element": "rigid", "name": "pinion", "mass": 0.6, "inertia": inertia, "position": [0.0, 0.0], "angle": 0.5,
                    "motion": {"spin": rate}, "markers": {"c": [0.0, 0.0]}},
                   {"element": "rigid", "name": "rack", "mass": mass, "inertia": 0.1, "position": [0.35, 0.4],
                    "motion": {"velocity": [0.0, ratio * rate]}, "markers": {"c": [0.0, 0.0]}},
                   {"element": "rigid", "name": "wheel", "mass": 0.6, "inertia": inertia, "position": [4.0, 0.0],
                    "markers": {"c": [0.0, 0.0]}},
                   {"element": "rigid", "name": "bar", "mass": 0.9, "inertia": 0.1, "position": [5.0, 0.0],
                    "markers": {"c": [0.0, 0.0]}}, extra()],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "pinion.c"]},
                   {"name": "guide", "kind": "prismatic", "markers": ["ground", "rack.c"], "direction": [0.0, 1.0],
                    "point": [0.35, 0.1]},
                   {"name": "hub", "kind": "revolute", "markers": ["ground", "wheel.c"]},
                   {"name": "level", "kind": "prismatic", "markers": ["ground", "bar.c"], "direction": [1.0, 0.0]}],
        "gears": [{"name": "teeth", "joints": ["pin", "guide"], "ratio": ratio},
                  {"name": "idle", "joints": ["hub", "level"], "ratio": 0.2}],
        "outputs": joined([read(TURN, "pin"), read(WAY, "level"), read(WAY, "guide"), vec![json!({"kind": "gear_force", "gear": "teeth"})]])});
    let second = -mass * weight * ratio * ratio / (inertia + mass * ratio * ratio);
    let force = mass * (second + weight);
    let mut specimen = Specimen::new("rack", scene);
    specimen = claimed(specimen, WAY, "level", [0.0; 3]);
    for time in [0.0, 1.0] {
        let way = ratio * rate * time + 0.5 * second * time * time;
        let velocity = ratio * rate + second * time;
        let turned = [0.5 + way / ratio, velocity / ratio, second / ratio];
        specimen = specimen.at(time);
        let ways = [0.3 + way, velocity, second];
        for (joint, names, values) in [("pin", TURN, turned), ("guide", WAY, ways)] {
            for ((kind, unit), value) in names.into_iter().zip(values) {
                let of = format!("{joint}.{kind}");
                specimen = specimen.claim_within(&of, unit, value, 1e-8);
            }
        }
        specimen = specimen.claim_within("teeth.gear_force", "N", force, 1e-8);
    }
    specimen
}

/// Name, what is free, which translations and which rotations that is.
type Free<'a> = (&'a str, &'a [&'a str], [f64; 3], [f64; 3]);

/// Bodies at rest that may go along and rotate about named axes of the ground, pushed and rotated: of two rotations the joint holds
/// the moment across both.
fn let_go() -> Specimen {
    let off = Vector3::new(0.02, 0.05, -0.03);
    let cases: [Free<'_>; 4] = [
        ("a", &["x", "rotation_y"], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        (
            "b",
            &["y", "z", "rotation_z", "rotation_x"],
            [0.0, 1.0, 1.0],
            [1.0, 0.0, 1.0],
        ),
        ("d", &["x", "y", "z"], [1.0; 3], [0.0; 3]),
        (
            "e",
            &["rotation_x", "rotation_y", "rotation_z"],
            [0.0; 3],
            [1.0; 3],
        ),
    ];
    let (mut bodies, mut joints, mut loads, mut outputs) = (vec![], vec![], vec![], vec![]);
    let mut claims: Vec<(String, &str, Vector3<f64>)> = Vec::new();
    for (name, free, ways, turns) in cases {
        let body = body(name);
        let marker = format!("{name}.c");
        let joint = format!("of_{name}");
        bodies.push(body.described(Value::Null));
        joints.push(
            json!({"name": joint, "kind": "generic", "markers": ["ground", marker], "free": free,
                           "point": array(body.place + off)}),
        );
        for (kind, value) in [("force", FORCE), ("moment", MOMENT)] {
            loads.push(json!({"name": format!("{kind}_on_{name}"), "kind": kind, "marker": marker, "value": array(value)}));
        }
        for kind in ["position", "acceleration", "angular_acceleration"] {
            outputs.push(json!({"kind": kind, "marker": marker}));
        }
        let ways = Matrix3::from_diagonal(&ways.into());
        let place = body.place + off - ways * off;
        claims.push((format!("{marker}.position"), "m", place));
        claims.push((
            format!("{marker}.acceleration"),
            "m/s2",
            ways * FORCE / body.mass,
        ));
        // J w' = M + N with w' along what is free and N across it.
        let held: Vec<usize> = (0..3).filter(|k| turns[*k] == 0.0).collect();
        let mut system = body.tensor();
        for k in &held {
            (0..3).for_each(|i| system[(i, *k)] = if i == *k { -1.0 } else { 0.0 });
        }
        let mut turning = system.try_inverse().expect("regular") * MOMENT;
        held.iter().for_each(|k| turning[*k] = 0.0);
        claims.push((format!("{marker}.angular_acceleration"), "rad/s2", turning));
    }
    let scene = json!({"name": "let_go", "dimension": 3, "bodies": bodies, "joints": joints, "loads": loads, "outputs": outputs});
    let mut specimen = Specimen::new("let go", scene);
    for (of, unit, value) in claims {
        specimen = vector(specimen, &of, unit, value);
    }
    specimen
}

/// A torque on a rotor and a force on a slider that friction holds: it bears both.
fn sticking() -> Specimen {
    let (torque, force, n) = (0.9, 2.5, axis());
    let [first, mut second] = ["u", "v"].map(body);
    second.place = Vector3::new(2.0, 0.1, 0.3);
    let friction = |name: &str, joint: &str| json!({"name": name, "kind": "joint_friction", "joint": joint, "force": 3.0});
    let scene = json!({"name": "sticking", "dimension": 3,
        "bodies": [first.described(Value::Null), second.described(Value::Null)],
        "joints": [{"name": "a", "kind": "revolute", "markers": ["ground", "u.c"], "direction": AXIS},
                   {"name": "b", "kind": "prismatic", "markers": ["ground", "v.c"], "direction": AXIS}],
        "loads": [{"name": "motor", "kind": "torque", "joint": "a", "value": torque},
                  {"name": "push", "kind": "force", "marker": "v.c", "value": [force * n.x, force * n.y, force * n.z]},
                  friction("bearing", "a"), friction("guide", "b")],
        "outputs": [{"kind": "load_moment", "load": "bearing"}, {"kind": "load_force", "load": "guide"}]});
    let mut specimen = Specimen::new("sticking", scene);
    for k in 0..3 {
        specimen = specimen
            .claim(&format!("bearing.moment[{}]", k + 1), "N.m", -torque * n[k])
            .claim(&format!("guide.force[{}]", k + 1), "N", -force * n[k]);
    }
    specimen
}

/// The same in the plane.
fn sticking_in_the_plane() -> Specimen {
    let scene = json!({"name": "sticking_in_the_plane", "dimension": 2,
        "bodies": [{"name": "wheel", "element": "rigid", "mass": 2, "inertia": 0.5, "position": [0, 0], "markers": {"c": [0, 0]}}],
        "joints": [{"name": "axle", "kind": "revolute", "markers": ["ground", "wheel.c"]}],
        "loads": [{"name": "motor", "kind": "torque", "joint": "axle", "value": 0.7},
                  {"name": "brake", "kind": "joint_friction", "joint": "axle", "force": 1.0}],
        "outputs": [{"kind": "load_moment", "load": "brake"}]});
    Specimen::new("sticking_in_the_plane", scene).claim("brake.moment", "N.m", -0.7)
}

/// A rotor and a slider under friction that falls with the speed (Stribeck).
fn sliding() -> Specimen {
    let (force, ratio, fall) = (3.0, 1.4, 0.8);
    let friction = |name: &str, joint: &str| json!({"name": name, "kind": "joint_friction", "joint": joint, "force": force, "static_ratio": ratio, "stribeck_speed": fall});
    let scene = json!({"name": "sliding", "dimension": 2,
        "bodies": [{"name": "wheel", "element": "rigid", "mass": 2, "inertia": 0.5, "position": [0, 0], "motion": {"spin": 0.5},
                    "markers": {"c": [0, 0]}},
                   {"name": "block", "element": "rigid", "mass": 2, "inertia": 0.5, "position": [1, 0], "motion": {"velocity": [-0.7, 0]},
                    "markers": {"c": [0, 0]}}],
        "joints": [{"name": "axle", "kind": "revolute", "markers": ["ground", "wheel.c"]},
                   {"name": "guide", "kind": "prismatic", "markers": ["ground", "block.c"], "direction": [1, 0]}],
        "loads": [friction("bearing", "axle"), friction("shoe", "guide")],
        "outputs": [{"kind": "angular_acceleration", "marker": "wheel.c"}, {"kind": "acceleration", "marker": "block.c"}]});
    let at = |speed: f64| force * (1.0 + (ratio - 1.0) * (-(speed / fall).powi(2)).exp());
    Specimen::new("sliding", scene)
        .claim("wheel.c.angular_acceleration", "rad/s2", -at(0.5) / 0.5)
        .claim("block.c.acceleration[1]", "m/s2", at(0.7) / 2.0)
}

/// A torque on two rotors, one of which a latch holds: the latch bears the torque of the one, the other is accelerated.
fn latched() -> Specimen {
    let (torque, n) = (0.9, axis());
    let [first, mut second] = ["u", "v"].map(body);
    second.place = Vector3::new(2.0, 0.1, 0.3);
    let load = |joint: &str| json!({"name": format!("motor_{joint}"), "kind": "torque", "joint": joint, "value": torque});
    let outputs = |latch: &str| {
        ["latch_state", "latch_torque"]
            .map(|kind| json!({"kind": kind, "latch": latch}))
            .to_vec()
    };
    let scene = json!({"name": "latched", "dimension": 3,
        "bodies": [first.described(Value::Null), second.described(Value::Null)],
        "joints": [{"name": "a", "kind": "revolute", "markers": ["ground", "u.c"], "direction": AXIS},
                   {"name": "b", "kind": "revolute", "markers": ["ground", "v.c"], "direction": AXIS}],
        "latches": [{"name": "shut", "joint": "a", "closed": true}, {"name": "open", "joint": "b", "at": 1.0}],
        "loads": [load("a"), load("b")],
        "outputs": joined([read(TURN, "a"), read(TURN, "b"), outputs("shut"), outputs("open")])});
    let about = n.dot(&(second.tensor() * n));
    let specimen = Specimen::new("latched", scene)
        .claim("shut.latch_state", "", 1.0)
        .claim("shut.latch_torque", "N.m", -torque)
        .claim("open.latch_state", "", 0.0)
        .claim("open.latch_torque", "N.m", 0.0);
    let specimen = claimed(specimen, TURN, "a", [0.0; 3]);
    claimed(specimen, TURN, "b", [0.0, 0.0, torque / about])
}

/// Two bodies at rest whose centres of mass are at one place: along what is let go a force moves the second alone, across it both.
fn let_go_between() -> Specimen {
    let [first, mut second] = ["f", "g"].map(body);
    second.mass = 0.6;
    let n = first.axes.column(0).into_owned();
    let acceleration = |marker: &str| json!({"kind": "acceleration", "marker": marker});
    let scene = json!({"name": "between", "dimension": 3,
        "bodies": [first.described(Value::Null), second.described(Value::Null)],
        "joints": [{"name": "between", "kind": "generic", "markers": ["f.c", "g.c"], "free": ["x"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "g.c", "value": array(FORCE)}],
        "outputs": [acceleration("f.c"), acceleration("g.c")]});
    let along = n * n.dot(&FORCE);
    let together = (FORCE - along) / (first.mass + second.mass);
    let specimen = Specimen::new("let go between", scene);
    let specimen = vector(specimen, "f.c.acceleration", "m/s2", together);
    let apart = together + along / second.mass;
    vector(specimen, "g.c.acceleration", "m/s2", apart)
}
