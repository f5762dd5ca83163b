//! Coordinates of joints: read, driven between bodies, sprung, stopped, coupled by screws and gears; bushings; joints by what they
//! let go.

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::extra;
use super::space::{array, vector};
use super::space_bodies::Body;
use super::space_joints::{AXIS, axis, body};
use crate::specimen::Specimen;

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
        sprung(),
        stopped(),
        planar(),
        driven_in_the_plane(),
        driven_in_space(),
        screw(),
        gears(),
        rack(),
        modes(),
        dampers(),
        let_go(),
    ]
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

/// A body that moves along and about an axis of no symmetry through its centre of mass, from a point 0.3 m before it.
fn on_axis(speed: f64, rate: f64) -> (Body, [f64; 3]) {
    let (mut bar, n) = (body("bar"), axis());
    bar.velocity = n * speed;
    bar.spin = n * rate;
    let point = array(bar.place - n * 0.3);
    (bar, point)
}

/// Springs and dampers along and about the axis of a cylindrical joint.
fn sprung() -> Specimen {
    let ([speed, rate], n) = ([0.7, -1.2], axis());
    let (bar, point) = on_axis(speed, rate);
    let [k, c, rest] = [5.0, 0.4, 0.1];
    let [turning_k, turning_c, turning_rest] = [2.0, 0.3, -0.2];
    let scene = json!({"name": "sprung", "dimension": 3, "bodies": [bar.described(Value::Null)],
        "joints": [{"name": "guide", "kind": "cylindrical", "markers": ["ground", "bar.c"], "direction": AXIS, "point": point}],
        "loads": [{"name": "spring", "kind": "joint_spring", "joint": "guide", "coordinate": "displacement",
                   "stiffness": k, "damping": c, "rest": rest},
                  {"name": "as_it_starts", "kind": "joint_spring", "joint": "guide", "stiffness": 3.0},
                  {"name": "torsion", "kind": "joint_spring", "joint": "guide", "coordinate": "angle",
                   "stiffness": turning_k, "damping": turning_c, "rest": turning_rest},
                  {"name": "damper", "kind": "joint_spring", "joint": "guide", "coordinate": "angle", "damping": 0.2}],
        "outputs": [read(WAY, "guide"), read(TURN, "guide"), vec![json!({"kind": "energy"})]].concat()});
    let force = -k * (0.3 - rest) - c * speed;
    let torque = turning_k * turning_rest - (turning_c + 0.2) * rate;
    let inertia = n.dot(&(bar.tensor() * n));
    let mut specimen = Specimen::new("sprung", scene);
    specimen = claimed(specimen, WAY, "guide", [0.3, speed, force / bar.mass]);
    specimen = claimed(specimen, TURN, "guide", [0.0, rate, torque / inertia]);
    let stored = k * (0.3 - rest) * (0.3 - rest) + turning_k * turning_rest * turning_rest;
    specimen.claim("energy.spring", "J", 0.5 * stored)
}

/// Stops of both coordinates: `k d (1 + a d')`, two on each side; and one that is left too fast to push.
fn stopped() -> Specimen {
    let ([speed, rate], n) = ([0.7, -1.2], axis());
    let (bar, point) = on_axis(speed, rate);
    let ([upper, k, a], [lower, turning_k, turning_a]) = ([0.2, 50.0, 0.6], [0.25, 3.0, 0.5]);
    let stop = |name: &str, keys: Value| {
        let mut stop = json!({"name": name, "kind": "stop", "joint": "guide"});
        let given = keys.as_object().expect("keys").clone();
        stop.as_object_mut().expect("keys").extend(given);
        stop
    };
    let scene = json!({"name": "stopped", "dimension": 3, "bodies": [bar.described(Value::Null)],
        "joints": [{"name": "guide", "kind": "cylindrical", "markers": ["ground", "bar.c"], "direction": AXIS, "point": point}],
        "loads": [stop("above", json!({"upper": upper, "stiffness": k, "damping": a, "coordinate": "displacement"})),
                  stop("open", json!({"lower": 0.1, "stiffness": 7.0})),
                  stop("left", json!({"lower": 0.4, "stiffness": 9.0, "damping": 2.0})),
                  stop("pressed", json!({"lower": 0.45, "stiffness": 4.0})),
                  stop("about", json!({"coordinate": "angle", "lower": lower, "stiffness": turning_k, "damping": turning_a})),
                  stop("wide", json!({"coordinate": "angle", "upper": 1.0, "stiffness": turning_k}))],
        "outputs": [read(WAY, "guide"), read(TURN, "guide"), vec![json!({"kind": "energy"})]].concat()});
    let force = -k * (0.3 - upper) * (1.0 + a * speed) + 4.0 * 0.15;
    let torque = turning_k * lower * (1.0 - turning_a * rate);
    let inertia = n.dot(&(bar.tensor() * n));
    let mut specimen = Specimen::new("stopped", scene);
    specimen = claimed(specimen, WAY, "guide", [0.3, speed, force / bar.mass]);
    specimen = claimed(specimen, TURN, "guide", [0.0, rate, torque / inertia]);
    let stored = k * 0.01 + 9.0 * 0.01 + 4.0 * 0.15 * 0.15 + turning_k * lower * lower;
    specimen.claim("energy.spring", "J", 0.5 * stored)
}

