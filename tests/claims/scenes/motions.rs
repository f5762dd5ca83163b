//! Driven motions: constant, as expressions and as tables, or set by the master with 0, 1 and 2 derivatives.

use serde_json::{Value, json};

use super::{sum, times, turned};
use crate::claims::specimen::Specimen;

/// Time of the start, s.
const T: f64 = 0.3;
/// A smooth function of time and what it is with two derivatives.
const WAVE: &str = "0.4+0.5*t+0.9*t^2";

fn wave(t: f64) -> [f64; 3] {
    [0.4 + 0.5 * t + 0.9 * t * t, 0.5 + 1.8 * t, 1.8]
}

/// A table of two points, and the spline that is at rest at both: `y0 + (y1 - y0) (3 s^2 - 2 s^3)`.
fn table() -> Value {
    json!({"table": [[0.1, 0.2], [0.9, 1.0]]})
}

fn spline(t: f64) -> [f64; 3] {
    let (s, rate) = ((t - 0.1) / 0.8, 1.0 / 0.8);
    [
        0.2 + 0.8 * (3.0 * s * s - 2.0 * s.powi(3)),
        0.8 * rate * (6.0 * s - 6.0 * s * s),
        0.8 * rate * rate * (6.0 - 12.0 * s),
    ]
}

pub fn all() -> Vec<Specimen> {
    vec![
        angles(),
        positions(),
        displacements(),
        distances(),
        mastered(),
        described(),
        steps(),
        stretching(),
        turned_back(),
        works(),
    ]
}

fn wheel(name: &str, place: [f64; 2], angle: f64) -> Value {
    json!({"element": "rigid", "name": name, "mass": 1.6, "inertia": 0.4, "position": place, "angle": angle,
           "markers": {"c": [0.0, 0.0], "p": [0.5, -0.2]}})
}

fn outputs(kinds: &[&str], of: &str) -> Vec<Value> {
    let output = |kind: &&str| json!({"kind": kind, "marker": of});
    kinds.iter().map(output).collect()
}

const TURNS: [&str; 3] = ["angle", "angular_velocity", "angular_acceleration"];
pub(super) const MOVES: [&str; 3] = ["position", "velocity", "acceleration"];
const RAD: [&str; 3] = ["rad", "rad/s", "rad/s2"];
pub(super) const METRES: [&str; 3] = ["m", "m/s", "m/s2"];

/// Directions of markers, and of pins between two wheels at their centres of mass.
fn angles() -> Specimen {
    let values = [json!(0.45), json!(WAVE), table()];
    let (mut bodies, mut joints, mut motions) = (Vec::new(), Vec::new(), Vec::new());
    let mut read = Vec::new();
    for (n, value) in values.iter().enumerate() {
        let y = n as f64;
        bodies.push(wheel(&format!("m{n}"), [0.0, y], 0.4));
        bodies.push(wheel(&format!("u{n}"), [3.0, y], 0.1));
        bodies.push(wheel(&format!("v{n}"), [3.0, y], 0.6));
        joints.push(json!({"name": format!("axle{n}"), "kind": "revolute", "markers": ["ground", format!("m{n}.c")]}));
        joints.push(json!({"name": format!("pin{n}"), "kind": "revolute",
                           "markers": [format!("u{n}.c"), format!("v{n}.c")]}));
        motions.push(json!({"name": format!("turn{n}"), "kind": "angle", "marker": format!("m{n}.c"), "value": value}));
        motions.push(json!({"name": format!("bend{n}"), "kind": "angle", "joint": format!("pin{n}"), "value": value}));
        read.extend(outputs(&TURNS, &format!("m{n}.c")));
        read.extend(TURNS.map(|kind| json!({"kind": kind, "joint": format!("pin{n}")})));
        // One is left that nobody reads.
        for name in ["turn", "bend"]
            .into_iter()
            .take(if n == 2 { 1 } else { 2 })
        {
            read.push(json!({"kind": "reaction_moment", "motion": format!("{name}{n}")}));
        }
    }
    // A pin that nothing drives.
    bodies.extend([
        wheel("free", [5.0, 0.0], 0.1),
        wheel("other", [5.0, 0.0], 0.7),
    ]);
    joints.push(json!({"name": "loose", "kind": "revolute", "markers": ["free.c", "other.c"]}));
    let scene = json!({"name": "angles", "dimension": 2, "bodies": bodies, "joints": joints, "motions": motions,
                       "outputs": read});
    let mut specimen = Specimen::new("angles", scene).from(T);
    for (n, course) in [[0.45, 0.0, 0.0], wave(T), spline(T)]
        .into_iter()
        .enumerate()
    {
        for k in 0..3 {
            specimen = specimen
                .claim(&format!("m{n}.c.{}", TURNS[k]), RAD[k], course[k])
                .claim(&format!("pin{n}.{}", TURNS[k]), RAD[k], course[k]);
        }
        specimen = specimen.claim(&format!("turn{n}.reaction_moment"), "N.m", 0.4 * course[2]);
        if n < 2 {
            // Both wheels rotate against each other.
            let moment = 0.2 * course[2];
            specimen = specimen.claim(&format!("bend{n}.reaction_moment"), "N.m", moment);
        }
    }
    specimen
}

