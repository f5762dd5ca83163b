//! Keys of reduced bodies, of which a specimen would have to bring a file: claims of their own, with the strip of the book. It has a
//! length of 0.5 m and modes in closed form (`docs/book/examples/bodies/strip.py`).

use flexbody::scene::{Modes, Scene, beside};
use flexbody::simulation::{Budget, Simulation, plan};
use nalgebra::{Rotation3, Vector3};
use serde_json::{Value, json};

const LENGTH: f64 = 0.5;

/// A scene with the strip, which moves freely, with these keys more.
fn strip(keys: &Value) -> Value {
    let mut body = json!({"name": "strip", "element": "reduced", "file": "strip.safetensors",
        "position": [0, 0, 0], "markers": {"root": "root", "tip": "tip"}});
    for (key, value) in keys.as_object().into_iter().flatten() {
        body[key] = value.clone();
    }
    let outputs: Vec<Value> = ["root", "tip"]
        .iter()
        .flat_map(|marker| {
            let marker = format!("strip.{marker}");
            ["position", "velocity", "orientation", "angular_velocity"]
                .map(|kind| json!({"kind": kind, "marker": marker}))
        })
        .chain([
            json!({"kind": "natural_frequency", "count": 7}),
            json!({"kind": "energy"}),
        ])
        .collect();
    json!({"name": "strip", "dimension": 3, "bodies": [body], "outputs": outputs,
        "accuracy": {"relative_tolerance": 1e-7}})
}

fn read(scene: &Value) -> Result<Scene, String> {
    read_with(scene, |_| Ok(()))
}

/// Reads a scene with the file of the strip changed.
fn read_with(
    scene: &Value,
    change: impl Fn(&mut [u8]) -> Result<(), String>,
) -> Result<Scene, String> {
    let folder = crate::root().join("docs/book/examples/bodies");
    let files = |name: &str| {
        let mut bytes = beside(&folder)(name)?;
        change(&mut bytes)?;
        Ok(bytes)
    };
    let scene = Scene::from_json_with(&scene.to_string(), &files);
    scene.map_err(|error| error.to_string())
}

struct Run(Simulation);

impl Run {
    fn new(scene: &Value) -> Result<Self, String> {
        Self::set(scene, &[])
    }

    /// With parameters set.
    fn set(scene: &Value, values: &[(&str, f64)]) -> Result<Self, String> {
        Self::of(read(scene)?, values)
    }

    /// Of a scene that was read, with parameters set.
    fn of(scene: Scene, values: &[(&str, f64)]) -> Result<Self, String> {
        let mut run = Self(Simulation::new(scene));
        for (name, value) in values {
            let index = run.index(name)?;
            let set = run.0.set_real(index, *value);
            set.map_err(|error| error.to_string())?;
        }
        run.0.initialize(0.0).map_err(|error| error.to_string())?;
        run.0.start().map_err(|error| error.to_string())?;
        Ok(run)
    }

    fn index(&self, name: &str) -> Result<usize, String> {
        let place = self.0.variables().iter().position(|v| v.name == name);
        place.ok_or_else(|| format!("{name}: no such variable"))
    }

    fn value(&mut self, name: &str) -> Result<f64, String> {
        let index = self.index(name)?;
        self.0.real(index).map_err(|error| error.to_string())
    }

    fn vector(&mut self, name: &str) -> Result<Vector3<f64>, String> {
        let mut vector = Vector3::zeros();
        for (k, part) in vector.iter_mut().enumerate() {
            *part = self.value(&format!("{name}[{}]", k + 1))?;
        }
        Ok(vector)
    }

    /// Natural frequencies but those of rigid motions, Hz.
    fn frequencies(&mut self) -> Result<Vec<f64>, String> {
        let listed = self.0.variables().iter();
        let listed = listed.filter(|of| of.name.starts_with("natural_frequency"));
        let all = (1..=listed.count()).map(|k| self.value(&format!("natural_frequency[{k}]")));
        let all = all.collect::<Result<Vec<_>, _>>()?;
        let hertz = all.into_iter().map(|of| of / std::f64::consts::TAU);
        Ok(hertz.filter(|of| *of > 1.0).collect())
    }
}

fn near(found: f64, expected: f64, within: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= within,
        "expected {expected}, found {found}, {off} off"
    );
}

