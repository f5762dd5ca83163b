//! Joints of rigid bodies in space: what they let go, and the force and moment that they hold the rest with.

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::space::{array, vector};
use super::space_bodies::{ARM, Body, about, rotation};
use crate::claims::specimen::Specimen;

/// Force at the centre of mass, and moment, on bodies that joints hold.
const FORCE: Vector3<f64> = Vector3::new(1.9, -0.8, 2.7);
const MOMENT: Vector3<f64> = Vector3::new(0.6, 1.3, -0.9);
const GRAVITY: Vector3<f64> = Vector3::new(0.4, -0.7, -9.1);

pub fn all() -> Vec<Specimen> {
    vec![
        pendulum(),
        driven(),
        top(),
        held_on_a_line(),
        held_fast(),
        pairs(),
        twisting(),
        cross(),
        forks(),
        shaft_in_the_ground(),
        shafts(),
        guided_by_another(),
    ]
}

pub fn body(name: &'static str) -> Body {
    Body::new(name, [0.5, 0.8, 1.0])
}

/// Inertia about the marker `p`, from which the centre of mass is `-arm` away (parallel axes).
fn about_marker(body: &Body) -> Matrix3<f64> {
    let r = body.arm();
    let square = Matrix3::identity() * r.norm_squared() - r * r.transpose();
    body.tensor() + square * body.mass
}

/// The axis that bodies rotate about, not a unit vector, and the unit vector.
pub const AXIS: [f64; 3] = [0.8, -0.4, 1.6];

pub fn axis() -> Vector3<f64> {
    Vector3::from(AXIS).normalize()
}

fn outputs(kinds: &[&str], key: &str, of: &str) -> Vec<Value> {
    kinds
        .iter()
        .map(|kind| json!({"kind": kind, key: of}))
        .collect()
}

fn joined<const N: usize>(parts: [Vec<Value>; N]) -> Vec<Value> {
    parts.concat()
}

const TURNS: [&str; 3] = ["angle", "angular_velocity", "angular_acceleration"];
const RAD: [&str; 3] = ["rad", "rad/s", "rad/s2"];

/// What a body that rotates about a fixed axis through its marker `p` needs as force there and as moment about it:
/// `m (a - g)` and `J a + w x J w - r x m g`, with the inertia about the marker and `r` to the centre of mass.
fn needed(body: &Body, turning: Vector3<f64>) -> [Vector3<f64>; 2] {
    let (r, about) = (-body.arm(), about_marker(body));
    let a = body.carried(turning, r);
    let moment =
        about * turning + body.spin.cross(&(about * body.spin)) - r.cross(&GRAVITY) * body.mass;
    [(a - GRAVITY) * body.mass, moment]
}

/// A physical pendulum about an axis of no symmetry, with a torque and a torque that the master sets.
fn pendulum() -> Specimen {
    let (mut bar, n, [known, set]) = (body("bar"), axis(), [0.7, -1.6]);
    bar.spin = n * 1.3;
    // The marker stays where it is.
    bar.velocity = bar.spin.cross(&-bar.arm());
    let scene = json!({"name": "pendulum", "dimension": 3, "gravity": array(GRAVITY),
        "bodies": [bar.described(Value::Null)],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "bar.p"], "direction": AXIS}],
        "loads": [{"name": "motor", "kind": "torque", "joint": "pin", "value": known}],
        "inputs": [{"kind": "torque", "joint": "pin", "start": [set]}],
        "outputs": outputs(&["angle", "angular_velocity", "angular_acceleration", "reaction", "reaction_moment"], "joint", "pin")});
    let torque = known + set;
    let (r, inertia) = (-bar.arm(), about_marker(&bar));
    let rate = (n.dot(&r.cross(&GRAVITY)) * bar.mass + torque) / n.dot(&(inertia * n));
    let [force, moment] = needed(&bar, n * rate);
    let mut specimen = Specimen::new("pendulum in space", scene);
    for (k, value) in [0.0, 1.3, rate].into_iter().enumerate() {
        specimen = specimen.claim(&format!("pin.{}", TURNS[k]), RAD[k], value);
    }
    specimen = vector(specimen, "pin.reaction", "N", force);
    vector(specimen, "pin.reaction_moment", "N.m", moment - n * torque)
}

