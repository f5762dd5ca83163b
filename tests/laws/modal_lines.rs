//! Rods and beams that are reduced to modes, against closed forms and elements.

use std::f64::consts::TAU;

use flexbody::scene::Scene;
use serde_json::{Value, json};

use super::runs::Run;

const LENGTH: f64 = 0.8;
const YOUNG: f64 = 70e9;
const SHEAR: f64 = 26e9;
const DENSITY: f64 = 2700.0;
const WIDTH: f64 = 0.02;
const HEIGHT: f64 = 0.012;

/// A clamped rod or beam along a slanted line, with so many natural modes.
fn clamped(element: &str, modes: u32) -> Value {
    let end = [0.6 * LENGTH, 0.0, 0.8 * LENGTH];
    json!({"name": "clamped", "dimension": 3, "gravity": [0, 0, 0],
        "bodies": [{"name": "rod", "element": element, "model": "modal", "modes": modes, "axis": [0, 1, 0],
            "material": {"youngs_modulus": YOUNG, "shear_modulus": SHEAR, "density": DENSITY},
            "section": {"shape": {"rectangle": {"width": WIDTH, "height": HEIGHT}}},
            "shape": {"line": {"from": [0, 0, 0], "to": end}}, "markers": {"root": 0, "middle": 0.4, "tip": 1}}],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "rod.root"]}],
        "outputs": [{"kind": "natural_frequency", "count": 6}, {"kind": "position", "marker": "rod.tip"},
            {"kind": "rotation_vector", "marker": "rod.tip"},
            {"kind": "deflection", "marker": "rod.tip", "from": "rod.root"}, {"kind": "deflection", "marker": "rod.tip"}, {"kind": "reaction", "joint": "clamp"}]})
}

/// A clamped rod along the first axis of the scene, with these keys of its model.
fn along_x(model: &Value) -> Value {
    let mut scene = clamped("rod", 0);
    let body = &mut scene["bodies"][0];
    body.as_object_mut().expect("a body").remove("modes");
    for (key, value) in model.as_object().into_iter().flatten() {
        body[key] = value.clone();
    }
    body["shape"] = json!({"line": {"from": [0, 0, 0], "to": [LENGTH, 0, 0]}});
    scene
}

/// Second moments about the width and the height, m^4.
fn second_moments() -> [f64; 2] {
    [WIDTH * HEIGHT.powi(3), HEIGHT * WIDTH.powi(3)].map(|of| of / 12.0)
}

/// Clamped frequencies of a Bernoulli beam, `(k L)^2 sqrt(E I / (rho A)) / L^2`, two planes.
#[test]
fn clamped_frequencies_are_those_of_the_closed_form() {
    let mut run = Run::started(&clamped("rod", 6));
    let area = WIDTH * HEIGHT;
    let mut exact: Vec<f64> = second_moments()
        .iter()
        .flat_map(|moment| {
            let unit = (YOUNG * moment / (DENSITY * area)).sqrt() / (LENGTH * LENGTH);
            [
                1.875_104_068_711_961,
                4.694_091_132_974_175,
                7.854_757_438_237_613,
            ]
            .map(|root: f64| root * root * unit)
        })
        .collect();
    exact.sort_by(f64::total_cmp);
    for (k, exact) in exact.iter().take(6).enumerate() {
        let found = run.read(&format!("natural_frequency[{}]", k + 1));
        assert!((found / exact - 1.0).abs() < 1e-4, "{k}: {found} {exact}");
    }
}

/// `F L^3 / (3 E I)` and `F L^2 / (2 E I)` about one axis, a moment `M L / (G J)` about the line: static shapes are exact without natural modes.
#[test]
fn static_deflections_are_exact_without_natural_modes() {
    let [about_width, _] = second_moments();
    let mut scene = clamped("rod", 0);
    // Across the line, upwards: along the height.
    let force = 0.01;
    scene["loads"] = json!([{"name": "pull", "kind": "force", "marker": "rod.tip", "value": [-0.8 * force, 0, 0.6 * force]}]);
    scene["initial"] = json!("static_equilibrium");
    let mut run = Run::started(&scene);
    let [x, _, z]: [f64; 3] = run.read_all("rod.tip.position");
    let deflection = -0.8 * (x - 0.6 * LENGTH) + 0.6 * (z - 0.8 * LENGTH);
    let exact = force * LENGTH.powi(3) / (3.0 * YOUNG * about_width);
    // Components are along the axes of the scene, which the root does not rotate.
    let [x, _, z]: [f64; 3] = run.read_all("rod.tip.deflection_from_root");
    assert!(((0.6 * z - 0.8 * x) / exact - 1.0).abs() < 1e-6, "{x} {z}");
    assert!(
        (deflection / exact - 1.0).abs() < 1e-6,
        "{deflection} {exact}"
    );
    let reaction: [f64; 3] = run.read_all("clamp.reaction");
    assert!(
        (reaction[0] - 0.8 * force).abs() < 1e-9 * force,
        "{reaction:?}"
    );
}