/// `position`, `orientation`, `motion` and `markers`: both interfaces move as points of a rigid body, whose origin is that of the file.
#[test]
fn a_strip_stands_and_moves_as_described() -> Result<(), String> {
    let turn = Vector3::new(0.4, -0.3, 0.6);
    let (place, velocity) = (Vector3::new(0.3, -0.4, 0.8), Vector3::new(1.0, -2.0, 0.5));
    let spin = Vector3::new(0.3, 0.2, -0.1);
    let list = |v: Vector3<f64>| <[f64; 3]>::from(v);
    let mut run = Run::new(&strip(&json!({
        "position": list(place), "orientation": {"rotation_vector": list(turn)},
        "motion": {"velocity": list(velocity), "spin": list(spin)}})))?;
    let axes = Rotation3::new(turn).into_inner();
    for (marker, along) in [("root", 0.0), ("tip", LENGTH)] {
        let arm = axes.column(0) * along;
        let at = |what: &str| format!("strip.{marker}.{what}");
        let expected = [
            ("position", place + arm),
            ("velocity", velocity + spin.cross(&arm)),
            ("angular_velocity", spin),
        ];
        for (what, expected) in expected {
            let off = (run.vector(&at(what))? - expected).norm();
            assert!(off < 1e-12, "{marker} {what}: {off}");
        }
        for (k, part) in axes.transpose().iter().enumerate() {
            let name = at(&format!("orientation[{}]", k + 1));
            near(run.value(&name)?, *part, 1e-12);
        }
    }
    // Markers the other way round.
    let mut run = Run::new(&strip(&json!({"markers": {"root": "tip", "tip": "root"}})))?;
    near(run.value("strip.root.position[1]")?, LENGTH, 1e-15);
    Ok(())
}

/// `modes`: the first ones, those up to a frequency, or all.
#[test]
fn a_strip_has_the_modes_that_are_taken() -> Result<(), String> {
    // Six rigid motions come first.
    let found = |modes: &Value, count: usize| {
        let mut scene = strip(&json!({"modes": modes}));
        scene["outputs"] = json!([{"kind": "natural_frequency", "count": 6 + count}]);
        Run::new(&scene)?.frequencies()
    };
    let all = found(&json!("all"), 6)?;
    // Source: S. S. Rao, Vibration of continuous systems (2007), chapter 11: beta L = 4.730 of the free beam.
    let first = 22.3733 / std::f64::consts::TAU * (2.1e11 / 7850.0 / 12.0f64).sqrt() * 0.003
        / LENGTH.powi(2);
    near(all[0] / first, 1.0, 0.01);
    for (modes, count) in [
        (json!("all"), 6),
        (json!(2), 2),
        (json!({"up_to": 1.01 * all[1]}), 2),
        (json!({"up_to": 0.99 * all[1]}), 1),
    ] {
        let taken = found(&modes, count)?;
        assert_eq!(taken.len(), count, "{modes}: {taken:?}");
        (taken.iter().zip(&all)).for_each(|(a, b)| near(*a, *b, 1e-6 * b));
        assert!(found(&modes, count + 1).is_err(), "{modes}");
    }
    Ok(())
}

/// `modes`: with none the body is rigid: a pendulum of its mass and inertia.
#[test]
fn a_strip_without_modes_is_rigid() -> Result<(), String> {
    let mut scene = strip(&json!({"modes": 0}));
    scene["gravity"] = json!([0, 0, -9.81]);
    scene["outputs"] = json!([{"kind": "acceleration", "marker": "strip.tip"}, {"kind": "energy"}]);
    scene["joints"] = json!([{"name": "pivot", "kind": "revolute", "direction": [0, 1, 0],
        "markers": ["ground", "strip.root"]}]);
    let mut run = Run::new(&scene)?;
    // m g L / 2 about an inertia of m L^2 / 3 + m t^2 / 12, about the edge of a plate.
    let (length, thickness) = (LENGTH, 0.003f64);
    let inertia = length.powi(2) / 3.0 + thickness.powi(2) / 12.0;
    let expected = -9.81 * length / 2.0 / inertia * length;
    near(run.value("strip.tip.acceleration[3]")?, expected, 1e-9);
    assert_eq!(run.value("energy.strain")?, 0.0);
    // Bit for bit as the rigid body of its mass and inertia.
    let read_scene = read(&scene)?;
    let container = read_scene.bodies[0]
        .reduced()
        .ok_or("a reduced body")?
        .contained();
    let inertia = &container.tensor()[..3];
    scene["bodies"][0] = json!({"name": "strip", "element": "rigid", "mass": container.model.mass, "inertia": inertia,
        "position": [LENGTH / 2.0, 0, 0], "markers": {"root": [-LENGTH / 2.0, 0, 0], "tip": [LENGTH / 2.0, 0, 0]}});
    let mut rigid = Run::new(&scene)?;
    for step in 1..=20 {
        for run in [&mut run, &mut rigid] {
            let done = run.0.step(0.02 * f64::from(step));
            done.map_err(|error| error.to_string())?;
        }
        let [a, b] = [
            run.vector("strip.tip.acceleration")?,
            rigid.vector("strip.tip.acceleration")?,
        ];
        assert_eq!(a, b, "{step}");
    }
    Ok(())
}

