//! Airfoils along bodies against closed forms: wings that bend and twist, a wing near divergence, a bar that spins in still air.

use flexbody::scene::{Scene, assemble};
use serde_json::{Value, json};

use super::runs::{Run, is_near, settings, vector};

const DENSITY: f64 = 1.2;
/// Length of the wings, m.
const LENGTH: f64 = 2.0;
/// Second moment of area, m^4, both about the first axis and about the second.
const SECOND_MOMENT: f64 = 2e-8;
const TORSION_CONSTANT: f64 = 1e-8;
const SHEAR_MODULUS: f64 = 8e8;
const YOUNGS_MODULUS: f64 = 2e9;
const AREA: f64 = 4e-4;
const SHEAR_FACTOR: f64 = 0.8;

/// A wing that is clamped along the first axis. In space its chord is along the second one.
fn wing(dimension: usize, element: &str, elements: u32, keys: &Value) -> Value {
    let mut section = match dimension {
        2 => json!({"area": AREA, "second_moment": SECOND_MOMENT}),
        _ => {
            json!({"area": AREA, "second_moments": [SECOND_MOMENT, SECOND_MOMENT], "torsion_constant": TORSION_CONSTANT})
        }
    };
    let mut material = json!({"youngs_modulus": YOUNGS_MODULUS, "density": 1e3});
    if element != "cable" {
        material["shear_modulus"] = json!(SHEAR_MODULUS);
    }
    match (dimension, element) {
        (2, "beam") => section["shear_factor"] = json!(SHEAR_FACTOR),
        (3, "beam") => section["shear_factors"] = json!([SHEAR_FACTOR, SHEAR_FACTOR]),
        _ => {}
    }
    let mut body = json!({"name": "wing", "element": element, "elements": elements, "section": section, "material": material,
        "shape": {"line": {"from": vector(dimension, [0.0, 0.0]), "to": vector(dimension, [LENGTH, 0.0])}},
        "markers": {"root": 0, "tip": 1}});
    let mut air = keys.clone();
    air["name"] = json!("air");
    air["kind"] = json!("airfoil");
    air["body"] = json!("wing");
    air["density"] = json!(DENSITY);
    let mut outputs = vec![
        json!({"kind": "position", "marker": "wing.tip"}),
        json!({"kind": "reaction", "joint": "clamp"}),
        json!({"kind": "reaction_moment", "joint": "clamp"}),
        json!({"kind": "load_force", "load": "air"}),
    ];
    if dimension == 3 {
        body["axis"] = json!([0, 1, 0]);
        air["chord_direction"] = json!([0, 1, 0]);
        air["lift_direction"] = json!([0, 0, 1]);
        outputs.push(json!({"kind": "orientation", "marker": "wing.tip"}));
    } else {
        air["chord_direction"] = json!([1, 0]);
    }
    json!({"name": "wing", "dimension": dimension, "bodies": [body], "loads": [air], "outputs": outputs,
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "wing.root"]}],
        "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-10}})
}

/// Rotation of the tip about the span, nose up, rad: the second axis is the chord.
fn twist(run: &mut Run) -> f64 {
    -run.read("wing.tip.orientation[8]")
}

