//! Winches on straight ropes that nothing holds: what is paid out moves as all of the rope does, so the rope stays as it is, without stress,
//! and the end at the winch goes back along it.

use serde_json::{Value, json};

use super::motions::{METRES, MOVES, ends};
use super::{dot, sum, times};
use crate::claims::specimen::Specimen;

const GRAVITY: [f64; 2] = [0.3, -2.0];
const VELOCITY: [f64; 2] = [0.5, 0.4];
const TANGENT: [f64; 2] = [0.6, 0.8];
const LENGTH: f64 = 1.5;
/// Mass per length, kg/m.
const LINE: f64 = 1.25;

pub fn all() -> Vec<Specimen> {
    vec![paid_out(), loaded(), mastered()]
}

fn rope(name: &str, place: [f64; 2]) -> Value {
    json!({"element": "cable", "name": name, "elements": 3, "material": {"youngs_modulus": 1e5, "density": 1250.0, "damping_time": 1e-3},
           "section": {"area": 1e-3, "second_moment": 0.0},
           "shape": {"line": {"from": place, "to": sum(place, times(LENGTH, TANGENT))}},
           "motion": {"velocity": VELOCITY}, "markers": {"first": 0.0, "inside": 0.25, "last": 1.0}})
}

/// Where the end of a rope that began at a place falls to, with two derivatives.
fn fallen(place: [f64; 2], t: f64) -> [[f64; 2]; 3] {
    let way = sum(times(t, VELOCITY), times(0.5 * t * t, GRAVITY));
    [sum(place, way), sum(VELOCITY, times(t, GRAVITY)), GRAVITY]
}

/// A place of the mesh, by its share of the length, where all material moves alike: the end at the winch goes away from the other one.
fn passed(mut moves: [[f64; 2]; 3], share: f64, (end, travel): (&str, [f64; 3])) -> [[f64; 2]; 3] {
    let away = match end {
        "last" => times(share, TANGENT),
        _ => times(share - 1.0, TANGENT),
    };
    for (moved, travel) in moves.iter_mut().zip(travel) {
        *moved = sum(*moved, times(travel, away));
    }
    moves
}

/// `3 s^2 - 2 s^3` of a table that is at rest at both ends, with two derivatives.
fn spline(t: f64) -> [f64; 3] {
    let (s, rate) = (t / 0.8, 1.0 / 0.8);
    [
        0.4 * (3.0 * s * s - 2.0 * s.powi(3)),
        0.4 * rate * (6.0 * s - 6.0 * s * s),
        0.4 * rate * rate * (6.0 - 12.0 * s),
    ]
}

/// Name of a rope, what its winch is told, the end that it is at, and the length paid out with two derivatives.
type Course = (&'static str, Value, &'static str, [f64; 3]);

fn courses(t: f64) -> [Course; 5] {
    let wave = [0.5 * t + 0.9 * t * t, 0.5 + 1.8 * t, 1.8];
    let taken = [-2.0 * t * t, -4.0 * t, -4.0];
    let table = json!({"table": [[0.0, 0.0], [0.8, 0.4]]});
    let kinked = json!("0.5*max(0,t-0.1)");
    [
        ("still", json!(0.0), "first", [0.0; 3]),
        ("first", json!("0.5*t+0.9*t^2"), "first", wave),
        ("last", table, "last", spline(t)),
        ("kinked", kinked, "first", [0.5 * (t - 0.1), 0.5, 0.0]),
        ("taken", json!("-2*t^2"), "last", taken),
    ]
}

/// Where the first end of a rope is at the start.
fn place(n: usize) -> [f64; 2] {
    [2.0 * n as f64, 0.1]
}