/// `modes`: with held interfaces; the clamped strip has the same natural frequencies as with all modes of the file, and deflects alike.
#[test]
fn a_strip_has_natural_modes_with_held_interfaces() -> Result<(), String> {
    let clamped = |modes: &Value, count: usize| {
        let mut scene = strip(&json!({"modes": modes}));
        scene["joints"] =
            json!([{"name": "wall", "kind": "weld", "markers": ["ground", "strip.root"]}]);
        scene["outputs"] = json!([{"kind": "natural_frequency", "count": count}]);
        Run::new(&scene)?.frequencies()
    };
    let all = clamped(&json!("all"), 3)?;
    // Source: S. S. Rao, Vibration of continuous systems (2007), chapter 11: beta L = 1.875 of a cantilever.
    let first = 3.51602 / std::f64::consts::TAU * (2.1e11 / 7850.0 / 12.0f64).sqrt() * 0.003
        / LENGTH.powi(2);
    near(all[0] / first, 1.0, 1e-3);
    for count in 1..=3 {
        let held = clamped(&json!({"fixed_interface": count}), count)?;
        assert_eq!(held.len(), count);
        (held.iter().zip(&all)).for_each(|(a, b)| near(*a, *b, 1e-7 * b));
        // The first modes of the free strip are no substitute.
        let free = clamped(&json!(count), count)?;
        assert!(free[0] > 1.02 * all[0], "{free:?}");
    }
    Ok(())
}

/// Stresses of the file follow its modes in any basis: the strip hangs from its clamp with the same stress.
#[test]
fn a_gauge_reads_the_same_in_any_basis() -> Result<(), String> {
    let stress = |modes: &Value| {
        let mut scene = strip(&json!({"modes": modes, "gauges": {"root": "root"}}));
        scene["gravity"] = json!([0, 0, -9.81]);
        scene["joints"] =
            json!([{"name": "wall", "kind": "weld", "markers": ["ground", "strip.root"]}]);
        scene["initial"] = json!({"state": "static_equilibrium"});
        scene["outputs"] = json!([{"kind": "stress_tensor", "gauge": "strip.root"}]);
        Run::new(&scene)?.value("strip.root.von_mises_stress")
    };
    let whole = stress(&json!("all"))?;
    assert!(whole > 1e6, "{whole}");
    near(stress(&json!({"fixed_interface": 6}))?, whole, 1e-9 * whole);
    near(stress(&json!({"fixed_interface": 3}))?, whole, 0.05 * whole);
    Ok(())
}