/// A block of the plane and the bar that it slides along, both at rest, the bar turned and shifted.
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
    let (bodies, _) = bar_and_block(masses);
    let [k, rest] = [6.0, 0.15];
    let scene = json!({"name": "flat", "dimension": 2, "bodies": bodies,
        "joints": [{"name": "rail", "kind": "prismatic", "markers": ["bar.c", "block.c"], "direction": in_bar()},
                   {"name": "pin", "kind": "revolute", "markers": ["ground", "extra.a"]}],
        "loads": [{"name": "spring", "kind": "joint_spring", "joint": "rail", "stiffness": k, "rest": rest},
                  {"name": "torsion", "kind": "joint_spring", "joint": "pin", "stiffness": 2.0, "rest": 0.3}],
        "outputs": [read(WAY, "rail"), read(TURN, "pin")].concat()});
    let force = -k * (0.4 - rest);
    let relative = force / masses[0] + force / masses[1];
    let specimen = Specimen::new("springs in the plane", scene);
    let specimen = claimed(specimen, WAY, "rail", [0.4, 0.0, relative]);
    let inertia = 0.2 + 0.7 * (0.01 + 0.0025);
    claimed(
        specimen,
        TURN,
        "pin",
        [1.1, -0.6, -2.0 * (1.1 - 0.3) / inertia],
    )
}

/// In the plane: a block is driven along a bar that is free.
fn driven_in_the_plane() -> Specimen {
    let masses = [0.8, 1.3];
    let (bodies, along) = bar_and_block(masses);
    let scene = json!({"name": "moved", "dimension": 2, "bodies": bodies,
        "joints": [{"name": "rail", "kind": "prismatic", "markers": ["bar.c", "block.c"], "direction": in_bar()}],
        "motions": [{"name": "drive", "kind": "displacement", "joint": "rail", "value": "0.4+0.9*t^2"}],
        "outputs": [read(WAY, "rail"), vec![json!({"kind": "reaction", "motion": "drive"})]].concat()});
    // Both about their centre of mass, which rests.
    let force = 1.8 * masses[0] * masses[1] / (masses[0] + masses[1]);
    let specimen = Specimen::new("driven between bodies", scene);
    let specimen = claimed(specimen, WAY, "rail", [0.4, 0.0, 1.8]);
    let specimen = specimen.vector("drive.reaction", "N", along.map(|part| part * force));
    let specimen = specimen.at(0.2);
    let done = [0.4 + 0.9 * 0.04, 0.36, 1.8];
    claimed(specimen, WAY, "rail", done)
}

/// In space: the same along an axis of no symmetry; the bodies turn together.
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
        "outputs": [read(WAY, "rail"), vec![json!({"kind": "reaction", "motion": "drive"})]].concat()});
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
        "outputs": [read(WAY, "thread"), read(TURN, "thread"),
                    ["reaction", "reaction_moment"].map(|kind| json!({"kind": kind, "joint": "thread"})).to_vec()].concat()});
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

/// Two rotors on axes of no symmetry and a torque on the first: `(J1 + r^2 J2) a = M`.
fn gears() -> Specimen {
    let (ratio, torque, rate, n) = (-1.7, 0.9, 0.4, axis());
    let (mut first, mut second) = (body("u"), Body::new("v", [0.7, 0.6, 0.9]));
    let other = Vector3::new(0.6, 0.0, -0.8);
    second.place = Vector3::new(2.0, 0.1, 0.3);
    (first.spin, second.spin) = (n * rate, other * (ratio * rate));
    let scene = json!({"name": "gears", "dimension": 3, "bodies": [first.described(Value::Null), second.described(Value::Null)],
        "joints": [{"name": "a", "kind": "revolute", "markers": ["ground", "u.c"], "direction": AXIS},
                   {"name": "b", "kind": "revolute", "markers": ["ground", "v.c"], "direction": array(other)}],
        "gears": [{"name": "pair", "joints": ["a", "b"], "ratio": ratio}],
        "loads": [{"name": "motor", "kind": "torque", "joint": "a", "value": torque}],
        "outputs": [read(TURN, "a"), read(TURN, "b"), vec![json!({"kind": "gear_torque", "gear": "pair"})]].concat()});
    let about = |body: &Body, n: Vector3<f64>| n.dot(&(body.tensor() * n));
    let [j1, j2] = [about(&first, n), about(&second, other)];
    let turning = torque / (j1 + ratio * ratio * j2);
    let specimen = Specimen::new("gears", scene);
    let specimen = claimed(specimen, TURN, "a", [0.0, rate, turning]);
    let specimen = claimed(specimen, TURN, "b", [0.0, ratio * rate, ratio * turning]);
    specimen.claim("pair.gear_torque", "N.m", j2 * ratio * turning)
}