fn scene(courses: &[Course]) -> Value {
    let (mut bodies, mut motions, mut read) = (Vec::new(), Vec::new(), Vec::new());
    for (n, (name, value, end, _)) in courses.iter().enumerate() {
        bodies.push(rope(name, place(n)));
        motions.push(json!({"name": format!("winch{n}"), "kind": "winch", "marker": format!("{name}.{end}"), "value": value}));
        for marker in ["first", "inside", "last"] {
            let marker = format!("{name}.{marker}");
            read.extend(MOVES.map(|kind| json!({"kind": kind, "marker": marker})));
        }
        read.push(json!({"kind": "axial_force", "marker": format!("{name}.inside")}));
    }
    read.extend(["momentum", "center_of_mass", "energy", "work"].map(|kind| json!({"kind": kind})));
    json!({"name": "paid_out", "dimension": 2, "gravity": GRAVITY, "bodies": bodies, "motions": motions, "outputs": read,
           "accuracy": {"relative_tolerance": 1e-10}})
}

fn paid_out() -> Specimen {
    let t = 0.2;
    let courses = courses(t);
    let mut specimen = Specimen::new("paid_out", scene(&courses)).at(t);
    let velocity = fallen([0.0; 2], t)[1];
    let (mut mass, mut turn, mut kinetic, mut gravity, mut start) = (0.0, [0.0; 2], 0.0, 0.0, 0.0);
    for (n, (name, _, end, travel)) in courses.into_iter().enumerate() {
        let along = |share: f64| sum(place(n), times(share * LENGTH, TANGENT));
        let moved = |share: f64| passed(fallen(along(share), t), share, (end, travel));
        for (marker, share) in [("first", 0.0), ("inside", 0.25), ("last", 1.0)] {
            for (k, value) in moved(share).into_iter().enumerate() {
                specimen =
                    specimen.vector(&format!("{name}.{marker}.{}", MOVES[k]), METRES[k], value);
            }
        }
        specimen = specimen.claim_within(&format!("{name}.inside.axial_force"), "N", 0.0, 1e-6);
        let (own, middle) = (LINE * (LENGTH + travel[0]), moved(0.5)[0]);
        mass += own;
        turn = sum(turn, times(own, middle));
        kinetic += 0.5 * own * dot(velocity, velocity);
        gravity -= own * dot(GRAVITY, middle);
        start += LINE * LENGTH * (0.5 * dot(VELOCITY, VELOCITY) - dot(GRAVITY, along(0.5)));
    }
    let about = turn[0] * velocity[1] - turn[1] * velocity[0];
    specimen
        .vector("momentum", "N.s", times(mass, velocity))
        .claim("angular_momentum", "N.m.s", about)
        .vector("center_of_mass", "m", times(1.0 / mass, turn))
        .claim("energy.kinetic", "J", kinetic)
        .claim("energy.gravity", "J", gravity)
        .claim_within("energy.strain", "J", 0.0, 1e-9)
        .claim_within("energy.input", "J", kinetic + gravity - start, 1e-7)
}

/// Motion of all material of a rope that has fallen, been pushed, dragged or pressed, along its tangent and across it (to the left):
/// ways, velocities, and what is lost by length in time, W/m, lost already, J.
#[derive(Clone, Copy)]
struct Moving {
    way: [f64; 2],
    velocity: [f64; 2],
    lost: f64,
}

/// Acceleration along and across at a way and a velocity, m/s^2, and what is lost by length in time, W/m.
type Law = fn([f64; 2], [f64; 2]) -> ([f64; 2], f64);

const ACROSS: [f64; 2] = [-0.8, 0.6];
const PUSH: [f64; 2] = [0.7, -0.4];
/// Drag by the square of the velocity, along and across, N s^2/m^3.
const DRAG: [f64; 2] = [
    0.5 * 0.1 * 1000.0 * std::f64::consts::PI * 0.03,
    0.5 * 1.2 * 1000.0 * 0.03,
];
const DEPTH: f64 = 0.03;
const STIFFNESS: f64 = 50.0;
const DAMPING: f64 = 0.6;
const FRICTION: f64 = 0.45;
const SLIP: f64 = 0.8;

fn in_axes(v: [f64; 2]) -> [f64; 2] {
    [dot(v, TANGENT), dot(v, ACROSS)]
}

fn in_space([along, across]: [f64; 2]) -> [f64; 2] {
    sum(times(along, TANGENT), times(across, ACROSS))
}

fn pushed(_: [f64; 2], _: [f64; 2]) -> ([f64; 2], f64) {
    (in_axes(sum(GRAVITY, times(1.0 / LINE, PUSH))), 0.0)
}

