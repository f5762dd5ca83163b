//! Lines and finite element models as modes in the plane, against closed forms, elements and the same bodies in space.

use serde_json::{Value, json};

use super::runs::Run;

const LENGTH: f64 = 0.8;
const YOUNG: f64 = 70e9;
const DENSITY: f64 = 2700.0;
const AREA: f64 = 2.4e-4;
const SECOND_MOMENT: f64 = 2.88e-9;
/// Roots of the frequency equation of a clamped beam and of one between hinges.
const CLAMPED: [f64; 3] = [
    1.875_104_068_711_961,
    4.694_091_132_974_175,
    7.854_757_438_237_613,
];

/// A clamped cable or beam along a slanted line, with these keys of its model.
fn clamped(element: &str, model: &Value) -> Value {
    let mut scene = json!({"name": "clamped", "dimension": 2, "gravity": [0, 0],
        "bodies": [{"name": "line", "element": element,
            "material": {"youngs_modulus": YOUNG, "density": DENSITY},
            "section": {"area": AREA, "second_moment": SECOND_MOMENT},
            "shape": {"line": {"from": [0, 0], "to": [0.6 * LENGTH, 0.8 * LENGTH]}},
            "markers": {"root": 0, "middle": 0.4, "tip": 1}}],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "line.root"]}],
        "outputs": [{"kind": "natural_frequency", "count": 3}, {"kind": "position", "marker": "line.tip"},
            {"kind": "angle", "marker": "line.tip"},
            {"kind": "deflection", "marker": "line.tip", "from": "line.root"}, {"kind": "reaction", "joint": "clamp"}]});
    let body = &mut scene["bodies"][0];
    if element == "beam" {
        body["material"]["shear_modulus"] = json!(26e9);
        body["section"]["shear_factor"] = json!(5.0 / 6.0);
    }
    for (key, value) in model.as_object().into_iter().flatten() {
        body[key] = value.clone();
    }
    scene
}

fn modal(modes: u32) -> Value {
    json!({"model": "modal", "modes": modes})
}

fn elements(count: u32) -> Value {
    json!({"model": "flexible", "elements": count})
}

/// `k^2 sqrt(E I / (rho A)) / L^2`.
fn bending(root: f64) -> f64 {
    root * root * (YOUNG * SECOND_MOMENT / (DENSITY * AREA)).sqrt() / (LENGTH * LENGTH)
}

fn near(found: f64, exact: f64, part: f64) {
    assert!(
        (found / exact - 1.0).abs() < part,
        "{found}, expected {exact}"
    );
}

/// Of a Bernoulli beam, clamped and between hinges, of which one slides along the line.
#[test]
fn frequencies_are_those_of_the_closed_form() {
    let mut run = Run::started(&clamped("cable", &modal(6)));
    for (k, root) in CLAMPED.into_iter().enumerate() {
        near(
            run.read(&format!("natural_frequency[{}]", k + 1)),
            bending(root),
            1e-4,
        );
    }
    let mut scene = clamped("cable", &modal(6));
    scene["joints"] = json!([
        {"name": "hinge", "kind": "revolute", "markers": ["ground", "line.root"]},
        {"name": "roller", "kind": "point_on_line", "direction": [0.6, 0.8], "markers": ["ground", "line.tip"]}]);
    scene["outputs"] = json!([{"kind": "natural_frequency", "count": 3}]);
    let mut run = Run::started(&scene);
    for k in 1..=3_u32 {
        let root = f64::from(k) * std::f64::consts::PI;
        near(
            run.read(&format!("natural_frequency[{k}]")),
            bending(root),
            5e-4,
        );
    }
}

