//! Damping ratios of first modes: they become Kelvin-Voigt times, `2 zeta / omega` where all of the energy is strain of the body. A mode decays
//! by `zeta omega`, one of another frequency by `zeta omega_2^2 / omega_1`.

use serde_json::{Value, json};

use super::clamp;
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        cantilever(),
        supported(),
        in_space("rod"),
        in_space("beam"),
        beside_a_spring(),
    ]
}

const RATIO: f64 = 0.02;
const LENGTH: f64 = 2.0;
const YOUNG: f64 = 2e9;
const DENSITY: f64 = 1200.0;
const AREA: f64 = 1e-3;
const MOMENT: f64 = 1e-8;
/// Roots of `cos x cosh x = -1`.
const ROOTS: [f64; 2] = [1.875_104_068_711_961, 4.694_091_132_974_175];

/// Frequency of a bending mode of a slender body, its root over the length the wave number, rad/s.
fn bending(root: f64, moment: f64) -> f64 {
    (root / LENGTH).powi(2) * (YOUNG * moment / (DENSITY * AREA)).sqrt()
}

fn read() -> Value {
    json!([{"kind": "eigenvalue", "count": 2}])
}

/// What the mesh may miss of a frequency: with eight elements some 1e-6.
fn claimed(specimen: Specimen, [first, second]: [f64; 2]) -> Specimen {
    let decay = [RATIO * first, RATIO * second * second / first];
    specimen
        .claim_within("eigenvalue.decay_rate[1]", "1/s", decay[0], 2e-5 * decay[0])
        .claim_within("eigenvalue.decay_rate[2]", "1/s", decay[1], 2e-4 * decay[1])
        .claim_within(
            "rod.damping_time",
            "s",
            2.0 * RATIO / first,
            2e-5 * RATIO / first,
        )
}

fn line(element: &str, dimension: usize) -> Value {
    let place = |x: f64| vec![x, 0.0, 0.0][..dimension].to_vec();
    json!({"name": "rod", "element": element, "elements": 8, "model": "flexible", "axial": "waves",
        "material": {"youngs_modulus": YOUNG, "density": DENSITY, "damping_ratio": RATIO},
        "section": {"area": AREA, "second_moment": MOMENT},
        "shape": {"line": {"from": place(0.0), "to": place(LENGTH)}}, "markers": {"a": 0.0, "e": 1.0}})
}

fn cantilever() -> Specimen {
    let scene = json!({"name": "cantilever", "dimension": 2, "bodies": [line("cable", 2)],
        "joints": [clamp("wall", "rod.a")], "outputs": read()});
    claimed(
        Specimen::new("damped cantilever", scene),
        ROOTS.map(|root| bending(root, MOMENT)),
    )
}

/// A beam between supports: with the wave number `k`, `omega^2` is the lower root of
/// `rho r^2 / (kappa G) w^2 - (1 + k^2 r^2 (1 + E / (kappa G))) w + E r^2 k^4 / rho` (Timoshenko 1921), `r^2 = I / A`.
fn supported() -> Specimen {
    let (shear, factor) = (8e8, 0.8);
    let mut body = line("beam", 2);
    body["material"]["shear_modulus"] = json!(shear);
    body["section"] =
        json!({"area": AREA, "second_moment": 100.0 * MOMENT, "shear_factor": factor});
    let scene = json!({"name": "supported", "dimension": 2, "bodies": [body],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "rod.a"]},
                   {"name": "roller", "kind": "point_on_line", "markers": ["ground", "rod.e"], "direction": [1.0, 0.0]}],
        "outputs": read()});
    let frequency = |mode: f64| {
        let (k, r) = (mode * std::f64::consts::PI / LENGTH, 100.0 * MOMENT / AREA);
        let a = DENSITY * r / (factor * shear);
        let b = 1.0 + k * k * r * (1.0 + YOUNG / (factor * shear));
        let c = YOUNG * r * k.powi(4) / DENSITY;
        (2.0 * c / (b + (b * b - 4.0 * a * c).sqrt())).sqrt()
    };
    claimed(
        Specimen::new("damped between supports", scene),
        [frequency(1.0), frequency(2.0)],
    )
}

/// Clamped, and four times as stiff about one axis as about the other: the second mode is the first about that one.
fn in_space(element: &'static str) -> Specimen {
    let mut body = line(element, 3);
    body["material"]["shear_modulus"] = json!(8e8);
    body["section"] = json!({"area": AREA, "second_moments": [4.0 * MOMENT, MOMENT], "torsion_constant": 4.0 * MOMENT});
    if element == "beam" {
        // Hardly any shear and rotary inertia.
        body["section"]["shear_factors"] = json!([1e4, 1e4]);
    }
    let scene = json!({"name": "clamped", "dimension": 3, "bodies": [body],
        "joints": [clamp("wall", "rod.a")], "outputs": read()});
    let modes = [1.0, 4.0].map(|times| bending(ROOTS[0], times * MOMENT));
    claimed(
        Specimen::new(
            if element == "rod" {
                "damped rod"
            } else {
                "damped beam"
            },
            scene,
        ),
        modes,
    )
}

/// A mass on a light bar, with half as stiff a spring beside it: two thirds of the energy are strain of the bar, whose time is longer by as much.
fn beside_a_spring() -> Specimen {
    let (mass, bar) = (50.0, YOUNG * AREA / LENGTH);
    let mut body = line("cable", 2);
    body["elements"] = json!(2);
    body["material"]["density"] = json!(1e-3);
    body["section"]["second_moment"] = json!(1e-6);
    let scene = json!({"name": "beside", "dimension": 2,
        "bodies": [body, {"element": "rigid", "name": "block", "mass": mass, "inertia": 0.0, "position": [LENGTH, 0.0],
                          "markers": {"c": [0.0, 0.0]}}],
        "joints": [clamp("wall", "rod.a"),
                   {"name": "end", "kind": "revolute", "markers": ["rod.e", "block.c"]},
                   {"name": "rail", "kind": "point_on_line", "markers": ["ground", "block.c"], "direction": [1.0, 0.0]}],
        "loads": [{"name": "spring", "kind": "spring_damper", "markers": ["ground", "block.c"], "point": [2.0 * LENGTH, 0.0],
                   "stiffness": 0.5 * bar}],
        "outputs": [{"kind": "eigenvalue", "count": 1}]});
    let frequency = (1.5 * bar / mass).sqrt();
    // The mass of the bar is 1e-8 of that of the block.
    Specimen::new("damped beside a spring", scene)
        .claim_within(
            "eigenvalue.decay_rate[1]",
            "1/s",
            RATIO * frequency,
            1e-6 * frequency,
        )
        .claim_within(
            "rod.damping_time",
            "s",
            3.0 * RATIO / frequency,
            1e-6 / frequency,
        )
}
