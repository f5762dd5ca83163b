//! Cantilevers with sections that are polygons, against closed forms of thin walls and of bending about two axes.

use serde_json::{Value, json};

use super::runs::{Run, is_near};

const YOUNG: f64 = 2.1e11;
const SHEAR: f64 = 8e10;
const LENGTH: f64 = 4.0;

/// A cantilever along x whose first axis is along y, under a force at the centroid of its end.
fn cantilever(element: &str, shape: &Value, force: [f64; 3], points: &Value) -> Run {
    Run::started(&json!({"name": "cantilever", "dimension": 3,
        "bodies": [{"name": "bar", "element": element, "elements": 4, "model": "flexible",
            "material": {"youngs_modulus": YOUNG, "shear_modulus": SHEAR, "density": 7850},
            "section": {"shape": shape}, "axis": [0, 1, 0], "shape": {"line": {"from": [0, 0, 0], "to": [LENGTH, 0, 0]}},
            "markers": {"root": 0, "tip": 1}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "bar.root"]}],
        "loads": [{"name": "push", "kind": "force", "marker": "bar.tip", "value": force}],
        "outputs": [{"kind": "position", "marker": "bar.tip"}, {"kind": "orientation", "marker": "bar.tip"},
            {"kind": "stress", "marker": "bar.root", "points": points},
            {"kind": "torsion_stress", "marker": "bar.root", "points": points}],
        "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-10}}))
}

/// The angle by which the end is twisted, from the first axis there.
fn twist(run: &mut Run) -> f64 {
    let [y, z] = [5, 8].map(|k| run.read(&format!("bar.tip.orientation[{k}]")));
    z.atan2(y)
}

/// A force through the centroid of a thin channel twists it by `V e L / (G J)`, with the shear centre `b^2 h^2 t / (4 I)` behind the middle of
/// the web and `J` a third of the lengths times the cube of the thickness (S. P. Timoshenko, Strength of Materials II, 3rd ed. (1956), section 54).
/// The torque about the shear centre stresses walls by `T t / J`; the centroid goes down with the twist, too.
#[test]
fn a_force_through_the_centroid_of_a_channel_twists_it() {
    let (b, h, t, push): (f64, f64, f64, f64) = (0.1, 0.2, 2e-3, 10.0);
    let shape = json!({"c": {"width": b + 0.5 * t, "height": h + t, "web_thickness": t, "flange_thickness": t}});
    let area = t * (2.0 * b + h);
    let (center, second) = (b * b * t / area, t * (h.powi(3) / 12.0 + 0.5 * b * h * h));
    let arm = center + b * b * h * h * t / (4.0 * second);
    let constant = area * t * t / 3.0;
    let point = json!([
        [0.5 * b - center, 0.5 * (h + t)],
        [0.7 * b - center, -0.5 * (h + t)]
    ]);
    let mut beam = cantilever("beam", &shape, [0.0, 0.0, push], &point);
    let torque = push * arm;
    let angle = torque * LENGTH / (SHEAR * constant);
    is_near(twist(&mut beam) / angle, 1.0, 0.015);
    let bent = push * LENGTH.powi(3) / (3.0 * YOUNG * second);
    let down = beam.read("bar.tip.position[3]");
    is_near(down / (bent + angle * arm), 1.0, 0.02);
    for k in 1..=2 {
        let stress = beam.read(&format!("bar.root.torsion_stress[{k}]"));
        is_near(stress / (torque * t / constant), 1.0, 0.02);
    }
    // A rod has its shear centre on the line.
    let mut rod = cantilever("rod", &shape, [0.0, 0.0, push], &point);
    is_near(twist(&mut rod), 0.0, 1e-12);
    is_near(rod.read("bar.tip.position[3]") / bent, 1.0, 2e-3);
}

/// Integrals of `y^2`, `z^2` and `y z` over rectangles given by their middles and edges, about the centroid, which is returned too.
fn moments(parts: &[[f64; 4]]) -> ([f64; 3], [f64; 2]) {
    let area: f64 = parts.iter().map(|[_, _, a, b]| a * b).sum();
    let mean = |k: usize| parts.iter().map(|of| of[k] * of[2] * of[3]).sum::<f64>() / area;
    let center = [mean(0), mean(1)];
    let mut sums = [0.0; 3];
    for [y, z, a, b] in parts {
        let [y, z] = [y - center[0], z - center[1]];
        sums[0] += a * b * (y * y + a * a / 12.0);
        sums[1] += a * b * (z * z + b * b / 12.0);
        sums[2] += a * b * y * z;
    }
    (sums, center)
}

/// A section with a product of inertia bends to the side, `I^-1 F L^3 / (3 E)`, and its stress is linear in both coordinates: an angle as a rod,
/// and as a beam a letter Z, whose shear centre is its centroid.
#[test]
fn a_section_with_a_product_of_inertia_bends_to_the_side() {
    let angle = json!({"l": {"width": 0.1, "height": 0.15, "web_thickness": 0.01, "flange_thickness": 0.012}});
    let legs = [[0.005, 0.075, 0.01, 0.15], [0.055, 0.006, 0.09, 0.012]];
    let letter = json!({"polygon": {"outline": [[0, 0], [0.06, 0], [0.06, 0.01], [0.01, 0.01], [0.01, 0.11], [-0.05, 0.11], [-0.05, 0.1], [0, 0.1]]}});
    let walls = [
        [0.005, 0.055, 0.01, 0.11],
        [0.035, 0.005, 0.05, 0.01],
        [-0.025, 0.105, 0.05, 0.01],
    ];
    // Shear adds to the beam's deflection.
    for (element, shape, parts, within) in [
        ("rod", angle, &legs[..], 2e-5),
        ("beam", letter, &walls[..], 3e-3),
    ] {
        let ([y2, z2, yz], center) = moments(parts);
        let corner = [
            parts[0][0] - 0.5 * parts[0][2],
            parts[0][1] + 0.4 * parts[0][3],
        ];
        let corner = [0, 1].map(|k| corner[k] - center[k]);
        for force in [[0.0, 2.0, 0.0], [0.0, 0.0, 3.0]] {
            let determinant = y2 * z2 - yz * yz;
            let across = [
                (z2 * force[1] - yz * force[2]) / determinant,
                (y2 * force[2] - yz * force[1]) / determinant,
            ];
            let mut run = cantilever(element, &shape, force, &json!([corner]));
            let size = LENGTH.powi(3) / (3.0 * YOUNG);
            let largest = size * across[0].hypot(across[1]);
            for k in 0..2 {
                let found = run.read(&format!("bar.tip.position[{}]", k + 2));
                is_near(found / largest, size * across[k] / largest, within);
            }
            // What is bent towards a force is pressed there.
            let stress = -LENGTH * (across[0] * corner[0] + across[1] * corner[1]);
            let found = run.read("bar.root.stress[1]");
            is_near(found / stress, 1.0, 1e-5);
            if element == "beam" {
                is_near(twist(&mut run), 0.0, 1e-6);
            }
        }
    }
}

/// Under the name `auto` a channel becomes a beam, a letter I a rod.
#[test]
fn a_shear_center_apart_from_the_centroid_asks_for_a_beam() {
    for (shape, wanted) in [("c", "beam"), ("i", "rod")] {
        let sizes =
            json!({"width": 0.1, "height": 0.2, "web_thickness": 0.01, "flange_thickness": 0.01});
        let scene = json!({"name": "open", "dimension": 3,
            "bodies": [{"name": "bar", "element": "auto", "elements": 4,
                "material": {"youngs_modulus": YOUNG, "shear_modulus": SHEAR, "density": 7850},
                "section": {"shape": {shape: sizes}}, "shape": {"line": {"from": [0, 0, 0], "to": [40, 0, 0]}}}]});
        let scene = flexbody::scene::Scene::from_json(&scene.to_string()).expect("a scene");
        let chosen = scene.choose_elements().expect("elements");
        assert_eq!(chosen[0].element(), wanted, "{}", chosen[0].why);
    }
}
