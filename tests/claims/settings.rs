//! Every parameter is the key of the scene that it is named after, and every input acts: on what, and in
//! which unit, the claims say that hold with it and fail with another value.

use std::collections::BTreeSet;
use std::sync::Mutex;

use flexbody::scene::Scene;
use flexbody::simulation::{Parameter, Simulation, Source};
use serde_json::{Value, json};

use crate::claims::coverage::for_each_specimen;
use crate::claims::mutate::with;
use crate::claims::specimen::{Outcome, Specimen, limits, units};

/// Names all parameters, with the list and the key of the scene that they stand for and their units.
macro_rules! keys {
    ($($variant:ident => $list:literal, $key:literal, $unit:literal;)*) => {
        const PARAMETERS: &[&str] = &[$(stringify!($variant)),*, "Inertia", "SecondMoments", "SectionLength", "Gravity", "Rotation", "RelativeTolerance"];
        /// Name, place in the scene and unit of a parameter whose variable bears the name of a part.
        fn key(parameter: Parameter, scene: &Value, variable: &str) -> (&'static str, String, &'static str) {
            match parameter {
                $(Parameter::$variant(..) => {
                    let place = part(scene, $list, variable);
                    (stringify!($variant), format!("/{}/{place}{}", $list, $key), $unit)
                })*
                Parameter::Inertia(_, axis) => {
                    let place = format!("/bodies/{}/inertia", part(scene, "bodies", variable));
                    // A number in the plane, moments or a matrix in space.
                    let found = scene.pointer(&place).and_then(Value::as_array);
                    let place = match found.map(|rows| rows[0].is_array()) {
                        None => place,
                        Some(false) => format!("{place}/{axis}"),
                        Some(true) => format!("{place}/{axis}/{axis}"),
                    };
                    ("Inertia", place, "kg.m2")
                }
                Parameter::SecondMoments(_, axis) => {
                    let place = part(scene, "bodies", variable);
                    ("SecondMoments", format!("/bodies/{place}/section/second_moments/{axis}"), "m4")
                }
                Parameter::SectionLength(..) => {
                    let (_, key) = variable.rsplit_once('.').expect("a key");
                    let section = format!("/bodies/{}/section/shape", part(scene, "bodies", variable));
                    let shape = scene.pointer(&section).and_then(Value::as_object);
                    let shape = shape.and_then(|kinds| kinds.keys().next()).expect("a shape");
                    ("SectionLength", format!("{section}/{shape}/{key}"), "m")
                }
                Parameter::SolidLength(..) => {
                    let place = format!("/bodies/{}/shape", part(scene, "bodies", variable));
                    let key = counted_from_zero(variable);
                    let shape = scene.pointer(&place).and_then(Value::as_object);
                    let shape = shape.and_then(|kinds| kinds.keys().next()).expect("a shape");
                    (of_each(SIZES, &format!("{shape}/{key}")), format!("{place}/{shape}/{key}"), "m")
                }
                Parameter::Load(..) => of_load(scene, variable),
                Parameter::Gravity(axis) => ("Gravity", format!("/gravity/{axis}"), "m/s2"),
                Parameter::Rotation(axis) => {
                    let place = if scene["rotation"].is_array() { format!("/rotation/{axis}") } else { "/rotation".into() };
                    ("Rotation", place, "rad/s")
                }
                Parameter::RelativeTolerance => ("RelativeTolerance", "/accuracy/relative_tolerance".into(), ""),
                // Its claim is in `reduced.rs`.
                Parameter::DampingRatio(_) => {
                    let place = part(scene, "bodies", variable);
                    ("DampingRatio", format!("/bodies/{place}/damping_ratio"), "")
                }
                // Their claims are in `patches.rs`.
                Parameter::PatchModulus(_)
                | Parameter::PatchRatio(_)
                | Parameter::PatchDensity(_)
                | Parameter::PatchDamping(_)
                | Parameter::PatchThickness(_)
                | Parameter::PatchAngle(_) => {
                    panic!("{variable}: no specimen has a plate")
                }
                // Its claim is in `own.rs`: it changes no result.
                Parameter::WorkLimit => ("WorkLimit", "/method/work_limit".into(), ""),
            }
        }
    };
}

