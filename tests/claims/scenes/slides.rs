//! Sliders on lines and on cables, and links that hold a distance.

use serde_json::{Value, json};

use super::{clamp, dot, extra, left, sum, times};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        line(),
        links(),
        along(),
        bead(),
        carried(),
        on_an_arc(),
        put_on(),
    ]
}

fn bead_at(name: &str, mass: f64, place: [f64; 2], speed: [f64; 2]) -> Value {
    json!({"element": "rigid", "name": name, "mass": mass, "inertia": 0.0, "position": place,
           "motion": {"velocity": speed}, "markers": {"c": [0.0, 0.0]}})
}

/// Beads on inclined lines: one is moved to its line, one is where it is.
fn line() -> Specimen {
    let (m, g, point) = (1.4, [0.5, -9.0], [0.2, 0.3]);
    let along = [0.8, -0.6];
    let scene = json!({
        "name": "line_slider", "dimension": 2, "gravity": g,
        "bodies": [bead_at("bead", m, [1.0, -0.28], [0.0, 0.0]), bead_at("other", 0.9, [0.0, 1.0], [0.0, 0.0]), extra()],
        "joints": [{"name": "guide", "kind": "point_on_line", "markers": ["ground", "bead.c"], "point": point,
                    "direction": [1.6, -1.2]},
                   {"name": "as_is", "kind": "point_on_line", "markers": ["ground", "other.c"], "direction": [0.0, 2.0]}],
        "outputs": [{"kind": "position", "marker": "bead.c"}, {"kind": "acceleration", "marker": "bead.c"},
                    {"kind": "reaction", "joint": "guide"}, {"kind": "position", "marker": "other.c"},
                    {"kind": "acceleration", "marker": "other.c"}]});
    // The shortest way to the line.
    let from = sum([1.0, -0.28], times(-1.0, point));
    let foot = sum(point, times(dot(from, along), along));
    let normal = left(along);
    Specimen::new("line_slider", scene)
        .vector("bead.c.position", "m", foot)
        .vector("bead.c.acceleration", "m/s2", times(dot(g, along), along))
        .vector("guide.reaction", "N", times(-m * dot(g, normal), normal))
        .vector("other.c.position", "m", [0.0, 1.0])
        .vector("other.c.acceleration", "m/s2", [0.0, -9.0])
}