/// A pinion and its rack, in the plane; the pinion turns past full turns.
fn rack() -> Specimen {
    let (ratio, weight, rate) = (0.35, 9.0, 8.0);
    let [inertia, mass] = [0.2, 1.4];
    let scene = json!({"name": "rack", "dimension": 2, "gravity": [0.0, -weight],
        "bodies": [{"element": "rigid", "name": "pinion", "mass": 0.6, "inertia": inertia, "position": [0.0, 0.0], "angle": 0.5,
                    "motion": {"spin": rate}, "markers": {"c": [0.0, 0.0]}},
                   {"element": "rigid", "name": "rack", "mass": mass, "inertia": 0.1, "position": [0.35, 0.4],
                    "motion": {"velocity": [0.0, ratio * rate]}, "markers": {"c": [0.0, 0.0]}}, extra()],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "pinion.c"]},
                   {"name": "guide", "kind": "prismatic", "markers": ["ground", "rack.c"], "direction": [0.0, 1.0],
                    "point": [0.35, 0.1]}],
        "gears": [{"name": "teeth", "joints": ["pin", "guide"], "ratio": ratio}],
        "outputs": [read(TURN, "pin"), read(WAY, "guide"), vec![json!({"kind": "gear_force", "gear": "teeth"})]].concat()});
    let second = -mass * weight * ratio * ratio / (inertia + mass * ratio * ratio);
    let force = mass * (second + weight);
    let mut specimen = Specimen::new("rack", scene);
    for time in [0.0, 1.0] {
        let way = ratio * rate * time + 0.5 * second * time * time;
        let velocity = ratio * rate + second * time;
        let turned = [0.5 + way / ratio, velocity / ratio, second / ratio];
        specimen = specimen.at(time);
        specimen = claimed(specimen, TURN, "pin", turned);
        specimen = claimed(specimen, WAY, "guide", [0.3 + way, velocity, second]);
        specimen = specimen.claim("teeth.gear_force", "N", force);
    }
    specimen
}

/// Small motions of a body on a bushing: `sqrt(k / m)` along the axes of the ground, and about those of a body in them.
fn modes() -> Specimen {
    let mut block = body("block");
    block.axes = Matrix3::identity();
    let (along, about) = ([3.0, 5.0, 8.0], [4.0, 20.0, 41.0]);
    let scene = json!({"name": "mounted", "dimension": 3, "bodies": [block.described(Value::Null)],
        "loads": [{"name": "mount", "kind": "bushing", "markers": ["ground", "block.c"],
                   "translational_stiffness": along, "rotational_stiffness": about}],
        "outputs": [{"kind": "natural_frequency", "count": 6}]});
    let mut frequencies: Vec<f64> = along.iter().map(|k| (k / block.mass).sqrt()).collect();
    let moments = block.inertia.diagonal();
    frequencies.extend(
        about
            .iter()
            .zip(moments.iter())
            .map(|(k, j)| (k / j).sqrt()),
    );
    frequencies.sort_by(f64::total_cmp);
    let mut specimen = Specimen::new("bushing", scene);
    for (k, value) in frequencies.into_iter().enumerate() {
        specimen = specimen.claim(&format!("natural_frequency[{}]", k + 1), "rad/s", value);
    }
    specimen
}

/// Dampers along and about the axes of a body that stands obliquely: of what another moves past it.
fn dampers() -> Specimen {
    let ([first, mut second], along, about) =
        (["u", "v"].map(body), [0.3, 0.5, 0.8], [0.4, 0.2, 0.7]);
    second.velocity = Vector3::new(0.7, -0.2, 0.5);
    second.spin = Vector3::new(0.9, 0.4, -0.7);
    let scene = json!({"name": "damped", "dimension": 3, "bodies": [first.described(Value::Null), second.described(Value::Null)],
        "loads": [{"name": "mount", "kind": "bushing", "markers": ["u.c", "v.c"],
                   "translational_damping": along, "rotational_damping": about}],
        "outputs": ["u.c", "v.c"].map(|marker| ["acceleration", "angular_acceleration"]
            .map(|kind| json!({"kind": kind, "marker": marker}))).concat()});
    let damping =
        |of: [f64; 3]| first.axes * Matrix3::from_diagonal(&of.into()) * first.axes.transpose();
    let force = -damping(along) * second.velocity;
    // Forces stand at one point: none turns the bodies.
    let moment = -damping(about) * second.spin;
    let mut specimen = Specimen::new("dampers", scene);
    for (body, sign) in [(&first, -1.0), (&second, 1.0)] {
        let name = body.name;
        let a = force * (sign / body.mass);
        specimen = vector(specimen, &format!("{name}.c.acceleration"), "m/s2", a);
        let turning = body.turning(moment * sign);
        specimen = vector(
            specimen,
            &format!("{name}.c.angular_acceleration"),
            "rad/s2",
            turning,
        );
    }
    specimen
}

/// Bodies at rest that may go along and turn about named axes of the ground, pushed and turned: of two rotations the joint holds
/// the moment across both.
fn let_go() -> Specimen {
    let off = Vector3::new(0.02, 0.05, -0.03);
    let cases: [(&str, &[&str], [f64; 3], [f64; 3]); 4] = [
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
