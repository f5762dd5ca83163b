//! Fluids along straight cables that are free: what is the same all along moves them as they are, which tells every term of the force
//! from the acceleration at the start (J. R. Morison and others 1950).

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::{dot, sum, times};
use crate::claims::specimen::Specimen;

/// Time of the start, s.
const T: f64 = 0.3;

const GRAVITY: [f64; 2] = [0.3, -2.0];
const SPEED: [f64; 2] = [0.5, -0.3];
const TANGENT: [f64; 2] = [0.6, 0.8];
/// Density and radius of the cables.
const DENSITY: f64 = 1250.0;
const RADIUS: f64 = 0.02;
const CURRENT: [f64; 2] = [1.1, 0.7];

pub fn all() -> Vec<Specimen> {
    vec![streams(), in_time(), inputs(), still(), rigid()]
}

/// A fluid as its formula knows it.
#[derive(Clone, Copy)]
struct Water {
    density: f64,
    current: [f64; 2],
    rate: [f64; 2],
    drag: f64,
    tangential: f64,
    added: f64,
    diameter: f64,
    area: f64,
    lifts: f64,
}

const CIRCLE: f64 = PI * RADIUS * RADIUS;

const WATER: Water = Water {
    density: 800.0,
    current: CURRENT,
    rate: [0.0, 0.0],
    drag: 1.2,
    tangential: 0.04,
    added: 0.9,
    diameter: 2.0 * RADIUS,
    area: CIRCLE,
    lifts: 1.0,
};

impl Water {
    /// Acceleration of a cable of this mass per length that moves at [`SPEED`].
    fn acceleration(&self, line: f64) -> [f64; 2] {
        let past = sum(self.current, times(-1.0, SPEED));
        let along = dot(past, TANGENT);
        let across = sum(past, times(-along, TANGENT));
        let faced = 0.5 * self.density * self.diameter;
        let displaced = self.density * self.area;
        let drag = sum(
            times(faced * self.drag * dot(across, across).sqrt(), across),
            times(faced * PI * self.tangential * along.abs() * along, TANGENT),
        );
        let inertia = times(displaced * (1.0 + self.added), self.rate);
        let weight = times(line - self.lifts * displaced, GRAVITY);
        let moved = line + self.added * displaced;
        times(1.0 / moved, sum(sum(drag, inertia), weight))
    }
}

fn cable(name: &str, section: &Value) -> Value {
    json!({"element": "cable", "name": name, "elements": 2, "material": {"youngs_modulus": 1e6, "density": DENSITY},
           "section": section, "shape": {"line": {"from": [0.0, 0.0], "to": TANGENT}},
           "motion": {"velocity": SPEED}, "markers": {"p": 0.3}})
}

fn circle() -> Value {
    json!({"shape": {"circle": {"radius": RADIUS}}})
}

fn whole() -> Value {
    json!({"density": 800.0, "current": CURRENT, "drag": 1.2, "tangential_drag": 0.04, "added_mass": 0.9})
}

fn with(key: &str, value: Value) -> Value {
    let mut keys = whole();
    keys[key] = value;
    keys
}

fn without(key: &str) -> Value {
    let mut keys = whole();
    keys.as_object_mut().expect("keys").remove(key);
    keys
}

