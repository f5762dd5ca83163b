//! Finite element models reduced to modes, which a scene reads from files.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::de::{Deserializer, Error as _};
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use super::body::InitialMotion;
use super::reader::found;
use super::strict::{Strict, typed};
use super::{Orientation, SceneVector};
use crate::scene::container::Container;

/// Finite element model reduced to modes, from a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FileBody {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// File of the reduced model, beside the scene: letters, digits, `_`, `-` and `.`, folders before `/`; its name ends in `.safetensors`.
    pub file: String,
    /// SHA-256 of the file, hexadecimal in lower case. A file with another one is refused. Written out when a scene is read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
    /// Modes that are taken, in the order of their frequencies.
    #[serde(default)]
    pub modes: Modes,
    /// Damping ratio of the modes of the free body: a number, or pairs of a frequency (Hz) and the ratio there, linear between them and
    /// constant outside.
    #[serde(default)]
    pub damping_ratio: DampingRatio,
    /// Place of the origin of the file's axes at the start, m.
    pub position: SceneVector,
    /// How the file's axes stand at the start; along the global axes where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orientation: Option<Orientation>,
    /// Motion at the start; velocity of the origin of the file's axes.
    #[serde(default)]
    pub motion: InitialMotion,
    /// Named interfaces of the file.
    #[serde(default)]
    pub markers: BTreeMap<String, String>,
    /// Content of the file; nothing before it is read.
    #[serde(skip)]
    pub container: Option<Arc<Container>>,
}

/// Modes of a reduced model that are taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Modes {
    /// All of the file.
    All(AllModes),
    /// So many first ones.
    Count(#[schemars(range(min = 1))] u32),
    /// Modes up to a frequency.
    UpTo(ModesUpTo),
}

/// The word for all modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AllModes {
    /// All modes of the file.
    All,
}

/// Modes up to a frequency.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModesUpTo {
    /// Highest natural frequency of the free body, Hz.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub up_to: f64,
}

impl Default for Modes {
    fn default() -> Self {
        Self::All(AllModes::All)
    }
}

impl<'de> Deserialize<'de> for Modes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Strict::deserialize(deserializer)?.0;
        match &value {
            Json::String(word) if word == "all" => Ok(Self::default()),
            Json::String(word) => {
                let unknown = match word.as_str() {
                    "auto" => ", which is not available for modes",
                    _ => "",
                };
                Err(D::Error::custom(format!(
                    "expected a number of modes, {{\"up_to\": a frequency in Hz}} or \"all\", found {}{unknown}",
                    found(&value)
                )))
            }
            Json::Object(_) => typed(value).map(Self::UpTo),
            _ => typed(value).map(Self::Count),
        }
    }
}

/// Damping ratio of the modes of a free body.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum DampingRatio {
    /// One ratio of all modes.
    Number(#[schemars(range(min = 0.0))] f64),
    /// Pairs of a frequency, Hz, and the ratio there.
    Table(Vec<[f64; 2]>),
}

impl Default for DampingRatio {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl<'de> Deserialize<'de> for DampingRatio {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Strict::deserialize(deserializer)?.0;
        if value.is_array() {
            typed(value).map(Self::Table)
        } else {
            typed(value).map(Self::Number)
        }
    }
}

impl DampingRatio {
    /// The ratio at a frequency, Hz.
    pub fn at(&self, frequency: f64) -> f64 {
        let table = match self {
            Self::Number(ratio) => return *ratio,
            Self::Table(table) => table,
        };
        let after = table.partition_point(|[at, _]| *at <= frequency);
        let pair = [after.checked_sub(1), Some(after)].map(|at| table.get(at?));
        match pair {
            [Some([a, first]), Some([b, second])] => {
                first + (second - first) * (frequency - a) / (b - a)
            }
            [Some([_, ratio]), None] | [None, Some([_, ratio])] => *ratio,
            [None, None] => 0.0,
        }
    }
}

impl FileBody {
    /// Returns the content of the file.
    ///
    /// # Panics
    /// When the file was not read: a scene that was read has its files.
    pub fn contained(&self) -> &Container {
        let container = self.container.as_deref();
        container.unwrap_or_else(|| unreachable!("a scene that was read has its files"))
    }

    /// Number of modes that are taken.
    pub fn mode_count(&self) -> usize {
        let frequencies = self.contained().frequencies();
        match self.modes {
            Modes::All(_) => frequencies.len(),
            Modes::Count(count) => frequencies.len().min(count as usize),
            Modes::UpTo(ModesUpTo { up_to }) => frequencies.partition_point(|of| *of <= up_to),
        }
    }

    /// Damping ratios of the modes that are taken.
    pub fn damping_ratios(&self) -> Vec<f64> {
        let frequencies = self.contained().frequencies();
        let taken = frequencies.iter().take(self.mode_count());
        taken.map(|of| self.damping_ratio.at(*of)).collect()
    }

    /// The file's axes at the start, in global components, as columns.
    pub fn axes(&self) -> Matrix3<f64> {
        let given = self.orientation.and_then(|orientation| orientation.axes());
        given.unwrap_or_else(Matrix3::identity)
    }

    /// A direction in the file's axes, in global components at the start.
    pub fn directed(&self, way: [f64; 3]) -> [f64; 3] {
        (self.axes() * Vector3::from(way)).into()
    }

    /// Where a point in the file's axes is at the start, m.
    pub fn point(&self, point: [f64; 3]) -> [f64; 3] {
        let way = self.directed(point);
        std::array::from_fn(|k| self.position[k] + way[k])
    }

    /// Where the centre of mass is at the start, m.
    pub fn center(&self) -> [f64; 3] {
        self.point(self.contained().center.into())
    }

    /// Where an interface is at the start, m.
    pub fn place(&self, interface: usize) -> [f64; 3] {
        self.point(self.contained().place(interface).into())
    }
}
