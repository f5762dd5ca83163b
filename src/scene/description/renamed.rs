//! Names of keys and kinds that scenes had once: refused, with the names that they have now.

use serde_json::Value;

use super::reader::found;
use crate::scene::Error;

/// Kinds of a part of a scene: as they were called, and as they are called.
type Renamed = [(&'static str, &'static str)];

const JOINTS: &Renamed = &[
    ("hinge", "`revolute` with `stiffness` or `damping`"),
    ("slider", "`point_on_line`"),
    ("along", "`point_on_cable`"),
];
const LOADS: &Renamed = &[
    ("stop", "`joint_limit`"),
    ("distributed", "`distributed_force`"),
];
const AXIAL: &Renamed = &[("settled", "`critically_damped`")];
const STATES: &Renamed = &[("as_shaped", "`undeformed`")];

/// Checks that nothing in a scene has a name of old.
///
/// # Errors
/// The first that has one, with its place and its name of now.
pub fn check_names(scene: &Value) -> Result<(), Error> {
    listed(&scene["joints"], "joints", "kind", JOINTS)?;
    listed(&scene["loads"], "loads", "kind", LOADS)?;
    let initial = &scene["initial"];
    listed(&initial["loads"], "initial.loads", "kind", LOADS)?;
    listed(&scene["inputs"], "inputs", "kind", LOADS)?;
    listed(&scene["bodies"], "bodies", "axial", AXIAL)?;
    named(initial, "initial", STATES)?;
    named(&initial["state"], "initial.state", STATES)?;
    match scene["accuracy"].get("for") {
        Some(_) => Err(refused("accuracy.for", "the key `input_profiles`", "`for`")),
        None => Ok(()),
    }
}

/// Checks a value of every object in a list.
fn listed(list: &Value, place: &str, key: &str, renamed: &Renamed) -> Result<(), Error> {
    let parts = list.as_array().into_iter().flatten().enumerate();
    for (index, part) in parts {
        named(&part[key], &format!("{place}[{index}].{key}"), renamed)?;
    }
    Ok(())
}

/// Checks a value.
fn named(value: &Value, place: &str, renamed: &Renamed) -> Result<(), Error> {
    let old = renamed.iter().find(|(old, _)| value == old);
    old.map_or(Ok(()), |(_, new)| Err(refused(place, new, &found(value))))
}

fn refused(place: &str, new: &str, old: &str) -> Error {
    Error::new(
        place,
        format!("expected {new}, found {old}, its former name"),
    )
}