/// The deflection of the clamped strip from its root is the way of its tip, in axes of the scene; from the mean axes it is that way less what these
/// rotate and move: of a shape `x^2 (6 L^2 - 4 L x + x^2)` about, the tip is farther from the mean than the middle.
#[test]
fn a_strip_deflects_from_its_root_and_from_mean_axes() -> Result<(), String> {
    let mut scene = strip(&json!({}));
    scene["gravity"] = json!([0, 0, -0.981]);
    scene["joints"] =
        json!([{"name": "wall", "kind": "weld", "markers": ["ground", "strip.root"]}]);
    scene["initial"] = json!({"state": "static_equilibrium"});
    scene["outputs"] = json!([{"kind": "position", "marker": "strip.tip"},
        {"kind": "deflection", "marker": "strip.tip", "from": "strip.root"},
        {"kind": "deflection", "marker": "strip.tip"}, {"kind": "deflection", "marker": "strip.root"}]);
    let mut run = Run::new(&scene)?;
    let fallen = run.value("strip.tip.position[3]")?;
    // w L^4 / (8 E I) of a strip of 30 x 3 mm.
    let exact = -7850.0 * 0.03 * 0.003 * 0.981 * LENGTH.powi(4)
        / (8.0 * 2.1e11 * 0.03 * 0.003_f64.powi(3) / 12.0);
    near(fallen, exact, 0.01 * exact.abs());
    near(
        run.value("strip.tip.deflection_from_root[3]")?,
        fallen,
        1e-9,
    );
    let [tip, root] = ["tip", "root"].map(|of| run.value(&format!("strip.{of}.deflection[3]")));
    let (tip, root) = (tip?, root?);
    // Ends bend to one side of the line that fits best, which passes 0.6 and 0.9 of the length.
    assert!(tip < 0.0 && root < 0.0, "{tip} {root}");
    assert!(tip.abs() < 0.2 * fallen.abs(), "{tip} {fallen}");
    Ok(())
}

/// `critically_damped`: with both ends held the strip has static shapes, which answer to loads without ringing where that is said.
#[test]
fn static_shapes_of_a_strip_answer() -> Result<(), String> {
    let bent = |modes: &Value, is_damped: bool| {
        let mut scene = strip(&json!({"modes": modes, "critically_damped": is_damped}));
        scene["joints"] = json!([
            {"name": "wall", "kind": "weld", "markers": ["ground", "strip.root"]},
            {"name": "guide", "kind": "point_on_line", "direction": [1, 0, 0], "markers": ["ground", "strip.tip"]}]);
        scene["initial"] = json!({"state": "static_equilibrium"});
        scene["gravity"] = json!([0, 0, -9.81]);
        scene["outputs"] =
            json!([{"kind": "reaction_moment", "joint": "wall"}, {"kind": "energy"}]);
        Run::new(&scene)?.value("wall.reaction_moment[2]")
    };
    let whole = bent(&json!("all"), true)?;
    // A propped cantilever under its weight: w L^2 / 8 at the clamp (S. P. Timoshenko, Strength of materials I, section 44).
    let weight = 7850.0 * 0.03 * 0.003 * 9.81;
    near(
        whole.abs(),
        weight * LENGTH.powi(2) / 8.0,
        0.05 * whole.abs(),
    );
    for is_damped in [true, false] {
        let held = bent(&json!({"fixed_interface": 2}), is_damped)?;
        near(held, whole, 0.02 * whole.abs());
    }
    Ok(())
}

/// `modes`: left to the planner, which takes as many as the error wanted needs, and none where the strip may be rigid.
#[test]
fn a_strip_has_as_many_modes_as_the_error_wanted_needs() -> Result<(), String> {
    let scene = |modes: &Value, kind: &str, accuracy: Value| {
        let mut scene = strip(&json!({"modes": modes, "damping_ratio": 0.05}));
        scene["gravity"] = json!([0, 0, -9.81]);
        scene["joints"] =
            json!([{"name": "root", "kind": kind, "markers": ["ground", "strip.root"]}]);
        if kind == "revolute" {
            scene["joints"][0]["direction"] = json!([0, 1, 0]);
        }
        scene["outputs"] = json!([{"kind": "position", "marker": "strip.tip"}]);
        scene["accuracy"] = accuracy;
        scene["experiment"] = json!({"stop_time": 0.3, "step": 0.01});
        scene
    };
    let planned = |kind: &str, error: f64| -> Result<(Modes, Vec<f64>), String> {
        let open = read(&scene(&json!("auto"), kind, json!({"error": error})))?;
        let (planned, _) = plan(&open, &Budget::default(), &mut |_, _, _| ())
            .map_err(|error| error.to_string())?;
        let body = planned.bodies[0].reduced().ok_or("a reduced body")?;
        let modes = body.modes;
        Ok((modes, path(Run::of(planned, &[])?)?))
    };
    for (kind, error, is_rigid) in [("weld", 1e-2, false), ("revolute", 5e-2, true)] {
        let exact = json!({"relative_tolerance": 1e-7});
        let whole = path(Run::new(&scene(&json!("all"), kind, exact))?)?;
        let (modes, found) = planned(kind, error)?;
        match modes {
            Modes::Count(0) => assert!(is_rigid, "{kind}"),
            Modes::FixedInterface(of) => {
                assert!(
                    !is_rigid && (1..6).contains(&of.fixed_interface),
                    "{kind}: {of:?}"
                );
            }
            _ => return Err(format!("{kind}: {modes:?}")),
        }
        let fall = whole
            .iter()
            .map(|of| (of - whole[0]).abs())
            .fold(0.0, f64::max);
        // The account is an estimate, made at communication points.
        for (found, whole) in found.iter().zip(&whole) {
            near(*found, *whole, 2.0 * error * fall);
        }
    }
    Ok(())
}