/// In space: `w = q L^4 / (8 E I)` and `t = (m + q e) L^2 / (2 G J)` by the lift `q`, the moment `m` and the centre `e` ahead of the line,
/// with the deflection `q L^2 / (2 k G A)` of shear. The chord of the second wing grows along it: `q s`.
#[test]
fn wings_bend_and_twist() {
    let [wind, lift, moment, ahead, chord] = [0.2, 0.4, 0.15, 0.2, 0.3];
    let keys = json!({"wind": [0, wind, 0], "lift": lift, "moment": moment, "ahead": ahead, "chord": chord});
    let pressure = 0.5 * DENSITY * wind * wind;
    let bending = YOUNGS_MODULUS * SECOND_MOMENT;
    let torsion = SHEAR_MODULUS * TORSION_CONSTANT;
    for element in ["rod", "beam"] {
        let shear = match element {
            "beam" => 1.0 / (SHEAR_FACTOR * SHEAR_MODULUS * AREA),
            _ => 0.0,
        };
        let mut run = Run::started(&wing(3, element, 4, &keys));
        let q = pressure * chord * lift;
        let w = q * LENGTH.powi(4) / (8.0 * bending) + q * LENGTH.powi(2) * shear / 2.0;
        is_near(run.read("wing.tip.position[3]"), w, 1e-5 * w);
        let m = pressure * chord * chord * (moment + lift * ahead);
        let t = m * LENGTH.powi(2) / (2.0 * torsion);
        is_near(twist(&mut run), t, 1e-5 * t);
        is_near(run.read("air.force[3]"), q * LENGTH, 1e-9);
        is_near(run.read("clamp.reaction[3]"), -q * LENGTH, 1e-9);
        is_near(
            run.read("clamp.reaction_moment[2]"),
            q * LENGTH.powi(2) / 2.0,
            1e-5,
        );
        is_near(run.read("clamp.reaction_moment[1]"), m * LENGTH, 1e-5);

        let mut grown = keys.clone();
        grown["chord"] = json!(format!("{chord}*s"));
        let mut run = Run::started(&wing(3, element, 4, &grown));
        let w = 11.0 * q * LENGTH.powi(4) / (120.0 * bending) + q * LENGTH.powi(2) * shear / 3.0;
        is_near(run.read("wing.tip.position[3]"), w, 1e-5 * w);
        is_near(run.read("air.force[3]"), q * LENGTH / 2.0, 1e-9);
    }
}

/// In the plane, with the chord along the line and the wind across it: `w = q L^4 / (8 E I) - (m + e q) L^3 / (3 E I)`, with the deflection
/// `q L^2 / (2 k G A)` of shear.
#[test]
fn planar_lines_bend_under_drag_and_moment() {
    let [wind, drag, moment, ahead, chord] = [0.2, 0.7, 0.2, 0.3, 0.1];
    let keys = json!({"wind": [0, wind], "lift": 0, "drag": drag, "moment": moment, "ahead": ahead, "chord": chord});
    let pressure = 0.5 * DENSITY * wind * wind * chord;
    let bending = YOUNGS_MODULUS * SECOND_MOMENT;
    for element in ["cable", "beam"] {
        let shear = match element {
            "beam" => 1.0 / (SHEAR_FACTOR * SHEAR_MODULUS * AREA),
            _ => 0.0,
        };
        let mut run = Run::started(&wing(2, element, 4, &keys));
        let (q, m) = (pressure * drag, pressure * chord * (moment + ahead * drag));
        let w = q * LENGTH.powi(4) / (8.0 * bending) + q * LENGTH.powi(2) * shear / 2.0
            - m * LENGTH.powi(3) / (3.0 * bending);
        is_near(run.read("wing.tip.position[2]"), w, 1e-5 * w);
        is_near(run.read("clamp.reaction[2]"), -q * LENGTH, 1e-9);
        let held = m * LENGTH - q * LENGTH.powi(2) / 2.0;
        is_near(run.read("clamp.reaction_moment"), held, 1e-5);
    }
}

