//! Rods: bending, torsion, axes of sections, motions at the start.

use std::f64::consts::PI;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::space::{array, vector};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        twisted(),
        bending(),
        moving(),
        named(),
        hanging(),
        settled("waves"),
        settled("critically_damped"),
    ]
}

/// Returns the specimens for which rotary inertia of bending does not count.
pub fn statics() -> Vec<Specimen> {
    let all = all().into_iter();
    all.filter(|specimen| specimen.name != "bending rod")
        .collect()
}

const YOUNG: f64 = 3.0e5;
const SHEAR: f64 = 1.1e5;
const DENSITY: f64 = 700.0;
const AREA: f64 = 2.0e-3;
const MOMENTS: [f64; 2] = [3.0e-7, 7.0e-7];
const TORSION: f64 = 5.0e-7;

fn rod(shape: Value) -> Value {
    json!({"name": "rod", "element": "rod", "elements": 4, "axial": "waves",
           "material": {"youngs_modulus": YOUNG, "shear_modulus": SHEAR, "density": DENSITY},
           "section": {"area": AREA, "second_moments": MOMENTS, "torsion_constant": TORSION},
           "axis": [0.3, -0.2, 0.9], "shape": shape, "markers": {"root": 0.0, "mid": 0.4, "tip": 1.0}})
}

fn straight(from: Vector3<f64>, to: Vector3<f64>) -> Value {
    json!({"line": {"from": array(from), "to": array(to)}})
}

fn clamped(body: Value, rest: Value) -> Value {
    let mut scene = json!({"name": "rod", "dimension": 3, "bodies": [body],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.root"]}]});
    for (key, value) in rest.as_object().into_iter().flatten() {
        scene[key] = value.clone();
    }
    scene
}

/// Under a torque `M` inside it a section there, at `s`, rotates by `M s / (G J)`, and the torque is `M` up to there.
fn twisted() -> Specimen {
    let (from, to, torque) = (
        Vector3::new(0.2, -0.4, 0.1),
        Vector3::new(1.0, 0.2, 0.4),
        0.02,
    );
    let (way, length) = (to - from, (to - from).norm());
    let along = way / length;
    let scene = clamped(
        rod(straight(from, to)),
        json!({"loads": [{"name": "twist", "kind": "moment", "marker": "rod.mid", "value": array(along * torque)}],
               "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-9},
               "outputs": [{"kind": "orientation", "marker": "rod.mid"}, {"kind": "torque", "marker": "rod.root"},
                           {"kind": "position", "marker": "rod.mid"}]}),
    );
    let given = Vector3::new(0.3, -0.2, 0.9);
    let first = (given - along * along.dot(&given)).normalize();
    let angle = torque * 0.4 * length / (SHEAR * TORSION);
    let second = first * angle.cos() + along.cross(&first) * angle.sin();
    let axes = [along, second, along.cross(&second)];
    let mut specimen = Specimen::new("twisted rod", scene).claim("rod.root.torque", "N.m", torque);
    for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column))) {
        let of = format!("rod.mid.orientation[{}]", 3 * row + column + 1);
        specimen = specimen.claim(&of, "", axes[column][row]);
    }
    vector(specimen, "rod.mid.position", "m", from + way * 0.4)
}

/// The first two frequencies of a clamped rod are those of bending about both axes, `1.8751^2 sqrt(E I / (rho A)) / L^2`; with
/// damping in proportion to stiffness they decay at `tau w^2 / 2`.
fn bending() -> Specimen {
    let (to, time) = (Vector3::new(0.0, 1.2, 0.0), 0.03);
    let mut body = rod(straight(Vector3::zeros(), to));
    body["elements"] = json!(16);
    body["material"]["damping_time"] = json!(time);
    let scene = clamped(
        body,
        json!({"outputs": [{"kind": "natural_frequency", "count": 2}, {"kind": "eigenvalue", "count": 2}]}),
    );
    let wave = 1.875104068711961 / to.norm();
    let frequency = |moment: f64| wave * wave * (YOUNG * moment / (DENSITY * AREA)).sqrt();
    let [slow, fast] = MOMENTS.map(frequency);
    let specimen = Specimen::new("bending rod", scene)
        .claim_within("natural_frequency[1]", "rad/s", slow, 1e-6)
        .claim_within("natural_frequency[2]", "rad/s", fast, 1e-6);
    let decay = |w: f64| 0.5 * time * w * w;
    specimen
        .claim_within("eigenvalue.decay_rate[1]", "1/s", decay(slow), 1e-6)
        .claim_within("eigenvalue.decay_rate[2]", "1/s", decay(fast), 1e-6)
}

