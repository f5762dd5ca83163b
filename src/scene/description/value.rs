//! Numbers that may change in time.

use std::fmt;

use schemars::JsonSchema;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

use crate::math::function::Function;

/// Coordinates of a line body in expressions: 0 at the first end, 1 at the last.
pub const ALONG_LINE: &[&str] = &["s"];
/// Coordinates of a plate or shell in expressions, each from 0 to 1.
pub const OVER_SURFACE: [&str; 2] = ["s1", "s2"];

/// A number, an expression in the time `t` (s), or a table over time.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Value {
    /// Constant.
    Number(f64),
    /// Expression in `t`, e.g. `0.1*sin(2*PI*t)`: numbers, `PI`, `E`, `+ - * / ^`, `< <= > >=` (1 or 0), `sin`, `cos`,
    /// `tan`, `asin`, `acos`, `atan`, `atan2(y, x)`, `sinh`, `cosh`, `tanh`, `exp`, `ln`, `log2`, `log10`, `sqrt`, `abs`,
    /// `sign`, `step` (1 from zero on), `min`, `max`, `if(c, a, b)` (`a` where `c` is positive). No step leads
    /// across a kink or a jump. A motion must not jump; where its velocity does, the drive strikes the bodies. Of loads
    /// that are distributed along a body also in its material coordinate `s`, 0 at the first end and 1 at the last.
    Expression(String),
    /// Table.
    Table(Table),
}

/// A table over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// Times (s, increasing) and values.
    pub table: Vec<[f64; 2]>,
    /// Curve between the points; by default `spline` for a motion and `linear` for all else.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<Interpolation>,
    /// Rates of a spline at its first and last point, with which it goes on outside, 1/s; 0 where nothing is
    /// said: at rest before and after.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slopes: Option<[f64; 2]>,
}

/// Ways from point to point of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Interpolation {
    /// Straight from point to point, the end values held outside. The velocity of a motion jumps at every
    /// point: the drive strikes the bodies there.
    Linear,
    /// A smooth cubic spline.
    Spline,
}

/// Values of a load: one of a moment, as many as dimensions of a force.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum LoadValue {
    /// One component.
    One(Value),
    /// The components of a vector.
    Vector(#[schemars(length(min = 2, max = 3))] Vec<Value>),
}

/// Course of a driven motion.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum MotionValue {
    /// An angle or a displacement.
    One(Value),
    /// The components of a position, or the parts of a quaternion.
    Vector(#[schemars(length(min = 2, max = 4))] Vec<Value>),
    /// Set by the master.
    Input(MasterInput),
}

/// A motion that the master sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MasterInput {
    /// Rates that the master sets besides the value: 0 none, 1 the rate, 2 rate and acceleration. A rate that is never set is 0: a unit whose
    /// value moves all the same says so once. Tables of inputs (`flexbody simulate --input`) need no rates: those of the curve are taken.
    #[schemars(range(max = 2))]
    pub input: u8,
}

impl Value {
    /// The function of time of a load: tables are piecewise linear unless they say otherwise.
    ///
    /// # Errors
    /// The expression or the table is not valid; never in a valid scene.
    pub fn function(&self) -> Result<Function, String> {
        self.interpolated(Interpolation::Linear)
    }

    /// The function of time of a motion: tables are splines unless they say otherwise.
    ///
    /// # Errors
    /// The expression or the table is not valid; never in a valid scene.
    pub fn motion_function(&self) -> Result<Function, String> {
        self.interpolated(Interpolation::Spline)
    }

    /// The expression, if it is one in coordinates of a body, and these.
    pub fn varying(&self) -> Option<(&str, &'static [&'static str])> {
        let Self::Expression(text) = self else {
            return None;
        };
        let kinds = [ALONG_LINE, &OVER_SURFACE].into_iter();
        let mut own = kinds.filter(|names| Function::varies(text, names));
        own.next().map(|names| (text.as_str(), names))
    }

    fn interpolated(&self, otherwise: Interpolation) -> Result<Function, String> {
        match self {
            Self::Number(value) => Ok(Function::constant(*value)),
            Self::Expression(text) => Function::expression(text),
            Self::Table(table) => match table.interpolation.unwrap_or(otherwise) {
                Interpolation::Linear if table.slopes.is_some() => {
                    Err("expected slopes of a spline only, found those of a linear table".into())
                }
                Interpolation::Linear => Function::linear(&table.table),
                Interpolation::Spline => {
                    Function::spline(&table.table, table.slopes.unwrap_or_default())
                }
            },
        }
    }
}