/// Centres of mass, driven against gravity.
fn positions() -> Specimen {
    let g = [0.6, -9.0];
    let motion = |n: usize, value: Value| json!({"name": format!("drive{n}"), "kind": "position", "marker": format!("m{n}.c"), "value": value});
    let courses = [
        (json!([0.45, -0.2]), [[0.45, -0.2], [0.0; 2], [0.0; 2]]),
        (
            json!([WAVE, "0.1-t^2"]),
            pair(wave(T), [0.1 - T * T, -2.0 * T, -2.0]),
        ),
        (
            json!([table(), {"table": [[-0.3, 0.5], [0.9, 0.5], [2.0, 0.5]]}]),
            pair(spline(T), [0.5, 0.0, 0.0]),
        ),
        (json!([0.3, table()]), pair([0.3, 0.0, 0.0], spline(T))),
    ];
    let mut read = Vec::new();
    let (mut bodies, mut motions) = (Vec::new(), Vec::new());
    for (n, (value, _)) in courses.iter().enumerate() {
        bodies.push(wheel(&format!("m{n}"), [0.4, 0.1], 0.0));
        motions.push(motion(n, value.clone()));
        read.extend(outputs(&MOVES, &format!("m{n}.c")));
        // One is left that nobody reads.
        if n < 3 {
            read.push(json!({"kind": "reaction", "motion": format!("drive{n}")}));
        }
    }
    bodies.push(super::resting());
    let scene = json!({"name": "positions", "dimension": 2, "gravity": g, "bodies": bodies, "motions": motions,
                       "outputs": read});
    let mut specimen = Specimen::new("positions", scene).from(T);
    for (n, (_, course)) in courses.into_iter().enumerate() {
        for k in 0..3 {
            specimen = specimen.vector(&format!("m{n}.c.{}", MOVES[k]), METRES[k], course[k]);
        }
        let force = times(1.6, sum(course[2], times(-1.0, g)));
        if n < 3 {
            specimen = specimen.vector(&format!("drive{n}.reaction"), "N", force);
        }
    }
    specimen
}

fn pair(x: [f64; 3], y: [f64; 3]) -> [[f64; 2]; 3] {
    [0, 1, 2].map(|k| [x[k], y[k]])
}