/// A free rod that moves, rotates and deforms at the start: `v + w x r` and what deforms it.
fn moving() -> Specimen {
    let (from, to) = (Vector3::new(0.5, 0.1, -0.3), Vector3::new(1.1, 0.9, -0.2));
    let (velocity, spin) = (Vector3::new(0.4, -0.7, 1.1), Vector3::new(0.6, 0.5, -0.8));
    let mut body = rod(straight(from, to));
    body["motion"] = json!({"velocity": array(velocity), "spin": array(spin),
        "deformation": ["0.2*s", "s^2", "0.3*sin(s)"]});
    let scene = json!({"name": "rod", "dimension": 3, "bodies": [body],
        "outputs": [{"kind": "velocity", "marker": "rod.root"}, {"kind": "velocity", "marker": "rod.mid"},
                    {"kind": "velocity", "marker": "rod.tip"},
                    {"kind": "angular_velocity", "marker": "rod.root"}, {"kind": "angular_velocity", "marker": "rod.tip"}]});
    let place = |s: f64| {
        let deformed = Vector3::new(0.2 * s, s * s, 0.3 * s.sin());
        velocity + spin.cross(&((to - from) * s)) + deformed
    };
    let mut specimen = Specimen::new("moving rod", scene);
    for (marker, s) in [("root", 0.0), ("mid", 0.4), ("tip", 1.0)] {
        specimen = vector(specimen, &format!("rod.{marker}.velocity"), "m/s", place(s));
    }
    // Sections rotate with their line, those of beams as well.
    let turn = |s: f64| {
        let slope_rate = Vector3::new(0.2, 2.0 * s, 0.3 * s.cos()) / (to - from).norm();
        spin + (to - from).normalize().cross(&slope_rate)
    };
    for (marker, s) in [("root", 0.0), ("tip", 1.0)] {
        let name = format!("rod.{marker}.angular_velocity");
        specimen = vector(specimen, &name, "rad/s", turn(s));
    }
    specimen
}

/// A free rod at rest, which nothing refers to: its centre of mass stays, its parameters bear its name.
fn named() -> Specimen {
    let (from, to) = (Vector3::new(0.5, 0.1, -0.3), Vector3::new(1.1, 0.9, -0.2));
    let mut other = rod(straight(to, from));
    (other["name"], other["material"]["density"]) = (json!("other"), json!(2.0 * DENSITY));
    let scene = json!({"name": "rod", "dimension": 3, "bodies": [rod(straight(from, to)), other],
        "outputs": [{"kind": "momentum"}, {"kind": "energy"}]});
    let specimen = Specimen::new("named rod", scene)
        .claim("rod.density", "kg/m3", DENSITY)
        .claim("other.density", "kg/m3", 2.0 * DENSITY)
        .claim("energy.kinetic", "J", 0.0);
    let specimen = vector(specimen, "momentum", "N.s", Vector3::zeros());
    vector(specimen, "angular_momentum", "N.m.s", Vector3::zeros())
}

/// A rod that is curved without stress stands as it is drawn: on an arc, through the ends, and as deep as its length says.
fn hanging() -> Specimen {
    // Half an angle of 0.8 rad.
    let (radius, half) = (1.5_f64, 0.8_f64);
    let from = Vector3::new(-radius * half.sin(), 0.3, 0.2);
    let to = Vector3::new(radius * half.sin(), 0.3, 0.2);
    let shape =
        json!({"arc": {"from": array(from), "to": array(to), "length": 2.0 * radius * half}});
    let mut body = rod(shape);
    body["markers"]["mid"] = json!(0.5);
    let scene = clamped(
        body,
        json!({"outputs": [{"kind": "position", "marker": "rod.root"}, {"kind": "position", "marker": "rod.mid"},
                           {"kind": "position", "marker": "rod.tip"}]}),
    );
    let deepest = Vector3::new(0.0, 0.3, 0.2 - radius * (1.0 - half.cos()));
    let mut specimen = Specimen::new("hanging rod", scene);
    for (marker, at) in [("root", from), ("mid", deepest), ("tip", to)] {
        specimen = vector(specimen, &format!("rod.{marker}.position"), "m", at);
    }
    specimen
}

/// Stretching of a clamped rod that hardly bends and twists swings at `w = pi c / (2 L)`, `c^2 = E / rho`; settled, with the time
/// `2 / w`, all faster modes creep at `w / 2`.
fn settled(axial: &str) -> Specimen {
    let to = Vector3::new(0.0, 0.0, 0.8);
    let mut body = rod(straight(Vector3::zeros(), to));
    body["elements"] = json!(8);
    body["axial"] = json!(axial);
    body["section"]["second_moments"] = json!([AREA, AREA]);
    body["section"]["torsion_constant"] = json!(1e2 * AREA);
    let scene = clamped(
        body,
        json!({"outputs": [{"kind": "eigenvalue", "count": 2}]}),
    );
    let frequency = 0.5 * PI * (YOUNG / DENSITY).sqrt() / to.norm();
    let name = if axial == "waves" {
        "ringing rod"
    } else {
        "settled rod"
    };
    let decay = if axial == "waves" {
        0.0
    } else {
        0.5 * frequency
    };
    Specimen::new(name, scene).claim_within(
        "eigenvalue.decay_rate[1]",
        "1/s",
        decay,
        0.1 * frequency,
    )
}