/// The same pendulum, driven: the motion takes the moment about the axis, the pin what is across it.
fn driven() -> Specimen {
    let (mut bar, n) = (body("bar"), axis());
    let [angle, rate, second] = [0.4, 0.5, 1.8];
    let scene = json!({"name": "driven", "dimension": 3, "gravity": array(GRAVITY),
        "bodies": [bar.described(Value::Null)],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "bar.p"], "direction": AXIS}],
        "motions": [{"name": "drive", "kind": "angle", "joint": "pin", "value": "0.4+0.5*t+0.9*t^2"}],
        "outputs": joined([outputs(&["angle", "angular_velocity", "angular_acceleration", "reaction_moment"], "joint", "pin"),
                    outputs(&["reaction_moment"], "motion", "drive"),
                    outputs(&["position", "orientation"], "marker", "bar.c")])});
    let (turned, pin) = (rotation(n * angle), bar.place + bar.arm());
    bar.axes = turned * bar.axes;
    bar.spin = n * rate;
    let [_, moment] = needed(&bar, n * second);
    let on_axis = n * n.dot(&moment);
    let mut specimen = Specimen::new("driven turn in space", scene);
    for (k, value) in [angle, rate, second].into_iter().enumerate() {
        specimen = specimen.claim(&format!("pin.{}", TURNS[k]), RAD[k], value);
    }
    for (k, entry) in bar.axes.transpose().iter().enumerate() {
        specimen = specimen.claim(&format!("bar.c.orientation[{}]", k + 1), "", *entry);
    }
    specimen = vector(specimen, "bar.c.position", "m", pin - bar.arm());
    specimen = vector(specimen, "pin.reaction_moment", "N.m", moment - on_axis);
    vector(specimen, "drive.reaction_moment", "N.m", on_axis)
}

/// A top in its socket, which holds no moment; a body that a socket elsewhere moves there.
fn top() -> Specimen {
    let (mut top, moved) = (body("top"), body("moved"));
    top.spin = Vector3::new(0.9, 0.4, 5.0);
    top.velocity = top.spin.cross(&-top.arm());
    let point = moved.place + Vector3::new(0.02, 0.05, -0.03);
    let scene = json!({"name": "top", "dimension": 3, "gravity": array(GRAVITY),
        "bodies": [top.described(Value::Null), moved.described(Value::Null)],
        "joints": [{"name": "ball", "kind": "spherical", "markers": ["ground", "top.p"]},
                   {"name": "socket", "kind": "spherical", "markers": ["ground", "moved.c"], "point": array(point)}],
        "outputs": joined([outputs(&["reaction"], "joint", "ball"), outputs(&["angular_acceleration"], "marker", "top.c"),
                    outputs(&["position"], "marker", "moved.c"), outputs(&["position"], "marker", "moved.p")])});
    let (r, inertia) = (-top.arm(), about_marker(&top));
    let moment = r.cross(&GRAVITY) * top.mass - top.spin.cross(&(inertia * top.spin));
    let turning = inertia.try_inverse().expect("inertia") * moment;
    let [force, _] = needed(&top, turning);
    let mut specimen = Specimen::new("top", scene);
    for (of, unit, value) in [
        ("ball.reaction", "N", force),
        ("top.c.angular_acceleration", "rad/s2", turning),
        ("moved.c.position", "m", point),
        ("moved.p.position", "m", point + moved.arm()),
    ] {
        specimen = vector(specimen, of, unit, value);
    }
    specimen
}

/// Loads that push and rotate a body.
fn pushed(name: &str) -> Vec<Value> {
    let load = |(kind, value)| {
        json!({"name": format!("{kind}_on_{name}"), "kind": kind, "marker": format!("{name}.c"),
               "value": array(value)})
    };
    [("force", FORCE), ("moment", MOMENT)].map(load).to_vec()
}