/// A body with a fluid along it: its section, the keys of the fluid, the fluid that these mean, and mass per length of the body.
type Row = (&'static str, Value, Value, Water, f64);

fn scene(name: &str, rows: &[Row]) -> Value {
    let bodies: Vec<Value> = rows.iter().map(|row| cable(row.0, &row.1)).collect();
    let loads = rows.iter().map(|(name, _, keys, ..)| {
        let mut load = json!({"name": format!("by_{name}"), "kind": "fluid", "body": name});
        let keys = keys.as_object().expect("keys").clone();
        load.as_object_mut().expect("keys").extend(keys);
        load
    });
    let outputs = rows
        .iter()
        .map(|row| json!({"kind": "acceleration", "marker": format!("{}.p", row.0)}));
    json!({"name": name, "dimension": 2, "gravity": GRAVITY, "bodies": bodies,
           "loads": loads.collect::<Vec<_>>(), "outputs": outputs.collect::<Vec<_>>()})
}

fn claimed(mut specimen: Specimen, rows: &[Row]) -> Specimen {
    for (name, .., water, line) in rows {
        let of = format!("{name}.p.acceleration");
        specimen = specimen.vector(&of, "m/s2", water.acceleration(*line));
    }
    specimen
}

/// The fluid with something changed.
fn changed(change: fn(&mut Water)) -> Water {
    let mut water = WATER;
    change(&mut water);
    water
}

/// A round cable in a fluid.
fn round(name: &'static str, keys: Value, change: fn(&mut Water)) -> Row {
    (name, circle(), keys, changed(change), DENSITY * CIRCLE)
}

/// Every coefficient and size, and each left out.
fn streams() -> Specimen {
    let tube = json!({"shape": {"tube": {"radius": RADIUS, "inner_radius": 0.015}}});
    let hollow = DENSITY * PI * (RADIUS * RADIUS - 0.015 * 0.015);
    let numbers = json!({"area": 3e-4, "second_moment": 1e-8});
    let even = changed(|w| (w.diameter, w.area) = (2.0 * (3e-4 / PI).sqrt(), 3e-4));
    let rows: [Row; 11] = [
        round("all", whole(), |_| ()),
        ("tube", tube, whole(), WATER, hollow),
        ("numbers", numbers, whole(), even, DENSITY * 3e-4),
        round("wide", with("diameter", json!(0.05)), |w| {
            (w.diameter, w.area) = (0.05, 0.25 * PI * 0.05 * 0.05);
        }),
        round("area", with("area", json!(7e-4)), |w| w.area = 7e-4),
        round("sunk", with("buoyancy", json!(false)), |w| w.lifts = 0.0),
        round("lifted", with("buoyancy", json!(true)), |_| ()),
        round("slippery", without("tangential_drag"), |w| {
            w.tangential = 0.0;
        }),
        round("sharp", without("drag"), |w| w.drag = 0.0),
        round("light", without("added_mass"), |w| w.added = 0.0),
        round("calm", without("current"), |w| w.current = [0.0; 2]),
    ];
    claimed(Specimen::new("fluids", scene("fluids", &rows)), &rows)
}

/// Currents that change in time push as they are accelerated.
fn in_time() -> Specimen {
    let listed = json!({"table": [[0.1, 1.2], [0.9, 2.8], [1.3, -5.0]]});
    let swung = json!(["1.3*t+0.5", "-0.7*cos(t)"]);
    let line = DENSITY * CIRCLE;
    let swings = Water {
        current: [1.3 * T + 0.5, -0.7 * T.cos()],
        rate: [1.3, 0.7 * T.sin()],
        ..WATER
    };
    let grows = Water {
        current: [1.6, 0.7],
        rate: [2.0, 0.0],
        ..WATER
    };
    let steady = Water {
        current: [0.7, 1.6],
        rate: [0.0, 2.0],
        ..WATER
    };
    let rows: [Row; 3] = [
        ("swung", circle(), with("current", swung), swings, line),
        (
            "listed",
            circle(),
            with("current", json!([listed, 0.7])),
            grows,
            line,
        ),
        (
            "across",
            circle(),
            with("current", json!([0.7, listed])),
            steady,
            line,
        ),
    ];
    let specimen = Specimen::new("fluids_in_time", scene("fluids_in_time", &rows));
    claimed(specimen.from(T), &rows)
}

/// Currents that the master sets: with a start of their own, with that of the fluid, later.
fn inputs() -> Specimen {
    let line = DENSITY * CIRCLE;
    let of = |current| Water { current, ..WATER };
    let rows: [Row; 5] = [
        ("aside", circle(), whole(), WATER, line),
        ("started", circle(), whole(), of([0.2, -0.9]), line),
        ("given", circle(), whole(), WATER, line),
        ("none", circle(), without("current"), of([0.0; 2]), line),
        ("set", circle(), without("current"), of([-0.4, 0.8]), line),
    ];
    let mut scene = scene("fluid_inputs", &rows);
    let input = |of: &str| json!({"kind": "current", "load": format!("by_{of}")});
    let mut inputs = ["started", "given", "none", "set"].map(input);
    inputs[0]["start"] = json!([0.2, -0.9]);
    scene["inputs"] = json!(inputs);
    let specimen = Specimen::new("fluid_inputs", scene)
        .set("by_set.current[1]", -0.4)
        .set("by_set.current[2]", 0.8);
    claimed(specimen, &rows)
        .vector("by_started.current", "m/s", [0.2, -0.9])
        .vector("by_given.current", "m/s", CURRENT)
}

/// In a fluid at rest a taut line swings slower by the root of the mass that it moves, and what it loses is counted.
fn still() -> Specimen {
    let (tension, length, added) = (40.0, 2.0, 0.9 * 800.0 * CIRCLE);
    let line = DENSITY * CIRCLE;
    let speed = 0.4;
    let scene = json!({
        "name": "still", "dimension": 2, "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [{"element": "cable", "name": "line", "elements": 8,
                    "material": {"youngs_modulus": 1e6, "density": DENSITY}, "section": circle(),
                    "shape": {"line": {"from": [0.0, 0.0], "to": [length, 0.0]}},
                    "motion": {"velocity": [0.0, speed]}, "markers": {"a": 0.0, "b": 1.0}}],
        "loads": [{"name": "sea", "kind": "fluid", "body": "line", "density": 800.0, "drag": 1.2, "added_mass": 0.9},
                  {"name": "left", "kind": "force", "marker": "line.a", "value": [-tension, 0.0]},
                  {"name": "right", "kind": "force", "marker": "line.b", "value": [tension, 0.0]}],
        "outputs": [{"kind": "work"}, {"kind": "energy"}, {"kind": "momentum"}, {"kind": "velocity", "marker": "line.a"}]});
    // v' = -k v^2.
    let moved = line + added;
    let k = 0.5 * 800.0 * 1.2 * 2.0 * RADIUS / moved;
    let t = 0.8;
    let slowed = speed / (1.0 + k * speed * t);
    let energy = |speed: f64| 0.5 * moved * length * speed * speed;
    Specimen::new("still", scene)
        .claim("momentum[2]", "N.s", moved * length * speed)
        .at(t)
        .claim_within("line.a.velocity[2]", "m/s", slowed, 1e-7)
        .claim_within(
            "energy.dissipated",
            "J",
            energy(speed) - energy(slowed),
            1e-6,
        )
}

