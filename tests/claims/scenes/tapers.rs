//! Cross sections by shape, at stations, and coupled.

use std::f64::consts::PI;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::coupled;
use super::space::vector;
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    let mut all = of(false);
    all.push(helix(false));
    all.extend(rods());
    all
}

/// Returns the specimens of rods.
pub fn rods() -> Vec<Specimen> {
    let mut rods = of(true);
    rods.extend([twisted(), helix(true)]);
    rods.extend(coupled::all());
    rods
}

fn of(is_rod: bool) -> Vec<Specimen> {
    let [uniform, tapered] = [false, true].map(|is_tapered| shapes(is_rod, is_tapered));
    vec![uniform, tapered, numbers(is_rod), bent(is_rod)]
}

pub const YOUNG: f64 = 3.0e6;
pub const SHEAR: f64 = 1.1e6;
const DENSITY: f64 = 700.0;
pub const LENGTH: f64 = 0.9;
const GRAVITY: f64 = 4.0;
const TORQUE: f64 = 3e-3;
/// Where the middle station of tapered bodies is.
const MIDDLE: f64 = 0.4;

/// A body along -y (plane) or -z (space) from a point, held at its first end.
pub fn body(name: &str, is_rod: bool, place: f64) -> Value {
    let (from, to) = if is_rod {
        (json!([place, 0.0, 0.0]), json!([place, 0.0, -LENGTH]))
    } else {
        (json!([place, 0.0]), json!([place, -LENGTH]))
    };
    let mut material = json!({"youngs_modulus": YOUNG, "density": DENSITY});
    if is_rod {
        material["shear_modulus"] = json!(SHEAR);
    }
    json!({"name": name, "element": if is_rod { "rod" } else { "cable" }, "elements": 16, "axial": "waves",
           "model": "flexible", "material": material, "shape": {"line": {"from": from, "to": to}},
           "markers": {"root": 0.0, "tip": 1.0}})
}

/// Bodies that hang at walls and, if they are rods, are twisted by a torque at the tip.
pub fn hung(name: &str, is_rod: bool, bodies: Vec<Value>) -> Value {
    let names: Vec<String> = bodies
        .iter()
        .map(|body| body["name"].as_str().expect("a name").into())
        .collect();
    let joint = |name: &String| json!({"name": format!("wall_{name}"), "kind": "weld", "markers": ["ground", format!("{name}.root")]});
    let load = |name: &String| {
        json!({"name": format!("twist_{name}"), "kind": "moment", "marker": format!("{name}.tip"),
                                      "value": [0.0, 0.0, -TORQUE]})
    };
    let mut outputs = Vec::new();
    for name in &names {
        outputs.push(json!({"kind": "reaction", "joint": format!("wall_{name}")}));
        outputs.push(json!({"kind": "position", "marker": format!("{name}.tip")}));
        if is_rod {
            outputs.push(json!({"kind": "orientation", "marker": format!("{name}.tip")}));
        }
    }
    let joints: Vec<Value> = names.iter().map(joint).collect();
    let loads: Vec<Value> = names.iter().filter(|_| is_rod).map(load).collect();
    let gravity = if is_rod {
        json!([0.0, 0.0, -GRAVITY])
    } else {
        json!([0.0, -GRAVITY])
    };
    json!({"name": name, "dimension": if is_rod { 3 } else { 2 }, "gravity": gravity, "bodies": bodies,
           "joints": joints, "loads": loads, "initial": "static_equilibrium",
           "accuracy": {"relative_tolerance": 1e-9}, "outputs": outputs})
}

/// Integral over the length of the body, by Simpson's rule between stations, of a function of the material coordinate.
fn integral(of: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for [from, to] in [[0.0, MIDDLE], [MIDDLE, 1.0]] {
        let pieces = 400;
        let h = (to - from) / f64::from(pieces);
        for k in 0..pieces {
            let at = from + h * f64::from(k);
            // Just inside: at a step both sides differ.
            let [a, b, c] = [at + 1e-12, at + 0.5 * h, at + h - 1e-12].map(&of);
            sum += (a + 4.0 * b + c) * h / 6.0;
        }
    }
    sum * LENGTH
}

