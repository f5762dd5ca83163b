//! Scenes with rods and with beams: moved as a whole, drawn from the other end, in the plane and beside cables.

use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;
use serde_json::{Map, Value, json};

use crate::laws::differences::{Outcome, check, within};
use crate::laws::moved::{Plane, agree, simulation};
use flexbody::simulation::Simulation;

const CASES: u32 = 6;
/// Beams take shorter steps.
const CASES_OF_BEAMS: u32 = 1;

/// Differences, relative to the size of what is compared, that roundoff may make at the start; and after steps, whose
/// lengths roundoff changes as well: what the tolerance allows, so many times.
pub const AT_START: f64 = 1e-8;
const AT_END: f64 = 1e2;
const TOLERANCE: f64 = 1e-9;
const TOLERANCE_OF_BEAMS: f64 = 1e-7;

pub const GRAVITY: [f64; 3] = [0.4, -0.3, -9.6];

pub fn rod(name: &str, elements: usize, shape: Value, axis: [f64; 3]) -> Value {
    json!({"name": name, "element": "rod", "elements": elements,
           "material": {"youngs_modulus": 1e9, "shear_modulus": 4e8, "density": 1000.0, "damping_time": 1e-3},
           "section": {"area": 1e-4, "second_moments": [1e-9, 3e-9], "torsion_constant": 1.5e-9, "coupling": [0.2, -0.1, 0.1]},
           "shape": shape, "axis": axis, "markers": {"root": 0.0, "mid": 0.5, "tip": 1.0}})
}

pub fn line(from: [f64; 3], to: [f64; 3]) -> Value {
    json!({"line": {"from": from, "to": to}})
}

pub fn read(kinds: &[&str], key: &str, of: &[&str]) -> Vec<Value> {
    let of = of.iter();
    of.flat_map(|of| kinds.iter().map(move |kind| json!({"kind": kind, key: of})))
        .collect()
}

/// Two rods on a ball, a rigid body at the end, a rod curved without stress, one that flies; forces and moments, dead and
/// following.
fn scene() -> Value {
    let mut free = rod(
        "free",
        4,
        line([2.0, 0.5, 0.0], [2.4, 0.9, 0.3]),
        [0.2, 0.1, 0.9],
    );
    free["motion"] = json!({"velocity": [0.3, -0.2, 0.4], "spin": [1.0, -2.0, 1.5]});
    let arc = json!({"arc": {"from": [0.0, 1.0, 0.5], "to": [0.8, 1.4, 0.4], "length": 1.1}});
    let bodies = [
        rod(
            "arm",
            4,
            line([0.1, 0.0, 0.2], [0.9, 0.3, 0.1]),
            [0.1, 0.2, 1.0],
        ),
        rod(
            "whip",
            4,
            line([0.9, 0.3, 0.1], [1.2, 0.6, -0.4]),
            [0.5, 0.4, 0.2],
        ),
        json!({"name": "bob", "element": "rigid", "mass": 0.05, "inertia": [1e-4, 2e-4, 2.5e-4],
               "position": [1.2, 0.6, -0.4], "orientation": {"matrix": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]},
               "markers": {"eye": [0.0, 0.0, 0.0], "edge": [0.02, -0.03, 0.01]}}),
        rod("hook", 4, arc, [-0.4, 0.8, 0.0]),
        free,
    ];
    let moving = ["arm.tip", "whip.mid", "bob.edge", "hook.tip", "free.tip"];
    let outputs = [
        read(
            &["position", "velocity", "acceleration", "orientation"],
            "marker",
            &moving,
        ),
        read(
            &["torque", "bending_moment", "axial_force"],
            "marker",
            &["arm.mid", "hook.mid"],
        ),
        read(&["reaction"], "joint", &["wall", "ball", "weld", "post"]),
        read(&["reaction_moment"], "joint", &["wall", "weld", "post"]),
        ["energy", "momentum", "center_of_mass"]
            .map(|kind| json!({"kind": kind}))
            .to_vec(),
    ];
    json!({"name": "rods", "dimension": 3, "gravity": GRAVITY, "bodies": bodies,
        "joints": [
            {"name": "wall", "kind": "weld", "markers": ["ground", "arm.root"]},
            {"name": "ball", "kind": "spherical", "markers": ["arm.tip", "whip.root"]},
            {"name": "weld", "kind": "weld", "markers": ["whip.tip", "bob.eye"]},
            {"name": "post", "kind": "weld", "markers": ["ground", "hook.root"]}],
        "loads": [
            {"name": "twist", "kind": "moment", "marker": "arm.tip", "value": [0.01, 0.02, -0.015]},
            {"name": "wind", "kind": "distributed_force", "body": "hook", "value": [0.05, 0.1, 0.02]},
            {"name": "pull", "kind": "force", "marker": "hook.tip", "value": [0.03, -0.02, 0.05]},
            {"name": "stay", "kind": "spring_damper", "markers": ["ground", "bob.edge"], "point": [1.5, 0.6, 0.2],
             "stiffness": 5.0, "damping": 0.02}],
        "outputs": outputs.concat(), "accuracy": {"relative_tolerance": TOLERANCE}})
}