/// Wheels on inclined sliders, driven along them from a point on: `drive` has the keys of the motion of each, `more` adds to the scene.
fn guided(
    name: &'static str,
    (point, g): ([f64; 2], [f64; 2]),
    values: &[(Value, [f64; 3])],
    drive: impl Fn(usize) -> Value,
    more: impl FnOnce(&mut Vec<Value>, &mut Vec<Value>, &mut Vec<Value>, &mut Vec<Value>),
) -> Specimen {
    let along = [0.6, 0.8];
    let (mut bodies, mut joints, mut motions) = (Vec::new(), Vec::new(), Vec::new());
    let mut read = Vec::new();
    for (n, (value, _)) in values.iter().enumerate() {
        bodies.push(wheel(&format!("m{n}"), sum(point, times(0.4, along)), 0.0));
        joints.push(json!({"name": format!("guide{n}"), "kind": "point_on_line", "markers": ["ground", format!("m{n}.c")],
                           "point": point, "direction": [3.0, 4.0]}));
        let mut motion = drive(n);
        motion["name"] = json!(format!("drive{n}"));
        motion["value"] = value.clone();
        motions.push(motion);
        read.extend(outputs(&MOVES, &format!("m{n}.c")));
        read.push(json!({"kind": "reaction", "motion": format!("drive{n}")}));
    }
    more(&mut bodies, &mut joints, &mut motions, &mut read);
    let scene = json!({"name": name, "dimension": 2, "gravity": g, "bodies": bodies, "joints": joints, "motions": motions, "outputs": read});
    let mut specimen = Specimen::new(name, scene).from(T);
    for (n, (_, course)) in values.iter().enumerate() {
        let ways = [
            sum(point, times(course[0], along)),
            times(course[1], along),
            times(course[2], along),
        ];
        for k in 0..3 {
            specimen = specimen.vector(&format!("m{n}.c.{}", MOVES[k]), METRES[k], ways[k]);
        }
        let force = 1.6 * (course[2] - super::dot(g, along));
        specimen = specimen.vector(&format!("drive{n}.reaction"), "N", times(force, along));
    }
    specimen
}

/// Ways along inclined sliders.
fn displacements() -> Specimen {
    let values = [
        (json!(0.45), [0.45, 0.0, 0.0]),
        (json!(WAVE), wave(T)),
        (table(), spline(T)),
    ];
    let drive = |n: usize| json!({"kind": "displacement", "joint": format!("guide{n}")});
    let places = ([0.2, -0.1], [0.6, -9.0]);
    guided(
        "displacements",
        places,
        &values,
        drive,
        |bodies, joints, _, _| {
            // A slider that nothing drives.
            bodies.push(wheel("free", [6.0, 0.0], 0.0));
            joints.push(json!({"name": "loose", "kind": "point_on_line", "markers": ["ground", "free.c"], "direction": [1.0, 0.0]}));
        },
    )
}

/// Distances from the ground along inclined sliders, and between two free wheels, each of which moves half of it.
fn distances() -> Specimen {
    let point = [0.2, -0.1];
    let course = [0.5 + 0.2 * T.sin(), 0.2 * T.cos(), -0.2 * T.sin()];
    let values = [
        (json!("0.5+0.2*sin(t)"), course),
        (json!(0.45), [0.45, 0.0, 0.0]),
        (table(), spline(T)),
    ];
    let drive = |n: usize| json!({"kind": "distance", "markers": ["ground", format!("m{n}.c")], "point": point});
    let specimen = guided(
        "distances",
        (point, [0.0; 2]),
        &values,
        drive,
        |bodies, _, motions, read| {
            bodies.push(wheel("a", [4.0, 0.0], 0.0));
            bodies.push(wheel("b", [4.5, 0.0], 0.0));
            motions.push(json!({"name": "between", "kind": "distance", "markers": ["a.c", "b.c"], "value": values[0].0}));
            read.extend(outputs(&MOVES[2..], "a.c"));
            read.extend(outputs(&MOVES[2..], "b.c"));
            read.push(json!({"kind": "reaction", "motion": "between"}));
        },
    );
    let half = [0.5 * course[2], 0.0];
    specimen
        .vector("a.c.acceleration", "m/s2", times(-1.0, half))
        .vector("b.c.acceleration", "m/s2", half)
        .vector("between.reaction", "N", times(1.6, half))
}