/// In a fluid at rest in which it has no weight.
fn dragged(_: [f64; 2], v: [f64; 2]) -> ([f64; 2], f64) {
    let drag = [0, 1].map(|k| -DRAG[k] * v[k].abs() * v[k]);
    (times(1.0 / LINE, drag), -dot(drag, v))
}

/// Force of the ground by length, along and across.
fn pressure(way: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    let push = STIFFNESS * (DEPTH - way[1]) * (1.0 - DAMPING * v[1]);
    [-FRICTION * push * v[0] / v[0].hypot(SLIP), push]
}

fn pressed(way: [f64; 2], v: [f64; 2]) -> ([f64; 2], f64) {
    let force = pressure(way, v);
    let elastic = [0.0, STIFFNESS * (DEPTH - way[1])];
    let lost = -dot(sum(force, times(-1.0, elastic)), v);
    (sum(in_axes(GRAVITY), times(1.0 / LINE, force)), lost)
}

/// The classical method of Runge and Kutta with steps so short that they count for nothing.
fn moving(law: Law, length: impl Fn(f64) -> f64, until: f64) -> Moving {
    let mut now = Moving {
        way: [0.0; 2],
        velocity: in_axes(VELOCITY),
        lost: 0.0,
    };
    let (steps, mut t) = (2000, 0.0);
    let h = until / f64::from(steps);
    let rate = |t: f64, at: Moving| {
        let (acceleration, lost) = law(at.way, at.velocity);
        Moving {
            way: at.velocity,
            velocity: acceleration,
            lost: lost * length(t),
        }
    };
    let ahead = |at: Moving, by: f64, rate: Moving| Moving {
        way: sum(at.way, times(by, rate.way)),
        velocity: sum(at.velocity, times(by, rate.velocity)),
        lost: at.lost + by * rate.lost,
    };
    for _ in 0..steps {
        let a = rate(t, now);
        let b = rate(t + 0.5 * h, ahead(now, 0.5 * h, a));
        let c = rate(t + 0.5 * h, ahead(now, 0.5 * h, b));
        let d = rate(t + h, ahead(now, h, c));
        for (part, weight) in [(a, 1.0), (b, 2.0), (c, 2.0), (d, 1.0)] {
            now = ahead(now, weight * h / 6.0, part);
        }
        t += h;
    }
    now
}

/// What acts along ropes that are paid out acts on their material: ropes that are pushed, dragged and pressed evenly move as a whole.
fn loaded() -> Specimen {
    let t = 0.2;
    let [_, first, last, _, taken] = courses(t);
    let length_of: [fn(f64) -> f64; 3] = [
        |t| LENGTH + 0.5 * t + 0.9 * t * t,
        |t| LENGTH + spline(t)[0],
        |t| LENGTH - 2.0 * t * t,
    ];
    let mut scene = scene(&[first.clone(), last.clone(), taken.clone()]);
    scene["name"] = json!("paid_out_loads");
    let ground = sum(place(2), times(DEPTH, ACROSS));
    scene["loads"] = json!([
        {"name": "wind", "kind": "distributed_force", "body": "first", "value": PUSH},
        {"name": "sea", "kind": "fluid", "body": "last", "density": 1000.0, "area": LINE / 1000.0, "diameter": 0.03,
         "drag": 1.2, "tangential_drag": 0.1},
        {"name": "floor", "kind": "contact", "body": "taken", "stiffness": STIFFNESS, "damping": DAMPING, "friction": FRICTION,
         "slip_velocity": SLIP, "surface": {"plane": {"point": ground, "normal": ACROSS}}}]);
    let read = scene["outputs"].as_array_mut().expect("a list");
    read.push(json!({"kind": "load_force", "load": "floor"}));
    let mut specimen = Specimen::new("paid_out_loads", scene).at(t);
    let laws: [Law; 3] = [pushed, dragged, pressed];
    let (mut held, mut start, mut lost) = (0.0, 0.0, 0.0);
    for (n, (name, _, end, travel)) in [first, last, taken].into_iter().enumerate() {
        let now = moving(laws[n], length_of[n], t);
        let (acceleration, _) = laws[n](now.way, now.velocity);
        let velocity = in_space(now.velocity);
        let along = |share: f64| sum(place(n), times(share * LENGTH, TANGENT));
        let moved = |share: f64| {
            let place = sum(along(share), in_space(now.way));
            passed(
                [place, velocity, in_space(acceleration)],
                share,
                (end, travel),
            )
        };
        for (marker, share) in [("first", 0.0), ("inside", 0.25), ("last", 1.0)] {
            for (k, value) in moved(share).into_iter().enumerate() {
                let of = format!("{name}.{marker}.{}", MOVES[k]);
                specimen = specimen.vector_within(&of, METRES[k], value, 1e-7);
            }
        }
        specimen = specimen.claim_within(&format!("{name}.inside.axial_force"), "N", 0.0, 1e-6);
        let length = LENGTH + travel[0];
        let energy = |velocity: [f64; 2], middle: [f64; 2]| {
            LINE * (0.5 * dot(velocity, velocity) - dot(GRAVITY, middle))
        };
        held += length * energy(velocity, moved(0.5)[0]);
        start += LENGTH * energy(VELOCITY, along(0.5));
        lost += now.lost;
        if n == 2 {
            let depth = DEPTH - now.way[1];
            held += length * 0.5 * STIFFNESS * depth * depth;
            start += LENGTH * 0.5 * STIFFNESS * DEPTH * DEPTH;
            let force = in_space(times(length, pressure(now.way, now.velocity)));
            specimen = specimen.vector_within("floor.force", "N", force, 1e-6);
        }
    }
    specimen
        .claim_within("energy.dissipated", "J", lost, 1e-6)
        .claim_within("energy.input", "J", held - start + lost, 1e-6)
}

