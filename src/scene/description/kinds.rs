//! Kinds of parts in the published schema: one variant for each kind, told apart by its tag.

use schemars::Schema;
use serde_json::{Map, Value, json};

use super::tagged::Kinds;
use super::{Input, Output, PortKind};
use crate::scene::joints::JointKind;
use crate::scene::loads::LoadKind;
use crate::scene::motions::MotionKind;

/// Makes one titled variant for every kind of all parts, with all keys that it takes.
pub fn tell_apart(schema: &mut Schema) {
    let parts = [
        (JointKind::PART, JointKind::SPEAKS),
        (MotionKind::PART, MotionKind::SPEAKS),
        (LoadKind::PART, LoadKind::SPEAKS),
        (Input::PART, Input::SPEAKS),
        (Output::PART, Output::SPEAKS),
        (PortKind::PART, PortKind::SPEAKS),
    ];
    for (part, _) in parts {
        take_in(schema, part);
    }
    drop_unused(schema);
    for (part, speaks) in parts {
        spread(schema, part, speaks);
    }
}

/// Gives every variant of a part the keys that all of them share.
fn spread(schema: &mut Schema, name: &str, speaks: bool) {
    let definitions = schema.pointer_mut("/$defs").and_then(Value::as_object_mut);
    let Some(definitions) = definitions else {
        return;
    };
    let names: Vec<String> = definitions.keys().cloned().collect();
    let Some(part) = definitions.get_mut(name) else {
        return;
    };
    // Unlike any other name in the schema: models made of it are named so.
    let title = |kind: &Value| {
        let kind = camel_case(kind.as_str().unwrap_or_default());
        if speaks && !names.contains(&kind) {
            kind
        } else {
            kind + name
        }
    };
    let variants = part["oneOf"].as_array().into_iter().flatten();
    let variants = variants.flat_map(|variant| {
        let title = title(constant(variant, "kind"));
        let mut properties = properties_of(variant);
        properties.append(&mut properties_of(part));
        let required = [required_of(part), required_of(variant)].concat();
        let either = variant["x-either"].as_array().cloned();
        let either = either.unwrap_or_else(|| vec![json!([])]);
        let all: Vec<Value> = flat(&either);
        let one = either.into_iter().map(move |own| {
            let own = flat(std::slice::from_ref(&own));
            let mut properties = properties.clone();
            properties.retain(|key, _| {
                let is = |of: &[Value]| of.iter().any(|of| of == key);
                !is(&all) || is(&own)
            });
            let demanded = own.first().cloned();
            json!({
                "title": title,
                "description": variant["description"],
                "type": "object",
                "properties": properties,
                "additionalProperties": false,
                "required": required.iter().cloned().chain(demanded).collect::<Vec<_>>(),
            })
        });
        one.collect::<Vec<_>>()
    });
    let variants: Vec<Value> = variants.collect();
    *part = json!({ "description": part["description"], "oneOf": variants });
}

/// Puts the keys of the types of all kinds of a part in the places that refer to them.
fn take_in(schema: &mut Schema, part: &str) {
    let definitions = schema.pointer_mut("/$defs").and_then(Value::as_object_mut);
    let Some(definitions) = definitions else {
        return;
    };
    let others = definitions.clone();
    let variants = definitions.get_mut(part).map(|part| &mut part["oneOf"]);
    let variants = variants.and_then(Value::as_array_mut).into_iter().flatten();
    for variant in variants {
        let name = variant["$ref"].as_str().unwrap_or_default();
        let Some(own) = others.get(name.trim_start_matches("#/$defs/")) else {
            continue;
        };
        let mut properties = properties_of(own);
        properties.append(&mut properties_of(variant));
        let required = [required_of(variant), required_of(own)].concat();
        variant["properties"] = properties.into();
        variant["required"] = required.into();
        if let Some(either) = own.get("x-either") {
            variant["x-either"] = either.clone();
        }
        if let Some(variant) = variant.as_object_mut() {
            variant.remove("$ref");
        }
    }
}

