//! A planar scene moved into any plane of space moves there as it does in the plane.

use flexbody::scene::Scene;
use flexbody::simulation::Simulation;
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::laws::differences::{Outcome, check, within};

const CASES: u32 = 12;

/// Difference, relative to the size of what is compared, that roundoff may make: of positions, and of forces and
/// accelerations, which stiffness magnifies it to.
const KINEMATIC: f64 = 1e-12;
const DYNAMIC: f64 = 1e-9;

/// Something of everything that there is in space.
fn planar(initial: &str) -> Value {
    let material = json!({"youngs_modulus": 1e7, "density": 1000.0, "damping_time": 1e-3});
    let section = |second_moment: f64| json!({"area": 1e-4, "second_moment": second_moment});
    let particle = |name: &str, at: [f64; 2]| json!({"name": name, "element": "rigid", "mass": 0.2, "position": at, "markers": {"eye": [0.0, 0.0]}});
    json!({
        "name": "moved", "dimension": 2, "gravity": [0.4, -9.81],
        "bodies": [
            {"name": "rod", "element": "cable", "elements": 6, "material": material, "section": section(1e-9),
             "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.1]}},
             "markers": {"root": 0.0, "mid": 0.5, "three": 0.75, "tip": 1.0}},
            {"name": "rope", "element": "cable", "elements": 4, "material": material, "section": section(0.0),
             "shape": {"line": {"from": [1.0, 0.1], "to": [1.8, -0.3]}}, "markers": {"first": 0.0, "last": 1.0}},
            particle("bob", [1.8, -0.3]), particle("slide", [0.5, -0.9]), particle("ring", [0.3, 0.03]),
            particle("free", [2.0, 0.5]), particle("driven", [2.2, 0.0]),
            {"name": "guide", "element": "cable", "elements": 2, "material": material, "section": section(1e-9),
             "shape": {"line": {"from": [3.0, 0.0], "to": [3.5, 0.1]}}, "markers": {"root": 0.0, "tip": 1.0}},
            {"name": "vane", "element": "cable", "elements": 2, "material": material, "section": section(1e-9),
             "shape": {"line": {"from": [3.0, 1.0], "to": [3.4, 0.8]}}, "markers": {"root": 0.0, "tip": 1.0}}],
        "masses": [{"marker": "rod.three", "mass": 0.1}],
        "joints": [
            {"name": "clamp", "kind": "weld", "markers": ["ground", "rod.root"]},
            {"name": "knot", "kind": "revolute", "markers": ["rod.tip", "rope.first"]},
            {"name": "hold", "kind": "revolute", "markers": ["rope.last", "bob.eye"]},
            {"name": "link", "kind": "distance", "markers": ["rod.mid", "slide.eye"]},
            {"name": "rail", "kind": "point_on_line", "markers": ["ground", "slide.eye"], "direction": [1.0, 0.2]},
            {"name": "track", "kind": "point_on_line", "markers": ["ground", "driven.eye"], "direction": [0.3, -1.0],
             "point": [2.2, 0.0]},
            {"name": "sleeve", "kind": "prismatic", "markers": ["ground", "guide.root"], "direction": [1.0, 0.4]},
            {"name": "turned", "kind": "orientation", "markers": ["ground", "vane.root"]},
            {"name": "threaded", "kind": "point_on_cable", "markers": ["rod", "ring.eye"]}],
        "motions": [{"name": "drive", "kind": "displacement", "joint": "track", "value": "0.1*sin(5*t)"}],
        "loads": [
            {"name": "spring", "kind": "spring_damper", "markers": ["ground", "bob.eye"], "point": [2.5, 0.5],
             "stiffness": 5.0, "damping": 0.1},
            {"name": "stay", "kind": "spring_damper", "markers": ["ground", "ring.eye"], "point": [0.2, 0.5],
             "stiffness": 30.0, "damping": 0.2},
            {"name": "tie", "kind": "spring_damper", "markers": ["driven.eye", "free.eye"], "stiffness": 8.0,
             "damping": 0.2},
            {"name": "stop", "kind": "spring_damper", "markers": ["ground", "guide.root"], "point": [2.6, 0.0],
             "stiffness": 40.0, "damping": 0.2},
            {"name": "hang", "kind": "spring_damper", "markers": ["ground", "vane.tip"], "point": [3.4, 1.5],
             "stiffness": 40.0, "damping": 0.2},
            {"name": "wind", "kind": "distributed_force", "body": "rope", "value": [0.2, -0.1]},
            {"name": "pull", "kind": "force", "marker": "rod.mid", "value": [0.3, 0.2]}],
        "inputs": [{"kind": "force", "marker": "rod.tip", "start": [0.1, -0.2]},
                   {"kind": "distributed_force", "body": "rod", "start": [0.05, 0.1]}],
        "ports": [{"name": "plug", "marker": "bob.eye", "kind": "force"},
                  {"name": "mount", "marker": "free.eye", "kind": "motion", "stiffness": 20.0, "damping": 0.5}],
        "outputs": [
            {"kind": "position", "marker": "rod.tip"}, {"kind": "velocity", "marker": "rod.mid"},
            {"kind": "acceleration", "marker": "ring.eye"}, {"kind": "travel", "joint": "threaded"},
            {"kind": "strain", "marker": "rod.three"}, {"kind": "axial_force", "marker": "rod.mid"},
            {"kind": "bending_moment", "marker": "rod.mid"}, {"kind": "connectivity_force", "marker": "rod.three"},
            {"kind": "reaction", "joint": "clamp"}, {"kind": "reaction", "joint": "link"},
            {"kind": "reaction", "joint": "threaded"}, {"kind": "reaction", "joint": "sleeve"},
            {"kind": "position", "marker": "guide.tip"}, {"kind": "position", "marker": "vane.root"}, {"kind": "reaction", "motion": "drive"},
            {"kind": "energy"}, {"kind": "work"}, {"kind": "momentum"}, {"kind": "center_of_mass"}],
        "initial": initial,
        "accuracy": {"relative_tolerance": 1e-6}})
}

