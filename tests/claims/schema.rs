//! The published JSON Schema of scenes, walked beside a scene: every place where a value stands or could
//! stand.

use std::collections::BTreeSet;

use flexbody::scene::Scene;
use serde_json::{Value, json};

/// Kind of value that may be at a place.
#[derive(Clone, Debug, PartialEq)]
pub enum Sort {
    Number,
    Integer,
    Flag,
    Text,
    Choice(Vec<String>),
}

/// A place in a scene.
#[derive(Clone, Debug)]
pub struct Place {
    /// Key of the place, equal for all scenes: `joints{revolute}.stiffness`, `loads{force}.value[0]#number`.
    pub key: String,
    /// JSON pointer: of the value or, where nothing stands, of the optional key that holds the place.
    pub pointer: String,
    pub sort: Sort,
    /// Values that could be at the pointer, if it is empty now.
    pub samples: Option<Vec<Value>>,
    /// The innermost optional key that holds the place.
    pub removal: Option<String>,
}

/// The schema.
pub struct Schema(Value);

/// Where a walk is.
#[derive(Clone, Default)]
struct At {
    key: String,
    pointer: String,
    removal: Option<String>,
    samples: Option<Vec<Value>>,
}

impl At {
    /// Further down, at another key.
    fn down(&self, key: &str, step: impl std::fmt::Display) -> Self {
        Self {
            key: format!("{}{key}", self.key),
            pointer: match self.samples {
                None => format!("{}/{step}", self.pointer),
                Some(_) => self.pointer.clone(),
            },
            ..self.clone()
        }
    }

    fn named(&self, suffix: &str) -> Self {
        Self {
            key: format!("{}{suffix}", self.key),
            ..self.clone()
        }
    }
}

/// The variants of an enumeration of texts.
fn variants(node: &Value) -> Option<Vec<String>> {
    let alternatives = node["oneOf"].as_array()?;
    let text = |node: &Value| node["const"].as_str().map(String::from);
    alternatives.iter().map(text).collect()
}

/// The type of a node, but for null.
fn kind(node: &Value) -> &str {
    let of = &node["type"];
    let listed = || {
        of.as_array()?
            .iter()
            .filter_map(Value::as_str)
            .find(|t| *t != "null")
    };
    of.as_str().or_else(listed).unwrap_or("")
}

/// The length of an array that has one length only.
fn length(node: &Value) -> Option<u64> {
    let least = node["minItems"].as_u64();
    least.filter(|_| node["minItems"] == node["maxItems"])
}

/// What tells a variant from others: a key, and what stands there.
fn tag(node: &Value) -> Option<(&'static str, &str)> {
    let constant = |key: &'static str| Some((key, node["properties"][key]["const"].as_str()?));
    constant("element").or_else(|| constant("kind"))
}

/// The variants that a check leads to.
fn told(check: &Value) -> Vec<&Value> {
    match check.get("then") {
        Some(then) => [Some(then), check.get("else")]
            .into_iter()
            .flatten()
            .flat_map(told)
            .collect(),
        None => vec![check],
    }
}

fn is_null(node: &&Value) -> bool {
    node["type"] == "null"
}

impl Schema {
    pub fn published() -> Self {
        let mut schema: Value = serde_json::from_str(&Scene::json_schema()).expect("JSON");
        let definitions = schema["$defs"].as_object_mut().expect("definitions");
        for definition in definitions.values_mut() {
            if let Some(checks) = definition["allOf"].as_array() {
                let told = checks.iter().flat_map(told).cloned();
                *definition = json!({ "oneOf": told.collect::<Vec<_>>() });
            }
        }
        // Means nothing: it is for editors.
        let keys = schema["properties"].as_object_mut().expect("keys");
        keys.remove("$schema").expect("where the schema is");
        Self(schema)
    }

    /// All places of a scene.
    pub fn places(&self, scene: &Value) -> Vec<Place> {
        let mut found = Vec::new();
        self.walk(&self.0, At::default(), Some(scene), &mut found);
        found
    }