/// The master sets the length, with 0, 1 and 2 derivatives; at the start nothing has been paid out.
fn mastered() -> Specimen {
    let (mut bodies, mut motions, mut read) = (Vec::new(), Vec::new(), Vec::new());
    for n in 0..3 {
        let name = format!("rope{n}");
        bodies.push(rope(&name, [2.0 * f64::from(n), 0.0]));
        motions.push(json!({"name": format!("winch{n}"), "kind": "winch", "marker": format!("{name}.first"), "value": {"input": n}}));
        read.extend(MOVES.map(|kind| json!({"kind": kind, "marker": format!("{name}.first")})));
    }
    let scene = json!({"name": "winch_inputs", "dimension": 2, "bodies": bodies, "motions": motions, "outputs": read,
                       "accuracy": {"relative_tolerance": 1e-11}});
    let keys = ["travel", "velocity", "acceleration"];
    let (h, first, second) = (0.1, [0.0, 0.2, 0.5], [0.03, 0.4, -0.8]);
    let mut specimen = Specimen::new("winch_inputs", scene);
    let set = |mut specimen: Specimen, from: usize, course: [f64; 3]| {
        for n in 0..3 {
            for k in from..=n {
                specimen = specimen.set(&format!("winch{n}.{}", keys[k]), course[k]);
            }
        }
        specimen
    };
    specimen = set(specimen, 1, first);
    for n in 0..3 {
        for k in 0..=n {
            let of = format!("rope{n}.first.{}", MOVES[k]);
            let start = match k {
                0 => [2.0 * n as f64, 0.0],
                1 => VELOCITY,
                _ => [0.0; 2],
            };
            let value = sum(start, times(-first[k], TANGENT));
            specimen = specimen.vector(&of, METRES[k], value);
        }
    }
    specimen = set(specimen.at(h), 0, second).at(2.0 * h);
    for (n, end) in ends(second, h).into_iter().enumerate() {
        for k in 0..=n {
            let of = format!("rope{n}.first.{}", MOVES[k]);
            let start = match k {
                0 => sum([2.0 * n as f64, 0.0], times(2.0 * h, VELOCITY)),
                1 => VELOCITY,
                _ => [0.0; 2],
            };
            let value = sum(start, times(-end[k], TANGENT));
            specimen =
                specimen.vector_within(&of, METRES[k], value, if k == 2 { 1e-7 } else { 1e-8 });
        }
    }
    specimen
}