/// A blade that its root drives about a slanted axis, against sixteen elements: deflections of 7 % of the length, errors of third order.
#[test]
fn a_driven_blade_moves_as_elements_do() {
    let scene = |model: Value| {
        let mut body = json!({"name": "blade", "element": "rod", "axis": [0, 1, 0],
            "material": {"youngs_modulus": 1e9, "shear_modulus": 1e9 / 2.7, "density": 1150},
            "section": {"shape": {"rectangle": {"width": 0.03, "height": 0.006}}},
            "shape": {"line": {"from": [0, 0, 0], "to": [0.4, 0, 0]}}, "markers": {"root": 0, "tip": 1}});
        for (key, value) in model.as_object().into_iter().flatten() {
            body[key] = value.clone();
        }
        json!({"name": "blade", "dimension": 3, "bodies": [body],
            "joints": [{"name": "hub", "kind": "revolute", "direction": [0, 0.9396926207859084, 0.3420201433256687],
                "markers": ["ground", "blade.root"]}],
            "motions": [{"name": "drive", "kind": "angle", "joint": "hub",
                "value": "20*max(t - 0.5, 0) + 40*(min(t, 0.5)^2/2 + (cos(4*PI*min(t, 0.5)) - 1)/(4*PI)^2)"}],
            "outputs": [{"kind": "position", "marker": "blade.tip"}],
            "accuracy": {"relative_tolerance": 1e-6}})
    };
    let path = |model: Value| {
        let mut run = Run::started(&scene(model));
        let mut place = |at: u32| -> [f64; 3] {
            run.0.step(0.05 * f64::from(at)).expect("a step");
            run.read_all("blade.tip.position")
        };
        (1..=20).map(&mut place).collect::<Vec<_>>()
    };
    let elements = path(json!({"elements": 16, "model": "flexible"}));
    for (modes, limit) in [(1, 2e-3), (2, 1e-3), (4, 1e-3)] {
        let found = path(json!({"model": "modal", "modes": modes}));
        let distance = |(a, b): (&[f64; 3], &[f64; 3])| {
            (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt() / 0.4
        };
        let most = found
            .iter()
            .zip(&elements)
            .map(distance)
            .fold(0.0, f64::max);
        assert!(most < limit, "{modes} modes: {most:e}");
    }
}

/// Flapping of a cantilever that a frame rotates with: `sqrt(f^2 + Omega^2)`, `f` in the plane of rotation by Frobenius series
/// (`tests/cases/rotating_beam`). Without second-order displacements it would be the frequency at rest.
#[test]
fn centrifugal_forces_stiffen_a_cantilever() {
    let (speed, in_plane) = (6.0, 4.263_225_420_193_83_f64);
    let scene = json!({"name": "flap", "dimension": 3, "gravity": [0, 0, 0], "rotation": [0, 0, speed],
        "bodies": [{"name": "rod", "element": "rod", "model": "modal", "modes": 8, "axis": [0, 1, 0],
            "material": {"youngs_modulus": 1.0, "shear_modulus": 0.4, "density": 1e-4},
            "section": {"area": 1e4, "second_moments": [1.0, 1.0], "torsion_constant": 2.0},
            "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}}],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "rod.root"]}],
        "outputs": [{"kind": "position", "marker": "rod.tip"}, {"kind": "natural_frequency", "count": 2}],
        "initial": {"state": "static_equilibrium",
            "loads": [{"name": "lift", "kind": "force", "marker": "rod.tip", "value": [0, 0, 1e-2]}]},
        "accuracy": {"relative_tolerance": 1e-7}});
    let mut run = Run::started(&scene);
    let exact = in_plane.hypot(speed);
    let step = TAU / exact / 100.0;
    let (mut before, mut crossings) = (run.read("rod.tip.position[3]"), Vec::new());
    assert!(before > 1e-5, "{before}");
    for k in 1..2100 {
        run.0.step(step * f64::from(k)).expect("a step");
        let now = run.read("rod.tip.position[3]");
        if before > 0.0 && now <= 0.0 {
            crossings.push(step * (f64::from(k) - now / (now - before)));
        }
        before = now;
    }
    let periods = (crossings.len() - 1) as f64;
    let found = TAU * periods / (crossings[crossings.len() - 1] - crossings[0]);
    assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
    let frequency = run.read("natural_frequency[2]");
    assert!(
        (frequency / exact - 1.0).abs() < 1e-3,
        "{frequency} {exact}"
    );
}

/// Frequencies of a clamped blade in a scene that rotates, bending and torsion, against elements.
#[test]
fn a_blade_that_rotates_has_the_frequencies_of_elements() {
    let frequencies = |model: Value| -> [f64; 5] {
        let mut scene = along_x(&model);
        let body = &mut scene["bodies"][0];
        (
            body["material"]["youngs_modulus"],
            body["material"]["shear_modulus"],
        ) = (json!(1e11), json!(1e8));
        (scene["rotation"], scene["initial"]) = (json!([0, 0, 60]), json!("static_equilibrium"));
        let mut run = Run::started(&scene);
        run.read_all("natural_frequency")
    };
    let exact = frequencies(json!({"elements": 12, "model": "flexible"}));
    let found = frequencies(json!({"modes": 12, "model": "modal"}));
    for (found, exact) in found.iter().zip(&exact) {
        assert!((found / exact - 1.0).abs() < 2e-4, "{found} {exact}");
    }
}

/// A free beam keeps its energy and its angular momentum.
#[test]
fn a_free_beam_keeps_energy_and_momentum() {
    let mut scene = clamped("beam", 3);
    scene["joints"] = json!([]);
    scene["bodies"][0]["motion"] =
        json!({"velocity": [0.2, 0.1, -0.3], "spin": [10.0, -30.0, 20.0]});
    scene["bodies"][0]["material"]["youngs_modulus"] = json!(5e6);
    scene["outputs"] = json!([{"kind": "energy"}, {"kind": "momentum"}]);
    scene["accuracy"] = json!({"relative_tolerance": 1e-9});
    let mut run = Run::started(&scene);
    let names: Vec<String> = run
        .0
        .variables()
        .iter()
        .map(|variable| variable.name.clone())
        .collect();
    let kept = |name: &&String| name.starts_with("angular_momentum");
    let kept: Vec<&String> = names.iter().filter(kept).collect();
    assert_eq!(kept.len(), 3, "{names:?}");
    let read = |run: &mut Run| {
        let energy = run.read("energy.kinetic") + run.read("energy.strain");
        let momentum = kept.iter().map(|name| run.read(name));
        momentum.chain([energy]).collect::<Vec<f64>>()
    };
    let before = read(&mut run);
    run.0.step(0.5).expect("a step");
    for (now, before) in read(&mut run).into_iter().zip(before) {
        assert!((now / before - 1.0).abs() < 1e-6, "{before} {now}");
    }
}

/// A soft beam that swings from its root keeps its energy, of which strain takes part.
#[test]
fn a_swinging_beam_keeps_its_energy() {
    let mut scene = clamped("beam", 3);
    scene["joints"][0]["kind"] = json!("spherical");
    scene["gravity"] = json!([0, -9.81, 0]);
    scene["bodies"][0]["material"]["youngs_modulus"] = json!(2e9);
    scene["outputs"] = json!([{"kind": "energy"}]);
    scene["accuracy"] = json!({"relative_tolerance": 1e-9});
    let mut run = Run::started(&scene);
    let read = |run: &mut Run| {
        ["kinetic", "strain", "gravity"].map(|of| run.read(&format!("energy.{of}")))
    };
    let before: f64 = read(&mut run).iter().sum();
    let (mut most, mut moved) = (0.0_f64, 0.0_f64);
    for k in 1..=20 {
        run.0.step(0.025 * f64::from(k)).expect("a step");
        let [kinetic, strain, gravity] = read(&mut run);
        (most, moved) = (most.max(strain), moved.max(kinetic));
        let off = (kinetic + strain + gravity - before).abs();
        assert!(off < 1e-6 * moved, "{off} of {moved}");
    }
    assert!(most > 1e-6 * moved, "{most} of {moved}");
}

/// A moment about the line and an axis across it: the way along the other axis is of second order, and a linear rotation of the tip is 16 % off.
/// Elements agree with the integrated equations of Kirchhoff's rod to seven digits here.
#[test]
fn moments_about_two_axes_act_to_second_order() {
    let place = |model: Value| -> [f64; 3] {
        let mut scene = along_x(&model);
        scene["loads"] =
            json!([{"name": "twist", "kind": "moment", "marker": "rod.tip", "value": [1, 0.3, 0]}]);
        scene["initial"] = json!("static_equilibrium");
        scene["outputs"] = json!([{"kind": "position", "marker": "rod.tip"}]);
        Run::started(&scene).read_all("rod.tip.position")
    };
    let found = place(json!({"model": "modal", "modes": 2}));
    let exact = place(json!({"model": "flexible", "elements": 8}));
    for (found, exact) in found.iter().zip(&exact).skip(1) {
        assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
    }
}

/// A shaft under a quarter of its critical torque bends at a frequency that is 2.2 % below that without torque: moments at interfaces have
/// stiffness.
#[test]
fn torque_softens_a_shaft() {
    let frequency = |model: Value, torque: f64| {
        let mut scene = along_x(&model);
        scene["bodies"][0]["section"] =
            json!({"area": 5e-5, "second_moments": [2e-10, 2e-10], "torsion_constant": 4e-8});
        scene["bodies"][0]["shape"] = json!({"line": {"from": [0, 0, 0], "to": [1.5, 0, 0]}});
        let bearing = json!({"name": "bearing", "kind": "cylindrical", "direction": [1, 0, 0], "markers": ["ground", "rod.tip"]});
        scene["joints"]
            .as_array_mut()
            .expect("joints")
            .push(bearing);
        scene["loads"] =
            json!([{"name": "drive", "kind": "torque", "joint": "bearing", "value": torque}]);
        scene["outputs"] = json!([{"kind": "natural_frequency", "count": 2}]);
        scene["initial"] = json!("static_equilibrium");
        Run::started(&scene).read("natural_frequency[1]")
    };
    let modal = || json!({"model": "modal", "modes": 8});
    let exact = frequency(json!({"model": "flexible", "elements": 16}), 20.0);
    let found = frequency(modal(), 20.0);
    assert!((found / exact - 1.0).abs() < 3e-3, "{found} {exact}");
    assert!(found < 0.985 * frequency(modal(), 0.0), "{found}");
}

/// An initial load alone holds its marker: its static shape is there.
#[test]
fn initial_loads_have_static_shapes() {
    let mut scene = clamped("rod", 0);
    scene["initial"] = json!({"state": "static_equilibrium",
        "loads": [{"name": "twist", "kind": "moment", "marker": "rod.tip", "value": [0, 0.01, 0]}]});
    let mut run = Run::started(&scene);
    let [about_width, _] = second_moments();
    let exact = 0.01 * LENGTH.powi(2) / (2.0 * YOUNG * about_width);
    let [x, _, z]: [f64; 3] = run.read_all("rod.tip.position");
    let deflection = (0.8 * (x - 0.6 * LENGTH) - 0.6 * (z - 0.8 * LENGTH)).abs();
    assert!(
        (deflection / exact - 1.0).abs() < 1e-3,
        "{deflection} {exact}"
    );
}

/// Twist by a torque, and the section's frame that markers have.
#[test]
fn frames_of_markers_are_those_of_sections() {
    let mut scene = clamped("rod", 0);
    let axis = [0.6, 0.0, 0.8];
    let torque = 0.02;
    scene["loads"] = json!([{"name": "twist", "kind": "moment", "marker": "rod.tip", "value": axis.map(|of| of * torque)}]);
    scene["initial"] = json!("static_equilibrium");
    scene["outputs"] = json!([{"kind": "orientation", "marker": "rod.tip"}]);
    let mut modal = Run::started(&scene);
    scene["bodies"][0]
        .as_object_mut()
        .expect("a body")
        .remove("modes");
    (scene["bodies"][0]["model"], scene["bodies"][0]["elements"]) = (json!("flexible"), json!(2));
    let mut elements = Run::started(&scene);
    let names: Vec<String> = (elements.0.variables().iter())
        .filter(|variable| variable.is_computed())
        .map(|variable| variable.name.clone())
        .collect();
    assert!(names.len() >= 4, "{names:?}");
    for name in names {
        let (found, exact) = (modal.read(&name), elements.read(&name));
        assert!((found - exact).abs() < 1e-6, "{name}: {found} {exact}");
    }
}

#[test]
fn what_modes_do_not_describe_is_refused() {
    let refused = |change: &dyn Fn(&mut Value), wanted: &str| {
        let mut scene = clamped("rod", 2);
        change(&mut scene);
        let error = Scene::from_json(&scene.to_string())
            .expect_err(wanted)
            .to_string();
        assert!(error.contains(wanted), "{error}");
    };
    refused(
        &|scene| scene["bodies"][0]["shape"] = json!({"helix": {"from": [0, 0, 0], "to": [0, 0, 1], "radius": 0.1, "turns": 1, "start": [1, 0, 0]}}),
        "bodies[0].model: expected \"auto\" or \"flexible\" of a line that is curved without stress, found \"modal\"",
    );
    refused(
        &|scene| {
            drop(
                scene["bodies"][0]
                    .as_object_mut()
                    .map(|body| body.remove("modes")),
            )
        },
        "bodies[0].modes: expected an integer from 0 to 12, found nothing",
    );
    refused(
        &|scene| scene["bodies"][0]["model"] = json!("auto"),
        "bodies[0].modes: expected nothing but with model \"modal\", found 2",
    );
    refused(
        &|scene| scene["outputs"] = json!([{"kind": "curvature", "marker": "rod.middle"}]),
        "which is reduced to modes (bodies[0].model)",
    );
    for output in [
        "torque",
        "bending_moment",
        "axial_force",
        "connectivity_force",
    ] {
        refused(
            &|scene| scene["outputs"] = json!([{"kind": output, "marker": "rod.middle"}]),
            "which is reduced to modes (bodies[0].model)",
        );
    }
    refused(
        &|scene| scene["masses"] = json!([{"marker": "rod.tip", "mass": 0.1}]),
        "masses[0].marker: expected a marker of another body than a reduced one",
    );
    refused(
        &|scene| scene["loads"] = json!([{"name": "wind", "kind": "distributed_force", "body": "rod", "value": [0, 1, 0]}]),
        "which is reduced to modes (bodies[0].model)",
    );
    refused(
        &|scene| scene["bodies"][0]["motion"] = json!({"deformation": ["0", "s", "0"]}),
        "of a line that deforms at the start",
    );
}

/// A velocity that counts as usual is that of the slowest bending, whatever the line is made of. Steps are measured by it where a scene rests
/// without gravity. Modes have the size of the distance from the centre of mass, half of the length.
#[test]
fn modes_and_elements_have_the_same_scale_of_time() {
    let natural = |model: Value| {
        let mut scene = along_x(&model);
        scene["outputs"] = json!([{"kind": "velocity", "marker": "rod.tip"}]);
        let run = Run::started(&scene);
        run.0
            .natural_size(&run.0.variables()[run.index("rod.tip.velocity[1]")])
    };
    let [modes, elements] = [
        json!({"model": "modal", "modes": 2}),
        json!({"model": "flexible", "elements": 4}),
    ]
    .map(natural);
    assert!(
        (2.0 * modes / elements - 1.0).abs() < 1e-9,
        "{modes} {elements}"
    );
}

/// Modes are displacements along axes that rotate: eigenvalues need a frame of the scene that rotates with the body.
#[test]
fn eigenvalues_of_a_line_that_spins_are_refused() {
    let mut scene = along_x(&json!({"model": "modal", "modes": 2}));
    scene["joints"] = json!([]);
    scene["outputs"] = json!([{"kind": "eigenvalue", "count": 3}]);
    let started = |scene: &Value| Run::ready(scene).0.initialize(0.0);
    assert!(started(&scene).is_ok());
    scene["bodies"][0]["motion"] = json!({"spin": [0, 0, 20]});
    let error = started(&scene).expect_err("a refusal").to_string();
    for words in ["reduced bodies that do not turn in space", "(\"rotation\")"] {
        assert!(error.contains(words), "{error}");
    }
}

/// Moments about two axes have no potential. Their equilibria are those of elements, in a basis where an iteration in the wrong coordinates
/// found none.
#[test]
fn equilibria_under_moments_about_two_axes_are_found() {
    let tip = |model: Value| -> [f64; 3] {
        let mut scene = along_x(&model);
        scene["outputs"] = json!([{"kind": "position", "marker": "rod.tip"}]);
        scene["loads"] =
            json!([{"name": "twist", "kind": "moment", "marker": "rod.tip", "value": [0, 5, 10]}]);
        scene["initial"] = json!("static_equilibrium");
        let mut run = Run::started(&scene);
        run.read_all("rod.tip.position")
    };
    let exact = tip(json!({"model": "flexible", "elements": 8}));
    for modes in [0, 4, 8] {
        let found = tip(json!({"model": "modal", "modes": modes}));
        for k in 0..3 {
            assert!(
                (found[k] - exact[k]).abs() < 2e-5 * LENGTH,
                "{modes}: {found:?} {exact:?}"
            );
        }
    }
}