    /// The keys of all places that a scene could have, and the variants of those that are chosen by name
    /// as `key=variant`.
    pub fn keys(&self) -> BTreeSet<String> {
        let mut found = Vec::new();
        let everything = At {
            samples: Some(Vec::new()),
            ..At::default()
        };
        self.walk(&self.0, everything, None, &mut found);
        let names = |place: Place| match place.sort {
            Sort::Choice(variants) if !place.key.ends_with('}') => {
                let named = |variant| format!("{}={variant}", place.key);
                variants.iter().map(named).collect()
            }
            _ => vec![place.key],
        };
        found.into_iter().flat_map(names).collect()
    }

    fn resolve<'a>(&'a self, node: &'a Value) -> &'a Value {
        match node["$ref"].as_str() {
            Some(name) => {
                let pointer = name.trim_start_matches('#');
                self.resolve(self.0.pointer(pointer).expect("a definition"))
            }
            None => node,
        }
    }

    /// Whether a value is of the form that a node asks for.
    fn fits(&self, node: &Value, value: &Value) -> bool {
        let node = self.resolve(node);
        if let Some(alternatives) = node["anyOf"].as_array() {
            return alternatives.iter().any(|node| self.fits(node, value));
        }
        if let Some(variants) = variants(node) {
            return variants.iter().any(|variant| value == variant);
        }
        if let Some(alternatives) = node["oneOf"].as_array() {
            return alternatives.iter().any(|node| self.fits(node, value));
        }
        match (kind(node), value) {
            ("number" | "integer", Value::Number(_)) => true,
            ("array", Value::Array(found)) => {
                let is_long = length(node).is_none_or(|length| found.len() as u64 == length);
                is_long && found.iter().all(|item| self.fits(&node["items"], item))
            }
            ("string", Value::String(_)) => true,
            ("object", Value::Object(found)) => {
                let required = node["required"].as_array();
                let known = |key: &Value| key.as_str().is_some_and(|key| found.contains_key(key));
                required.is_none_or(|keys| keys.iter().all(known))
                    && tag(node).is_none_or(|(key, tag)| value[key] == tag)
            }
            _ => false,
        }
    }

    /// Values that could stand at a node.
    fn samples(&self, node: &Value) -> Vec<Value> {
        let node = self.resolve(node);
        if let Some(variants) = variants(node) {
            return variants.into_iter().map(Value::from).collect();
        }
        for several in ["anyOf", "oneOf"] {
            if let Some(alternatives) = node[several].as_array() {
                return alternatives
                    .iter()
                    .flat_map(|node| self.samples(node))
                    .collect();
            }
        }
        match kind(node) {
            "number" => vec![json!(0.37)],
            "integer" => vec![json!(2)],
            // What it is not where nothing is said.
            "boolean" => vec![json!(node["default"] != json!(true))],
            "string" => vec![json!("0.37+0.1*t"), json!("0.37")],
            "array" if length(node).is_none() => match kind(self.resolve(&node["items"])) {
                "number" => vec![
                    json!([0.37]),
                    json!([0.37, 0.21]),
                    json!([0.37, 0.21, 0.53]),
                ],
                "array" => vec![json!([[0.0, 0.37], [1.0, 0.73]])],
                _ => Vec::new(),
            },
            "array" => {
                let one = self.samples(&node["items"]);
                let count = length(node).unwrap_or_default() as usize;
                let several = |sample: &Value| Value::from(vec![sample.clone(); count]);
                one.iter().map(several).collect()
            }
            "object" => self.object_sample(node),
            _ => Vec::new(),
        }
    }

    fn object_sample(&self, node: &Value) -> Vec<Value> {
        let Some(properties) = node["properties"].as_object() else {
            return Vec::new();
        };
        let mut sample = json!({});
        for (key, node) in properties {
            // A limit of the work stays at its default: below it there would be no step.
            let limit = node["default"].as_f64().filter(|value| *value != 0.0);
            if let Some(value) = limit.map(Value::from).or_else(|| self.samples(node).pop()) {
                sample[key] = value;
            }
        }
        vec![sample]
    }