/// Beads on massless links: one longer than it starts, one as long as it starts; two free beads on a link.
fn links() -> Specimen {
    let (m, g, point, length, speed) = (1.4, [0.0, -9.0], [0.3, 1.1], 1.05, 2.0);
    let scene = json!({
        "name": "links", "dimension": 2, "gravity": g,
        "bodies": [bead_at("bead", m, [0.3, 0.1], [speed, 0.0]), bead_at("other", m, [2.0, 0.1], [speed, 0.0]),
                   bead_at("a", 0.6, [-1.0, 0.0], [0.0, 0.0]), bead_at("b", 0.9, [-1.0, 0.5], [0.0, 0.0]), extra()],
        "joints": [{"name": "link", "kind": "distance", "markers": ["ground", "bead.c"], "point": point,
                    "length": length},
                   {"name": "as_is", "kind": "distance", "markers": ["ground", "other.c"], "point": [2.0, 1.1]},
                   {"name": "pair", "kind": "distance", "markers": ["a.c", "b.c"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "b.c", "value": [0.0, 4.0]}],
        "outputs": [{"kind": "position", "marker": "bead.c"}, {"kind": "reaction", "joint": "link"},
                    {"kind": "reaction", "joint": "as_is"}, {"kind": "acceleration", "marker": "bead.c"},
                    {"kind": "reaction", "joint": "pair"}]});
    let tension = |l: f64| m * (9.0 + speed * speed / l);
    Specimen::new("links", scene)
        .vector("bead.c.position", "m", [0.3, 1.1 - length])
        .vector("bead.c.acceleration", "m/s2", [0.0, speed * speed / length])
        .vector("link.reaction", "N", [0.0, tension(length)])
        .vector("as_is.reaction", "N", [0.0, tension(1.0)])
        .vector("pair.reaction", "N", [0.0, -4.0 * 0.6 / 1.5])
}

/// A bead hangs in the middle of a beam that is clamped at both ends: the beam carries its weight. A
/// spring along the beam, at rest, keeps it there.
fn along() -> Specimen {
    let (m, g) = (1.4, 9.0);
    let beam = |name: &str, x: f64| {
        json!({"element": "cable", "name": name, "elements": 4,
               "material": {"youngs_modulus": 1e7, "density": 1.0},
               "section": {"area": 1e-3, "second_moment": 1e-5},
               "shape": {"line": {"from": [x, 0.0], "to": [x + 1.0, 0.0]}}, "markers": {"root": 0.0, "tip": 1.0}})
    };
    let keep = |name: &str, of: &str, x: f64| json!({"name": name, "kind": "spring_damper", "markers": ["ground", of], "point": [x, 0.0], "stiffness": 100.0});
    let scene = json!({
        "name": "along", "dimension": 2, "gravity": [0.0, -g], "initial": "static_equilibrium",
        "bodies": [beam("beam", 0.0), beam("other", 2.0), bead_at("bead", m, [0.5, 0.0], [0.0, 0.0]),
                   bead_at("second", 0.9, [2.5, 0.0], [0.0, 0.0])],
        "joints": [clamp("a", "beam.root"), clamp("b", "beam.tip"), clamp("c", "other.root"),
                   clamp("d", "other.tip"),
                   {"name": "ring", "kind": "point_on_cable", "markers": ["beam", "bead.c"]},
                   {"name": "ring2", "kind": "point_on_cable", "markers": ["other", "second.c"]}],
        "loads": [keep("keep", "bead.c", -0.5), keep("keep2", "second.c", 1.5)],
        "outputs": [{"kind": "travel", "joint": "ring"}, {"kind": "travel", "joint": "ring2"},
                    {"kind": "reaction", "joint": "ring"}, {"kind": "reaction", "joint": "ring2"}]});
    Specimen::new("along", scene)
        .claim_within("ring.travel", "m", 0.5, 1e-6)
        .claim_within("ring2.travel", "m", 0.5, 1e-6)
        .vector_within("ring.reaction", "N", [0.0, m * g], 1e-6)
        .vector_within("ring2.reaction", "N", [0.0, 0.9 * g], 1e-6)
        // It stays.
        .at(0.5)
        .vector_within("ring.reaction", "N", [0.0, m * g], 1e-6)
}

/// Beads that coast along straight cables: the second slide is where the second bead is.
fn bead() -> Specimen {
    let rod = |name: &str, y: f64| {
        json!({"element": "cable", "name": name, "elements": 3,
               "material": {"youngs_modulus": 1e5, "density": 1000.0},
               "section": {"area": 1e-3, "second_moment": 1e-7},
               "shape": {"line": {"from": [0.0, y], "to": [0.6, y + 0.8]}}, "markers": {"root": 0.0}})
    };
    let start = |s: f64, y: f64| [0.6 * s, y + 0.8 * s];
    // Its second marker is a way of 0.1 along the cable from its first.
    let mut long = bead_at("long", 0.7, start(0.6, 2.0), [-0.12, -0.16]);
    long["inertia"] = json!(0.1);
    long["markers"]["end"] = json!([0.06, 0.08]);
    let scene = json!({
        "name": "bead", "dimension": 2,
        "bodies": [rod("first", 0.0), rod("second", 2.0), bead_at("a", 0.5, start(0.35, 0.0), [0.3, 0.4]), long],
        "joints": [{"name": "pin", "kind": "weld", "markers": ["ground", "first.root"]},
                   {"name": "pin2", "kind": "weld", "markers": ["ground", "second.root"]},
                   {"name": "ring", "kind": "point_on_cable", "markers": ["first", "a.c"]},
                   {"name": "ring2", "kind": "point_on_cable", "markers": ["second", "long.c"]}],
        "outputs": [{"kind": "travel", "joint": "ring2"}, {"kind": "velocity", "marker": "a.c"}]});
    Specimen::new("bead", scene)
        .claim("ring2.travel", "m", 0.6)
        .vector("a.c.velocity", "m/s", [0.3, 0.4])
        .at(0.4)
        .claim_within("ring2.travel", "m", 0.52, 1e-9)
}

/// A bead that moves outwards along a cable that rotates: only the force across the cable acts on it, `2 w u`.
fn carried() -> Specimen {
    let (mass, rate, speed, at) = (0.5, 0.8, 0.6, 0.35);
    let turn = |name: &str, of: &str| json!({"name": name, "kind": "angle", "marker": of, "value": format!("{rate}*t")});
    let place = |name: &str, of: &str, value: Value| json!({"name": name, "kind": "position", "marker": of, "value": value});
    let scene = json!({
        "name": "carried", "dimension": 2,
        "bodies": [{"element": "cable", "name": "arm", "elements": 1,
                    "material": {"youngs_modulus": 1e5, "density": 1000.0},
                    "section": {"area": 1e-3, "second_moment": 1e-7},
                    "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.0]}},
                    "motion": {"spin": rate}, "markers": {"root": 0.0, "tip": 1.0}},
                   bead_at("bead", mass, [at, 0.0], [speed, rate * at])],
        "joints": [{"name": "ring", "kind": "point_on_cable", "markers": ["arm", "bead.c"]}],
        "motions": [place("hold", "arm.root", json!([0.0, 0.0])), turn("first", "arm.root"),
                    place("swing", "arm.tip", json!([format!("cos({rate}*t)"), format!("sin({rate}*t)")])),
                    turn("second", "arm.tip")],
        "outputs": [{"kind": "acceleration", "marker": "bead.c"}, {"kind": "reaction", "joint": "ring"}]});
    let across = 2.0 * rate * speed;
    Specimen::new("carried", scene)
        .vector("bead.c.acceleration", "m/s2", [0.0, across])
        .vector("ring.reaction", "N", [0.0, mass * across])
}

/// A bead that coasts through the lowest point of a heavy cable on an arc of radius 1 m.
fn on_an_arc() -> Specimen {
    let (half, speed) = (0.6_f64, 0.7);
    let scene = json!({
        "name": "on_an_arc", "dimension": 2,
        "bodies": [{"element": "cable", "name": "rail", "elements": 8,
                    "material": {"youngs_modulus": 1e5, "density": 1e9},
                    "section": {"area": 1e-3, "second_moment": 1e-7},
                    "shape": {"arc": {"from": [-half.sin(), 0.0], "to": [half.sin(), 0.0], "length": 2.0 * half}},
                    "markers": {"first": 0.0, "last": 1.0}},
                   bead_at("bead", 1e-3, [0.0, half.cos() - 1.0], [speed, 0.0])],
        "joints": [clamp("a", "rail.first"), clamp("b", "rail.last"),
                   {"name": "ring", "kind": "point_on_cable", "markers": ["rail", "bead.c"]}],
        "outputs": [{"kind": "acceleration", "marker": "bead.c"}]});
    // The curvature is that of the elements.
    Specimen::new("on_an_arc", scene).vector_within(
        "bead.c.acceleration",
        "m/s2",
        [0.0, speed * speed],
        5e-3,
    )
}

/// A bead that is described beside a heavy rail is put on it, by the shortest way.
fn put_on() -> Specimen {
    let (along, way) = ([0.6, 0.8], 0.35);
    let beside = sum(times(way, along), times(0.05, left(along)));
    let scene = json!({
        "name": "put_on", "dimension": 2,
        "bodies": [{"element": "cable", "name": "rail", "elements": 2,
                    "material": {"youngs_modulus": 1e5, "density": 1e12},
                    "section": {"area": 1e-3, "second_moment": 1e-7},
                    "shape": {"line": {"from": [0.0, 0.0], "to": along}}, "markers": {"first": 0.0, "last": 1.0}},
                   bead_at("bead", 1e-3, beside, [0.0, 0.0])],
        "joints": [clamp("a", "rail.first"), clamp("b", "rail.last"),
                   {"name": "ring", "kind": "point_on_cable", "markers": ["rail", "bead.c"]}],
        "outputs": [{"kind": "position", "marker": "bead.c"}, {"kind": "travel", "joint": "ring"}]});
    Specimen::new("put_on", scene)
        .vector("bead.c.position", "m", times(way, along))
        .claim("ring.travel", "m", way)
}
