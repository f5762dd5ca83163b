//! Where a simulation starts from.

use schemars::JsonSchema;
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize};

use super::Load;
use super::strict::{Strict, typed};

/// Where the simulation starts from: a state by its name, or a state and loads that act only while it is looked
/// for. Joints that bodies as described do not fit are closed: bodies are moved as a whole, and where that is not
/// enough, cables start deformed, with the least strain energy. From there bodies start with their `motion`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Initial {
    /// A state.
    State(InitialState),
    /// A state under loads of its own.
    Loaded(Loaded),
}

/// A state and loads that act only while it is looked for: what is bent or plucked by them is let go at the start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Loaded {
    /// The state.
    pub state: InitialState,
    /// Loads that act only while it is looked for, beside all others; no springs.
    #[serde(default)]
    pub loads: Vec<Load>,
}

/// States by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InitialState {
    /// The unstressed shapes.
    #[default]
    Undeformed,
    /// The equilibrium under gravity, loads and the start values of the inputs, motions held where they start. It is
    /// stable where loads have a potential: an unstable one, as that of a straight column above its buckling load, is
    /// left to where gravity pulls, else up or to the right. Follower forces have none; there it is where all forces balance.
    StaticEquilibrium,
    /// Equilibrium in the motion that all bodies start with, by motions, joints and their own `motion`: a steady rotation about
    /// one point, in space one axis, with centrifugal forces, or a translation. What rotates starts stretched and does not ring.
    Steady,
}

impl Default for Initial {
    fn default() -> Self {
        Self::State(InitialState::default())
    }
}

impl<'de> Deserialize<'de> for Initial {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Strict::deserialize(deserializer)?.0;
        if value.is_object() {
            return typed(value).map(Self::Loaded);
        }
        if value.is_string() {
            return typed(value).map(Self::State);
        }
        let message =
            format!("expected a state or {{\"state\": ..., \"loads\": [...]}}, found {value}");
        Err(D::Error::custom(message))
    }
}

impl Initial {
    /// The state.
    pub fn state(&self) -> InitialState {
        match self {
            Self::State(state) => *state,
            Self::Loaded(loaded) => loaded.state,
        }
    }

    /// Loads that act only while it is looked for.
    pub fn loads(&self) -> &[Load] {
        match self {
            Self::State(_) => &[],
            Self::Loaded(loaded) => &loaded.loads,
        }
    }
}
