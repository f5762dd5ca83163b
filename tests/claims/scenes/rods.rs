//! Cables that do not bend: their motion is that of a rigid rod, the forces in their sections are those of d'Alembert.

use serde_json::{Value, json};

use super::{clamp, cross, dot, left, sum, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        falling("falling", None),
        falling("falling_with_bob", Some([0.2, 0.03])),
        hinged(),
        carrying("carrying", "rigid"),
        carrying("stiff_carrying", "flexible"),
        linked(),
        whirling(),
    ]
}

/// Length, m, and mass per length, kg/m, of all of them.
const LENGTH: f64 = 1.5;
const LINE: f64 = 0.3;
/// Markers along them.
const PLACES: [(&str, f64); 5] = [("a", 0.0), ("b", 0.25), ("c", 0.5), ("d", 0.8), ("e", 1.0)];

/// A rigid cable with a marker at every place.
pub fn rod(name: &str, from: [f64; 2], along: [f64; 2]) -> Value {
    let markers: serde_json::Map<String, Value> = PLACES
        .iter()
        .map(|(name, s)| ((*name).into(), json!(s)))
        .collect();
    json!({"element": "cable", "name": name, "model": "rigid",
           "material": {"youngs_modulus": 1e9, "density": 30.0},
           "section": {"area": 1e-2, "second_moment": 1e-5},
           "shape": {"line": {"from": from, "to": sum(from, times(LENGTH, along))}}, "markers": markers})
}

/// All that is read of the sections of a rod.
pub fn sections(name: &str) -> Vec<Value> {
    let kinds = ["axial_force", "bending_moment", "connectivity_force"];
    let read = |(place, _): &(&str, f64)| {
        kinds.map(|kind| json!({"kind": kind, "marker": format!("{name}.{place}")}))
    };
    PLACES.iter().flat_map(read).collect()
}

/// What the outer part of a pendulum exerts in a section: along the rod, across it, and its moment there.
struct Pendulum {
    /// Gravity along the rod from the pin outwards, and across it to the left.
    gravity: [f64; 2],
    spin: f64,
    /// Moment of a hinge at the pin.
    hinge: f64,
    /// Mass and inertia at the outer end.
    bob: [f64; 2],
}

impl Pendulum {
    fn spin_rate(&self) -> f64 {
        let ([_, g], [m, j], l) = (self.gravity, self.bob, LENGTH);
        let inertia = LINE * l * l * l / 3.0 + m * l * l + j;
        (LINE * l * g * 0.5 * l + m * g * l + self.hinge) / inertia
    }

    /// Force along and across, and moment, at a distance from the pin: weight less inertia of what is beyond.
    fn outer(&self, y: f64) -> [f64; 3] {
        let ([along, across], [m, j], l) = (self.gravity, self.bob, LENGTH);
        let (square, rate, h) = (self.spin * self.spin, self.spin_rate(), l - y);
        let ring = 0.5 * (l * l - y * y);
        let turned = LINE * (across * h * h / 2.0 - rate * (y * h * h / 2.0 + h * h * h / 3.0));
        [
            LINE * (along * h + square * ring) + m * (along + square * l),
            LINE * (across * h - rate * ring) + m * (across - rate * l),
            turned + m * h * (across - rate * l) - j * rate,
        ]
    }
}

