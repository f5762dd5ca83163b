//! Keys that a kind does not take: told before anything is read, so that a value for another kind is no matter of its type.

use std::cell::LazyCell;

use schemars::JsonSchema;
use serde_json::Value;

use super::kinds::listed;
use super::{InputKind, JointKind, Kind, LoadKind, MotionKind, OutputKind, PortKind};
use crate::scene::Error;

/// What else takes keys of a joint: a load between its ends.
const OF_LOADS: [&str; 2] = ["stiffness", "damping"];

/// Checks that all parts of a scene have keys of their kinds alone; what else may be wrong with them is left to who reads them.
///
/// # Errors
/// The first key that other kinds take.
pub fn check_keys(scene: &Value) -> Result<(), Error> {
    check::<JointKind>(&scene["joints"], "joints")?;
    check::<MotionKind>(&scene["motions"], "motions")?;
    check::<LoadKind>(&scene["loads"], "loads")?;
    check::<LoadKind>(&scene["initial"]["loads"], "initial.loads")?;
    check::<InputKind>(&scene["inputs"], "inputs")?;
    check::<OutputKind>(&scene["outputs"], "outputs")?;
    check::<PortKind>(&scene["ports"], "ports")
}

fn check<K: Kind + JsonSchema>(list: &Value, place: &str) -> Result<(), Error> {
    let parts = list.as_array().into_iter().flatten();
    let others = LazyCell::new(takers::<K>);
    for (index, part) in parts.enumerate() {
        let Ok(kind) = serde_json::from_value::<K>(part["kind"].clone()) else {
            continue;
        };
        // What is null or false is not said.
        let keys = part.as_object().into_iter().flatten();
        let said = keys.filter(|(_, value)| !value.is_null() && **value != Value::Bool(false));
        let mut said = said.filter(|(key, _)| !own(&kind).any(|own| own == key.as_str()));
        let strange =
            said.find_map(|(key, _)| Some((key, strange(&kind, key, &part["kind"], &others)?)));
        if let Some((key, message)) = strange {
            return Err(Error::new(format!("{place}[{index}].{key}"), message));
        }
    }
    Ok(())
}

/// Keys that a kind takes beside those that all of them have.
fn own<K: Kind>(kind: &K) -> impl Iterator<Item = &'static str> {
    let keys = kind.keys().iter();
    keys.flat_map(|(must, may)| must.iter().chain(*may))
        .copied()
}

/// A kind by its name, and the keys that it takes beside those that all of them have.
type Taker = (String, Vec<&'static str>);

/// All kinds of a part of a scene, from its schema.
fn takers<K: Kind + JsonSchema>() -> Vec<Taker> {
    let schema = schemars::schema_for!(K);
    let takers = listed::<K>(schema.as_value()).filter_map(|(kind, told)| {
        Some((told["const"].as_str()?.to_owned(), own(&kind).collect()))
    });
    takers.collect()
}

/// What is said of a key that `others` take and this kind does not; nothing of one that none takes.
fn strange<K: Kind>(kind: &K, key: &str, name: &Value, others: &[Taker]) -> Option<String> {
    let takers = others.iter().filter(|(_, keys)| keys.contains(&key));
    let takers: Vec<&str> = takers.map(|(name, _)| name.as_str()).collect();
    if takers.is_empty() {
        return None;
    }
    let mut keys: Vec<&str> = Vec::new();
    own(kind).for_each(|key| {
        if !keys.contains(&key) {
            keys.push(key);
        }
    });
    let has = match keys.is_empty() {
        true => "none beside those of all".into(),
        false => keys.join(", "),
    };
    let load = match K::PART == "Joint" && OF_LOADS.contains(&key) {
        true => " and of a load of kind joint_spring",
        false => "",
    };
    let name = name.as_str().unwrap_or_default();
    let takers = takers.join(", ");
    Some(format!(
        "expected a key of the kind {name} ({has}), found `{key}`, which is one of {takers}{load}"
    ))
}