/// Bodies on a line and in a plane elsewhere, which may move along and rotate about the direction or across it.
fn held_on_a_line() -> Specimen {
    let n = axis();
    let off = Vector3::new(0.02, 0.05, -0.03);
    let (along, identity) = (n * n.transpose(), Matrix3::identity());
    // What of a velocity is let go, and of a spin.
    let kinds = [
        ("cylindrical", "a", along, along),
        ("planar", "b", identity - along, along),
        ("point_on_line", "d", along, identity),
        ("prismatic", "e", along, Matrix3::zeros()),
    ];
    let mut claims: Vec<(String, &str, Vector3<f64>)> = Vec::new();
    let (mut bodies, mut joints, mut loads, mut read) = (vec![], vec![], vec![], vec![]);
    let mut turns = Vec::new();
    for (kind, name, let_go, turned) in kinds {
        let mut body = body(name);
        body.velocity = let_go * Vector3::new(0.7, -0.2, 0.5);
        body.spin = turned * Vector3::new(0.9, 0.4, -0.7);
        let point = body.place + off;
        let joint = format!("on_{name}");
        bodies.push(body.described(Value::Null));
        joints.push(
            json!({"name": joint, "kind": kind, "markers": ["ground", format!("{name}.c")],
                           "direction": AXIS, "point": array(point)}),
        );
        loads.extend(pushed(name));
        let a = let_go * FORCE / body.mass;
        let turning = if kind == "point_on_line" {
            body.turning(MOMENT)
        } else {
            // About the axis alone.
            turned * n * (n.dot(&(MOMENT - body.gyroscopic())) / n.dot(&(body.tensor() * n)))
        };
        let moment = body.tensor() * turning + body.gyroscopic() - MOMENT;
        claims.push((format!("{name}.c.position"), "m", point - let_go * off));
        claims.push((format!("{name}.c.acceleration"), "m/s2", a));
        claims.push((format!("{name}.c.angular_acceleration"), "rad/s2", turning));
        claims.push((format!("{joint}.reaction"), "N", a * body.mass - FORCE));
        read.extend(outputs(
            &["position", "acceleration", "angular_acceleration"],
            "marker",
            &format!("{name}.c"),
        ));
        read.extend(outputs(&["reaction"], "joint", &joint));
        if kind != "point_on_line" {
            claims.push((format!("{joint}.reaction_moment"), "N.m", moment));
            read.extend(outputs(&["reaction_moment"], "joint", &joint));
        }
        if kind == "cylindrical" {
            turns = vec![0.0, n.dot(&body.spin), n.dot(&turning)];
            read.extend(outputs(&TURNS, "joint", &joint));
        }
    }
    let scene = json!({"name": "guided", "dimension": 3, "bodies": bodies, "joints": joints, "loads": loads,
                       "outputs": read});
    let mut specimen = Specimen::new("guided in space", scene);
    for (k, value) in turns.into_iter().enumerate() {
        specimen = specimen.claim(&format!("on_a.{}", TURNS[k]), RAD[k], value);
    }
    for (of, unit, value) in claims {
        specimen = vector(specimen, &of, unit, value);
    }
    specimen
}

/// A weld off the centre of mass holds everything; an orientation holds moments alone.
fn held_fast() -> Specimen {
    let [a, b] = [body("a"), body("b")];
    let scene = json!({"name": "fast", "dimension": 3, "bodies": [a.described(Value::Null), b.described(Value::Null)],
        "joints": [{"name": "weld", "kind": "weld", "markers": ["ground", "a.p"]},
                   {"name": "guide", "kind": "orientation", "markers": ["ground", "b.c"]}],
        "loads": joined([pushed("a"), pushed("b")]),
        "outputs": joined([outputs(&["reaction", "reaction_moment"], "joint", "weld"),
                    outputs(&["reaction_moment"], "joint", "guide"),
                    outputs(&["acceleration", "angular_acceleration"], "marker", "b.c")])});
    let mut specimen = Specimen::new("fast in space", scene);
    for (of, unit, value) in [
        ("weld.reaction", "N", -FORCE),
        (
            "weld.reaction_moment",
            "N.m",
            -MOMENT - (-a.arm()).cross(&FORCE),
        ),
        ("guide.reaction_moment", "N.m", -MOMENT),
        ("b.c.acceleration", "m/s2", FORCE / b.mass),
        ("b.c.angular_acceleration", "rad/s2", Vector3::zeros()),
    ] {
        specimen = vector(specimen, of, unit, value);
    }
    specimen
}