/// Lengths of shapes of rigid bodies, every one with a claim of its own.
const SIZES: &[&str] = &[
    "box/size/0",
    "box/size/1",
    "box/size/2",
    "cylinder/radius",
    "cylinder/length",
    "sphere/radius",
    "tube/radius",
    "tube/inner_radius",
    "tube/length",
];
/// Numbers of loads, every one with a claim of its own.
const LOADS: &[&str] = &[
    "stiffness N/m",
    "stiffness N/m2",
    "stiffness N.m/rad",
    "damping N.s/m",
    "damping N.m.s/rad",
    "damping s/m",
    "damping s/rad",
    "tangential_stiffness N/m",
    "tangential_damping N.s/m",
    "axial_stiffness N",
    "damping_time s",
    "friction ",
    "stribeck_speed m/s",
    "stribeck_speed rad/s",
    "density kg/m3",
    "drag ",
    "tangential_drag ",
    "added_mass ",
    "chord m",
    "span m",
    "translational_stiffness/0 N/m",
    "translational_stiffness/1 N/m",
    "translational_stiffness/2 N/m",
    "translational_damping/0 N.s/m",
    "translational_damping/1 N.s/m",
    "translational_damping/2 N.s/m",
    "rotational_stiffness/0 N.m/rad",
    "rotational_stiffness/1 N.m/rad",
    "rotational_stiffness/2 N.m/rad",
    "rotational_damping/0 N.m.s/rad",
    "rotational_damping/1 N.m.s/rad",
    "rotational_damping/2 N.m.s/rad",
];

