//! Floor 10. What all versions of FMI share: an instance with its lifecycle, values and saved states, its logger, the
//! guard around every call, and what is written alike. A version brings its functions, its names for things
//! ([`Names`]) and its model description.

mod borrow;
mod float;
mod guid;
mod instance;
mod lifecycle;
mod logger;
mod names;
mod place;
mod resources;
mod state;
mod status;
mod terminals;
mod values;
pub(crate) mod xml;

pub use guid::guid;
pub use lifecycle::{Call, InstanceState};
pub use logger::Category;
pub use status::Status;
pub use terminals::terminals;

pub(crate) use borrow::{guard, lent, lent_mut, place, saved, text};
pub(crate) use float::Environment;
pub(crate) use instance::Instance;
#[cfg(test)]
pub(crate) use lifecycle::settable_states;
pub(crate) use logger::{Logger, Sink};
pub(crate) use names::Names;
pub(crate) use place::own_place;
pub(crate) use resources::{NoSimulation, open};
pub(crate) use state::SavedState;
pub(crate) use status::Fault;

/// Name of the library inside the package; the same for every scene.
pub const MODEL_IDENTIFIER: &str = "flexbody";
