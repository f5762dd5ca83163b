//! Vectors and points: as many components as the scene has dimensions.

use std::borrow::Cow;
use std::ops::{Index, IndexMut};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize, Serializer};

use super::strict::{Strict, typed};

/// Components of a vector or a point: `[x, y]` in the plane, `[x, y, z]` in space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SceneVector {
    /// Components; those that are not given are zero.
    components: [f64; 3],
    /// How many are given.
    count: usize,
}

impl SceneVector {
    /// The zero vector of so many dimensions.
    pub fn zero(dimension: usize) -> Self {
        Self {
            components: [0.0; 3],
            count: dimension,
        }
    }

    /// All three components, zero where none is given.
    pub fn full(&self) -> [f64; 3] {
        self.components
    }

    /// Whether nothing is said: zero.
    pub fn is_unsaid(&self) -> bool {
        self.count == 0
    }

    /// Returns the components that are given.
    pub fn given(&self) -> &[f64] {
        &self.components[..self.count]
    }
}

impl From<[f64; 2]> for SceneVector {
    fn from([x, y]: [f64; 2]) -> Self {
        Self {
            components: [x, y, 0.0],
            count: 2,
        }
    }
}

impl From<[f64; 3]> for SceneVector {
    fn from(components: [f64; 3]) -> Self {
        Self {
            components,
            count: 3,
        }
    }
}

impl Index<usize> for SceneVector {
    type Output = f64;

    fn index(&self, axis: usize) -> &f64 {
        &self.components[axis]
    }
}

impl IndexMut<usize> for SceneVector {
    fn index_mut(&mut self, axis: usize) -> &mut f64 {
        &mut self.components[axis]
    }
}

impl Serialize for SceneVector {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.given().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for SceneVector {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Vec::<f64>::deserialize(deserializer)?[..] {
            [x, y] => Ok([x, y].into()),
            [x, y, z] => Ok([x, y, z].into()),
            ref other => {
                let message = format!("expected a list of 2 or 3, found {}", other.len());
                Err(D::Error::custom(message))
            }
        }
    }
}

impl JsonSchema for SceneVector {
    fn schema_name() -> Cow<'static, str> {
        "Vector".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Components of a vector or a point: `[x, y]` in the plane, `[x, y, z]` in space.",
            "type": "array",
            "items": { "type": "number", "format": "double" },
            "minItems": 2,
            "maxItems": 3
        })
    }
}

/// An angular velocity: a number in the plane, counter-clockwise, three components in space, rad/s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Spin {
    /// In the plane.
    Number(f64),
    /// In space.
    Vector([f64; 3]),
}

impl Default for Spin {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl Spin {
    /// All three components.
    pub fn full(&self) -> [f64; 3] {
        match *self {
            Self::Number(rate) => [0.0, 0.0, rate],
            Self::Vector(components) => components,
        }
    }

    /// Sets the component about an axis, in the plane the third.
    pub fn set(&mut self, axis: usize, value: f64) {
        match self {
            Self::Number(rate) => *rate = value,
            Self::Vector(components) => components[axis] = value,
        }
    }
}

impl<'de> Deserialize<'de> for Spin {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Strict::deserialize(deserializer)?.0;
        if value.is_array() {
            return typed(value).map(Self::Vector);
        }
        typed(value).map(Self::Number)
    }
}