/// One of these names.
fn of_each(names: &[&'static str], name: &str) -> &'static str {
    let found = names.iter().find(|found| **found == name);
    found.unwrap_or_else(|| panic!("{name}: expected one of {names:?}"))
}

/// The key that the name of a variable ends with; components have numbers from 1 there, in a scene from 0.
fn counted_from_zero(variable: &str) -> String {
    let (_, key) = variable.rsplit_once('.').expect("a key");
    let Some((key, number)) = key.strip_suffix(']').and_then(|key| key.split_once('[')) else {
        return key.into();
    };
    let number: usize = number.parse().expect("a number");
    format!("{key}/{}", number - 1)
}

/// Name, place in the scene and unit of a number of a load.
fn of_load(scene: &Value, variable: &str) -> (&'static str, String, &'static str) {
    let key = counted_from_zero(variable);
    let place = part(scene, "loads", variable);
    let load = &scene["loads"][place];
    let is_angle = load["coordinate"] == "angle" || {
        let mut joints = scene["joints"].as_array().into_iter().flatten();
        let joint = joints.find(|joint| joint["name"] == load["joint"]);
        load["coordinate"].is_null() && joint.is_some_and(|joint| joint["kind"] == "revolute")
    };
    let kind = load["kind"].as_str().expect("a kind");
    let (number, _) = key.split_once('/').unwrap_or((&key, ""));
    let unit = match (kind, number, is_angle) {
        ("joint_spring" | "joint_limit", "stiffness", true) => "N.m/rad",
        ("joint_spring", "damping", true) => "N.m.s/rad",
        ("joint_limit", "damping", true) => "s/rad",
        ("joint_limit" | "contact", "damping", _) => "s/m",
        ("contact", "stiffness", _) if load["body"].is_string() => "N/m2",
        (_, "stiffness" | "translational_stiffness" | "tangential_stiffness", _) => "N/m",
        (_, "damping" | "translational_damping" | "tangential_damping", _) => "N.s/m",
        (_, "rotational_stiffness", _) => "N.m/rad",
        (_, "rotational_damping", _) => "N.m.s/rad",
        (_, "stribeck_speed", true) => "rad/s",
        (_, "stribeck_speed", false) => "m/s",
        (_, "density", _) => "kg/m3",
        (_, "axial_stiffness", _) => "N",
        (_, "damping_time", _) => "s",
        (_, "chord" | "span", _) => "m",
        _ => "",
    };
    let label = of_each(LOADS, &format!("{key} {unit}"));
    (label, format!("/loads/{place}/{key}"), unit)
}

/// Place in its list of the part whose name begins that of a variable.
fn part(scene: &Value, list: &str, variable: &str) -> usize {
    let (owner, _) = variable.rsplit_once('.').expect("the name of a part");
    let key = if list == "masses" { "marker" } else { "name" };
    let parts = scene[list].as_array().expect("a list");
    let place = parts.iter().position(|part| part[key] == owner);
    place.expect("a part of this name")
}

keys! {
    YoungsModulus => "bodies", "/material/youngs_modulus", "Pa";
    LineLoad => "bodies", "/material/density", "kg/m3";
    SolidDensity => "bodies", "/density", "kg/m3";
    DampingTime => "bodies", "/material/damping_time", "s";
    Area => "bodies", "/section/area", "m2";
    SecondMoment => "bodies", "/section/second_moment", "m4";
    ShearModulus => "bodies", "/material/shear_modulus", "Pa";
    TorsionConstant => "bodies", "/section/torsion_constant", "m4";
    Elements => "bodies", "/elements", "";
    Mass => "bodies", "/mass", "kg";
    LumpedMass => "masses", "/mass", "kg";
    ReleaseTime => "joints", "/release_time", "s";
    HingeStiffness => "joints", "/stiffness", "N.m/rad";
    HingeDamping => "joints", "/damping", "N.m.s/rad";
    CouplingStiffness => "ports", "/stiffness", "N/m";
    CouplingDamping => "ports", "/damping", "N.s/m";
    RotationalStiffness => "ports", "/rotational_stiffness", "N.m/rad";
    RotationalDamping => "ports", "/rotational_damping", "N.m.s/rad";
}

/// What the master sets, by list of the scene, and its unit.
const INPUTS: [(&str, &str); 99] = [
    ("inputs.release", ""),
    ("inputs.distributed_moment[1]", "N.m/m"),
    ("inputs.distributed_moment[2]", "N.m/m"),
    ("inputs.distributed_moment[3]", "N.m/m"),
    ("inputs.distributed_follower_moment[1]", "N.m/m"),
    ("inputs.distributed_follower_moment[2]", "N.m/m"),
    ("inputs.distributed_follower_moment[3]", "N.m/m"),
    ("inputs.force[1]", "N"),
    ("inputs.force[2]", "N"),
    ("inputs.follower_force[1]", "N"),
    ("inputs.follower_force[2]", "N"),
    ("inputs.force[3]", "N"),
    ("inputs.distributed_force[3]", "N/m"),
    ("motions.position[3]", "m"),
    ("motions.velocity[3]", "m/s"),
    ("motions.acceleration[3]", "m/s2"),
    ("ports.force[3]", "N"),
    ("ports.position[3]", "m"),
    ("ports.velocity[3]", "m/s"),
    ("ports.acceleration[3]", "m/s2"),
    ("couplings.position[3]", "m"),
    ("couplings.velocity[3]", "m/s"),
    ("inputs.follower_force[3]", "N"),
    ("inputs.moment[1]", "N.m"),
    ("inputs.moment[2]", "N.m"),
    ("inputs.moment[3]", "N.m"),
    ("inputs.follower_moment[1]", "N.m"),
    ("inputs.follower_moment[2]", "N.m"),
    ("inputs.follower_moment[3]", "N.m"),
    ("inputs.moment", "N.m"),
    ("inputs.torque", "N.m"),
    ("inputs.distributed_force[1]", "N/m"),
    ("inputs.distributed_force[2]", "N/m"),
    ("inputs.rest_length", "m"),
    ("inputs.control", ""),
    ("motions.distance", "m"),
    ("inputs.current[1]", "m/s"),
    ("inputs.current[2]", "m/s"),
    ("motions.position[1]", "m"),
    ("motions.position[2]", "m"),
    ("motions.velocity[1]", "m/s"),
    ("motions.velocity[2]", "m/s"),
    ("motions.acceleration[1]", "m/s2"),
    ("motions.acceleration[2]", "m/s2"),
    ("motions.angle", "rad"),
    ("motions.angular_velocity", "rad/s"),
    ("motions.angular_acceleration", "rad/s2"),
    ("motions.displacement", "m"),
    ("motions.travel", "m"),
    ("motions.velocity", "m/s"),
    ("motions.acceleration", "m/s2"),
    ("ports.force[1]", "N"),
    ("ports.force[2]", "N"),
    ("ports.moment", "N.m"),
    ("ports.moment[1]", "N.m"),
    ("ports.moment[2]", "N.m"),
    ("ports.moment[3]", "N.m"),
    ("ports.position[1]", "m"),
    ("ports.position[2]", "m"),
    ("ports.velocity[1]", "m/s"),
    ("ports.velocity[2]", "m/s"),
    ("ports.acceleration[1]", "m/s2"),
    ("ports.acceleration[2]", "m/s2"),
    ("ports.angle", "rad"),
    ("ports.angular_velocity", "rad/s"),
    ("ports.angular_acceleration", "rad/s2"),
    ("motions.quaternion[1]", ""),
    ("motions.quaternion[2]", ""),
    ("motions.quaternion[3]", ""),
    ("motions.quaternion[4]", ""),
    ("motions.angular_velocity[1]", "rad/s"),
    ("motions.angular_velocity[2]", "rad/s"),
    ("motions.angular_velocity[3]", "rad/s"),
    ("motions.angular_acceleration[1]", "rad/s2"),
    ("motions.angular_acceleration[2]", "rad/s2"),
    ("motions.angular_acceleration[3]", "rad/s2"),
    ("ports.quaternion[1]", ""),
    ("ports.quaternion[2]", ""),
    ("ports.quaternion[3]", ""),
    ("ports.quaternion[4]", ""),
    ("ports.angular_velocity[1]", "rad/s"),
    ("ports.angular_velocity[2]", "rad/s"),
    ("ports.angular_velocity[3]", "rad/s"),
    ("ports.angular_acceleration[1]", "rad/s2"),
    ("ports.angular_acceleration[2]", "rad/s2"),
    ("ports.angular_acceleration[3]", "rad/s2"),
    // Through a spring and a damper.
    ("couplings.position[1]", "m"),
    ("couplings.position[2]", "m"),
    ("couplings.velocity[1]", "m/s"),
    ("couplings.velocity[2]", "m/s"),
    ("couplings.angle", "rad"),
    ("couplings.angular_velocity", "rad/s"),
    ("couplings.quaternion[1]", ""),
    ("couplings.quaternion[2]", ""),
    ("couplings.quaternion[3]", ""),
    ("couplings.quaternion[4]", ""),
    ("couplings.angular_velocity[1]", "rad/s"),
    ("couplings.angular_velocity[2]", "rad/s"),
    ("couplings.angular_velocity[3]", "rad/s"),
];

/// Names that are still to be seen, and what is wrong.
type Findings = Mutex<(BTreeSet<String>, Vec<String>)>;

fn findings(names: impl IntoIterator<Item = &'static str>) -> Findings {
    Mutex::new((names.into_iter().map(String::from).collect(), Vec::new()))
}

fn conclude(findings: Findings) {
    let (missing, wrong) = findings.into_inner().expect("no panic while locked");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let missing: Vec<String> = missing.into_iter().collect();
    assert!(
        missing.is_empty(),
        "expected specimens of {}",
        missing.join(", ")
    );
}

fn simulation(scene: &Value) -> Simulation {
    Simulation::new(Scene::from_json(&scene.to_string()).expect("a scene"))
}

/// Whether a section stands upright by the gravity of the scene, which it keeps whatever gravity a master sets.
fn stands_by_gravity(scene: &Value) -> bool {
    let bodies = scene["bodies"].as_array();
    let has_axes = |body: &Value| {
        let element = body["element"].as_str();
        matches!(element, Some("rod" | "beam")) && body.get("axis").is_none()
    };
    scene["dimension"] == 3 && bodies.is_some_and(|bodies| bodies.iter().any(has_axes))
}

/// A key with another value, where there is one and it is accepted.
fn changed(scene: &Value, pointer: &str) -> Option<(Value, f64)> {
    let found = scene.pointer(pointer)?;
    let value = found.as_f64()?;
    let tried = match found.as_u64() {
        Some(n) if pointer.ends_with("elements") => [json!(n + 1), json!(n - 1)],
        _ if value == 0.0 => [json!(0.05), json!(-0.05)],
        _ => [json!(1.05 * value), json!(0.95 * value)],
    };
    let scenes = tried.map(|value| with(scene, pointer, value));
    let valid = |scene: &Value| Scene::from_json(&scene.to_string()).is_ok();
    scenes.into_iter().find(valid).map(|scene| (scene, value))
}

/// The change of a key is noticed, and the parameter undoes it.
#[test]
fn every_parameter_is_its_key() {
    let all = [PARAMETERS, SIZES, LOADS].concat();
    let findings = findings(all);
    for_each_specimen(|specimen| {
        // What becomes of a damping ratio follows from all other keys.
        if specimen.scene.to_string().contains("damping_ratio") {
            return;
        }
        let known = specimen.variables();
        let units = units(&specimen.scene);
        for (index, variable) in simulation(&specimen.scene).variables().iter().enumerate() {
            let Source::Parameter(parameter) = variable.source else {
                continue;
            };
            let (label, pointer, unit) = key(parameter, &specimen.scene, &variable.name);
            if pointer.starts_with("/gravity") && stands_by_gravity(&specimen.scene) {
                continue;
            }
            let Some((scene, value)) = changed(&specimen.scene, &pointer) else {
                continue;
            };
            let mut wrong = Vec::new();
            let place = format!("{}: {}", specimen.name, variable.name);
            if variable.start != Some(value) {
                wrong.push(format!(
                    "{place}: expected the start {value}, found {:?}",
                    variable.start
                ));
            }
            if units.get(&variable.name).is_some_and(|found| found != unit) {
                wrong.push(format!("{place}: expected the unit {unit}"));
            }
            // That of the model description stays as packaged; see the tests of tolerances.
            let is_told = specimen
                .claims
                .iter()
                .any(|claim| claim.of == "@DefaultExperiment/tolerance");
            if label == "RelativeTolerance" && is_told {
                continue;
            }
            let noticed = specimen.judge(&scene, &known).is_noticed();
            let undone = specimen.judge_set(&scene, &known, &[(index, value)]);
            if undone != Outcome::Holds {
                wrong.push(format!(
                    "{place} does not undo a change of {pointer}: {undone:?}"
                ));
            }
            let mut findings = findings.lock().expect("no panic while locked");
            findings.1.extend(wrong);
            if noticed || label == "RelativeTolerance" {
                findings.0.remove(label);
            }
        }
    });
    conclude(findings);
}

/// A master that reads the model description knows what it must not set.
#[test]
fn parameters_out_of_their_limits_are_those_that_are_refused() {
    let findings = findings([]);
    for_each_specimen(|specimen| {
        let limits = limits(&specimen.scene);
        let mut simulation = simulation(&specimen.scene);
        for index in 0..simulation.variables().len() {
            let variable = &simulation.variables()[index];
            let (name, is_integer) = (variable.name.clone(), variable.is_integer());
            if !matches!(variable.source, Source::Parameter(_)) {
                continue;
            }
            let before = simulation.setting(index);
            let mut set = |value: f64| {
                if is_integer {
                    simulation.set_integer(index, value as i32).is_ok()
                } else {
                    simulation.set_real(index, value).is_ok()
                }
            };
            let [least, greatest] = limits[&name];
            for value in [-1.0, 2e5] {
                let is_within = least.is_none_or(|least| value >= least)
                    && greatest.is_none_or(|greatest| value <= greatest);
                if set(value) != is_within {
                    let mut findings = findings.lock().expect("no panic while locked");
                    let place = format!("{}: {name}", specimen.name);
                    findings.1.push(format!(
                        "{place}: {value}, limits {least:?} and {greatest:?}"
                    ));
                }
                assert!(set(before), "{name}: its own value is refused");
            }
        }
    });
    conclude(findings);
}

/// The list of a scene that an input comes from, by its name: that of a motion, of a port, or of what a load
/// acts on.
fn list(scene: &Value, variable: &str) -> &'static str {
    let (owner, _) = variable.rsplit_once('.').expect("the name of a part");
    let find = |list: &str| {
        let parts = scene[list].as_array().into_iter().flatten();
        parts.into_iter().find(|part| part["name"] == owner)
    };
    match find("ports") {
        Some(port) if port["stiffness"].is_number() || port["damping"].is_number() => "couplings",
        Some(_) => "ports",
        None if find("motions").is_some() => "motions",
        None => "inputs",
    }
}

/// The specimen with another value of an input, set by the master or there at the start.
fn disturbed(specimen: &Specimen, known: &[String], (index, start): (usize, f64)) -> Outcome {
    let name = &known[index];
    let mut other = specimen.clone();
    let mut is_set = false;
    for (_, set, value) in &mut other.settings {
        if set == name {
            *value += 0.05 * (1.0 + value.abs());
            is_set = true;
        }
    }
    other.claims.retain(|claim| claim.of != *name);
    let extra = [(index, start + 0.05 * (1.0 + start.abs()))];
    other.judge_set(&specimen.scene, known, if is_set { &[] } else { &extra })
}

#[test]
fn every_input_acts_in_its_unit() {
    let findings = findings(INPUTS.iter().map(|(name, _)| *name));
    for_each_specimen(|specimen| {
        let known = specimen.variables();
        let units = units(&specimen.scene);
        let simulation = simulation(&specimen.scene);
        for (index, variable) in simulation.variables().iter().enumerate() {
            let Source::Input(_) = variable.source else {
                continue;
            };
            let list = list(&specimen.scene, &variable.name);
            let word = variable.name.rsplit('.').next().unwrap_or_default();
            let label = format!("{list}.{word}");
            let noticed = disturbed(specimen, &known, (index, variable.start.unwrap_or(0.0)));
            let mut findings = findings.lock().expect("no panic while locked");
            let same = |(name, _): &&(&str, &str)| *name == label;
            let unit = INPUTS.iter().find(same).map(|(_, unit)| *unit);
            let found = units.get(&variable.name).map_or("", String::as_str);
            if unit != Some(found) {
                findings.1.push(format!(
                    "{}: {}: no input known in {found}",
                    specimen.name, label
                ));
            }
            if noticed.is_noticed() {
                findings.0.remove(&label);
            }
        }
    });
    conclude(findings);
}