/// Lift that grows with the twist: `t = a (1 / cos(k L) - 1)` with `k^2 = rho U^2 c^2 e C / (2 G J)`, for the angle of attack `a` at the root.
/// The wing diverges at `k L = pi / 2`. Bisplinghoff, Ashley, Halfman, Aeroelasticity (1955), Eq. 8-14.
#[test]
fn wings_twist_more_and_more_towards_divergence() {
    let [wind, slope, ahead, chord, start] = [4.9, 5.0, 0.25, 0.4, 1e-5_f64];
    let pressure = 0.5 * DENSITY * wind * wind;
    let torsion = SHEAR_MODULUS * TORSION_CONSTANT;
    let k = (pressure * chord * chord * ahead * slope / torsion).sqrt();
    assert!(k * LENGTH > 1.0 && k * LENGTH < 1.5, "{}", k * LENGTH);
    let exact = start * (1.0 / (k * LENGTH).cos() - 1.0);
    for element in ["rod", "beam"] {
        let errors = [2, 4, 8].map(|elements| {
            let keys = json!({"wind": [0, wind * start.cos(), wind * start.sin()], "lift": format!("{slope}*a"), "ahead": ahead,
                "chord": chord});
            let mut run = Run::started(&wing(3, element, elements, &keys));
            (twist(&mut run) / exact - 1.0).abs()
        });
        let order = (errors[1] / errors[2]).log2();
        assert!(
            order > 1.9 && errors[2] < 1e-2,
            "{element} {errors:?} {order}"
        );
    }
}

/// A rigid bar that spins about its end in still air, with drag all along it: `w = w_0 / (1 + k w_0 t / J)` with
/// `k = rho c C_d (L^4 / 4 + c L^3 / 3 + c^2 L^2 / 8) / 2`: the velocity counts half a chord behind each place, here outwards. What the air takes
/// is what the bar has lost.
#[test]
fn drag_along_a_bar_stops_it() {
    for (_, method) in settings().filter(|(dimension, _)| *dimension == 2) {
        let [length, chord, drag, spin] = [1.1_f64, 0.2, 0.9, 12.0];
        let scene = json!({"name": "rotor", "dimension": 2,
            "bodies": [{"name": "bar", "element": "cable", "model": "rigid", "shape": {"line": {"from": [0, 0], "to": [length, 0]}},
                "section": {"area": 1e-3, "second_moment": 1e-8}, "material": {"youngs_modulus": 2e11, "density": 1000},
                "motion": {"spin": spin}, "markers": {"axle": 0, "tip": 1}}],
            "joints": [{"name": "axle", "kind": "revolute", "markers": ["ground", "bar.axle"]}],
            "loads": [{"name": "air", "kind": "airfoil", "body": "bar", "chord_direction": [1, 0], "chord": chord, "density": DENSITY,
                "lift": 0, "drag": drag}],
            "outputs": [{"kind": "angular_velocity", "joint": "axle"}, {"kind": "energy"}, {"kind": "work"}],
            "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-10}});
        let mut run = Run::started(&scene);
        let inertia = length.powi(3) / 3.0;
        let k = 0.5
            * DENSITY
            * chord
            * drag
            * (length.powi(4) / 4.0
                + chord * length.powi(3) / 3.0
                + (chord * length).powi(2) / 8.0);
        let start = run.read("energy.kinetic");
        is_near(start, 0.5 * inertia * spin * spin, 1e-9);
        for step in 1..=4 {
            let time = 0.5 * f64::from(step);
            run.step(time);
            let exact = spin / (1.0 + k * spin * time / inertia);
            is_near(run.read("axle.angular_velocity"), exact, 1e-7);
            let lost = run.read("energy.kinetic") - start;
            is_near(run.read("energy.input"), lost, 1e-6);
        }
    }
}

/// A chord below 0, or without a value, is refused where strips are: the error names the place.
#[test]
fn chords_that_are_none_are_refused() {
    for (chord, told) in [
        (
            "0.3 - s",
            "loads[0].chord: expected zero or a positive number (m), found -0.",
        ),
        (
            "0.3/(s-s)",
            "loads[0].chord: expected a finite number, found inf",
        ),
    ] {
        let keys = json!({"wind": [0, 1, 0], "lift": 1, "chord": chord});
        let scene = Scene::from_json(&wing(3, "rod", 2, &keys).to_string()).expect("a scene");
        let error = assemble::<3>(&scene).expect_err("no chord").to_string();
        assert!(error.starts_with(told), "{error}");
    }
}