/// A plane of space: its axes, and how far it is from the origin along the third.
pub struct Plane {
    pub axes: Rotation3<f64>,
    pub distance: f64,
}

impl Plane {
    pub fn normal(&self) -> [f64; 3] {
        (self.axes * Vector3::z()).into()
    }

    pub fn vector(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        (self.axes * Vector3::new(x, y, 0.0)).into()
    }

    pub fn point(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        (self.axes * Vector3::new(x, y, self.distance)).into()
    }

    /// A scene, or a part of one, moved into the plane: pairs of numbers become triples.
    pub fn moved(&self, key: &str, of: &Value) -> Value {
        let pair = || -> Option<[f64; 2]> {
            let numbers: Vec<f64> = of.as_array()?.iter().filter_map(Value::as_f64).collect();
            numbers.try_into().ok()
        };
        let is_point = ["from", "to", "position", "point"].contains(&key);
        match (of, pair()) {
            (_, Some(pair)) if is_point => json!(self.point(pair)),
            // A marker of a particle, or a direction, a force, gravity.
            (_, Some(pair)) => json!(self.vector(pair)),
            (Value::Array(list), None) => list.iter().map(|item| self.moved(key, item)).collect(),
            (Value::Object(keys), None) => (keys.iter())
                .map(|(key, item)| (key.clone(), self.moved(key, item)))
                .collect(),
            _ => of.clone(),
        }
    }
}

pub fn simulation(scene: &Value) -> Simulation {
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("an initial state");
    simulation
}

fn output(simulation: &mut Simulation, name: &str) -> Option<f64> {
    let index = (simulation.variables().iter()).position(|variable| variable.name == name)?;
    Some(simulation.real(index).expect("a number"))
}