impl LoadValue {
    /// Returns the components.
    pub fn components(&self) -> &[Value] {
        match self {
            Self::One(value) => std::slice::from_ref(value),
            Self::Vector(values) => values,
        }
    }
}

impl MotionValue {
    /// Returns the components; none if the master sets them.
    pub fn components(&self) -> &[Value] {
        match self {
            Self::One(value) => std::slice::from_ref(value),
            Self::Vector(values) => values,
            Self::Input(_) => &[],
        }
    }
}

/// Forms that a JSON value may have.
struct Anything {
    /// Words for the forms that are expected.
    wanted: &'static str,
    list: bool,
    input: bool,
}

/// Form of a JSON value.
enum JsonForm {
    One(Value),
    Vector(Vec<Value>),
    Input(MasterInput),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TableOrInput {
    table: Option<Vec<[f64; 2]>>,
    interpolation: Option<Interpolation>,
    slopes: Option<[f64; 2]>,
    input: Option<u8>,
}

impl<'de> Visitor<'de> for Anything {
    type Value = JsonForm;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.wanted)
    }

    fn visit_f64<E>(self, value: f64) -> Result<JsonForm, E> {
        Ok(JsonForm::One(Value::Number(value)))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<JsonForm, E> {
        self.visit_f64(value as f64)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<JsonForm, E> {
        self.visit_f64(value as f64)
    }

    fn visit_str<E>(self, text: &str) -> Result<JsonForm, E> {
        Ok(JsonForm::One(Value::Expression(text.into())))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<JsonForm, A::Error> {
        if !self.list {
            return Err(A::Error::custom(format!(
                "expected {}, found a list",
                self.wanted
            )));
        }
        Deserialize::deserialize(SeqAccessDeserializer::new(list)).map(JsonForm::Vector)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<JsonForm, A::Error> {
        let keys = MapAccessDeserializer::new(map);
        if !self.input {
            return Table::deserialize(keys).map(|table| JsonForm::One(Value::Table(table)));
        }
        match TableOrInput::deserialize(keys)? {
            TableOrInput {
                table: Some(table),
                interpolation,
                slopes,
                input: None,
            } => Ok(JsonForm::One(Value::Table(Table {
                table,
                interpolation,
                slopes,
            }))),
            TableOrInput {
                table: None,
                interpolation: None,
                slopes: None,
                input: Some(input),
            } => Ok(JsonForm::Input(MasterInput { input })),
            _ => Err(A::Error::custom(format!("expected {}", self.wanted))),
        }
    }
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let wanted = "a number, an expression in t or {\"table\": [[t, y], ...]}";
        let visitor = Anything {
            wanted,
            list: false,
            input: false,
        };
        match deserializer.deserialize_any(visitor)? {
            JsonForm::One(value) => Ok(value),
            JsonForm::Vector(_) | JsonForm::Input(_) => {
                Err(D::Error::custom(format!("expected {wanted}")))
            }
        }
    }
}

impl<'de> Deserialize<'de> for LoadValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let wanted = "a number, an expression in t, {\"table\": [[t, y], ...]} or a list of them";
        let visitor = Anything {
            wanted,
            list: true,
            input: false,
        };
        match deserializer.deserialize_any(visitor)? {
            JsonForm::One(value) => Ok(Self::One(value)),
            JsonForm::Vector(values) => Ok(Self::Vector(values)),
            JsonForm::Input(_) => Err(D::Error::custom(format!("expected {wanted}"))),
        }
    }
}

impl<'de> Deserialize<'de> for MotionValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let visitor = Anything {
            wanted: "a number, an expression in t, {\"table\": [[t, y], ...]}, a list of them or {\"input\": 0, 1 or 2}",
            list: true,
            input: true,
        };
        Ok(match deserializer.deserialize_any(visitor)? {
            JsonForm::One(value) => Self::One(value),
            JsonForm::Vector(values) => Self::Vector(values),
            JsonForm::Input(input) => Self::Input(input),
        })
    }
}