/// A compound pendulum as it moves off from the horizontal, by itself, M = m g x (L - x)^2 / (4 L^2), or with mass and
/// inertia at its end.
fn falling(title: &'static str, bob: Option<[f64; 2]>) -> Specimen {
    let (g, spin) = (9.81, -1.3);
    let [mass, inertia] = bob.unwrap_or_default();
    let masses = bob.map(|_| json!({"marker": "rod.e", "mass": mass, "inertia": inertia}));
    let mut body = rod("rod", [0.0, 0.0], [1.0, 0.0]);
    body["motion"] = json!({"velocity": [0.0, 0.0], "spin": spin});
    let scene = json!({
        "name": title, "dimension": 2, "gravity": [0.0, -g], "bodies": [body],
        "masses": Vec::from_iter(masses),
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "rod.a"]}],
        "outputs": sections("rod")});
    let mut specimen = Specimen::new(title, scene);
    let pendulum = Pendulum {
        gravity: [0.0, -g],
        spin,
        hinge: 0.0,
        bob: [mass, inertia],
    };
    for (place, s) in PLACES {
        let name = |of: &str| format!("rod.{place}.{of}");
        let x = s * LENGTH;
        let [axial, across, moment] = pendulum.outer(x);
        let moment = match bob {
            None => LINE * g * x * (LENGTH - x).powi(2) / (4.0 * LENGTH),
            Some(_) => moment,
        };
        let before = if s == 0.0 {
            [0.0; 2]
        } else {
            [-axial, -across]
        };
        specimen = specimen
            .claim(&name("axial_force"), "N", axial)
            .claim(&name("bending_moment"), "N.m", moment)
            .vector(&name("connectivity_force"), "N", before);
    }
    specimen
}

const PIN: [f64; 2] = [3.0, 1.0];

/// A pendulum that is described towards its pin, on a hinge and with a bob, as it moves off.
fn hinged() -> Specimen {
    let (g, angle, spin, bob) = (9.81, 0.7, 1.3, [0.2, 0.03]);
    let (k, d, rest) = (2.0, 0.4, -2.0);
    let out = turned(angle, [1.0, 0.0]);
    let tip = sum(PIN, times(LENGTH, out));
    let mut body = rod("rod", tip, times(-1.0, out));
    body["motion"] = json!({"velocity": times(spin * LENGTH, left(out)), "spin": spin});
    let mut outputs = sections("rod");
    outputs.extend(["energy", "momentum", "center_of_mass"].map(|kind| json!({"kind": kind})));
    outputs.extend([
        json!({"kind": "velocity", "marker": "rod.b"}),
        json!({"kind": "angular_acceleration", "marker": "rod.c"}),
    ]);
    let scene = json!({
        "name": "hinged", "dimension": 2, "gravity": [0.0, -g], "bodies": [body],
        "masses": [{"marker": "rod.a", "mass": bob[0], "inertia": bob[1]}],
        "joints": [{"name": "hinge", "kind": "revolute", "markers": ["ground", "rod.e"], "stiffness": k, "damping": d,
                    "angle": rest}],
        "outputs": outputs});
    // The direction of the rod is opposite to the way out.
    let turn = angle - std::f64::consts::PI - rest;
    let pendulum = Pendulum {
        gravity: [dot([0.0, -g], out), dot([0.0, -g], left(out))],
        spin,
        hinge: -k * turn - d * spin,
        bob,
    };
    let specimen = Specimen::new("hinged", scene)
        .vector(
            "rod.b.velocity",
            "m/s",
            times(0.75 * spin * LENGTH, left(out)),
        )
        .claim("rod.c.angular_acceleration", "rad/s2", pendulum.spin_rate());
    let mut specimen = swung(specimen, (spin, g), bob, out);
    for (place, s) in PLACES {
        let name = |of: &str| format!("rod.{place}.{of}");
        let [axial, across, moment] = pendulum.outer((1.0 - s) * LENGTH);
        // The bob acts at the first end: before it there is nothing.
        let before = match s {
            0.0 => [0.0; 2],
            _ => sum(times(axial, out), times(across, left(out))),
        };
        specimen = specimen
            .claim(&name("axial_force"), "N", axial)
            .claim(&name("bending_moment"), "N.m", -moment)
            .vector(&name("connectivity_force"), "N", before);
    }
    specimen
}

