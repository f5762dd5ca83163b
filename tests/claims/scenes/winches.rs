//! Winches on straight ropes that nothing holds: what is paid out moves as all of the rope does, so the rope stays as it is, without stress,
//! and the end at the winch goes back along it.

use serde_json::{Value, json};

use super::motions::{METRES, MOVES, ends};
use super::{dot, sum, times};
use crate::specimen::Specimen;

const GRAVITY: [f64; 2] = [0.3, -2.0];
const VELOCITY: [f64; 2] = [0.5, 0.4];
const TANGENT: [f64; 2] = [0.6, 0.8];
const LENGTH: f64 = 1.5;
/// Mass per length, kg/m.
const LINE: f64 = 1.25;

pub fn all() -> Vec<Specimen> {
    vec![paid_out(), mastered()]
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
        // The end at the winch goes away from the other one.
        let (away, at_last) = match end {
            "last" => (TANGENT, true),
            _ => (times(-1.0, TANGENT), false),
        };
        let along = |share: f64| sum(place(n), times(share * LENGTH, TANGENT));
        let moved = |share: f64| {
            let (mut moves, paid) = (
                fallen(along(share), t),
                if at_last { share } else { 1.0 - share },
            );
            for (k, travel) in travel.into_iter().enumerate() {
                moves[k] = sum(moves[k], times(paid * travel, away));
            }
            moves
        };
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
