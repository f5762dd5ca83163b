//! Cross sections that are polygons or hollow ellipses: bodies that hang weigh what the areas of their sections say. What torsion, bending and
//! shear of these sections are is claimed in `tests/laws/profiles.rs`.

use std::f64::consts::PI;

use serde_json::{Value, json};

use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    let titles = [
        ("cable", "profiles of cables", "tapered profiles of cables"),
        ("rod", "profiles of rods", "tapered profiles of rods"),
        ("beam", "profiles of beams", "tapered profiles of beams"),
    ];
    let both = titles.into_iter().flat_map(|(element, uniform, tapered)| {
        [(element, uniform, false), (element, tapered, true)]
    });
    both.map(|(element, title, is_tapered)| hung(element, title, is_tapered))
        .collect()
}

const LENGTH: f64 = 0.8;
const DENSITY: f64 = 900.0;
const GRAVITY: f64 = 3.0;

/// Keys and sizes of each shape but the polygon at the first end, m, and its area from them.
type Walls = (&'static str, [f64; 4], fn([f64; 4]) -> f64);

const WALLS: [Walls; 5] = [
    ("box", [0.08, 0.10, 0.02, 0.03], |[w, h, t, f]| {
        w * h - (w - 2.0 * t) * (h - 2.0 * f)
    }),
    ("i", [0.08, 0.10, 0.03, 0.02], |[w, h, t, f]| {
        2.0 * w * f + t * (h - 2.0 * f)
    }),
    ("c", [0.07, 0.10, 0.02, 0.03], |[w, h, t, f]| {
        2.0 * w * f + t * (h - 2.0 * f)
    }),
    ("t", [0.09, 0.08, 0.03, 0.02], |[w, h, t, f]| {
        w * f + t * (h - f)
    }),
    ("l", [0.06, 0.09, 0.02, 0.03], |[w, h, t, f]| {
        w * f + t * (h - f)
    }),
];
const KEYS: [&str; 4] = ["width", "height", "web_thickness", "flange_thickness"];
const RING: [f64; 3] = [0.08, 0.06, 0.04];
/// A square with a triangular hole.
const SQUARE: [[f64; 2]; 4] = [[0.1, 0.2], [0.2, 0.2], [0.2, 0.3], [0.1, 0.3]];
const HOLE: [[f64; 2]; 3] = [[0.12, 0.22], [0.17, 0.23], [0.15, 0.27]];

/// Name, section and area, with lengths so many times as large.
fn sections(t: f64) -> Vec<(&'static str, Value, f64)> {
    let mut all: Vec<_> = (WALLS.iter())
        .map(|(shape, sizes, area)| {
            let mut of = json!({});
            for (key, size) in KEYS.iter().zip(sizes) {
                of[key] = json!(size * t);
            }
            (*shape, of, area(*sizes) * t * t)
        })
        .collect();
    let [width, height, inner] = RING;
    let ring = json!({"width": width * t, "height": height * t, "inner_width": inner * t});
    let part = inner / width;
    let area = 0.25 * PI * width * height * (1.0 - part * part) * t * t;
    all.push(("hollow_ellipse", ring, area));
    let scaled = |corners: &[[f64; 2]]| {
        json!(
            corners
                .iter()
                .map(|of| of.map(|at| at * t))
                .collect::<Vec<_>>()
        )
    };
    // The hole by the products of its edges.
    let [a, b, c] = HOLE;
    let hole = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    let polygon = json!({"outline": scaled(&SQUARE), "holes": [scaled(&HOLE)]});
    all.push(("polygon", polygon, (0.01 - hole) * t * t));
    all
}

fn hung(element: &'static str, title: &'static str, is_tapered: bool) -> Specimen {
    let is_planar = element == "cable";
    // Sizes at the last end over those at the first.
    let last = if is_tapered { 0.9 } else { 1.0 };
    let (mut bodies, mut joints, mut outputs) = (vec![], vec![], vec![]);
    let (first, second) = (sections(1.0), sections(last));
    for (k, (name, shape, _)) in first.iter().enumerate() {
        let at = |z: f64| {
            if is_planar {
                json!([k as f64, z])
            } else {
                json!([k as f64, 0.0, z])
            }
        };
        let mut material = json!({"youngs_modulus": 1e8, "density": DENSITY});
        if !is_planar {
            material["shear_modulus"] = json!(4e7);
        }
        let mut body = json!({"name": name, "element": element, "elements": 2, "axial": "waves", "material": material,
            "model": "flexible", "shape": {"line": {"from": at(0.0), "to": at(-LENGTH)}}, "markers": {"root": 0.0}});
        let of = |shape: &Value| json!({"shape": {*name: shape}});
        if is_tapered {
            body["stations"] = json!([{"at": 0.0, "section": of(shape)}, {"at": 1.0, "section": of(&second[k].1)}]);
        } else {
            body["section"] = of(shape);
        }
        bodies.push(body);
        let joint = format!("wall_{name}");
        joints.push(
            json!({"name": joint, "kind": "weld", "markers": ["ground", format!("{name}.root")]}),
        );
        outputs.push(json!({"kind": "reaction", "joint": joint}));
    }
    let gravity = if is_planar {
        json!([0.0, -GRAVITY])
    } else {
        json!([0.0, 0.0, -GRAVITY])
    };
    let scene = json!({"name": "profiles", "dimension": if is_planar { 2 } else { 3 }, "gravity": gravity,
        "bodies": bodies, "joints": joints, "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-9}, "outputs": outputs});
    let mut specimen = Specimen::new(title, scene);
    for (name, _, area) in first {
        // Sizes change linearly, so that the mean of the area is that of a square.
        let mean = area * (1.0 + last + last * last) / 3.0;
        let weight = DENSITY * GRAVITY * LENGTH * mean;
        let up = if is_planar { 2 } else { 3 };
        let of = format!("wall_{name}.reaction[{up}]");
        specimen = specimen.claim_within(&of, "N", weight, 2e-6 * weight);
    }
    specimen
}
