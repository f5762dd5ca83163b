//! Forces in sections of cables where something acts inside, on a cable that it moves with, and in a rotating frame.

use serde_json::{Value, json};

use super::initial::{AXIAL, LENGTH, bar};
use super::{clamp, left, times};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![drawn(), stiff(), turned_bar(), at_rest_outside()]
}

fn outputs(kind: &str, of: &str, at: &[&str]) -> Vec<Value> {
    let output = |place: &&str| json!({"kind": kind, "marker": format!("{of}.{place}")});
    at.iter().map(output).collect()
}

const ALONG: [f64; 2] = [1.0, 0.0];
const PLACES: [&str; 4] = ["root", "quarter", "middle", "tip"];

/// Bars that are drawn along their line: by forces in the middle, after which less is left, and at the tip;
/// and by a uniform load, of which every section carries what acts beyond it.
fn drawn() -> Specimen {
    let (inside, end, line) = (12.0, 18.0, 8.0);
    let pull = |name: &str, at: &str, force: f64| json!({"name": name, "kind": "force", "marker": at, "value": [force, 0.0]});
    // Nearer to the node than roundoff tells apart.
    let mut rod = bar("rod", [0.0, 0.0], ALONG, 2);
    rod["markers"]["near"] = json!(0.499_999_999_99);
    let read = [
        outputs("axial_force", "rod", &PLACES),
        outputs("axial_force", "rod", &["near"]),
        outputs("axial_force", "mast", &PLACES),
        // Where it is drawn, the slope is longer than one.
        outputs("direction", "rod", &["tip"]),
    ]
    .concat();
    let scene = json!({
        "name": "drawn", "dimension": 2, "initial": "static_equilibrium",
        "bodies": [rod, bar("mast", [0.0, 1.0], ALONG, 2)],
        "joints": [clamp("a", "rod.root"), clamp("b", "mast.root")],
        "loads": [pull("first", "rod.middle", inside), pull("second", "rod.tip", end),
                  {"name": "wind", "kind": "distributed_force", "body": "mast", "value": [line, 0.0]}],
        "outputs": read});
    let mut specimen = Specimen::new("drawn", scene)
        .claim_within("rod.near.axial_force", "N", end, 1e-7)
        .vector("rod.tip.direction", "", ALONG);
    for (place, s) in PLACES.into_iter().zip([0.0, 0.25, 0.5, 1.0]) {
        let on_rod = if s < 0.5 { inside + end } else { end };
        let on_mast = line * LENGTH * (1.0 - s);
        specimen = specimen
            .claim_within(&format!("rod.{place}.axial_force"), "N", on_rod, 1e-7)
            .claim_within(&format!("mast.{place}.axial_force"), "N", on_mast, 1e-7);
    }
    specimen
}

/// A beam so stiff that it stays straight, under moments in the middle and at the tip and a force across it.
fn stiff() -> Specimen {
    let (inside, end, force) = (0.5, 1.2, 2.0);
    let twist = |name: &str, at: &str, size: f64| json!({"name": name, "kind": "moment", "marker": at, "value": size});
    let scene = json!({
        "name": "stiff", "dimension": 2, "initial": "static_equilibrium",
        "bodies": [{"element": "cable", "name": "beam", "elements": 2,
                    "material": {"youngs_modulus": 1e9, "density": 30.0},
                    "section": {"area": 1e-2, "second_moment": 1e-4},
                    "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.0]}},
                    "markers": {"root": 0.0, "quarter": 0.25, "middle": 0.5, "tip": 1.0}}],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "beam.root"]}],
        "loads": [twist("first", "beam.middle", inside), twist("second", "beam.tip", end),
                  {"name": "lift", "kind": "force", "marker": "beam.tip", "value": [0.0, force]}],
        "outputs": outputs("bending_moment", "beam", &PLACES)});
    let mut specimen = Specimen::new("stiff", scene);
    for (place, s) in PLACES.into_iter().zip([0.0, 0.25, 0.5, 1.0]) {
        let moment = end + force * (1.0 - s) + if s < 0.5 { inside } else { 0.0 };
        specimen =
            specimen.claim_within(&format!("beam.{place}.bending_moment"), "N.m", moment, 1e-5);
    }
    specimen
}

/// A bar at rest in a frame that rotates: `r = A sin(a s)`, `a = w sqrt(rho/E)`, `N = EA (r' - 1)`.
fn turned_bar() -> Specimen {
    let rate = 3.0;
    let scene = json!({
        "name": "turned_bar", "dimension": 2, "rotation": rate, "initial": "static_equilibrium",
        "bodies": [bar("bar", [0.0, 0.0], ALONG, 4)],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "bar.root"]}],
        "outputs": outputs("axial_force", "bar", &["root", "middle"])});
    let a = rate * (30.0_f64 / 4000.0).sqrt();
    let force = |s: f64| AXIAL * ((a * s).cos() / (a * LENGTH).cos() - 1.0);
    Specimen::new("turned_bar", scene)
        .claim_within("bar.root.axial_force", "N", force(0.0), 1e-4)
        .claim_within("bar.middle.axial_force", "N", force(0.5 * LENGTH), 1e-4)
}

/// A free bar that rests outside of a frame that rotates: it goes round in there, and no section carries anything.
fn at_rest_outside() -> Specimen {
    let rate = 1.3;
    let mut body = bar("bar", [0.0, 0.4], ALONG, 2);
    body["motion"] = json!({"velocity": times(-rate, left([0.0, 0.4])), "spin": -rate});
    let read = [
        outputs("axial_force", "bar", &["quarter"]),
        outputs("bending_moment", "bar", &["quarter"]),
        outputs("connectivity_force", "bar", &["middle"]),
        outputs("acceleration", "bar", &["tip"]),
    ]
    .concat();
    let scene = json!({
        "name": "at_rest_outside", "dimension": 2, "rotation": rate, "bodies": [body],
        "outputs": read});
    Specimen::new("at_rest_outside", scene)
        .claim("bar.quarter.axial_force", "N", 0.0)
        .claim("bar.quarter.bending_moment", "N.m", 0.0)
        .vector("bar.middle.connectivity_force", "N", [0.0, 0.0])
        // It circles the origin of the frame the other way.
        .vector(
            "bar.tip.acceleration",
            "m/s2",
            times(-rate * rate, [LENGTH, 0.4]),
        )
}