/// The same of beams, that shear.
fn of_beams(mut scene: Value) -> Value {
    for body in scene["bodies"].as_array_mut().expect("bodies") {
        if body["element"] == "rod" {
            body["element"] = json!("beam");
            body["section"]["shear_factors"] = json!([0.9, 0.7]);
        }
    }
    scene["accuracy"]["relative_tolerance"] = json!(TOLERANCE_OF_BEAMS);
    scene
}

/// A motion of everything: a rotation about the origin, then a shift.
struct Whole {
    turn: Rotation3<f64>,
    shift: Vector3<f64>,
}

fn triple(of: &Value) -> Option<Vector3<f64>> {
    let numbers: Vec<f64> = of.as_array()?.iter().filter_map(Value::as_f64).collect();
    <[f64; 3]>::try_from(numbers).ok().map(Vector3::from)
}

impl Whole {
    /// As high as before, so that energies stay.
    fn level(turn: Rotation3<f64>, shift: [f64; 3]) -> Self {
        let (down, shift) = (
            turn * Vector3::from(GRAVITY).normalize(),
            Vector3::from(shift),
        );
        let shift = shift - down * down.dot(&shift);
        Self { turn, shift }
    }

    /// What stands in a scene, moved; numbers in axes of a body or of its section stay.
    fn moved(&self, key: &str, of: &Value) -> Value {
        let each = |keys: &Map<String, Value>| -> Value {
            let moved = keys
                .iter()
                .map(|(key, item)| (key.clone(), self.moved(key, item)));
            Value::Object(moved.collect())
        };
        match (key, of, triple(of)) {
            ("markers" | "section" | "inertia", ..) => of.clone(),
            ("from" | "to" | "position" | "point", _, Some(at)) => {
                self.numbers(self.turn * at + self.shift)
            }
            (_, _, Some(vector)) => self.numbers(self.turn * vector),
            ("matrix", ..) => {
                let rows = self.turn.matrix();
                json!([0, 1, 2].map(|i| [0, 1, 2].map(|j| rows[(i, j)])))
            }
            (_, Value::Array(list), None) => {
                list.iter().map(|item| self.moved(key, item)).collect()
            }
            (_, Value::Object(keys), None) => each(keys),
            _ => of.clone(),
        }
    }

    fn numbers(&self, of: Vector3<f64>) -> Value {
        json!(<[f64; 3]>::from(of))
    }

    /// What an output of this name says after the motion.
    fn read(&self, name: &str, of: &[f64]) -> Vec<f64> {
        let place = name.ends_with("position") || name == "center_of_mass";
        match of.len() {
            9 => (self.turn * Matrix3::from_row_slice(of))
                .transpose()
                .as_slice()
                .to_vec(),
            3 if place => (self.turn * Vector3::from_column_slice(of) + self.shift)
                .as_slice()
                .to_vec(),
            3 => (self.turn * Vector3::from_column_slice(of))
                .as_slice()
                .to_vec(),
            _ => of.to_vec(),
        }
    }
}

