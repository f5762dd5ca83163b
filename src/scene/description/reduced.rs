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

/// Finite element model reduced to modes, from a file. In the plane of a scene lie the first two axes of the file, and the body moves and
/// rotates in it alone: interfaces are where they are seen from across, and modes that nothing in the plane excites do not count.
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
    /// Modes that are taken, in the order of their frequencies; with 0 the body is rigid.
    #[serde(default)]
    pub modes: Modes,
    /// Whether modes that static shapes add far above the others (more than five times their highest frequency) are critically damped, with
    /// `"fixed_interface"` or `"auto"`: they answer and do not ring.
    #[serde(default = "critically_damped", skip_serializing_if = "Clone::clone")]
    pub critically_damped: bool,
    /// Damping ratio of the modes of the free body: a number, or pairs of a frequency (Hz) and the ratio there, linear between them and
    /// constant outside.
    #[serde(default)]
    pub damping_ratio: DampingRatio,
    /// Place of the origin of the file's axes at the start, m.
    pub position: SceneVector,
    /// How the file's axes stand at the start; along the global axes where nothing is said. In the plane a rotation about the third axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orientation: Option<Orientation>,
    /// Motion at the start; velocity of the origin of the file's axes.
    #[serde(default)]
    pub motion: InitialMotion,
    /// Named interfaces of the file.
    #[serde(default)]
    pub markers: BTreeMap<String, String>,
    /// Named points whose stress outputs read: names of stresses in the file.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub gauges: BTreeMap<String, String>,
    /// Content of the file; nothing before it is read.
    #[serde(skip)]
    pub container: Option<Arc<Container>>,
}

/// Static shapes are critically damped where nothing else is said.
fn critically_damped() -> bool {
    true
}

/// Modes of a reduced model that are taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Modes {
    /// All of the file, or as many as the error wanted needs.
    Word(ModesWord),
    /// So many first ones.
    Count(u32),
    /// Modes up to a frequency.
    UpTo(ModesUpTo),
    /// Static shapes and natural modes with held interfaces.
    FixedInterface(FixedInterfaceModes),
}

/// A word that says which modes are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ModesWord {
    /// All modes of the file.
    All,
    /// As many natural modes with held interfaces as the error wanted needs, found by trial runs; none where the body may be rigid.
    Auto,
}

/// Modes in the basis of Craig and Bampton within the modes of the file: static shapes of the interfaces that joints, motions, loads and ports
/// act on, and natural modes with these interfaces held.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FixedInterfaceModes {
    /// Number of natural modes with held interfaces, beside the static shapes.
    pub fixed_interface: u32,
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
        Self::Word(ModesWord::All)
    }
}

impl<'de> Deserialize<'de> for Modes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Strict::deserialize(deserializer)?.0;
        match &value {
            Json::String(word) if word == "all" => Ok(Self::default()),
            Json::String(word) if word == "auto" => Ok(Self::Word(ModesWord::Auto)),
            Json::String(_) => Err(D::Error::custom(format!(
                "expected a number of modes, {{\"up_to\": a frequency in Hz}}, {{\"fixed_interface\": a number of modes}}, \"all\" or \"auto\", found {}",
                found(&value)
            ))),
            Json::Object(keys) if keys.contains_key("fixed_interface") => {
                typed(value).map(Self::FixedInterface)
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

    /// Number of first modes of the file that are taken; all of them where the scene decides on a basis within them.
    pub fn first_modes(&self) -> usize {
        let frequencies = self.contained().frequencies();
        match self.modes {
            Modes::Word(_) | Modes::FixedInterface(_) => frequencies.len(),
            Modes::Count(count) => frequencies.len().min(count as usize),
            Modes::UpTo(ModesUpTo { up_to }) => frequencies.partition_point(|of| *of <= up_to),
        }
    }

    /// Whether it has no modes.
    pub fn is_rigid(&self) -> bool {
        self.modes == Modes::Count(0)
    }

    /// Whether the number of modes is left to the planner.
    pub fn is_open(&self) -> bool {
        self.modes == Modes::Word(ModesWord::Auto)
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