/// Wheels whose motions the master sets, with 0, 1 and 2 derivatives: a point, a direction, the angle of a
/// pin, a way.
fn mastered_scene(name: &str) -> Value {
    let (mut bodies, mut joints, mut motions) = (Vec::new(), Vec::new(), Vec::new());
    let mut read = Vec::new();
    for n in 0..3 {
        let y = f64::from(n);
        bodies.push(wheel(&format!("p{n}"), [0.4, y], 0.0));
        bodies.push(wheel(&format!("m{n}"), [2.0, y], 0.4));
        bodies.push(wheel(&format!("u{n}"), [3.0, y], 0.1));
        bodies.push(wheel(&format!("v{n}"), [3.0, y], 0.6));
        bodies.push(wheel(&format!("s{n}"), [4.6, y + 0.8], 0.0));
        joints.push(json!({"name": format!("pin{n}"), "kind": "revolute", "markers": [format!("u{n}.c"), format!("v{n}.c")]}));
        joints.push(json!({"name": format!("guide{n}"), "kind": "point_on_line", "markers": ["ground", format!("s{n}.c")],
                           "point": [4.0, y], "direction": [0.6, 0.8]}));
        let value = json!({"input": n});
        motions.push(json!({"name": format!("place{n}"), "kind": "position", "marker": format!("p{n}.c"), "value": value}));
        motions.push(json!({"name": format!("turn{n}"), "kind": "angle", "marker": format!("m{n}.c"), "value": value}));
        motions.push(json!({"name": format!("bend{n}"), "kind": "angle", "joint": format!("pin{n}"), "value": value}));
        motions.push(json!({"name": format!("shift{n}"), "kind": "displacement", "joint": format!("guide{n}"), "value": value}));
        read.extend(outputs(&MOVES, &format!("p{n}.c")));
        read.extend(outputs(&TURNS, &format!("m{n}.c")));
        read.extend(TURNS.map(|kind| json!({"kind": kind, "joint": format!("pin{n}")})));
        read.extend(outputs(&MOVES, &format!("s{n}.c")));
        bodies.push(wheel(&format!("d{n}"), [6.2, y + 1.6], 0.0));
        joints.push(json!({"name": format!("rail{n}"), "kind": "point_on_line", "markers": ["ground", format!("d{n}.c")],
                           "point": [5.0, y], "direction": [0.6, 0.8]}));
        motions.push(json!({"name": format!("reach{n}"), "kind": "distance", "markers": ["ground", format!("d{n}.c")], "point": [5.0, y],
                            "value": value}));
        read.extend(outputs(&MOVES, &format!("d{n}.c")));
    }
    json!({"name": name, "dimension": 2, "bodies": bodies, "joints": joints, "motions": motions, "outputs": read})
}

/// What the master sets: value, rate and acceleration of each motion, as far as they are inputs.
fn set(mut specimen: Specimen, course: [f64; 3]) -> Specimen {
    for n in 0..3_usize {
        for (k, value) in course.into_iter().enumerate().take(n + 1) {
            let (moves, turns) = (MOVES[k], TURNS[k]);
            let shift = if k == 0 { "displacement" } else { moves };
            // A distance is positive.
            let (reach, least) = if k == 0 {
                ("distance", 2.0)
            } else {
                (moves, 0.0)
            };
            specimen = specimen
                .set(&format!("place{n}.{moves}[1]"), value)
                .set(&format!("place{n}.{moves}[2]"), -2.0 * value)
                .set(&format!("turn{n}.{turns}"), value)
                .set(&format!("bend{n}.{turns}"), value)
                .set(&format!("shift{n}.{shift}"), value)
                .set(&format!("reach{n}.{reach}"), least + value);
        }
    }
    specimen
}