/// Heights of the tip for 0.3 s, m.
fn path(mut run: Run) -> Result<Vec<f64>, String> {
    let mut heights = vec![run.value("strip.tip.position[3]")?];
    for step in 1..=30 {
        let done = run.0.step(0.01 * f64::from(step));
        done.map_err(|error| error.to_string())?;
        heights.push(run.value("strip.tip.position[3]")?);
    }
    Ok(heights)
}

/// `damping_ratio`: a mode decays as `exp(-2 pi f d t)`; a number is a parameter, a table is linear between its rows.
#[test]
fn a_strip_is_damped_as_described() -> Result<(), String> {
    // Mechanical energy that is left after ten periods of the first mode, which a kick across the middle of the ends excites.
    let left = |damping: &Value, set: &[(&str, f64)]| {
        let mut scene = strip(&json!({"damping_ratio": damping, "modes": 1}));
        let ends = ["root", "tip"].map(|end| {
            json!({"name": end, "kind": "force", "marker": format!("strip.{end}"),
                "value": [0, 0, {"table": [[0, 1], [0.05, 1], [0.0500001, 0], [1, 0]]}]})
        });
        scene["loads"] = json!(ends);
        let mut run = Run::set(&scene, set)?;
        let mut amplitude = [0.0, 0.0];
        for (k, begin) in [0.06, 0.16].into_iter().enumerate() {
            for step in 0..40 {
                let until = begin + 0.5e-3 * f64::from(step);
                let stepped = run.0.step(until);
                stepped.map_err(|failure| failure.reason.to_string())?;
                amplitude[k] = run.value("energy.strain")?.max(amplitude[k]);
            }
        }
        Ok::<f64, String>((amplitude[0] / amplitude[1]).ln())
    };
    let scene = read(&strip(&json!({})))?;
    let body = scene.bodies[0].reduced().expect("a reduced body");
    let frequency = body.contained().frequencies()[0];
    let expected = |ratio: f64| 2.0 * std::f64::consts::TAU * frequency * ratio * 0.1;
    near(left(&json!(0.0), &[])?, 0.0, 0.02);
    near(left(&json!(0.01), &[])? / expected(0.01), 1.0, 0.05);
    near(
        left(&json!(0.0), &[("strip.damping_ratio", 0.01)])? / expected(0.01),
        1.0,
        0.05,
    );
    let table = json!([[0.5 * frequency, 0.0], [1.5 * frequency, 0.02]]);
    near(left(&table, &[])? / expected(0.01), 1.0, 0.05);
    Ok(())
}

/// `file` and `sha256`: another file and another digest are refused.
#[test]
fn a_strip_is_read_from_its_file() -> Result<(), String> {
    let refused = |keys: Value| read(&strip(&keys)).expect_err("a refusal");
    assert!(
        refused(json!({"file": "strap.safetensors"}))
            .starts_with("bodies[0].file: \"strap.safetensors\": ")
    );
    let digest = "0".repeat(64);
    assert!(
        refused(json!({"sha256": digest})).starts_with("bodies[0].sha256: expected the digest of")
    );
    let written = read(&strip(&json!({})))?.to_json();
    let written: Value = serde_json::from_str(&written).map_err(|error| error.to_string())?;
    read(&written)?;
    assert_eq!(
        written["bodies"][0]["sha256"].as_str().map(str::len),
        Some(64)
    );
    Ok(())
}