/// Two bodies on one axis, which is a principal one of both, given in the frame of the first: by a torque, by a spring and
/// a damper.
fn pairs() -> Specimen {
    let (torque, stiffness, damping, rest) = (0.9, 7.0, 0.3, 0.25);
    let direction = [0.0, 2.0, 0.0];
    let spins = [0.3, 1.1];
    let (mut bodies, mut read) = (Vec::new(), Vec::new());
    for (names, joint, y) in [(["u", "v"], "pin", 0.0), (["w", "x"], "spring", 4.0)] {
        let mut first = Body::new(names[0], [0.5, 0.8, 1.0]);
        let mut second = Body::new(names[1], [0.7, 0.6, 0.9]);
        first.place.y = y;
        second.place = first.place;
        second.axes = first.axes * about(1, 0.5);
        for (body, spin) in [&mut first, &mut second].into_iter().zip(spins) {
            body.spin = second_axis(&body.axes) * spin;
            bodies.push(body.described(Value::Null));
        }
        read.extend(outputs(&TURNS, "joint", joint));
        read.extend(
            names
                .map(|name| json!({"kind": "angular_acceleration", "marker": format!("{name}.c")})),
        );
    }
    read.push(json!({"kind": "energy"}));
    let scene = json!({"name": "pairs", "dimension": 3, "bodies": bodies,
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["u.c", "v.c"], "direction": direction},
                   {"name": "spring", "kind": "revolute", "markers": ["w.c", "x.c"], "direction": direction,
                    "stiffness": stiffness, "damping": damping, "angle": rest}],
        "loads": [{"name": "motor", "kind": "torque", "joint": "pin", "value": torque}],
        "outputs": read});
    let relative = spins[1] - spins[0];
    let n = second_axis(&Body::new("u", [0.5, 0.8, 1.0]).axes);
    let mut specimen = Specimen::new("pairs in space", scene);
    for (names, joint, moment) in [
        (["u", "v"], "pin", torque),
        (["w", "x"], "spring", stiffness * rest - damping * relative),
    ] {
        let (first, second) = (-moment / 0.8, moment / 0.6);
        for (k, value) in [0.0, relative, second - first].into_iter().enumerate() {
            specimen = specimen.claim(&format!("{joint}.{}", TURNS[k]), RAD[k], value);
        }
        for (name, size) in names.into_iter().zip([first, second]) {
            specimen = vector(
                specimen,
                &format!("{name}.c.angular_acceleration"),
                "rad/s2",
                n * size,
            );
        }
    }
    specimen.claim("energy.spring", "J", 0.5 * stiffness * rest * rest)
}

/// The second axis of a frame.
fn second_axis(axes: &Matrix3<f64>) -> Vector3<f64> {
    axes.column(1).into_owned()
}

/// A body at rest on a spring about an axis of no symmetry: `w' = k a / n.J n`; what is across the axis the hinge holds.
fn twisting() -> Specimen {
    let (body, n, stiffness, rest) = (body("plate"), axis(), 12.0, -0.3);
    let point = body.place + Vector3::new(0.02, 0.05, -0.03);
    let scene = json!({"name": "twisting", "dimension": 3, "bodies": [body.described(Value::Null)],
        "joints": [{"name": "wire", "kind": "revolute", "markers": ["ground", "plate.c"], "direction": AXIS,
                    "stiffness": stiffness, "angle": rest, "point": array(point)}],
        "outputs": joined([outputs(&["angle", "angular_acceleration", "reaction_moment"], "joint", "wire"),
                           outputs(&["position"], "marker", "plate.p")])});
    let turning = stiffness * rest / n.dot(&(body.tensor() * n));
    let mut specimen = Specimen::new("twisting", scene)
        .claim("wire.angle", "rad", 0.0)
        .claim("wire.angular_acceleration", "rad/s2", turning);
    specimen = vector(
        specimen,
        "wire.reaction_moment",
        "N.m",
        body.tensor() * n * turning,
    );
    vector(specimen, "plate.p.position", "m", point + body.axes * ARM)
}

/// Adds the claims of a body at `shaft.c` that a joint holds at a point, and about a direction `n` so that `n . w'` is `rate`.
fn held_about(
    mut specimen: Specimen,
    joint: &str,
    (body, point): (&Body, Vector3<f64>),
    n: Vector3<f64>,
    rate: f64,
) -> Specimen {
    let inverse = body.tensor().try_inverse().expect("inertia");
    let free = body.turning(MOMENT);
    let held = (rate - n.dot(&free)) / n.dot(&(inverse * n));
    for (of, unit, value) in [
        (format!("{joint}.reaction"), "N", -FORCE),
        (format!("{joint}.reaction_moment"), "N.m", n * held),
        (
            "shaft.c.angular_acceleration".into(),
            "rad/s2",
            free + inverse * n * held,
        ),
        ("shaft.c.position".into(), "m", point),
    ] {
        specimen = vector(specimen, &of, unit, value);
    }
    specimen
}