/// Energies, momentum and centre of mass of a rod that rotates about the pin, with mass and inertia at its outer end.
fn swung(
    specimen: Specimen,
    (spin, g): (f64, f64),
    [bob, inertia]: [f64; 2],
    out: [f64; 2],
) -> Specimen {
    let (mass, l) = (LINE * LENGTH, LENGTH);
    let (total, first) = (mass + bob, mass * 0.5 * l + bob * l);
    let centre = sum(PIN, times(first / total, out));
    let about = mass * l * l / 3.0 + bob * l * l + inertia;
    specimen
        .claim("energy.kinetic", "J", 0.5 * about * spin * spin)
        .claim("energy.gravity", "J", g * total * centre[1])
        .vector("center_of_mass", "m", centre)
        .vector("momentum", "N.s", times(spin * first, left(out)))
}

/// A clamped rod at rest that carries one load of every kind: every section carries what acts beyond it. A flexible one so
/// stiff that it stays straight carries the same.
fn carrying(title: &'static str, model: &str) -> Specimen {
    let (g, out) = (9.81, turned(-0.4, [1.0, 0.0]));
    let (mass, line) = (0.6, [0.5, -2.0]);
    let (dead, follower, moment, twist) = ([3.0, 1.0], [-2.0, 4.0], 0.7, -1.1);
    let (k, reach, length) = (20.0, [0.4, 1.1], 0.3);
    let (port, held) = (8.0, [1.2, -0.9]);
    let at = |s: f64| times(s * LENGTH, out);
    let (mut beam, mut initial, mut within) = (rod("beam", [0.0, 0.0], out), "undeformed", 1e-9);
    if model == "flexible" {
        beam["model"] = json!(model);
        beam["elements"] = json!(4);
        beam["material"]["youngs_modulus"] = json!(1e11);
        (initial, within) = ("static_equilibrium", 1e-4);
    }
    let scene = json!({
        "name": title, "dimension": 2, "gravity": [0.0, -g], "initial": initial,
        "bodies": [beam],
        "masses": [{"marker": "beam.c", "mass": mass, "inertia": 0.1}],
        "joints": [clamp("clamp", "beam.a")],
        "loads": [{"name": "dead", "kind": "force", "marker": "beam.e", "value": dead},
                  {"name": "turning", "kind": "force", "marker": "beam.d", "follower": true, "value": follower},
                  {"name": "twist", "kind": "moment", "marker": "beam.d", "value": moment},
                  {"name": "wind", "kind": "distributed_force", "body": "beam", "value": line},
                  {"name": "spring", "kind": "spring_damper", "markers": ["ground", "beam.c"], "point": reach,
                   "stiffness": k, "length": length}],
        "inputs": [{"kind": "moment", "marker": "beam.b", "start": [twist]}],
        "ports": [{"name": "port", "marker": "beam.d", "kind": "motion", "stiffness": port}],
        "outputs": sections("beam")});
    let mut specimen = Specimen::new(title, scene)
        .set("port.position[1]", held[0])
        .set("port.position[2]", held[1]);
    let way = sum(reach, times(-1.0, at(0.5)));
    let distance = dot(way, way).sqrt();
    let pull = times(k * (distance - length) / distance, way);
    let across = |of: [f64; 2]| sum(times(of[0], out), times(of[1], left(out)));
    let drag = times(port, sum(held, times(-1.0, at(0.8))));
    // Place, force and moment of all that acts at points.
    let acting = [
        (1.0, dead, 0.0),
        (0.8, across(follower), moment),
        (0.8, drag, 0.0),
        (0.5, sum(pull, [0.0, -mass * g]), 0.0),
        (0.25, [0.0; 2], twist),
    ];
    let spread = sum(line, [0.0, -LINE * g]);
    for (place, s) in PLACES {
        let name = |of: &str| format!("beam.{place}.{of}");
        // At the last end what acts there is carried.
        let (force, moment) = carried((s, out), spread, &acting, s == 1.0);
        let (held, _) = carried((s, out), spread, &acting, true);
        let held = if s == 0.0 {
            [0.0; 2]
        } else {
            times(-1.0, held)
        };
        specimen = specimen
            .claim_within(&name("axial_force"), "N", dot(force, out), within)
            .claim_within(&name("bending_moment"), "N.m", moment, within)
            .vector_within(&name("connectivity_force"), "N", held, within);
    }
    specimen
}

