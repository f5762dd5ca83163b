//! Keys that a kind does not take: told before anything is read, so that a value for another kind is no matter of its type.

use std::cell::LazyCell;

use serde_json::Value;

use super::tagged::{Kinds, OneKind, is_said, known};
use super::{Input, JointKind, Kind, LoadKind, MotionKind, OutputKind, PortKind};
use crate::scene::Error;

/// What else takes keys of a joint: a load between its ends.
const OF_LOADS: [&str; 2] = ["stiffness", "damping"];

/// Checks that all parts of a scene have keys of their kinds alone; what else may be wrong with them is left to who reads them.
///
/// # Errors
/// The first key that other kinds take.
pub fn check_keys(scene: &Value) -> Result<(), Error> {
    check(&scene["joints"], "joints", all::<JointKind>)?;
    check(&scene["motions"], "motions", takers::<MotionKind>)?;
    check(&scene["loads"], "loads", all::<LoadKind>)?;
    check(&scene["initial"]["loads"], "initial.loads", all::<LoadKind>)?;
    check(&scene["inputs"], "inputs", all::<Input>)?;
    check(&scene["outputs"], "outputs", takers::<OutputKind>)?;
    check(&scene["ports"], "ports", takers::<PortKind>)
}

/// A kind by its name, and the keys that it takes beside those that all of them have.
struct Taker {
    name: &'static str,
    keys: Vec<&'static str>,
}

/// All kinds of a part of a scene.
fn all<K: Kinds>() -> Vec<Taker> {
    let all = K::all();
    let is_shared = |key: &&str| all.iter().all(|kind| kind.keys.contains(key));
    let taker = |kind: &OneKind<K>| Taker {
        name: kind.name,
        keys: (kind.keys.iter().copied())
            .filter(|key| !is_shared(key))
            .collect(),
    };
    all.iter().map(taker).collect()
}

/// All kinds of a part of a scene, from its table of keys.
fn takers<K: Kind>() -> Vec<Taker> {
    let names = known::<K>().iter();
    let taker = |name: &&'static str| {
        let kind: Option<K> = serde_json::from_value((*name).into()).ok();
        let keys = kind.iter().flat_map(|kind| kind.keys());
        let mut own: Vec<&'static str> = Vec::new();
        for key in keys.flat_map(|(must, may)| must.iter().chain(*may)) {
            if !own.contains(key) {
                own.push(key);
            }
        }
        Taker { name, keys: own }
    };
    names.map(taker).collect()
}

fn check(list: &Value, place: &str, all: fn() -> Vec<Taker>) -> Result<(), Error> {
    let parts = list.as_array().into_iter().flatten();
    let all = LazyCell::new(all);
    for (index, part) in parts.enumerate() {
        let Some(kind) = all.iter().find(|kind| part["kind"] == kind.name) else {
            continue;
        };
        let said = part.as_object().into_iter().flatten();
        let said = said.filter(|(_, value)| is_said(value));
        let mut strange = said.filter_map(|(key, _)| Some((key, strange(kind, key, &all, place)?)));
        if let Some((key, message)) = strange.next() {
            return Err(Error::new(format!("{place}[{index}].{key}"), message));
        }
    }
    Ok(())
}

/// What is said of a key that other kinds take and this kind does not; nothing of one that none takes.
fn strange(kind: &Taker, key: &str, all: &[Taker], place: &str) -> Option<String> {
    let takers = all.iter().filter(|kind| kind.keys.contains(&key));
    let takers: Vec<&str> = takers.map(|kind| kind.name).collect();
    if takers.is_empty() || kind.keys.contains(&key) {
        return None;
    }
    let has = match kind.keys.is_empty() {
        true => "none beside those of all".into(),
        false => kind.keys.join(", "),
    };
    let load = match place == "joints" && OF_LOADS.contains(&key) {
        true => " and of a load of kind joint_spring",
        false => "",
    };
    let (name, takers) = (kind.name, takers.join(", "));
    Some(format!(
        "expected a key of the kind {name} ({has}), found `{key}`, which is one of {takers}{load}"
    ))
}