/// Claims that all motions with `n` derivatives are where the course says, up to derivative `to`.
fn claimed(mut specimen: Specimen, n: usize, course: [f64; 3], to: usize) -> Specimen {
    let along = [0.6, 0.8];
    for (k, value) in course.into_iter().enumerate().take(to + 1) {
        let origin = if k == 0 { [4.0, n as f64] } else { [0.0; 2] };
        let foot = if k == 0 {
            [6.2, n as f64 + 1.6]
        } else {
            [0.0; 2]
        };
        specimen = specimen
            .vector(
                &format!("p{n}.c.{}", MOVES[k]),
                METRES[k],
                [value, -2.0 * value],
            )
            .claim(&format!("m{n}.c.{}", TURNS[k]), RAD[k], value)
            .claim(&format!("pin{n}.{}", TURNS[k]), RAD[k], value)
            .vector(
                &format!("s{n}.c.{}", MOVES[k]),
                METRES[k],
                sum(origin, times(value, along)),
            )
            .vector(
                &format!("d{n}.c.{}", MOVES[k]),
                METRES[k],
                sum(foot, times(value, along)),
            );
    }
    specimen
}

/// Set before the start: everything that is set holds at once.
fn mastered() -> Specimen {
    let course = [0.7, -0.3, 0.9];
    let mut specimen = set(
        Specimen::new("mastered", mastered_scene("mastered")),
        course,
    );
    for n in 0..3 {
        let known = [0, 1, 2].map(|k| if k <= n { course[k] } else { 0.0 });
        specimen = claimed(specimen, n, known, n);
    }
    specimen
}

/// Before the master sets them, motions are where their bodies are as described.
fn described() -> Specimen {
    let mut specimen = Specimen::new("described", mastered_scene("described"));
    for n in 0..3 {
        let y = f64::from(n);
        specimen = specimen
            .vector(&format!("place{n}.position"), "m", [0.4, y])
            .claim(&format!("turn{n}.angle"), "rad", 0.4)
            .claim(&format!("bend{n}.angle"), "rad", 0.5)
            .claim(&format!("shift{n}.displacement"), "m", 1.0)
            .claim(&format!("reach{n}.distance"), "m", 2.0)
            .vector(&format!("p{n}.c.position"), "m", [0.4, y])
            .claim(&format!("pin{n}.angle"), "rad", 0.5)
            .vector(&format!("s{n}.c.velocity"), "m/s", [0.0, 0.0]);
    }
    specimen
}

/// Returns value, rate and acceleration at the end of a step of length `h`, for motions with 0, 1 and 2 derivatives as
/// inputs.
pub(super) fn ends([value, rate, second]: [f64; 3], h: f64) -> [[f64; 3]; 3] {
    [
        [value, 0.0, 0.0],
        [value + h * rate, rate, 0.0],
        [
            value + h * rate + 0.5 * h * h * second,
            rate + h * second,
            second,
        ],
    ]
}

/// Set at communication points: a value alone is reached at the end of the step, with derivatives their
/// Taylor polynomial is.
fn steps() -> Specimen {
    let (first, h, second) = ([0.6, 0.2, 0.5], 0.1, [0.65, 0.4, -0.8]);
    let specimen = set(Specimen::new("steps", mastered_scene("steps")), first).at(h);
    let specimen = set(specimen, second).at(2.0 * h);
    let mut specimen = specimen;
    for (n, end) in ends(second, h).into_iter().enumerate() {
        specimen = claimed(specimen, n, end, n);
    }
    specimen
}

/// The slope at the end of a cable rotates as it is driven, also while it stretches.
fn stretching() -> Specimen {
    let scene = json!({
        "name": "stretching", "dimension": 2,
        "bodies": [{"element": "cable", "name": "rod", "elements": 2,
                    "material": {"youngs_modulus": 1e4, "density": 1000.0},
                    "section": {"area": 1e-3, "second_moment": 1e-7},
                    "shape": {"line": {"from": [0.0, 0.0], "to": [0.8, 0.0]}},
                    "motion": {"spin": 0.3, "deformation": ["0.25*s", "0"]}, "markers": {"root": 0.0}}],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "rod.root"]}],
        "motions": [{"name": "turn", "kind": "angle", "marker": "rod.root", "value": "0.3*t+0.4*t^2"}],
        "outputs": outputs(&TURNS, "rod.root")});
    Specimen::new("stretching", scene)
        .claim("rod.root.angle", "rad", 0.0)
        .claim("rod.root.angular_velocity", "rad/s", 0.3)
        .claim("rod.root.angular_acceleration", "rad/s2", 0.8)
}