/// A strip that bends beyond a tenth of its length is told of once, by its name; one that bends less is not.
#[test]
fn a_strip_that_bends_too_far_is_told_of() -> Result<(), String> {
    for (force, is_told) in [(0.1, false), (60.0, true)] {
        let mut scene = strip(&json!({"damping_ratio": 0.5}));
        scene["outputs"] = json!([{"kind": "position", "marker": "strip.tip"}]);
        scene["joints"] =
            json!([{"name": "clamp", "kind": "weld", "markers": ["ground", "strip.root"]}]);
        scene["loads"] = json!([{"name": "pull", "kind": "force", "marker": "strip.tip", "value": [0, 0, force]}]);
        let mut run = Run::new(&scene)?;
        let mut told = Vec::new();
        for step in 1..=20 {
            let stepped = run.0.step(0.01 * f64::from(step));
            stepped.map_err(|failure| failure.to_string())?;
            while let Some(found) = run.0.next_over_deformed() {
                told.push(found.to_string());
            }
        }
        assert_eq!(told.len(), usize::from(is_told), "{force} N: {told:?}");
        assert!(
            told.iter()
                .all(|told| told.starts_with("strip: its deformation leaves"))
        );
    }
    Ok(())
}

/// A strip that a drive spins about an inclined axis, with these keys of the scene more.
fn spun(keys: &Value) -> Value {
    let mut scene = strip(&json!({"orientation": {"rotation_vector": [0, -0.5, 0]}}));
    scene["joints"] = json!([{"name": "pin", "kind": "revolute", "direction": [0, 0, 1],
        "markers": ["ground", "strip.root"]}]);
    scene["outputs"] = json!([{"kind": "position", "marker": "strip.tip"}, {"kind": "velocity", "marker": "strip.tip"},
        {"kind": "acceleration", "marker": "strip.tip"}, {"kind": "energy"}]);
    for (key, value) in keys.as_object().into_iter().flatten() {
        scene[key] = value.clone();
    }
    scene
}

/// A steady start is in balance with centrifugal forces: the strip keeps its shape while it rotates. It bends towards the plane of rotation.
#[test]
fn a_strip_rotates_steadily() -> Result<(), String> {
    let rate = 20.0;
    let mut run = Run::new(&spun(&json!({"initial": "steady",
        "motions": [{"name": "drive", "kind": "angle", "joint": "pin", "value": "20*t"}]})))?;
    let straight = LENGTH * 0.5_f64.sin();
    let start = run.vector("strip.tip.position")?;
    assert!(start.z < 0.95 * straight, "{start}");
    for step in 1..=20 {
        let time = 0.01 * f64::from(step);
        run.0.step(time).map_err(|error| error.to_string())?;
        let turned = Rotation3::new(Vector3::z() * rate * time) * start;
        let off = (run.vector("strip.tip.position")? - turned).norm();
        assert!(off < 1e-6, "{time}: {off}");
    }
    Ok(())
}

/// A scene described in a frame that rotates: the strip moves as it does in space, seen from there.
#[test]
fn a_strip_moves_in_a_frame_that_rotates() -> Result<(), String> {
    let rotation = Vector3::new(3.0, -5.0, 8.0);
    let spin = Vector3::new(2.0, 9.0, -4.0);
    let list = |v: Vector3<f64>| <[f64; 3]>::from(v);
    // Joints at the origin stand in both.
    let joint = json!([{"name": "ball", "kind": "spherical", "markers": ["ground", "strip.root"]}]);
    // A force that follows the strip bends it.
    let force = json!([{"name": "push", "kind": "force", "marker": "strip.tip", "follower": true, "value": [0.0, 0.3, 2.0]}]);
    let of = |rotation: Vector3<f64>, spin: Vector3<f64>| {
        let mut scene = spun(&json!({"joints": joint, "loads": force, "rotation": list(rotation)}));
        scene["bodies"][0]["motion"] = json!({"spin": list(spin)});
        Run::new(&scene)
    };
    let mut resting = of(Vector3::zeros(), spin)?;
    let mut rotating = of(rotation, spin - rotation)?;
    let (mut largest, mut strain): (f64, f64) = (0.0, 0.0);
    for step in 0..=20 {
        let time = 0.01 * f64::from(step);
        if step > 0 {
            for run in [&mut resting, &mut rotating] {
                run.0.step(time).map_err(|error| error.to_string())?;
            }
        }
        let turned = Rotation3::new(rotation * time).inverse();
        let [place, velocity] = [
            resting.vector("strip.tip.position")?,
            resting.vector("strip.tip.velocity")?,
        ]
        .map(|of| turned * of);
        let seen = velocity - rotation.cross(&place);
        largest = largest.max((rotating.vector("strip.tip.position")? - place).norm());
        let off = (rotating.vector("strip.tip.velocity")? - seen).norm();
        largest = largest.max(off / 100.0);
        strain = strain.max(resting.value("energy.strain")?);
    }
    assert!(largest < 1e-6, "{largest}");
    assert!(strain > 1e-3, "{strain}");
    Ok(())
}

