//! Claims as written in a `case.json`. Keys and kinds not known here are errors.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// A claim.
pub struct Claim {
    /// Scene file in place of the case's.
    pub scene: Option<String>,
    /// Values of variables for a run.
    pub values: Given,
    /// Kind of the claim with its keys.
    pub kind: Kind,
}

/// Values that a claim gives to a run.
#[derive(Clone, Default, PartialEq)]
pub struct Given {
    /// Start values of parameters and inputs.
    pub set: BTreeMap<String, f64>,
    /// Inputs that change at communication points, in the order of time.
    pub changes: Vec<Change>,
}

/// Inputs that change at a communication point.
#[derive(Clone, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Change {
    pub time: f64,
    pub set: BTreeMap<String, f64>,
}

/// Kind of a claim.
pub enum Kind {
    /// Columns of a reference agree at every communication point that it has.
    Series(Series),
    /// Variables have given values at the start or at a time.
    Values(Values),
    /// The error of a variable falls with the order that theory gives.
    Order(Order),
    /// A frequency vanishes at a given start value: buckling.
    Critical(Critical),
    /// A sum of variables keeps its start value over the whole run.
    Drift(Drift),
}

/// See [`Kind::Series`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Series {
    pub stop_time: f64,
    pub step: f64,
    pub reference: String,
    pub columns: BTreeMap<String, String>,
    #[serde(default)]
    pub absolute: f64,
    #[serde(default)]
    pub relative: f64,
    #[serde(default)]
    pub scale: f64,
    #[serde(default)]
    pub distance: bool,
}

/// See [`Kind::Values`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Values {
    #[serde(default)]
    pub time: f64,
    pub step: Option<f64>,
    pub values: BTreeMap<String, f64>,
    pub relative: f64,
    #[serde(default)]
    pub scale: f64,
}

/// See [`Kind::Order`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Order {
    #[serde(default)]
    pub time: f64,
    pub step: Option<f64>,
    pub vary: String,
    pub over: Vec<f64>,
    pub variable: String,
    pub value: f64,
    pub order: f64,
    pub within: f64,
    #[serde(default)]
    pub at_least: bool,
}

/// See [`Kind::Critical`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Critical {
    pub vary: String,
    pub between: [f64; 2],
    pub indicator: String,
    pub value: f64,
    pub relative: f64,
}

/// See [`Kind::Drift`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drift {
    pub stop_time: f64,
    pub step: f64,
    pub sum: Vec<String>,
    #[serde(default)]
    pub less: Vec<String>,
    #[serde(default)]
    pub after: f64,
    pub scale: f64,
    pub absolute: f64,
}

impl Kind {
    /// Returns the name in a `case.json`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Series(_) => "series",
            Self::Values(_) => "values",
            Self::Order(_) => "order",
            Self::Critical(_) => "critical",
            Self::Drift(_) => "drift",
        }
    }
}

impl Claim {
    /// Reads a claim.
    ///
    /// # Errors
    /// A key that is missing, unknown or of another form, in words.
    pub fn parse(mut map: Map<String, Value>) -> Result<Self, String> {
        let scene = match map.remove("scene") {
            None => None,
            Some(Value::String(scene)) => Some(scene),
            Some(other) => return Err(format!("scene: expected a text, found {other}")),
        };
        let note = text(&mut map, "note")?;
        // A limit that is our own earlier output says so, and why there is no other.
        let reason = text(&mut map, "no_reference")?;
        if reason.is_none() && note.is_some_and(|note| note.contains("was measured")) {
            return Err("no_reference: expected why the limit has no outside reference".into());
        }
        let set = map.remove("set").map_or(Ok(BTreeMap::new()), |value| {
            serde_json::from_value(value).map_err(|error| format!("set: {error}"))
        })?;
        let changes = map.remove("changes").map_or(Ok(Vec::new()), |value| {
            serde_json::from_value(value).map_err(|error| format!("changes: {error}"))
        })?;
        let values = Given { set, changes };
        let kind = map.remove("kind");
        let kind = match kind.as_ref().and_then(Value::as_str) {
            Some("series") => Kind::Series(read(map)?),
            Some("values") => Kind::Values(read(map)?),
            Some("order") => Kind::Order(read(map)?),
            Some("critical") => Kind::Critical(read(map)?),
            Some("drift") => Kind::Drift(read(map)?),
            _ => {
                let found = kind.map_or("nothing".into(), |kind| kind.to_string());
                return Err(format!(
                    "kind: expected one of series, values, order, critical, drift, found {found}"
                ));
            }
        };
        Ok(Self {
            scene,
            values,
            kind,
        })
    }
}

/// A text that may be there.
fn text(map: &mut Map<String, Value>, key: &str) -> Result<Option<String>, String> {
    match map.remove(key) {
        None => Ok(None),
        Some(Value::String(text)) => Ok(Some(text)),
        Some(other) => Err(format!("{key}: expected a text, found {other}")),
    }
}

fn read<T: DeserializeOwned>(map: Map<String, Value>) -> Result<T, String> {
    serde_json::from_value(Value::Object(map)).map_err(|error| error.to_string())
}
