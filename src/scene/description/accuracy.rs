//! What accuracy is asked for, and what is left to the planner.

use super::strict::{Strict, typed};
use super::value::Value;
use schemars::JsonSchema;
use serde::de::{Deserializer, Error as _};
use serde::{Deserialize, Serialize, Serializer};

/// Accuracy that is requested: an error, from which meshes and the tolerance follow while packaging, or a tolerance.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Accuracy {
    /// Error wanted of every output over the default experiment, relative to its own largest change: of positions, angles and directions
    /// from where the scene draws them, of all else from zero. What hardly changes is held to a thousandth of like outputs of its body.
    /// By default 1e-3 where numbers of elements are left to the planner. Where nothing is left to it, what warnings and the output
    /// `resolution` are measured by: ten times the tolerance where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
    /// Names of the outputs that count, without indices; by default all but energies, work and residuals.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub of: Vec<String>,
    /// Profiles of inputs in the experiment that is planned for; inputs that are not named keep their start values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub input_profiles: Vec<InputCourse>,
    /// Error in time that a step may make, relative to the length of the body (root mean square
    /// over its mass). By default 1e-4; 1e-7 in a scene without cables, which then keeps its energy to
    /// 0.1 % over a thousand swings or turns. Beside `error`, from which it follows, only where numbers of elements are
    /// given.
    #[serde(default)]
    pub relative_tolerance: Option<f64>,
    /// Notes of the planner on errors that it could not keep and on inputs that it held: written by it, told by units when they are instantiated.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// Profile of an input in the experiment that is planned for: `value`, or a ramp `from` one value `to` another.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InputCourse {
    /// Name of the input, with its index where it is a component.
    pub input: String,
    /// Profile in time, beside which no other key stands: a number, an expression in `t`, or a table, straight from point to point unless it
    /// says `spline`. A driven motion has the rates of this course, where they are inputs without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
    /// Value that it starts from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<f64>,
    /// Value that it goes to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<f64>,
    /// How it goes there: `ramp` where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub course: Option<Course>,
    /// Time that a ramp takes from the start on, s; it then stays. Where nothing is said it takes a tenth of the experiment, and goes back
    /// after half of it.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration: Option<f64>,
}

/// Ways from a value to another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Course {
    /// A smooth ramp over the first tenth of the experiment, and one back over a tenth after its half.
    #[default]
    Ramp,
    /// A jump after a tenth of the experiment, and one back after its half.
    Step,
    /// To and fro as a cosine, three times.
    Sine,
}

/// A number of elements in JSON: an integer, or `"auto"`, which is none.
pub(super) mod elements {
    use serde_json::Value as Json;

    use super::*;

    /// A number of elements, or the word that leaves it to the planner.
    #[derive(Serialize, JsonSchema)]
    #[schemars(rename = "Elements")]
    #[serde(untagged)]
    pub enum InJson {
        /// As many as the accuracy asks for: found while packaging.
        Auto(Word),
        /// Number of elements.
        Count(u32),
    }

    /// The word for a number that is left to the planner.
    #[derive(Serialize, JsonSchema)]
    #[schemars(rename = "Auto")]
    #[serde(rename_all = "snake_case")]
    pub enum Word {
        /// As many as the accuracy asks for.
        Auto,
    }

    /// Writes a number of elements, or the word for one that is left to the planner.
    ///
    /// # Errors
    /// The serializer fails.
    pub fn serialize<S: Serializer>(count: &Option<u32>, serializer: S) -> Result<S::Ok, S::Error> {
        let value = count.map_or(InJson::Auto(Word::Auto), InJson::Count);
        value.serialize(serializer)
    }

    /// Reads a number of elements, or the word for one that is left to the planner.
    ///
    /// # Errors
    /// Neither a positive integer nor that word.
    pub fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<u32>, D::Error> {
        match Strict::deserialize(deserializer)?.0 {
            Json::String(word) if word == "auto" => Ok(None),
            Json::String(word) => Err(D::Error::custom(format!(
                "expected \"auto\" or a positive integer, found \"{word}\""
            ))),
            count => typed(count).map(Some),
        }
    }
}