/// A fork that rotates in the ground about `a`, and a body that rotates in it about its `b`: across both, `n = a x b`, the
/// joint holds a moment. From the second derivative of `a.b = 0`: `n . w' = (a.w) (b.w)`.
fn cross() -> Specimen {
    let (a, b) = (Vector3::x(), Vector3::y());
    let n = a.cross(&b);
    let mut body = body("shaft");
    body.spin = a * 0.9 + b * 0.4;
    let point = body.place + Vector3::new(0.02, 0.05, -0.03);
    let scene = json!({"name": "cross", "dimension": 3, "bodies": [body.described(Value::Null)],
        "joints": [{"name": "cross", "kind": "universal", "markers": ["ground", "shaft.c"], "point": array(point),
                    "direction": array(a), "second_direction": array(b)}],
        "loads": pushed("shaft"),
        "outputs": joined([outputs(&["reaction", "reaction_moment"], "joint", "cross"),
                    outputs(&["angular_acceleration", "position"], "marker", "shaft.c")])});
    held_about(
        Specimen::new("cross", scene),
        "cross",
        (&body, point),
        n,
        a.dot(&body.spin) * b.dot(&body.spin),
    )
}

/// Two bodies at rest between forks, whose axes are given in the frame of the first: `n . w'` is the same of both.
fn forks() -> Specimen {
    let (first, mut second) = (body("u"), Body::new("v", [0.7, 0.6, 0.9]));
    second.axes = rotation(Vector3::new(-0.2, 0.9, 0.5));
    let directions = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let scene = json!({"name": "forks", "dimension": 3,
        "bodies": [first.described(Value::Null), second.described(Value::Null)],
        "joints": [{"name": "forks", "kind": "universal", "markers": ["u.c", "v.c"],
                    "direction": directions[0], "second_direction": directions[1]}],
        "loads": [pushed("v")[1]],
        "outputs": joined([outputs(&["reaction_moment"], "joint", "forks"),
                    outputs(&["angular_acceleration"], "marker", "u.c"),
                    outputs(&["angular_acceleration"], "marker", "v.c")])});
    let [a, b] = directions.map(|of| first.axes * Vector3::from(of));
    let n = a.cross(&b);
    let [mine, other] = [&first, &second].map(|of| of.tensor().try_inverse().expect("inertia"));
    let held = -n.dot(&(other * MOMENT)) / n.dot(&((mine + other) * n));
    let mut specimen = Specimen::new("forks", scene);
    for (of, unit, value) in [
        ("forks.reaction_moment", "N.m", n * held),
        ("u.c.angular_acceleration", "rad/s2", mine * n * -held),
        (
            "v.c.angular_acceleration",
            "rad/s2",
            other * (MOMENT + n * held),
        ),
    ] {
        specimen = vector(specimen, of, unit, value);
    }
    specimen
}

/// A shaft that a homokinetic joint holds against the ground, where the axis is `a` and its own `b`. The joint holds the rotation about
/// `n = a + b`, which halves the angle between both: `n . w = 0` and, since `w` is in the plane across `n`, `n . w' = 0`.
fn shaft_in_the_ground() -> Specimen {
    let (a, b) = (Vector3::new(0.8, 0.6, 0.0), Vector3::new(0.48, 0.64, 0.6));
    let n = a + b;
    let mut body = body("shaft");
    let spin = Vector3::new(0.9, -0.7, 0.4);
    body.spin = spin - n * (n.dot(&spin) / n.norm_squared());
    let point = body.place + Vector3::new(0.02, 0.05, -0.03);
    let scene = json!({"name": "shaft", "dimension": 3, "bodies": [body.described(Value::Null)],
        "joints": [{"name": "ball", "kind": "constant_velocity", "markers": ["ground", "shaft.c"], "point": array(point),
                    "direction": array(a * 2.0), "second_direction": array(b)}],
        "loads": pushed("shaft"),
        "outputs": joined([outputs(&["reaction", "reaction_moment"], "joint", "ball"),
                    outputs(&["angular_acceleration", "position"], "marker", "shaft.c")])});
    held_about(
        Specimen::new("shaft in the ground", scene),
        "ball",
        (&body, point),
        n,
        0.0,
    )
}