/// `F L^3 / (3 E I)`, of a beam with `F L / (k G A)` more, and `F L^2 / (2 E I)`: static shapes are exact without natural modes.
#[test]
fn static_deflections_are_exact_without_natural_modes() {
    let force = 0.01;
    for (element, shear) in [("cable", 0.0), ("beam", 1.0 / (5.0 / 6.0 * 26e9 * AREA))] {
        let mut scene = clamped(element, &modal(0));
        scene["loads"] = json!([{"name": "pull", "kind": "force", "marker": "line.tip", "value": [-0.8 * force, 0.6 * force]}]);
        scene["initial"] = json!("static_equilibrium");
        let mut run = Run::started(&scene);
        let exact = force * (LENGTH.powi(3) / (3.0 * YOUNG * SECOND_MOMENT) + LENGTH * shear);
        let [x, y]: [f64; 2] = run.read_all("line.tip.position");
        near(
            0.6 * (y - 0.8 * LENGTH) - 0.8 * (x - 0.6 * LENGTH),
            exact,
            1e-6,
        );
        let [x, y]: [f64; 2] = run.read_all("line.tip.deflection_from_root");
        near(0.6 * y - 0.8 * x, exact, 1e-6);
        let turned = run.read("line.tip.angle") - 0.8_f64.atan2(0.6);
        near(
            turned,
            force * LENGTH.powi(2) / (2.0 * YOUNG * SECOND_MOMENT),
            1e-6,
        );
        let [x, y]: [f64; 2] = run.read_all("clamp.reaction");
        near(0.6 * y - 0.8 * x, -force, 1e-9);
    }
}

/// A cantilever that rotates with its clamp on the axis, in the plane of rotation: the series of `tests/cases/rotating_beam`. At rest the first
/// frequency is 3.516.
#[test]
fn rotation_stiffens_a_cantilever_in_its_plane() {
    for (speed, exact) in [
        (2.0, [3.621_796_964_124_13, 22.526_311_173_797_8]),
        (6.0, [4.263_225_420_193_83, 26.129_042_470_867]),
        (8.0, [4.657_149_596_298_88, 28.908_872_942_781_3]),
    ] {
        let scene = json!({"name": "lag", "dimension": 2, "gravity": [0, 0], "rotation": speed,
            "bodies": [{"name": "rod", "element": "cable", "model": "modal", "modes": 8,
                "material": {"youngs_modulus": 1.0, "density": 4e-8},
                "section": {"area": 2.5e7, "second_moment": 1.0},
                "shape": {"line": {"from": [0, 0], "to": [1, 0]}}, "markers": {"root": 0, "tip": 1}}],
            "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "rod.root"]}],
            "outputs": [{"kind": "natural_frequency", "count": 2}],
            "initial": "static_equilibrium"});
        let mut run = Run::started(&scene);
        for (k, exact) in exact.into_iter().enumerate() {
            near(
                run.read(&format!("natural_frequency[{}]", k + 1)),
                exact,
                1e-3,
            );
        }
    }
}

/// A free line keeps its energy, momentum and angular momentum while it deforms.
#[test]
fn a_free_line_keeps_energy_and_momenta() {
    for element in ["cable", "beam"] {
        let mut scene = clamped(element, &modal(3));
        scene["joints"] = json!([]);
        scene["bodies"][0]["motion"] = json!({"velocity": [0.2, 0.1], "spin": 20.0});
        scene["bodies"][0]["material"]["youngs_modulus"] = json!(5e6);
        scene["initial"] = json!("undeformed");
        scene["loads"] = json!([{"name": "pull", "kind": "moment", "marker": "line.tip", "value": "max(0, 0.02 - t)"}]);
        scene["outputs"] = json!([{"kind": "energy"}, {"kind": "momentum"}]);
        scene["accuracy"] = json!({"relative_tolerance": 1e-9});
        let mut run = Run::started(&scene);
        let read = |run: &mut Run| {
            let energy = run.read("energy.kinetic") + run.read("energy.strain");
            let names = ["momentum[1]", "momentum[2]", "angular_momentum"];
            let momenta = names.map(|name| run.read(name));
            [momenta[0], momenta[1], momenta[2], energy]
        };
        run.step(0.025);
        let before = read(&mut run);
        run.step(0.5);
        for (now, before) in read(&mut run).into_iter().zip(before) {
            near(now, before, 1e-6);
        }
        assert!(run.read("energy.strain") > 0.0);
    }
}