/// A plate is moved by a point that goes on another way at once: the impulse there keeps its moment of momentum about that
/// point, and does the work that the plate gains.
fn turned_back() -> Specimen {
    let (mass, inertia, arm, speed, jump) = (1.6, 0.4, 0.5, [-0.8, 0.3], 0.5);
    let scene = json!({
        "name": "turned_back", "dimension": 2,
        "bodies": [{"element": "rigid", "name": "plate", "mass": mass, "inertia": inertia, "position": [-speed[0] * jump, -arm],
                    "motion": {"velocity": [speed[0], 0.0]}, "markers": {"c": [0.0, 0.0], "p": [0.0, arm]}}],
        "motions": [{"name": "hand", "kind": "position", "marker": "plate.p",
                     "value": [format!("(t-{jump})*if(t-{jump},{},{})", speed[1], speed[0]), 0.0]}],
        "outputs": [{"kind": "velocity", "marker": "plate.c"}, {"kind": "angular_velocity", "marker": "plate.c"},
                    {"kind": "work"}]});
    let spin = -mass * arm * (speed[1] - speed[0]) / (inertia + mass * arm * arm);
    let after = speed[1] + spin * arm;
    let gained = 0.5 * mass * (after * after - speed[0] * speed[0]) + 0.5 * inertia * spin * spin;
    Specimen::new("turned_back", scene)
        .at(0.4)
        .vector("plate.c.velocity", "m/s", [speed[0], 0.0])
        .claim("plate.c.angular_velocity", "rad/s", 0.0)
        .claim("energy.input", "J", 0.0)
        .at(jump)
        .vector("plate.c.velocity", "m/s", [after, 0.0])
        .claim("plate.c.angular_velocity", "rad/s", spin)
        .claim("energy.input", "J", gained)
}

/// What drives a point, a direction and the angle of a pin from rest does the work that goes into speed and height.
fn works() -> Specimen {
    let (g, t) = ([0.6, -9.0], 0.5);
    let scene = json!({
        "name": "works_of_drives", "dimension": 2, "gravity": g, "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [wheel("p", [0.4, 0.1], 0.0), wheel("m", [2.0, 0.0], 0.4), wheel("u", [3.0, 0.0], 0.1),
                   wheel("v", [3.0, 0.0], 0.6)],
        "joints": [{"name": "axle", "kind": "revolute", "markers": ["ground", "m.c"]},
                   {"name": "first", "kind": "revolute", "markers": ["ground", "u.c"]},
                   {"name": "pin", "kind": "revolute", "markers": ["u.c", "v.c"]}],
        "motions": [{"name": "drive", "kind": "position", "marker": "p.c", "value": ["0.4+0.7*t^2", "0.1-0.5*t^2"]},
                    {"name": "turn", "kind": "angle", "marker": "m.c", "value": "0.4+0.9*t^2"},
                    {"name": "bend", "kind": "angle", "joint": "pin", "value": "0.5+0.6*t^2"}],
        "outputs": [{"kind": "work"}]});
    let (way, speed) = ([0.7 * t * t, -0.5 * t * t], [1.4 * t, -t]);
    let of_the_point = 1.6 * (0.5 * super::dot(speed, speed) - super::dot(g, way));
    let of_the_wheel = 0.5 * 0.4 * (1.8 * t).powi(2);
    // Both wheels rotate against each other.
    let of_the_pin = 0.4 * (0.6 * t).powi(2);
    Specimen::new("works_of_drives", scene).at(t).claim_within(
        "energy.input",
        "J",
        of_the_point + of_the_wheel + of_the_pin,
        1e-7,
    )
}

#[test]
fn the_spline_is_at_rest_at_both_ends() {
    assert_eq!([spline(0.1)[1], spline(0.9)[0]], [0.0, 1.0]);
    assert_eq!(turned(0.0, [1.0, 0.0]), [1.0, 0.0]);
}
