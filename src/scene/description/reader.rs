//! Reads types from JSON and tells what is wrong in words of JSON: the place, what was expected, what was
//! found. An object is read from an object only.

use std::fmt::{self, Display};

use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Expected, MapAccess, SeqAccess, Unexpected,
    VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_json::Value;

use super::strict::INNER;
use crate::scene::alike::did_you_mean;

/// Mistake in a value, and its place inside the value.
#[derive(Clone, Debug)]
pub struct Wrong {
    /// Path inside the value; empty for the value itself.
    pub path: String,
    /// Text of what was expected and what was found.
    pub message: String,
}

/// Stands for a value that a type is read from.
pub struct Reader(pub Value);

impl Wrong {
    pub(super) fn here(wanted: impl Display, found: impl Display) -> Self {
        let message = format!("expected {wanted}, found {found}");
        let path = String::new();
        Self { path, message }
    }

    /// Mistake of a value that is no object.
    pub(super) fn no_object(value: &Value) -> Self {
        Self::here("an object { ... }", found(value))
    }

    /// Mistake of a key that an object lacks.
    pub(super) fn missing(key: &'static str) -> Self {
        let wanted = match key {
            "marker" | "joint" | "body" | "load" | "gear" | "motion" => "a name",
            "markers" => "two names",
            "surface" => "a surface",
            "stiffness" => "a stiffness",
            "density" => "a density",
            "direction" | "second_direction" => "a direction [x, y, z]",
            "pitch" => "a pitch",
            "free" => "a list of freedoms",
            "points" => "points",
            "count" => "an integer from 1 to 100",
            _ => "a value",
        };
        Self::here(wanted, "nothing").under(key)
    }

    /// Mistake of a key that an object does not have.
    pub(super) fn no_key(key: &str, known: &[&str]) -> Self {
        let wanted = format!("one of the keys {}", known.join(", "));
        let meant = did_you_mean(key, known.iter().copied());
        Self::here(wanted, format!("\"{key}\"{meant}"))
    }

    /// Mistake of a value that is none of these names.
    pub(super) fn no_variant(value: &Value, names: &[&str]) -> Self {
        let known: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
        let meant = value
            .as_str()
            .map(|of| did_you_mean(of, names.iter().copied()));
        let found = found(value) + &meant.unwrap_or_default();
        Self::here(known.join(" or "), found)
    }

    /// Mistake with its place as seen from the object that the value stands in.
    pub(super) fn under(mut self, key: &str) -> Self {
        let joint = if self.path.is_empty() || self.path.starts_with('[') {
            ""
        } else {
            "."
        };
        self.path = format!("{key}{joint}{}", self.path);
        self
    }
}

impl Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path, self.message)
    }
}

impl std::error::Error for Wrong {}

impl serde::de::Error for Wrong {
    fn custom<T: Display>(message: T) -> Self {
        let text = message.to_string();
        let (path, message) = text.split_once(INNER).unwrap_or(("", &text));
        let [path, message] = [path, message].map(str::to_owned);
        Self { path, message }
    }

    fn invalid_type(found: Unexpected<'_>, wanted: &dyn Expected) -> Self {
        let wanted = expectation(&wanted.to_string());
        match found {
            Unexpected::Str(text) if is_number(text) && NUMBERS.contains(&&*wanted) => Self::here(
                wanted,
                format_args!("the text \"{text}\": a number has no quotation marks"),
            ),
            _ => Self::here(wanted, FoundValue(found)),
        }
    }

    fn invalid_value(found: Unexpected<'_>, wanted: &dyn Expected) -> Self {
        Self::invalid_type(found, wanted)
    }

    fn invalid_length(found: usize, wanted: &dyn Expected) -> Self {
        Self::here(expectation(&wanted.to_string()), format!("{found}"))
    }

    fn unknown_variant(found: &str, names: &'static [&'static str]) -> Self {
        Self::no_variant(&found.into(), names)
    }

    fn unknown_field(found: &str, known: &'static [&'static str]) -> Self {
        Self::no_key(found, known)
    }

    fn missing_field(key: &'static str) -> Self {
        Self::missing(key)
    }
}

/// Expectations where numbers stand.
const NUMBERS: [&str; 2] = ["a number", "zero or a positive integer"];

fn is_number(text: &str) -> bool {
    text.trim().parse::<f64>().is_ok()
}

/// Expectation of a type, in words of JSON.
fn expectation(wanted: &str) -> String {
    match wanted {
        "f64" => "a number".into(),
        "u8" | "u32" | "u64" | "usize" => "zero or a positive integer".into(),
        "a sequence" => "a list".into(),
        "a map" => "an object { ... }".into(),
        _ => match wanted.strip_prefix("an array of length ") {
            Some(length) => format!("a list of {length}"),
            None if wanted.starts_with("struct ") => "an object { ... }".into(),
            None => wanted.into(),
        },
    }
}

/// Value that was found, in words of JSON.
struct FoundValue<'a>(Unexpected<'a>);