/// A strip at the end of a beam hangs in equilibrium: the clamp carries both weights, and their moments about it to what deflections
/// change.
#[test]
fn a_strip_on_a_beam_hangs_in_equilibrium() -> Result<(), String> {
    let mut scene = strip(&json!({"position": [0.4, 0, 0]}));
    scene["gravity"] = json!([0, 0, -9.81]);
    let beam = json!({"name": "beam", "element": "beam", "elements": 4,
        "material": {"youngs_modulus": 2e10, "shear_modulus": 8e9, "density": 7850},
        "section": {"shape": {"rectangle": {"width": 0.03, "height": 0.006}}},
        "shape": {"line": {"from": [0, 0, 0], "to": [0.4, 0, 0]}}, "markers": {"clamp": 0, "end": 1}});
    let bodies = scene["bodies"].as_array_mut().ok_or("bodies")?;
    bodies.push(beam);
    scene["joints"] = json!([{"name": "wall", "kind": "weld", "markers": ["ground", "beam.clamp"]},
        {"name": "seam", "kind": "weld", "markers": ["beam.end", "strip.root"]}]);
    scene["outputs"] = json!([{"kind": "reaction", "joint": "wall"}, {"kind": "reaction_moment", "joint": "wall"}]);
    scene["initial"] = json!({"state": "static_equilibrium"});
    let mut run = Run::new(&scene)?;
    let [beam, strip] = [7850.0 * 0.03 * 0.006 * 0.4, 0.35325].map(|mass| 9.81 * mass);
    near(run.value("wall.reaction[3]")?.abs(), beam + strip, 1e-6);
    let moment = beam * 0.2 + strip * (0.4 + 0.25);
    near(
        run.value("wall.reaction_moment[2]")?.abs(),
        moment,
        0.01 * moment,
    );
    Ok(())
}

/// Modes of the strip.
const MODES: usize = 6;
/// Section of the strip, m: width along y, thickness along z.
const SECTION: [f64; 2] = [0.03, 0.003];
/// Factors of the components of a stress that is no stress of a strip.
const FACTORS: [f64; 6] = [1.0, 0.5, -0.25, 2.0, 3.0, -1.5];

/// The strip with its axes rotated, clamped at its root, in equilibrium under a force along these axes at its tip.
fn bent_strip(force: [f64; 3], turn: [f64; 3]) -> Value {
    let force: [f64; 3] = (Rotation3::new(turn.into()) * Vector3::from(force)).into();
    let turned = json!({"rotation_vector": turn});
    let mut scene = strip(&json!({"gauges": {"foot": "root"}, "orientation": turned}));
    scene["joints"] =
        json!([{"name": "clamp", "kind": "weld", "markers": ["ground", "strip.root"]}]);
    scene["loads"] =
        json!([{"name": "pull", "kind": "force", "marker": "strip.tip", "value": force}]);
    scene["outputs"] = json!([{"kind": "stress_tensor", "gauge": "strip.foot"}]);
    scene["initial"] = json!({"state": "static_equilibrium"});
    scene
}