/// Force and moment about a section, by its place and the direction of the rod, of what acts beyond: what is spread, and
/// points with their forces and moments, those in the section too or not.
fn carried(
    (s, out): (f64, [f64; 2]),
    spread: [f64; 2],
    acting: &[(f64, [f64; 2], f64)],
    with_own: bool,
) -> ([f64; 2], f64) {
    let h = (1.0 - s) * LENGTH;
    let (mut force, mut moment) = (times(h, spread), cross(out, spread) * h * h / 2.0);
    for (place, point, twist) in acting {
        if *place > s || with_own && *place == s {
            force = sum(force, *point);
            moment += cross(times((place - s) * LENGTH, out), *point) + twist;
        }
    }
    (force, moment)
}

/// A rod between a pin and a link that holds it level: a beam between supports, M = q x (L - x) / 2, and the link pulls
/// along it.
fn linked() -> Specimen {
    let (g, link) = (9.81, [-0.9, 1.2]);
    let scene = json!({
        "name": "linked", "dimension": 2, "gravity": [0.0, -g],
        "bodies": [rod("beam", [0.0, 0.0], [1.0, 0.0])],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "beam.a"]},
                   {"name": "link", "kind": "distance", "markers": ["ground", "beam.e"],
                    "point": sum([LENGTH, 0.0], link)}],
        "outputs": sections("beam")});
    let mut specimen = Specimen::new("linked", scene);
    let weight = LINE * g;
    let axial = 0.5 * weight * LENGTH * link[0] / link[1];
    for (place, s) in PLACES {
        let name = |of: &str| format!("beam.{place}.{of}");
        let (x, shear) = (s * LENGTH, weight * (s - 0.5) * LENGTH);
        let before = if s == 0.0 { [0.0; 2] } else { [-axial, -shear] };
        let moment = 0.5 * weight * x * (LENGTH - x);
        specimen = specimen
            .claim(&name("axial_force"), "N", axial)
            .claim(&name("bending_moment"), "N.m", moment)
            .vector(&name("connectivity_force"), "N", before);
    }
    specimen
}

/// In a frame that rotates, a rod at rest is stretched by centrifugal force, N = rho A w^2 (L^2 - x^2) / 2. One that rests
/// outside goes round in there, and no section carries anything, whatever sits on it.
fn whirling() -> Specimen {
    let (rate, out) = (2.3, turned(0.3, [1.0, 0.0]));
    let mut free = rod("free", [0.2, -0.7], [0.0, 1.0]);
    let outputs = [sections("beam"), sections("free")].concat();
    free["motion"] = json!({"velocity": times(-rate, left([0.2, -0.7])), "spin": -rate});
    let scene = json!({
        "name": "whirling", "dimension": 2, "rotation": rate,
        "bodies": [rod("beam", [0.0, 0.0], out), free],
        "masses": [{"marker": "free.c", "mass": 0.4, "inertia": 0.1}],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "beam.a"]}],
        "outputs": outputs});
    let mut specimen = Specimen::new("whirling", scene);
    for (place, s) in PLACES {
        let name = |of: &str| format!("beam.{place}.{of}");
        let axial = 0.5 * LINE * (rate * LENGTH).powi(2) * (1.0 - s * s);
        let before = if s == 0.0 { 0.0 } else { -axial };
        specimen = specimen
            .claim(&name("axial_force"), "N", axial)
            .claim(&name("bending_moment"), "N.m", 0.0)
            .vector(&name("connectivity_force"), "N", times(before, out))
            .claim(&format!("free.{place}.axial_force"), "N", 0.0)
            .claim(&format!("free.{place}.bending_moment"), "N.m", 0.0);
    }
    specimen
}