/// A quantity that goes through three values at the stations, linear between them.
fn through([a, b, c]: [f64; 3]) -> impl Fn(f64) -> f64 {
    move |s| {
        if s < MIDDLE {
            a + (b - a) * s / MIDDLE
        } else {
            b + (c - b) * (s - MIDDLE) / (1.0 - MIDDLE)
        }
    }
}

/// What hangs is as heavy as its area says, longer by its weight, and a rod rotates by its torsion constant.
fn claimed(
    specimen: Specimen,
    (name, is_rod, place): (&str, bool, f64),
    area: impl Fn(f64) -> f64,
    torsion: impl Fn(f64) -> f64,
) -> Specimen {
    let weight = DENSITY * GRAVITY * integral(&area);
    let up = if is_rod { 3 } else { 2 };
    let mut specimen =
        specimen.claim_within(&format!("wall_{name}.reaction[{up}]"), "N", weight, 2e-6);
    if is_rod {
        let angle = TORQUE * integral(|s| 1.0 / (SHEAR * torsion(s)));
        // About -z, from where the first axis of the section is along y: the second column.
        let turned = [angle.sin(), angle.cos(), 0.0];
        for (row, value) in turned.into_iter().enumerate() {
            let of = format!("{name}.tip.orientation[{}]", 3 * row + 2);
            specimen = specimen.claim_within(&of, "", value, 2e-5);
        }
    }
    let side = format!("{name}.tip.position[1]");
    specimen.claim(&side, "m", place)
}

/// A shape, the keys of its lengths, and these at three stations, m.
type Sizes = (&'static str, [&'static str; 2], [[f64; 2]; 3]);

/// All shapes, uniform or tapered.
fn shapes(is_rod: bool, is_tapered: bool) -> Specimen {
    // Lengths at the stations, m.
    let sizes: [Sizes; 4] = [
        (
            "rectangle",
            ["width", "height"],
            [[0.05, 0.03], [0.04, 0.03], [0.04, 0.02]],
        ),
        (
            "ellipse",
            ["width", "height"],
            [[0.03, 0.05], [0.03, 0.03], [0.025, 0.03]],
        ),
        (
            "circle",
            ["radius", ""],
            [[0.02, 0.0], [0.025, 0.0], [0.01, 0.0]],
        ),
        (
            "tube",
            ["radius", "inner_radius"],
            [[0.03, 0.02], [0.03, 0.01], [0.02, 0.01]],
        ),
    ];
    let title = match (is_tapered, is_rod) {
        (false, false) => "shaped cables",
        (false, true) => "shaped rods",
        (true, false) => "tapered cables",
        (true, true) => "tapered rods",
    };
    let mut bodies = Vec::new();
    for (k, (shape, keys, lengths)) in sizes.iter().enumerate() {
        let section = |lengths: &[f64; 2]| {
            let mut of = json!({});
            for (key, length) in keys.iter().zip(lengths).filter(|(key, _)| !key.is_empty()) {
                of[key] = json!(length);
            }
            let mut shapes = json!({});
            shapes[shape] = of;
            json!({"shape": shapes})
        };
        let mut made = body(shape, is_rod, k as f64);
        if is_tapered {
            let places = [0.0, MIDDLE, 1.0].into_iter().zip(lengths);
            let station =
                |(at, lengths): (f64, &[f64; 2])| json!({"at": at, "section": section(lengths)});
            made["stations"] = places.map(station).collect();
        } else {
            made["section"] = section(&lengths[0]);
        }
        bodies.push(made);
    }
    let mut specimen = Specimen::new(title, hung("shapes", is_rod, bodies));
    for (k, (shape, _, lengths)) in sizes.iter().enumerate() {
        let at = |s: f64| {
            [0, 1].map(|i| {
                if is_tapered {
                    through([0, 1, 2].map(|j| lengths[j][i]))(s)
                } else {
                    lengths[0][i]
                }
            })
        };
        let (area, torsion) = (
            |s: f64| geometry(shape, at(s))[0],
            |s: f64| geometry(shape, at(s))[1],
        );
        specimen = claimed(specimen, (shape, is_rod, k as f64), area, torsion);
    }
    specimen
}