/// A number, or the components of a vector.
pub fn values(simulation: &mut Simulation, name: &str) -> Vec<f64> {
    let parts = (1..=3).map(|k| format!("{name}[{k}]"));
    let components: Vec<f64> = parts.filter_map(|part| output(simulation, &part)).collect();
    if components.is_empty() {
        vec![output(simulation, name).expect("an output")]
    } else {
        components
    }
}

/// Both say the same, but for so much: of positions, and of the rest.
pub fn agree(
    flat: &mut Simulation,
    moved: &mut Simulation,
    plane: &Plane,
    [kinematic, dynamic]: [f64; 2],
) -> Outcome {
    let names: std::collections::BTreeSet<String> = (flat.variables().iter())
        .filter(|variable| variable.start.is_none() && variable.name != "time")
        .map(|variable| variable.name.split('[').next().unwrap_or_default().into())
        .collect();
    for name in names {
        let (in_plane, in_space) = (values(flat, &name), values(moved, &name));
        let expected = match (in_plane[..].as_ref(), in_space.len()) {
            ([x, y], 3) if name.ends_with("position") || name == "center_of_mass" => {
                plane.point([*x, *y]).to_vec()
            }
            ([x, y], 3) => plane.vector([*x, *y]).to_vec(),
            // What rotates in the plane rotates about its normal; beside that the distance from the origin counts.
            ([z], 3) => {
                let normal = plane.axes * Vector3::z();
                let along = normal.dot(&Vector3::from_column_slice(&in_space));
                within(&name, (along - z).abs(), dynamic * z.abs().max(1.0))?;
                continue;
            }
            (same, _) => same.to_vec(),
        };
        let is_kinematic = ["position", "center_of_mass", "travel"]
            .iter()
            .any(|end| name.ends_with(end));
        let limit = if is_kinematic { kinematic } else { dynamic };
        let size = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (a, b) in expected.iter().zip(&in_space) {
            within(&name, (a - b).abs(), limit * size)?;
        }
    }
    Ok(())
}

fn runs_alike(initial: &str, (axis, distance): ([f64; 3], f64)) -> Outcome {
    let plane = Plane {
        axes: Rotation3::new(Vector3::from(axis)),
        distance,
    };
    let mut scene = planar(initial);
    if initial != "undeformed" {
        // Newton's method ends at 1e-9 where something slides along a cable, whose tangent is not whole.
        scene["joints"].as_array_mut().expect("joints").pop();
        scene["outputs"]
            .as_array_mut()
            .expect("outputs")
            .retain(|output| output["joint"] != "threaded");
    }
    let mut there = plane.moved("", &scene);
    there["dimension"] = json!(3);
    for joint in there["joints"].as_array_mut().expect("joints") {
        if joint["kind"] == "revolute" {
            joint["kind"] = json!("spherical");
        }
    }
    let (mut flat, mut moved) = (simulation(&scene), simulation(&there));
    agree(&mut flat, &mut moved, &plane, [KINEMATIC, DYNAMIC])
        .map_err(|e| TestCaseError::fail(format!("{initial} start {e}")))?;
    for part in 1..=3 {
        let until = 0.05 * f64::from(part);
        flat.step(until).expect("a step in the plane");
        moved.step(until).expect("a step in space");
        prop_assert_eq!(flat.report().method, moved.report().method);
    }
    agree(&mut flat, &mut moved, &plane, [KINEMATIC, DYNAMIC])
        .map_err(|e| TestCaseError::fail(format!("{initial} end {e}")))
}

#[test]
fn a_planar_scene_moves_alike_in_any_plane_of_space() {
    let planes = || (prop::array::uniform3(-2.0..2.0), -1.0..1.0);
    check(CASES, planes(), |plane| runs_alike("undeformed", plane));
    check(CASES, planes(), |plane| {
        runs_alike("static_equilibrium", plane)
    });
}
