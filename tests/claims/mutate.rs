//! Changes of a scene at one place, of the same sort for all keys: numbers are shifted, flags inverted,
//! names swapped for others, kinds replaced.

use serde_json::{Value, json};

use crate::claims::schema::{Place, Sort};

/// Share by which numbers change.
const SHIFT: f64 = 0.05;

/// A changed scene, and whether its variables have other names.
pub struct Mutant {
    pub scene: Value,
    pub is_renamed: bool,
}

/// The last key of a pointer.
fn last(pointer: &str) -> &str {
    pointer.rsplit('/').next().unwrap_or_default()
}

/// A scene with another value at a pointer, which may be that of a key that is not there.
pub fn with(scene: &Value, pointer: &str, value: Value) -> Value {
    let mut changed = scene.clone();
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
    match changed.pointer_mut(parent).expect("a place in the scene") {
        Value::Array(list) => list[key.parse::<usize>().expect("an index")] = value,
        holder => holder[key] = value,
    }
    changed
}

/// A scene without a key.
pub fn without(scene: &Value, pointer: &str) -> Value {
    let mut changed = scene.clone();
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
    let holder = changed.pointer_mut(parent).and_then(Value::as_object_mut);
    holder.expect("an object").remove(key);
    changed
}

/// Where the entry of a matrix with row and column exchanged is.
fn mirror(pointer: &str) -> Option<String> {
    let (rest, column) = pointer.rsplit_once('/')?;
    let (rest, row) = rest.rsplit_once('/')?;
    let are_numbers = [row, column].iter().all(|key| key.parse::<u8>().is_ok());
    (are_numbers && row != column).then(|| format!("{rest}/{column}/{row}"))
}

/// Names that a reference may have in a scene.
fn names(scene: &Value) -> Vec<String> {
    let mut names = vec!["ground".to_owned()];
    for list in ["bodies", "joints", "gears", "loads", "motions"] {
        for part in scene[list].as_array().into_iter().flatten() {
            let name = part["name"].as_str().unwrap_or_default();
            names.push(name.into());
            let markers = part["markers"].as_object().into_iter().flatten();
            names.extend(markers.map(|(marker, _)| format!("{name}.{marker}")));
        }
    }
    names
}

/// A scene in which a part has another name, there and where it is referred to.
fn renamed(value: &Value, from: &str, to: &str) -> Value {
    let dotted = format!("{from}.");
    match value {
        Value::String(text) if text == from => json!(to),
        Value::String(text) if text.starts_with(&dotted) => json!(text.replacen(from, to, 1)),
        Value::Array(list) => list.iter().map(|value| renamed(value, from, to)).collect(),
        Value::Object(keys) => {
            let of = |(key, value): (&String, &Value)| (key.clone(), renamed(value, from, to));
            Value::Object(keys.iter().map(of).collect())
        }
        _ => value.clone(),
    }
}

/// Lists values that could replace the value at a place. Of numbers the first that is accepted decides.
pub fn changes(scene: &Value, place: &Place) -> Vec<Mutant> {
    let found = scene.pointer(&place.pointer).expect("a value");
    let plain = |value: Value| Mutant {
        scene: with(scene, &place.pointer, value),
        is_renamed: false,
    };
    match &place.sort {
        Sort::Number => {
            let x = found.as_f64().expect("a number");
            let step = if x == 0.0 { SHIFT } else { SHIFT * x.abs() };
            let mut found = vec![plain(json!(x + step)), plain(json!(x - step))];
            // Of a symmetric matrix both entries.
            if let Some(mirrored) = mirror(&place.pointer)
                && scene.pointer(&mirrored).is_some()
            {
                let first = with(scene, &place.pointer, json!(x + step));
                found.push(Mutant {
                    scene: with(&first, &mirrored, json!(x + step)),
                    is_renamed: false,
                });
            }
            found
        }
        Sort::Integer => {
            let n = found.as_u64().expect("a whole number");
            vec![plain(json!(n + 1)), plain(json!(n.saturating_sub(1)))]
        }
        Sort::Flag => vec![plain(json!(found != &json!(true)))],
        Sort::Choice(variants) => {
            let others = variants.iter().filter(|variant| found != &json!(variant));
            // What is of another kind has variables of other names.
            let of = |variant| Mutant {
                is_renamed: place.key.ends_with('}'),
                ..plain(json!(variant))
            };
            others.map(of).collect()
        }
        Sort::Text if last(&place.pointer) == "name" => {
            let from = found.as_str().expect("a name");
            let scene = match place.pointer.as_str() {
                "/name" => with(scene, "/name", json!("another")),
                _ => renamed(scene, from, "another"),
            };
            vec![Mutant {
                scene,
                is_renamed: true,
            }]
        }
        Sort::Text
            if place.key.ends_with("#expression")
                || place.key.contains(".deformation")
                || place.key == "loads{force_law}.force" =>
        {
            let text = found.as_str().expect("an expression");
            // What a winch has paid out begins at nothing.
            let shift = if place.key.starts_with("motions{winch}") {
                ""
            } else {
                "+0.01"
            };
            vec![plain(json!(format!("({text})*1.05{shift}")))]
        }
        Sort::Text => {
            let others = names(scene)
                .into_iter()
                .filter(|name| found != &json!(name));
            others.map(|name| plain(json!(name))).collect()
        }
    }
}

/// A scene in which a name stands that another part has.
pub fn clash(scene: &Value, place: &Place) -> Value {
    with(scene, &place.pointer, scene["bodies"][0]["name"].clone())
}

/// One name of each sort.
fn a_few_names(scene: &Value) -> Vec<String> {
    let mut names = vec!["ground".to_owned()];
    for list in ["bodies", "joints", "gears", "loads", "motions"] {
        names.extend(scene[list][0]["name"].as_str().map(String::from));
    }
    let markers = scene["bodies"][0]["markers"]
        .as_object()
        .into_iter()
        .flatten();
    let body = scene["bodies"][0]["name"].as_str().unwrap_or_default();
    names.extend(markers.map(|(marker, _)| format!("{body}.{marker}")));
    names
}

/// Lists scenes with a value at a place that is empty now.
pub fn plants(scene: &Value, place: &Place) -> Vec<Value> {
    let samples = place.samples.iter().flatten().cloned();
    let mut values: Vec<Value> = samples.collect();
    if place.sort == Sort::Text {
        values.extend(a_few_names(scene).into_iter().map(Value::from));
    }
    let planted = values
        .into_iter()
        .map(|value| with(scene, &place.pointer, value));
    planted.collect()
}
