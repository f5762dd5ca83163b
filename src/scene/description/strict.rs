//! JSON of a shape that is known only after a look inside: no key twice, and errors inside it keep
//! their path.

use std::fmt::{self, Display};

use serde::Deserialize;
use serde::de::{DeserializeOwned, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};

use super::reader::Reader;

/// Stands between a path inside a value and the message about what is there.
pub(super) const INNER: char = '\u{1f}';

/// Any JSON value in which no key stands twice.
pub struct Strict(pub Value);

/// A message about the place `path` inside the value at hand.
pub fn at(path: &str, message: &str) -> String {
    format!("{path}{INNER}{message}")
}

/// Reads a type from a value.
///
/// # Errors
/// The value does not fit the type; the error carries its path inside the value.
pub fn typed<T: DeserializeOwned, E: Error>(value: Value) -> Result<T, E> {
    T::deserialize(Reader(value)).map_err(|wrong| E::custom(at(&wrong.path, &wrong.message)))
}

struct AnyValue;

impl<'de> Visitor<'de> for AnyValue {
    type Value = Strict;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Strict, E> {
        Ok(Strict(Value::Null))
    }

    fn visit_bool<E>(self, value: bool) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }

    fn visit_str<E>(self, value: &str) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Strict, A::Error> {
        let mut values = Vec::new();
        while let Some(Strict(value)) = list.next_element()? {
            values.push(value);
        }
        Ok(Strict(values.into()))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Strict, A::Error> {
        let mut values = Map::new();
        while let Some(key) = map.next_key::<String>()? {
            if values.contains_key(&key) {
                return Err(twice(&key));
            }
            let Strict(value) = map.next_value()?;
            values.insert(key, value);
        }
        Ok(Strict(values.into()))
    }
}

fn twice<E: Error>(key: impl Display) -> E {
    E::custom(format!("expected every key once, found \"{key}\" twice"))
}

impl<'de> Deserialize<'de> for Strict {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AnyValue)
    }
}