/// Area and torsion constant of a shape with these lengths. Rectangles: S. P. Timoshenko, J. N. Goodier, section 109.
fn geometry(shape: &str, [a, b]: [f64; 2]) -> [f64; 2] {
    match shape {
        "rectangle" => {
            let (long, short) = (a.max(b), a.min(b));
            let terms = (0..50).map(|k| f64::from(2 * k + 1));
            let sum: f64 = terms
                .map(|n| (0.5 * n * PI * long / short).tanh() / n.powi(5))
                .sum();
            let factor = 1.0 - 192.0 / PI.powi(5) * short / long * sum;
            [a * b, long * short.powi(3) * factor / 3.0]
        }
        "ellipse" => {
            let [p, q] = [0.5 * a, 0.5 * b];
            [PI * p * q, PI * (p * q).powi(3) / (p * p + q * q)]
        }
        "circle" => [PI * a * a, 0.5 * PI * a.powi(4)],
        _ => [PI * (a * a - b * b), 0.5 * PI * (a.powi(4) - b.powi(4))],
    }
}

/// Sections by numbers at stations, with a step in the middle.
fn numbers(is_rod: bool) -> Specimen {
    let (before, after) = ([2.0e-3, 1.5e-3], [1.0e-3, 1.2e-3]);
    let torsion = [[5.0e-7, 4.0e-7], [3.0e-7, 2.0e-7]];
    let section = |area: f64, torsion: f64| {
        if is_rod {
            json!({"area": area, "second_moments": [3e-7, 7e-7], "torsion_constant": torsion})
        } else {
            json!({"area": area, "second_moment": 3e-7})
        }
    };
    let mut made = body("stepped", is_rod, 0.0);
    made["stations"] = json!([
        {"at": 0.0, "section": section(before[0], torsion[0][0])},
        {"at": MIDDLE, "section": section(before[1], torsion[0][1])},
        {"at": MIDDLE, "section": section(after[0], torsion[1][0])},
        {"at": 1.0, "section": section(after[1], torsion[1][1])}]);
    let title = if is_rod {
        "stepped rod"
    } else {
        "stepped cable"
    };
    let specimen = Specimen::new(title, hung("stepped", is_rod, vec![made]));
    let stepped = |before: [f64; 2], after: [f64; 2]| {
        move |s: f64| {
            if s < MIDDLE {
                before[0] + (before[1] - before[0]) * s / MIDDLE
            } else {
                after[0] + (after[1] - after[0]) * (s - MIDDLE) / (1.0 - MIDDLE)
            }
        }
    };
    let [first, last] = torsion;
    claimed(
        specimen,
        ("stepped", is_rod, 0.0),
        stepped(before, after),
        stepped(first, last),
    )
}

/// Under moments at its tip alone a body bends by the integral of moment over bending stiffness: rods about the first axis
/// and, each for itself, about the second.
fn bent(is_rod: bool) -> Specimen {
    let (first, second) = ([3.0e-7, 2.0e-7, 1.5e-7], [7.0e-7, 5.0e-7, 6.0e-7]);
    let moment = 0.4;
    let made = |name: &str, place: f64| {
        let mut made = body(name, is_rod, place);
        let station = |k: usize| {
            let section = if is_rod {
                json!({"area": 2e-3, "second_moments": [first[k], second[k]], "torsion_constant": 5e-7})
            } else {
                json!({"area": 2e-3, "second_moment": first[k]})
            };
            json!({"at": ([0.0, MIDDLE, 1.0][k]), "section": section})
        };
        made["stations"] = [0, 1, 2].map(station).into();
        made
    };
    let title = if is_rod { "bent rods" } else { "bent cable" };
    let angle = |moments: [f64; 3]| integral(|s| moment / (YOUNG * through(moments)(s)));
    if !is_rod {
        let mut scene = hung("bent", false, vec![made("bow", 0.0)]);
        scene["gravity"] = json!([0.0, 0.0]);
        scene["loads"] =
            json!([{"name": "end", "kind": "moment", "marker": "bow.tip", "value": moment}]);
        scene["outputs"] = json!([{"kind": "angle", "marker": "bow.tip"}]);
        return Specimen::new(title, scene).claim_within(
            "bow.tip.angle",
            "rad",
            angle(first) - 0.5 * PI,
            1e-6,
        );
    }
    let mut scene = hung("bent", true, vec![made("one", 0.0), made("two", 1.0)]);
    scene["gravity"] = json!([0.0, 0.0, 0.0]);
    // Sections have their first axis along y: the second is along x.
    scene["loads"] = json!([
        {"name": "a", "kind": "moment", "marker": "one.tip", "value": [0.0, moment, 0.0]},
        {"name": "b", "kind": "moment", "marker": "two.tip", "value": [moment, 0.0, 0.0]}]);
    let (about_first, about_second) = (angle(first), angle(second));
    // The tangent, the first column: -z rotated about y and about x.
    let tangents = [
        ("one", [-about_first.sin(), 0.0, -about_first.cos()]),
        ("two", [0.0, about_second.sin(), -about_second.cos()]),
    ];
    let mut specimen = Specimen::new(title, scene);
    for (name, tangent) in tangents {
        for (row, value) in tangent.into_iter().enumerate() {
            let of = format!("{name}.tip.orientation[{}]", 3 * row + 1);
            specimen = specimen.claim_within(&of, "", value, 1e-6);
        }
    }
    specimen
}