/// What does not bend, in a current that grows along it: drag of `s^2`, and its moment about the middle.
fn rigid() -> Specimen {
    let (length, rate) = (2.0, 1.5);
    let scene = json!({
        "name": "rigid_in_current", "dimension": 2,
        "bodies": [{"element": "cable", "name": "bar", "model": "rigid", "material": {"youngs_modulus": 1e6, "density": DENSITY},
                    "section": circle(), "shape": {"line": {"from": [0.0, 0.0], "to": [length, 0.0]}},
                    "markers": {"middle": 0.5, "end": 1.0}}],
        "loads": [{"name": "sea", "kind": "fluid", "body": "bar", "density": 800.0, "drag": 1.2, "added_mass": 0.9,
                   "current": [0.0, format!("{rate}*s")]}],
        "outputs": [{"kind": "acceleration", "marker": "bar.middle"},
                    {"kind": "angular_acceleration", "marker": "bar.middle"},
                    {"kind": "bending_moment", "marker": "bar.middle"}]});
    let pushed = 0.5 * 800.0 * 1.2 * 2.0 * RADIUS * rate * rate;
    let moved = (DENSITY + 0.9 * 800.0) * CIRCLE;
    let turned = pushed / (moved * length);
    // Of the half after the middle, about it: the load less inertia.
    let half = length / 2.0;
    let by_load = pushed * (1.0 / 2.0 + 2.0 / 3.0 + 1.0 / 4.0) / 4.0;
    let by_inertia = pushed / 3.0 / 2.0 + moved * turned * half / 3.0;
    let loaded = (by_load - by_inertia) * half * half;
    Specimen::new("rigid_in_current", scene)
        .vector(
            "bar.middle.acceleration",
            "m/s2",
            [0.0, pushed / (3.0 * moved)],
        )
        .claim("bar.middle.angular_acceleration", "rad/s2", turned)
        .claim("bar.middle.bending_moment", "N.m", loaded)
}