/// `gauges`: bending stress `6 F L / (b h^2)` where the strip is clamped, by forces along both axes of its section, wherever its axes stand.
#[test]
fn a_strip_has_the_stress_of_a_clamped_beam() -> Result<(), String> {
    let [width, height] = SECTION;
    let [along_y, along_z] = [0.5, -0.02];
    let expected = -6.0 * LENGTH / (width * height) * (along_y / width + along_z / height);
    for turn in [[0.0; 3], [0.4, -0.3, 0.6]] {
        let mut run = Run::new(&bent_strip([0.0, along_y, along_z], turn))?;
        let within = 1e-5 * expected.abs();
        near(run.value("strip.foot.stress_tensor[1]")?, expected, within);
        near(
            run.value("strip.foot.von_mises_stress")?,
            expected.abs(),
            within,
        );
        for k in 2..=6 {
            near(
                run.value(&format!("strip.foot.stress_tensor[{k}]"))?,
                0.0,
                1e-9,
            );
        }
    }
    Ok(())
}

/// Numbers of an array of a file, to be read and changed.
fn array<'a>(bytes: &'a mut [u8], name: &str) -> Result<&'a mut [[u8; 8]], String> {
    let (length, rest) = bytes.split_at_mut(8);
    let length = u64::from_le_bytes(length.try_into().map_err(|_| "a length")?);
    let (header, data) = rest.split_at_mut(length as usize);
    let header: Value = serde_json::from_slice(header).map_err(|error| error.to_string())?;
    let place = |end: usize| {
        let place = header[name]["data_offsets"][end].as_u64();
        place.ok_or_else(|| format!("no array {name}"))
    };
    let (numbers, _) = data[place(0)? as usize..place(1)? as usize].as_chunks_mut();
    Ok(numbers)
}

/// Components stand in the order of the file, and make the equivalent stress.
#[test]
fn a_gauge_has_the_components_of_its_file() -> Result<(), String> {
    let scene = bent_strip([0.0, 0.0, -0.02], [0.0; 3]);
    let factored = read_with(&scene, |bytes| {
        let rows = array(bytes, "stress.root")?;
        for at in (0..rows.len()).rev() {
            let first = f64::from_le_bytes(rows[at % MODES]);
            rows[at] = (FACTORS[at / MODES] * first).to_le_bytes();
        }
        Ok(())
    })?;
    let mut run = Run::of(factored, &[])?;
    let first = run.value("strip.foot.stress_tensor[1]")?;
    for (k, factor) in FACTORS.iter().enumerate() {
        let name = format!("strip.foot.stress_tensor[{}]", k + 1);
        near(run.value(&name)?, factor * first, 1e-9 * first.abs());
    }
    let [xx, yy, zz, xy, xz, yz] = FACTORS;
    let normal: f64 = [xx - yy, yy - zz, zz - xx]
        .iter()
        .map(|of| of * of / 2.0)
        .sum();
    let shear: f64 = [xy, xz, yz].iter().map(|of| 3.0 * of * of).sum();
    let expected = (normal + shear).sqrt() * first.abs();
    let found = run.value("strip.foot.von_mises_stress")?;
    near(found, expected, 1e-9 * expected);
    Ok(())
}

/// Stress follows the strains that the energy counts: where the components of a stress are the strains of the six modes, times the roots of
/// their stiffness, their squares make the energy. Pairs of the first mode strain the last one here.
#[test]
fn a_gauge_follows_the_strain_of_the_energy() -> Result<(), String> {
    let mut scene = bent_strip([0.0, 0.3, -0.5], [0.0; 3]);
    scene["outputs"] =
        json!([{"kind": "stress_tensor", "gauge": "strip.foot"}, {"kind": "energy"}]);
    let strained = read_with(&scene, |bytes| {
        let eigenvalues = array(bytes, "eigenvalues")?.to_vec();
        let eigenvalues = eigenvalues.into_iter().map(f64::from_le_bytes);
        let last = MODES * MODES * (MODES - 1);
        array(bytes, "cubic")?[last] = 1e7f64.to_le_bytes();
        let rows = array(bytes, "stress.root")?;
        rows.fill(0.0f64.to_le_bytes());
        for (k, eigenvalue) in eigenvalues.enumerate() {
            rows[(MODES + 1) * k] = (0.5 * eigenvalue).sqrt().to_le_bytes();
        }
        Ok(())
    })?;
    let mut run = Run::of(strained, &[])?;
    let mut sum = 0.0;
    for k in 1..=6 {
        sum += run
            .value(&format!("strip.foot.stress_tensor[{k}]"))?
            .powi(2);
    }
    let energy = run.value("energy.strain")?;
    near(sum, energy, 1e-12 * energy);
    Ok(())
}