    fn walk(&self, node: &Value, at: At, value: Option<&Value>, out: &mut Vec<Place>) {
        let node = self.resolve(node);
        if node.get("const").is_some() {
            return;
        }
        if let Some(variants) = variants(node) {
            return out.push(place(at, Sort::Choice(variants)));
        }
        for several in ["anyOf", "oneOf"] {
            if let Some(alternatives) = node[several].as_array() {
                for node in alternatives.iter().filter(|node| !is_null(node)) {
                    if value.is_none_or(|value| self.fits(node, value)) {
                        self.walk_alternative(node, &at, value, out);
                    } else if several == "anyOf" {
                        // What stands there in one form could stand there in another.
                        let other = At {
                            samples: Some(self.samples(node)),
                            ..at.clone()
                        };
                        self.walk_alternative(node, &other, None, out);
                    }
                }
                return;
            }
        }
        match kind(node) {
            "object" => self.walk_object(node, at, value, out),
            "array" => self.walk_array(node, at, value, out),
            "number" => out.push(place(at, Sort::Number)),
            "integer" => out.push(place(at, Sort::Integer)),
            "boolean" => out.push(place(at, Sort::Flag)),
            "string" => out.push(place(at, Sort::Text)),
            other => panic!("{}: a type of schema that nobody walks: {other}", at.key),
        }
    }

    fn walk_alternative(&self, node: &Value, at: &At, value: Option<&Value>, out: &mut Vec<Place>) {
        let inner = self.resolve(node);
        let suffix = match (tag(inner), kind(inner)) {
            (Some((_, tag)), _) => format!("{{{tag}}}"),
            (None, "number") => "#number".into(),
            (None, "string") => "#expression".into(),
            _ => String::new(),
        };
        self.walk(node, at.named(&suffix), value, out);
    }

    fn walk_object(&self, node: &Value, at: At, value: Option<&Value>, out: &mut Vec<Place>) {
        if let Some(inner) = node["additionalProperties"].as_object() {
            let inner = Value::Object(inner.clone());
            match value.and_then(Value::as_object) {
                Some(entries) => {
                    for (name, value) in entries {
                        let mut below = at.down(".*", name);
                        below.removal = None;
                        self.walk(&inner, below, Some(value), out);
                    }
                }
                None => self.walk(&inner, at.named(".*"), None, out),
            }
            return;
        }
        let Some(properties) = node["properties"].as_object() else {
            panic!("{}: an object of which the schema says nothing", at.key);
        };
        for (key, property) in properties {
            let required = node["required"]
                .as_array()
                .is_some_and(|r| r.contains(&json!(key)));
            let dot = if at.key.is_empty() { "" } else { "." };
            // The kind of a part is in its key already.
            let word = if key == "kind" {
                String::new()
            } else {
                format!("{dot}{key}")
            };
            let mut below = at.down(&word, key);
            if !required && at.samples.is_none() {
                below.removal = Some(below.pointer.clone());
            }
            let found = value.and_then(|value| value.get(key));
            if found.is_none() && at.samples.is_none() {
                if required {
                    continue;
                }
                let samples = self.samples(property);
                if samples.is_empty() {
                    continue;
                }
                below.samples = Some(samples);
            }
            self.walk(property, below, found, out);
        }
    }

    fn walk_array(&self, node: &Value, at: At, value: Option<&Value>, out: &mut Vec<Place>) {
        let items = &node["items"];
        if let Some(length) = length(node) {
            for i in 0..length {
                let found = value.and_then(|value| value.get(i as usize));
                self.walk(items, at.down(&format!("[{i}]"), i), found, out);
            }
            return;
        }
        let is_list = kind(self.resolve(items)) == "object" || items.get("$ref").is_some();
        let suffix = if is_list { "" } else { "[]" };
        let Some(found) = value.and_then(Value::as_array) else {
            // A list that is not there has no places; in the walk of everything it has all.
            let everything = at.samples.as_ref().is_some_and(Vec::is_empty);
            if everything || !is_list {
                self.walk(items, at.named(suffix), None, out);
            }
            return;
        };
        for (i, value) in found.iter().enumerate() {
            let mut below = at.down(suffix, i);
            if is_list {
                below.removal = None;
            }
            self.walk(items, below, Some(value), out);
        }
    }
}

fn place(at: At, sort: Sort) -> Place {
    Place {
        key: at.key,
        pointer: at.pointer,
        sort,
        samples: at.samples,
        removal: at.removal,
    }
}