/// All outputs by name, components together.
pub fn outputs(simulation: &mut Simulation) -> Vec<(String, Vec<f64>)> {
    let names: Vec<(usize, String)> = (simulation.variables().iter().enumerate())
        .filter(|(_, variable)| variable.start.is_none() && variable.name != "time")
        .map(|(index, variable)| {
            (
                index,
                variable.name.split('[').next().unwrap_or_default().into(),
            )
        })
        .collect();
    let mut found: Vec<(String, Vec<f64>)> = Vec::new();
    for (index, name) in names {
        let value = simulation.real(index).expect("a number");
        match found.last_mut() {
            Some((last, values)) if *last == name => values.push(value),
            _ => found.push((name, vec![value])),
        }
    }
    found
}

/// Outputs of the second are those of the first, seen through `read`. The angular momentum about the origin is another where
/// the origin is.
pub fn same(
    [a, b]: [&mut Simulation; 2],
    read: impl Fn(&str, &[f64]) -> Vec<f64>,
    limit: f64,
) -> Outcome {
    for ((name, first), (other, second)) in outputs(a).into_iter().zip(outputs(b)) {
        prop_assert_eq!(&name, &other);
        if name == "angular_momentum" {
            continue;
        }
        let expected = read(&name, &first);
        let size = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (x, y) in expected.iter().zip(&second) {
            within(&name, (x - y).abs(), limit * size)?;
        }
    }
    Ok(())
}

/// Both from the start to the end.
fn alike(a: &Value, b: &Value, read: impl Fn(&str, &[f64]) -> Vec<f64>) -> Outcome {
    let told = |when: &'static str| move |e| TestCaseError::fail(format!("{when}: {e}"));
    let tolerance = a["accuracy"]["relative_tolerance"].as_f64();
    let limit = AT_END * tolerance.expect("a tolerance");
    let (mut a, mut b) = (simulation(a), simulation(b));
    same([&mut a, &mut b], &read, AT_START).map_err(told("start"))?;
    for part in 1..=3 {
        let until = 0.03 * f64::from(part);
        a.step(until).expect("a step");
        b.step(until).expect("a step");
    }
    same([&mut a, &mut b], &read, limit).map_err(told("end"))
}

/// An arc hangs in an upright plane: with it the scene rotates about the upright; without it about any axis.
fn moves_alike(scene: &Value, axis: [f64; 3], shift: [f64; 3]) -> Outcome {
    let upright = Whole::level(Rotation3::new(Vector3::z() * axis[0]), shift);
    let any = Whole::level(Rotation3::new(Vector3::from(axis)), shift);
    let (hanging, mut straight) = (scene.clone(), scene.clone());
    straight["bodies"][3]["shape"] = line([0.0, 1.0, 0.5], [0.8, 1.4, 0.4]);
    for (whole, scene) in [(upright, hanging), (any, straight)] {
        alike(&scene, &whole.moved("", &scene), |name, of| {
            whole.read(name, of)
        })?;
    }
    Ok(())
}

#[test]
fn scenes_with_rods_and_beams_move_alike_wherever_they_are() {
    for (cases, scene) in [(CASES, scene()), (CASES_OF_BEAMS, of_beams(scene()))] {
        let motions = (
            prop::array::uniform3(-2.0..2.0),
            prop::array::uniform3(-1.0..1.0),
        );
        check(cases, motions, |(axis, shift)| {
            moves_alike(&scene, axis, shift)
        });
    }
}