impl Display for FoundValue<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Unexpected::Bool(value) => write!(f, "{value}"),
            Unexpected::Unsigned(number) => write!(f, "{number}"),
            Unexpected::Signed(number) => write!(f, "{number}"),
            Unexpected::Float(number) => write!(f, "{number:?}"),
            Unexpected::Str(text) => write!(f, "\"{text}\""),
            Unexpected::Unit | Unexpected::Option => f.write_str("null"),
            Unexpected::Seq => f.write_str("a list"),
            Unexpected::Map => f.write_str("an object"),
            other => write!(f, "{other}"),
        }
    }
}

/// A value in words of JSON; of a list or an object that it is one.
pub(super) fn found(value: &Value) -> String {
    let found = match value {
        Value::Null => Unexpected::Unit,
        Value::Bool(value) => Unexpected::Bool(*value),
        Value::Number(number) => return number.to_string(),
        Value::String(text) => Unexpected::Str(text),
        Value::Array(_) => Unexpected::Seq,
        Value::Object(_) => Unexpected::Map,
    };
    FoundValue(found).to_string()
}

impl<'de> Deserializer<'de> for Reader {
    type Error = Wrong;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        match self.0 {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(value),
            Value::Number(number) => match (number.as_u64(), number.as_i64()) {
                (Some(number), _) => visitor.visit_u64(number),
                (None, Some(number)) => visitor.visit_i64(number),
                (None, None) => visitor.visit_f64(number.as_f64().unwrap_or(f64::NAN)),
            },
            Value::String(text) => visitor.visit_string(text),
            Value::Array(list) => {
                let length = list.len();
                let mut list = List {
                    rest: list.into_iter().enumerate(),
                };
                let read = visitor.visit_seq(&mut list)?;
                // A list of fixed length leaves what is too much.
                match list.rest.len() {
                    0 => Ok(read),
                    more => Err(Wrong::here(format!("a list of {}", length - more), length)),
                }
            }
            Value::Object(map) => visitor.visit_map(Object {
                rest: map.into_iter(),
                next: None,
            }),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        match self.0 {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _keys: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        match &self.0 {
            Value::Object(_) => self.deserialize_any(visitor),
            other => Err(Wrong::no_object(other)),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        let known = || {
            let quoted: Vec<String> = variants.iter().map(|name| format!("\"{name}\"")).collect();
            quoted.join(" or ")
        };
        match self.0 {
            Value::String(name) => visitor.visit_enum(Variant {
                name,
                content: None,
            }),
            Value::Object(map) if map.len() == 1 => match map.into_iter().next() {
                Some((name, value)) => visitor.visit_enum(Variant {
                    name,
                    content: Some(value),
                }),
                None => Err(Wrong::here(known(), "nothing")),
            },
            Value::Object(map) => {
                let keys: Vec<String> = map.keys().map(|key| format!("\"{key}\"")).collect();
                let wanted = format!("an object with one of {}", known());
                Err(Wrong::here(wanted, format!("{{{}}}", keys.join(", "))))
            }
            other => Err(Wrong::here(known(), found(&other))),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit
        unit_struct seq tuple tuple_struct map identifier ignored_any
    }
}

struct List {
    rest: std::iter::Enumerate<std::vec::IntoIter<Value>>,
}

impl<'de> SeqAccess<'de> for &mut List {
    type Error = Wrong;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Wrong> {
        let Some((index, value)) = self.rest.next() else {
            return Ok(None);
        };
        let read = seed.deserialize(Reader(value));
        read.map(Some)
            .map_err(|wrong| wrong.under(&format!("[{index}]")))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.rest.len())
    }
}

struct Object {
    rest: serde_json::map::IntoIter,
    next: Option<(String, Value)>,
}

impl<'de> MapAccess<'de> for Object {
    type Error = Wrong;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Wrong> {
        self.next = self.rest.next();
        let Some((key, _)) = &self.next else {
            return Ok(None);
        };
        let read = seed.deserialize(StrDeserializer::<Wrong>::new(key));
        read.map(Some).map_err(|wrong| wrong.under(key))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Wrong> {
        let (key, value) = self.next.take().unwrap_or_default();
        let read = seed.deserialize(Reader(value));
        read.map_err(|wrong| wrong.under(&key))
    }
}

struct Variant {
    name: String,
    content: Option<Value>,
}

impl<'de> EnumAccess<'de> for Variant {
    type Error = Wrong;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Wrong> {
        let read = seed.deserialize(StrDeserializer::<Wrong>::new(&self.name))?;
        Ok((read, self))
    }
}

impl<'de> VariantAccess<'de> for Variant {
    type Error = Wrong;

    fn unit_variant(self) -> Result<(), Wrong> {
        match self.content {
            None => Ok(()),
            Some(content) => Err(Wrong::here("nothing", found(&content)).under(&self.name)),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Wrong> {
        let read = seed.deserialize(Reader(self.content.unwrap_or_default()));
        read.map_err(|wrong| wrong.under(&self.name))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _length: usize, visitor: V) -> Result<V::Value, Wrong> {
        let read = Reader(self.content.unwrap_or_default()).deserialize_any(visitor);
        read.map_err(|wrong| wrong.under(&self.name))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        keys: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        let read = Reader(self.content.unwrap_or_default()).deserialize_struct("", keys, visitor);
        read.map_err(|wrong| wrong.under(&self.name))
    }
}