/// Sections that are twisted without stress stand so.
fn twisted() -> Specimen {
    let section = json!({"shape": {"rectangle": {"width": 0.05, "height": 0.02}}});
    let mut made = body("blade", true, 0.0);
    made["markers"]["mid"] = json!(MIDDLE);
    made["stations"] = json!([{"at": 0.0, "section": section, "twist": 0.2},
        {"at": MIDDLE, "section": section, "twist": -0.5}, {"at": 1.0, "section": section, "twist": 0.9}]);
    made["axis"] = json!([0.0, 1.0, 0.0]);
    let scene = json!({"name": "twisted", "dimension": 3, "bodies": [made], "initial": "static_equilibrium",
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "blade.root"]}],
        "outputs": [{"kind": "orientation", "marker": "blade.root"}, {"kind": "orientation", "marker": "blade.mid"},
                    {"kind": "orientation", "marker": "blade.tip"}]});
    let mut specimen = Specimen::new("twisted sections", scene);
    for (marker, angle) in [("root", 0.2_f64), ("mid", -0.5), ("tip", 0.9)] {
        for (row, value) in [angle.sin(), angle.cos(), 0.0].into_iter().enumerate() {
            let of = format!("blade.{marker}.orientation[{}]", 3 * row + 2);
            specimen = specimen.claim(&of, "", value);
        }
    }
    specimen
}

/// A helix at rest stands as it is drawn: left-handed from the direction that it starts in.
fn helix(is_rod: bool) -> Specimen {
    let (radius, turns, rise) = (0.3, -0.8, 0.9);
    let mut made = body("coil", is_rod, 0.0);
    made["shape"] = json!({"helix": {"from": [0.2, -0.1, 0.4], "to": [0.2 + rise, -0.1, 0.4],
        "radius": radius, "turns": turns, "start": [0.5, 0.0, 2.0]}});
    // With a node at the marker in between.
    (made["elements"], made["markers"]["mid"]) = (json!(20), json!(0.4));
    made["section"] = if is_rod {
        json!({"shape": {"circle": {"radius": 0.01}}})
    } else {
        json!({"area": 1e-4, "second_moment": 0.0})
    };
    let places = [("root", 0.0), ("mid", 0.4), ("tip", 1.0)];
    let outputs = places.map(|(at, _)| json!({"kind": "position", "marker": format!("coil.{at}")}));
    let scene = json!({"name": "helix", "dimension": 3, "bodies": [made], "outputs": outputs});
    let title = if is_rod {
        "helix of a rod"
    } else {
        "helix of a cable"
    };
    let mut specimen = Specimen::new(title, scene);
    for (at, s) in places {
        // Along x, from +z: x cross z is -y, and the rotations are negative.
        let (sin, cos) = (2.0 * PI * turns * s).sin_cos();
        let place = Vector3::new(0.2 + rise * s, -0.1 - radius * sin, 0.4 + radius * cos);
        specimen = vector(specimen, &format!("coil.{at}.position"), "m", place);
    }
    specimen
}