/// The same rod drawn from its other end: markers are as far from it, the first axis is where it was and the second opposite.
/// Then twist and bending about the second axis are what they were, bending about the first is opposite.
fn from_the_other_end(body: &Value) -> Value {
    let mut other = body.clone();
    let kind = if body["shape"]["arc"].is_object() {
        "arc"
    } else {
        "line"
    };
    let ends = &body["shape"][kind];
    other["shape"][kind]["from"] = ends["to"].clone();
    other["shape"][kind]["to"] = ends["from"].clone();
    for (name, at) in body["markers"].as_object().expect("markers") {
        other["markers"][name] = json!(1.0 - at.as_f64().expect("a number"));
    }
    for k in [0, 2] {
        let coupling = &body["section"]["coupling"][k];
        other["section"]["coupling"][k] = json!(-coupling.as_f64().expect("a number"));
    }
    if let (Some(velocity), Some(spin)) = (
        triple(&body["motion"]["velocity"]),
        triple(&body["motion"]["spin"]),
    ) {
        let way = triple(&ends["to"]).expect("a point") - triple(&ends["from"]).expect("a point");
        other["motion"]["velocity"] = json!(<[f64; 3]>::from(velocity + spin.cross(&way)));
    }
    other
}

/// Tangent and second axis are opposite, and so is what one side of a cut does to the other.
fn seen_from_the_other_end(name: &str, of: &[f64]) -> Vec<f64> {
    let opposite = |k: usize| match of.len() {
        9 => !name.starts_with("bob") && k % 3 != 1,
        _ => name.ends_with("bending_moment"),
    };
    let signed = of
        .iter()
        .enumerate()
        .map(|(k, x)| if opposite(k) { -x } else { *x });
    signed.collect()
}

#[test]
fn rods_and_beams_move_alike_from_whichever_end_they_are_drawn() {
    // Meshes are even: of an odd number of elements about a marker in the middle the last half has one more.
    let all = &["arm", "whip", "hook", "free"][..];
    for (scene, drawn) in [
        (scene(), &["arm"][..]),
        (scene(), &["hook", "free"]),
        (scene(), all),
        (of_beams(scene()), all),
    ] {
        let mut other = scene.clone();
        for body in other["bodies"].as_array_mut().expect("bodies") {
            if drawn.iter().any(|name| body["name"] == *name) {
                *body = from_the_other_end(body);
            }
        }
        let read = |name: &str, of: &[f64]| {
            if drawn.iter().any(|body| name.starts_with(body)) {
                seen_from_the_other_end(name, of)
            } else {
                of.to_vec()
            }
        };
        alike(&scene, &other, read).unwrap_or_else(|error| panic!("{drawn:?}: {error}"));
    }
}

/// Cables that stand, hang on pins and welds, and carry a body that rotates; forces, a moment, a spring.
pub fn flat() -> Value {
    let cable = |name: &str, elements: usize, from: [f64; 2], to: [f64; 2]| {
        json!({"name": name, "element": "cable", "elements": elements,
               "material": {"youngs_modulus": 1e9, "density": 1000.0, "damping_time": 1e-3},
               "section": {"area": 1e-4, "second_moment": 1e-9},
               "shape": {"line": {"from": from, "to": to}}, "markers": {"root": 0.0, "mid": 0.5, "tip": 1.0}})
    };
    let markers = ["arm.tip", "arm.mid", "elbow.tip", "swing.tip", "bob.edge"];
    let outputs = [
        read(
            &["position", "velocity", "acceleration"],
            "marker",
            &markers,
        ),
        read(
            &["bending_moment", "axial_force", "strain"],
            "marker",
            &["arm.mid", "swing.mid"],
        ),
        read(&["reaction"], "joint", &["wall", "corner", "pin", "hold"]),
        read(&["reaction_moment"], "joint", &["wall", "corner", "hold"]),
        ["energy", "momentum", "center_of_mass"]
            .map(|kind| json!({"kind": kind}))
            .to_vec(),
    ];
    json!({"name": "flat", "dimension": 2, "gravity": [0.4, -9.81],
        "bodies": [
            cable("arm", 4, [0.0, 0.0], [0.8, 0.1]), cable("elbow", 4, [0.8, 0.1], [0.9, -0.4]),
            cable("swing", 4, [0.9, -0.4], [1.4, -0.7]),
            {"name": "bob", "element": "rigid", "mass": 0.05, "inertia": 2e-4, "position": [1.4, -0.7],
             "markers": {"eye": [0.0, 0.0], "edge": [0.02, -0.03]}}],
        "joints": [
            {"name": "wall", "kind": "weld", "markers": ["ground", "arm.root"]},
            {"name": "corner", "kind": "weld", "markers": ["arm.tip", "elbow.root"]},
            {"name": "pin", "kind": "revolute", "markers": ["elbow.tip", "swing.root"]},
            {"name": "hold", "kind": "weld", "markers": ["swing.tip", "bob.eye"]}],
        "loads": [
            {"name": "pull", "kind": "force", "marker": "arm.mid", "value": [0.05, 0.1]},
            {"name": "wind", "kind": "distributed_force", "body": "elbow", "value": [0.2, -0.1]},
            {"name": "turn", "kind": "moment", "marker": "swing.root", "value": "0.004"},
            {"name": "stay", "kind": "spring_damper", "markers": ["ground", "bob.edge"], "point": [1.5, 0.2],
             "stiffness": 5.0, "damping": 0.02}],
        "outputs": outputs.concat(), "accuracy": {"relative_tolerance": 1e-11}})
}

