//! Winches on straight ropes that nothing holds: what is paid out moves as all of the rope does, so the rope stays as it is, without stress,
//! and the end at the winch goes back along it.

use serde_json::{Value, json};

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

const MOVES: [&str; 3] = ["position", "velocity", "acceleration"];
const METRES: [&str; 3] = ["m", "m/s", "m/s2"];

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

fn paid_out() -> Specimen {
    let t = 0.2;
    let courses = [
        ("still", json!(0.0), "first", [0.0; 3]),
        (
            "first",
            json!("0.5*t+0.9*t^2"),
            "first",
            [0.5 * t + 0.9 * t * t, 0.5 + 1.8 * t, 1.8],
        ),
        (
            "last",
            json!({"table": [[0.0, 0.0], [0.8, 0.4]]}),
            "last",
            spline(t),
        ),
        (
            "taken",
            json!("-2*t^2"),
            "last",
            [-2.0 * t * t, -4.0 * t, -4.0],
        ),
    ];
    let (mut bodies, mut motions, mut read) = (Vec::new(), Vec::new(), Vec::new());
    let place = |n: usize| [2.0 * n as f64, 0.1];
    for (n, (name, value, end, _)) in courses.iter().enumerate() {
        bodies.push(rope(name, place(n)));
        motions.push(json!({"name": format!("winch{n}"), "kind": "winch", "marker": format!("{name}.{end}"), "value": value}));
        for marker in ["first", "inside", "last"] {
            read.extend(
                MOVES.map(|kind| json!({"kind": kind, "marker": format!("{name}.{marker}")})),
            );
        }
        read.push(json!({"kind": "axial_force", "marker": format!("{name}.inside")}));
    }
    read.extend(["momentum", "center_of_mass", "energy", "work"].map(|kind| json!({"kind": kind})));
    let scene = json!({"name": "paid_out", "dimension": 2, "gravity": GRAVITY, "bodies": bodies, "motions": motions,
                       "outputs": read, "accuracy": {"relative_tolerance": 1e-10}});
    let mut specimen = Specimen::new("paid_out", scene).at(t);
    let (mut mass, mut turn, mut energy) = (0.0, [0.0; 2], [0.0; 3]);
    for (n, (name, _, end, travel)) in courses.into_iter().enumerate() {
        let ends = [place(n), sum(place(n), times(LENGTH, TANGENT))];
        let at_last = end == "last";
        // From the other end on the winch's goes away from it.
        let away = times(if at_last { 1.0 } else { -1.0 }, TANGENT);
        let moved = |start: [f64; 2], share: f64| {
            let mut moves = fallen(start, t);
            for (k, travel) in travel.into_iter().enumerate() {
                moves[k] = sum(moves[k], times(share * travel, away));
            }
            moves
        };
        let inside = sum(ends[0], times(0.25 * LENGTH, TANGENT));
        let markers = [
            ("first", moved(ends[0], if at_last { 0.0 } else { 1.0 })),
            ("inside", moved(inside, if at_last { 0.25 } else { 0.75 })),
            ("last", moved(ends[1], if at_last { 1.0 } else { 0.0 })),
        ];
        let middle = times(0.5, sum(markers[0].1[0], markers[2].1[0]));
        for (marker, moves) in markers {
            for k in 0..3 {
                let of = format!("{name}.{marker}.{}", MOVES[k]);
                specimen = specimen.vector(&of, METRES[k], moves[k]);
            }
        }
        specimen = specimen.claim_within(&format!("{name}.inside.axial_force"), "N", 0.0, 1e-6);
        let own = LINE * (LENGTH + travel[0]);
        mass += own;
        turn = sum(turn, times(own, middle));
        let velocity = fallen([0.0; 2], t)[1];
        energy[0] += 0.5 * own * dot(velocity, velocity);
        energy[1] -= own * dot(GRAVITY, middle);
        let before = LINE * LENGTH;
        let start = sum(ends[0], times(0.5 * LENGTH, TANGENT));
        energy[2] += 0.5 * own * dot(velocity, velocity)
            - own * dot(GRAVITY, middle)
            - 0.5 * before * dot(VELOCITY, VELOCITY)
            + before * dot(GRAVITY, start);
    }
    let velocity = fallen([0.0; 2], t)[1];
    let momentum = times(mass, velocity);
    let about = turn[0] * velocity[1] - turn[1] * velocity[0];
    specimen
        .vector("momentum", "N.s", momentum)
        .claim("angular_momentum", "N.m.s", about)
        .vector("center_of_mass", "m", times(1.0 / mass, turn))
        .claim("energy.kinetic", "J", energy[0])
        .claim("energy.gravity", "J", energy[1])
        .claim_within("energy.strain", "J", 0.0, 1e-9)
        .claim_within("energy.input", "J", energy[2], 1e-7)
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
    let ends = [
        [second[0], 0.0, 0.0],
        [second[0] + h * second[1], second[1], 0.0],
        [
            second[0] + h * second[1] + 0.5 * h * h * second[2],
            second[1] + h * second[2],
            second[2],
        ],
    ];
    for (n, end) in ends.into_iter().enumerate() {
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