/// Two shafts at rest, whose axes are given in the frame of the first, the one at an angle, the other straight on: `n . w'` is the same
/// of both.
fn shafts() -> Specimen {
    let direction = [0.6, 0.0, 0.8];
    let (mut bodies, mut joints, mut loads, mut read) = (vec![], vec![], vec![], vec![]);
    let mut claims = Vec::new();
    for (names, joint, second, place) in [
        (["u", "v"], "bent", Some([0.8, 0.36, 0.48]), 0.0),
        (["w", "x"], "straight", None, 3.0),
    ] {
        let (mut first, mut other) = (body(names[0]), Body::new(names[1], [0.7, 0.6, 0.9]));
        other.axes = rotation(Vector3::new(-0.2, 0.9, 0.5));
        (first.place.x, other.place.x) = (place, place);
        bodies.extend([&first, &other].map(|of| of.described(Value::Null)));
        let markers = names.map(|name| format!("{name}.c"));
        let mut held = json!({"name": joint, "kind": "constant_velocity", "markers": markers, "direction": direction});
        if let Some(second) = second {
            held["second_direction"] = json!(second);
        }
        joints.push(held);
        loads.push(pushed(names[1])[1].clone());
        read.extend(outputs(&["reaction_moment"], "joint", joint));
        for marker in &markers {
            read.extend(outputs(&["angular_acceleration"], "marker", marker));
        }
        let axes = [direction, second.unwrap_or(direction)];
        let [a, b] = axes.map(|of| first.axes * Vector3::from(of));
        let n = a + b;
        let [mine, its] = [&first, &other].map(|of| of.tensor().try_inverse().expect("inertia"));
        let moment = -n.dot(&(its * MOMENT)) / n.dot(&((mine + its) * n));
        claims.extend([
            (format!("{joint}.reaction_moment"), "N.m", n * moment),
            (
                format!("{}.angular_acceleration", markers[0]),
                "rad/s2",
                mine * n * -moment,
            ),
            (
                format!("{}.angular_acceleration", markers[1]),
                "rad/s2",
                its * (MOMENT + n * moment),
            ),
        ]);
    }
    let scene = json!({"name": "shafts", "dimension": 3, "bodies": bodies, "joints": joints, "loads": loads, "outputs": read});
    let mut specimen = Specimen::new("shafts", scene);
    for (of, unit, value) in claims {
        specimen = vector(specimen, &of, unit, value);
    }
    specimen
}

/// Two bodies at rest, one on a line or in a plane of the other: along what is let go a force moves the second alone,
/// across it both.
fn guided_by_another() -> Specimen {
    let direction = [0.3, -0.9, 0.6];
    let (mut bodies, mut loads, mut read) = (Vec::new(), Vec::new(), Vec::new());
    let mut claims = Vec::new();
    let mut joints = Vec::new();
    for (kind, names, x) in [
        ("cylindrical", ["a", "b"], 0.0),
        ("planar", ["d", "e"], 4.0),
    ] {
        let [mut first, mut second] = names.map(body);
        (first.place.x, second.place.x) = (x, x);
        second.mass = 0.6;
        let n = (first.axes * Vector3::from(direction)).normalize();
        let along = n * n.transpose();
        let let_go = if kind == "cylindrical" {
            along
        } else {
            Matrix3::identity() - along
        };
        let across = FORCE - let_go * FORCE;
        let joint = format!("on_{}", names[0]);
        let markers = names.map(|name| format!("{name}.c"));
        let together = across / (first.mass + second.mass);
        claims.push((format!("{}.acceleration", markers[0]), "m/s2", together));
        let apart = let_go * FORCE / second.mass;
        claims.push((
            format!("{}.acceleration", markers[1]),
            "m/s2",
            apart + together,
        ));
        claims.push((format!("{joint}.reaction"), "N", -together * first.mass));
        read.extend(
            markers
                .iter()
                .flat_map(|of| outputs(&["acceleration"], "marker", of)),
        );
        read.extend(outputs(&["reaction"], "joint", &joint));
        joints
            .push(json!({"name": joint, "kind": kind, "markers": markers, "direction": direction}));
        loads.push(pushed(names[1])[0].clone());
        bodies.extend([first.described(Value::Null), second.described(Value::Null)]);
    }
    let scene = json!({"name": "guided_by_another", "dimension": 3, "bodies": bodies, "joints": joints,
                       "loads": loads, "outputs": read});
    let mut specimen = Specimen::new("guided by another in space", scene);
    for (of, unit, value) in claims {
        specimen = vector(specimen, &of, unit, value);
    }
    specimen
}