/// Removes definitions that nothing refers to.
fn drop_unused(schema: &mut Schema) {
    loop {
        let text = schema.as_value().to_string();
        let definitions = schema.pointer_mut("/$defs").and_then(Value::as_object_mut);
        let Some(definitions) = definitions else {
            return;
        };
        let before = definitions.len();
        definitions.retain(|name, _| text.contains(&format!("\"#/$defs/{name}\"")));
        if definitions.len() == before {
            return;
        }
    }
}

fn properties_of(variant: &Value) -> Map<String, Value> {
    variant["properties"]
        .as_object()
        .cloned()
        .unwrap_or_default()
}

fn required_of(variant: &Value) -> Vec<Value> {
    variant["required"].as_array().cloned().unwrap_or_default()
}

/// The values in lists of values.
fn flat(lists: &[Value]) -> Vec<Value> {
    let lists = lists.iter().filter_map(Value::as_array);
    lists.flatten().cloned().collect()
}

/// Keys that say which variant an object is.
const TAGS: [&str; 2] = ["element", "kind"];

/// Makes of variants with a tag one check by it: what validators tell is of the variant that is meant, not that none of all fits.
pub fn tell_by_tag(schema: &mut Schema) {
    let definitions = schema.pointer_mut("/$defs").and_then(Value::as_object_mut);
    for definition in definitions.into_iter().flat_map(Map::values_mut) {
        let variants = definition["oneOf"].as_array().cloned().unwrap_or_default();
        let is_told = |tag: &&str| variants.iter().all(|of| constant(of, tag).is_string());
        let tag = TAGS.into_iter().find(is_told);
        if let Some(tag) = tag.filter(|_| !variants.is_empty()) {
            *definition = by_tag(&definition["description"], tag, variants);
        }
    }
}

fn constant<'a>(variant: &'a Value, tag: &str) -> &'a Value {
    &variant["properties"][tag]["const"]
}

fn by_tag(description: &Value, tag: &str, variants: Vec<Value>) -> Value {
    // Variants of one name stand side by side.
    let mut alike: Vec<(Value, Vec<Value>)> = Vec::new();
    for variant in variants {
        let name = constant(&variant, tag).clone();
        match alike.last_mut().filter(|(known, _)| *known == name) {
            Some((_, several)) => several.push(variant),
            None => alike.push((name, vec![variant])),
        }
    }
    let names: Vec<Value> = alike.iter().map(|(name, _)| name.clone()).collect();
    let checks: Vec<Value> = alike
        .into_iter()
        .map(|(name, several)| {
            json!({
                "if": {"properties": {tag: {"const": name}}, "required": [tag]},
                "then": by_keys(several),
            })
        })
        .collect();
    json!({
        "description": description,
        "type": "object",
        "properties": {tag: {"type": "string", "enum": names}},
        "required": [tag],
        "allOf": checks,
    })
}

/// One check for several variants of a name: by the keys that they alone demand, the last where none is there.
fn by_keys(mut variants: Vec<Value>) -> Value {
    let demanded = |variant: &Value| variant["required"].as_array().cloned().unwrap_or_default();
    let all: Vec<Vec<Value>> = variants.iter().map(demanded).collect();
    let own = |keys: &[Value]| -> Vec<Value> {
        let is_own = |key: &&Value| !all.iter().all(|others| others.contains(key));
        let keys = keys.iter().filter(is_own);
        keys.map(|key| json!({"required": [key]})).collect()
    };
    let last = variants.pop().unwrap_or_default();
    let others = variants.into_iter().zip(&all).rev();
    others.fold(
        last,
        |rest, (variant, keys)| json!({"if": {"anyOf": own(keys)}, "then": variant, "else": rest}),
    )
}

/// A name in snake case as that of a type.
fn camel_case(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let (first, rest) = word.split_at(1.min(word.len()));
        first.to_uppercase() + rest
    });
    words.collect()
}
