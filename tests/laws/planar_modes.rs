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

/// A line whose root is driven to a speed: where it stands relative to the root, at these times.
fn spun_up(model: &Value) -> Vec<[f64; 2]> {
    let mut body = json!({"name": "rod", "element": "cable", "material": {"youngs_modulus": 2.8e7, "density": 1.2},
        "section": {"area": 1.0, "second_moment": 5e-4},
        "shape": {"line": {"from": [0, 0], "to": [10, 0]}}, "markers": {"root": 0, "tip": 1}});
    for (key, value) in model.as_object().into_iter().flatten() {
        body[key] = value.clone();
    }
    let scene = json!({"name": "spin_up", "dimension": 2, "gravity": [0, 0], "bodies": [body],
        "joints": [{"name": "pivot", "kind": "revolute", "markers": ["ground", "rod.root"]}],
        "motions": [{"name": "drive", "kind": "angle", "joint": "pivot",
            "value": "0.4*(min(t, 15)^2/2 + (15/(2*PI))^2*(cos(2*PI*min(t, 15)/15) - 1)) + 6*max(t - 15, 0)"}],
        "outputs": [{"kind": "deflection", "marker": "rod.tip", "from": "rod.root"}],
        "accuracy": {"relative_tolerance": 1e-5}});
    let mut run = Run::started(&scene);
    let mut place = |k: u32| {
        run.step(f64::from(k));
        run.read_all("rod.tip.deflection_from_root")
    };
    (1..=20).map(&mut place).collect()
}

/// The beam of Kane, Ryan and Banerjee (1987) that a hub spins up to 6 rad/s lags by 0.57 m of 10 m. Modes without centrifugal stiffening diverge.
#[test]
fn a_beam_is_spun_up_as_elements_are() {
    let exact = spun_up(&elements(8));
    let lag = exact.iter().map(|[_, y]| y.abs()).fold(0.0, f64::max);
    assert!((lag - 0.57).abs() < 0.01, "{lag}");
    for modes in [1, 2, 4] {
        let found = spun_up(&modal(modes));
        for (found, exact) in found.iter().zip(&exact) {
            let off = (found[0] - exact[0]).hypot(found[1] - exact[1]);
            assert!(off < 2e-3 * 10.0, "{modes} modes: {found:?}, {exact:?}");
        }
    }
}

/// A slider-crank mechanism with a connecting rod of modes, between revolute joints on a rigid crank and a block, against six elements.
#[test]
fn a_connecting_rod_of_modes_moves_as_elements_do() {
    let path = |model: Value| {
        let mut rod = json!({"name": "rod", "element": "beam",
            "material": {"youngs_modulus": 1e10, "shear_modulus": 3.85e9, "density": 7800},
            "section": {"area": 1e-4, "second_moment": 8.33e-10, "shear_factor": 5.0 / 6.0},
            "shape": {"line": {"from": [0.15, 0], "to": [0.45, 0]}}, "markers": {"crank": 0, "middle": 0.5, "pin": 1}});
        for (key, value) in model.as_object().into_iter().flatten() {
            rod[key] = value.clone();
        }
        let scene = json!({"name": "slider_crank", "dimension": 2, "gravity": [0, -9.81],
            "bodies": [rod,
                {"name": "crank", "element": "rigid", "mass": 0.3, "inertia": 6e-4, "position": [0.075, 0],
                    "markers": {"hub": [-0.075, 0], "pin": [0.075, 0]}},
                {"name": "block", "element": "rigid", "mass": 0.2, "inertia": 1e-4, "position": [0.45, 0], "markers": {"pin": [0, 0]}}],
            "joints": [{"name": "hub", "kind": "revolute", "markers": ["ground", "crank.hub"]},
                {"name": "big_end", "kind": "revolute", "markers": ["crank.pin", "rod.crank"]},
                {"name": "small_end", "kind": "revolute", "markers": ["rod.pin", "block.pin"]},
                {"name": "guide", "kind": "prismatic", "direction": [1, 0], "markers": ["ground", "block.pin"]}],
            "motions": [{"name": "drive", "kind": "angle", "joint": "hub", "value": "100*t^2"}],
            "outputs": [{"kind": "position", "marker": "block.pin"}, {"kind": "position", "marker": "rod.middle"},
                {"kind": "reaction", "joint": "big_end"}, {"kind": "energy"}],
            "accuracy": {"relative_tolerance": 1e-5}});
        let mut run = Run::started(&scene);
        let mut sum = Vec::new();
        for k in 1..=10_u32 {
            run.step(0.02 * f64::from(k));
            let [x]: [f64; 1] = [run.read("block.pin.position[1]")];
            let middle: [f64; 2] = run.read_all("rod.middle.position");
            sum.push([x, middle[0], middle[1], run.read("energy.strain")]);
        }
        sum
    };
    let exact = path(elements(6));
    assert!(exact.iter().any(|row| row[3] > 1e-4), "{exact:?}");
    for (found, exact) in path(modal(3)).iter().zip(&exact) {
        for k in 0..3 {
            assert!((found[k] - exact[k]).abs() < 3e-4, "{found:?}, {exact:?}");
        }
    }
}