/// A scene of the plane in one of space; `line` makes of its cables or beams what they are there.
pub fn in_space(plane: &Plane, flat: &Value, line: impl Fn(&mut Value)) -> Value {
    let mut there = plane.moved("", flat);
    there["dimension"] = json!(3);
    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| plane.axes[(i, j)]));
    let pairs = there["bodies"]
        .as_array_mut()
        .into_iter()
        .flatten()
        .zip(flat["bodies"].as_array().into_iter().flatten());
    for (body, flat) in pairs {
        if body["element"] == "rigid" {
            body["orientation"] = json!({"matrix": rows});
            body["inertia"] = json!([1e-4, 1.5e-4, flat["inertia"]]);
            for (name, at) in flat["markers"].as_object().expect("markers") {
                body["markers"][name] = json!([at[0], at[1], 0.0]);
            }
            continue;
        }
        body["axis"] = json!(plane.normal());
        line(body);
    }
    for joint in there["joints"].as_array_mut().expect("joints") {
        if joint["kind"] == "revolute" {
            // In axes of the section: the first across the line is the normal.
            joint["direction"] = json!([0.0, 1.0, 0.0]);
        }
    }
    for load in there["loads"].as_array_mut().expect("loads") {
        if load["kind"] == "moment" {
            let value = load["value"].as_str().expect("an expression").to_owned();
            load["value"] = json!(plane.normal().map(|n| format!("{n:?}*({value})")));
        }
    }
    there
}

/// The same of rods that bend as easily about the normal of the plane, and otherwise as they like.
fn of_rods(plane: &Plane, flat: &Value) -> Value {
    in_space(plane, flat, |body| {
        body["element"] = json!("rod");
        body["material"]["shear_modulus"] = json!(4e8);
        body["section"] =
            json!({"area": 1e-4, "second_moments": [1e-9, 4e-9], "torsion_constant": 3e-9});
    })
}

fn bends_alike((axis, distance): ([f64; 3], f64)) -> Outcome {
    let plane = Plane {
        axes: Rotation3::new(Vector3::from(axis)),
        distance,
    };
    let flat = flat();
    let there = of_rods(&plane, &flat);
    let told = |when: &'static str| move |e| TestCaseError::fail(format!("{when}: {e}"));
    let (mut flat, mut rods) = (simulation(&flat), simulation(&there));
    agree(&mut flat, &mut rods, &plane, [1e-10, AT_START]).map_err(told("start"))?;
    for part in 1..=3 {
        let until = 0.03 * f64::from(part);
        flat.step(until).expect("a step in the plane");
        rods.step(until).expect("a step in space");
    }
    agree(&mut flat, &mut rods, &plane, [1e-8, 1e-7]).map_err(told("end"))
}

/// Of the same mesh (markers of rods are nodes, those of cables only where something acts): bending about the normal of a plane is what a cable of the plane knows.
#[test]
fn cables_of_the_plane_and_rods_in_it_move_alike() {
    let planes = || (prop::array::uniform3(-2.0..2.0), -1.0..1.0);
    check(CASES, planes(), bends_alike);
}
